"""Basilisk: RK4 steps of a spacecraft, by the effector that fits its devices.

    python basilisk_step.py check FILE   what moves in 100 steps
    python basilisk_step.py time FILE    nanoseconds per step
    python basilisk_step.py turns FILE   the same, a turn for each line of input

FILE is `steps/wheels.json` (ReactionWheelStateEffector, JitterFullyCoupled), `steps/vscmg.json`
(VSCMGStateEffector, vscmgJitterFullyCoupled), or `steps/N.json` with DGVSCMGs
(SpinningBodyNDOFStateEffector, three joints a device).
"""

import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "engines"))

import basilisk_run  # noqa: E402
import basilisk_vscmg  # noqa: E402
import listed  # noqa: E402
import turns  # noqa: E402
import wheels  # noqa: E402
import with_basilisk  # noqa: E402
from motion import STEPS, motion, quaternion_of  # noqa: E402

# Short while it is timed, so that no angle or rate moves far.
STEP_NANOSECONDS = 100


def opened(file):
    path = Path(file)
    if path.stem == "wheels":
        return Steps(listed.STEP_OF_WHEELS, reaction_wheels)
    if path.stem == "vscmg":
        return Steps(listed.STEP_OF_VSCMG, basilisk_vscmg.Run)
    craft = json.loads((path.parent.parent / path.name).read_text(encoding="utf-8"))
    return Steps(listed.STEP_OF_DGVSCMGS, lambda step: chains(craft, step))


class Steps:
    """Steps of one spacecraft: another simulation for each length of a step."""

    units = 1
    # Long enough that waiting for the thread that steps, up to 0.3 ms of the main thread, does not count.
    least_batch = 2e-2

    def __init__(self, step, open_run):
        self.open_run = open_run
        self.checked = round(step * 1e9)
        self.run_of_turns = None
        self.steps = 0

    def check(self):
        run = self.open_run(self.checked)
        before = sample(run)
        run.sim.ConfigureStopTime(STEPS * self.checked)
        run.sim.ExecuteSimulation()
        return motion([(before[:2], sample(run))], STEPS * self.checked * 1e-9)

    def run(self, calls):
        if self.run_of_turns is None:
            self.run_of_turns = self.open_run(STEP_NANOSECONDS)
        self.steps += calls
        self.run_of_turns.sim.ConfigureStopTime(self.steps * STEP_NANOSECONDS)
        self.run_of_turns.sim.ExecuteSimulation()


def sample(run):
    states = run.spacecraft.dynManager

    def state(name):
        return np.ravel(states.getStateObject(name).getState()).tolist()

    joints = [np.array([state(name) for name in names]) for names in run.joints]
    # Device by device, joint by joint.
    coordinates, rates = (np.ravel(values.T if run.by_joint else values) for values in joints)
    attitude = quaternion_of(state("hubSigma"))
    omega = state("hubOmega")
    return state("hubPosition"), state("hubVelocity"), attitude, omega, coordinates, rates


def reaction_wheels(nanoseconds):
    craft = {
        **wheels.CRAFT,
        "step": nanoseconds * 1e-9,
        "v_c_n": [0.0] * 3,
        "mrp": [0.0] * 3,
        "wheels": [wheels.mounted(wheel) for wheel in wheels.CRAFT["wheels"]],
    }
    run = with_basilisk.Run(craft)
    run.joints = (["reactionWheelThetas"], ["reactionWheelOmegas"])
    run.by_joint = True
    return run


def chains(craft, nanoseconds):
    run = basilisk_run.Run({**craft, "r_b_n_dot": [0.0] * 3}, nanoseconds)
    run.joints = (
        [chain.getNameOfThetaState() for chain in run.effectors],
        [chain.getNameOfThetaDotState() for chain in run.effectors],
    )
    run.by_joint = False
    return run


if __name__ == "__main__":
    turns.answer(opened)
