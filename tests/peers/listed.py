"""Spacecraft of which steps are compared, with their devices listed by kind and bodies.

Of every body: mass, origin of its joint (the first from B along B, others from the parent body's origin in
its axes), centre of mass from the origin and inertia about it along its own axes. Entries of a tensor come
in the order 11, 12, 13, 22, 23, 33.
"""

import numpy as np
import runs
import wheels

AXES = "xyz"
ENTRIES = ["11", "12", "13", "22", "23", "33"]

# Steps of the integrator where motions are compared, s.
STEP_OF_DGVSCMGS = 1e-4
STEP_OF_WHEELS = 1e-3
STEP_OF_VSCMG = 1e-4

# Imbalances a thousand times those of a real wheel, so that every term of the coupling counts.
VSCMG = {
    "hub": {"mass": 750.0, "centre": [-0.02, 0.01, 0.1],
            "inertia": [900.0, 12.0, -8.0, 800.0, 5.0, 600.0]},
    "omega": [0.08, 0.01, -0.03],
    "mount": runs.rotation(3, 1, -2, 1),
    "gamma": 0.4, "gamma_dot": 0.06, "spin": 209.0, "u_g": 0.008, "u_w": 0.02,
    "gimbal": {"mass": 6.0, "origin": [0.1, 0.02, -0.02], "centre": [0.001, -0.02, 0.01],
               "inertia": [0.1, 0.004, -0.003, 0.2, 0.002, 0.3]},
    "wheel": {"mass": 6.0, "l": 0.01, "L": 0.1, "u_s": 4.8e-3, "u_d": 1.54e-3,
              "inertia": [0.16, 0.08, 0.075]},
}  # fmt: skip


def of_dgvscmgs(craft):
    """A spacecraft of N DGVSCMGs from the fields of engines.json."""
    hub = craft["hub"]
    return {
        "step": STEP_OF_DGVSCMGS,
        "hub": {"mass": hub["m_b"], "centre": hub["r_bc_b"], "inertia": hub["i_b"]},
        "omega": craft["omega"],
        "force": craft["force"],
        "torque_b": craft["torque_b"],
        "devices": [dgvscmg(device) for device in craft["devices"]],
    }


def dgvscmg(device):
    p = device["parameters"]

    def vector(name):
        return [p[name + axis] for axis in AXES]

    def inertia(name):
        return [p[f"{name}_{entry}"] for entry in ENTRIES]

    origin = (np.array(device["mount"]) @ vector("r_go_b_b")).tolist()
    return {
        "kind": "dgvscmg",
        "mount": device["mount"],
        "bodies": [
            {"mass": p["m_go"], "origin": origin, "centre": vector("r_goc_go_go"),
             "inertia": inertia("i_go")},
            {"mass": p["m_gi"], "origin": vector("l_o_"), "centre": vector("r_gic_gi_gi"),
             "inertia": inertia("i_gi")},
            {"mass": p["m_w"], "origin": vector("l_i_"), "centre": [0.0, p["d"], 0.0],
             "inertia": inertia("j")},
        ],
        "coordinates": list(device["angles"].values()),
        "rates": list(device["rates"].values()),
        "motors": list(device["motors"].values()),
    }  # fmt: skip


def of_wheels():
    """The three imbalanced reaction wheels with motors of tests/engines/wheels.py."""
    craft = wheels.CRAFT
    hub = craft["hub"]
    return {
        "step": STEP_OF_WHEELS,
        "hub": {"mass": hub["m_b"], "centre": hub["r_bc_b"], "inertia": hub["i_b"]},
        "omega": craft["omega"],
        "force": [0.0] * 3,
        "torque_b": [0.0] * 3,
        "devices": [wheel(wheels.mounted(given)) for given in craft["wheels"]],
    }


def wheel(given):
    a, t = given["axial"], given["transverse"]
    return {
        "kind": "reaction_wheel",
        "mount": given["mount"],
        "bodies": [{"mass": given["m_w"], "origin": given["r_w_b"],
                    "centre": [0.0, given["u_s"] / given["m_w"], 0.0],
                    "inertia": [a, 0.0, given["u_d"], t, 0.0, t]}],
        "coordinates": [0.0],
        "rates": [given["spin"]],
        "motors": [given["u_w"]],
    }  # fmt: skip


def of_vscmg():
    """One imbalanced variable-speed control moment gyro."""
    given = VSCMG
    its = given["wheel"]
    xx, yy, zz = its["inertia"]
    rotor = {"mass": its["mass"], "origin": [its["l"], 0.0, its["L"]],
             "centre": [0.0, its["u_s"] / its["mass"], 0.0],
             "inertia": [xx, 0.0, its["u_d"], yy, 0.0, zz]}  # fmt: skip
    return {
        "step": STEP_OF_VSCMG,
        "hub": given["hub"],
        "omega": given["omega"],
        "force": [0.0] * 3,
        "torque_b": [0.0] * 3,
        "devices": [
            {
                "kind": "vscmg",
                "mount": given["mount"],
                "bodies": [given["gimbal"], rotor],
                "coordinates": [given["gamma"], 0.0],
                "rates": [given["gamma_dot"], given["spin"]],
                "motors": [given["u_g"], given["u_w"]],
            }
        ],
    }
