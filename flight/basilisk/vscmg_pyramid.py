"""Four imbalanced VSCMGs of Precess on a Basilisk hub, steered to rest by Basilisk's `vscmgVelocitySteering`.

    python flight/basilisk/vscmg_pyramid.py

Navigation, tracking error, `mrpFeedback`, steering and `vscmgGimbalRateServo` are Basilisk's, ten times a second. The gyros are
Precess's, fully coupled, with the imbalance of a catalogue wheel, by RK4 in steps of a millisecond. Prints attitude, rate, the
momentum of the spacecraft and its drift, and the vibration that the imbalance leaves.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "target" / "basilisk"), str(HERE)]

from Basilisk.architecture import messaging  # noqa: E402
from Basilisk.fswAlgorithms import (  # noqa: E402
    attTrackingError,
    inertial3D,
    mrpFeedback,
    vscmgGimbalRateServo,
    vscmgVelocitySteering,
)
from Basilisk.simulation import simpleNav, spacecraft, vscmgStateEffector  # noqa: E402
from Basilisk.utilities import SimulationBaseClass  # noqa: E402
from parameter_table import vscmg, write  # noqa: E402
from precessStateEffector import PrecessStateEffector  # noqa: E402

DYNAMICS, CONTROL, SECONDS = 1_000_000, 100_000_000, 120
WHEEL_RATE = 400.0
INERTIA = np.diag([80.0, 75.0, 60.0])


def main():
    sim = SimulationBaseClass.SimBaseClass()
    process = sim.CreateNewProcess("process")
    process.addTask(sim.CreateNewTask("control", CONTROL))
    process.addTask(sim.CreateNewTask("dynamics", DYNAMICS))
    gyros = [gyro(number) for number in range(4)]
    craft, effector = plant(gyros)
    modules = control(craft, effector, gyros)
    for module in modules:
        sim.AddModelToTask("control", module)
    for module in (effector, craft):
        sim.AddModelToTask("dynamics", module)
    sim.InitializeSimulation()
    print("time, s   |sigma|     |omega|, rad/s  momentum, N m s  gimbal angles, rad")
    first, fast = None, []
    for second in range(SECONDS + 1):
        sim.ConfigureStopTime(second * 1_000_000_000 + DYNAMICS)
        sim.ExecuteSimulation()
        state = craft.scStateOutMsg.read()
        momentum = np.ravel(craft.totRotAngMomPntC_N)
        first = momentum if first is None else first
        if second % 20 == 0:
            angles = [effector.coordinate(number, 0) for number in range(4)]
            sigma, omega = np.linalg.norm(state.sigma_BN), np.linalg.norm(state.omega_BN_B)
            values = " ".join(f"{angle:7.3f}" for angle in angles)
            print(f"{second:7d}   {sigma:.3e}   {omega:.3e}       {np.linalg.norm(momentum):.9f}     {values}")
    for _ in range(1000):
        sim.ConfigureStopTime(sim.TotalSim.CurrentNanos + DYNAMICS)
        sim.ExecuteSimulation()
        fast.append(craft.scStateOutMsg.read().omega_BN_B)
    vibration = np.max(np.std(np.array(fast), axis=0))
    drift = np.linalg.norm(momentum - first) / (gyros[0].IW1 * WHEEL_RATE)
    print(f"momentum drifts by {drift:.1e} of a wheel's; the hub vibrates by {vibration:.1e} rad/s, rms, at {WHEEL_RATE / 6.283185307:.1f} Hz")
    settled = np.linalg.norm(state.sigma_BN) < 5e-3
    sys.exit(0 if settled and drift < 1e-5 and vibration > 0.0 else "the spacecraft is not at rest")


def gyro(number):
    """One of a pyramid: a configuration of Basilisk's own effector."""
    made = messaging.VSCMGConfigMsgPayload()
    around, slope = number * np.pi / 2.0, np.deg2rad(54.75)
    radial = np.array([np.cos(around), np.sin(around), 0.0])
    gimbal = np.sin(slope) * radial + np.cos(slope) * np.array([0.0, 0.0, 1.0])
    spin = np.cross([0.0, 0.0, 1.0], radial)
    made.gsHat0_B, made.gtHat0_B, made.ggHat_B = (column(axis) for axis in (spin, np.cross(gimbal, spin), gimbal))
    made.rGB_B = column(0.3 * radial)
    made.massG, made.rGcG_G = 2.0, column([0.0, 0.001, 0.0])
    made.IG1, made.IG2, made.IG3 = 0.02, 0.015, 0.02
    made.massW, made.l, made.L = 4.0, 0.0, 0.0
    made.IW1, made.IW2, made.IW3 = 0.03, 0.016, 0.016
    # 32 g cm and 15.4 g cm^2.
    made.U_s, made.U_d = 3.2e-4, 1.54e-6
    made.gamma, made.gammaDot, made.Omega = 0.0, 0.0, WHEEL_RATE
    made.VSCMGModel = vscmgStateEffector.vscmgJitterFullyCoupled
    return made


def plant(gyros):
    craft = spacecraft.Spacecraft()
    craft.ModelTag = "craft"
    craft.hub.mHub, craft.hub.r_BcB_B = 300.0, column([0.0, 0.0, 0.0])
    craft.hub.IHubPntBc_B = INERTIA.tolist()
    craft.hub.sigma_BNInit, craft.hub.omega_BN_BInit = column([0.1, -0.15, 0.2]), column([0.004, -0.006, 0.003])
    effector = PrecessStateEffector()
    effector.ModelTag = "gyros"
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "gyros.table")
        write(path, [vscmg(config) for config in gyros])
        effector.readTable(path)
    for number, config in enumerate(gyros):
        effector.setJoint(number, 0, config.gamma, config.gammaDot)
        effector.setJoint(number, 1, 0.0, config.Omega)
    craft.addStateEffector(effector)
    return craft, effector


def control(craft, effector, gyros):
    """Basilisk's flight software, in the order in which it runs."""
    nav, reference, error = simpleNav.SimpleNav(), inertial3D.inertial3D(), attTrackingError.attTrackingError()
    law, steering = mrpFeedback.mrpFeedback(), vscmgVelocitySteering.VscmgVelocitySteering()
    servo = vscmgGimbalRateServo.VscmgGimbalRateServo()
    modules = [nav, reference, error, law, steering, servo]
    for number, module in enumerate(modules):
        module.ModelTag = f"module{number}"
    nav.scStateInMsg.subscribeTo(craft.scStateOutMsg)
    reference.sigma_R0N = [0.0, 0.0, 0.0]
    error.attNavInMsg.subscribeTo(nav.attOutMsg)
    error.attRefInMsg.subscribeTo(reference.attRefOutMsg)
    law.K, law.P, law.Ki = 4.0, 30.0, -1.0
    law.guidInMsg.subscribeTo(error.attGuidOutMsg)
    vehicle = messaging.VehicleConfigMsgPayload()
    vehicle.ISCPntB_B = INERTIA.ravel().tolist()
    law.vehConfigInMsg.subscribeTo(kept(messaging.VehicleConfigMsg().write(vehicle)))
    array = kept(messaging.VSCMGArrayConfigMsg().write(configuration(gyros)))
    steering.setW_g([1e3] * 4)
    steering.setW0_s([1.0] * 4)
    steering.setMu(1e-9)
    steering.vscmgParamsInMsg.subscribeTo(array)
    steering.vehControlInMsg.subscribeTo(law.cmdTorqueOutMsg)
    steering.attGuideInMsg.subscribeTo(error.attGuidOutMsg)
    steering.attNavInMsg.subscribeTo(nav.attOutMsg)
    steering.speedsInMsg.subscribeTo(effector.vscmgSpeedOutMsg)
    servo.setK_gammaDot(2.0)
    servo.vsmcgParamsInMsg.subscribeTo(array)
    servo.vscmgRefStatesInMsg.subscribeTo(steering.vscmgRefStatesOutMsg)
    servo.attInMsg.subscribeTo(nav.attOutMsg)
    servo.speedsInMsg.subscribeTo(effector.vscmgSpeedOutMsg)
    effector.vscmgTorqueInMsg.subscribeTo(servo.cmdsOutMsg)
    return modules


KEPT = []


def kept(message):
    """Messages live as long as somebody in Python has them."""
    KEPT.append(message)
    return message


def configuration(gyros):
    """The cluster as law and servo know it: balanced."""
    made = messaging.VSCMGArrayConfigMsgPayload()
    made.numVSCMG = len(gyros)
    made.IwsList = [of.IW1 for of in gyros]
    made.JsList = [of.IG1 + of.IW1 for of in gyros]
    made.JtList = [of.IG2 + of.IW2 for of in gyros]
    made.JgList = [of.IG3 + of.IW3 for of in gyros]
    made.Omega0List = [of.Omega for of in gyros]
    made.gamma0List, made.gammaDot0List = [0.0] * len(gyros), [0.0] * len(gyros)
    for name, axis in (("Gs0Matrix_B", "gsHat0_B"), ("Gt0Matrix_B", "gtHat0_B"), ("GgMatrix_B", "ggHat_B")):
        setattr(made, name, [float(x[0]) for of in gyros for x in getattr(of, axis)])
    return made


def column(values):
    return [[float(x)] for x in values]


if __name__ == "__main__":
    main()
