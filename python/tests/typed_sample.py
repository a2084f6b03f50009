"""A program that uses the package with types: checked by mypy --strict, and run."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

import precess
from precess import montecarlo, pointing, spectra, sweep

TABLES = {
    "hub": {"mass": 350.0, "inertia": [80.0, 70.0, 60.0]},
    "initial": {"angular_velocity": [0.01, -0.02, 0.03]},
    "device": [
        {
            "name": "wheel",
            "kind": "reaction_wheel",
            "mount": {"spin_axis": [0, 0, 1]},
            "imbalance": {"static": "1 g cm", "dynamic": "20 g cm^2"},
            "wheel": {"mass": 4.0, "inertia": [0.0288, 0.015, 0.015], "rate": "3000 rpm"},
        }
    ],
    "run": {"duration": 1.0},
    "output": {"rate": 1000.0},
}


def momentum(craft: precess.Spacecraft, state: precess.State) -> npt.NDArray[np.float64]:
    """Angular momentum about the origin."""
    return craft.momentum(state).angular


def main() -> None:
    scenario = precess.Scenario.from_dict(TABLES)
    result = scenario.run()
    omega: npt.NDArray[np.float64] = result["omega"]
    lost: float | None = result.drift.energy
    craft = scenario.spacecraft
    state = craft.initial_state()
    state["omega_x"] = 0.02
    inputs = craft.inputs()
    inputs.motors["wheel.u_w"] = 0.01
    accelerations: precess.Accelerations = craft.accelerations(state, inputs)
    matrices = craft.linearize(state, inputs, parameters=["hub.m_b"])
    batch = precess.Batch(craft, {"hub.m_b": np.linspace(300.0, 400.0, 8)})
    found = batch.run(batch.states(), dt=1e-3, steps=10, reduce=["max"])
    density = spectra.welch(omega[:, 0], 1000.0)
    exposure: pointing.Exposure = pointing.exposure(omega.T, 1000.0, 0.1).rms
    swept: sweep.Sweep = sweep.run(scenario, {"hub.mass": "300, 400 kg"})
    drawn = montecarlo.run(
        scenario, [{"key": "hub.mass", "distribution": "uniform", "from": "300 kg", "to": "400 kg"}], 2
    )
    try:
        scenario.with_values({"hub.mass": "-1 kg"})
    except precess.ScenarioError as error:
        places: list[int] = [diagnostic.line for diagnostic in error.diagnostics]
        print(places)
    print(omega.shape, lost, accelerations["omega_dot_x"], matrices.A.shape, momentum(craft, state))
    print(found.reduced["max"].shape, density.band_rms(10.0, 100.0), swept["omega rms"], len(drawn))
    print(f"jitter {exposure.jitter}")


if __name__ == "__main__":
    main()
