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


#: A scenario with twenty modes, gimbals locked.
FLEXIBLE = "scenarios/imaging-satellite-flexible.toml"


def test_linearised_structure_is_that_of_differences_of_its_derivative() -> None:
    craft = precess.Scenario.from_toml(FLEXIBLE).spacecraft
    state, inputs = craft.initial_state(), craft.inputs()
    inputs.gravity = [0.3, -0.2, 9.8]
    found = craft.linearize(state, inputs)
    assert {"modes.eta_20", "modes.eta_dot_1"} <= set(found.states)
    assert {"modes.force_20", "cmg4.force_x", "cmg1.moment_z"} <= set(found.inputs)
    names = list(craft.state_names)
    rows = [place for place, name in enumerate(found.states) if name in names]
    kept = [names.index(found.states[place]) for place in rows]
    assert len(rows) == len(found.states) - 3
    y = state.to_array()
    for name, size in [("modes.eta_1", 1e-3), ("modes.eta_dot_20", 1e-3), ("omega_x", 1e-4), ("cmg2.spin", 1e-2)]:
        step = np.zeros_like(y)
        step[names.index(name)] = size
        slope = (craft.derivative(0.0, y + step, inputs) - craft.derivative(0.0, y - step, inputs)) / (2 * size)
        exact = found.A[rows, found.states.index(name)]
        np.testing.assert_allclose(slope[kept], exact, atol=1e-6 * np.abs(exact).max(), rtol=0, err_msg=name)
    with pytest.raises(precess.UnsupportedError, match="parameters"):
        craft.linearize(state, inputs, parameters=["hub.m_b"])


def test_mass_matrix_of_a_structure_returns_what_acts() -> None:
    craft = precess.Scenario.from_toml(FLEXIBLE).spacecraft
    state, inputs = craft.initial_state(), craft.inputs()
    for joint in craft.joints:
        inputs.modes[joint.coordinate] = "driven"
    found = craft.mass_matrix_and_bias(state, inputs)
    np.testing.assert_allclose(found.matrix, found.matrix.T, atol=1e-12 * np.abs(found.matrix).max())
    forces = found.matrix @ np.asarray(craft.accelerations(state, inputs)) + found.bias
    np.testing.assert_allclose(forces, 0.0, atol=1e-11 * np.abs(found.bias).max())


#: Of central differences of a step of RK4, relative to the largest of a column of numbers of size one.
STEPS = 1e-7


def test_linearize_step_is_that_of_differences(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    state = craft.initial_state().replace({"omega": [0.3, -0.2, 0.4], "mrp": [0.1, 0.2, -0.1]})
    inputs = craft.inputs()
    inputs.gravity = [0.3, -0.2, 9.8]
    dt, h = 0.01, 1e-5
    found = craft.linearize_step(state, dt, inputs)
    names = craft.state_names
    kept = [place for place, name in enumerate(names) if not 6 <= place < 10]

    def product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
        vector = p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:])
        return np.array([p[0] * q[0] - p[1:] @ q[1:], *vector])

    def stepped(changed: np.ndarray, acting: precess.Inputs) -> np.ndarray:
        """The state after the step, its attitude by twice the vector of the rotation from the one found."""
        y = craft.step(changed, dt, acting).to_array()
        q = found.state.to_array()[6:10] * [1, -1, -1, -1]
        turn = 2.0 * product(q, y[6:10])[1:]
        return np.concatenate([y[0:3], turn, y[3:6], y[10:13], y[joints]])

    assert len(found.states) == len(kept) + 3
    np.testing.assert_array_equal(found.state.to_array(), craft.step(state, dt, inputs).to_array())
    y = state.to_array()
    joints = [names.index(name) for name in found.states[12:]]
    order = [*range(3), *range(-3, 0), *range(3, 6), *range(10, 13), *joints]
    for column, place in enumerate(order):

        def at(size: float, place: int = place) -> np.ndarray:
            changed = y.copy()
            if place < 0:
                turn = np.zeros(4)
                turn[4 + place] = 0.5 * size
                changed[6:10] += product(y[6:10], turn)
            else:
                changed[place] += size
            return stepped(changed, inputs)

        slope = (at(h) - at(-h)) / (2 * h)
        exact = found.A[:, column]
        np.testing.assert_allclose(slope, exact, atol=STEPS * np.abs(exact).max(), rtol=0)
    assert sorted(joints) == list(range(13, len(names)))
    for column, name in enumerate(found.inputs):
        u = inputs.to_array()

        def by(size: float, column: int = column) -> np.ndarray:
            changed = craft.inputs()
            changed.gravity = inputs.gravity
            row = u.copy()
            row[column] += size
            changed.force, changed.torque = row[:3], row[3:6]
            for motor, number in zip(("wheel1.u_w", "wheel2.u_w"), row[6:], strict=True):
                changed.motors[motor] = number
            return stepped(y, changed)

        # Linear but for rounding: a long difference.
        slope = (by(1e-2) - by(-1e-2)) / 2e-2
        exact = found.B[:, column]
        np.testing.assert_allclose(slope, exact, atol=STEPS * np.abs(exact).max(), rtol=0, err_msg=name)


def test_linearized_steps_are_the_product_of_steps(wheels: str) -> None:
    craft = precess.Scenario.from_text(wheels).spacecraft
    state = craft.initial_state().replace({"omega": [0.3, -0.2, 0.4]})
    inputs = craft.inputs()
    by = ["hub.m_b", "wheel1.m_w"]
    whole = craft.linearize_step(state, 1e-3, inputs, steps=10, parameters=by)
    first = craft.linearize_step(state, 1e-3, inputs, steps=5, parameters=by)
    second = craft.linearize_step(first.state, 1e-3, inputs, steps=5, parameters=by)
    np.testing.assert_array_equal(second.state.to_array(), whole.state.to_array())
    np.testing.assert_allclose(second.A @ first.A, whole.A, rtol=1e-13, atol=1e-13)
    np.testing.assert_allclose(second.A @ first.B + second.B, whole.B, rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(second.A @ first.P + second.P, whole.P, rtol=1e-12, atol=1e-15)
    # Zero by structure: without gravity nothing depends on position, velocity or attitude but they themselves.
    rows = [place for place, name in enumerate(whole.states) if place >= 9]
    np.testing.assert_array_equal(whole.A[np.ix_(rows, range(9))], 0.0)
    # By a parameter, against spacecraft a kilogram off: differences have an error of its share of the mass, squared, and the
    # rounding of a spin.
    size = 1.0
    reached = []
    for mass in (size, -size):
        other = craft.scenario.with_values({"hub.mass": craft.parameters["hub.m_b"].value + mass})
        reached.append(other.spacecraft.step(state.to_array(), 1e-3, inputs=None, steps=10).to_array())
    slope = (reached[0] - reached[1]) / (2 * size)
    for name in ("velocity_x", "omega_x", "wheel1.spin", "wheel2.theta"):
        exact = whole.P[whole.states.index(name), 0]
        np.testing.assert_allclose(slope[craft.state_names.index(name)], exact, rtol=1e-4, atol=1e-13)


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
