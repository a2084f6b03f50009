"""One VSCMG in Basilisk: `VSCMGStateEffector`, fully coupled (`vscmgJitterFullyCoupled`).

The effector takes the wheel's centre of mass for U_s / mass along its y axis, its product of inertia 13 for
U_d, and starts it at the angle zero. Friction and limits are off.
"""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import spacecraft, vscmgStateEffector
from Basilisk.utilities import SimulationBaseClass

import listed
from basilisk_run import column, tensor


class Run:
    """The simulation, started, and all its objects kept alive."""

    joints = (["VSCMGGammas", "VSCMGThetas"], ["VSCMGGammaDots", "VSCMGOmegas"])
    by_joint = True

    def __init__(self, nanoseconds):
        given = listed.VSCMG
        self.sim = SimulationBaseClass.SimBaseClass()
        self.sim.CreateNewProcess("process").addTask(self.sim.CreateNewTask("task", nanoseconds))
        self.spacecraft = spacecraft.Spacecraft()
        hub = self.spacecraft.hub
        hub.mHub = given["hub"]["mass"]
        hub.r_BcB_B = column(given["hub"]["centre"])
        hub.IHubPntBc_B = tensor(given["hub"]["inertia"])
        hub.r_CN_NInit = hub.v_CN_NInit = hub.sigma_BNInit = column([0.0] * 3)
        hub.omega_BN_BInit = column(given["omega"])
        self.effector = vscmgStateEffector.VSCMGStateEffector()
        self.config = gyro(given)
        self.effector.AddVSCMG(self.config)
        self.spacecraft.addStateEffector(self.effector)
        torques = messaging.VSCMGArrayTorqueMsgPayload()
        torques.gimbalTorque, torques.wheelTorque = [given["u_g"]], [given["u_w"]]
        self.torques = messaging.VSCMGArrayTorqueMsg().write(torques)
        self.effector.cmdsInMsg.subscribeTo(self.torques)
        # The effector reads the torques before the spacecraft takes its step.
        self.sim.AddModelToTask("task", self.effector)
        self.sim.AddModelToTask("task", self.spacecraft)
        self.sim.InitializeSimulation()


def gyro(given):
    made = messaging.VSCMGConfigMsgPayload()
    axes = np.array(given["mount"])
    made.gsHat0_B, made.gtHat0_B, made.ggHat_B = (column(axes[:, k]) for k in range(3))
    gimbal, wheel = given["gimbal"], given["wheel"]
    made.rGB_B = column(gimbal["origin"])
    made.massG, made.rGcG_G = gimbal["mass"], column(gimbal["centre"])
    made.IG1, made.IG12, made.IG13, made.IG2, made.IG23, made.IG3 = gimbal["inertia"]
    made.massW, made.l, made.L = wheel["mass"], wheel["l"], wheel["L"]
    made.IW1, made.IW2, made.IW3 = wheel["inertia"]
    made.U_s, made.U_d = wheel["u_s"], wheel["u_d"]
    made.gamma, made.gammaDot, made.Omega = given["gamma"], given["gamma_dot"], given["spin"]
    made.u_s_max = made.u_s_min = made.u_g_max = made.u_g_min = -1.0
    made.Omega_max = made.gammaDot_max = -1.0
    made.wheelLinearFrictionRatio = made.gimbalLinearFrictionRatio = -1.0
    made.VSCMGModel = vscmgStateEffector.vscmgJitterFullyCoupled
    return made
