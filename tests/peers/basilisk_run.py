"""Basilisk: a hub with one SpinningBodyNDOF effector of three joints a device.

    python basilisk_run.py check FILE   accelerations of the file's state
    python basilisk_run.py time FILE    nanoseconds per derivative evaluation within RK4 steps
    python basilisk_run.py turns FILE   the same, a turn for each line of input

A step evaluates the derivatives four times. What a step does besides (the sums of the integrator,
the energies, the messages) is counted with them: Basilisk has no step without it.
"""

import json

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import extForceTorque, spacecraft
from Basilisk.simulation import spinningBodyNDOFStateEffector as spinning
from Basilisk.utilities import SimulationBaseClass

import turns

AXES = "xyz"
ENTRIES = ["11", "12", "13", "22", "23", "33"]
# Short, so that no angle or rate moves far in all the steps that are timed.
STEP_NANOSECONDS = 100
STAGES = 4


def opened(file):
    with open(file, encoding="utf-8") as text:
        return Run(json.load(text))


class Run:
    """The simulation of one spacecraft, started, and all its objects kept alive."""

    units = STAGES
    # Long enough that waiting for the thread that steps, up to 0.3 ms of the main thread, does not count.
    least_batch = 2e-2

    def __init__(self, craft, nanoseconds=STEP_NANOSECONDS):
        self.nanoseconds = nanoseconds
        self.sim = SimulationBaseClass.SimBaseClass()
        self.sim.CreateNewProcess("process").addTask(
            self.sim.CreateNewTask("task", nanoseconds)
        )
        self.spacecraft = hub(craft)
        self.loads = extForceTorque.ExtForceTorque()
        self.loads.extForce_B = column(craft["force"])
        self.loads.extTorquePntB_B = column(craft["torque_b"])
        self.spacecraft.addDynamicEffector(self.loads)
        self.motors = [motors(device) for device in craft["devices"]]
        self.effectors = [effector(device) for device in craft["devices"]]
        for motor, chain in zip(self.motors, self.effectors):
            chain.motorTorqueInMsg.subscribeTo(motor)
            self.spacecraft.addStateEffector(chain)
            self.sim.AddModelToTask("task", chain)
        self.sim.AddModelToTask("task", self.loads)
        self.sim.AddModelToTask("task", self.spacecraft)
        self.sim.InitializeSimulation()
        self.steps = 0

    def check(self):
        """Derivatives at the file's state: B's axes are still the inertial ones."""
        for module in (*self.effectors, self.loads):
            module.UpdateState(0)
        self.spacecraft.equationsOfMotion(0.0, self.nanoseconds * 1e-9)
        names = ["hubVelocity", "hubOmega"]
        names += [chain.getNameOfThetaDotState() for chain in self.effectors]
        states = self.spacecraft.dynManager
        values = [np.ravel(states.getStateObject(name).getStateDeriv()) for name in names]
        return {"accelerations": np.concatenate(values).tolist()}

    def run(self, calls):
        """So many steps, all within C++."""
        self.steps += calls
        self.sim.ConfigureStopTime(self.steps * self.nanoseconds)
        self.sim.ExecuteSimulation()


def hub(craft):
    made = spacecraft.Spacecraft()
    given = craft["hub"]
    made.hub.mHub = given["m_b"]
    made.hub.r_BcB_B = column(given["r_bc_b"])
    made.hub.IHubPntBc_B = tensor(given["i_b"])
    made.hub.r_CN_NInit = column([0.0] * 3)
    made.hub.v_CN_NInit = column(craft["r_b_n_dot"])
    made.hub.sigma_BNInit = column([0.0] * 3)
    made.hub.omega_BN_BInit = column(craft["omega"])
    return made


def effector(device):
    """Outer gimbal, inner gimbal and wheel, each on the one before."""
    p, mount = device["parameters"], np.array(device["mount"])
    # Place in the body before, axes there at zero angle, axis; then mass, centre, inertia.
    bodies = [
        (mount @ vector(p, "r_go_b_b"), mount.T, [0, 0, 1],
         p["m_go"], vector(p, "r_goc_go_go"), inertia(p, "i_go")),
        (vector(p, "l_o_"), np.eye(3), [0, 1, 0],
         p["m_gi"], vector(p, "r_gic_gi_gi"), inertia(p, "i_gi")),
        (vector(p, "l_i_"), np.eye(3), [1, 0, 0],
         p["m_w"], [0.0, p["d"], 0.0], inertia(p, "j")),
    ]  # fmt: skip
    chain = spinning.SpinningBodyNDOFStateEffector()
    motion = zip(device["angles"].values(), device["rates"].values())
    for (place, axes, axis, mass, centre, entries), (angle, rate) in zip(bodies, motion):
        body = spinning.SpinningBody()
        body.setR_SP_P(column(place))
        body.setDCM_S0P(np.array(axes).tolist())
        body.setSHat_S(column(axis))
        body.setMass(mass)
        body.setR_ScS_S(column(centre))
        body.setISPntSc_S(entries)
        body.setThetaInit(angle)
        body.setThetaDotInit(rate)
        chain.addSpinningBody(body)
    return chain


def motors(device):
    torques = messaging.ArrayMotorTorqueMsgPayload()
    torques.motorTorque = list(device["motors"].values())
    return messaging.ArrayMotorTorqueMsg().write(torques)


def vector(p, name):
    return np.array([p[name + axis] for axis in AXES])


def inertia(p, name):
    return tensor([p[f"{name}_{entry}"] for entry in ENTRIES])


def tensor(entries):
    xx, xy, xz, yy, yz, zz = entries
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


def column(values):
    return [[float(x)] for x in values]


if __name__ == "__main__":
    turns.answer(opened)
