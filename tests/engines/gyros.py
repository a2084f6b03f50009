"""Writes tests/fixtures/gyros.json: a run of two imbalanced VSCMGs with motors by Basilisk.

    python gyros.py           runs it; writes its states
    python gyros.py --check   the same, compared with the stored file; writes nothing

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
    "gyros": [
        {"quaternion": [3, 1, -2, 1], "r_g_b": [0.2, 0.1, -0.2], "m_g": 3.0,
         "r_gc_g": [0.004, -0.02, 0.01], "i_g_gc": [0.05, 0.004, -0.003, 0.06, 0.002, 0.08],
         "l_g_xz": [0.01, 0.03], "m_w": 6.0, "i_w_wc": [0.0191, 0.0114, 0.0109],
         "u_s": 3e-3, "u_d": 4e-4, "gamma": 0.4, "gamma_dot": 0.06, "spin": 52.0,
         "u_g": 0.004, "u_w": 0.02},
        {"quaternion": [2, -1, 1, 3], "r_g_b": [-0.1, 0.3, -0.1], "m_g": 4.0,
         "r_gc_g": [-0.01, 0.005, 0.02], "i_g_gc": [0.07, -0.003, 0.002, 0.05, 0.004, 0.06],
         "l_g_xz": [-0.02, 0.04], "m_w": 9.0, "i_w_wc": [0.03, 0.02, 0.021],
         "u_s": 4e-3, "u_d": -6e-4, "gamma": -1.1, "gamma_dot": -0.05, "spin": -41.0,
         "u_g": -0.003, "u_w": -0.015},
    ],
}  # fmt: skip


def main():
    try:
        import gyros_with_basilisk
    except ModuleNotFoundError as error:
        if error.name not in ("Basilisk", "numpy"):
            raise
        print(error, file=sys.stderr)
        sys.exit(runs.MISSING)
    craft = {**CRAFT, "gyros": [mounted(gyro) for gyro in CRAFT["gyros"]]}
    runs.main(__doc__, "gyros", craft, gyros_with_basilisk)


if __name__ == "__main__":
    main()
