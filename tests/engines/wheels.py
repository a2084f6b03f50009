"""Writes tests/fixtures/wheels.json: a run of three imbalanced reaction wheels with motors by Basilisk.

    python wheels.py           runs it; writes its states
    python wheels.py --check   the same, compared with the stored file; writes nothing

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import sys

import runs
from runs import mounted

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
    try:
        import with_basilisk
    except ModuleNotFoundError as error:
        if error.name not in ("Basilisk", "numpy"):
            raise
        print(error, file=sys.stderr)
        sys.exit(runs.MISSING)
    craft = {**CRAFT, "wheels": [mounted(wheel) for wheel in CRAFT["wheels"]]}
    runs.main(__doc__, "wheels", craft, with_basilisk)


if __name__ == "__main__":
    main()
