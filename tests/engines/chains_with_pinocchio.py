"""One spacecraft of `chains.py` in Pinocchio: a free-flyer, and a chain of joints for each device.

Locked joints and a fixed hub are removed by Pinocchio itself (`buildReducedModel`); what is left is
`aba`, or with prescribed accelerations Pinocchio's own mass matrix and bias force solved for the
rest. Loads are `rnea` of the whole model with the accelerations found. Springs, dampers and
friction are torques on joints. B is at the world's origin with its axes along the world's.
"""

import numpy as np
import pinocchio as pin

import chains
from spacecraft import ENTRIES

VERSION = pin.__version__
HUB = 1
TURNS = (pin.JointModelRX, pin.JointModelRY, pin.JointModelRZ)
SLIDES = (pin.JointModelPX, pin.JointModelPY, pin.JointModelPZ)
# Velocities of the free-flyer come first.
SIX = 6


def evaluate(craft):
    """Accelerations, motor torques, loads of the joints, energies, momenta, centre of mass; the load
    of a hub that is not free."""
    full = Full(craft)
    a = accelerations(craft, full)
    model, data = full.model, full.model.createData()
    tau = pin.rnea(model, data, full.q, full.v, a, vector_of(full.forces))
    # The first six rows of the mass matrix times the velocities: momentum along B, about B.
    mass = pin.crba(model, model.createData(), full.q, pin.Convention.WORLD)
    momentum = mass[:SIX] @ full.v
    omega, r_b_n_dot = full.v[3:SIX], full.v[:3]
    motors = [
        float(tau[model.idx_vs[number]]) - chains.passive_torque(made)
        for number, (_, _, _, made) in full.numbered()
    ]
    loads = [
        load(data.f[number], joint, made) for number, (_, _, joint, made) in full.numbered()
    ]
    springs = sum(chains.spring_energy(made) for _, _, _, made in full.joints)
    centre = pin.centerOfMass(model, model.createData(), full.q)
    found = {
        "r_b_n_ddot": (a[:3] + np.cross(omega, r_b_n_dot)).tolist(),
        "omega_dot": a[3:SIX].tolist(),
        "accelerations": chains.by_device(craft, a[SIX:].tolist()),
        "motors": [list(device.values()) for device in chains.by_device(craft, motors)],
        "loads": [list(device.values()) for device in chains.by_device(craft, loads)],
        "energy": float(pin.computeKineticEnergy(model, model.createData(), full.q, full.v)),
        "linear": momentum[:3].tolist(),
        "angular_b": momentum[3:].tolist(),
        "centre_of_mass": centre.tolist(),
        "potential": float(pin.computePotentialEnergy(model, model.createData(), full.q)) + springs,
    }
    if craft["hub_mode"] != "free":
        needed = tau[:SIX] - np.concatenate([craft["force"], craft["torque_b"]])
        found["hub_load"] = {"hub_force": needed[:3].tolist(), "hub_moment": needed[3:].tolist()}
    return found


def stopped(craft):
    """The velocities after an impulsive stop of locked joints and a fixed hub, and the energy lost."""
    full = Full(craft)
    model = full.model
    # The velocities that vanish by the impulses; prescribed ones do not jump.
    stops = np.zeros(model.nv)
    rows = [] if craft["hub_mode"] == "free" else list(range(SIX))
    if craft["hub_mode"] == "fixed":
        stops[:SIX] = full.v[:SIX]
    for number, (_, _, _, made) in full.numbered():
        velocity = model.idx_vs[number]
        if made["mode"] != "driven":
            rows.append(velocity)
        if made["mode"] == "locked":
            stops[velocity] = full.v[velocity]
    constraint = np.eye(model.nv)[rows]
    data = model.createData()
    jump = pin.impulseDynamics(model, data, full.q, stops, constraint, 0.0, 0.0) - stops
    after = full.v + jump
    # What is stopped is at rest to rounding of what it had.
    if np.abs(after[stops != 0.0]).max() > 1e-12 * np.abs(full.v).max():
        raise ArithmeticError(f"{craft['name']}: Pinocchio stops to {after[stops != 0.0]}")
    after[stops != 0.0] = 0.0
    jump[stops != 0.0] = -full.v[stops != 0.0]
    return {
        "r_b_n_dot": after[:3].tolist(),
        "omega": after[3:SIX].tolist(),
        "rates": [list(d.values()) for d in chains.by_device(craft, after[SIX:].tolist())],
        "energy_lost": energy_lost(full, jump, after, rows),
    }


def energy_lost(full, jump, after, rows):
    """T(v) - T(v') of a jump to v' is T(jump) - jump . M v': the difference of two energies keeps no
    digit of a loss below their rounding. The impulses M jump act on the constrained velocities only."""
    model = full.model
    mass = pin.crba(model, model.createData(), full.q, pin.Convention.WORLD)
    mass = np.triu(mass) + np.triu(mass, 1).T
    impulses = mass[rows] @ jump
    of_jump = pin.computeKineticEnergy(model, model.createData(), full.q, jump)
    return float(of_jump - impulses @ after[rows])


class Full:
    """The whole spacecraft, every joint free, with its state and the forces on its bodies."""

    def __init__(self, craft):
        self.craft = craft
        self.joints = list(chains.joints(craft))
        self.model = build(craft)
        coordinates = [made["coordinate"] for _, _, _, made in self.joints]
        rates = [made["rate"] for _, _, _, made in self.joints]
        # Position, then the quaternion with its scalar last.
        self.q = np.concatenate([[0.0] * SIX, [1.0], coordinates])
        self.v = np.concatenate([craft["r_b_n_dot"], craft["omega"], rates])
        torques = [made["motor"] + chains.passive_torque(made) for _, _, _, made in self.joints]
        self.tau = np.concatenate([craft["force"], craft["torque_b"], torques])
        self.forces = [pin.Force.Zero(), pin.Force.Zero()]
        for _, _, joint, made in self.joints:
            self.forces.append(pin.Force(*chains.wrench_on_body(joint, made)))

    def numbered(self):
        """Pinocchio's number of each joint: 0 is the universe, 1 the free-flyer."""
        return enumerate(self.joints, start=HUB + 1)


def build(craft):
    model = pin.Model()
    hub = craft["hub"]
    model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "B")
    model.addJointFrame(HUB)
    model.appendBodyToJoint(HUB, body(hub["m_b"], hub["r_bc_b"], hub["i_b"]), pin.SE3.Identity())
    for number, index, joint, made in chains.joints(craft):
        first = index == 0
        turned = chains.mount(craft["devices"][number]) if first else np.eye(3)
        parent = HUB if first else model.njoints - 1
        moves = (SLIDES if joint.slides else TURNS)[joint.axis]()
        placement = pin.SE3(turned, np.array(made["origin"]))
        last = model.addJoint(parent, moves, placement, f"{number}.{index}")
        # `buildReducedModel` needs a frame for each joint.
        model.addJointFrame(last)
        own = body(made["mass"], made["centre"], made["inertia"])
        model.appendBodyToJoint(last, own, pin.SE3.Identity())
    model.gravity = pin.Motion(np.array(craft["gravity"]), np.zeros(3))
    return model


def body(mass, centre, entries):
    tensor = np.zeros((3, 3))
    for (i, k), x in zip(ENTRIES, entries):
        tensor[i, k] = tensor[k, i] = x
    return pin.Inertia(mass, np.array(centre), tensor)


def accelerations(craft, full):
    """Of the whole model, the free-flyer's spatial along B, what does not move zero."""
    held = [n for n, (_, _, _, made) in full.numbered() if made["mode"] == "locked"]
    if craft["hub_mode"] == "fixed":
        held.insert(0, HUB)
    model, moving = full.model, np.arange(full.model.nv)
    q, forces = full.q, full.forces
    if held:
        model = pin.buildReducedModel(full.model, held, full.q)
        moving = np.array([k for k in moving if owner(full.model, k) not in held], dtype=int)
        forces = carried_over(full, model)
        six_and_one = 0 if HUB in held else SIX + 1
        kept = [k for k in moving if k >= SIX]
        q = np.concatenate([full.q[:six_and_one], full.q[1:][kept]])
    v, tau = full.v[moving], full.tau[moving]
    given = given_accelerations(craft, full)[moving]
    free = np.isnan(given)
    data = model.createData()
    if free.all():
        found = pin.aba(model, data, q, v, tau, vector_of(forces)).copy()
    else:
        found = hybrid(model, data, q, v, tau, forces, given, free)
    a = np.zeros(full.model.nv)
    a[moving] = found
    return a


def hybrid(model, data, q, v, tau, forces, given, free):
    """The rest of the accelerations by the engine's own mass matrix and bias force."""
    found = np.where(free, 0.0, given)
    # The bias: what the given accelerations and the rates need.
    bias = pin.rnea(model, data, q, v, found, vector_of(forces))
    mass = pin.crba(model, model.createData(), q, pin.Convention.WORLD)
    mass = np.triu(mass) + np.triu(mass, 1).T
    found[free] = solved(mass[np.ix_(free, free)], (tau - bias)[free])
    return found


def solved(mass, right):
    """Of a mass matrix, scaled to a unit diagonal."""
    scale = 1.0 / np.sqrt(np.diag(mass))
    return scale * np.linalg.solve(mass * np.outer(scale, scale), scale * right)


def given_accelerations(craft, full):
    """NaN where the acceleration is not given."""
    hub = [np.nan] * SIX
    if isinstance(craft["hub_mode"], dict):
        of_hub = craft["hub_mode"]["prescribed"]
        spatial = np.array(of_hub["r_b_n_ddot"]) - np.cross(full.v[3:SIX], full.v[:3])
        hub = [*spatial, *of_hub["omega_dot"]]
    own = [chains.prescribed(made) for _, _, _, made in full.joints]
    return np.array([*hub, *(np.nan if x is None else x for x in own)])


def owner(model, velocity):
    """The joint to which an entry of the velocity belongs."""
    return HUB if velocity < SIX else velocity - SIX + HUB + 1


def carried_over(full, model):
    """The forces on bodies, each on the joint of the reduced model that now carries the body."""
    data = full.model.createData()
    pin.forwardKinematics(full.model, data, full.q)
    forces = [pin.Force.Zero() for _ in range(model.njoints)]
    for number, force in enumerate(full.forces):
        at = number
        while at > 0 and not model.existJointName(full.model.names[at]):
            at = full.model.parents[at]
        if at > 0:
            moved = data.oMi[at].actInv(data.oMi[number].act(force))
            forces[model.getJointId(full.model.names[at])] += moved
    return forces


def load(force, joint, made):
    """What the parent body exerts on the child body, about its origin."""
    axes = chains.turn(joint.axis, made["coordinate"]) if joint.round else np.eye(3)
    force, moment = axes @ force.linear, axes @ force.angular
    return {"force": force.tolist(), "moment": moment.tolist()}


def vector_of(forces):
    made = pin.StdVec_Force()
    made.extend(forces)
    return made
