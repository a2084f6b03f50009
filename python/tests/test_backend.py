"""Batches with another backend: the same bits, and what is said where there is no GPU."""

from __future__ import annotations

import numpy as np
import precess
import pytest


def made(craft: object, **more: object) -> precess.Batch | None:
    """A batch with a GPU; none in a build without one, which says so."""
    with pytest.warns() as said:
        try:
            batch = precess.Batch(craft, backend="cuda", **more)  # type: ignore[arg-type]
        except precess.UnsupportedError as error:
            assert "feature `cuda`" in str(error)
            said.list.clear()
            return None
        finally:
            # Of a machine with a GPU and of a build without, nothing is said.
            precess_said = [str(of.message) for of in said.list]
            import warnings

            warnings.warn("none", UserWarning, stacklevel=1)
    assert all("backend 'cuda': " in text and "the processor computes" in text for text in precess_said)
    return batch


def test_another_backend_has_the_same_bits(wheels: str) -> None:
    scenario = precess.Scenario.from_text(wheels)
    masses = np.linspace(300.0, 400.0, 5)
    masses[3] = -1.0
    cpu = precess.Batch(scenario, {"hub.m_b": masses})
    gpu = made(scenario, parameters={"hub.m_b": masses})
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


def test_what_no_gpu_computes_is_an_error(scenarios: object) -> None:
    scenario = precess.Scenario.from_file(f"{scenarios}/wheels-on-isolator.toml")
    with pytest.raises(precess.UnsupportedError, match="platforms|feature `cuda`"):
        precess.Batch(scenario, backend="cuda")


def test_another_name_is_an_error(wheels: str) -> None:
    with pytest.raises(ValueError, match="'cpu' or 'cuda'"):
        precess.Batch(precess.Scenario.from_text(wheels), backend="metal")
