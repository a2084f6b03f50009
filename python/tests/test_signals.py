"""Spectra and pointing metrics, judged by SciPy and by NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import precess
from precess import pointing, spectra

signal = pytest.importorskip("scipy.signal")

RATE = 1000.0
#: Transforms of a few thousand samples, rounded.
ROUNDING = 1e-12


def record(components: int = 2, samples: int = 5000) -> np.ndarray:
    """Lines in noise, and a lag between the first two."""
    rng = np.random.default_rng(3)
    noise = rng.standard_normal((components, samples + 5))
    time = np.arange(samples + 5) / RATE
    line = 0.7 * np.sin(2 * np.pi * 123.4 * time)
    shared = noise[0] + line
    rows = [shared[5:], 2.0 * shared[:-5] + 0.3 * noise[-1, 5:], *noise[2:, 5:]]
    return np.array(rows[:components])


@pytest.mark.parametrize(
    ("window", "of_scipy"), [("hann", "hann"), ("rectangular", "boxcar"), ("flat-top", "flattop")]
)
@pytest.mark.parametrize(
    ("detrend", "trend"), [("none", False), ("mean", "constant"), ("linear", "linear")]
)
def test_densities_are_those_of_scipy(window: Any, of_scipy: str, detrend: Any, trend: Any) -> None:
    x, y = record()
    settings = dict(window=of_scipy, nperseg=500, noverlap=200, detrend=trend)
    given = dict(window=window, length=500, overlap=200, detrend=detrend)
    frequency, expected = signal.welch(x, RATE, **settings)
    found = spectra.welch(x, RATE, **given)
    np.testing.assert_allclose(found.frequency, frequency, rtol=ROUNDING)
    scale = expected.max()
    np.testing.assert_allclose(found.density, expected, rtol=1e-9, atol=ROUNDING * scale)
    _, cross = signal.csd(x, y, RATE, **settings)
    np.testing.assert_allclose(
        spectra.csd(x, y, RATE, **given)[1], cross, rtol=1e-8, atol=ROUNDING * np.abs(cross).max()
    )
    _, coherent = signal.coherence(x, y, RATE, **settings)
    inner = slice(3, -3)
    np.testing.assert_allclose(
        spectra.coherence(x, y, RATE, **given)[1][inner], coherent[inner], rtol=1e-6
    )


def test_amplitudes_are_those_of_scipy_and_of_the_line() -> None:
    x = record()[0]
    _, square = signal.welch(x, RATE, window="flattop", nperseg=1000, noverlap=750, scaling="spectrum")
    found = spectra.amplitude_spectrum(x, RATE, length=1000, overlap=750)
    np.testing.assert_allclose(found.amplitude[1:-1], np.sqrt(2 * square[1:-1]), rtol=1e-9)
    line = found.strongest(1)[0]
    assert abs(line.frequency - 123.4) < 0.2 and abs(line.amplitude - 0.7) < 0.1


def test_rms_over_frequency_adds_up() -> None:
    found = spectra.welch(record()[0], RATE)
    whole = np.sqrt(found.density.sum() * found.about.resolution)
    np.testing.assert_allclose(found.cumulative_rms()[-1], whole, rtol=ROUNDING)
    np.testing.assert_allclose(found.cumulative_rms(backward=True)[0], whole, rtol=ROUNDING)
    np.testing.assert_allclose(found.band_rms(0.0, RATE / 2), whole, rtol=ROUNDING)
    parts = np.hypot(found.band_rms(0.0, 0.123 * RATE), found.band_rms(0.123 * RATE, RATE / 2))
    np.testing.assert_allclose(parts, whole, rtol=ROUNDING)
    low, high = found.interval(10)
    assert low < found.density[10] < high


def test_signals_without_a_spectrum_are_rejected() -> None:
    with pytest.raises(precess.SignalError, match="not within 4 and"):
        spectra.welch(np.zeros(100), RATE, length=2)
    with pytest.raises(precess.SignalError, match="sample 7 of signal 0 is NaN"):
        spectra.welch(np.where(np.arange(100) == 7, np.nan, 0.0), RATE)
    with pytest.raises(precess.SignalError, match="below 2"):
        spectra.coherence(np.arange(64.0), np.arange(64.0) ** 2, RATE, length=64)
    with pytest.raises(ValueError, match="rectangular, hann or flat-top"):
        spectra.welch(np.zeros(100), RATE, window="hamming")  # type: ignore[arg-type]


def test_exposures_are_means_lines_and_rests() -> None:
    signals, window = record(), 50
    parts = signals.reshape(2, -1, window)
    at = np.arange(window) - (window - 1) / 2
    means = parts.mean(axis=2)
    slopes = (parts * at).sum(axis=2) / (at**2).sum()
    lines = slopes[..., None] * at
    rest = parts - means[..., None] - lines
    squares = [(means**2).sum(axis=0), (lines**2).mean(axis=2).sum(axis=0), (rest**2).mean(axis=2).sum(axis=0)]
    found = pointing.exposure(signals, RATE, window / RATE)
    for name, square in zip(("displacement", "smear", "jitter"), squares, strict=True):
        np.testing.assert_allclose(getattr(found.rms, name), np.sqrt(square.mean()), rtol=1e-10)
        np.testing.assert_allclose(getattr(found.worst, name), np.sqrt(square.max()), rtol=1e-10)
    assert (found.count, found.samples) == (100, 50)
    np.testing.assert_allclose(found.rms.total, np.sqrt((signals**2).sum(axis=0).mean()), rtol=1e-10)


def test_lines_have_the_shares_of_a_long_history() -> None:
    frequency, time = 7.3, 0.1
    history = 2.0 * np.sin(2 * np.pi * frequency * np.arange(200_000) / RATE)
    found = pointing.exposure(history, RATE, time).rms
    line = pointing.exposure_of_lines(frequency, 2.0, time)
    shares = pointing.weights([frequency], time)
    for name, share in zip(("displacement", "smear", "jitter"), shares, strict=True):
        np.testing.assert_allclose(getattr(line, name), np.sqrt(2.0 * share[0]), rtol=1e-12)
        # Sums over 100 samples stand for integrals.
        np.testing.assert_allclose(getattr(found, name), getattr(line, name), rtol=5e-3)


def test_a_density_and_its_table_have_the_exposure_of_the_history() -> None:
    noise = np.random.default_rng(5).standard_normal(200_000)
    psd = spectra.welch(noise, RATE, length=4000, detrend="none")
    of_history = pointing.exposure(noise, RATE, 0.1).rms
    of_psd = pointing.exposure_of_psd(psd, 0.1)
    of_table = pointing.exposure_of_table([0.0, 500.0], [2 / RATE, 2 / RATE], 0.1)
    for name in ("displacement", "smear", "jitter"):
        np.testing.assert_allclose(getattr(of_psd, name), getattr(of_history, name), rtol=0.05)
        np.testing.assert_allclose(getattr(of_table, name), getattr(of_history, name), rtol=0.05)


def test_indices_are_quantiles_of_their_definitions() -> None:
    x = record()[0]
    means = x.reshape(-1, 100).mean(axis=1)
    departures = (x.reshape(-1, 100) - means[:, None]).ravel()
    drifts = means[3:] - means[:-3]
    largest = 1.0 - 1e-9

    def value(name: Any, **settings: Any) -> float:
        return pointing.index(name, x, RATE, level=largest, **settings).value

    np.testing.assert_allclose(value("APE"), np.abs(x).max(), rtol=1e-12)
    np.testing.assert_allclose(value("MPE", window=0.1), np.abs(means).max(), rtol=1e-10)
    np.testing.assert_allclose(value("RPE", window=0.1), np.abs(departures).max(), rtol=1e-10)
    found = value("PDE", window=0.1, stability=0.3)
    np.testing.assert_allclose(found, np.abs(drifts).max(), rtol=1e-10)
    runs = [x[:1000], x[1000:2000]]
    repeated = pointing.index("PRE", runs, RATE, window=0.1, level=largest)
    pairs = np.abs(means[:10] - means[10:20]).max()
    np.testing.assert_allclose(repeated.value, pairs, rtol=1e-10)
    worst = pointing.index("APE", [x[k : k + 500] for k in range(0, 5000, 500)], RATE, level=0.5, interpretation="ensemble")
    assert worst.runs == 10 and worst.confidence is not None
    gauss = pointing.index_of_psd("APE", spectra.welch(x, RATE, detrend="none"), level=0.6827)
    np.testing.assert_allclose(gauss.value, x.std(), rtol=0.05)
    with pytest.raises(ValueError, match="PDE has one and a stability time"):
        pointing.index("PDE", x, RATE, window=0.1)
