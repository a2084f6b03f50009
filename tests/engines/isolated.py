"""Writes tests/fixtures/isolated.json: wheels and a gyro on a platform, as Pinocchio has them.

    python isolated.py           evaluates all clusters; writes
    python isolated.py --check   the same, compared with the stored file; writes nothing

A platform is six joints: three prismatic, three revolute, without mass but for the last. Exit status:
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
    import numpy as np
    import pinocchio as pin
    from fixture import lines
    from spacecraft import Draw, rotation, solid
    from with_pinocchio import add_body
except ModuleNotFoundError as error:
    if error.name not in ("numpy", "pinocchio"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

CLUSTERS = 24

# Against what was stored before, of each block: another version may order its sums anew.
REPRODUCTION = 1e-11

NO_INERTIA = [0.0] * 6
JOINTS = {
    ("slide", 0): pin.JointModelPX, ("slide", 1): pin.JointModelPY, ("slide", 2): pin.JointModelPZ,
    ("turn", 0): pin.JointModelRX, ("turn", 1): pin.JointModelRY, ("turn", 2): pin.JointModelRZ,
}  # fmt: skip


def cluster(seed):
    """Hub and devices; of a device its links from the base to the tip."""
    draw = Draw(1000 + seed)

    def block(mass, size):
        edges = [size * draw.within(0.3, 1.0) for _ in range(3)]
        return solid(mass, [edge**2 / 12.0 for edge in edges], draw.quaternion())

    def link(motion, axis, mass, centre, inertia, origin=(0.0, 0.0, 0.0), limits=(0.0, 0.0)):
        q, rate = (draw.within(-limit, limit) for limit in limits)
        return {
            "motion": motion, "axis": axis, "origin": list(origin), "mass": mass,
            "centre": list(centre), "inertia": inertia, "q": q, "rate": rate,
            "torque": draw.signed(1e-2, 5.0),
        }  # fmt: skip

    def device(name, links):
        return {"kind": name, "mount": rotation(draw.quaternion()).tolist(), "links": links}

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
    m_b = draw.log_within(20.0, 800.0)
    return {
        "seed": seed,
        "hub": {"m_b": m_b, "r_bc_b": draw.vector(0.2), "i_b": block(m_b, 1.5)},
        "omega": draw.vector(0.8), "r_b_n_dot": draw.vector(2.0),
        "force": draw.vector(5.0), "torque_b": draw.vector(1.0),
        "devices": [
            device("platform", slides + turns + [last]),
            device("reaction_wheel", [wheel(draw.vector(0.3))]),
            device("reaction_wheel", [wheel(draw.vector(0.3))]),
            device("vscmg", [gimbal, wheel(none)]),
        ],
    }  # fmt: skip


def evaluate(craft):
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
        if device["kind"] == "platform":
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


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    crafts = [cluster(seed) for seed in range(CLUSTERS)]
    found = [{**craft, "pinocchio": evaluate(craft)} for craft in crafts]
    if not check:
        text = lines({"pinocchio": pin.__version__, "clusters": found}) + "\n"
        FIXTURE.write_text(text, encoding="utf-8")
        return 0
    stored = json.loads(FIXTURE.read_text(encoding="utf-8"))["clusters"]
    if len(stored) != len(found):
        print(f"{len(stored)} clusters are stored, not {len(found)}", file=sys.stderr)
        return 1
    for new, old in zip(found, stored):
        given = {key: value for key, value in old.items() if key != "pinocchio"}
        if given != {key: value for key, value in new.items() if key != "pinocchio"}:
            print(f"cluster {new['seed']}: other numbers are stored", file=sys.stderr)
            return 1
        for block, value in new["pinocchio"].items():
            value, before = np.atleast_1d(value), np.atleast_1d(old["pinocchio"][block])
            off = np.max(np.abs(value - before)) / np.max(np.abs(before))
            if off > REPRODUCTION:
                print(f"cluster {new['seed']}: {block} off by {off:.1e}", file=sys.stderr)
                return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
