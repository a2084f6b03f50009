"""Parameters of batches: names that nothing has, and values that are wrong."""

from __future__ import annotations

import functools
from typing import Any

import numpy as np
import pytest

import precess


@pytest.fixture
def craft(wheels: str) -> precess.Spacecraft:
    return precess.Scenario.from_text(wheels).spacecraft


def test_a_key_that_nothing_has_is_an_error_of_the_constructor(craft: precess.Spacecraft) -> None:
    make = functools.partial(precess.Batch, craft)
    for key, near in (
        ("hub.mb", "hub.m_b"),
        ("hub.mas", "hub.mass|`mass`"),
        ("wheel1.dd", "wheel1.d"),
        ("device.wheel1.wheel.mas", "mass"),
        ("nothing", "is neither"),
        ("", "is neither"),
        ("hub.mass.x", "is neither"),
    ):
        for values in ([1.0, 2.0], np.ones(2), ["?", "?"], []):
            with pytest.raises(KeyError, match=near) as raised:
                make({key: values})
            assert f"`{key}`" in str(raised.value)
    with pytest.raises(TypeError, match="one value for each element"):
        make({"hub.m_b": 3.0})
    with pytest.raises(TypeError, match="one value for each element"):
        make({"hub.m_b": "12"})
    with pytest.raises(ValueError, match="different lengths"):
        make({"hub.m_b": [1.0], "wheel1.d": [0.0, 0.0]})


def test_a_bad_value_is_the_error_of_its_element(craft: precess.Spacecraft) -> None:
    right = craft.accelerations(craft.initial_state()).to_array()
    values: list[Any]
    for key, values, kind in (
        ("hub.m_b", [350.0, -1.0, 350.0], precess.ParameterError),
        ("hub.m_b", [350.0, "?", 350.0], precess.ParameterError),
        ("hub.m_b", [350.0, None, 350.0], precess.ParameterError),
        ("hub.m_b", [350.0, float("nan"), 350.0], precess.ParameterError),
        ("hub.mass", [350.0, -1.0, "350 kg"], precess.ScenarioError),
        ("hub.mass", [350.0, "?", 350.0], precess.ScenarioError),
        ("hub.mass", ["350 kg", "350 m", 350.0], precess.ScenarioError),
        ("hub.mass", [350.0, object(), 350.0], TypeError),
    ):
        batch = precess.Batch(craft, {key: values})
        found = batch.accelerations(batch.states())
        assert list(batch.errors) == [1], f"{key}: {values}"
        assert isinstance(batch.errors[1], kind), batch.errors
        assert np.isnan(found[1]).all()
        np.testing.assert_array_equal(found[[0, 2]], [right, right])
