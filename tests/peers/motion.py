"""What moved in a run, as every runner of steps prints it: see README.md, "Steps"."""

import numpy as np

# Steps over which motions are compared.
STEPS = 100


def motion(samples, time):
    """Blocks of several runs, one after another.

    A sample is position and velocity of B at the start, then those at the end, attitude as a
    quaternion with its scalar first, angular velocity, coordinates and rates of the joints.
    """
    blocks = {name: [] for name in
              ("displacement", "velocity", "attitude", "omega", "coordinates", "rates")}  # fmt: skip
    for (r_0, v_0), (r, v, quaternion, omega, coordinates, rates) in samples:
        r_0, v_0, r, v = (np.ravel(x) for x in (r_0, v_0, r, v))
        blocks["displacement"] += (r - r_0 - v_0 * time).tolist()
        blocks["velocity"] += (v - v_0).tolist()
        scalar, *vector = np.ravel(quaternion).tolist()
        blocks["attitude"] += [x if scalar >= 0.0 else -x for x in vector]
        blocks["omega"] += np.ravel(omega).tolist()
        blocks["coordinates"] += np.ravel(coordinates).tolist()
        blocks["rates"] += np.ravel(rates).tolist()
    return {"motion": blocks}


def quaternion_of(mrp):
    """The quaternion, scalar first, of modified Rodrigues parameters."""
    mrp = np.ravel(mrp)
    square = float(mrp @ mrp)
    return np.concatenate([[1.0 - square], 2.0 * mrp]) / (1.0 + square)
