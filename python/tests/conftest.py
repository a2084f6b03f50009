"""Fixtures: scenarios of the repository, and the package as it is installed."""

from __future__ import annotations

from pathlib import Path

import pytest

SCENARIOS = Path(__file__).resolve().parents[2] / "scenarios"

WHEELS = """
format = 1
[hub]
mass = "350 kg"
inertia = "80, 70, 60 kg m^2"
[initial]
angular_velocity = "0.01, -0.02, 0.03 rad/s"
[[device]]
name = "wheel1"
kind = "reaction_wheel"
position = "0.3, 0.1, 0 m"
mount = { spin_axis = [0, 0, 1] }
imbalance = { static = "1 g cm", dynamic = "20 g cm^2" }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "3000 rpm"
torque = "0.02 N m"
[[device]]
name = "wheel2"
kind = "reaction_wheel"
mount = { spin_axis = [1, 0, 0] }
[device.wheel]
mass = "4 kg"
inertia = "288, 150, 150 kg cm^2"
rate = "1000 rpm"
[run]
duration = "0.05 s"
integrator = "rk4"
step = "1 ms"
[output]
rate = "1 kHz"
"""


@pytest.fixture
def scenarios() -> Path:
    """The folder of scenarios."""
    return SCENARIOS


@pytest.fixture
def wheels() -> str:
    """The text of a scenario with two wheels, RK4."""
    return WHEELS
