"""Parameter tables of Precess from Basilisk's configurations of wheels and gyros, for `readTable` of the effector.

    from parameter_table import reaction_wheel, vscmg, write
    write("wheels.table", [reaction_wheel(rw) for rw in rwFactory.rwList.values()])

A device is fully coupled: `RWModel = JitterFullyCoupled`, `VSCMGModel = vscmgJitterFullyCoupled`. Basilisk counts other wheels with
the hub, so that they are refused here, as is friction that Precess does not have. The layout is that of `precess.h`, version 1.
"""

import struct
import zlib
from pathlib import Path

COUPLED = 0
REACTION_WHEEL, VSCMG = 9, 5
BODIES = 3
# Of Basilisk's enumerations of models.
FULLY_COUPLED = 2


def write(path, devices):
    """Writes the table of some devices. Its hub, of 1 kg, is for Precess alone: the effector does not use it."""
    Path(path).write_bytes(table(devices))


def table(devices):
    hub = [1.0, 0.0, 0.0, 0.0, *diagonal(1.0, 1.0, 1.0)]
    length = 124 + 584 * len(devices)
    head = struct.pack("<4s3I", b"PREC", 1, length, len(devices))
    body = head + struct.pack("<13d", *hub) + b"".join(devices)
    return body + struct.pack("<I", zlib.crc32(body))


def device(kind, mount, bodies, viscous):
    """`mount` row by row, its columns the device's axes; of each body mass, origin, centre, inertia."""
    numbers = [*mount]
    for body in bodies:
        numbers += body
    numbers += [0.0] * (16 * (BODIES - len(bodies)))
    for friction in viscous:
        numbers += [0.0, 0.0, friction, 0.0, 0.0]
    numbers += [0.0] * (5 * (BODIES - len(viscous)))
    return struct.pack("<2i72d", kind, COUPLED, *map(float, numbers))


def reaction_wheel(config):
    """A wheel of `RWConfigPayload`, as `rwFactory.create` makes it."""
    coupled(config.RWModel, "RWModel", "JitterFullyCoupled")
    viscous_alone(config)
    axes = [vector(config.gsHat_B), vector(config.w2Hat0_B), vector(config.w3Hat0_B)]
    inertia = [config.Js, 0.0, config.U_d, 0.0, config.Jt, 0.0, config.U_d, 0.0, config.Jg]
    wheel = [config.mass, *vector(config.rWB_B), 0.0, config.U_s / config.mass, 0.0, *inertia]
    return device(REACTION_WHEEL, columns(axes), [wheel], [config.cViscous])


def vscmg(config):
    """A gyro of `VSCMGConfigMsgPayload`; the angle of its wheel at the start is `setJoint`'s."""
    coupled(config.VSCMGModel, "VSCMGModel", "vscmgJitterFullyCoupled")
    for name in ("u_s_f", "u_g_f"):
        without(config, name)
    axes = [vector(config.gsHat0_B), vector(config.gtHat0_B), vector(config.ggHat_B)]
    upper = [config.IG1, config.IG12, config.IG13, config.IG2, config.IG23, config.IG3]
    gimbal = [config.massG, *vector(config.rGB_B), *vector(config.rGcG_G), *symmetric(*upper)]
    origin = [config.l, 0.0, config.L]
    inertia = symmetric(config.IW1, 0.0, config.U_d, config.IW2, 0.0, config.IW3)
    wheel = [config.massW, *origin, 0.0, config.U_s / config.massW, 0.0, *inertia]
    return device(VSCMG, columns(axes), [gimbal, wheel], [0.0, 0.0])


def coupled(model, name, expected):
    if model != FULLY_COUPLED:
        raise ValueError(f"{name} is {model}, not {expected}: Basilisk counts such a wheel with the hub")


def without(config, name):
    if getattr(config, name) > 0.0:
        raise ValueError(f"{name} is {getattr(config, name)}: Precess has no such friction here; set it to 0")


def viscous_alone(config):
    """Refuses friction of a wheel that Precess has otherwise or not at all."""
    without(config, "fCoulomb")
    if config.betaStatic > 0.0:
        raise ValueError(f"betaStatic is {config.betaStatic}: Stribeck friction is Basilisk's alone; set it to -1")


def vector(of):
    return [float(x[0]) if hasattr(x, "__len__") else float(x) for x in of]


def columns(axes):
    return [axes[column][row] for row in range(3) for column in range(3)]


def symmetric(xx, xy, xz, yy, yz, zz):
    return [xx, xy, xz, xy, yy, yz, xz, yz, zz]


def diagonal(xx, yy, zz):
    return symmetric(xx, 0.0, 0.0, yy, 0.0, zz)
