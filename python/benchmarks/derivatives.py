"""What derivatives cost in Python: the Jacobian in JAX and CasADi, the linearised systems of a batch, one spacecraft's, and the
sensitivities of a campaign.

    pip install jax casadi
    python python/benchmarks/derivatives.py

Prints a table for the package that is installed: an older wheel prints what it was before. The spacecraft is that
of `throughput.py`, four double-gimbal gyros, which is compared with what is stored first. Times are those of the processor in all
threads of the process, the least of all turns: what else the machine does is not counted.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import precess
from machine import processor
from throughput import AGREEMENT, compared, scenario_of, stored

SCENARIOS = Path(__file__).resolve().parents[2] / "scenarios"
STATES, TURNS = 256, 15


def least(call: Callable[[], object], count: int) -> float:
    """Microseconds of a call."""
    call()
    times = []
    for _ in range(TURNS):
        start = time.process_time()
        for _ in range(count):
            call()
        times.append(time.process_time() - start)
    return 1e6 * min(times) / count


def of_jax(craft: precess.Spacecraft) -> dict[str, Callable[[], object]]:
    """The Jacobian by the state and the inputs, and one product with a direction, under `jit`."""
    import jax
    from precess.jax import accelerations

    jax.config.update("jax_enable_x64", True)
    function = accelerations(craft)
    y, u = craft.initial_state().to_array(), craft.inputs().to_array()
    jacobian = jax.jit(jax.jacobian(function, argnums=(0, 1)))
    along = jax.jit(lambda y, u, dy, du: jax.jvp(function, (y, u), (dy, du))[1])
    dy, du = np.ones_like(y), np.ones_like(u)
    return {
        "`jax.jit(jax.jacobian(accelerations, (0, 1)))`": lambda: jax.block_until_ready(jacobian(y, u)),
        "`jax.jvp` of `accelerations`, under `jit`": lambda: along(y, u, dy, du).block_until_ready(),
    }


def of_casadi(craft: precess.Spacecraft) -> dict[str, Callable[[], object]]:
    """The function's Jacobian."""
    from precess.casadi import accelerations

    function = accelerations(craft)
    y, u = craft.initial_state().to_array(), craft.inputs().to_array()
    result = function(y, u)

    def jacobian(function: object = function, of: Callable[..., object] = function.jacobian()) -> object:
        # CasADi does not keep the function: a default value of this one does.
        return of(y, u, result)

    return {"`jacobian()` of the function for CasADi": jacobian}


def of_precess(craft: precess.Spacecraft) -> dict[str, Callable[[], object]]:
    """One linearised system, and those of a batch."""
    state, batch = craft.initial_state(), precess.Batch(craft)
    states = batch.states(STATES)
    return {
        "`Spacecraft.linearize`": lambda: craft.linearize(state),
        f"`Batch.linearize`, {STATES} states, one thread": lambda: batch.linearize(states, threads=1),
    }


def of_campaign() -> Callable[[], object]:
    """Sensitivities of two wheels on one axis."""
    from precess import montecarlo

    vary = [
        {"key": f"device.{wheel}.imbalance.static", "distribution": "normal", "mean": "1 g cm", "deviation": "0.1 g cm"}
        for wheel in ("wheel", "opposite")
    ]
    return lambda: montecarlo.sensitivities(SCENARIOS / "known-opposite-wheels.toml", vary)


def main() -> None:
    stored_craft = stored()
    craft = precess.Spacecraft(scenario_of(stored_craft))
    if not compared(stored_craft, craft) <= AGREEMENT:
        raise SystemExit("accelerations are not those that are stored")
    rows = {name: (call, 20) for name, call in (of_jax(craft) | of_casadi(craft) | of_precess(craft)).items()}
    rows["`montecarlo.sensitivities` of `known-opposite-wheels.toml`, two parameters"] = (of_campaign(), 1)
    print(f"{processor()}; precess {precess.__version__}; least of {TURNS} turns\n")
    print("| | us |\n|---|---:|")
    for name, (call, count) in rows.items():
        print(f"| {name} | {least(call, count):.0f} |")


if __name__ == "__main__":
    main()
