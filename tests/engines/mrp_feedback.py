"""Writes tests/fixtures/mrp_feedback.json: torques of Basilisk's `mrpFeedback`.

    python mrp_feedback.py           evaluates the law in every state; writes its torques
    python mrp_feedback.py --check   the same, compared with the stored file; writes nothing

Three samples at 0, 0.5 and 1 s, the inputs the same; the torque is that of the third. The module takes a previous
time of zero for none, so that its integral has grown by one interval of 0.5 s only.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import random
import sys
from pathlib import Path

MISSING = 77
FIXTURE = Path(__file__).resolve().parent.parent / "fixtures" / "mrp_feedback.json"
# Of the largest torque, against what it gave before: another version or processor may order its sums anew.
REPRODUCTION = 1e-13
CASES, WHEELS = 24, 3
PERIOD = 0.5

try:
    from Basilisk.architecture import messaging
    from Basilisk.fswAlgorithms import mrpFeedback
    from Basilisk.utilities import SimulationBaseClass
    from fixture import lines
    from with_basilisk import VERSION
except ModuleNotFoundError as error:
    if error.name not in ("Basilisk", "numpy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)


def drawn(seed):
    """Gains, errors and wheels. A third each: no integral; an integral with either compensation."""
    chance = random.Random(seed)

    def numbers(count, lower, upper):
        return [chance.uniform(lower, upper) for _ in range(count)]

    def unit():
        x = numbers(3, -1.0, 1.0)
        size = sum(value * value for value in x) ** 0.5
        return [value / size for value in x]

    a, b, c = numbers(3, -20.0, 20.0)
    d, e, f = numbers(3, 100.0, 300.0)
    return {
        "attitude_gain": chance.uniform(1.0, 5.0),
        "rate_gain": chance.uniform(10.0, 30.0),
        "integral_gain": chance.uniform(0.001, 0.01) if seed % 3 else 0.0,
        "integral_limit": 1.0 if seed % 2 else 0.2,
        # 0: omega_rn (+ K_I z) x H; 1: omega_bn x H.
        "law": (seed // 3 % 2, 0, 1)[seed % 3],
        "inertia": [[d, a, b], [a, e, c], [b, c, f]],
        "sigma": numbers(3, -0.5, 0.5),
        "omega_br": numbers(3, -0.1, 0.1),
        "omega_rn": numbers(3, -0.1, 0.1),
        "omega_rn_dot": numbers(3, -0.02, 0.02),
        "external": numbers(3, -0.1, 0.1),
        "wheels": [
            {"axis": unit(), "inertia": chance.uniform(0.05, 0.2), "spin": chance.uniform(-400, 400)}
            for _ in range(WHEELS)
        ],
    }


def commanded(given):
    """The torque of the law on the spacecraft."""
    sim = SimulationBaseClass.SimBaseClass()
    step = int(PERIOD * 1e9)
    sim.CreateNewProcess("process").addTask(sim.CreateNewTask("task", step))
    law = mrpFeedback.mrpFeedback()
    law.K, law.P = given["attitude_gain"], given["rate_gain"]
    law.Ki = given["integral_gain"] or -1.0
    law.integralLimit = given["integral_limit"]
    law.controlLawType = given["law"]
    law.knownTorquePntB_B = given["external"]
    vehicle = messaging.VehicleConfigMsgPayload()
    vehicle.ISCPntB_B = [value for row in given["inertia"] for value in row]
    guidance = messaging.AttGuidMsgPayload()
    guidance.sigma_BR = given["sigma"]
    guidance.omega_BR_B = given["omega_br"]
    guidance.omega_RN_B = given["omega_rn"]
    guidance.domega_RN_B = given["omega_rn_dot"]
    wheels = messaging.RWArrayConfigMsgPayload()
    wheels.numRW = WHEELS
    wheels.GsMatrix_B = [value for wheel in given["wheels"] for value in wheel["axis"]]
    wheels.JsList = [wheel["inertia"] for wheel in given["wheels"]]
    speeds = messaging.RWSpeedMsgPayload()
    speeds.wheelSpeeds = [wheel["spin"] for wheel in given["wheels"]]
    kept = [
        messaging.VehicleConfigMsg().write(vehicle),
        messaging.AttGuidMsg().write(guidance),
        messaging.RWArrayConfigMsg().write(wheels),
        messaging.RWSpeedMsg().write(speeds),
    ]
    inputs = [law.vehConfigInMsg, law.guidInMsg, law.rwParamsInMsg, law.rwSpeedsInMsg]
    for message, written in zip(inputs, kept, strict=True):
        message.subscribeTo(written)
    found = law.cmdTorqueOutMsg.recorder()
    sim.AddModelToTask("task", law)
    sim.AddModelToTask("task", found)
    sim.InitializeSimulation()
    sim.ConfigureStopTime(2 * step)
    sim.ExecuteSimulation()
    if len(found.torqueRequestBody) != 3:
        sys.exit(f"{len(found.torqueRequestBody)} samples instead of 3")
    return [float(value) for value in found.torqueRequestBody[-1]]


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    cases = [{**given, "torque": commanded(given)} for given in map(drawn, range(CASES))]
    if not check:
        document = {"basilisk": VERSION, "period": PERIOD, "cases": cases}
        FIXTURE.write_text(lines(document) + "\n", encoding="utf-8")
        print(f"wrote {FIXTURE.name}")
        return
    worst = 0.0
    stored = json.loads(FIXTURE.read_text(encoding="utf-8"))["cases"]
    for new, old in zip(cases, stored, strict=True):
        torque, before = new.pop("torque"), old.pop("torque")
        if new != old:
            sys.exit("the stored inputs are not those of the seeds; run mrp_feedback.py")
        size = max(map(abs, before))
        worst = max([worst, *(abs(a - b) / size for a, b in zip(torque, before, strict=True))])
    print(f"basilisk {VERSION} against {FIXTURE.name}: worst {worst:.1e} of the torque")
    if worst > REPRODUCTION:
        sys.exit(f"more than {REPRODUCTION:g}")


if __name__ == "__main__":
    main()
