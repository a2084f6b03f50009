"""One spacecraft in Pinocchio: a free-flyer and a chain of three revolute joints a device.

The free-flyer's velocity and acceleration are spatial ones along B: its linear acceleration is
`r_ddot - omega x r_dot`. B is at the world's origin with its axes along the world's.
"""

import numpy as np
import pinocchio as pin

from spacecraft import ENTRIES

VERSION = pin.__version__
ALIGNED = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED


def evaluate(craft):
    """Accelerations, energy, momenta, and every body seen from B."""
    model = build(craft)
    data = model.createData()
    q = configuration(craft)
    omega, r_b_n_dot = np.array(craft["omega"]), np.array(craft["r_b_n_dot"])
    rates = joints(craft, "rates")
    v = np.concatenate([r_b_n_dot, omega, rates])
    tau = np.concatenate([craft["force"], craft["torque_b"], joints(craft, "motors")])

    a = pin.aba(model, data, q, v, tau).copy()
    # The first six rows of the mass matrix times the velocities: momentum along B, about B.
    momentum = pin.crba(model, data, q, pin.Convention.WORLD)[:6] @ v
    names = ("gamma_o_ddot", "gamma_i_ddot", "spin_dot")
    return {
        "r_b_n_ddot": (a[:3] + np.cross(omega, r_b_n_dot)).tolist(),
        "omega_dot": a[3:6].tolist(),
        "accelerations": [dict(zip(names, row)) for row in a[6:].reshape(-1, 3).tolist()],
        "energy": float(pin.computeKineticEnergy(model, data, q, v)),
        "linear": momentum[:3].tolist(),
        "angular_b": momentum[3:].tolist(),
        "bodies": bodies(model, data, q, rates, a[6:]),
    }


def build(craft):
    """The spacecraft as a Pinocchio model; every body has a frame at its centre of mass."""
    model = pin.Model()
    hub = craft["hub"]
    base = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "B")
    add_body(model, base, "hub", hub["m_b"], hub["r_bc_b"], hub["i_b"])
    for number, device in enumerate(craft["devices"]):
        p = device["parameters"]

        def vector(name, axes):
            return np.array([p[f"{name}_{axes}{axis}"] for axis in "xyz"])

        def inertia(name):
            return [p[f"{name}_{i + 1}{k + 1}"] for i, k in ENTRIES]

        mount = np.array(device["mount"])
        # Joint, where it is in its parent body, and its body's mass, centre and inertia.
        chain = [
            (pin.JointModelRZ(), pin.SE3(mount, mount @ vector("r_go_b", "b")),
             p["m_go"], vector("r_goc_go", "go"), inertia("i_go")),
            (pin.JointModelRY(), pin.SE3(np.eye(3), vector("l_o", "")),
             p["m_gi"], vector("r_gic_gi", "gi"), inertia("i_gi")),
            (pin.JointModelRX(), pin.SE3(np.eye(3), vector("l_i", "")),
             p["m_w"], np.array([0.0, p["d"], 0.0]), inertia("j")),
        ]  # fmt: skip
        parent = base
        for name, (joint, placement, mass, centre, entries) in zip(("Go", "Gi", "W"), chain):
            parent = model.addJoint(parent, joint, placement, f"{name} {number}")
            add_body(model, parent, f"{name} {number} body", mass, centre, entries)
    model.gravity = pin.Motion.Zero()
    return model


def add_body(model, joint, name, mass, centre, entries):
    tensor = np.zeros((3, 3))
    for (i, k), x in zip(ENTRIES, entries):
        tensor[i, k] = tensor[k, i] = x
    at_centre = pin.SE3(np.eye(3), np.array(centre))
    model.appendBodyToJoint(joint, pin.Inertia(mass, np.zeros(3), tensor), at_centre)
    model.addBodyFrame(name, joint, at_centre, 0)


def configuration(craft):
    # Position, then the quaternion with its scalar last.
    return np.concatenate([[0.0] * 6, [1.0], joints(craft, "angles")])


def joints(craft, what):
    """Angles, rates or motor torques of all devices, joint by joint."""
    return np.array([x for device in craft["devices"] for x in device[what].values()])


def bodies(model, data, q, rates, accelerations):
    """Centre of mass, its derivatives, angular velocity and inertia about B, hub held still."""
    still = np.zeros(6)
    v, a = np.concatenate([still, rates]), np.concatenate([still, accelerations])
    pin.forwardKinematics(model, data, q, v, a)
    pin.updateFramePlacements(model, data)

    def body(joint):
        name = f"{model.names[joint]} body"
        frame = model.getFrameId(name)
        velocity = pin.getFrameVelocity(model, data, frame, ALIGNED)
        acceleration = pin.getFrameClassicalAcceleration(model, data, frame, ALIGNED)
        about_b = data.oMi[joint].act(model.inertias[joint]).matrix()[3:, 3:]
        return {
            "r": data.oMf[frame].translation.tolist(),
            "r_prime": velocity.linear.tolist(),
            "r_dprime": acceleration.linear.tolist(),
            "omega_b": velocity.angular.tolist(),
            "i_b": [float(about_b[entry]) for entry in ENTRIES],
        }

    # Joint 0 is the universe, 1 the free-flyer; then three a device.
    return [[body(first + k) for k in range(3)] for first in range(2, model.njoints, 3)]
