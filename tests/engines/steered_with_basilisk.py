"""One spacecraft that Basilisk steers: `vscmgVelocitySteering` and `vscmgGimbalRateServo` every few steps, their motor
torques held between, the VSCMGs by its fully coupled effector.

The torque that is demanded is -(K sigma + P omega). The reference turns as the hub does, which makes the two halves of
the rate of the inertia in the law whole. Wheels are balanced and in the origins of their gimbals: the servo knows no others.
"""

from Basilisk.architecture import messaging
from Basilisk.fswAlgorithms import vscmgGimbalRateServo, vscmgVelocitySteering

import gyros_with_basilisk

VERSION = gyros_with_basilisk.VERSION
STATES = gyros_with_basilisk.Run.states
# What the last sample of the controller commanded.
COMMANDS = ("demand", "gimbal_rates", "wheel_accelerations", "gimbal_torques", "wheel_torques")


def samples(craft):
    """The state at the start and after every so many steps, with what is commanded there."""
    run = Run(craft)
    found = []
    for steps in range(0, craft["steps"] + 1, craft["control_every"]):
        run.step_to(steps)
        run.control(craft)
        if steps % craft["every"] == 0:
            found.append(run.state(steps))
    return found


class Run(gyros_with_basilisk.Run):
    """The simulation, started, with law and servo beside it."""

    states = {**STATES, **dict.fromkeys(COMMANDS)}

    def __init__(self, craft):
        super().__init__(craft)
        self.law = Law(craft)

    def control(self, craft):
        """Samples the state, and writes the torques that the effector takes for the steps from here on."""
        now = self.simulated()
        demand = [
            -(craft["stiffness"] * s + craft["damping"] * w) for s, w in zip(now["mrp"], now["omega"], strict=True)
        ]
        self.commands = {"demand": demand, **self.law.commands(now, demand)}
        torques = messaging.VSCMGArrayTorqueMsgPayload()
        torques.gimbalTorque = self.commands["gimbal_torques"]
        torques.wheelTorque = self.commands["wheel_torques"]
        self.torques.write(torques)

    def simulated(self):
        states = self.spacecraft.dynManager
        read = {name: states.getStateObject(of_basilisk).getState() for name, of_basilisk in STATES.items()}
        return {name: [float(row[0]) for row in rows] for name, rows in read.items()}

    def state(self, steps):
        return {"steps": steps, **self.simulated(), **self.commands}


class Law:
    """Both modules and their messages, kept alive."""

    def __init__(self, craft):
        gyros = craft["gyros"]
        self.count = len(gyros)
        self.law = vscmgVelocitySteering.VscmgVelocitySteering()
        gimbal, wheel = craft["weights"]
        self.law.setW_g([gimbal] * self.count)
        self.law.setW0_s([wheel] * self.count)
        self.law.setMu(craft["mu"])
        self.servo = vscmgGimbalRateServo.VscmgGimbalRateServo()
        self.servo.setK_gammaDot(craft["gain"])
        self.config = messaging.VSCMGArrayConfigMsg().write(array(gyros))
        self.speeds = messaging.VSCMGSpeedMsg()
        self.guidance = messaging.AttGuidMsg()
        self.attitude = messaging.NavAttMsg()
        self.torque = messaging.CmdTorqueBodyMsg()
        self.law.vscmgParamsInMsg.subscribeTo(self.config)
        self.law.speedsInMsg.subscribeTo(self.speeds)
        self.law.attGuideInMsg.subscribeTo(self.guidance)
        self.law.attNavInMsg.subscribeTo(self.attitude)
        self.law.vehControlInMsg.subscribeTo(self.torque)
        self.servo.vsmcgParamsInMsg.subscribeTo(self.config)
        self.servo.vscmgRefStatesInMsg.subscribeTo(self.law.vscmgRefStatesOutMsg)
        self.servo.attInMsg.subscribeTo(self.attitude)
        self.servo.speedsInMsg.subscribeTo(self.speeds)
        for module in (self.law, self.servo):
            module.SelfInit()
            module.Reset(0)

    def commands(self, now, demand):
        speeds = messaging.VSCMGSpeedMsgPayload()
        speeds.wheelSpeeds, speeds.gimbalAngles, speeds.gimbalRates = now["spin"], now["gamma"], now["gamma_dot"]
        self.speeds.write(speeds)
        guidance = messaging.AttGuidMsgPayload()
        guidance.omega_RN_B = now["omega"]
        self.guidance.write(guidance)
        attitude = messaging.NavAttMsgPayload()
        attitude.omega_BN_B = now["omega"]
        self.attitude.write(attitude)
        torque = messaging.CmdTorqueBodyMsgPayload()
        # On the hub: the law commands the opposite of the devices.
        torque.torqueRequestBody = demand
        self.torque.write(torque)
        self.law.UpdateState(0)
        self.servo.UpdateState(0)
        commanded, torques = self.law.vscmgRefStatesOutMsg.read(), self.servo.cmdsOutMsg.read()
        return {
            "gimbal_rates": list(commanded.gimbalRates)[: self.count],
            "wheel_accelerations": list(commanded.wheelAccels)[: self.count],
            "gimbal_torques": list(torques.gimbalTorque)[: self.count],
            "wheel_torques": list(torques.wheelTorque)[: self.count],
        }


def array(gyros):
    """The cluster as law and servo know it."""
    config = messaging.VSCMGArrayConfigMsgPayload()
    config.numVSCMG = len(gyros)
    # Moments of the gimbal and, about its transverse axes, of the wheel.
    moments = [[gyro["i_g_gc"][k] for k in (0, 3, 5)] for gyro in gyros]
    wheels = [gyro["i_w_wc"] for gyro in gyros]
    config.IwsList = [wheel[0] for wheel in wheels]
    config.JsList = [of[0] + wheel[0] for of, wheel in zip(moments, wheels, strict=True)]
    config.JtList = [of[1] + wheel[1] for of, wheel in zip(moments, wheels, strict=True)]
    config.JgList = [of[2] + wheel[2] for of, wheel in zip(moments, wheels, strict=True)]
    config.Omega0List = [gyro["spin"] for gyro in gyros]
    config.gamma0List = [0.0] * len(gyros)
    config.gammaDot0List = [0.0] * len(gyros)
    for axis, name in enumerate(("Gs0Matrix_B", "Gt0Matrix_B", "GgMatrix_B")):
        setattr(config, name, [row[axis] for gyro in gyros for row in gyro["mount"]])
    return config
