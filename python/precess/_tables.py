"""Tables of Python as TOML: what the reader of scenario files takes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._wanted import table

__all__ = ["overrides_of", "path_of", "toml_of"]

Overrides = Mapping[str, Any]


def overrides_of(values: Overrides | None) -> list[str]:
    """``{"hub.mass": "900 kg"}`` as the overrides of the command line, in order.

    A table within is a table of the scenario: its keys replace those there.
    """
    values = {} if values is None else table("set", values)
    return [f"{path_of(key)} = {_value(value)}" for key, value in values.items()]


def toml_of(tables: Mapping[str, Any]) -> str:
    """Tables as TOML, one top-level key a line."""
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in tables.items())


def path_of(path: str) -> str:
    """The path of a key as TOML has it, with quotation marks where they are needed."""
    if not isinstance(path, str):
        raise TypeError(f"keys of a scenario are texts, not {path!r}")
    return ".".join(_key(key) for key in path.split("."))


def _key(key: object) -> str:
    if not isinstance(key, str):
        raise TypeError(f"keys of a scenario are texts, not {key!r}")
    bare = key.isascii() and all(c.isalnum() or c in "-_" for c in key)
    return key if key and bare else _text(key)


def _text(text: str) -> str:
    escaped = "".join(_escaped(c) for c in text)
    return f'"{escaped}"'


def _escaped(c: str) -> str:
    if c in '"\\':
        return "\\" + c
    return f"\\u{ord(c):04x}" if ord(c) < 0x20 or ord(c) == 0x7F else c


def _value(value: object) -> str:
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        # The fewest digits that read back the same; TOML also has inf and nan.
        return repr(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        entries = (f"{_key(key)} = {_value(entry)}" for key, entry in value.items())
        return "{ " + ", ".join(entries) + " }" if value else "{}"
    if isinstance(value, Sequence):
        return "[" + ", ".join(_value(entry) for entry in value) + "]"
    raise TypeError(
        f"a scenario takes texts, numbers, true or false, lists and tables, not {value!r}"
    )
