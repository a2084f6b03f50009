"""MuJoCo: RK4 steps of 256 states of one spacecraft on one thread, from Python.

    python mujoco_batch.py check FILE rollout   what moves in 100 steps, of the first state and the last
    python mujoco_batch.py turns FILE rollout   nanoseconds per step and state, a turn for each line
    python mujoco_batch.py turns FILE mjbatch   the same by mjbatch, in its folder of the environment

FILE is `steps/N.json`. What the smooth dynamics of a free spacecraft do not need is switched off: contacts,
constraints, actuators, sensors, energy.
"""

import json
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "engines"))

if sys.argv[-1] == "mjbatch":
    # It needs a version of MuJoCo of its own.
    sys.path.insert(0, str(Path(sys.prefix) / "mjbatch"))

import mujoco  # noqa: E402
import turns  # noqa: E402
import with_mujoco  # noqa: E402
from motion import STEPS, motion  # noqa: E402

STATES = 256
# Steps in a call, as of Precess.
STEPS_IN_A_CALL = 10
# By how much the body rate of a state exceeds that of the one before, of itself.
APART = 1e-3
# Step where motions are compared, s: short, since the attitude of MuJoCo 3.14 differs with longer ones
# (README.md, "Steps").
COMPARED = 2e-7
# Short while it is timed, s, so that no turn runs into a state unlike the first.
STEP = 1e-7


def opened(file, engine):
    path = Path(file)
    craft = json.loads((path.parent.parent / path.name).read_text(encoding="utf-8"))
    return {"rollout": Rollout, "mjbatch": Batch}[engine](craft)


def model_of(craft, step):
    model = with_mujoco.build(craft)
    model.opt.integrator = mujoco.mjtIntegrator.mjINT_RK4
    model.opt.timestep = step
    model.opt.enableflags = 0
    off = mujoco.mjtDisableBit
    for flag in (off.mjDSBL_CONSTRAINT, off.mjDSBL_CONTACT, off.mjDSBL_ACTUATION,
                 off.mjDSBL_SENSOR, off.mjDSBL_GRAVITY, off.mjDSBL_WARMSTART):  # fmt: skip
        model.opt.disableflags |= flag
    return model


def starts(craft):
    """Coordinates and rates of every state; B starts at rest, axes along the world's."""
    angles = with_mujoco.joints(craft, "angles")
    rates = with_mujoco.joints(craft, "rates")
    omega, places, velocities = np.array(craft["omega"]), [], []
    for _ in range(STATES):
        places.append(np.concatenate([[0.0] * 3, [1.0], [0.0] * 3, angles]))
        velocities.append(np.concatenate([[0.0] * 3, omega, rates]))
        omega = omega * (1.0 + APART)
    return np.array(places), np.array(velocities)


def torques(craft):
    """On the degrees of freedom. A force would be along the world's axes, ours is along B's: none."""
    motors = with_mujoco.joints(craft, "motors")
    return np.concatenate([[0.0] * 3, craft["torque_b"], motors])


def compared(before, after, time):
    """The first state's motion and the last one's."""
    (places_0, velocities_0), (places, velocities) = before, after
    chosen = [0, STATES - 1]
    return motion(
        [((places_0[k][:3], velocities_0[k][:3]),
          (places[k][:3], velocities[k][:3], places[k][3:7], velocities[k][3:6],
           places[k][7:], velocities[k][6:])) for k in chosen],
        time,
    )  # fmt: skip


class Rollout:
    """`mujoco.rollout`, its arrays allocated once."""

    units = STATES * STEPS_IN_A_CALL
    least_batch = 1e-3

    def __init__(self, craft):
        from mujoco import rollout

        self.craft = craft
        self.rollout = rollout.Rollout(nthread=0)
        self.open(STEP, STEPS_IN_A_CALL)

    def open(self, step, steps):
        self.model = [model_of(self.craft, step)] * STATES
        self.data = [mujoco.MjData(self.model[0])]
        spec = mujoco.mjtState.mjSTATE_FULLPHYSICS
        size = mujoco.mj_stateSize(self.model[0], spec)
        self.initial, data = np.empty((STATES, size)), mujoco.MjData(self.model[0])
        for row, place, velocity in zip(self.initial, *starts(self.craft)):
            data.qpos[:], data.qvel[:] = place, velocity
            mujoco.mj_getState(self.model[0], data, row, spec)
        applied = np.tile(torques(self.craft), (STATES, steps, 1))
        self.states = np.empty((STATES, steps, size))
        self.arguments = dict(
            control=applied, control_spec=mujoco.mjtState.mjSTATE_QFRC_APPLIED.value,
            skip_checks=True, nstep=steps, state=self.states,
        )  # fmt: skip

    def run(self, calls):
        for _ in range(calls):
            self.rollout.rollout(self.model, self.data, self.initial, **self.arguments)

    def check(self):
        self.open(COMPARED, STEPS)
        self.run(1)
        data, found = self.data[0], []
        for state in self.states[:, -1]:
            mujoco.mj_setState(self.model[0], data, state, mujoco.mjtState.mjSTATE_FULLPHYSICS)
            found.append((data.qpos.copy(), data.qvel.copy()))
        return compared(
            starts(self.craft), list(zip(*found)), STEPS * COMPARED
        )


class Batch:
    """mjbatch on one thread."""

    units = STATES * STEPS_IN_A_CALL
    least_batch = 1e-3

    def __init__(self, craft):
        self.craft = craft
        self.open(STEP)

    def open(self, step):
        from mjbatch import Batch as Simulations

        self.batch = Simulations(model_of(self.craft, step), num_sims=STATES, num_threads=1)
        self.qpos, self.qvel = self.batch.bind("qpos"), self.batch.bind("qvel")
        self.qpos[:], self.qvel[:] = starts(self.craft)
        self.batch.bind("qfrc_applied")[:] = torques(self.craft)

    def run(self, calls):
        for _ in range(calls):
            self.batch.step(nstep=STEPS_IN_A_CALL)

    def check(self):
        self.open(COMPARED)
        before = self.qpos.copy(), self.qvel.copy()
        self.batch.step(nstep=STEPS)
        return compared(before, (self.qpos, self.qvel), STEPS * COMPARED)


if __name__ == "__main__":
    turns.answer(opened)
