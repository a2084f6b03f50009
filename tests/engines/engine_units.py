"""Units that run the simulator's engine in FMPy, against `precess run`."""

import sys

import fmpy
from fmpy.validation import validate_fmu
from importers import instance
from recordings import SCENARIOS, ran, recorded

# Name, step in s, samples per second, duration in s, other settings: of what the engine runs. Requirements are judged within
# the duration.
OF_ENGINE = (
    ("wheels-on-isolator", "5e-4", 1000.0, 0.5, ()),
    ("gyro-pyramid-slew", "2e-3", 50.0, 3.0, ('requirement."pointing in the dwell".from=1 s',)),
    ("imaging-satellite-flexible", "1e-4", 2000.0, 0.2, ("requirement.jitter.from=50 ms", "requirement.jitter.to=200 ms")),
    ("flexible-slew", "2e-3", 50.0, 3.0, ('requirement."pointing in the dwell".from=1 s',)),
)


def of_engine(folder, programs, library, case, version):
    """A unit that runs the engine: bits of every column at every sample, also from a state; its size, and how many numbers."""
    name, step, rate, duration, others = case
    file = SCENARIOS / f"{name}.toml"
    archive = folder / f"{name}-{version}.fmu"
    others = [part for setting in others for part in ("--set", setting)]
    settings = ("--set", f"run.duration={duration!r} s", *others)
    options = ("--step", f"{step} s", "--fmi", version, "--binary", "--engine", library, "--to", archive, "--force")
    ran(programs / "precess", "export", "fmu", file, *options, *settings)
    if findings := validate_fmu(str(archive)):
        sys.exit(f"{name}, FMI {version}.0: {findings}")
    fmpy.extract(str(archive), unzipdir=str(archive.with_suffix("")))
    description = fmpy.read_model_description(str(archive.with_suffix("")))
    outputs = [v for v in description.modelVariables if v.causality == "output"]
    columns, samples = recorded(folder, programs, file, step, duration, rate, others)
    if len(columns) != len(outputs) + 1:
        sys.exit(f"{name}: {len(outputs)} outputs of {len(columns)} columns")
    made = (instance(description, archive.with_suffix(""), name=name) for name in ("one", "other", "third"))
    one, other, third = made
    places = [v.valueReference for v in outputs]

    def run(of, first, last):
        for index in range(first, last):
            if index:
                of.step((index - 1) / rate, index / rate - (index - 1) / rate)
            for output, value, stored in zip(outputs, of.get(places), samples[index][1:], strict=True):
                if value != float(stored) and not (value != value and stored == "nan"):
                    sys.exit(f"{name}, FMI {version}.0, sample {index}, {output.name}: {value!r} against {stored}")

    # Instances share nothing; a state goes on as the run does, in the instance that it is of and, by its bytes, in another.
    saved, end = len(samples) // 3, len(samples)
    for index in range(saved):
        for of in (one, other):
            run(of, index, index + 1)
    state = one.state()
    stored = one.to_bytes(state)
    for index in range(saved, end):
        for of in (one, other):
            run(of, index, index + 1)
    one.set_state(state)
    of_bytes = third.of_bytes(stored)
    third.set_state(of_bytes)
    for index in range(saved, end):
        for of in (one, third):
            run(of, index, index + 1)
    one.free_state(state)
    third.free_state(of_bytes)
    for of in (one, other, third):
        of.close()
    return archive.stat().st_size, len(samples) * len(outputs)


def check(folder, programs):
    """Each, in both versions of FMI."""
    library = programs / "libprecess_fmu.a"
    for case in OF_ENGINE:
        for version in (2, 3):
            size, count = of_engine(folder, programs, library, case, version)
            print(
                f"fmpy {fmpy.__version__}, {case[0]} by the engine, FMI {version}.0: {size / 1e6:.1f} MB, valid; {count} numbers of"
                " Co-Simulation have the bits of the run, also from a state and from its bytes",
                flush=True,
            )
