"""Writes tests/fixtures/wheels.json: a run of three imbalanced reaction wheels with motors by Basilisk.

    python wheels.py           runs it; writes its states
    python wheels.py --check   the same, compared with the stored file; writes nothing

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import sys
from pathlib import Path

MISSING = 77
FIXTURE = Path(__file__).resolve().parent.parent / "fixtures" / "wheels.json"

try:
    import with_basilisk
    from fixture import lines
except ModuleNotFoundError as error:
    if error.name not in ("Basilisk", "numpy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

# Basilisk against what it gave before, of the block's largest magnitude: another processor may order its
# sums anew, and a run adds up what it rounds.
REPRODUCTION = 1e-12

# Imbalances a thousand times those of a real wheel, so that every term of the coupling counts.
CRAFT = {
    "step": 1e-3,
    "steps": 20000,
    "every": 1000,
    "hub": {
        "m_b": 180.0,
        "r_bc_b": [0.02, -0.01, 0.05],
        "i_b": [40.0, 1.5, -1.1, 35.0, 0.9, 30.0],
    },
    "v_c_n": [0.3, -0.2, 0.1],
    "mrp": [0.1, 0.2, -0.3],
    "omega": [0.02, -0.03, 0.01],
    "wheels": [
        {"quaternion": [3, 1, -2, 1], "r_w_b": [0.2, 0.1, -0.2], "m_w": 6.0, "axial": 0.0191,
         "transverse": 0.0114, "u_s": 3e-3, "u_d": 4e-4, "spin": 52.0, "u_w": 0.02},
        {"quaternion": [2, -1, 1, 3], "r_w_b": [-0.1, 0.3, -0.1], "m_w": 6.0, "axial": 0.0191,
         "transverse": 0.0114, "u_s": 2e-3, "u_d": -3e-4, "spin": -41.0, "u_w": -0.015},
        {"quaternion": [1, 2, 1, -1], "r_w_b": [0.1, -0.2, 0.3], "m_w": 9.0, "axial": 0.03,
         "transverse": 0.02, "u_s": 4e-3, "u_d": 6e-4, "spin": 33.0, "u_w": 0.03},
    ],
}  # fmt: skip


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    craft = {**CRAFT, "wheels": [mounted(wheel) for wheel in CRAFT["wheels"]]}
    found = {"basilisk": with_basilisk.VERSION, **craft, "samples": with_basilisk.samples(craft)}
    print(f"basilisk {with_basilisk.VERSION}: {craft['steps']} steps of {craft['step']} s")
    if not check:
        FIXTURE.write_text(lines(found) + "\n", encoding="utf-8")
        print(f"wrote {FIXTURE.name}")
        return
    if not FIXTURE.exists():
        sys.exit(f"{FIXTURE} is missing; run wheels.py")
    stored = json.loads(FIXTURE.read_text(encoding="utf-8"))
    if any(found[key] != stored.get(key) for key in craft):
        sys.exit(f"{FIXTURE.name} has another spacecraft; run wheels.py")
    name, error = worst(found["samples"], stored["samples"])
    print(f"against {FIXTURE.name}: worst {error:.1e} of the block, {name}")
    # A NaN is above every bound.
    if not error <= REPRODUCTION:
        sys.exit(f"{name} differs by {error:e} of the block, above {REPRODUCTION:g}")


def mounted(wheel):
    """The wheel with its mount, from a quaternion of whole numbers: the same doubles on every machine."""
    mount = rotation(*wheel["quaternion"])
    kept = {key: value for key, value in wheel.items() if key != "quaternion"}
    return {"mount": mount, **kept}


def rotation(a, b, c, d):
    square = a * a + b * b + c * c + d * d
    rows = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]
    return [[entry / square for entry in row] for row in rows]


def worst(found, stored):
    """The block with the largest difference in units of its largest magnitude, and that difference."""
    if [sample["steps"] for sample in found] != [sample["steps"] for sample in stored]:
        sys.exit(f"{FIXTURE.name} has other samples; run wheels.py")

    def error(name):
        pairs = [(x, y) for a, b in zip(found, stored) for x, y in zip(a[name], b[name], strict=True)]
        return max(abs(x - y) for x, y in pairs) / max(abs(y) for _, y in pairs)

    return max(((name, error(name)) for name in with_basilisk.STATES), key=lambda pair: pair[1])


if __name__ == "__main__":
    main()
