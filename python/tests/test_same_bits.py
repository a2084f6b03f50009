"""The command line and Python give the same bits: same scenario, same integrator."""

from __future__ import annotations

import os
import subprocess
import warnings
from pathlib import Path

import numpy as np
import pytest

import precess

#: The program of the command line, built of the same sources.
COMMAND = os.environ.get("PRECESS_COMMAND")
#: Scenarios of every sort, and how long they are run where that is not as written.
SCENARIOS = {
    "every-kind": "0.2 s",
    "imaging-satellite": None,
    "known-tip-wheel": None,
    "beam-tip-wheel": "0.1 s",
    "wheels-on-isolator": "0.1 s",
    "panel-deployment": "3 s",
    "sticking-wheel": None,
    "orbit-gravity-gradient": "5 min",
    "table1-catalogue-250": "0.1 s",
}


@pytest.mark.skipif(COMMAND is None, reason="PRECESS_COMMAND is not the path of the program")
@pytest.mark.parametrize("name", [*SCENARIOS, "wheels"])
def test_runs_have_the_bits_of_the_command_line(
    name: str, wheels: str, scenarios: Path, tmp_path: Path
) -> None:
    assert COMMAND is not None
    path = scenarios / f"{name}.toml"
    if name == "wheels":
        # By RK4; the others are by DOP853.
        path = tmp_path / "wheels.toml"
        path.write_text(wheels)
    duration = SCENARIOS.get(name)
    values = {} if duration is None else {"run.duration": duration}
    overrides = [f"--set={key}={value}" for key, value in values.items()]
    arguments = ["run", str(path), "--no-report", "--out", str(tmp_path / "out")]
    ended = subprocess.run(
        [COMMAND, *arguments, "--set=output.formats=['npz']", *overrides],
        capture_output=True,
        text=True,
    )
    # 2: a requirement is not met.
    assert ended.returncode in (0, 2), ended.stderr
    stored = np.load(tmp_path / "out" / f"{name}.npz")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = precess.Scenario.from_toml(path, set=values).run()
    assert stored["columns"].tolist() == list(result.keys())
    assert len(result) > 10
    arrays = np.column_stack([result[key] for key in result])
    # Bit by bit: minus zero is another number than zero.
    same = stored["samples"].view(np.uint64) == arrays.view(np.uint64)
    different = [key for key, of in zip(result, same.T, strict=True) if not of.all()]
    assert not different
