"""One spacecraft with reaction wheels in Basilisk: `ReactionWheelStateEffector`, every wheel fully
coupled (`JitterFullyCoupled`), in steps of Basilisk's RK4.

The effector knows a wheel by its imbalances: the centre of mass is U_s / mass along the wheel's y axis,
the product of inertia 13 is U_d. It takes the transverse moments Jt and Jg for equal, and starts every wheel
at the angle zero, where its y axis is `w2Hat0_B`. Friction is zero: no coefficient is set.
"""

from importlib.metadata import version

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import reactionWheelStateEffector, spacecraft
from Basilisk.utilities import SimulationBaseClass

VERSION = version("bsk")
# Names of Basilisk's states, by what they are here.
HUB_STATES = {
    "position": "hubPosition",
    "velocity": "hubVelocity",
    "mrp": "hubSigma",
    "omega": "hubOmega",
}
STATES = {**HUB_STATES, "theta": "reactionWheelThetas", "spin": "reactionWheelOmegas"}


def samples(craft):
    """The state at the start and after every so many steps."""
    return samples_of(Run(craft), craft)


def samples_of(run, craft):
    found = [run.state(0)]
    for steps in range(craft["every"], craft["steps"] + 1, craft["every"]):
        run.step_to(steps)
        found.append(run.state(steps))
    return found


class Run:
    """The simulation, started, and all its objects kept alive."""

    states = STATES

    def __init__(self, craft):
        self.nanoseconds = round(craft["step"] * 1e9)
        self.sim = SimulationBaseClass.SimBaseClass()
        self.sim.CreateNewProcess("process").addTask(
            self.sim.CreateNewTask("task", self.nanoseconds)
        )
        self.spacecraft = hub(craft)
        self.effector = self.attached(craft)
        self.spacecraft.addStateEffector(self.effector)
        # The effector reads the torques before the spacecraft takes its step.
        self.sim.AddModelToTask("task", self.effector)
        self.sim.AddModelToTask("task", self.spacecraft)
        self.sim.InitializeSimulation()

    def attached(self, craft):
        """The effector with its devices and motors."""
        self.configs = [wheel(given) for given in craft["wheels"]]
        effector = reactionWheelStateEffector.ReactionWheelStateEffector()
        for config in self.configs:
            effector.addReactionWheel(config)
        torques = messaging.ArrayMotorTorqueMsgPayload()
        torques.motorTorque = [given["u_w"] for given in craft["wheels"]]
        self.torques = messaging.ArrayMotorTorqueMsg().write(torques)
        effector.rwMotorCmdInMsg.subscribeTo(self.torques)
        return effector

    def step_to(self, steps):
        self.sim.ConfigureStopTime(steps * self.nanoseconds)
        self.sim.ExecuteSimulation()

    def state(self, steps):
        states = self.spacecraft.dynManager
        found = {"steps": steps}
        for name, of_basilisk in self.states.items():
            found[name] = np.ravel(states.getStateObject(of_basilisk).getState()).tolist()
        return found


def hub(craft):
    made = spacecraft.Spacecraft()
    given = craft["hub"]
    made.hub.mHub = given["m_b"]
    made.hub.r_BcB_B = column(given["r_bc_b"])
    xx, xy, xz, yy, yz, zz = given["i_b"]
    made.hub.IHubPntBc_B = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    # Of the centre of mass of the whole; Basilisk derives the state of B from it.
    made.hub.r_CN_NInit = column([0.0] * 3)
    made.hub.v_CN_NInit = column(craft["v_c_n"])
    made.hub.sigma_BNInit = column(craft["mrp"])
    made.hub.omega_BN_BInit = column(craft["omega"])
    return made


def wheel(given):
    made = reactionWheelStateEffector.RWConfigPayload()
    axes = np.array(given["mount"])
    made.gsHat_B, made.w2Hat0_B, made.w3Hat0_B = (column(axes[:, k]) for k in range(3))
    made.rWB_B = column(given["r_w_b"])
    made.mass = given["m_w"]
    made.Js = given["axial"]
    made.Jt = made.Jg = given["transverse"]
    made.U_s, made.U_d = given["u_s"], given["u_d"]
    made.Omega = given["spin"]
    made.RWModel = reactionWheelStateEffector.JitterFullyCoupled
    # Negative: no Stribeck friction, and no limit.
    made.betaStatic = made.u_max = made.Omega_max = made.P_max = -1.0
    return made


def column(values):
    return [[float(x)] for x in values]
