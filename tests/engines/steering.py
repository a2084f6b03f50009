"""Writes tests/fixtures/steering.json: VSCMG steering by Basilisk's `vscmgVelocitySteering`.

    python steering.py           evaluates the law in every state; writes its commands
    python steering.py --check   the same, compared with the stored file; writes nothing

Basilisk's law divides the rate of the inertia between two terms, for the control law of Schaub, Vadali and Junkins:
with a reference that turns as the hub does they are whole again, and the law is the plain weighted inverse.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import random
import sys
from pathlib import Path

MISSING = 77
FIXTURE = Path(__file__).resolve().parent.parent / "fixtures" / "steering.json"
# Of the largest command, against what it gave before: another version or processor may order its sums anew.
REPRODUCTION = 1e-11
CASES, GYROS = 20, 4

try:
    import numpy as np
    from Basilisk.architecture import messaging
    from Basilisk.fswAlgorithms import vscmgVelocitySteering
    from Basilisk.utilities import SimulationBaseClass
    from fixture import lines
    from with_basilisk import VERSION
except ModuleNotFoundError as error:
    if error.name not in ("Basilisk", "numpy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)


def drawn(seed):
    """A cluster in a state, and the torque that the law is to give."""
    chance = random.Random(seed)

    def numbers(count, lower, upper):
        return [chance.uniform(lower, upper) for _ in range(count)]

    def mount():
        w, x, y, z = numbers(4, -1.0, 1.0)
        size = (w * w + x * x + y * y + z * z) ** 0.5
        w, x, y, z = w / size, x / size, y / size, z / size
        return [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]

    return {
        "omega": numbers(3, -0.3, 0.3),
        "torque": numbers(3, -1.0, 1.0),
        "weights": [chance.uniform(0.5, 2.0), chance.uniform(0.5, 2.0)],
        "gyros": [
            {
                "mount": mount(),
                "i_g": numbers(3, 0.02, 0.05),
                "i_w": numbers(2, 0.05, 0.1),
                "gamma": chance.uniform(-3.0, 3.0),
                "gamma_dot": chance.uniform(-0.5, 0.5),
                "spin": chance.uniform(100.0, 400.0),
            }
            for _ in range(GYROS)
        ],
    }


def commanded(given):
    """Wheel accelerations and gimbal rates of the law."""
    sim = SimulationBaseClass.SimBaseClass()
    sim.CreateNewProcess("process").addTask(sim.CreateNewTask("task", 10**9))
    law = vscmgVelocitySteering.VscmgVelocitySteering()
    gimbal, wheel = given["weights"]
    law.setW_g([gimbal] * GYROS)
    law.setW0_s([wheel] * GYROS)
    law.setMu(0.0)
    gyros = given["gyros"]
    config = messaging.VSCMGArrayConfigMsgPayload()
    config.numVSCMG = GYROS
    config.IwsList = [gyro["i_w"][0] for gyro in gyros]
    config.JsList = [gyro["i_g"][0] + gyro["i_w"][0] for gyro in gyros]
    config.JtList = [gyro["i_g"][1] + gyro["i_w"][1] for gyro in gyros]
    config.JgList = [gyro["i_g"][2] + gyro["i_w"][1] for gyro in gyros]
    config.Omega0List = [gyro["spin"] for gyro in gyros]
    config.gamma0List = [0.0] * GYROS
    config.gammaDot0List = [0.0] * GYROS
    for axis, name in enumerate(("Gs0Matrix_B", "Gt0Matrix_B", "GgMatrix_B")):
        setattr(config, name, [row[axis] for gyro in gyros for row in gyro["mount"]])
    speeds = messaging.VSCMGSpeedMsgPayload()
    speeds.wheelSpeeds = [gyro["spin"] for gyro in gyros]
    speeds.gimbalAngles = [gyro["gamma"] for gyro in gyros]
    speeds.gimbalRates = [gyro["gamma_dot"] for gyro in gyros]
    guidance = messaging.AttGuidMsgPayload()
    guidance.omega_RN_B = given["omega"]
    attitude = messaging.NavAttMsgPayload()
    attitude.omega_BN_B = given["omega"]
    torque = messaging.CmdTorqueBodyMsgPayload()
    # On the hub: the law commands the opposite of the devices.
    torque.torqueRequestBody = given["torque"]
    kept = [
        messaging.VSCMGArrayConfigMsg().write(config),
        messaging.VSCMGSpeedMsg().write(speeds),
        messaging.AttGuidMsg().write(guidance),
        messaging.NavAttMsg().write(attitude),
        messaging.CmdTorqueBodyMsg().write(torque),
    ]
    inputs = [law.vscmgParamsInMsg, law.speedsInMsg, law.attGuideInMsg, law.attNavInMsg]
    for message, written in zip([*inputs, law.vehControlInMsg], kept):
        message.subscribeTo(written)
    found = law.vscmgRefStatesOutMsg.recorder()
    sim.AddModelToTask("task", law)
    sim.AddModelToTask("task", found)
    sim.InitializeSimulation()
    sim.ConfigureStopTime(0)
    sim.ExecuteSimulation()
    return {
        "spin_dot": [float(x) for x in np.array(found.wheelAccels)[0, :GYROS]],
        "gamma_dot": [float(x) for x in np.array(found.gimbalRates)[0, :GYROS]],
    }


def inputs(case):
    return {**case, "commands": None}


def commands(case):
    return np.array(case["commands"]["spin_dot"] + case["commands"]["gamma_dot"])


def compared(found, stored):
    """The worst difference, of the largest command of its state; ends the program where it is too large."""
    if [inputs(case) for case in found] != [inputs(case) for case in stored]:
        sys.exit(f"{FIXTURE.name} has other states; run steering.py")
    pairs = [(commands(case), commands(before)) for case, before in zip(found, stored, strict=True)]
    worst = float(np.max([abs(now - then).max() / abs(then).max() for now, then in pairs]))
    # Not below where it is not a number.
    if not worst <= REPRODUCTION:
        sys.exit(f"{FIXTURE.name}: differs by {worst:.1e} of the largest command, more than {REPRODUCTION:.0e}")
    return worst


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    cases = []
    for seed in range(CASES):
        given = drawn(seed)
        cases.append({**given, "commands": commanded(given)})
    if not check:
        FIXTURE.write_text(lines({"basilisk": VERSION, "cases": cases}) + "\n", encoding="utf-8")
        print(f"wrote {FIXTURE.name}")
    elif not FIXTURE.exists():
        sys.exit(f"{FIXTURE} is missing; run steering.py")
    else:
        stored = json.loads(FIXTURE.read_text(encoding="utf-8"))["cases"]
        print(f"Basilisk {VERSION} against {FIXTURE.name}: worst {compared(cases, stored):.1e} of the largest command")


if __name__ == "__main__":
    main()
