"""Imbalance, friction, mounts and inertia of a spacecraft from its telemetry, as ``precess identify`` finds them.

>>> import precess
>>> found = precess.identify("bus.toml", data="bus-telemetry.csv", unknown="bus-unknown.toml")
>>> found.wheels["rw1"].u_s
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._tables import toml_of
from ._telemetry import columns_of, file_of, scenario_of
from ._wanted import instance, table, text
from .fit import Estimate
from .scenario import Scenario

__all__ = [
    "Design",
    "Direction",
    "Identification",
    "Number",
    "Residual",
    "Wheel",
    "identify",
]

Array = npt.NDArray[np.float64]
StrPath = str | os.PathLike[str]


@dataclass(frozen=True)
class Number:
    """A number that was estimated, SI: ``told`` says whether data or a prior tell it."""

    name: str
    unit: str
    estimate: Estimate
    told: bool


@dataclass(frozen=True)
class Wheel:
    """The imbalance of a wheel.

    Attributes
    ----------
    u_s, u_d : Estimate
        Static and dynamic imbalance, kg m and kg m².
    phase, angle : Estimate
        By which the torque of ``u_d`` leads the force of ``u_s``, and the angle of the wheel at the start of the record at which
        that force is along its y axis, rad.
    hidden : (bool, bool)
        Whether noise hides ``u_s``, and ``u_d``: the interval reaches to zero, and its upper end is a bound.
    told : bool
        Whether data or priors tell all four.
    """

    u_s: Estimate
    u_d: Estimate
    phase: Estimate
    angle: Estimate
    hidden: tuple[bool, bool]
    told: bool


@dataclass(frozen=True)
class Direction:
    """A change of several numbers together that the data do not tell.

    Attributes
    ----------
    changes : dict
        What each number changes by, SI.
    deviation : float
        Standard deviation along it by the data, in steps of it; infinite where they do not depend on it.
    has_prior : bool
        Whether priors tell it.
    """

    changes: dict[str, float]
    deviation: float
    has_prior: bool


@dataclass(frozen=True)
class Residual:
    """What the model leaves of a sensor: how many numbers; their mean square by the stated variance (noise has 0.99); how many
    are beyond three standard deviations; whether the model explains them."""

    count: int
    mean_square: float
    outliers: int
    holds: bool


@dataclass(frozen=True, eq=False)
class Design:
    """What manoeuvres would add to a record.

    Attributes
    ----------
    manoeuvres : tuple of str
        Their names.
    durations : array
        Their lengths, s.
    names, units : tuple of str
        The numbers of the spacecraft.
    alone : array, shape (numbers,)
        Standard deviations with the record alone, SI; infinite where nothing tells a number.
    with_manoeuvre : array, shape (numbers, manoeuvres)
        With the record and each manoeuvre.
    untold : tuple of Direction
        What the record does not tell of the spacecraft.
    deviations : array, shape (directions, manoeuvres)
        Standard deviation along each by the data of the record and of each manoeuvre, in steps of it: 1 and less is determined.
    """

    manoeuvres: tuple[str, ...]
    durations: Array
    names: tuple[str, ...]
    units: tuple[str, ...]
    alone: Array
    with_manoeuvre: Array
    untold: tuple[Direction, ...]
    deviations: Array

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of the standard deviations: a row for each number, columns ``unit``, ``record`` and one for each
        manoeuvre."""
        import pandas as pd

        columns = dict(zip(self.manoeuvres, self.with_manoeuvre.T, strict=True))
        data = {"unit": self.units, "record": self.alone, **columns}
        return pd.DataFrame(data, index=pd.Index(self.names, name="number"))


class Identification:
    """What was found in a record."""

    def __init__(self, native: _native.NativeIdentified) -> None:
        self._native = native
        self.numbers = {
            name: Number(name, unit, Estimate(*estimate), told)
            for name, unit, estimate, told in native.numbers
        }
        """All numbers by their names, SI; those of the start among them."""
        self.wheels = {
            device: Wheel(
                Estimate(*u_s), Estimate(*u_d), Estimate(*phase), Estimate(*angle), (by_u_s, by_u_d), told
            )
            for device, (u_s, u_d, phase, angle), (by_u_s, by_u_d), told in native.wheels
        }
        """Imbalances by the names of devices."""
        self.covariance = np.array(native.covariance)
        """Of all numbers, in their order, SI."""
        self.untold = tuple(_direction(facts) for facts in native.untold)
        """What the data do not tell."""
        self.residuals = {
            sensor: Residual(count, square, outliers, holds)
            for sensor, count, square, outliers, holds in native.residuals
        }
        """What the model leaves of each sensor."""
        self.exclusions = tuple(native.exclusions)
        """What was left out of the data, in sentences."""
        self.holds, self.is_told = native.verdict
        """Whether the model explains the readings; whether data or priors tell all that is unknown."""
        start, end, self.steps = native.span
        self.span = (start, end)
        """From when to when the record is, s."""

    @property
    def correlation(self) -> Array:
        """Of the errors of all numbers, in their order."""
        deviations = np.sqrt(np.diagonal(self.covariance))
        return np.asarray(self.covariance / np.outer(deviations, deviations))

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame``: a row for each number, and for ``u_s``, ``u_d``, ``phase`` and ``angle`` of each wheel, columns
        ``value``, ``deviation``, ``low``, ``high``, ``unit``, ``told``."""
        import pandas as pd

        rows = [(of.name, of.estimate, of.unit, of.told) for of in self.numbers.values()]
        units = {"u_s": "kg m", "u_d": "kg m²", "phase": "rad", "angle": "rad"}
        for device, wheel in self.wheels.items():
            rows += [
                (f"{device}.{name}", getattr(wheel, name), unit, wheel.told)
                for name, unit in units.items()
            ]
        data = {
            "value": [estimate.value for _, estimate, _, _ in rows],
            "deviation": [estimate.deviation for _, estimate, _, _ in rows],
            "low": [estimate.low for _, estimate, _, _ in rows],
            "high": [estimate.high for _, estimate, _, _ in rows],
            "unit": [unit for _, _, unit, _ in rows],
            "told": [told for _, _, _, told in rows],
        }
        return pd.DataFrame(data, index=pd.Index([name for name, *_ in rows], name="number"))

    def to_toml(self) -> str:
        """The parts of a scenario, which takes them after its own file: ``base = ["bus.toml", "bus-identified.toml"]``."""
        return self._native.parts()

    def design(self, manoeuvres: Mapping[str, Scenario]) -> Design:
        """Which manoeuvres would tell what this record does not, and how much narrower they would make each interval.

        Parameters
        ----------
        manoeuvres : mapping of str to Scenario
            Scenarios of the same spacecraft, which are run, with names.

        Raises
        ------
        SignalError
            A manoeuvre of another spacecraft, or whose run fails.
        """
        given = [
            (text("the name of a manoeuvre", name), _scenario("a manoeuvre", of)._native)
            for name, of in table("manoeuvres", manoeuvres).items()
        ]
        durations, numbers, directions = self._native.design(given)
        shape = (-1, len(given))
        return Design(
            tuple(name for name, _ in given),
            np.array(durations, dtype=np.float64),
            tuple(name for name, *_ in numbers),
            tuple(unit for _, unit, *_ in numbers),
            np.array([alone for *_, alone, _ in numbers], dtype=np.float64),
            _rows([of for *_, of in numbers], shape),
            tuple(_direction(facts) for facts, _ in directions),
            _rows([of for _, of in directions], shape),
        )

    def __repr__(self) -> str:
        count = len(self.numbers)
        start, end = self.span
        state = "the model holds" if self.holds else "the model does not hold"
        return f"<precess.identification.Identification of {end - start:.6g} s: {count} numbers; {state}>"


def identify(
    scenario: Scenario | StrPath,
    data: StrPath | Mapping[str, npt.ArrayLike],
    unknown: StrPath | Mapping[str, Any],
    near: bool = False,
) -> Identification:
    """Finds the unknowns of a scenario in telemetry, by maximum likelihood.

    Parameters
    ----------
    scenario : Scenario or path
        The spacecraft, with the controller whose sensors the telemetry is of.
    data : path, mapping or pandas.DataFrame
        The file (CSV, NPZ), or columns by the names that a run has: ``time``, ``aocs.gyro_x``, ``rw1.spin``, ``rw1.u_w``; NaN where
        a sensor has no reading. The index of a frame is its time where that has the name of no column.
    unknown : path or mapping
        The file of what is unknown, or its tables: ``{"unknown": {"hub_moments": True}, "noise": {"tachometer": "0.05 rad/s"}}``.
    near : bool
        Whether the scenario is near the truth: the whole record is taken at once.

    Raises
    ------
    ScenarioError
        Where the file of unknowns cannot be read.
    SignalError
        Data that are no telemetry of this scenario, or that determine nothing.
    """
    if not isinstance(near, bool):
        raise TypeError(f"near is {near!r}; it needs True or False")
    read = scenario_of(scenario)
    path = file_of(data)
    columns = [] if path is not None else columns_of(data)
    if isinstance(unknown, str | os.PathLike):
        native = _native.identify(read._native, os.fspath(unknown), columns, path, near)
    else:
        with tempfile.TemporaryDirectory() as folder:
            written = Path(folder, "unknown.toml")
            tables = {"format": 1, **table("unknown", unknown)}
            written.write_text(toml_of(tables), encoding="utf-8")
            native = _native.identify(read._native, str(written), columns, path, near)
    return Identification(native)


def _scenario(name: str, value: Any) -> Scenario:
    return instance(name, value, Scenario, "a precess.Scenario")


def _direction(facts: tuple[Sequence[tuple[str, float, str]], float, bool]) -> Direction:
    changes, deviation, has_prior = facts
    return Direction({name: change for name, change, _ in changes}, deviation, has_prior)


def _rows(of: Sequence[Sequence[float]], shape: tuple[int, int]) -> Array:
    rows = np.array(of, dtype=np.float64)
    return rows.reshape(shape) if rows.size else rows.reshape(len(of), max(shape[1], 0))
