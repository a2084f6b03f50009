"""The package as it is installed: its version, what importing it imports, Ctrl-C."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import numpy as np
import pytest

import precess

ROOT = Path(__file__).resolve().parents[2]
#: Seconds from a signal to the end of a process; two are enough where nothing else is built at the same time.
PROMPT = 20.0
#: What the package may import beyond NumPy: no package of anybody else, and of Python only what is small.
IMPORTED = {
    "__future__",
    "copy",
    "dataclasses",
    "precess",
    "precess._native",
    "precess._tables",
    "precess._wanted",
    "precess._backend",
    "precess._batch_arguments",
    "precess.batch",
    "precess.columns",
    "precess.control",
    "precess.errors",
    "precess.inputs",
    "precess.linearization",
    "precess.result",
    "precess.scenario",
    "precess.spacecraft",
    "precess.state",
}


def test_the_version_is_that_of_the_workspace() -> None:
    manifest = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))
    assert precess.__version__ == manifest["workspace"]["package"]["version"]
    of_wheel = tomllib.loads((ROOT / "python/Cargo.toml").read_text(encoding="utf-8"))
    assert precess.__version__ == of_wheel["workspace"]["package"]["version"]


def test_importing_imports_little_beyond_numpy() -> None:
    program = (
        "import json, sys, time, numpy; before = set(sys.modules); start = time.perf_counter(); "
        "import precess; end = time.perf_counter(); "
        "print(json.dumps([1e3 * (end - start), sorted(set(sys.modules) - before)]))"
    )
    printed = subprocess.run(
        [sys.executable, "-I", "-c", program], check=True, capture_output=True, text=True
    ).stdout
    milliseconds, modules = json.loads(printed)
    print(f"import: {milliseconds:.1f} ms beyond NumPy's; {', '.join(modules)}")
    assert set(modules) <= IMPORTED


RUN = """
import sys
import precess

def started(time):
    print("started", flush=True)

text, folder = sys.argv[1:]
scenario = precess.Scenario.from_text(text, set={"run.duration": 1e6, "output.rate": 10.0})
scenario.run(progress=started, formats=["csv", "npz"], out=folder)
"""
BATCH = """
import sys
import precess

def started(share):
    print("started", flush=True)

batch = precess.Batch(precess.Scenario.from_text(sys.argv[1]))
batch.run(batch.states(256), 1e-3, 10**9, reduce=["max"], progress=started)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent otherwise")
@pytest.mark.parametrize("program", [RUN, BATCH], ids=["run", "batch"])
def test_ctrl_c_ends_at_once_and_leaves_no_partial_file(
    program: str, wheels: str, tmp_path: Path
) -> None:
    process = subprocess.Popen(
        [sys.executable, "-c", program, wheels, str(tmp_path)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline() == "started\n"
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=PROMPT)
    finally:
        process.kill()
        process.wait()
    print(f"ended {time.monotonic() - sent:.2f} s after the signal")
    assert errors.rstrip().endswith("KeyboardInterrupt")
    assert process.returncode != 0
    # What has its name is complete.
    names = sorted(os.listdir(tmp_path))
    assert set(names) <= {"scenario.csv", "scenario.npz"}
    if "scenario.npz" in names:
        stored = np.load(tmp_path / "scenario.npz")
        assert stored["samples"].shape[1] == len(stored["columns"])
