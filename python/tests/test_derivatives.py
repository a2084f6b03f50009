"""Accelerations as functions of JAX and CasADi: exact derivatives, one call of the library for a batch."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import precess
from precess._derivatives import Derivatives

#: Of central differences with steps of 1e-5 of numbers of size one.
DIFFERENCES = 1e-6


@pytest.fixture
def craft(wheels: str) -> precess.Spacecraft:
    return precess.Scenario.from_text(wheels).spacecraft


def state_and_inputs(craft: precess.Spacecraft, count: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """States off the initial one, quaternions of any length, and inputs."""
    rng = np.random.default_rng(2)
    y = np.tile(craft.initial_state().to_array(), (count, 1))
    y[:, :13] += 0.2 * rng.standard_normal((count, 13))
    y[:, 13:] *= 0.01
    return y, rng.standard_normal((count, 6 + len(craft.joints)))


def in_a_field(craft: precess.Spacecraft) -> precess.Inputs:
    """Inputs with gravity: accelerations depend on the attitude."""
    inputs = craft.inputs()
    inputs.gravity = [0.3, -0.2, 9.8]
    return inputs


def test_jacobians_are_those_of_differences(craft: precess.Spacecraft) -> None:
    of = Derivatives(craft, in_a_field(craft))
    (y,), (u,) = state_and_inputs(craft)
    exact = of.jacobians(y, u)
    for place, (x, jacobian) in enumerate(zip((y, u), exact, strict=True)):
        for column in range(len(x)):
            step = np.zeros_like(x)
            step[column] = 1e-5

            def at(offset: np.ndarray) -> np.ndarray:
                return of.values(y + offset, u) if place == 0 else of.values(y, u + offset)

            slope = (at(step) - at(-step)) / 2e-5
            np.testing.assert_allclose(slope, jacobian[:, column], atol=DIFFERENCES)
    assert np.abs(exact[0][:3, 6:10]).max() > 0.1
    # Longer by any factor, a quaternion is the same attitude.
    np.testing.assert_allclose(exact[0][:, 6:10] @ y[6:10], 0.0, atol=1e-13)


def test_modes_and_failures(craft: precess.Spacecraft) -> None:
    inputs = craft.inputs()
    inputs.modes["wheel1.theta"] = 2.0
    inputs.modes["wheel2.theta"] = "locked"
    of = Derivatives(craft, inputs)
    y, u = state_and_inputs(craft, 3)
    y[1, 0] = np.nan
    y[:, craft.state_names.index("wheel2.spin")] = 0.0
    values = of.values(y, u)
    by_y, by_u = of.jacobians(y, u)
    assert np.isnan(values[1]).all() and np.isnan(by_y[1]).all() and np.isnan(by_u[1]).all()
    place = craft.acceleration_names.index("wheel1.spin_dot")
    np.testing.assert_array_equal(values[[0, 2], place], u[[0, 2], 6])
    np.testing.assert_allclose(by_u[0, place], np.eye(8)[6], atol=1e-15)
    np.testing.assert_array_equal(by_u[0, :, 7], 0.0)


def test_jax_has_exact_derivatives_and_one_call_for_a_batch(craft: precess.Spacecraft) -> None:
    jax = pytest.importorskip("jax")
    from jax.test_util import check_grads

    jax.config.update("jax_enable_x64", True)
    from precess.jax import accelerations, derivative

    of = Derivatives(craft, in_a_field(craft))
    function: Any = accelerations(craft, of=of)
    y, u = state_and_inputs(craft, 5)
    single = in_a_field(craft)
    single.force, single.torque = u[0, :3], u[0, 3:6]
    single.motors["wheel1.u_w"], single.motors["wheel2.u_w"] = u[0, 6:]
    expected = np.asarray(craft.accelerations(y[0], single))
    np.testing.assert_array_equal(jax.jit(function)(y[0], u[0]), expected)
    # JAX's own check: forward and reverse against differences.
    check_grads(function, (y[0], u[0]), order=1, modes=["fwd", "rev"], atol=1e-5, rtol=1e-5)
    slopes: Any = derivative(craft, of=of)
    check_grads(slopes, (y[0], u[0]), order=1, modes=["fwd", "rev"], atol=1e-5, rtol=1e-5)
    unit = y[0].copy()
    unit[6:10] /= np.linalg.norm(unit[6:10])
    np.testing.assert_allclose(
        slopes(unit, u[0]), craft.derivative(0.0, unit, single), rtol=1e-12, atol=1e-14
    )
    before = of.jax_calls
    batch = jax.block_until_ready(jax.vmap(function)(y, u))
    assert of.jax_calls == {**before, "values": before["values"] + 1}
    np.testing.assert_array_equal(batch, of.values(y, u))
    before = of.jax_calls
    jacobian = jax.block_until_ready(jax.vmap(jax.jacrev(function))(y, u))
    assert of.jax_calls["derivatives"] == before["derivatives"] + 1
    assert of.jax_calls["values"] <= before["values"] + 1
    np.testing.assert_allclose(jacobian, of.jacobians(y, u)[0], rtol=1e-12, atol=1e-14)
    by_u = jax.vmap(jax.jacfwd(function, argnums=1))(y, u)
    np.testing.assert_allclose(by_u, of.jacobians(y, u)[1], rtol=1e-12, atol=1e-14)


def test_failures_in_jax_are_nan_or_errors(craft: precess.Spacecraft) -> None:
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    from precess.jax import accelerations

    of = Derivatives(craft)
    function: Any = accelerations(craft, of=of)
    y, u = state_and_inputs(craft, 3)
    y[1, 0] = np.nan
    found = jax.vmap(function)(y, u)
    assert np.isnan(found[1]).all() and np.isfinite(found[np.array([0, 2])]).all()
    jacobian = jax.vmap(jax.jacfwd(function))(y, u)
    assert np.isnan(jacobian[1]).all() and np.isfinite(jacobian[np.array([0, 2])]).all()
    inputs = craft.inputs()
    for joint in craft.joints:
        inputs.modes[joint.coordinate] = "locked"
    still = Derivatives(craft, inputs)
    locked: Any = accelerations(craft, of=still)
    at_rest = y.copy()
    at_rest[:, [craft.state_names.index(joint.rate) for joint in craft.joints]] = 0.0
    for place in (0, 1):
        expected = still.jacobians(at_rest, u)[place]
        for jacobian_of in (jax.jacfwd, jax.jacrev):
            of_locked = jax.vmap(jacobian_of(locked, argnums=place))(at_rest, u)
            np.testing.assert_allclose(of_locked, expected, rtol=1e-12, atol=1e-14)
            assert np.isnan(of_locked[1]).all()
    with pytest.raises(Exception, match=f"a state has {craft.state_size}"):
        function(y[0, :-1], u[0])
    gone = jax.ffi.ffi_call("precess_accelerations", jax.ShapeDtypeStruct((of.acceleration_size,), np.float64))
    with pytest.raises(Exception, match="no longer exists"):
        gone(y[0], u[0], number=np.int64(0))
    # The function keeps what it calls.
    of.__dict__.pop("jax_function")
    compiled = jax.jit(function)
    np.testing.assert_array_equal(compiled(y[0], u[0]), found[0])


def test_a_structure_that_bends_has_values_in_jax() -> None:
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    from precess.jax import accelerations, derivative

    craft = precess.Scenario.from_toml("scenarios/imaging-satellite-flexible.toml").spacecraft
    of = Derivatives(craft)
    function: Any = accelerations(craft, of=of)
    y, u = craft.initial_state().to_array(), craft.inputs().to_array()
    y[-20:] = 0.01
    np.testing.assert_array_equal(jax.jit(function)(y, u), np.asarray(craft.accelerations(y)))
    by_y, by_u = of.jacobians(y, u)
    for place, expected in enumerate((by_y, by_u)):
        for jacobian_of in (jax.jacfwd, jax.jacrev):
            found = jacobian_of(function, argnums=place)(y, u)
            np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-14)
    # By a modal coordinate and by its rate.
    for name in ("modes.eta_3", "modes.eta_dot_3"):
        step = np.zeros_like(y)
        step[craft.state_names.index(name)] = 1e-3
        slope = (of.values(y + step, u) - of.values(y - step, u)) / 2e-3
        exact = by_y[:, craft.state_names.index(name)]
        np.testing.assert_allclose(slope, exact, atol=DIFFERENCES * np.abs(exact).max())
    slopes: Any = derivative(craft, of=of)
    np.testing.assert_allclose(slopes(y, u), craft.derivative(0.0, y), rtol=1e-12, atol=1e-14)


def test_casadi_has_exact_derivatives(craft: precess.Spacecraft) -> None:
    casadi = pytest.importorskip("casadi")
    from precess.casadi import accelerations

    function = accelerations(craft, in_a_field(craft))
    (y,), (u,) = state_and_inputs(craft)
    of = Derivatives(craft, in_a_field(craft))
    np.testing.assert_array_equal(np.array(function(y, u)).ravel(), of.values(y, u))
    by_y, by_u = of.jacobians(y, u)
    symbols = casadi.MX.sym("y", craft.state_size), casadi.MX.sym("u", 6 + len(craft.joints))
    for symbol, expected in zip(symbols, (by_y, by_u), strict=True):
        jacobian = casadi.Function("j", symbols, [casadi.jacobian(function(*symbols), symbol)])
        np.testing.assert_allclose(np.array(jacobian(y, u)), expected, rtol=1e-13, atol=1e-15)
    gradient = casadi.Function(
        "g", symbols, [casadi.gradient(casadi.sumsqr(function(*symbols)), symbols[1])]
    )
    expected_gradient = 2.0 * by_u.T @ of.values(y, u)
    np.testing.assert_allclose(np.array(gradient(y, u)).ravel(), expected_gradient, rtol=1e-10)
    assert function.calls["derivatives"] > 0
    assert {"jac_a_y", "jac_a_u"} <= set(function.jacobian().name_out())
