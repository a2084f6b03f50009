"""Spacecraft with the effector of flight/basilisk in Basilisk, steps by its RK4."""

import math
import struct
import time
from pathlib import Path

import gyros_with_basilisk
import numpy as np
import with_basilisk
from Basilisk.architecture import messaging
from Basilisk.simulation import gravityEffector, hingedRigidBodyStateEffector, spacecraft
from Basilisk.utilities import SimulationBaseClass
from parameter_table import reaction_wheel, write
from precessStateEffector import PrecessStateEffector
from scenario import scenario
from with_basilisk import column

EARTH = 3.986004415e14
STEP = 1e-3


class Recorded:
    """A run of ours: samples by quantity, joints in order."""

    def __init__(self, result):
        names, self.samples = list(result["columns"]), result["samples"]
        joints = [name for name in names[: names.index("energy")] if "." in name]
        # Coordinate, rate, acceleration, torque of each.
        self.joints = [joints[first : first + 4] for first in range(0, len(joints), 4)]
        self.index = {name: at for at, name in enumerate(names)}

    def of(self, *names):
        return self.samples[:, [self.index[name] for name in names]]


class Run:
    """A spacecraft with some effectors, all objects kept alive; one in the task updates before it."""

    def __init__(self, craft, effectors, step=STEP):
        self.nanoseconds = round(step * 1e9)
        self.sim = SimulationBaseClass.SimBaseClass()
        self.sim.CreateNewProcess("process").addTask(self.sim.CreateNewTask("task", self.nanoseconds))
        self.spacecraft, self.effectors = craft, effectors
        for effector in effectors:
            craft.addStateEffector(effector)
            self.sim.AddModelToTask("task", effector)
        self.sim.AddModelToTask("task", craft)
        self.sim.InitializeSimulation()

    def until(self, steps):
        self.sim.ConfigureStopTime(steps * self.nanoseconds)
        self.sim.ExecuteSimulation()

    def read(self, name):
        return np.ravel(self.spacecraft.dynManager.getStateObject(name).getState())

    def set(self, name, values):
        self.spacecraft.dynManager.getStateObject(name).setState(column(values))


def hub_of(table):
    """Of the table: in Basilisk the hub is its own."""
    numbers = struct.unpack("<13d", Path(table).read_bytes()[16:120])
    made = spacecraft.Spacecraft()
    made.hub.mHub, made.hub.r_BcB_B = numbers[0], column(numbers[1:4])
    made.hub.IHubPntBc_B = np.reshape(numbers[4:], (3, 3)).tolist()
    return made


def effector_of(table):
    made = PrecessStateEffector()
    made.readTable(table)
    devices = range(made.deviceCount())
    return made, [(device, joint) for device in devices for joint in range(made.jointCount(device))]


def difference_from(ours, table):
    """The largest difference of each quantity and joint at every sample of ours, of its largest value."""
    effector, joints = effector_of(table)
    first = [ours.of(*names)[0] for names in ours.joints]
    for (device, joint), (coordinate, rate, *_) in zip(joints, first, strict=True):
        effector.setJoint(device, joint, coordinate, rate)
    payload = messaging.ArrayMotorTorqueMsgPayload()
    payload.motorTorque = [float(torque) for *_, torque in first]
    torques = messaging.ArrayMotorTorqueMsg().write(payload)
    effector.motorTorqueInMsg.subscribeTo(torques)
    run = Run(hub_of(table), [effector])
    blocks = {"hubOmega": "omega_{}", "hubPosition": "position_{}", "hubVelocity": "velocity_{}"}
    expected = {name: ours.of(*[of.format(axis) for axis in "xyz"]) for name, of in blocks.items() if of.format("x") in ours.index}
    expected["hubSigma"] = ours.of("sigma_1", "sigma_2", "sigma_3")
    for name, values in expected.items():
        run.set(name, values[0])
    coordinates, rates = (ours.of(*[names[k] for names in ours.joints]) for k in (0, 1))
    errors = {name: 0.0 for name in expected} | {name: 0.0 for names in ours.joints for name in names[:2]}
    for sample, at in enumerate(ours.of("time")[:, 0]):
        run.until(round(at / STEP))
        for name, values in expected.items():
            errors[name] = max(errors[name], np.max(np.abs(run.read(name) - values[sample])))
        found, found_rates = np.split(run.read(effector.nameOfJointsState), 2)
        turned = found - coordinates[sample]
        # Angles of ours may be wrapped.
        turned = np.where(np.abs(turned) > 1.0, (turned + math.pi) % (2.0 * math.pi) - math.pi, turned)
        moved = found_rates - rates[sample]
        for names, x, x_dot in zip(ours.joints, turned, moved, strict=True):
            errors[names[0]] = max(errors[names[0]], abs(x))
            errors[names[1]] = max(errors[names[1]], abs(x_dot))
    sizes = {name: np.max(np.abs(values)) for name, values in expected.items()}
    sizes |= {name: np.max(np.abs(ours.of(name))) for names in ours.joints for name in names[:2]}
    # What is rounding of zero: an axis that does not move, of a platform that does.
    return {name: float(error / max(sizes[name], 1e-9)) for name, error in errors.items()}


def in_orbit_run(craft, table):
    """Hub and wheels of `wheels.py` in a low orbit about the Earth; by Basilisk's effector, or by ours from a table."""
    made = with_basilisk.hub(craft)
    made.hub.r_CN_NInit, made.hub.v_CN_NInit = column([7e6, 1e5, -2e5]), column([300.0, 7.2e3, 1.9e3])
    body = gravityEffector.GravBodyData()
    body.planetName, body.mu, body.isCentralBody = "earth", EARTH, True
    made.gravField.gravBodies = spacecraft.GravBodyVector([body])
    if table is None:
        # Its own class adds the effector in its way.
        effector = with_basilisk.Run.attached(keep := Keep(), craft)
        run = Run(made, [effector])
        run.keep = keep
        return run
    configs = [with_basilisk.wheel(given) for given in craft["wheels"]]
    write(table, [reaction_wheel(config) for config in configs])
    effector, _ = effector_of(table)
    for device, given in enumerate(craft["wheels"]):
        effector.setJoint(device, 0, 0.0, given["spin"])
    payload = messaging.ArrayMotorTorqueMsgPayload()
    payload.motorTorque = [given["u_w"] for given in craft["wheels"]]
    torques = messaging.ArrayMotorTorqueMsg().write(payload)
    effector.motorTorqueInMsg.subscribeTo(torques)
    run = Run(made, [effector])
    run.keep = torques
    return run


class Keep:
    """What messages and configurations are kept in."""


def in_orbit(craft, table):
    run = in_orbit_run(craft, table)
    run.until(craft["steps"])
    if table is None:
        joints = [run.read("reactionWheelThetas"), run.read("reactionWheelOmegas")]
    else:
        joints = np.split(run.read(run.effectors[0].nameOfJointsState), 2)
    hub = {name: run.read(of) for name, of in with_basilisk.HUB_STATES.items()}
    return {"states": {**hub, "theta": joints[0], "spin": joints[1]}}


def times(craft, table, repeats=60, steps=200):
    """Seconds a step of the spacecraft: alone, with Basilisk's wheels, with ours; the least of runs that take turns."""
    bare = with_basilisk.hub(craft)
    runs = {"hub": Run(bare, []), "basilisk": in_orbit_run(craft, None), "precess": in_orbit_run(craft, table)}
    least = dict.fromkeys(runs, math.inf)
    for repeat in range(1, repeats + 1):
        for name, run in runs.items():
            start = time.perf_counter()
            run.until(repeat * steps)
            least[name] = min(least[name], (time.perf_counter() - start) / steps)
    return least


def of_configurations(craft):
    """Wheels and gyros by Basilisk's own effectors, and the scenario of their configurations."""
    made = with_basilisk.hub(craft)
    made.hub.v_CN_NInit = column([0.0] * 3)
    keep = [Keep(), Keep()]
    own = [of.Run.attached(kept, craft) for of, kept in zip((with_basilisk, gyros_with_basilisk), keep, strict=True)]
    run = Run(made, own)
    run.keep = keep
    return run, scenario("configured", made.hub, keep[0].configs, keep[1].configs)


def drift_with_panel(table, seconds=10):
    """Drift of energy and momenta of a free spacecraft, motors off, with our devices and a panel of Basilisk."""
    effector, joints = effector_of(table)
    for (device, joint), rate in zip(joints, (0.05, -0.04, 52.0), strict=True):
        effector.setJoint(device, joint, 0.2, rate)
    panel = hingedRigidBodyStateEffector.HingedRigidBodyStateEffector()
    panel.mass, panel.d, panel.k, panel.c = 40.0, 1.2, 90.0, 0.0
    panel.IPntS_S = [[20.0, 0.0, 0.0], [0.0, 12.0, 0.0], [0.0, 0.0, 15.0]]
    panel.r_HB_B, panel.dcm_HB = column([0.5, 0.0, 1.0]), np.eye(3).tolist()
    panel.thetaInit, panel.thetaDotInit = 0.1, 0.02
    made = hub_of(table)
    made.hub.omega_BN_BInit, made.hub.v_CN_NInit = column([0.05, -0.03, 0.02]), column([0.3, -0.2, 0.1])
    made.hub.r_CN_NInit = column([2.0, 1.0, -3.0])
    step = 0.5 * STEP
    run = Run(made, [effector, panel], step)
    log = {name: [] for name in ("totOrbEnergy", "totRotEnergy", "totOrbAngMomPntN_N", "totRotAngMomPntC_N")}
    for steps in range(1, round(seconds / step) + 1, 200):
        run.until(steps)
        for name, values in log.items():
            values.append(np.ravel(getattr(made, name)))
    return {name: float(np.max(np.abs(np.array(of) - of[0])) / np.max(np.abs(of))) for name, of in log.items()}


def messages(bad, good):
    """What Basilisk raises for a table with a changed byte, none, a joint that is none, two messages, no table."""

    def two_messages():
        effector, _ = effector_of(good)
        motors, gyros = messaging.ArrayMotorTorqueMsg(), messaging.VSCMGArrayTorqueMsg()
        effector.motorTorqueInMsg.subscribeTo(motors)
        effector.vscmgTorqueInMsg.subscribeTo(gyros)
        effector.Reset(0)

    calls = [
        lambda: effector_of(bad),
        lambda: effector_of(bad + ".none"),
        lambda: effector_of(good)[0].setJoint(4, 0, 0.0, 0.0),
        two_messages,
        lambda: PrecessStateEffector().Reset(0),
    ]
    found = []
    for call in calls:
        try:
            call()
        except Exception as error:  # noqa: BLE001: Basilisk's own class is of each module
            found.append(str(error))
        else:
            found.append("nothing was raised")
    return found
