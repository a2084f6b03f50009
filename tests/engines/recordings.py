"""Samples of runs of the command `precess` by the names of a unit's variables."""

import csv
import subprocess
import sys

from programs import ROOT

SCENARIOS = ROOT / "scenarios"


def ran(program, *arguments):
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode not in (0, 2, 3):
        sys.exit(done.stderr)


def recorded(folder, programs, file, step, duration, rate, more=()):
    """Samples of `precess run` with the same steps, by the unit's names."""
    out = folder / f"{file.stem}-results"
    keys = {
        "run.integrator": "rk4",
        "run.step": f"{step} s",
        "run.duration": f"{duration!r} s",
        "output.rate": f"{rate!r} Hz",
        "output.formats": '["csv"]',
    }
    settings = [part for key, value in keys.items() for part in ("--set", f"{key}={value}")]
    ran(programs / "precess", "run", file, "--out", out, "--force", *settings, *more)
    with open(out / f"{file.stem}.csv", encoding="utf-8") as text:
        head, *rows = csv.reader(line for line in text if not line.startswith("#"))
    columns = {name.split(" ")[0].replace(".", "_"): index for index, name in enumerate(head)}
    return columns, rows
