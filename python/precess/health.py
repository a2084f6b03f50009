"""What has changed in a spacecraft, from its telemetry, as ``precess watch`` finds it.

>>> import precess
>>> found = precess.watch("bus.toml", data="telemetry.csv")
>>> found.alarms
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._telemetry import columns_of, file_of, scenario_of
from ._wanted import number, text
from .scenario import Scenario

__all__ = ["Alarm", "Series", "WatchedRecord", "watch"]

Array = npt.NDArray[np.float64]
StrPath = str | os.PathLike[str]


@dataclass(frozen=True)
class Alarm:
    """A change that a test has found, SI.

    Attributes
    ----------
    name, unit : str
        What has changed: ``drag torque of rw1``.
    time, onset : float
        When it was found, and since when it has been so, s.
    before, change : float
        The reference, and the mean since the onset less that.
    low, high : float
        The interval of 95 % of the change, at this onset.
    test : str
        ``likelihood ratio`` or ``cumulative sum``.
    alike : tuple of str
        What would look the same to these sensors.
    """

    name: str
    unit: str
    time: float
    onset: float
    before: float
    change: float
    low: float
    high: float
    test: str
    alike: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Series:
    """A quantity, block by block, SI.

    Attributes
    ----------
    unit : str
        Its unit.
    values, deviations : array, shape (blocks,)
        Estimates and their standard deviations, of white noise of the sensors; NaN where a block does not determine it.
    reference : float or None
        Its mean over the reference; None where that was not taken.
    scatter : float or None
        Root of the variance about the reference by the stated one: bounds are as much wider.
    """

    unit: str
    values: Array
    deviations: Array
    reference: float | None
    scatter: float | None


class WatchedRecord:
    """A record that was watched."""

    def __init__(self, native: _native.NativeWatched) -> None:
        self.start, self.end = native.times()
        """Start and end of each block, s."""
        self.alarms = tuple(
            Alarm(name, unit, time, onset, before, change, change - half, change + half, test, tuple(alike))
            for name, unit, (time, onset, before, change, half), test, alike in native.alarms
        )
        """What has changed, in the order in which it was found."""
        self.series = {
            name: Series(unit, *native.series(index), *_reference(reference))
            for index, (name, unit, reference) in enumerate(native.quantities)
        }
        """Every quantity by its name: ``static imbalance of rw1``. A torque constant is found in the series of drag."""
        self.exclusions = tuple(native.exclusions)
        """What was left out of the data, in sentences."""
        self.remarks = tuple(native.remarks)
        """What is not watched, with the reason."""

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of the series: a row for each block by its ``start``, columns ``end``, and of each quantity its name
        and its name with ``deviation``."""
        import pandas as pd

        data: dict[str, Array] = {"end": self.end}
        for name, series in self.series.items():
            data[name], data[f"{name}, deviation"] = series.values, series.deviations
        return pd.DataFrame(data, index=pd.Index(self.start, name="start"))

    def alarms_to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of the alarms: a row for each, columns as the fields of :class:`Alarm`."""
        import pandas as pd

        names = list(Alarm.__dataclass_fields__)
        return pd.DataFrame([[getattr(of, name) for name in names] for of in self.alarms], columns=names)

    def __repr__(self) -> str:
        count, alarms = len(self.start), len(self.alarms)
        return f"<precess.health.WatchedRecord of {count} blocks: {len(self.series)} quantities; {alarms} alarms>"


def watch(
    scenario: Scenario | StrPath,
    data: StrPath | Mapping[str, npt.ArrayLike],
    block: float = 2.0,
    learn: float = 600.0,
    false_alarms: float = 1.0,
    controller: str | None = None,
) -> WatchedRecord:
    """Runs the model of a scenario along telemetry, and finds what has changed since its first blocks.

    Parameters
    ----------
    scenario : Scenario or path
        What is known of the spacecraft, with the controller whose sensors the telemetry is of.
    data : path, mapping or pandas.DataFrame
        The file (CSV, NPZ), or columns by the names that a run has: ``time``, ``aocs.gyro_x``, ``rw1.spin``, ``rw1.u_w``; NaN where
        a sensor has no reading. The index of a frame is its time where that has the name of no column.
    block, learn : float
        Length of a block, and how long the reference is taken from the start, s.
    false_alarms : float
        False alarms an hour, of all tests together.
    controller : str or None
        The controller, where there are several.

    Raises
    ------
    SignalError
        Data that are no telemetry of this scenario, or from which nothing is watched; lengths and rates out of their range.
    """
    lengths = (number("block", block), number("learn", learn))
    rate = number("false_alarms", false_alarms)
    named = None if controller is None else text("controller", controller)
    read = scenario_of(scenario)
    path = file_of(data)
    columns = [] if path is not None else columns_of(data)
    return WatchedRecord(_native.watch(read._native, columns, path, named, lengths, rate))


def _reference(of: tuple[float, float] | None) -> tuple[float | None, float | None]:
    return (None, None) if of is None else (of[0], float(np.sqrt(of[1])))
