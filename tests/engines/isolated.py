"""Writes tests/fixtures/isolated.json: wheels and a gyro on a platform, and rows of four panels, as Pinocchio and MuJoCo
have them.

    python isolated.py           evaluates all spacecraft; writes
    python isolated.py --check   the same, compared with the stored file; writes nothing

A platform is six joints: three prismatic, three revolute. In Pinocchio bodies between them have no mass; in
MuJoCo all six joints are of one body. Exit status:
0 if all is well, 1 if something disagrees, 77 if a package is missing: see requirements.txt.
"""

import argparse
import json
import math
import sys
from pathlib import Path

MISSING = 77
HERE = Path(__file__).resolve().parent
FIXTURE = HERE.parent / "fixtures" / "isolated.json"

try:
    import mujoco
    import numpy as np
    import pinocchio as pin
    from fixture import lines
    from spacecraft import Draw, rotation, solid
    from with_mujoco import full
    from with_pinocchio import add_body
except ModuleNotFoundError as error:
    if error.name not in ("mujoco", "numpy", "pinocchio"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

CLUSTERS = 24
ROWS = 24

# What the devices after it stand on.
CARRIERS = ("platform", "hinged_panel")

# Against what was stored before, of each block: another version may order its sums anew.
REPRODUCTION = 1e-11

NO_INERTIA = [0.0] * 6
JOINTS = {
    ("slide", 0): pin.JointModelPX, ("slide", 1): pin.JointModelPY, ("slide", 2): pin.JointModelPZ,
    ("turn", 0): pin.JointModelRX, ("turn", 1): pin.JointModelRY, ("turn", 2): pin.JointModelRZ,
}  # fmt: skip


class Links(Draw):
    """Draws links and devices."""

    def block(self, mass, size):
        edges = [size * self.within(0.3, 1.0) for _ in range(3)]
        return solid(mass, [edge**2 / 12.0 for edge in edges], self.quaternion())

    def link(self, motion, axis, mass, centre, inertia, origin=(0.0, 0.0, 0.0), limits=(0.0, 0.0)):
        q, rate = (self.within(-limit, limit) for limit in limits)
        return {
            "motion": motion, "axis": axis, "origin": list(origin), "mass": mass,
            "centre": list(centre), "inertia": inertia, "q": q, "rate": rate,
            "torque": self.signed(1e-2, 5.0),
        }  # fmt: skip

    def device(self, name, links):
        return {"kind": name, "mount": rotation(self.quaternion()).tolist(), "links": links}

    def spacecraft(self, seed, devices):
        m_b = self.log_within(20.0, 800.0)
        return {
            "seed": seed,
            "hub": {"m_b": m_b, "r_bc_b": self.vector(0.2), "i_b": self.block(m_b, 1.5)},
            "omega": self.vector(0.8), "r_b_n_dot": self.vector(2.0),
            "force": self.vector(5.0), "torque_b": self.vector(1.0),
            "devices": devices(),
        }  # fmt: skip


def cluster(seed):
    """Hub and devices; of a device its links from the base to the tip."""
    draw = Links(1000 + seed)
    link, block = draw.link, draw.block

    def wheel(origin):
        mass = draw.log_within(0.5, 6.0)
        centre = [0.0, draw.signed(1e-5, 1e-2), 0.0]
        return link("turn", 0, mass, centre, block(mass, 0.25), origin, (math.pi, 300.0))

    none = [0.0, 0.0, 0.0]
    m_p = draw.log_within(1.0, 30.0)
    slides = [
        link("slide", axis, 0.0, none, NO_INERTIA, none, (0.1, 0.5)) for axis in range(3)
    ]
    slides[0]["origin"] = draw.vector(0.8)
    turns = [link("turn", axis, 0.0, none, NO_INERTIA, none, (1.2, 1.0)) for axis in range(2)]
    last = link("turn", 2, m_p, draw.vector(0.1), block(m_p, 0.5), none, (1.2, 1.0))
    m_g = draw.log_within(0.2, 2.0)
    gimbal = link(
        "turn", 2, m_g, draw.vector(0.05), block(m_g, 0.2), draw.vector(0.3), (math.pi, 2.0)
    )
    return draw.spacecraft(
        seed,
        lambda: [
            draw.device("platform", slides + turns + [last]),
            draw.device("reaction_wheel", [wheel(draw.vector(0.3))]),
            draw.device("reaction_wheel", [wheel(draw.vector(0.3))]),
            draw.device("vscmg", [gimbal, wheel(none)]),
        ],
    )


def row(seed):
    """Hub and four panels, each on the one before it."""
    draw = Links(3000 + seed)

    def panel():
        mass = draw.log_within(1.0, 20.0)
        centre, inertia = draw.vector(0.5), draw.block(mass, 1.0)
        link = draw.link("turn", 2, mass, centre, inertia, draw.vector(0.9), (math.pi, 1.5))
        return draw.device("hinged_panel", [link])

    return draw.spacecraft(seed, lambda: [panel() for _ in range(4)])


def with_pinocchio(craft):
    """Accelerations, kinetic energy, momenta about B."""
    model = pin.Model()
    hub = craft["hub"]
    base = model.addJoint(0, pin.JointModelFreeFlyer(), pin.SE3.Identity(), "B")
    add_body(model, base, "hub", hub["m_b"], hub["r_bc_b"], hub["i_b"])
    links = []
    for number, device in enumerate(craft["devices"]):
        parent, mount = base, np.array(device["mount"])
        for index, link in enumerate(device["links"]):
            axes = mount if index == 0 else np.eye(3)
            placement = pin.SE3(axes, np.array(link["origin"]))
            joint = JOINTS[link["motion"], link["axis"]]()
            name = f"{device['kind']} {number} {index}"
            parent = model.addJoint(parent, joint, placement, name)
            add_body(model, parent, name, link["mass"], link["centre"], link["inertia"])
            links.append(link)
        if device["kind"] in CARRIERS:
            base = parent
    model.gravity = pin.Motion.Zero()
    data = model.createData()
    omega, velocity = np.array(craft["omega"]), np.array(craft["r_b_n_dot"])
    q = np.concatenate([[0, 0, 0, 0, 0, 0, 1], [link["q"] for link in links]])
    v = np.concatenate([velocity, omega, [link["rate"] for link in links]])
    tau = np.concatenate([craft["force"], craft["torque_b"], [link["torque"] for link in links]])
    a = pin.aba(model, data, q, v, tau).copy()
    momentum = pin.crba(model, data, q, pin.Convention.WORLD)[:6] @ v
    return {
        "r_b_n_ddot": (a[:3] + np.cross(omega, velocity)).tolist(),
        "omega_dot": a[3:6].tolist(),
        "joints": a[6:].tolist(),
        "energy": float(pin.computeKineticEnergy(model, data, q, v)),
        "linear": momentum[:3].tolist(),
        "angular_b": momentum[3:].tolist(),
    }


def with_mujoco(craft):
    """The same."""
    model = build(craft)
    data = mujoco.MjData(model)
    links = [link for device in craft["devices"] for link in device["links"]]
    data.qpos[:] = [0, 0, 0, 1, 0, 0, 0] + [link["q"] for link in links]
    data.qvel[:] = craft["r_b_n_dot"] + craft["omega"] + [link["rate"] for link in links]
    torques = [link["torque"] for link in links]
    data.qfrc_applied[:] = craft["force"] + craft["torque_b"] + torques
    mujoco.mj_forward(model, data)
    mujoco.mj_energyVel(model, data)
    mujoco.mj_subtreeVel(model, data)
    a = data.qacc.copy()
    linear = model.body_subtreemass[1] * data.subtree_linvel[1]
    angular_b = data.subtree_angmom[1] + np.cross(data.subtree_com[1], linear)
    return {
        "r_b_n_ddot": a[:3].tolist(),
        "omega_dot": a[3:6].tolist(),
        "joints": a[6:].tolist(),
        "energy": float(data.energy[1]),
        "linear": linear.tolist(),
        "angular_b": angular_b.tolist(),
    }


def build(craft):
    """Bodies with mass, each on the joints of the links without mass before it and on its own."""
    spec = mujoco.MjSpec()
    spec.compiler.degree = False
    spec.option.gravity = [0.0] * 3
    hub = craft["hub"]
    base = spec.worldbody.add_body(
        mass=hub["m_b"], ipos=hub["r_bc_b"], fullinertia=full(hub["i_b"])
    )
    base.explicitinertial = True
    base.add_freejoint()
    kinds = {"slide": mujoco.mjtJoint.mjJNT_SLIDE, "turn": mujoco.mjtJoint.mjJNT_HINGE}
    for device in craft["devices"]:
        parent, quaternion, joints, origin = base, np.zeros(4), [], None
        mujoco.mju_mat2Quat(quaternion, np.array(device["mount"]).flatten())
        for link in device["links"]:
            joints.append((kinds[link["motion"]], np.eye(3)[link["axis"]]))
            origin = origin or link["origin"]
            if link["mass"] == 0.0:
                continue
            parent = parent.add_body(
                pos=origin, quat=quaternion, mass=link["mass"], ipos=link["centre"],
                fullinertia=full(link["inertia"]),
            )  # fmt: skip
            parent.explicitinertial = True
            for motion, axis in joints:
                parent.add_joint(type=motion, axis=axis)
            quaternion, joints, origin = np.array([1.0, 0.0, 0.0, 0.0]), [], None
        if device["kind"] in CARRIERS:
            base = parent
    return spec.compile()


ENGINES = {"pinocchio": with_pinocchio, "mujoco": with_mujoco}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    crafts = {
        "clusters": [cluster(seed) for seed in range(CLUSTERS)],
        "rows": [row(seed) for seed in range(ROWS)],
    }
    evaluated = {
        group: [{name: by(craft) for name, by in ENGINES.items()} for craft in of]
        for group, of in crafts.items()
    }
    if not check:
        versions = {"pinocchio": pin.__version__, "mujoco": mujoco.__version__}
        found = {
            group: [{**craft, **engines} for craft, engines in zip(of, evaluated[group])]
            for group, of in crafts.items()
        }
        text = lines({"engines": versions, **found}) + "\n"
        FIXTURE.write_text(text, encoding="utf-8")
        return 0
    stored = json.loads(FIXTURE.read_text(encoding="utf-8"))
    groups = (compare(group, of, evaluated[group], stored[group]) for group, of in crafts.items())
    return max(groups)


def compare(group, crafts, evaluated, stored):
    """Whether what is stored is what was drawn and evaluated."""
    if len(stored) != len(crafts):
        print(f"{len(stored)} {group} are stored, not {len(crafts)}", file=sys.stderr)
        return 1
    for craft, engines, old in zip(crafts, evaluated, stored):
        given = {key: value for key, value in old.items() if key not in ENGINES}
        if given != craft:
            print(f"{group}, {craft['seed']}: other numbers are stored", file=sys.stderr)
            return 1
        for engine, found in engines.items():
            for block, value in found.items():
                value, before = np.atleast_1d(value), np.atleast_1d(old[engine][block])
                off = np.max(np.abs(value - before)) / np.max(np.abs(before))
                if off > REPRODUCTION:
                    message = f"{engine}, {block} off by {off:.1e}"
                    print(f"{group}, {craft['seed']}: {message}", file=sys.stderr)
                    return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
