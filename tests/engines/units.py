"""Functional mock-up units of `precess export fmu` in FMPy, against `precess run`; stores nothing.

    python units.py --check   exports, validates, compiles, simulates and compares

Of each scenario, with fixed steps, and of FMI 2.0 and FMI 3.0: FMPy validates the unit without a finding and compiles it without
a warning; outputs of Co-Simulation have the bits of `precess run` at every sample, with inputs where the scenario varies them;
Model Exchange by CVode agrees with Co-Simulation at short steps; every derivative depends on what the model structure lists, and
on nothing else; derivatives along each state and input, and of weighed sums, agree with differences; a restored
state, and one of bytes, repeats what followed it. Units that run the simulator's engine, of an isolated platform, of flexible
structures and of controllers, are validated, and their outputs have the bits of every column that the run records.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import os
import random
import shutil
import sys
import tempfile
from pathlib import Path

MISSING = 77
# CVode, and by how much it may differ from Co-Simulation, of the larger of one and the output's largest magnitude.
TOLERANCE = 1e-10
AGREEMENT = 1e-7

try:
    import fmpy
    import numpy as np
    import programs
    from fmpy.build import build_platform_binary
    from fmpy.validation import validate_fmu
    from engine_units import check as check_engine
    from importers import instance
    from recordings import SCENARIOS, ran, recorded
    from unit_derivatives import check as derivatives
except ModuleNotFoundError as error:
    if error.name not in ("fmpy", "numpy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

HUB = """format = 1
title = "<unit> & \\"quotes\\""
[hub]
mass = "90 kg"
centre_of_mass = "1, -2, 3 cm"
inertia = "20, 21, 22 kg m^2"
[initial]
angular_velocity = "1, -2, 3 deg/s"
attitude = { euler = "5, 6, 7 deg", sequence = "ZYX", direction = "N to B" }
[run]
duration = "1 s"
[output]
rate = "1 kHz"
"""
GYRO = """[[device]]
name = "gyro"
kind = "dgvscmg"
position = "30, 10, 0 cm"
imbalance = { static = "5 g cm", dynamic = "50 g cm^2" }
outer_gimbal = { mass = "3 kg", inertia = "0.05, 0.04, 0.05 kg m^2", OUTER }
inner_gimbal = { mass = "2 kg", inertia = "0.02, 0.03, 0.02 kg m^2", angle = "10 deg", INNER }
wheel = { mass = "4 kg", inertia = "0.02, 0.011, 0.011 kg m^2", rate = "1000 rpm", WHEEL }
"""
# A locked joint, one of given acceleration, a torque beyond its limit; on a hub that is fixed, in a uniform field.
FIXED = (
    HUB.replace("[initial]", "mode = \"fixed\"\n[initial]").replace('angular_velocity = "1, -2, 3 deg/s"\n', "")
    + '[gravity]\nuniform = "1, -2, -9 m/s^2"\n'
    + GYRO.replace("OUTER", "locked = true")
    .replace("INNER", 'acceleration = "0.1 rad/s^2"')
    .replace("WHEEL", 'torque = "3 N m", torque_limit = "1 N m"')
)
# Springs, and wrenches: on a body, and on the hub along the axes of N.
PUSHED = (
    HUB
    + GYRO.replace("OUTER", 'stiffness = "3 N m/rad", damping = "0.1 N m s/rad"')
    .replace("INNER", 'damping = "0.2 N m s/rad"')
    .replace("WHEEL", 'torque = "0.1 N m"')
    + """[[wrench]]
on = "hub"
axes = "inertial"
force = "1, 2, -3 N"
point = "5, 0, 1 cm"
[[wrench]]
on = "gyro.inner_gimbal"
force = "-2, 1, 1 N"
moment = "0.1, 0, 0.2 N m"
point = "1, 2, 3 cm"
"""
)


def bus(time):
    """What the scenario varies with time."""
    torque = 0.0 if time < 2.0 else -0.15 if time < 5.0 else 0.15 if time < 8.0 else 0.0
    return {"wheel_z_u_w": torque, "wrench_1_force_z": 1.0 if 0.5 <= time < 1.0 else 0.0}


# Of a scenario that records less than its states: what is recorded.
COLUMNS = {"imaging-satellite": ["position", "velocity", "attitude", "omega", "cmg1", "cmg2", "cmg3", "cmg4"]}

# Name, step in s, samples per second, duration in s; the text of a file that is written; inputs at a time.
CASES = (
    ("table1-printed-free", "1e-3", 500.0, 2.0, None, None),
    ("table1-catalogue-200", "1e-3", 500.0, 2.0, None, None),
    ("bus-three-wheels", "1e-3", 500.0, 12.0, None, bus),
    ("imaging-satellite", "1e-3", 500.0, 2.0, None, None),
    ("orbit-gravity-gradient", "1", 0.1, 3000.0, None, None),
    ("every-kind", "1e-3", 500.0, 1.0, None, None),
    ("fixed", "1e-3", 1000.0, 1.0, FIXED, None),
    ("pushed", "1e-3", 1000.0, 1.0, PUSHED, None),
)
class Unit:
    """A unit that is exported, validated, unpacked and compiled."""

    def __init__(self, folder, programs, file, step, version):
        self.name = f"{file.stem}, FMI {version}.0"
        self.folder = folder / f"{file.stem}-{version}"
        self.archive = self.folder.with_suffix(".fmu")
        options = ("--step", f"{step} s", "--fmi", version, "--to", self.archive)
        ran(programs / "precess", "export", "fmu", file, *options)
        if findings := validate_fmu(str(self.archive)):
            sys.exit(f"{self.name}: {findings}")
        fmpy.extract(str(self.archive), unzipdir=str(self.folder))
        build_platform_binary(self.folder, all_warnings=True, cmake_options={"CMAKE_C_FLAGS:STRING": "-Werror"})
        self.description = fmpy.read_model_description(str(self.folder))
        if self.description.fmiVersion != f"{version}.0":
            sys.exit(f"{self.name}: it says {self.description.fmiVersion}")
        self.variables = self.description.modelVariables
        self.place = {variable.name: variable.valueReference for variable in self.variables}
        self.outputs = [v.name for v in self.variables if v.causality == "output"]

    def instance(self, exchanges=False, name="unit"):
        return instance(self.description, self.folder, exchanges, name)

    def read(self, one):
        return one.get([self.place[name] for name in self.outputs])


def stepped(unit, one, inputs, step, start, count):
    """Takes steps; the outputs before each, and after the last."""
    rows = []
    for index in range(start, start + count):
        rows.append(unit.read(one))
        time = index * step
        if inputs:
            given = inputs(time)
            one.set([unit.place[name] for name in given], list(given.values()))
        one.step(time, step)
    rows.append(unit.read(one))
    return rows


def co_simulation(unit, run, case):
    """Bits of every sample; how many numbers."""
    _, step, rate, duration, _, inputs = case
    length = float(step)
    one = unit.instance()
    rows = stepped(unit, one, inputs, length, 0, round(duration / length))
    one.close()
    columns, samples = run
    every = round(1.0 / (rate * length))
    picked = rows[::every]
    if len(picked) != len(samples):
        sys.exit(f"{unit.name}: {len(samples)} samples against {len(picked)}")
    for index, (mine, sample) in enumerate(zip(picked, samples, strict=True)):
        for name, value in zip(unit.outputs, mine, strict=True):
            stored = float(sample[columns[name]])
            if value != stored:
                sys.exit(f"{unit.name}, sample {index}, {name}: {value!r} against {stored!r}")
    return len(picked) * len(unit.outputs)


def model_exchange(unit, case):
    """CVode against Co-Simulation with steps of a fourth, without inputs; the largest difference of the size."""
    name, step, _, duration, _, inputs = case
    if inputs or name == "every-kind":
        duration = min(duration, 0.4)
    stop = min(duration, 2.0) if float(step) < 1.0 else 100.0
    arguments = {"stop_time": stop, "output_interval": stop / 20.0, "output": unit.outputs}
    # A wrench along N is held in B over each step: an error of the first order.
    short = {"step": float(step) / (100.0 if name == "pushed" else 4.0)}
    by_step = fmpy.simulate_fmu(
        str(unit.folder), fmi_type="CoSimulation", start_values=short, step_size=stop / 20.0, **arguments
    )
    by_cvode = fmpy.simulate_fmu(
        str(unit.folder), fmi_type="ModelExchange", relative_tolerance=TOLERANCE, **arguments
    )
    worst = 0.0
    for output in unit.outputs:
        size = max(1.0, np.abs(by_step[output]).max())
        worst = max(worst, np.abs(by_step[output] - by_cvode[output]).max() / size)
    if not worst <= AGREEMENT:
        sys.exit(f"{unit.name}: Model Exchange differs by {worst:e}, above {AGREEMENT:g}")
    return worst


def dependencies(unit, chance):
    """Every derivative changes with what is listed, and with nothing else; how many pairs."""
    one = unit.instance(exchanges=True)
    states = [v for v in unit.variables if v.causality == "output"]
    derivatives = [v for v in unit.variables if v.derivative is not None]
    # Springs and offsets wherever they may be: in a scenario that has none of them less depends on less.
    tuned = [v for v in unit.variables if v.variability == "tunable"]
    springs = [v for v in tuned if v.name.endswith(("_stiffness", "_rest", "_damping"))]
    offsets = [v for v in tuned if "_origin_" in v.name or "_centre_of_mass_" in v.name]
    one.set([v.valueReference for v in springs], [chance.uniform(1.0, 2.0) for _ in springs])
    one.set([v.valueReference for v in offsets], [chance.uniform(0.01, 0.03) for _ in offsets])
    listed = {d.name: {} for d in derivatives}
    initial = {d.name: {} for d in derivatives}
    for found, unknowns in (
        (listed, unit.description.derivatives),
        (initial, unit.description.initialUnknowns),
    ):
        for unknown in unknowns:
            found[unknown.variable.name] = {known.name for known in unknown.dependencies}
    one.enter_continuous_time()
    x = np.array([float(state.start) for state in states])
    for index, state in enumerate(states):
        x[index] += chance.uniform(-0.1, 0.1) * float(state.nominal or 1.0)
    inputs = [v for v in unit.variables if v.causality == "input"]
    one.set([v.valueReference for v in inputs], [chance.uniform(0.01, 0.05) for _ in inputs])

    def rates():
        return one.get([d.valueReference for d in derivatives])

    def differs(known, changed, lists):
        for derivative, was, now in zip(derivatives, base, changed, strict=True):
            depends = known.name in lists[derivative.name]
            # A wheel on bearings that move in all six ways acts on the rest by springs: its mass may be in no other equation.
            if depends and was == now and known.name.startswith("soft_"):
                continue
            # What is at rest on a hub that is at rest has no part in a motion, and is listed as where it moves.
            if depends and was == now and unit.name.startswith("fixed,"):
                continue
            if depends != (was != now):
                sys.exit(f"{unit.name}: {derivative.name} and {known.name}: listed {depends}, {was!r} and {now!r}")

    one.set_states(x)
    base = rates()
    pairs = 0
    for index, state in enumerate(states):
        y = x.copy()
        y[index] += 0.01 * float(state.nominal or 1.0)
        one.set_states(y)
        differs(state, rates(), listed)
        pairs += len(derivatives)
    one.set_states(x)
    for known in inputs:
        was = one.get([known.valueReference])
        one.set([known.valueReference], [was[0] + 0.05])
        differs(known, rates(), listed)
        pairs += len(derivatives)
        one.set([known.valueReference], was)
    one.enter_event_mode()
    for known in tuned:
        if not known.name.endswith(("_mass", "_stiffness", "gravity_mu")):
            continue
        was = one.get([known.valueReference])
        one.set([known.valueReference], [was[0] * 1.01 + 1e-3])
        differs(known, rates(), initial)
        pairs += len(derivatives)
        one.set([known.valueReference], was)
    one.close()
    return pairs


def restored(unit, case):
    """A state that is set again, and one of bytes, are followed by the same."""
    step = float(case[1])
    one, other = unit.instance(), unit.instance(name="other")
    stepped(unit, one, None, step, 0, 20)
    state = one.state()
    stored = one.to_bytes(state)
    first = stepped(unit, one, None, step, 20, 20)
    one.set_state(state)
    second = stepped(unit, one, None, step, 20, 20)
    of_bytes = other.of_bytes(stored)
    other.set_state(of_bytes)
    third = stepped(unit, other, None, step, 20, 20)
    if not first == second == third:
        sys.exit(f"{unit.name}: a restored state is followed by something else")
    one.free_state(state)
    other.free_state(of_bytes)
    one.close()
    other.close()


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="as without it: nothing is stored")
    arguments.parse_args()
    if not shutil.which("cmake"):
        os.environ["PATH"] += os.pathsep + str(Path(sys.executable).parent)
    built = programs.folder()
    chance = random.Random(40)
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        for case in CASES:
            name, text = case[0], case[4]
            file = SCENARIOS / f"{name}.toml"
            if text:
                file = folder / f"{name}.toml"
                file.write_text(text, encoding="utf-8")
            _, step, rate, duration, _, _ = case
            columns = ("--set", f"output.columns={COLUMNS[name]!r}") if name in COLUMNS else ()
            run = recorded(folder, built, file, step, duration, rate, columns)
            drawn = chance.getstate()
            for version in (2, 3):
                # The same states, inputs and springs of both.
                chance.setstate(drawn)
                unit = Unit(folder, built, file, step, version)
                size = unit.archive.stat().st_size
                count = co_simulation(unit, run, case)
                worst = model_exchange(unit, case)
                pairs = dependencies(unit, chance)
                slopes, off = derivatives(unit, chance)
                restored(unit, case)
                print(
                    f"fmpy {fmpy.__version__}, {unit.name}: {size // 1000} kB, valid; {count} numbers of Co-Simulation have the"
                    f" bits of the run; Model Exchange differs by {worst:.1e}; {pairs} pairs depend as listed;"
                    f" {slopes} derivatives differ from differences by {off:.1e}",
                    flush=True,
                )
        check_engine(folder, built)


if __name__ == "__main__":
    main()
