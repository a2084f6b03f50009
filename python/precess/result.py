"""Results: the samples of a run by name, and what became of it."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._wanted import text
from .columns import Column

if TYPE_CHECKING:
    import numpy.typing as npt

    from ._native import NativeResult
    from .scenario import Scenario

    Array = npt.NDArray[np.float64]

__all__ = ["Drift", "Event", "Requirement", "Result"]


@dataclass(frozen=True)
class Event:
    """What happened at a time, s."""

    time: float
    text: str


@dataclass(frozen=True)
class Drift:
    """How far conserved quantities drifted, each in a unit that cannot vanish; None where one is not conserved."""

    energy: float | None
    linear_momentum: float | None
    angular_momentum: float | None


@dataclass(frozen=True)
class Requirement:
    """A requirement and what became of it. ``value`` and ``limit`` are SI; ``unit`` is the shown one.

    ``state`` is ``"met"``, ``"violated"`` or ``"not evaluated"``: nothing was measured, for the ``reason``.
    """

    name: str
    quantity: str
    value: float | None
    limit: float
    unit: tuple[str, float]
    complete: bool
    state: str
    reason: str | None

    @property
    def met(self) -> bool:
        """Whether it is met: one that is not evaluated is neither met nor violated."""
        return self.state == "met"


class Result:
    """The samples of a run, one array for each column, and what became of the run.

    ``result["omega_x"]`` is a column, ``result["omega"]`` the three of a vector side by side, shape
    ``(samples, 3)``; ``omega.x`` is taken for ``omega_x``. Arrays of columns are not copied.
    """

    def __init__(self) -> None:
        raise TypeError("a Result comes from Scenario.run")

    @classmethod
    def _of(
        cls,
        scenario: Scenario,
        native: NativeResult,
        arrays: list[Array],
        requirements: tuple[Requirement, ...] | None = None,
    ) -> Result:
        result = cls.__new__(cls)
        result._scenario = scenario
        result._native = native
        if requirements is None:
            requirements = tuple(Requirement(*facts) for facts in native.verdicts)
        result._requirements = requirements
        result._columns = tuple(Column(*facts) for facts in native.columns)
        for array in arrays:
            array.flags.writeable = False
        result._arrays = dict(zip((column.name for column in result._columns), arrays, strict=True))
        return result

    _scenario: Scenario
    _native: NativeResult
    _requirements: tuple[Requirement, ...]
    _columns: tuple[Column, ...]
    _arrays: dict[str, Array]

    @property
    def scenario(self) -> Scenario:
        """The scenario that was run."""
        return self._scenario

    @property
    def columns(self) -> tuple[Column, ...]:
        """The columns in order, ``time`` first."""
        return self._columns

    @property
    def units(self) -> dict[str, str]:
        """The unit of each column by its name."""
        return {column.name: column.unit for column in self._columns}

    @property
    def time(self) -> Array:
        """Time since the start of the run, s, shape ``(samples,)``."""
        return self._arrays["time"]

    def __getitem__(self, name: str) -> Array:
        text("the name of a column", name)
        for known in (name, name.replace(".x", "_x").replace(".y", "_y").replace(".z", "_z")):
            if known in self._arrays:
                return self._arrays[known]
        parts = [column.name for column in self._columns if column.vector == name]
        if parts:
            return np.column_stack([self._arrays[part] for part in parts])
        import difflib

        near = difflib.get_close_matches(name, self._arrays)
        hint = f"; nearest: {', '.join(near)}" if near else ""
        raise KeyError(f"`{name}` was not recorded{hint}")

    def __contains__(self, name: object) -> bool:
        return name in self._arrays or any(column.vector == name for column in self._columns)

    def __iter__(self) -> Iterator[str]:
        return iter(self._arrays)

    def __len__(self) -> int:
        """How many samples there are."""
        return len(self.time)

    def keys(self) -> tuple[str, ...]:
        """The names of the columns."""
        return tuple(self._arrays)

    @property
    def end(self) -> str:
        """Why the run ended: ``finished``, ``cancelled``, an end stop, a crossing, an error."""
        return self._native.end

    @property
    def is_complete(self) -> bool:
        """Whether the run reached its end as the scenario has it."""
        return self._native.is_complete

    @property
    def end_time(self) -> float:
        """Simulated time at which the run ended, s."""
        return self._native.end_time

    @property
    def events(self) -> tuple[Event, ...]:
        """Changes, stops and crossings in the order of time."""
        return tuple(Event(*event) for event in self._native.events)

    @property
    def drift(self) -> Drift:
        """How far conserved quantities drifted."""
        return Drift(*self._native.drift)

    @property
    def energy_lost(self) -> float:
        """Energy lost in brakes and locking end stops, J."""
        return self._native.energy_lost

    @property
    def steps(self) -> dict[str, int]:
        """Steps accepted and rejected, and evaluations of the equations of motion."""
        return dict(zip(("accepted", "rejected", "evaluations"), self._native.steps, strict=True))

    @property
    def requirements(self) -> tuple[Requirement, ...]:
        """What became of each requirement."""
        return self._requirements

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with ``time`` as its index; units in ``frame.attrs["units"]``."""
        import pandas as pd

        data = {name: array for name, array in self._arrays.items() if name != "time"}
        frame = pd.DataFrame(data, index=pd.Index(self.time, name="time"))
        frame.attrs["units"] = self.units
        return frame

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over ``time``; unit, frame and meaning as attributes."""
        import xarray as xr

        variables = {
            column.name: ("time", self._arrays[column.name], _attributes(column))
            for column in self._columns
            if column.name != "time"
        }
        time = ("time", self.time, _attributes(self._columns[0]))
        return xr.Dataset(variables, {"time": time}, {"scenario": self.scenario.to_toml()})

    def to_parquet(self, path: str | os.PathLike[str]) -> None:
        """Writes a Parquet file by pyarrow, which gets its name when it is complete."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        fields = [
            pa.field(column.name, pa.float64(), False, _attributes(column))
            for column in self._columns
        ]
        arrays = [pa.array(array) for array in self._arrays.values()]
        about = {"precess.scenario": self.scenario.to_toml(), "precess.end": self.end}
        table = pa.Table.from_arrays(arrays, schema=pa.schema(fields, about))
        folder, name = os.path.split(os.fspath(path))
        partial = os.path.join(folder, f".{name}.{os.getpid()}.partial")
        try:
            pq.write_table(table, partial)
            os.replace(partial, path)
        except BaseException:
            with contextlib.suppress(FileNotFoundError):
                os.unlink(partial)
            raise

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes ``.csv``, ``.npz`` or ``.parquet``, as the command line does.

        The file gets its name when it is complete; an error leaves none behind.
        """
        suffix = os.path.splitext(path)[1].removeprefix(".")
        if suffix == "parquet":
            self.to_parquet(path)
        else:
            self._native.save(suffix, os.fspath(path), list(self._arrays.values()))

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Draws columns or vectors over time by matplotlib; returns the axes, one for each name."""
        import matplotlib.pyplot as plt

        names = names or ("omega",)
        if axes is None:
            _, axes = plt.subplots(len(names), sharex=True, squeeze=False, layout="constrained")
            axes = axes[:, 0]
        for name, ax in zip(names, np.atleast_1d(axes), strict=True):
            ax.plot(self.time, self[name])
            units = {c.unit for c in self._columns if name in (c.name, c.vector)}
            ax.set_ylabel(f"{name}, {', '.join(sorted(units))}")
        np.atleast_1d(axes)[-1].set_xlabel("time, s")
        return axes

    def __reduce__(self) -> tuple[Callable[..., Result], tuple[Any, ...]]:
        """Samples, and all that is known of the run: read again, it can be saved as here."""
        arrays = list(self._arrays.values())
        return _unpickled, (self._scenario, self._native.outcome, arrays, self._requirements)

    def __repr__(self) -> str:
        return (
            f"<precess.Result of {self.scenario.name!r}: {len(self)} samples of "
            f"{len(self._columns)} columns to {self.end_time:g} s; {self.end}>"
        )


def _unpickled(
    scenario: Scenario, outcome: Any, arrays: list[Array], requirements: tuple[Requirement, ...]
) -> Result:
    native = _native.NativeResult.restored(scenario._native, outcome)
    return Result._of(scenario, native, arrays, requirements)


def _attributes(column: Column) -> dict[str, str]:
    known = {"units": column.unit, "frame": column.frame, "long_name": column.meaning}
    return {key: value for key, value in known.items() if value is not None}
