"""Disturbance models of wheels, fitted to forces and moments on a rigid table, as ``precess fit`` fits them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from . import _native
from ._wanted import instance, items, number, text

__all__ = [
    "Band",
    "Coefficient",
    "Estimate",
    "Fit",
    "Harmonic",
    "Imbalance",
    "Mode",
    "Record",
    "fit",
    "fit_records",
]


@dataclass(frozen=True)
class Estimate:
    """A fitted number, SI: its value, standard deviation, and the ends of its 95 % interval."""

    value: float
    deviation: float
    low: float
    high: float


@dataclass(frozen=True)
class Imbalance:
    """``u_s``, kg m; ``u_d``, kg m²; the phase by which the torque of ``u_d`` leads the force of ``u_s``, rad, and the angle of
    that force at the index, rad. None of what noise hides, or without an index."""

    u_s: Estimate
    u_d: Estimate
    phase: Estimate | None
    angle: Estimate | None


@dataclass(frozen=True)
class Coefficient:
    """A coefficient of a harmonic: force or moment by the square of the speed, kg m or kg m², without modes.

    ``group`` is ``axial force``, ``radial force``, ``axial torque`` or ``radial torque``, ``sense`` is ``forward`` or
    ``backward``; ``seen`` says whether it is above the noise.
    """

    group: str
    sense: str
    c: Estimate
    phase: Estimate | None
    seen: bool


@dataclass(frozen=True)
class Harmonic:
    """A harmonic: its number, and its coefficients."""

    number: Estimate
    coefficients: tuple[Coefficient, ...]


@dataclass(frozen=True)
class Mode:
    """An internal mode of a group: frequency, rad/s, damping ratio, ratio of the wheel's inertias, share."""

    group: str
    frequency: Estimate
    damping: Estimate
    inertia_ratio: Estimate
    share: Estimate


@dataclass(frozen=True)
class Band:
    """Broadband noise of a group between two frequencies, Hz: density of each axis, N²/Hz or N² m²/Hz."""

    group: str
    start: float
    stop: float
    density: Estimate


@dataclass(frozen=True, eq=False)
class Record:
    """A measurement at one steady speed, in the wheel's axes about its centre.

    Attributes
    ----------
    samples : array, shape (samples, 6)
        Force along x, y, z, N, and moment about x, y, z, N m, x along the spin axis.
    rate : float
        Samples per second, 1/s.
    speed : float
        Speed about +x at the middle of the record, rad/s.
    drift : float
        Rate of change of the speed, rad/s²; 0 where it is unknown.
    pulses : sequence of float
        Times at which the wheel's y axis passes the reference direction, s from the first sample; empty without an index.
    name : str
        In messages.
    """

    samples: npt.ArrayLike
    rate: float
    speed: float
    drift: float = 0.0
    pulses: Sequence[float] = field(default=())
    name: str = "record"


class Fit:
    """A fitted disturbance model."""

    def __init__(self, native: _native.NativeFit) -> None:
        self._native = native
        u_s, u_d, phase, angle = native.imbalance
        self.imbalance = Imbalance(Estimate(*u_s), Estimate(*u_d), _estimate(phase), _estimate(angle))
        """The first harmonic."""
        self.harmonics = tuple(
            Harmonic(
                Estimate(*number),
                tuple(
                    Coefficient(group, sense, Estimate(*c), _estimate(phase), seen)
                    for group, sense, c, phase, seen in coefficients
                ),
            )
            for number, coefficients in native.harmonics
        )
        """All harmonics, the first among them."""
        self.modes = tuple(
            Mode(group, *(Estimate(*of) for of in numbers)) for group, *numbers in native.modes
        )
        """Internal modes."""
        self.noise = tuple(
            Band(group, start, stop, Estimate(*density))
            for group, bands in native.floors
            for start, stop, density in bands
        )
        """Broadband noise."""
        self.residuals = {group: (square, freedom) for group, square, freedom in native.residuals}
        """Mean square of the residuals by their variance, and degrees of freedom, by group."""
        self.discrepancies = tuple(text for text, _ in native.discrepancies)
        """What the model does not explain, in sentences."""
        self.holds = not any(fails for _, fails in native.discrepancies)
        """Whether the model explains what was measured; else its numbers are not those of the wheel."""

    def to_toml(
        self, name: str | None = None, rotor: tuple[float, float, float] | None = None
    ) -> tuple[str, str]:
        """The model as parts of a scenario: the texts of a device file and of a file of sources.

        Parameters
        ----------
        name : str, optional
            The device; that of the measurement by default.
        rotor : (float, float, float), optional
            Mass, kg, and moments of inertia about the spin axis and across it, kg m²; those of the measurement by default.
        """
        return self._native.parts(name or self._native.name, rotor)

    def __repr__(self) -> str:
        numbers = ", ".join(f"{harmonic.number.value:.4g}" for harmonic in self.harmonics)
        return f"<precess.fit.Fit of {self._native.name!r}: harmonics {numbers}; {len(self.modes)} modes>"


def fit(path: str | os.PathLike[str]) -> Fit:
    """Fits what a measurement file describes.

    Raises
    ------
    ScenarioError
        Where the file, or what it names, cannot be read.
    SignalError
        Records that cannot be used, or that determine no model.
    """
    return Fit(_native.fit_file(os.fspath(path)))


def fit_records(
    records: Sequence[Record],
    harmonics: Sequence[float] = (),
    highest: float | None = None,
    interference: Sequence[float] = (),
    speed_accuracy: float | None = None,
    name: str = "wheel",
) -> Fit:
    """Fits records in memory.

    Parameters
    ----------
    records : sequence of Record
        Three at least, each at another speed.
    harmonics : sequence of float
        Harmonic numbers; found where there are none.
    highest : float, optional
        The highest number that is looked for.
    interference : sequence of float
        Frequencies of lines that follow no speed, Hz.
    speed_accuracy : float, optional
        What the speeds are known to, as a share; 0 where they are exact.
    name : str
        The wheel, in :meth:`Fit.to_toml`.

    Raises
    ------
    SignalError
        Records that cannot be used, or that determine no model.
    """
    facts = [
        (
            instance("a record", record, Record, "a precess.fit.Record").name,
            record.rate,
            record.speed,
            record.drift,
            [float(of) for of in record.pulses],
            _samples(record),
        )
        for record in items("records", records, "a list of precess.fit.Record")
    ]
    numbers = "a list of numbers"
    native = _native.fit_records(
        text("name", name),
        facts,
        [number("a harmonic", of) for of in items("harmonics", harmonics, numbers)],
        [number("an interference", of) for of in items("interference", interference, numbers)],
        None if highest is None else number("highest", highest),
        None if speed_accuracy is None else number("speed_accuracy", speed_accuracy),
    )
    return Fit(native)


def _samples(record: Record) -> npt.NDArray[np.float64]:
    samples = np.asarray(record.samples, dtype=np.float64)
    if samples.ndim != 2:
        raise ValueError(
            f"samples of {record.name!r} have the shape {samples.shape}; they need (samples, 6): force and moment"
        )
    return samples


def _estimate(facts: tuple[float, float, float, float] | None) -> Estimate | None:
    return None if facts is None else Estimate(*facts)
