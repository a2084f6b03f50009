"""Scenarios: a spacecraft, its initial state, what happens over time, and what is recorded."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

from . import _native, _wanted
from ._tables import Overrides, overrides_of, toml_of
from .columns import Column
from .control import ControllerFunction, _of_fields
from .errors import RunError
from .result import Result

if TYPE_CHECKING:
    from ._native import NativeScenario
    from .spacecraft import Joint, Spacecraft

__all__ = ["Scenario", "ScenarioWarning"]

StrPath = str | os.PathLike[str]


class ScenarioWarning(UserWarning):
    """What may not be meant in a scenario, as ``precess check`` says it."""


class Scenario:
    """A scenario: what a scenario file says, with every default, layout and unit resolved.

    ``Scenario(hub={...}, device=[{...}], run={...})`` takes the tables of a scenario file as keyword
    arguments. A quantity is a text with its unit (``"900 kg"``) or a number in SI units and radians.
    ``format`` is 1 where it is missing. Read-only: :meth:`with_values` returns another scenario.
    """

    _native: NativeScenario
    _origin: tuple[Any, ...]

    def __init__(self, **tables: Any) -> None:
        other = type(self).from_dict(tables)
        self._native, self._origin = other._native, other._origin

    @classmethod
    def _of(cls, native: NativeScenario, origin: tuple[Any, ...]) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._native = native
        scenario._origin = origin
        return scenario

    @classmethod
    def _read(cls, origin: tuple[Any, ...]) -> Scenario:
        native = _native_of(origin)
        for warning in native.warnings:
            warnings.warn(warning, ScenarioWarning, stacklevel=3)
        return cls._of(native, origin)

    @classmethod
    def from_toml(cls, path: StrPath, set: Overrides | None = None) -> Scenario:
        """Reads a scenario file and the files it is based on.

        Parameters
        ----------
        path : path
            The file.
        set : mapping, optional
            Keys to replace: ``{"hub.mass": "900 kg", "device.cmg1.wheel.rate": 314.0}``. A number is
            in SI units and radians.

        Raises
        ------
        ScenarioError
            With everything that is wrong, each with its place and remedy.
        """
        return cls._read(("file", os.fspath(path), tuple(overrides_of(set))))

    @classmethod
    def from_text(
        cls,
        text: str,
        folder: StrPath | None = None,
        set: Overrides | None = None,
        name: str = "scenario",
    ) -> Scenario:
        """Reads the text of a scenario file; files that it names are beside ``folder``."""
        text, name = _wanted.text("text", text), _wanted.text("name", name)
        beside = os.fspath(folder) if folder is not None else ""
        return cls._read(("text", name, text, beside, tuple(overrides_of(set)), False))

    @classmethod
    def from_dict(
        cls,
        tables: Mapping[str, Any],
        folder: StrPath | None = None,
        set: Overrides | None = None,
        name: str = "scenario",
    ) -> Scenario:
        """Reads tables as a scenario file has them; numbers without a unit are in SI units."""
        name = _wanted.text("name", name)
        text = toml_of({"format": 1} | dict(_wanted.table("tables", tables)))
        beside = os.fspath(folder) if folder is not None else ""
        return cls._read(("text", name, text, beside, tuple(overrides_of(set)), True))

    def with_values(self, values: Overrides) -> Scenario:
        """The scenario with keys replaced, read again from what this one was read from.

        Raises
        ------
        ScenarioError
            As :meth:`from_toml`, or where a file is not there any more.
        """
        more = tuple(overrides_of(_wanted.table("values", values)))
        if self._origin[0] == "file":
            kind, path, overrides = self._origin
            return self._read((kind, path, overrides + more))
        kind, name, text, folder, overrides, si = self._origin
        return self._read((kind, name, text, folder, overrides + more, si))

    def to_toml(self) -> str:
        """The scenario as the text of a file, in SI units, every default written out."""
        return self._native.filled

    @property
    def name(self) -> str:
        """The name in file names."""
        return self._native.name

    @property
    def title(self) -> str:
        """What a heading says."""
        return self._native.title

    @property
    def description(self) -> str:
        """What it shows and where its numbers come from."""
        return self._native.description

    @property
    def duration(self) -> float:
        """Length of a run, s."""
        return self._native.duration

    @property
    def devices(self) -> dict[str, str]:
        """The kind of each device and platform, by its name, in order."""
        return dict(self._native.members)

    @property
    def columns(self) -> tuple[Column, ...]:
        """The quantities that a run records, ``time`` first."""
        return tuple(Column(*facts) for facts in self._native.columns)

    @property
    def all_columns(self) -> tuple[Column, ...]:
        """Every quantity that can be recorded: names for ``output.columns``."""
        return tuple(Column(*facts) for facts in self._native.all_columns)

    @cached_property
    def spacecraft(self) -> Spacecraft:
        """The spacecraft, to be evaluated at any state."""
        from .spacecraft import Spacecraft

        return Spacecraft(self)

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The joints in order, with the names of their coordinates, rates and motors."""
        return self.spacecraft.joints

    @property
    def warnings(self) -> tuple[str, ...]:
        """What may not be meant, as ``precess check`` says it."""
        return tuple(self._native.warnings)

    def run(
        self,
        progress: Callable[[float], bool | None] | None = None,
        formats: Sequence[str] = (),
        out: StrPath | None = None,
        controllers: Mapping[str, ControllerFunction] | None = None,
    ) -> Result:
        """Runs the scenario, without the interpreter's lock but while a function of yours is called.

        Parameters
        ----------
        progress : callable, optional
            Called with the simulated time, s, some twenty times a second. The run is cancelled where
            it returns False, its result complete up to there.
        formats : sequence of str, optional
            Files to write on the way: ``"csv"``, ``"npz"``. They are named ``NAME.csv`` in ``out`` and
            get their name when they are complete.
        out : path, optional
            The folder of the files; the present one by default. It is made where it is missing.
        controllers : mapping of functions, optional
            By the name of a ``[[controller]]``: a function that is called with each
            :class:`precess.ControllerSample`, in order of time, in the place of the law of the scenario. It
            returns the torque on the spacecraft about its centre of mass, three numbers in B in N m, which is
            divided among the joints that the controller commands; or ``{"motors": [..]}``, the torque of each of
            their motors. What it raises is raised. Give each run a function of its own if it keeps a state.

        Raises
        ------
        KeyError
            Where no controller has a name of ``controllers``.
        RunError
            Where an error ends the run; ``error.result`` has what was recorded up to there.
        ScenarioError, ParameterError, RecordError
            Where it cannot start.
        """
        progress = _wanted.function("progress", progress)
        formats = _wanted.names("formats", formats)
        folder = os.fspath(out) if out is not None else "."
        if formats:
            os.makedirs(folder, exist_ok=True)
        files = [(format, os.path.join(folder, f"{self.name}.{format}")) for format in formats]
        own = _controllers(controllers, self._native.controllers)
        native, arrays = _native.run(self._native, progress, files, own)
        result = Result._of(self, native, arrays)
        try:
            native.raise_error()
        except RunError as error:
            error.result = result
            raise
        return result

    def __repr__(self) -> str:
        devices = ", ".join(f"{name} ({kind})" for name, kind in self.devices.items())
        return f"<precess.Scenario {self.name!r}: {devices or 'no devices'}; {self.duration:g} s>"

    def __eq__(self, other: object) -> bool:
        """Whether every number is the same, to the bit."""
        if not isinstance(other, Scenario):
            return NotImplemented
        return self.to_toml() == other.to_toml()

    def __hash__(self) -> int:
        return hash(self.to_toml())

    def __reduce__(self) -> tuple[Callable[..., Scenario], tuple[Any, ...]]:
        """The text with every default: no file is needed where it is read again."""
        return _unpickled, (self.to_toml(), *self._native.source, self._origin)


def _controllers(
    of: Mapping[str, ControllerFunction] | None, known: Sequence[str]
) -> list[tuple[str, Callable[..., object]]]:
    if of is None:
        return []
    found = []
    for name, function in _wanted.table("controllers", of).items():
        if name not in known:
            names = ", ".join(known) or "none"
            raise KeyError(f"no controller is named {name!r}; there are: {names}")
        found.append((name, _of_fields(_wanted.called(f"controllers[{name!r}]", function))))
    return found


def _native_of(origin: tuple[Any, ...]) -> NativeScenario:
    if origin[0] == "file":
        _, path, overrides = origin
        return _native.NativeScenario.from_file(path, list(overrides))
    _, name, text, folder, overrides, si = origin
    return _native.NativeScenario.from_text(name, text, folder, list(overrides), si)


def _unpickled(filled: str, path: str, text: str, origin: tuple[Any, ...]) -> Scenario:
    return Scenario._of(_native.NativeScenario.from_filled(filled, path, text), origin)
