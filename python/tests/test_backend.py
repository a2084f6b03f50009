"""Batches with another backend: the same bits, and what is said where there is no GPU."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import precess
import pytest


def made(craft: precess.Scenario, parameters: dict[str, np.ndarray]) -> precess.Batch | None:
    """A batch with a GPU, or with a warning that there is none; none in a build without, which says so."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            batch = precess.Batch(craft, parameters, backend="cuda")
        except precess.UnsupportedError as error:
            assert "feature `cuda`" in str(error)
            return None
    for warning in said:
        assert warning.category is RuntimeWarning
        assert warning.filename == __file__
        text = str(warning.message)
        assert text.startswith("backend 'cuda': ") and "the processor computes" in text
    return batch


def test_another_backend_has_the_same_bits(wheels: str) -> None:
    scenario = precess.Scenario.from_text(wheels)
    masses = np.linspace(300.0, 400.0, 5)
    masses[3] = -1.0
    cpu = precess.Batch(scenario, {"hub.m_b": masses})
    gpu = made(scenario, {"hub.m_b": masses})
    if gpu is None:
        return
    y = cpu.states()
    np.testing.assert_array_equal(cpu.accelerations(y), gpu.accelerations(y))
    a = cpu.run(y, 1e-3, 20, every=5, history=True, reduce=["max", "rms"])
    b = gpu.run(y, 1e-3, 20, every=5, history=True, reduce=["max", "rms"])
    np.testing.assert_array_equal(a.final, b.final)
    np.testing.assert_array_equal(a.history, b.history)
    for name in ("max", "rms"):
        np.testing.assert_array_equal(a.reduced[name], b.reduced[name])
    assert sorted(a.errors) == sorted(b.errors) == [3]


def test_what_no_gpu_computes_is_an_error(scenarios: Path) -> None:
    scenario = precess.Scenario.from_toml(scenarios / "wheels-on-isolator.toml")
    with pytest.raises(precess.UnsupportedError, match="platforms|feature `cuda`"):
        precess.Batch(scenario, backend="cuda")


def test_another_name_is_an_error(wheels: str) -> None:
    with pytest.raises(ValueError, match="'cpu' or 'cuda'"):
        precess.Batch(precess.Scenario.from_text(wheels), backend="metal")
