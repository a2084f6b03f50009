"""Campaigns on one machine: plans, rows, files, and how a campaign that was ended goes on."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import precess
from precess import campaign

MASSES = {"hub.mass": "80..110 kg:13"}


def bytes_of(found: campaign.Campaign) -> dict[str, bytes]:
    """Every file of a campaign."""
    files = [found.samples, found.report, found.folder / "campaign.json", *found.partitions]
    return {path.name: path.read_bytes() for path in files}


def test_a_row_is_that_of_a_run(scenario: Path, tmp_path: Path) -> None:
    found = campaign.run(scenario, campaign.grid(MASSES), tmp_path / "out", partition=5)
    frame = found.to_pandas()
    assert list(frame.index) == list(range(13))
    assert (frame["state"] == "ok").all()
    sample = precess.Scenario.from_toml(scenario, set={"hub.mass": "80 kg"}).run()
    peak = np.sqrt((sample["omega"] ** 2).sum(axis=1)).max()
    assert frame["omega peak"][0] == pytest.approx(peak, rel=1e-15)
    assert frame["requirement quiet"][0] == pytest.approx(peak, rel=1e-15)
    assert frame["end omega_x"][0] == sample["omega_x"][-1]
    assert frame["hub.mass [kg]"][12] == 110.0


def test_bytes_do_not_depend_on_threads_or_folder(scenario: Path, tmp_path: Path) -> None:
    plan = campaign.grid(MASSES)
    one = campaign.run(scenario, plan, tmp_path / "one", partition=5, threads=1)
    moved = tmp_path / "moved"
    scenario.parent.rename(moved)
    three = campaign.run(moved / scenario.name, plan, tmp_path / "three", partition=5, threads=3)
    assert bytes_of(one) == bytes_of(three)


def test_a_rerun_does_nothing(scenario: Path, tmp_path: Path) -> None:
    plan = campaign.grid(MASSES)
    first = campaign.run(scenario, plan, tmp_path / "out", partition=5)
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "out").rglob("*")}
    again = campaign.run(scenario, plan, tmp_path / "out", partition=5)
    assert first.evaluated == 13 and again.evaluated == 0
    assert before == {path: path.stat().st_mtime_ns for path in (tmp_path / "out").rglob("*")}


def test_more_samples_keep_the_earlier_partitions(scenario: Path, tmp_path: Path) -> None:
    vary = [{"key": "hub.mass", "distribution": "uniform", "from": "80 kg", "to": "110 kg"}]
    campaign.run(scenario, campaign.monte_carlo(vary, 10), tmp_path / "out", partition=5)
    plan = campaign.monte_carlo(vary, 20)
    more = campaign.run(scenario, plan, tmp_path / "out", partition=5)
    assert more.evaluated == 10
    alone = campaign.run(scenario, plan, tmp_path / "alone", partition=5)
    assert bytes_of(more) == bytes_of(alone)


def test_names_follow_what_a_file_says(scenario: Path, tmp_path: Path) -> None:
    plan = campaign.grid(MASSES)
    first = campaign.run(scenario, plan, tmp_path / "out")
    hub = scenario.with_name("hub.toml")
    hub.write_text(hub.read_text().replace("20, 18, 15", "20, 18, 16"))
    second = campaign.run(scenario, plan, tmp_path / "out")
    assert second.evaluated == 13
    assert not set(first.partitions) & set(second.partitions)


def test_plans(tmp_path: Path) -> None:
    vary = [
        {"key": "hub.mass", "distribution": "normal", "mean": "100 kg", "deviation": "5 kg"},
        {"key": "device.wheel.wheel.rate", "distribution": "uniform", "from": "1 rpm", "to": "2 rpm"},
    ]
    latin = campaign.latin_hypercube(vary, 8, seed=3)
    rates = sorted(row[1] for row in latin.values)
    assert [int((rate - 1.0) * 8) for rate in rates] == list(range(8))
    assert campaign.monte_carlo(vary, 4).values == campaign.monte_carlo(vary, 8).values[:4]
    listed = campaign.listed({"hub.mass": ["90 kg", 95.0]})
    assert listed.overrides == (('hub.mass = "90 kg"',), ("hub.mass = 95.0",))
    assert len(campaign.grid({"hub.mass": "1, 2 kg", "hub.a": "1..100:log 3"})) == 6
    with pytest.raises(ValueError, match="lists of"):
        campaign.listed({"a": [1.0], "b": []})


def test_a_sobol_sequence_fills_evenly() -> None:
    pytest.importorskip("scipy")
    vary = [
        {"key": key, "distribution": "uniform", "from": 0.0, "to": 1.0} for key in ("a", "b")
    ]
    plan = campaign.sobol(vary, 64, seed=1)
    assert plan.values[:32] == campaign.sobol(vary, 32, seed=1).values
    points = np.array(plan.values)
    cells = {(int(x), int(y)) for x, y in points * 8}
    # A (0, 2)-sequence in base 2: one of 64 points in each of 8 by 8 cells.
    assert len(cells) == 64


def test_a_sample_that_cannot_be_read_is_a_row(scenario: Path, tmp_path: Path) -> None:
    plan = campaign.listed({"hub.mass": ["90 kg", "90 s", "95 kg", "-1 kg"]})
    found = campaign.run(scenario, plan, tmp_path / "out", partition=3)
    assert sorted(found.failed) == [1, 3]
    frame = found.to_pandas()
    assert np.isnan(frame["omega rms"][1]) and frame["omega rms"][2] > 0.0
    assert "Samples that failed: 2" in found.report.read_text()
    # A probability counts what failed as not met.
    assert "| 2 of 4 |" in found.report.read_text() or "| 0 of 4 |" in found.report.read_text()


def test_a_measure_is_part_of_the_name(scenario: Path, tmp_path: Path) -> None:
    plan = campaign.grid(MASSES)
    fields = {"mass": "kg"}
    first = campaign.run(scenario, plan, tmp_path / "out", measure=_one, fields=fields)
    second = campaign.run(scenario, plan, tmp_path / "out", measure=_two, fields=fields)
    assert second.evaluated == 13
    assert first.partitions != second.partitions
    assert set(second.to_pandas()["mass"]) == {2.0}


def _one(scenario: precess.Scenario) -> dict[str, float]:
    return {"mass": 1.0}


def _two(scenario: precess.Scenario) -> dict[str, float]:
    return {"mass": 2.0}


#: Runs a campaign in a process of its own; the second argument names what goes wrong.
PROGRAM = """
import os, resource, signal, sys
from precess import campaign

def measure(scenario):
    if scenario.title == "Poison" and os.environ.get("POISON") == "kill":
        os.kill(os.getpid(), signal.SIGKILL)
    if scenario.title == "Poison":
        raise RuntimeError("poison")
    return {"end": float(scenario.run()["omega_x"][-1])}

titles = ["A", "B", "C", "Poison", "D", "E", "F", "G"]
plan = campaign.listed({"title": titles})
scenario, out = sys.argv[1:3]
found = campaign.run(scenario, plan, out, partition=3, threads=2, measure=measure, fields={"end": "rad/s"})
print(found.failed)
"""


def _program(scenario: Path, out: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    path = out.parent / "program.py"
    path.write_text(PROGRAM)
    command = [sys.executable, str(path), str(scenario), str(out)]
    env = os.environ | environment
    return subprocess.run(command, capture_output=True, text=True, env=env, check=False)


def test_a_sample_that_kills_the_process_is_a_row_after_the_next_call(
    scenario: Path, tmp_path: Path
) -> None:
    first = _program(scenario, tmp_path / "out", POISON="kill")
    assert first.returncode == -signal.SIGKILL
    second = _program(scenario, tmp_path / "out", POISON="kill")
    assert second.returncode == 0, second.stderr
    assert "{3: 'the process that ran it was ended by signal 9 (SIGKILL)'}" in second.stdout
    states = json.loads((tmp_path / "out" / "campaign.json").read_text())
    assert states["samples"] == 8 and len(states["partitions"]) == 3
    assert not list((tmp_path / "out" / "partitions").glob("*.running"))


def test_a_limit_of_file_sizes_loses_nothing(scenario: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    limit = (
        "import resource; resource.setrlimit(resource.RLIMIT_FSIZE, (600, resource.RLIM_INFINITY))"
    )
    program = tmp_path / "limited.py"
    program.write_text(f"{limit}\n{PROGRAM}")
    command = [sys.executable, "-B", str(program), str(scenario), str(out)]
    limited = subprocess.run(command, capture_output=True, text=True, check=False)
    assert limited.returncode != 0 and "File too large" in limited.stderr
    assert not list(out.rglob("*.partial")) and not (out / "samples.parquet").exists()
    assert _program(scenario, out).returncode == 0
    assert _program(scenario, tmp_path / "whole").returncode == 0
    for name in ("samples.parquet", "report.md", "campaign.json"):
        assert (out / name).read_bytes() == (tmp_path / "whole" / name).read_bytes()
    assert resource.getrlimit(resource.RLIMIT_FSIZE)[0] == resource.RLIM_INFINITY


def test_what_a_killed_process_was_writing_is_removed(scenario: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    (out / "partitions").mkdir(parents=True)
    program = (
        "import os, pathlib, signal, sys\n"
        "from precess.campaign import store\n"
        "with store.atomic(pathlib.Path(sys.argv[1])) as partial:\n"
        "    partial.write_text('half')\n"
        "    os.kill(os.getpid(), signal.SIGKILL)\n"
    )
    command = [sys.executable, "-c", program, str(out / "partitions" / "part.parquet")]
    assert subprocess.run(command, check=False).returncode == -signal.SIGKILL
    (left,) = (out / "partitions").glob(".*.partial")
    # That of a process that is there is its own.
    living = left.with_name(left.name.replace(left.name.split(".")[-2], str(os.getpid())))
    living.write_text("half")
    campaign.run(scenario, campaign.grid(MASSES), out)
    assert list((out / "partitions").glob(".*.partial")) == [living]
