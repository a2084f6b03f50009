"""Spectra of evenly sampled signals, as ``precess spectrum`` computes them.

Densities are one-sided, in unit²/Hz, and frequencies are in Hz. Without a length, segments are an eighth of the record, as
of the command line; without an overlap they share half of it with a Hann window, three quarters with a flat-top window and
nothing with a rectangular one. Windows are periodic, as those of ``scipy.signal``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from . import _native
from ._wanted import number, whole

__all__ = [
    "About",
    "AmplitudeSpectrum",
    "CrossSpectra",
    "Line",
    "Psd",
    "amplitude_spectrum",
    "coherence",
    "cross_spectra",
    "csd",
    "welch",
]

Array = npt.NDArray[np.float64]
Window = Literal["rectangular", "hann", "flat-top"]
Detrend = Literal["none", "mean", "linear"]

#: Share of a segment that the next one has too.
_OVERLAPS = {"rectangular": 0.0, "hann": 0.5, "flat-top": 0.75}
#: Segments of a record, before they overlap, and the fewest and most samples of one.
_SEGMENTS, _SHORTEST, _LONGEST = 8, 64, 1 << 20


@dataclass(frozen=True)
class About:
    """How a spectrum was computed.

    Attributes
    ----------
    segments : int
        How many there are.
    unused : int
        Samples at the end that are in none of them.
    resolution : float
        Distance of two frequencies, Hz.
    noise_bandwidth : float
        Mean square of a line by its peak density, Hz.
    averages : float
        Independent segments with the same variance of the estimate.
    """

    segments: int
    unused: int
    resolution: float
    noise_bandwidth: float
    averages: float


@dataclass(frozen=True)
class Line:
    """A line: frequency, Hz, and amplitude (not RMS) between bins; the bin of its peak, and that by the median beside it."""

    frequency: float
    amplitude: float
    bin: int
    above_floor: float


class Psd:
    """A one-sided power spectral density."""

    def __init__(self, native: _native.NativePsd) -> None:
        self._native = native
        self.density: Array = native.density
        """unit²/Hz, shape ``(bins,)``."""
        self.about = About(*native.about)
        self.frequency = _frequencies(self.about, len(self.density))
        """Hz, shape ``(bins,)``."""

    def band_rms(self, start: float, stop: float) -> float:
        """RMS of the bins in a band, Hz, both ends included."""
        return self._native.band_rms(start, stop)

    def cumulative_rms(self, backward: bool = False) -> Array:
        """RMS of all bins from zero to each one, or ``backward`` from each one on, shape ``(bins,)``."""
        return self._native.cumulative_rms(not backward)

    def interval(self, bin: int, level: float = 0.95) -> tuple[float, float]:
        """Ends of the interval that contains the density of a Gaussian signal at a bin with this probability, unit²/Hz."""
        if whole("bin", bin) >= len(self.density):
            raise IndexError(f"bin is {bin}; there are {len(self.density)}, from 0 on")
        low, high = self._native.interval(bin, number("level", level))
        return self.density[bin] * low, self.density[bin] * high

    def __repr__(self) -> str:
        return f"<precess.spectra.Psd: {_shown(self.about, len(self.density))}>"


class AmplitudeSpectrum:
    """Amplitudes over frequency: right at lines."""

    def __init__(self, native: _native.NativeAmplitudes) -> None:
        self._native = native
        self.amplitude: Array = native.amplitude
        """Amplitude of a steady line at each bin, unit, shape ``(bins,)``."""
        self.about = About(*native.about)
        self.frequency = _frequencies(self.about, len(self.amplitude))
        """Hz, shape ``(bins,)``."""

    def strongest(self, count: int = 8) -> list[Line]:
        """The strongest lines, the strongest first: peaks 12 dB above the median beside them that are no sidelobes."""
        return [Line(*facts) for facts in self._native.strongest(whole("count", count))]

    def __repr__(self) -> str:
        return f"<precess.spectra.AmplitudeSpectrum: {_shown(self.about, len(self.amplitude))}>"


@dataclass(frozen=True, eq=False)
class CrossSpectra:
    """One-sided cross-spectral densities of n signals.

    Attributes
    ----------
    about : About
        How they were computed.
    frequency : array, shape (bins,)
        Hz.
    density : complex array, shape (bins, n, n)
        Hermitian; a signal j that lags i has a negative phase at ``[:, i, j]``, as of ``scipy.signal.csd``.
    coherence : array, shape (bins, n, n), or None
        From 0 to 1; None of fewer than two averages, of which it says nothing.
    """

    about: About
    frequency: Array
    density: npt.NDArray[np.complex128]
    coherence: Array | None


def welch(
    x: npt.ArrayLike,
    rate: float,
    window: Window = "hann",
    length: int | None = None,
    overlap: int | None = None,
    detrend: Detrend = "mean",
) -> Psd:
    """Power spectral density of a signal by Welch's method.

    Parameters
    ----------
    x : array, shape (samples,)
        In any unit.
    rate : float
        Samples per second, 1/s.
    window : {"rectangular", "hann", "flat-top"}
        What a segment is multiplied by.
    length, overlap : int, optional
        Samples of a segment, and those that two neighbours share.
    detrend : {"none", "mean", "linear"}
        What is subtracted from each segment.

    Raises
    ------
    SignalError
        A rate, length or overlap that cannot be, a sample that is not finite.
    """
    samples = np.asarray(x, dtype=np.float64)
    settings = _settings(samples, window, length, overlap, detrend)
    return Psd(_native.spectrum_welch(samples, rate, settings))


def amplitude_spectrum(
    x: npt.ArrayLike,
    rate: float,
    window: Window = "flat-top",
    length: int | None = None,
    overlap: int | None = None,
    detrend: Detrend = "mean",
) -> AmplitudeSpectrum:
    """Amplitudes over frequency, right at lines. Parameters and errors are those of :func:`welch`."""
    samples = np.asarray(x, dtype=np.float64)
    settings = _settings(samples, window, length, overlap, detrend)
    return AmplitudeSpectrum(_native.spectrum_amplitudes(samples, rate, settings))


def cross_spectra(
    signals: npt.ArrayLike,
    rate: float,
    window: Window = "hann",
    length: int | None = None,
    overlap: int | None = None,
    detrend: Detrend = "mean",
) -> CrossSpectra:
    """Cross-spectral densities of signals, shape ``(n, samples)``. Parameters and errors are those of :func:`welch`."""
    samples = np.atleast_2d(np.asarray(signals, dtype=np.float64))
    settings = _settings(samples, window, length, overlap, detrend)
    about, density, coherent = _native.spectrum_cross(samples, rate, settings)
    facts = About(*about)
    return CrossSpectra(facts, _frequencies(facts, len(density)), density, coherent)


def csd(
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    rate: float,
    window: Window = "hann",
    length: int | None = None,
    overlap: int | None = None,
    detrend: Detrend = "mean",
) -> tuple[Array, npt.NDArray[np.complex128]]:
    """Frequencies and cross-spectral density of two signals. Parameters and errors are those of :func:`welch`."""
    found = cross_spectra([np.asarray(x), np.asarray(y)], rate, window, length, overlap, detrend)
    return found.frequency, found.density[:, 0, 1]


def coherence(
    x: npt.ArrayLike,
    y: npt.ArrayLike,
    rate: float,
    window: Window = "hann",
    length: int | None = None,
    overlap: int | None = None,
    detrend: Detrend = "mean",
) -> tuple[Array, Array]:
    """Frequencies and coherence of two signals, 0 to 1. Parameters are those of :func:`welch`.

    Raises
    ------
    SignalError
        As of :func:`welch`, and fewer averages than two.
    """
    found = cross_spectra([np.asarray(x), np.asarray(y)], rate, window, length, overlap, detrend)
    if found.coherence is None:
        from .errors import SignalError

        raise SignalError(
            f"{found.about.averages:.3f} averages are below 2; choose shorter segments, or record a longer run"
        )
    return found.frequency, found.coherence[:, 0, 1]


def _settings(
    of: Array, window: Window, length: int | None, overlap: int | None, detrend: Detrend
) -> tuple[str, int, int, str]:
    if of.ndim == 0:
        raise ValueError("a signal is one number; it needs an array of samples")
    samples = of.shape[-1]
    length = None if length is None else whole("length", length)
    overlap = None if overlap is None else whole("overlap", overlap)
    if length is None:
        shortest = min(_SHORTEST, samples)
        length = min(max(samples // _SEGMENTS, shortest), max(_LONGEST, shortest))
    if overlap is None:
        # What is no window is an error of the native module, with the windows that there are.
        share = _OVERLAPS.get(window, 0.0) if isinstance(window, str) else 0.0
        overlap = round(share * length)
    return window, length, overlap, detrend


def _frequencies(about: About, bins: int) -> Array:
    return np.arange(bins, dtype=np.float64) * about.resolution


def _shown(about: About, bins: int) -> str:
    return f"{bins} bins of {about.resolution:g} Hz, {about.segments} segments"
