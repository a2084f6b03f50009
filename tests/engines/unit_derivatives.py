"""Directional and adjoint derivatives of units in FMPy, against differences."""

import sys

import numpy as np

# Central differences of numbers of a size of one: the error of their rounding, and of the third order.
STEP = 1e-4
DIFFERENCE = 2e-6


def check(unit, chance):
    """Derivatives of every derivative along each state and input; how many, and by how much differences are off."""
    one = unit.instance(exchanges=True)
    states = [v for v in unit.variables if v.causality == "output"]
    inputs = [v for v in unit.variables if v.causality == "input"]
    unknowns = [v.valueReference for v in unit.variables if v.derivative is not None]
    one.enter_continuous_time()
    x = np.array([float(state.start) for state in states])
    scale = np.array([float(state.nominal or 1.0) for state in states])
    x += [chance.uniform(-0.1, 0.1) * size for size in scale]
    u = np.array([chance.uniform(0.01, 0.05) for _ in inputs])
    places = [v.valueReference for v in inputs]

    def rates(x, u):
        one.set_states(x)
        one.set(places, list(u))
        return np.array(one.get(unknowns))

    base = rates(x, u)
    worst = 0.0
    columns = []
    for index, known in enumerate([*states, *inputs]):
        size = scale[index] if index < len(states) else 1.0
        by = np.zeros(len(states) + len(inputs))
        by[index] = STEP * size
        dx, du = by[: len(states)], by[len(states) :]
        difference = (rates(x + dx, u + du) - rates(x - dx, u - du)) / (2.0 * STEP * size)
        rates(x, u)
        found = np.array(one.along(unknowns, [known.valueReference], [1.0]))
        columns.append(found)
        # A rate and its derivative are of one size where their states are.
        bound = np.abs(found).max() + np.abs(base).max() / size
        off = np.abs(found - difference).max() / bound if bound else 0.0
        worst = max(worst, off)
        if not off <= DIFFERENCE:
            sys.exit(f"{unit.name}: along {known.name}: {found} and {difference}")
    knowns = [v.valueReference for v in [*states, *inputs]]
    seed = [chance.uniform(-1.0, 1.0) for _ in knowns]
    together = np.array(one.along(unknowns, knowns, seed))
    summed = np.array(columns).T @ seed
    if not np.allclose(together, summed, rtol=1e-12, atol=1e-12 * np.abs(summed).max()):
        sys.exit(f"{unit.name}: along a sum: {together} and {summed}")
    weights = [chance.uniform(-1.0, 1.0) for _ in unknowns]
    gradient = one.gradient(unknowns, knowns, weights)
    expected = np.array(columns) @ weights
    if gradient is not None and not np.allclose(gradient, expected, rtol=1e-12, atol=1e-12 * np.abs(expected).max()):
        sys.exit(f"{unit.name}: the gradient: {gradient} and {expected}")
    one.close()
    return len(columns) * len(unknowns), worst
