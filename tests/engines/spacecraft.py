"""Seeded random spacecraft: masses, places, inertias, state and torques, before any engine.

Inputs are drawn with Python's own generator, whose numbers are the same on every machine, and
rounded to six digits: short to read, and free of the last bits of a C library. Only a mount is
not rounded, since it must be orthonormal; it takes only + - * / of a rounded quaternion.
"""

import math
import random

import numpy as np

UNIT_SCALES = 6
DECLARED_RANGES = 6
ENTRIES = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
AXES = "xyz"


def all_spacecraft():
    """The stored spacecraft, in order: one device at unit scales, then 1 to 4 over the ranges."""
    for seed in range(UNIT_SCALES):
        yield unit_scales(f"one device, unit scales, {seed}", seed)
    for number in range(DECLARED_RANGES):
        yield over_ranges(number)


def more_spacecraft(count):
    """As many more over the ranges, after the stored ones."""
    for number in range(DECLARED_RANGES, DECLARED_RANGES + count):
        yield over_ranges(number)


def over_ranges(number):
    """Number so and so over the ranges: 1 to 4 devices in turn."""
    n = 1 + number % 4
    return declared_ranges(f"N = {n}, declared ranges, {number}", UNIT_SCALES + number, n)


def unit_scales(name, seed):
    """Every number of order one, so that every term of every equation counts."""
    draw = Draw(seed)

    def body():
        # Unlike second moments along turned axes: the products count as much as the moments.
        moments = [draw.within(0.1, 1.5) for _ in AXES]
        return draw.within(0.5, 1.5), solid(1.0, moments, draw.quaternion())

    def offset():
        return [draw.signed(0.3, 1.5) for _ in AXES]

    m_b, i_b = body()
    (m_go, i_go), (m_gi, i_gi), (m_w, j) = body(), body(), body()
    places = {"r_go_b": offset(), "r_goc_go": offset(), "l_o": offset(), "r_gic_gi": offset()}
    device = {
        "mount": np.eye(3).tolist(),
        "parameters": parameters(
            **places, l_i=offset(), d=draw.signed(0.3, 1.5),
            m_go=m_go, i_go=i_go, m_gi=m_gi, i_gi=i_gi, m_w=m_w, j=j,
        ),
        "angles": {k: draw.signed(0.3, math.pi) for k in ("gamma_o", "gamma_i", "theta")},
        "rates": {k: draw.signed(0.3, 1.5) for k in ("gamma_o_dot", "gamma_i_dot", "spin")},
        "motors": {k: draw.signed(0.3, 1.5) for k in ("u_o", "u_i", "u_w")},
    }
    hub = {"m_b": m_b, "r_bc_b": offset(), "i_b": i_b}
    motion = {k: offset() for k in ("omega", "r_b_n_dot", "force", "torque_b")}
    whose = {"name": name, "scales": "unit", "seed": seed}
    return {**whose, "hub": hub, "devices": [device], **motion}


def declared_ranges(name, seed, n):
    """Solid blocks and discs over the ranges that the suites declare (tests/src/random.rs)."""
    draw = Draw(seed)

    def block(mass):
        edges = [draw.log_within(0.05, 3.0) for _ in AXES]
        return solid(mass, [edge**2 / 12.0 for edge in edges], draw.quaternion())

    def device(heaviest):
        m_go, m_gi, m_w = (draw.log_within(0.1, heaviest) for _ in range(3))
        radius = draw.log_within(0.02, 0.5)
        thickness = radius * draw.within(0.1, 1.0)
        tilt = [1.0, 0.0, draw.signed(1e-6, 0.05), draw.signed(1e-6, 0.05)]
        disc = [thickness**2 / 12.0, radius**2 / 4.0, radius**2 / 4.0]
        inner = {
            k: draw.vector(draw.log_within(1e-3, 3.0))
            for k in ("r_goc_go", "l_o", "r_gic_gi", "l_i")
        }
        return {
            "mount": rotation(draw.quaternion()).tolist(),
            "parameters": parameters(
                r_go_b=draw.vector(draw.within(0.0, 3.0)), **inner,
                d=draw.signed(1e-6, radius), m_go=m_go, i_go=block(m_go),
                m_gi=m_gi, i_gi=block(m_gi), m_w=m_w, j=solid(m_w, disc, tilt),
            ),
            "angles": {
                "gamma_o": draw.within(-math.pi, math.pi),
                "gamma_i": draw.within(-math.pi, math.pi),
                "theta": draw.within(-1000.0, 1000.0),
            },
            "rates": {
                "gamma_o_dot": draw.within(-5.0, 5.0),
                "gamma_i_dot": draw.within(-5.0, 5.0),
                "spin": draw.within(-628.0, 628.0),
            },
            "motors": {k: draw.signed(1e-4, 10.0) for k in ("u_o", "u_i", "u_w")},
        }

    m_b = draw.log_within(1.0, 5000.0)
    hub = {"m_b": m_b, "r_bc_b": draw.vector(draw.within(0.0, 3.0)), "i_b": block(m_b)}
    return {
        "name": name, "scales": "declared", "seed": seed, "hub": hub,
        "devices": [device(m_b) for _ in range(n)],
        "omega": draw.vector(draw.within(0.0, 1.0)),
        "r_b_n_dot": draw.vector(draw.within(0.0, 10.0)),
        "force": draw.vector(draw.log_within(1e-3, 100.0)),
        "torque_b": draw.vector(draw.log_within(1e-4, 10.0)),
    }  # fmt: skip


def parameters(*, r_go_b, r_goc_go, m_go, i_go, l_o, r_gic_gi, m_gi, i_gi, l_i, d, m_w, j):
    """The fields of the solver's `Parameters`, in its order."""

    def entries(name, inertia):
        return {f"{name}_{i + 1}{k + 1}": x for (i, k), x in zip(ENTRIES, inertia)}

    def components(name, axes, vector):
        return {f"{name}_{axes}{axis}": x for axis, x in zip(AXES, vector)}

    return {
        **components("r_go_b", "b", r_go_b), **components("r_goc_go", "go", r_goc_go),
        "m_go": m_go, **entries("i_go", i_go), **components("l_o", "", l_o),
        **components("r_gic_gi", "gi", r_gic_gi), "m_gi": m_gi, **entries("i_gi", i_gi),
        **components("l_i", "", l_i), "d": d, "m_w": m_w, **entries("j", j),
    }  # fmt: skip


def rotation(q):
    """The rotation of a quaternion of any length, scalar first: columns are the new axes."""
    w, x, y, z = q
    s = 2.0 / (w * w + x * x + y * y + z * z)
    return np.array([
        [1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)],
        [s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)],
        [s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)],
    ])  # fmt: skip


def solid(mass, moments, q):
    """Inertia entries of a body with these second moments a kilogram along turned axes, m^2.

    `tr(P) 1 - P` with P positive: the triangle inequality holds whatever is drawn.
    """
    axes = rotation(q)
    p = mass * (axes * np.array(moments)) @ axes.T
    inertia = np.trace(p) * np.eye(3) - p
    return [short(inertia[entry]) for entry in ENTRIES]


def short(x):
    """Six significant digits."""
    return float(f"{x:.6g}")


class Draw:
    """Random numbers of one spacecraft."""

    def __init__(self, seed):
        # Of this generator only `random()` is promised never to change.
        self.next = random.Random(seed).random

    def within(self, low, high):
        return short(low + (high - low) * self.next())

    def log_within(self, low, high):
        return short(low * math.exp(math.log(high / low) * self.next()))

    def signed(self, low, high):
        """Either sign, log-uniform magnitude."""
        return self.log_within(low, high) * (1.0 if self.next() < 0.5 else -1.0)

    def ball(self, dimensions):
        """A point of the unit ball, away from its centre."""
        while True:
            v = [self.within(-1.0, 1.0) for _ in range(dimensions)]
            if 0.01 <= sum(x * x for x in v) <= 1.0:
                return v

    def vector(self, length):
        v = self.ball(3)
        share = length / math.sqrt(sum(x * x for x in v))
        return [short(share * x) for x in v]

    def quaternion(self):
        """A uniform rotation; not of unit length."""
        return self.ball(4)
