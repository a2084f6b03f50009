"""The same spacecraft in MuJoCo: a free joint and a chain of three hinges a device.

A free joint's linear velocity and acceleration are along the world's axes and its angular ones
along the body's. B is at the world's origin with its axes along the world's.
"""

import mujoco
import numpy as np

from spacecraft import ENTRIES
from with_pinocchio import joints

VERSION = mujoco.__version__
# MuJoCo's order of the entries of a full inertia: the diagonal first.
FULL_INERTIA = [ENTRIES.index(e) for e in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]]


def evaluate(craft):
    """What the other engine gives, of which accelerations and energy are stored."""
    model = build(craft)
    data = mujoco.MjData(model)
    rates = joints(craft, "rates")
    data.qpos[:] = np.concatenate([[0.0] * 3, [1.0], [0.0] * 3, joints(craft, "angles")])
    data.qvel[:] = np.concatenate([craft["r_b_n_dot"], craft["omega"], rates])
    data.qfrc_applied[:] = np.concatenate(
        [craft["force"], craft["torque_b"], joints(craft, "motors")]
    )
    mujoco.mj_forward(model, data)
    mujoco.mj_subtreeVel(model, data)
    a = data.qacc.copy()
    linear = model.body_subtreemass[1] * data.subtree_linvel[1]
    angular_b = data.subtree_angmom[1] + np.cross(data.subtree_com[1], linear)
    names = ("gamma_o_ddot", "gamma_i_ddot", "spin_dot")
    return {
        "r_b_n_ddot": a[:3].tolist(),
        "omega_dot": a[3:6].tolist(),
        "accelerations": [dict(zip(names, row)) for row in a[6:].reshape(-1, 3).tolist()],
        "energy": float(data.energy[1]),
        "linear": linear.tolist(),
        "angular_b": angular_b.tolist(),
        "bodies": bodies(model, data, rates, a[6:]),
    }


def build(craft):
    """The spacecraft as a MuJoCo model: no gravity, damping, armature, contact or limit."""
    spec = mujoco.MjSpec()
    spec.option.gravity = [0.0, 0.0, 0.0]
    spec.option.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    hub = craft["hub"]
    base = spec.worldbody.add_body(
        name="B", mass=hub["m_b"], ipos=hub["r_bc_b"], fullinertia=full(hub["i_b"])
    )
    base.explicitinertial = True
    base.add_freejoint()
    for number, device in enumerate(craft["devices"]):
        p = device["parameters"]

        def vector(name, axes):
            return np.array([p[f"{name}_{axes}{axis}"] for axis in "xyz"])

        def inertia(name):
            return full([p[f"{name}_{i + 1}{k + 1}"] for i, k in ENTRIES])

        mount = np.array(device["mount"])
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, mount.flatten())
        outer = base.add_body(
            name=f"Go {number}", pos=mount @ vector("r_go_b", "b"), quat=quaternion,
            mass=p["m_go"], ipos=vector("r_goc_go", "go"), fullinertia=inertia("i_go"),
        )
        inner = outer.add_body(
            name=f"Gi {number}", pos=vector("l_o", ""),
            mass=p["m_gi"], ipos=vector("r_gic_gi", "gi"), fullinertia=inertia("i_gi"),
        )
        wheel = inner.add_body(
            name=f"W {number}", pos=vector("l_i", ""),
            mass=p["m_w"], ipos=[0.0, p["d"], 0.0], fullinertia=inertia("j"),
        )  # fmt: skip
        for body, axis in ((outer, [0, 0, 1]), (inner, [0, 1, 0]), (wheel, [1, 0, 0])):
            body.explicitinertial = True
            body.add_joint(type=mujoco.mjtJoint.mjJNT_HINGE, axis=axis)
    return spec.compile()


def bodies(model, data, rates, accelerations):
    """Centre of mass, its derivatives, angular velocity and inertia about B, hub held still."""
    still = np.zeros(6)
    data.qvel[:] = np.concatenate([still, rates])
    mujoco.mj_forward(model, data)
    # Not the accelerations of this motion but the given ones.
    data.qacc[:] = np.concatenate([still, accelerations])
    mujoco.mj_rnePostConstraint(model, data)
    centre = mujoco.mjtObj.mjOBJ_BODY

    def body(number):
        velocity, acceleration = np.zeros(6), np.zeros(6)
        mujoco.mj_objectVelocity(model, data, centre, number, velocity, 0)
        mujoco.mj_objectAcceleration(model, data, centre, number, acceleration, 0)
        r, axes = data.xipos[number], data.ximat[number].reshape(3, 3)
        about_centre = (axes * model.body_inertia[number]) @ axes.T
        about_b = about_centre + model.body_mass[number] * (r @ r * np.eye(3) - np.outer(r, r))
        return {
            "r": r.tolist(),
            "r_prime": velocity[3:].tolist(),
            "r_dprime": acceleration[3:].tolist(),
            "omega_b": velocity[:3].tolist(),
            "i_b": [float(about_b[entry]) for entry in ENTRIES],
        }

    # Body 0 is the world, 1 the hub; then three a device, each after its parent.
    return [[body(first + k) for k in range(3)] for first in chains(model)]


def chains(model):
    """The outer gimbals, device by device."""
    return [number for number in range(2, model.nbody) if model.body_parentid[number] == 1]


def full(entries):
    return [entries[k] for k in FULL_INERTIA]
