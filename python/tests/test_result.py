"""Results in another process: samples, facts and files of a run are those of the run."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import precess

REQUIREMENT = """
[[requirement]]
name = "slow"
quantity = "omega"
statistic = "peak"
limit = "0.04 rad/s"
"""
CHANGES = """
[[at]]
time = "0.02 s"
joint = "wheel1.wheel"
brake = true
"""
#: What a result says beside its samples.
FACTS = (
    "columns",
    "drift",
    "end",
    "end_time",
    "energy_lost",
    "events",
    "is_complete",
    "requirements",
    "scenario",
    "steps",
    "units",
)


def same(found: precess.Result, right: precess.Result, folder: Path) -> None:
    for name in FACTS:
        assert getattr(found, name) == getattr(right, name), name
    assert list(found) == list(right)
    for name in right:
        np.testing.assert_array_equal(found[name], right[name], strict=True)
        assert not found[name].flags.writeable
    for suffix in ("csv", "npz"):
        for name, result in (("found", found), ("right", right)):
            result.save(folder / f"{name}.{suffix}")
        assert (folder / f"found.{suffix}").read_bytes() == (folder / f"right.{suffix}").read_bytes()


def test_facts_are_all_public_properties() -> None:
    properties = {
        name for name, of in vars(precess.Result).items() if isinstance(of, property)
    }
    assert properties == {*FACTS, "time"}


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_result_is_pickled(wheels: str, tmp_path: Path, protocol: int) -> None:
    result = precess.Scenario.from_text(wheels + REQUIREMENT + CHANGES).run()
    assert result.events and result.requirements and result.energy_lost > 0.0
    same(pickle.loads(pickle.dumps(result, protocol)), result, tmp_path)
    # Pickled once, it is pickled again.
    again = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result, protocol)), protocol))
    same(again, result, tmp_path)


def test_a_result_is_copied(wheels: str, tmp_path: Path) -> None:
    result = precess.Scenario.from_text(wheels).run()
    for copied in (copy.copy(result), copy.deepcopy(result)):
        same(copied, result, tmp_path)


def test_a_cancelled_run_is_pickled(wheels: str, tmp_path: Path) -> None:
    scenario = precess.Scenario.from_text(wheels, set={"run.duration": 1e4, "output.rate": 1.0})
    result = scenario.run(progress=lambda time: False)
    assert result.end == "cancelled"
    same(pickle.loads(pickle.dumps(result)), result, tmp_path)


CROSSING = """
[[crossing]]
name = "fast"
column = "wheel2.spin"
value = "1000.1 rpm"
ends = true
"""


def test_every_end_is_pickled(wheels: str, tmp_path: Path) -> None:
    driven = {"device.wheel2.wheel.torque": 0.02}
    result = precess.Scenario.from_text(wheels + CROSSING, set=driven).run()
    assert "crossing `fast`" in result.end
    same(pickle.loads(pickle.dumps(result)), result, tmp_path)


FAILS = """
[[at]]
time = "0.02 s"
joint = "wheel1.wheel"
locked = true
"""


def test_a_run_that_fails_is_pickled_with_what_it_recorded(wheels: str, tmp_path: Path) -> None:
    with pytest.raises(precess.RunError, match="moves at") as raised:
        precess.Scenario.from_text(wheels + FAILS).run()
    found = pickle.loads(pickle.dumps(raised.value))
    assert (str(found), found.time) == (str(raised.value), raised.value.time)
    assert found.result.end.startswith("failed: at t = 0.02 s")
    same(found.result, raised.value.result, tmp_path)


def test_a_result_of_a_process_is_that_of_this_one(wheels: str, tmp_path: Path) -> None:
    program = (
        "import pickle, sys, precess; "
        "sys.stdout.buffer.write(pickle.dumps(precess.Scenario.from_text(sys.argv[1]).run()))"
    )
    ran = subprocess.run([sys.executable, "-c", program, wheels], check=True, capture_output=True)
    same(pickle.loads(ran.stdout), precess.Scenario.from_text(wheels).run(), tmp_path)
