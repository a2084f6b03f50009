"""Reaction wheels in Basilisk whose imbalance is a force and a torque: `JitterSimple`.

Basilisk counts such wheels with the hub, so the hub has their masses and inertias; along its axis a
wheel's inertia is its own again.
"""

import numpy as np
from Basilisk.simulation import reactionWheelStateEffector

import with_basilisk

VERSION = with_basilisk.VERSION


class Run(with_basilisk.Run):
    """The simulation, started, and all its objects kept alive."""

    def __init__(self, craft):
        super().__init__({**craft, "hub": with_wheels(craft)})

    def attached(self, craft):
        effector = super().attached(craft)
        for config, given in zip(self.configs, craft["wheels"]):
            config.RWModel = reactionWheelStateEffector.JitterSimple
            config.cViscous = given["viscous"]
        return effector


def samples(craft):
    """The state at the start and after every so many steps."""
    return with_basilisk.samples_of(Run(craft), craft)


def with_wheels(craft):
    """The hub with balanced wheels that stand still in it."""
    hub = craft["hub"]
    bodies = [(hub["m_b"], np.array(hub["r_bc_b"]), tensor(hub["i_b"]))]
    for wheel in craft["wheels"]:
        axes = np.array(wheel["mount"])
        moments = np.diag([wheel["axial"], wheel["transverse"], wheel["transverse"]])
        bodies.append((wheel["m_w"], np.array(wheel["r_w_b"]), axes @ moments @ axes.T))
    mass = sum(m for m, _, _ in bodies)
    centre = sum(m * r for m, r, _ in bodies) / mass

    def about_centre(m, r, inertia):
        arm = r - centre
        return inertia + m * (arm @ arm * np.eye(3) - np.outer(arm, arm))

    inertia = sum(about_centre(*body) for body in bodies)
    entries = [float(inertia[i, k]) for i, k in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]]
    return {"m_b": mass, "r_bc_b": centre.tolist(), "i_b": entries}


def tensor(entries):
    xx, xy, xz, yy, yz, zz = entries
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
