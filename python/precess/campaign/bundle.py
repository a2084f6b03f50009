"""The files of a scenario, in memory: what a worker needs where it does not see the disk of the client."""

from __future__ import annotations

import functools
import hashlib
import os
import tempfile
import threading
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..scenario import Scenario

__all__ = ["Bundle"]


@dataclass(frozen=True)
class Bundle:
    """A scenario with every file that it names.

    ``origin`` is that of a :class:`precess.Scenario`, its path or folder relative to the folder that ``files`` are
    laid out in.
    """

    origin: tuple[Any, ...]
    files: tuple[tuple[str, bytes], ...]

    @classmethod
    def of(cls, scenario: Scenario) -> Bundle:
        """Reads the files of a scenario: itself, those it is based on, and the tables that it names."""
        origin = scenario._origin
        found: dict[Path, bytes] = {}
        if origin[0] == "file":
            path = Path(origin[1]).absolute()
            _add(path, found)
            folder, overrides = path.parent, origin[2]
        else:
            folder, overrides = Path(origin[3]).absolute(), origin[4]
            _add_named(tomllib.loads(origin[2]), folder, found)
        for override in overrides:
            _add_named(tomllib.loads(override), folder, found)
        root = Path(os.path.commonpath([folder, *(path.parent for path in found)]))
        files = sorted((path.relative_to(root).as_posix(), data) for path, data in found.items())
        if origin[0] == "file":
            moved = ("file", path.relative_to(root).as_posix(), overrides)
        else:
            moved = (*origin[:3], folder.relative_to(root).as_posix(), *origin[4:])
        return cls(moved, tuple(files))

    def digest(self) -> str:
        """SHA-256 of texts, files and their names."""
        hash_ = hashlib.sha256(repr(self.origin).encode())
        for name, data in self.files:
            hash_.update(f"\n{name} {len(data)}\n".encode() + data)
        return hash_.hexdigest()

    def shown(self, message: str) -> str:
        """A message without the folder of this process."""
        return message.replace(_folder(self) + os.sep, "")

    def laid_out(self) -> tuple[Any, ...]:
        """The origin of the scenario, its files in a folder that lasts as long as this process."""
        folder = _folder(self)
        place = 1 if self.origin[0] == "file" else 3
        path = os.path.normpath(os.path.join(folder, self.origin[place]))
        return (*self.origin[:place], path, *self.origin[place + 1 :])


@functools.lru_cache(maxsize=8)
def _laid_out(bundle: Bundle) -> tempfile.TemporaryDirectory[str]:
    folder = tempfile.TemporaryDirectory(prefix="precess-campaign-")
    for name, data in bundle.files:
        path = Path(folder.name, name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)
    return folder


#: Threads that begin at once would each lay out the files, and one folder would go away under the others.
_LOCK = threading.Lock()


def _folder(bundle: Bundle) -> str:
    with _LOCK:
        return _laid_out(bundle).name


def _add(path: Path, found: dict[Path, bytes]) -> None:
    path = Path(os.path.normpath(path))
    if path in found:
        return
    found[path] = path.read_bytes()
    if path.suffix == ".toml":
        _add_named(tomllib.loads(found[path].decode()), path.parent, found)


def _add_named(tables: Any, folder: Path, found: dict[Path, bytes]) -> None:
    """Adds each file that a text of some tables names."""
    for text in _texts(tables):
        # A file beyond what a path may be is none.
        if 0 < len(text) < 1024 and "\n" not in text and (folder / text).is_file():
            _add(folder / text, found)


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for entry in value.values():
            yield from _texts(entry)
    elif isinstance(value, list):
        for entry in value:
            yield from _texts(entry)
