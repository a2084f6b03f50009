"""Pointing metrics of signals: displacement, smear and jitter of exposures, and the indices of ECSS.

A signal is in any unit, usually rad, and has one component or several: shape ``(samples,)`` or ``(components, samples)``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _native
from ._wanted import instance, items, number
from .spectra import Psd

__all__ = [
    "Exposure",
    "ExposureHistory",
    "Index",
    "exposure",
    "exposure_of_lines",
    "exposure_of_psd",
    "exposure_of_table",
    "index",
    "index_of_psd",
    "weights",
]

Array = npt.NDArray[np.float64]
Name = Literal["APE", "MPE", "RPE", "PDE", "PRE"]
Interpretation = Literal["temporal", "ensemble", "mixed"]


@dataclass(frozen=True)
class Exposure:
    """Displacement, smear and jitter, each the root of a mean square over exposures, in the unit of the signal.

    Attributes
    ----------
    displacement : float
        RMS of the mean over an exposure.
    smear : float
        RMS of the straight line through the motion, its mean left out.
    jitter : float
        RMS of the rest.
    """

    displacement: float
    smear: float
    jitter: float

    @property
    def smear_length(self) -> float:
        """RMS of the smear's length from start to end of an exposure."""
        return float(np.sqrt(12.0)) * self.smear

    @property
    def total(self) -> float:
        """RMS of the whole motion."""
        return float(np.hypot(np.hypot(self.displacement, self.smear), self.jitter))


@dataclass(frozen=True)
class ExposureHistory:
    """Exposures of a history: over all of them, the largest of each in a single one, how many, and samples of each."""

    rms: Exposure
    worst: Exposure
    count: int
    samples: int


@dataclass(frozen=True)
class Index:
    """An index of the pointing error, with how it is to be read.

    Attributes
    ----------
    name : str
        ``APE``, ``MPE``, ``RPE``, ``PDE`` or ``PRE``.
    value : float
        What the index does not exceed with the level, in the unit of the signal.
    interpretation : str
        What the level is of.
    level : float
        Probability.
    confidence : float or None
        Probability that the level is reached, by the number of runs: of the ensemble interpretation only.
    runs, values : int
        Runs, and values of all of them; zero of a density.
    """

    name: str
    value: float
    interpretation: str
    level: float
    confidence: float | None
    runs: int
    values: int


def exposure(signal: npt.ArrayLike, rate: float, time: float) -> ExposureHistory:
    """Exposures of a history at a rate, 1/s, one after the other, each of ``time``, s.

    Raises
    ------
    SignalError
        An exposure that is not a whole number of samples, three at least, or longer than the history; a sample that is not
        finite.
    """
    rate, time = number("rate", rate), number("time", time)
    found = _native.pointing_of_history(_components(signal), rate, time)
    rms, worst, count, samples = found
    return ExposureHistory(Exposure(*rms), Exposure(*worst), count, samples)


def exposure_of_psd(psd: Psd, time: float) -> Exposure:
    """Exposures of a stationary signal with this density. What detrending has removed is missing from the displacement."""
    psd = instance("psd", psd, Psd, "a precess.spectra.Psd")
    return Exposure(*_native.pointing_of_psd(psd._native, number("time", time)))


def exposure_of_table(frequency: npt.ArrayLike, density: npt.ArrayLike, time: float) -> Exposure:
    """Exposures of a density, unit²/Hz, that is linear between rising frequencies, Hz, and zero beyond them."""
    return Exposure(*_native.pointing_of_table(_pairs(frequency, density), time))


def exposure_of_lines(frequency: npt.ArrayLike, amplitude: npt.ArrayLike, time: float) -> Exposure:
    """Exposures of lines with random phases, by frequencies, Hz, and amplitudes."""
    return Exposure(*_native.pointing_of_lines(_pairs(frequency, amplitude), time))


def weights(frequency: npt.ArrayLike, time: float) -> tuple[Array, Array, Array]:
    """Shares of the variance of a line in displacement, smear and jitter of an exposure, at each frequency, Hz."""
    frequencies = np.asarray(frequency, dtype=np.float64)
    rows = [_native.pointing_weights(float(of), time) for of in frequencies.ravel()]
    shares = np.array(rows, dtype=np.float64).reshape(-1, 3)
    displacement, smear, jitter = (shares[:, k].reshape(frequencies.shape) for k in range(3))
    return displacement, smear, jitter


def index(
    name: Name,
    runs: Array | Sequence[npt.ArrayLike],
    rate: float,
    window: float | None = None,
    stability: float | None = None,
    level: float = 0.9973,
    interpretation: Interpretation = "mixed",
    confidence: float | None = None,
) -> Index:
    """An index of runs.

    Parameters
    ----------
    name : {"APE", "MPE", "RPE", "PDE", "PRE"}
        Absolute, mean, relative, drift or reproducibility error.
    runs : array, or sequence of arrays
        The signal of a single run, an array, or that of each run.
    rate : float
        Samples per second, 1/s.
    window : float
        Length of a window, s; the APE has none.
    stability : float
        From one window to the other of the PDE, s.
    level : float
        The probability that the value is not exceeded.
    interpretation : {"temporal", "ensemble", "mixed"}
        Of the times of the worst run, of the worst times of all runs, or of all times of all runs.
    confidence : float, optional
        Of the ensemble interpretation: the probability that the level is reached.

    Raises
    ------
    SignalError
        Windows, levels or runs that have no such index.
    """
    wanted = "an array, or a list of arrays"
    each = [runs] if isinstance(runs, np.ndarray) else items("runs", runs, wanted)
    arrays = [_components(run) for run in each]
    facts = (name, window, stability)
    found = _native.pointing_index(facts, arrays, rate, interpretation, level, confidence)
    value, reached, count, values = found
    return Index(name, value, interpretation, level, reached, count, values)


def index_of_psd(
    name: Name,
    psd: Psd,
    window: float | None = None,
    stability: float | None = None,
    level: float = 0.9973,
) -> Index:
    """An index of a stationary Gaussian error of one axis with zero mean and this density, over time and runs."""
    psd = instance("psd", psd, Psd, "a precess.spectra.Psd")
    found = _native.pointing_index_of_psd((name, window, stability), psd._native, level)
    value, reached, count, values = found
    return Index(name, value, "mixed", level, reached, count, values)


def _components(signal: npt.ArrayLike) -> Array:
    return np.atleast_2d(np.asarray(signal, dtype=np.float64))


def _pairs(x: npt.ArrayLike, y: npt.ArrayLike) -> list[tuple[float, float]]:
    columns = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
    return [(float(a), float(b)) for a, b in zip(columns[0].ravel(), columns[1].ravel(), strict=True)]
