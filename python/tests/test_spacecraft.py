"""Spacecraft and batches: the bits of runs, of each other, and of any number of threads."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import precess


def test_steps_have_the_bits_of_a_run(wheels: str) -> None:
    scenario = precess.Scenario.from_text(wheels)
    result = scenario.run()
    craft = scenario.spacecraft
    state = craft.step(craft.initial_state(), 1e-3, steps=50)
    names = [name for name in craft.state_names if name in result]
    assert [state[name] for name in names] == [result[name][-1] for name in names]


def test_mass_matrix_and_bias_return_the_motors(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    state = craft.initial_state()
    found = craft.mass_matrix_and_bias(state)
    forces = found.matrix @ np.asarray(craft.accelerations(state)) + found.bias
    np.testing.assert_allclose(forces, [0, 0, 0, 0, 0, 0, 0.02, 0.0], atol=1e-11)


def test_linearize_is_that_of_differences(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    state = craft.initial_state()
    inputs = craft.inputs()
    found = craft.linearize(state, inputs, parameters=["hub.m_b"])
    step = 1e-4
    column = [
        np.asarray(craft.accelerations(state.replace({"wheel1.spin": state["wheel1.spin"] + h}), inputs))
        for h in (step, -step)
    ]
    slope = (column[0] - column[1]) / (2 * step)
    exact = found.C[:, found.states.index("wheel1.spin")]
    np.testing.assert_allclose(slope, exact, atol=1e-7 * np.abs(exact).max())
    assert found.Q.shape == (len(found.outputs), 1)


def test_solve_ivp_is_the_run(wheels: str) -> None:
    integrate = pytest.importorskip("scipy.integrate")
    scenario = precess.Scenario.from_text(wheels)
    craft = scenario.spacecraft
    y = craft.initial_state().to_array()
    found = integrate.solve_ivp(craft.derivative, (0, 0.05), y, method="DOP853", rtol=1e-11, atol=1e-11)
    result = scenario.run()
    np.testing.assert_allclose(found.y[10:13, -1], result["omega"][-1], atol=1e-8)


def test_batches_have_the_bits_of_single_states_on_any_threads(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    rng = np.random.default_rng(7)
    states = np.tile(craft.initial_state().to_array(), (150, 1))
    states[:, 10:] += 0.1 * rng.standard_normal(states[:, 10:].shape)
    batch = precess.Batch(craft)
    scalar = precess.Batch(craft, in_lanes=False)
    assert batch.in_lanes and not scalar.in_lanes
    found = batch.accelerations(states, threads=1)
    single = np.array([np.asarray(craft.accelerations(state, craft.inputs())) for state in states])
    for other in (single, batch.accelerations(states, threads=3), scalar.accelerations(states)):
        np.testing.assert_array_equal(found, other)
    run = batch.run(states, 1e-3, 300, every=7, threads=1)
    assert run.history is not None and run.history.shape == (150, 43, 17)
    again = scalar.run(states, 1e-3, 300, every=7, threads=2)
    np.testing.assert_array_equal(run.history, again.history)
    np.testing.assert_array_equal(run.final, again.final)
    parts = batch.run(states[60:90], 1e-3, 300, threads=2)
    np.testing.assert_array_equal(parts.final, run.final[60:90])
    one = craft.step(states[5], 1e-3, craft.inputs(), steps=300)
    np.testing.assert_array_equal(one.to_array(), run.final[5])
    reduced = batch.run(states, 1e-3, 300, every=7, reduce=["max", "rms"]).reduced
    np.testing.assert_array_equal(reduced["max"], run.history.max(axis=1))
    np.testing.assert_allclose(reduced["rms"], np.sqrt((run.history**2).mean(axis=1)), rtol=1e-12)


def test_parameters_differ_and_errors_are_of_elements(wheels: str) -> None:
    scenario = precess.Scenario.from_text(wheels)
    masses = np.linspace(300.0, 400.0, 70)
    masses[3] = -1.0
    batch = precess.Batch(scenario, {"hub.m_b": masses})
    states = batch.states()
    states[9, 0] = np.nan
    found = batch.accelerations(states)
    assert batch.in_lanes and sorted(batch.errors) == [3, 9]
    assert isinstance(batch.errors[3], precess.ParameterError)
    assert isinstance(batch.errors[9], precess.SolveError)
    assert np.isnan(found[[3, 9]]).all() and not np.isnan(np.delete(found, [3, 9], axis=0)).any()
    keys = precess.Batch(scenario, {"hub.mass": masses[10:20]})
    np.testing.assert_array_equal(keys.accelerations(keys.states()), found[10:20])
    other = scenario.with_values({"hub.mass": float(masses[20])}).spacecraft
    np.testing.assert_array_equal(np.asarray(other.accelerations(other.initial_state())), found[20])


def test_states_and_inputs_pickle_and_read_by_name(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    state = craft.state({"wheel1.spin": 3.0, "omega": [0.0, 0.1, 0.0], "mrp": [0.1, 0.0, 0.2]})
    assert state.joints["wheel1.spin"] == 3.0 == state["wheel1.spin"]
    np.testing.assert_allclose(state.mrp, [0.1, 0.0, 0.2], atol=1e-15)
    inputs = craft.inputs()
    inputs.motors["wheel2.u_w"] = 0.5
    inputs.modes["wheel1.theta"] = 2.0
    assert pickle.loads(pickle.dumps(state)) == state
    assert pickle.loads(pickle.dumps(inputs)) == inputs
    assert craft.accelerations(state, inputs)["wheel1.spin_dot"] == 2.0
