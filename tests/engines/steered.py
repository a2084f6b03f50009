"""Writes tests/fixtures/steered.json: 100 s of a spacecraft with four VSCMGs that Basilisk steers, by its law and its servo.

    python steered.py           runs it; writes its states and commands
    python steered.py --check   the same, compared with the stored file; writes nothing

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import sys

import runs
from runs import mounted


def gyro(quaternion, place, moments, wheel, gamma, spin):
    """A balanced VSCMG, its wheel in the origin of the gimbal, no torque at the start."""
    xx, yy, zz = moments
    axial, transverse = wheel
    return {
        "quaternion": quaternion, "r_g_b": place, "m_g": 3.0, "r_gc_g": [0.0] * 3,
        "i_g_gc": [xx, 0.0, 0.0, yy, 0.0, zz], "l_g_xz": [0.0, 0.0], "m_w": 6.0,
        "i_w_wc": [axial, transverse, transverse], "u_s": 0.0, "u_d": 0.0,
        "gamma": gamma, "gamma_dot": 0.0, "spin": spin, "u_g": 0.0, "u_w": 0.0,
    }  # fmt: skip


# Weights by which wheels give a share, which falls as the cluster leaves its singular pose.
CRAFT = {
    "step": 0.01,
    "steps": 10000,
    "every": 500,
    "control_every": 5,
    "stiffness": 12.0,
    "damping": 110.0,
    "gain": 5.0,
    "weights": [1.0, 4000.0],
    "mu": 2.0,
    "hub": {
        "m_b": 600.0,
        "r_bc_b": [0.02, -0.01, 0.05],
        "i_b": [520.0, 6.0, -4.0, 450.0, 5.0, 480.0],
    },
    "v_c_n": [0.0, 0.0, 0.0],
    "mrp": [0.15, -0.1, 0.12],
    "omega": [0.02, -0.03, 0.01],
    "gyros": [
        gyro([3, 1, -2, 1], [0.2, 0.1, -0.2], [0.03, 0.04, 0.05], [0.10, 0.06], 0.3, 220.0),
        gyro([2, -1, 1, 3], [-0.1, 0.3, -0.1], [0.04, 0.03, 0.04], [0.11, 0.07], -0.6, 210.0),
        gyro([1, 2, 2, -1], [0.1, -0.2, 0.2], [0.02, 0.03, 0.04], [0.09, 0.05], 0.5, 230.0),
        gyro([1, -1, 3, 2], [-0.2, -0.1, 0.1], [0.03, 0.05, 0.03], [0.12, 0.07], -0.2, 200.0),
    ],
}


def main():
    try:
        import steered_with_basilisk
    except ModuleNotFoundError as error:
        if error.name not in ("Basilisk", "numpy"):
            raise
        print(error, file=sys.stderr)
        sys.exit(runs.MISSING)
    craft = {**CRAFT, "gyros": [mounted(gyro) for gyro in CRAFT["gyros"]]}
    runs.main(__doc__, "steered", craft, steered_with_basilisk)


if __name__ == "__main__":
    main()
