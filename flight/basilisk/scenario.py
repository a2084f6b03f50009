"""Scenarios of Precess from Basilisk's configurations: a hub, wheels of `rwFactory`, gyros of `VSCMGConfigMsgPayload`.

    from scenario import scenario
    Path("craft.toml").write_text(scenario("craft", scObject.hub, rwFactory.rwList.values(), gyros))

then `precess check craft.toml`. Devices are fully coupled, as in `parameter_table.py`, which says what is refused. Numbers have the
digits that read back the same, in SI units. The angle of a wheel at the start is zero, as in Basilisk; of the hub
attitude and angular velocity are those at the start.
"""

from parameter_table import columns, coupled, vector, viscous_alone, without

MODEL = {"RWModel": "JitterFullyCoupled", "VSCMGModel": "vscmgJitterFullyCoupled"}


def scenario(name, hub, wheels=(), gyros=(), duration=10.0):
    """The text of a scenario file."""
    rows = [[float(x) for x in row] for row in hub.IHubPntBc_B]
    lines = ["format = 1", f'name = "{name}"', f'title = "{name}, from Basilisk"']
    lines += ["", "[hub]", f'mass = "{number(hub.mHub)} kg"', quantity("centre_of_mass", vector(hub.r_BcB_B), "m")]
    lines += inertia(rows)
    lines += ["", "[initial]", quantity("angular_velocity", vector(hub.omega_BN_BInit), "rad/s")]
    sigma = [number(x) for x in vector(hub.sigma_BNInit)]
    lines.append(f"attitude = {{ mrp = [{', '.join(sigma)}] }}")
    for index, config in enumerate(wheels, 1):
        lines += wheel(f"rw{index}", config)
    for index, config in enumerate(gyros, 1):
        lines += gyro(f"vscmg{index}", config)
    lines += ["", "[run]", f'duration = "{number(duration)} s"', ""]
    return "\n".join(lines)


def wheel(name, config):
    coupled(config.RWModel, "RWModel", MODEL["RWModel"])
    viscous_alone(config)
    axes = [vector(config.gsHat_B), vector(config.w2Hat0_B), vector(config.w3Hat0_B)]
    lines = device(name, "reaction_wheel", config.rWB_B, axes)
    lines += rotor(config.mass, config.U_s, (config.Js, config.Jt, config.Jg), config.U_d, config.Omega)
    lines += torque(config.u_current)
    if config.cViscous > 0.0:
        lines.append(f'damping = "{number(config.cViscous)} N m s"')
    return lines


def gyro(name, config):
    coupled(config.VSCMGModel, "VSCMGModel", MODEL["VSCMGModel"])
    for friction in ("u_s_f", "u_g_f"):
        without(config, friction)
    axes = [vector(config.gsHat0_B), vector(config.gtHat0_B), vector(config.ggHat_B)]
    lines = device(name, "vscmg", config.rGB_B, axes)
    rows = [
        [config.IG1, config.IG12, config.IG13],
        [config.IG12, config.IG2, config.IG23],
        [config.IG13, config.IG23, config.IG3],
    ]
    lines += ["", "[device.gimbal]", f'mass = "{number(config.massG)} kg"']
    lines += [quantity("centre_of_mass", vector(config.rGcG_G), "m"), *inertia(rows)]
    lines += [f'angle = "{number(config.gamma)} rad"', f'rate = "{number(config.gammaDot)} rad/s"']
    lines += torque(config.u_g_current)
    moments = (config.IW1, config.IW2, config.IW3)
    lines += rotor(config.massW, config.U_s, moments, config.U_d, config.Omega)
    return [*lines, *torque(config.u_s_current), quantity("origin", [config.l, 0.0, config.L], "m")]


def torque(of):
    """That of the motor, from the start on."""
    return [f'torque = "{number(of)} N m"'] if float(of) else []


def device(name, kind, position, axes):
    mount = columns(axes)
    rows = ", ".join(f"[{', '.join(number(x) for x in mount[3 * row : 3 * row + 3])}]" for row in range(3))
    head = ["", "[[device]]", f'name = "{name}"', f'kind = "{kind}"', quantity("position", vector(position), "m")]
    return [*head, f"mount = {{ matrix = [{rows}] }}"]


def rotor(mass, static, moments, dynamic, rate):
    lines = ["", "[device.wheel]", f'mass = "{number(mass)} kg"']
    lines.append(quantity("centre_of_mass", [0.0, static / mass, 0.0], "m"))
    axial, second, third = moments
    lines += inertia([[axial, 0.0, dynamic], [0.0, second, 0.0], [dynamic, 0.0, third]])
    return [*lines, f'rate = "{number(rate)} rad/s"']


def inertia(rows):
    moments = [rows[k][k] for k in range(3)]
    products = [rows[0][1], rows[0][2], rows[1][2]]
    return [quantity("inertia", moments, "kg m^2"), quantity("products_of_inertia", products, "kg m^2")]


def quantity(key, values, unit):
    return f'{key} = "{", ".join(number(x) for x in values)} {unit}"'


def number(value):
    """The digits that read back the same."""
    return repr(float(value))
