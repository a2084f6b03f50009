"""One spacecraft of `chains.py` in MuJoCo: a free joint, and a chain of joints for each device.

Locked joints and the free joint of a fixed hub are left out of the model; springs and dampers are
MuJoCo's own. Prescribed accelerations are given by MuJoCo's mass matrix and forces, solved for the
rest. B is at the world's origin with its axes along the world's.
"""

import mujoco
import numpy as np

import chains
from with_mujoco import full

VERSION = mujoco.__version__
SIX = 6
# MuJoCo's compiler accepts no moving body without mass or inertia, so point masses and massless
# gimbals have some until then.
PLACEHOLDER = 1.0


def evaluate(craft):
    """Accelerations, energies, momenta and centre of mass."""
    moving = [made for _, _, _, made in chains.joints(craft) if made["mode"] != "locked"]
    hub_moves = craft["hub_mode"] != "fixed"
    model = build(craft, hub_moves)
    data = mujoco.MjData(model)
    torques = [made["motor"] - friction(made) for made in moving]
    free = ([0.0] * 3 + [1.0] + [0.0] * 3, craft["r_b_n_dot"] + craft["omega"])
    q, v = free if hub_moves else ([], [])
    applied = craft["force"] + craft["torque_b"] if hub_moves else []
    data.qpos[:] = np.array(q + [made["coordinate"] for made in moving])
    data.qvel[:] = np.array(v + [made["rate"] for made in moving])
    data.qfrc_applied[:] = np.array(applied + torques)
    mujoco.mj_kinematics(model, data)
    apply_wrenches(model, data, craft)
    mujoco.mj_forward(model, data)
    mujoco.mj_subtreeVel(model, data)
    a = accelerations(model, data, given_accelerations(craft, moving, hub_moves))
    linear = model.body_subtreemass[1] * data.subtree_linvel[1]
    angular_b = data.subtree_angmom[1] + np.cross(data.subtree_com[1], linear)
    hub, own = (a[:SIX], a[SIX:]) if hub_moves else (np.zeros(SIX), a)
    left = iter(own.tolist())
    joints = [
        0.0 if made["mode"] == "locked" else next(left) for _, _, _, made in chains.joints(craft)
    ]
    return {
        "r_b_n_ddot": hub[:3].tolist(),
        "omega_dot": hub[3:].tolist(),
        "accelerations": chains.by_device(craft, joints),
        "energy": float(data.energy[1]),
        "linear": linear.tolist(),
        "angular_b": angular_b.tolist(),
        "centre_of_mass": data.subtree_com[1].tolist(),
        "potential": float(data.energy[0]) + springs_of_locked(craft),
    }


def build(craft, hub_moves):
    """The spacecraft as a MuJoCo model: no contact, limit, armature or dry friction."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.gravity = craft["gravity"]
    spec.option.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    hub = craft["hub"]
    parent = base = spec.worldbody.add_body(
        name="B", mass=hub["m_b"], ipos=hub["r_bc_b"], fullinertia=full(hub["i_b"])
    )
    base.explicitinertial = True
    if hub_moves:
        base.add_freejoint()
    for number, index, joint, made in chains.joints(craft):
        first = index == 0
        pose = chains.mount(craft["devices"][number]) if first else np.eye(3)
        place = np.array(made["origin"])
        if made["mode"] == "locked":
            along, q = pose[:, joint.axis], made["coordinate"]
            place = place + along * q if joint.slides else place
            pose = pose if joint.slides else pose @ chains.turn(joint.axis, q)
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, pose.flatten())
        point = not any(made["inertia"])
        parent = (base if first else parent).add_body(
            name=f"{number}.{index}", pos=place, quat=quaternion, mass=made["mass"] or PLACEHOLDER,
            ipos=made["centre"],
            fullinertia=[PLACEHOLDER] * 3 + [0.0] * 3 if point else full(made["inertia"]),
        )  # fmt: skip
        parent.explicitinertial = True
        if made["mode"] == "locked":
            continue
        stiffness, rest, damping, *_ = made.get("passive", [0.0] * 3)
        slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
        parent.add_joint(
            type=slide if joint.slides else hinge, axis=np.eye(3)[joint.axis],
            stiffness=stiffness, springref=rest, damping=damping,
        )  # fmt: skip
    model = spec.compile()
    for number, index, _, made in chains.joints(craft):
        own = model.body(f"{number}.{index}").id
        model.body_mass[own] = made["mass"]
        if not any(made["inertia"]):
            model.body_inertia[own] = 0.0
    # Masses of subtrees follow.
    mujoco.mj_setConst(model, mujoco.MjData(model))
    return model


def springs_of_locked(craft):
    """Energy of springs whose joints are not in the model."""
    joints = [made for _, _, _, made in chains.joints(craft)]
    return sum(chains.spring_energy(made) for made in joints if made["mode"] == "locked")


def friction(made):
    """Smoothed Coulomb friction, which MuJoCo does not have."""
    _, _, _, coulomb, fades = made.get("passive", [0.0] * 5)
    return chains.friction(made["rate"], coulomb, fades)


def apply_wrenches(model, data, craft):
    """MuJoCo takes forces along the world's axes, through the centre of mass."""
    for number, index, joint, made in chains.joints(craft):
        body = model.body(f"{number}.{index}").id
        axes = data.xmat[body].reshape(3, 3)
        force, moment = (axes @ x for x in chains.wrench_on_body(joint, made))
        arm = data.xpos[body] - data.xipos[body]
        data.xfrc_applied[body] = np.concatenate([force, moment + np.cross(arm, force)])


def accelerations(model, data, given):
    """MuJoCo's own where none is given, else the rest by its mass matrix and forces."""
    free = np.isnan(given)
    if free.all():
        return data.qacc.copy()
    found = np.where(free, 0.0, given)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    right = (data.qfrc_smooth - mass @ found)[free]
    mass = mass[np.ix_(free, free)]
    scale = 1.0 / np.sqrt(np.diag(mass))
    found[free] = scale * np.linalg.solve(mass * np.outer(scale, scale), scale * right)
    return found


def given_accelerations(craft, moving, hub_moves):
    """NaN where the acceleration is not given."""
    hub = [np.nan] * SIX if hub_moves else []
    if isinstance(craft["hub_mode"], dict):
        of_hub = craft["hub_mode"]["prescribed"]
        hub = of_hub["r_b_n_ddot"] + of_hub["omega_dot"]
    own = [chains.prescribed(made) for made in moving]
    return np.array([*hub, *(np.nan if x is None else x for x in own)])
