"""Seeded random spacecraft with devices of every kind: parameters, state and inputs, no engine.

A device is a chain of joints, each with its child body; `KINDS` says how the joints move. Numbers
are drawn as in `spacecraft.py`: of order one ("unit"), or over the ranges that the suites declare
("declared"), rounded to six digits. A mount is a quaternion of any length, scalar first.
"""

import math
from typing import NamedTuple

import numpy as np

from spacecraft import AXES, Draw, rotation, solid


class Joint(NamedTuple):
    """How a joint moves: about or along an axis of its parent body, 0 to 2."""

    # Of its acceleration.
    name: str
    axis: int
    slides: bool = False
    # A wheel; a round one is symmetric about its joint, and the wrench on it and the load of its
    # joint are expressed in the axes of its parent body.
    wheel: bool = False
    round: bool = False
    # Not driven: the kind prescribes a constant rate.
    kept: bool = False
    # Axes without a body; its joint's origin is that of the parent body unless it is the first.
    bodiless: bool = False
    # The joint's origin is that of the parent body.
    concentric: bool = False


OUTER, INNER = Joint("gamma_o_ddot", axis=2), Joint("gamma_i_ddot", axis=1)
GIMBAL = Joint("gamma_ddot", axis=2)


def wheel(**what):
    return Joint("spin_dot", axis=0, wheel=True, **what)


BEARINGS = [
    Joint("x_ddot", axis=0, slides=True, bodiless=True),
    Joint("y_ddot", axis=1, slides=True, bodiless=True),
    Joint("z_ddot", axis=2, slides=True, bodiless=True),
    Joint("tilt_y_ddot", axis=1, bodiless=True),
    Joint("tilt_z_ddot", axis=2, bodiless=True),
    wheel(concentric=True),
]

# The joints of each kind from the hub to the tip, docs/kinds.md.
KINDS = {
    "dgvscmg": [OUTER, INNER, wheel()],
    "balanced_dgvscmg": [OUTER, INNER, wheel(round=True)],
    "dgcmg": [OUTER, INNER, wheel(kept=True)],
    "balanced_dgcmg": [OUTER, INNER, wheel(round=True, kept=True)],
    "vscmg": [GIMBAL, wheel()],
    "balanced_vscmg": [GIMBAL, wheel(round=True)],
    "sgcmg": [GIMBAL, wheel(kept=True)],
    "balanced_sgcmg": [GIMBAL, wheel(round=True, kept=True)],
    "reaction_wheel": [wheel()],
    "balanced_reaction_wheel": [wheel(round=True)],
    "hinged_panel": [Joint("phi_ddot", axis=2)],
    "slosh_mass": [Joint("x_ddot", axis=0, slides=True)],
    "flexible_reaction_wheel": BEARINGS,
    "flexible_vscmg": [GIMBAL, *BEARINGS],
}
KEPT = {"prescribed": 0.0}
HUBS = ("free", "fixed", "prescribed")


def all_spacecraft():
    """The stored spacecraft, in order."""
    for kind in KINDS:
        yield drawn("kind", [kind], unit=True)
        yield drawn("kind", [kind])
        yield drawn("kind", [kind] * 3)
        yield drawn("passive", [kind], unit=True)
        yield drawn("passive", [kind] * 2)
        yield drawn("modes", [kind] * 2, unit=True)
        yield drawn("modes", [kind] * 3)
        # A massless gimbal whose rotor moves in all six freedoms has no inertia at all.
        if len(KINDS[kind]) > 1 and kind != "flexible_vscmg":
            yield drawn("massless gimbals", [kind] * 2, unit=True)
    for group, count in (("set", 12), ("passive set", 6), ("modes of a set", 12)):
        yield from sets(group, count)


def all_stops():
    """Spacecraft of which joints are stopped impulsively while they move, in order."""
    for kind in KINDS:
        yield drawn("stop", [kind] * 2, unit=True)
        yield drawn("stop", [kind] * 3)
    yield from sets("stop in a set", 6)


def sets(group, count):
    """So many sets of the first thirteen kinds, then two of fourteen that begin with the kinds on bearings: a kind that
    is added changes no set that is stored."""
    for number in range(count):
        yield mixed(group, number, list(KINDS)[:13])
    for number in (12, 13):
        yield mixed(group, number, list(KINDS)[:14])


def more_spacecraft(count):
    """As many more over the declared ranges: mixed sets, every third with each group of inputs."""
    for number in range(count):
        group = ("set", "passive set", "modes of a set")[number % 3]
        yield mixed(group, 1000 + number, list(KINDS))


def mixed(group, number, names):
    """Two to six devices of these kinds, the first of each in turn, the others at random."""
    draw = Scales(f"{group}, kinds, {number}", unit=False)
    others = [names[draw.index(len(names))] for _ in range(1 + draw.index(5))]
    kinds = [names[number % len(names)], *others]
    return drawn(group, kinds, number=number)


def drawn(group, kinds, unit=False, number=0):
    """One spacecraft: "passive" adds springs, dampers, friction, wrenches and gravity; "modes"
    draws the modes of joints and hub, and those of a set add everything; gimbals may have no mass."""
    scales = "unit" if unit else "declared"
    of = kinds[0] if len(set(kinds)) == 1 else "mixed"
    name = f"{group}: {len(kinds)} {of}, {scales}, {number}"
    draw = Scales(name, unit)
    everything = "passive" in group or group == "modes of a set"
    hub_mode = HUBS[number % 3] if group in ("modes of a set", "stop in a set") else "free"
    m_b = draw.hub_mass()
    still = hub_mode == "fixed" and "stop" not in group
    craft = {
        "name": name, "group": group,
        "hub": {"m_b": m_b, "r_bc_b": draw.position(), "i_b": draw.block(m_b)},
        "omega": draw.still(draw.omega(), still),
        "r_b_n_dot": draw.still(draw.velocity(), still),
        "force": draw.force(), "torque_b": draw.torque(),
        "gravity": draw.gravity() if everything else [0.0] * 3,
        "hub_mode": hub_mode,
        "devices": [device(draw, kind, m_b, everything) for kind in kinds],
    }  # fmt: skip
    if hub_mode == "prescribed":
        accelerations = {"r_b_n_ddot": draw.velocity(), "omega_dot": draw.omega()}
        craft["hub_mode"] = {"prescribed": accelerations}
    if group.startswith(("modes", "stop")):
        set_modes(draw, craft)
    if group == "massless gimbals":
        for _, _, joint, made in joints(craft):
            if not joint.wheel:
                made["mass"], made["inertia"], made["centre"] = 0.0, [0.0] * 6, [0.0] * 3
    return craft


def device(draw, kind, heaviest, everything):
    mount = [1.0, 0.0, 0.0, 0.0] if draw.unit else draw.quaternion()
    joints = []
    for joint in KINDS[kind]:
        # A gimbal holds the bearings, their housing and the motor: at least a third of the rotor's mass. Its
        # inertia is all that opposes its motor, since the rotor is free in all six freedoms.
        gimbals = [made["mass"] for made in joints if made["mass"] > 0.0]
        limit = min([heaviest, *(3.0 * mass for mass in gimbals if joint.concentric)])
        joints.append(one(draw, joint, not joints, limit, everything))
    return {"kind": kind, "mount": mount, "joints": joints}


def one(draw, joint, first, heaviest, everything):
    """A joint with its child body, its state and its inputs."""
    mass = draw.mass(heaviest)
    centre, inertia = [0.0] * 3, [0.0] * 6
    if joint.bodiless:
        mass = 0.0
    elif joint.wheel:
        inertia, off = draw.disc(mass, joint.round, joint.concentric)
        centre = [0.0, 0.0 if joint.round else off, 0.0]
    elif not joint.slides:
        centre, inertia = draw.offset(), draw.block(mass)
    coordinate, rate = draw.motion(joint)
    origin = draw.position() if first else draw.offset()
    concentric = not first and (joint.bodiless or joint.concentric)
    made = {
        "origin": [0.0] * 3 if concentric else origin,
        "mass": mass, "centre": centre, "inertia": inertia,
        "coordinate": coordinate, "rate": rate,
        "motor": 0.0 if joint.kept else draw.motor(),
        "mode": KEPT if joint.kept else "driven",
    }  # fmt: skip
    if everything:
        made["passive"] = draw.passive(joint)
        made["wrench"] = [*draw.force(), *draw.torque()]
    return made


def set_modes(draw, craft):
    """Each driven joint driven, prescribed or locked; at least one is not driven, where joints are
    to be stopped one is locked and moves."""
    stop = craft["group"].startswith("stop")
    own = [
        made
        for device in craft["devices"]
        for made, joint in zip(device["joints"], KINDS[device["kind"]])
        if not joint.kept
    ]
    forced = draw.index(len(own))
    for number, made in enumerate(own):
        mode = draw.index(4)
        if number == forced:
            mode = 1 if stop else mode % 2
        if mode == 0:
            made["mode"] = {"prescribed": draw.signed(1e-2, 10.0)}
        elif mode == 1:
            made["mode"], made["rate"] = "locked", made["rate"] if stop else 0.0


class Scales(Draw):
    """Random numbers of one spacecraft, of order one or over the declared ranges."""

    def __init__(self, seed, unit):
        super().__init__(seed)
        self.unit = unit

    def three(self):
        return [self.signed(0.3, 1.5) for _ in AXES]

    def hub_mass(self):
        return self.within(0.5, 1.5) if self.unit else self.log_within(1.0, 5000.0)

    def mass(self, heaviest):
        return self.within(0.5, 1.5) if self.unit else self.log_within(0.1, max(heaviest, 0.2))

    def block(self, mass):
        """A solid body whose products of inertia count as much as its moments."""
        if self.unit:
            return solid(1.0, [self.within(0.1, 1.5) for _ in AXES], self.quaternion())
        edges = [self.log_within(0.05, 3.0) for _ in AXES]
        return solid(mass, [edge**2 / 12.0 for edge in edges], self.quaternion())

    def disc(self, mass, is_round, on_bearings):
        """Inertia of a disc about nearly the x axis, and how far it may be off balance: to its radius, on
        flexible bearings to a hundredth of it, which is more than they would bear of a rotor."""
        if self.unit:
            axial, across = self.within(1.0, 1.5), self.within(0.8, 1.2)
            inertia = [axial, 0.0, 0.0, across, 0.0, across] if is_round else self.block(mass)
            return inertia, self.signed(0.3, 1.5)
        radius = self.log_within(0.02, 0.5)
        thickness = radius * self.within(0.1, 1.0)
        tilt = [1.0, 0.0, self.signed(1e-6, 0.05), self.signed(1e-6, 0.05)]
        seconds = [thickness**2 / 12.0, radius**2 / 4.0, radius**2 / 4.0]
        inertia = solid(mass, seconds, [1.0, 0.0, 0.0, 0.0] if is_round else tilt)
        if is_round:
            inertia = [inertia[0], 0.0, 0.0, inertia[3], 0.0, inertia[3]]
        return inertia, self.signed(1e-6, radius / 100.0 if on_bearings else radius)

    def position(self):
        return self.three() if self.unit else self.vector(self.within(0.0, 3.0))

    def offset(self):
        return self.three() if self.unit else self.vector(self.log_within(1e-3, 3.0))

    def omega(self):
        return self.three() if self.unit else self.vector(self.within(0.0, 1.0))

    def velocity(self):
        return self.three() if self.unit else self.vector(self.within(0.0, 10.0))

    def force(self):
        return self.three() if self.unit else self.vector(self.log_within(1e-3, 100.0))

    def torque(self):
        return self.three() if self.unit else self.vector(self.log_within(1e-4, 10.0))

    def gravity(self):
        return self.three() if self.unit else self.vector(self.within(1.0, 10.0))

    def motor(self):
        return self.signed(0.3, 1.5) if self.unit else self.signed(1e-4, 10.0)

    def motion(self, joint):
        """Coordinate and rate: a wheel to 6000 rpm, and turned through up to 1000 rad. Bearings yield by their
        clearance: slides by up to 5 mm, tilts by up to 0.1 rad; at unit scales tilts stay away from the right
        angle, where the axis of the spin is that of the other tilt."""
        if joint.bodiless and not joint.slides:
            return self.signed(0.1, 1.0) if self.unit else self.signed(1e-3, 0.1), self.signed(0.1, 1.5)
        if self.unit:
            return self.signed(0.3, math.pi), self.signed(0.3, 1.5)
        if joint.bodiless:
            return self.within(-5e-3, 5e-3), self.within(-0.1, 0.1)
        if joint.slides:
            return self.within(-0.5, 0.5), self.within(-1.0, 1.0)
        if joint.wheel:
            return self.within(-1000.0, 1000.0), self.within(-628.0, 628.0)
        return self.within(-math.pi, math.pi), self.within(-5.0, 5.0)

    def passive(self, joint):
        """Stiffness, coordinate at rest, viscous, Coulomb friction, rate below which that fades."""
        if self.unit:
            return [self.log_within(0.3, 1.5) for _ in range(5)]
        # Wheels turn freely: friction and no spring. Springs of bearings rest as far from the middle as they
        # yield; by a metre or a radian they would throw a small rotor at 6e5 rad/s^2.
        rest = (5e-3 if joint.slides else 0.1) if joint.bodiless else 1.0
        spring = [0.0, 0.0] if joint.wheel else [self.log_within(1e-2, 1e3), self.within(-rest, rest)]
        viscous = self.log_within(1e-5, 1e-2) if joint.wheel else self.log_within(1e-3, 10.0)
        return [*spring, viscous, self.log_within(1e-4, 1.0), self.log_within(1e-3, 1.0)]

    def index(self, count):
        """A whole number from 0, below the count."""
        return min(int(self.next() * count), count - 1)

    @staticmethod
    def still(drawn, still):
        return [0.0] * 3 if still else drawn


def joints(craft):
    """All joints of a spacecraft in order: device, number, how it moves, the joint itself."""
    for number, device in enumerate(craft["devices"]):
        for index, (joint, made) in enumerate(zip(KINDS[device["kind"]], device["joints"])):
            yield number, index, joint, made


def by_device(craft, values):
    """A value for each joint in order, by device and by the name of the joint's acceleration."""
    found = [{} for _ in craft["devices"]]
    for (device, _, joint, _), value in zip(joints(craft), values, strict=True):
        found[device][joint.name] = value
    return found


def mount(device):
    """Columns: the device's axes at zero angle, in B."""
    return rotation(device["mount"])


def turn(axis, angle):
    """The rotation about a coordinate axis."""
    s, c = math.sin(angle), math.cos(angle)
    after, last = (axis + 1) % 3, (axis + 2) % 3
    made = np.eye(3)
    made[after, after] = made[last, last] = c
    made[after, last], made[last, after] = -s, s
    return made


def passive_torque(made):
    """Of spring, damper and smoothed Coulomb friction: docs of `Passive`."""
    k, rest, viscous, coulomb, fades = made.get("passive", [0.0] * 5)
    q, rate = made["coordinate"], made["rate"]
    return -k * (q - rest) - viscous * rate - friction(rate, coulomb, fades)


def spring_energy(made):
    k, rest, *_ = made.get("passive", [0.0] * 5)
    return 0.5 * k * (made["coordinate"] - rest) ** 2


def friction(rate, coulomb, fades):
    return coulomb * rate / math.hypot(rate, fades) if coulomb else 0.0


def wrench_on_body(joint, made):
    """External force and moment about the body's origin, along axes that turn with the body."""
    wrench = np.array(made.get("wrench", [0.0] * 6))
    if not joint.round:
        return wrench[:3], wrench[3:]
    back = turn(joint.axis, made["coordinate"]).T
    return back @ wrench[:3], back @ wrench[3:]


def prescribed(made):
    """The given acceleration of a joint; none of a driven one."""
    if made["mode"] == "driven":
        return None
    return 0.0 if made["mode"] == "locked" else made["mode"]["prescribed"]
