"""The effector of flight/basilisk in Basilisk: against our own runs, against Basilisk's effector, beside a panel of Basilisk.

    python effector.py           runs all by the command `precess` and in Basilisk; compares
    python effector.py --check   the same

Nothing is stored. The C library and the effector are built first, in target/flight and target/basilisk: CMake, a C++
compiler and Python's headers (python3-dev) are needed.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package or a program is missing: see
requirements.txt.
"""

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

MISSING = 77
ROOT = Path(__file__).resolve().parent.parent.parent
BUILT = ROOT / "target" / "basilisk"
LIBRARY = ROOT / "target" / "flight"
# Of the largest value of each quantity over the run, against ours by RK4 at the same step.
AS_OURS = 1e-10
# The same, against Basilisk's own effector: rounding over a run.
AS_BASILISK = 1e-11
# Relative drift over the run with a panel, by RK4 at 0.5 ms.
CLOSED = 1e-10
SCENARIOS = {"table1-printed-200": "10 s", "wheels-on-isolator": "10 s"}



def build():
    """The library as `cargo xtask capi` builds it, and the effector; nothing where a program or the kit is missing."""
    try:
        import bsk_sdk
    except ModuleNotFoundError:
        return
    if shutil.which("cmake") is None:
        print("cmake is missing", file=sys.stderr)
        sys.exit(MISSING)
    cargo = os.environ.get("CARGO", "cargo")
    library = ["--manifest-path", "flight/Cargo.toml", "--target-dir", str(LIBRARY)]
    configuration = [f"-DPython3_EXECUTABLE={sys.executable}", f"-Dbsk-sdk_DIR={bsk_sdk.cmake_config_dir()}"]
    configuration.append(f"-DPRECESS_LIBRARY_FOLDER={LIBRARY / 'release'}")
    for command in (
        [cargo, "build", "--quiet", "--release", *library],
        ["cmake", "-S", "flight/basilisk", "-B", str(BUILT), *configuration],
        ["cmake", "--build", str(BUILT)],
    ):
        done = subprocess.run(command, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if done.returncode != 0:
            print(done.stdout, file=sys.stderr)
            sys.exit(f"`{' '.join(command)}` failed")


build()
sys.path[:0] = [str(BUILT), str(ROOT / "flight" / "basilisk")]
try:
    import effector_in_basilisk as basilisk
    import gyros
    import numpy as np
    import programs
    import wheels
    from runs import mounted
except ModuleNotFoundError as error:
    if error.name not in ("Basilisk", "numpy", "precessStateEffector"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="the same: nothing is stored")
    arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for scenario, duration in SCENARIOS.items():
            as_ours(Path(folder), scenario, duration)
        craft = {**wheels.CRAFT, "wheels": [mounted(wheel) for wheel in wheels.CRAFT["wheels"]]}
        as_basilisk(Path(folder), craft)
        from_configurations(Path(folder))
        beside_a_panel(Path(folder))
        refused(Path(folder))


def precess(*arguments):
    run = [programs.folder() / "precess", *arguments]
    subprocess.run(run, cwd=ROOT, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def exported(folder, scenario):
    table = folder / f"{scenario}.table"
    if not table.exists():
        precess("export", "table", f"scenarios/{scenario}.toml", "--to", str(table))
    return str(table)


def as_ours(folder, scenario, duration):
    """The same devices, hub, torques and steps: a scenario run by us, and in Basilisk from its table."""
    settings = ["run.integrator=rk4", "run.step=1 ms", f"run.duration={duration}"]
    settings += ["output.rate=100 Hz", 'output.formats=["npz"]']
    options = [word for setting in settings for word in ("--set", setting)]
    precess("run", f"scenarios/{scenario}.toml", *options, "--no-report", "--out", str(folder))
    result = basilisk.Recorded(np.load(folder / f"{scenario}.npz"))
    errors = basilisk.difference_from(result, exported(folder, scenario))
    within(f"{scenario}, {duration}", errors, AS_OURS)


def as_basilisk(folder, craft):
    """Three imbalanced wheels in orbit: Basilisk's effector, and ours from its configuration."""
    own, ours = basilisk.in_orbit(craft, None), basilisk.in_orbit(craft, str(folder / "wheels.table"))
    errors = {name: relative(ours["states"][name], own["states"][name]) for name in own["states"]}
    within(f"three wheels in orbit, {craft['steps']} steps", errors, AS_BASILISK)
    times = basilisk.times(craft, str(folder / "wheels.table"))
    hub, theirs, our = times["hub"], times["basilisk"], times["precess"]
    share = (our - hub) / (theirs - hub)
    print(
        f"a step of the spacecraft, the least of runs that take turns: {1e6 * hub:.1f} us without wheels, with three "
        f"{1e6 * theirs:.1f} us by Basilisk's effector, {1e6 * our:.1f} us by ours: {share:.2f} of its cost"
    )


def from_configurations(folder):
    """Wheels and gyros of Basilisk's configurations as a scenario, run by us, and in Basilisk by its own effectors."""
    free = {"u_w": 0.0, "u_g": 0.0}
    craft = {**wheels.CRAFT, "wheels": [{**mounted(of), **free} for of in wheels.CRAFT["wheels"]]}
    craft["gyros"] = [{**mounted(of), **free} for of in gyros.CRAFT["gyros"]]
    run, text = basilisk.of_configurations(craft)
    path = folder / "configured.toml"
    path.write_text(text, encoding="utf-8")
    settings = ["run.integrator=rk4", "run.step=1 ms", "run.duration=2 s", "output.rate=100 Hz"]
    options = [word for setting in [*settings, 'output.formats=["npz"]'] for word in ("--set", setting)]
    precess("run", str(path), *options, "--no-report", "--out", str(folder))
    ours = basilisk.Recorded(np.load(folder / "configured.npz"))
    run.until(2000)
    rates = {"reactionWheelOmegas": [f"rw{n}.spin" for n in (1, 2, 3)], "VSCMGOmegas": ["vscmg1.spin", "vscmg2.spin"]}
    rates |= {"VSCMGGammas": ["vscmg1.gamma", "vscmg2.gamma"], "hubSigma": [f"sigma_{n}" for n in (1, 2, 3)]}
    rates |= {"hubOmega": ["omega_x", "omega_y", "omega_z"]}
    errors = {name: relative(ours.of(*columns)[-1], run.read(name)) for name, columns in rates.items()}
    within("a scenario from Basilisk's configurations, 2 s", errors, AS_OURS)


def beside_a_panel(folder):
    drift = basilisk.drift_with_panel(exported(folder, "table1-printed-200"))
    within("a DGVSCMG and a hinged panel of Basilisk, drift", drift, CLOSED)


def refused(folder):
    """What is wrong is an error of Basilisk that says what and where."""
    bad = folder / "bad.table"
    data = bytearray(Path(exported(folder, "table1-printed-200")).read_bytes())
    data[200] ^= 1
    bad.write_bytes(data)
    found = basilisk.messages(str(bad), exported(folder, "table1-printed-200"))
    expected = ("checksum", "cannot be read", "device 4 has no joint 0", "are both connected", "call readTable first")
    for message, part in zip(found, expected, strict=True):
        if part.lower() not in message.lower():
            sys.exit(f"{message!r} does not say {part!r}")


def relative(found, expected):
    return float(np.max(np.abs(found - expected)) / np.max(np.abs(expected)))


def within(what, errors, bound):
    name = max(errors, key=lambda name: errors[name])
    print(f"{what}: worst {errors[name]:.1e}, {name}")
    # A NaN is above every bound.
    if not all(error <= bound for error in errors.values()):
        sys.exit(f"{what}: {errors} above {bound:g}")


if __name__ == "__main__":
    main()
