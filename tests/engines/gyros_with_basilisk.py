"""One spacecraft with VSCMGs in Basilisk: `VSCMGStateEffector`, every gyro fully coupled
(`vscmgJitterFullyCoupled`), in steps of Basilisk's RK4.

The effector knows a wheel by its imbalances: the centre of mass is U_s / mass along the wheel's y axis,
the product of inertia 13 is U_d. The wheel's origin is in the plane of the gimbal's x and z axes, at l and L,
and the wheel starts at the angle zero. Friction is zero, and nothing is limited.
"""

import numpy as np
from Basilisk.architecture import messaging
from Basilisk.simulation import vscmgStateEffector

import with_basilisk
from with_basilisk import column

VERSION = with_basilisk.VERSION
OFF = -1.0


class Run(with_basilisk.Run):
    """The simulation, started, and all its objects kept alive."""

    states = {
        **with_basilisk.HUB_STATES,
        "gamma": "VSCMGGammas",
        "gamma_dot": "VSCMGGammaDots",
        "theta": "VSCMGThetas",
        "spin": "VSCMGOmegas",
    }

    def attached(self, craft):
        self.configs = [gyro(given) for given in craft["gyros"]]
        effector = vscmgStateEffector.VSCMGStateEffector()
        for config in self.configs:
            effector.AddVSCMG(config)
        torques = messaging.VSCMGArrayTorqueMsgPayload()
        torques.gimbalTorque = [given["u_g"] for given in craft["gyros"]]
        torques.wheelTorque = [given["u_w"] for given in craft["gyros"]]
        self.torques = messaging.VSCMGArrayTorqueMsg().write(torques)
        effector.cmdsInMsg.subscribeTo(self.torques)
        return effector


def samples(craft):
    """The state at the start and after every so many steps."""
    return with_basilisk.samples_of(Run(craft), craft)


def gyro(given):
    made = messaging.VSCMGConfigMsgPayload()
    axes = np.array(given["mount"])
    made.gsHat0_B, made.gtHat0_B, made.ggHat_B = (column(axes[:, k]) for k in range(3))
    made.rGB_B = column(given["r_g_b"])
    made.massG, made.rGcG_G = given["m_g"], column(given["r_gc_g"])
    made.IG1, made.IG12, made.IG13, made.IG2, made.IG23, made.IG3 = given["i_g_gc"]
    made.massW, (made.l, made.L) = given["m_w"], given["l_g_xz"]
    made.IW1, made.IW2, made.IW3 = given["i_w_wc"]
    made.U_s, made.U_d = given["u_s"], given["u_d"]
    made.gamma, made.gammaDot, made.Omega = given["gamma"], given["gamma_dot"], given["spin"]
    made.u_s_max = made.u_s_min = made.u_g_max = made.u_g_min = OFF
    made.Omega_max = made.gammaDot_max = OFF
    made.wheelLinearFrictionRatio = made.gimbalLinearFrictionRatio = OFF
    made.VSCMGModel = vscmgStateEffector.vscmgJitterFullyCoupled
    return made
