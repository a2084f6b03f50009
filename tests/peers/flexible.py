"""Four imbalanced reaction wheels in a pyramid: on a rigid hub, on flexible bearings, on an isolated platform,
on a flexible structure. What that costs is compared with the rigid hub, and the first three with MuJoCo.

Listed as in `listed.py`, with the stiffness and damping of each joint. A platform stands below the devices, and its
joints come first. `modes` is how many modes the structure has, whose shapes the measuring program makes up. Of the
same numbers in a row, `angles`, `rates` and `motors`, MuJoCo's runner starts.
"""

import math

import mujoco
import numpy as np
import runs
from with_mujoco import full

SLIDE, HINGE = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
WHEEL = [(HINGE, 0)]
# On bearings: slides along x, y and z, tilts about y and z, spin about x.
SOFT = [(SLIDE, 0), (SLIDE, 1), (SLIDE, 2), (HINGE, 1), (HINGE, 2), (HINGE, 0)]
PLATFORM = [(SLIDE, 0), (SLIDE, 1), (SLIDE, 2), (HINGE, 0), (HINGE, 1), (HINGE, 2)]
JOINTS = {"reaction_wheel": WHEEL, "flexible_reaction_wheel": SOFT, "platform": PLATFORM}

MODES = [6, 20, 200]

# Of a wheel: mass, inertia about and across its axis, static imbalance over mass, dynamic imbalance.
MASS, AXIAL, ACROSS, OFFSET, U_D = 6.0, 0.0191, 0.0114, 5e-5, 4e-6
# What MuJoCo subtracts in the equations of a tilt grows with the square of the spin: these and tilts of a
# milliradian keep its rounding within the bound of agreement.
SPINS = [100.0, -80.0, 60.0, -110.0]
MOTORS = [0.02, -0.01, 0.03, 0.015]
MOUNTS = [(3, 1, -2, 1), (2, -1, 1, 3), (1, 2, 1, -1), (4, 1, 3, -2)]
PLACES = [[0.3, 0.3, -0.2], [-0.3, 0.3, -0.2], [-0.3, -0.3, -0.2], [0.3, -0.3, -0.2]]


def all_cases():
    """Name and spacecraft of each."""
    yield "rigid", craft([wheel(k) for k in range(4)])
    yield "bearings", craft([on_bearings(k) for k in range(4)])
    yield "platform", craft([platform(), *(wheel(k) for k in range(4))])
    for modes in MODES:
        yield f"modes-{modes}", {**craft([wheel(k) for k in range(4)]), "modes": modes}


def craft(devices):
    row = {name: [x for one in devices for x in one[of]] for name, of in ROWS.items()}
    return {
        "step": 1e-4,
        "hub": {"mass": 800.0, "centre": [0.02, -0.01, 0.05],
                "inertia": [900.0, 12.0, -8.0, 800.0, 5.0, 600.0]},
        "r_b_n_dot": [0.0] * 3,
        "omega": [0.02, -0.03, 0.01],
        "force": [1.0, -2.0, 0.5],
        "torque_b": [0.3, 0.1, -0.2],
        "devices": devices,
        **row,
    }  # fmt: skip


ROWS = {"angles": "coordinates", "rates": "rates", "motors": "motors"}


def rotor(origin):
    return {"mass": MASS, "origin": origin, "centre": [0.0, OFFSET, 0.0],
            "inertia": [AXIAL, 0.0, U_D, ACROSS, 0.0, ACROSS]}  # fmt: skip


def wheel(k):
    return {
        "kind": "reaction_wheel", "mount": runs.rotation(*MOUNTS[k]), "bodies": [rotor(PLACES[k])],
        "coordinates": [0.3 * k], "rates": [SPINS[k]], "motors": [MOTORS[k]],
        "stiffness": [0.0], "damping": [0.0],
    }  # fmt: skip


def on_bearings(k):
    """Translation at 150 Hz, rocking at 60 Hz of the wheel at rest, one hundredth of critical damping."""
    nothing = {"mass": 0.0, "origin": [0.0] * 3, "centre": [0.0] * 3, "inertia": [0.0] * 6}
    slide, tilt = (
        sprung(inertia, hertz) for inertia, hertz in [(MASS, 150.0), (ACROSS, 60.0)]
    )
    springs = [slide, slide, slide, tilt, tilt, (0.0, 0.0)]
    return {
        "kind": "flexible_reaction_wheel", "mount": runs.rotation(*MOUNTS[k]),
        "bodies": [{**nothing, "origin": PLACES[k]}, *[nothing] * 4, rotor([0.0] * 3)],
        "coordinates": [1e-5, -2e-5, 1.5e-5, 1e-3, -2e-3, 0.3 * k],
        "rates": [1e-4, 2e-4, -1e-4, 1e-3, 2e-3, SPINS[k]],
        "motors": [0.0] * 5 + [MOTORS[k]],
        "stiffness": [k for k, _ in springs], "damping": [c for _, c in springs],
    }  # fmt: skip


def platform():
    """Twenty kilograms on springs of 10 Hz, with a tenth of critical damping."""
    mass, inertia = 20.0, 1.2
    springs = [sprung(mass, 10.0, 0.1)] * 3 + [sprung(inertia, 10.0, 0.1)] * 3
    return {
        "kind": "platform", "mount": runs.rotation(3, 1, -2, 1),
        "bodies": [{"mass": mass, "origin": [0.1, 0.05, 0.4], "centre": [0.0, 0.01, 0.02],
                    "inertia": [inertia, 0.02, -0.01, 1.1, 0.03, 1.5]}],
        "coordinates": [1e-3, -5e-4, 2e-3, 0.01, -0.02, 0.03],
        "rates": [0.01, 0.02, -0.01, 0.1, -0.05, 0.02], "motors": [0.0] * 6,
        "stiffness": [k for k, _ in springs], "damping": [c for _, c in springs],
    }  # fmt: skip


def sprung(inertia, hertz, ratio=0.01):
    """Stiffness and damping."""
    w = 2.0 * math.pi * hertz
    return inertia * w * w, 2.0 * ratio * inertia * w


def model(given):
    """The tree in MuJoCo, with several joints of one body where bodies between them have no mass."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.gravity = [0.0] * 3
    hub = given["hub"]
    base = spec.worldbody.add_body(
        mass=hub["mass"], ipos=hub["centre"], fullinertia=full(hub["inertia"])
    )
    base.explicitinertial = True
    base.add_freejoint()
    for device in given["devices"]:
        first, tip = device["bodies"][0], device["bodies"][-1]
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, np.array(device["mount"]).flatten())
        body = base.add_body(
            pos=first["origin"], quat=quaternion, mass=tip["mass"], ipos=tip["centre"],
            fullinertia=full(tip["inertia"]),
        )  # fmt: skip
        body.explicitinertial = True
        springs = zip(device["stiffness"], device["damping"])
        for (motion, axis), (stiffness, damping) in zip(JOINTS[device["kind"]], springs):
            body.add_joint(
                type=motion, axis=np.eye(3)[axis], stiffness=stiffness, damping=damping
            )  # fmt: skip
        if device["kind"] == "platform":
            base = body
    return spec.compile()
