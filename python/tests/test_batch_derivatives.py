"""Derivatives of batches: matrices that are kept, products with directions and weights, spacecraft that differ."""

from __future__ import annotations

import numpy as np
import pytest

import precess

#: Products sum in another order than matrices.
ROUNDING = 1e-12


@pytest.fixture
def craft(wheels: str) -> precess.Spacecraft:
    return precess.Scenario.from_text(wheels).spacecraft


def states(craft: precess.Spacecraft, n: int) -> np.ndarray:
    """Some near the initial one; a quaternion is normalised where it is used."""
    random = np.random.default_rng(7)
    return craft.initial_state().to_array() + 1e-2 * random.normal(size=(n, craft.state_size))


def test_matrices_are_written_into_arrays_that_are_kept(craft: precess.Spacecraft) -> None:
    batch = precess.Batch(craft)
    first, second = states(craft, 6)[:3], states(craft, 6)[3:]
    kept, fresh = batch.linearize(first), batch.linearize(second)
    found = batch.linearize(second, out=(kept.C, kept.D))
    assert found.C is kept.C
    assert found.D is kept.D
    np.testing.assert_array_equal(found.C, fresh.C)
    np.testing.assert_array_equal(found.D, fresh.D)
    for index, y in enumerate(second):
        one = craft.linearize(precess.State.from_array(craft, y))
        rows = [one.outputs.index(name) for name in found.outputs]
        np.testing.assert_array_equal(found.C[index], one.C[rows])
        np.testing.assert_array_equal(found.D[index], one.D[rows])


def test_arrays_that_cannot_be_written_are_errors(craft: precess.Spacecraft) -> None:
    batch, y = precess.Batch(craft), states(craft, 3)
    kept = batch.linearize(y)
    with pytest.raises(ValueError, match=r"out\[0\] has the shape"):
        batch.linearize(y[:2], out=(kept.C, kept.D))
    with pytest.raises(ValueError, match=r"out\[1\] cannot be written"):
        batch.linearize(y, out=(kept.C, np.lib.stride_tricks.as_strided(kept.D, writeable=False)))
    with pytest.raises(ValueError, match="C order"):
        batch.linearize(y, out=(np.asfortranarray(kept.C), kept.D))
    with pytest.raises(TypeError, match="tuple of two arrays"):
        batch.linearize(y, out=kept.C)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="float64"):
        batch.linearize(y, out=(kept.C.astype(np.float32), kept.D))  # type: ignore[arg-type]


def test_products_are_those_with_the_matrices(craft: precess.Spacecraft) -> None:
    batch, y = precess.Batch(craft), states(craft, 5)
    found = batch.linearize(y)
    random = np.random.default_rng(11)
    dx = random.normal(size=(5, len(found.states)))
    du = random.normal(size=(5, len(found.inputs)))
    w = random.normal(size=(5, len(found.outputs)))
    by_state = np.einsum("nas,ns->na", found.C, dx)
    by_input = np.einsum("nai,ni->na", found.D, du)
    both = by_state + by_input
    for product, expected in (
        (batch.jvp(y, dx, du), both),
        (batch.jvp(y, dx), by_state),
        (batch.jvp(y, du=du, threads=2), by_input),
        (batch.vjp(y, w)[0], np.einsum("nas,na->ns", found.C, w)),
        (batch.vjp(y, w)[1], np.einsum("nai,na->ni", found.D, w)),
    ):
        np.testing.assert_allclose(product, expected, rtol=0.0, atol=ROUNDING * np.abs(expected).max())
    np.testing.assert_array_equal(batch.jvp(y), np.zeros_like(both))
    with pytest.raises(ValueError, match="dx has the shape"):
        batch.jvp(y, dx[:, 1:])
    with pytest.raises(ValueError, match="a row for each state"):
        batch.vjp(y, w[0])


def test_a_state_without_derivatives_has_nan(craft: precess.Spacecraft) -> None:
    batch, y = precess.Batch(craft), states(craft, 3)
    kept = batch.linearize(y)
    y[1] = np.nan
    weights = np.ones((3, len(kept.outputs)))
    found = batch.linearize(y, out=(kept.C, kept.D))
    assert list(batch.errors) == [1]
    along, gradient = batch.jvp(y), batch.vjp(y, weights)
    for of in (found.C, found.D, along, *gradient):
        assert np.isnan(of[1]).all()
        assert np.isfinite(of[[0, 2]]).all()


def test_spacecraft_that_differ_have_derivatives_with_their_own_parameters(wheels: str) -> None:
    scenario = precess.Scenario.from_text(wheels)
    masses = np.array([300.0, 350.0, 420.0])
    batch = precess.Batch(scenario, {"hub.m_b": masses})
    y = batch.states()
    found = batch.linearize(y)
    weights = np.ones((3, len(found.outputs)))
    gradient = batch.vjp(y, weights)[0]
    for index in range(len(masses)):
        one = precess.Batch(scenario, {"hub.m_b": masses[index : index + 1]}).linearize(y[:1])
        np.testing.assert_array_equal(found.C[index], one.C[0])
        expected = found.C[index].sum(axis=0)
        size = np.abs(expected).max()
        np.testing.assert_allclose(gradient[index], expected, rtol=0.0, atol=ROUNDING * size)
    # A heavier hub is accelerated less by a force.
    by_force = found.D[:, found.outputs.index("acceleration_b_x"), found.inputs.index("force_x")]
    assert (np.diff(by_force) < 0.0).all()
    rejected = precess.Batch(scenario, {"hub.m_b": [300.0, -1.0]})
    of_bad = rejected.linearize(rejected.states())
    assert list(rejected.errors) == [1]
    assert np.isnan(of_bad.C[1]).all()
