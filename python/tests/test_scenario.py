"""Scenarios: reading, messages, equality, pickling."""

from __future__ import annotations

import pickle
import warnings
from pathlib import Path

import pytest

import precess


def test_overrides_and_tables_give_the_same_scenario(wheels: str) -> None:
    text = precess.Scenario.from_text(wheels, set={"hub.mass": 400.0})
    unit = precess.Scenario.from_text(wheels, set={"hub.mass": "400 kg"})
    assert text == unit and hash(text) == hash(unit)
    assert text != precess.Scenario.from_text(wheels)
    assert text == precess.Scenario.from_text(wheels).with_values({"hub.mass": "0.4 t"})


def test_plain_numbers_are_rejected_in_a_text_and_si_in_tables() -> None:
    tables = {"hub": {"mass": 350.0, "inertia": [80.0, 70.0, 60.0]}, "run": {"duration": 0.1}}
    scenario = precess.Scenario(**tables)
    assert 'mass = "350.0 kg"' in scenario.to_toml()
    with pytest.raises(precess.ScenarioError, match="has no unit"):
        precess.Scenario.from_text("format = 1\n[hub]\nmass = 350.0\n")


def test_errors_have_places_and_remedies(wheels: str) -> None:
    with pytest.raises(precess.ScenarioError) as caught:
        precess.Scenario.from_text(wheels, set={"hub.mas": 1.0})
    assert "did you mean `mass`?" in str(caught.value)
    assert caught.value.diagnostics[0].message == "unknown key `hub.mas`"
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.diagnostics == caught.value.diagnostics


@pytest.mark.parametrize("name", ["table1-catalogue-250", "wheels-on-isolator", "beam-tip-wheel"])
def test_pickles_read_back_without_files(scenarios: Path, name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scenario = precess.Scenario.from_toml(scenarios / f"{name}.toml")
    again = pickle.loads(pickle.dumps(scenario))
    assert again == scenario and name in repr(again)
    assert pickle.loads(pickle.dumps(scenario.spacecraft)) == scenario.spacecraft
