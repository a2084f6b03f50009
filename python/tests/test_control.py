"""Controllers that are functions of Python: the bits of a law that is built in, errors, several at a time."""

from __future__ import annotations

import threading
from collections.abc import Sequence

import numpy as np
import pytest

import precess

BUS = """
format = 1
[hub]
mass = "100 kg"
inertia = "12, 11, 10 kg m^2"
[initial]
angular_velocity = "0.1, -0.2, 0.05 rad/s"
[[device]]
name = "rwx"
kind = "balanced_reaction_wheel"
mount = { spin_axis = [1, 0, 0] }
wheel = { mass = "2 kg", inertia = "0.02, 0.01, 0.01 kg m^2" }
[[device]]
name = "rwy"
copy_of = "rwx"
mount = { spin_axis = [0, 1, 0] }
[[device]]
name = "rwz"
copy_of = "rwx"
mount = { spin_axis = [0, 0, 1] }
[[controller]]
name = "aocs"
rate = "4 Hz"
delay = "0.1 s"
law = { kind = "rate_damping", rate_gain = "1 N m s" }
[run]
duration = "5 s"
integrator = "rk4"
step = "50 ms"
[output]
rate = "4 Hz"
"""


def damping(sample: precess.ControllerSample) -> list[float]:
    x, y, z = sample.omega
    return [-x, -y, -z]


def bits(result: precess.Result) -> list[bytes]:
    return [result[name].tobytes() for name in result]


def test_a_function_has_the_bits_of_the_law() -> None:
    scenario = precess.Scenario.from_text(BUS)
    law = bits(scenario.run())
    assert bits(scenario.run(controllers={"aocs": damping})) == law

    def table(sample: precess.ControllerSample) -> dict[str, Sequence[float]]:
        return {"torque": -np.array(sample.omega)}

    assert bits(scenario.run(controllers={"aocs": table})) == law
    # Several at a time, each with its own function.
    found: dict[int, list[bytes]] = {}

    def one(index: int) -> None:
        found[index] = bits(scenario.run(controllers={"aocs": lambda sample: damping(sample)}))

    threads = [threading.Thread(target=one, args=(index,)) for index in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert list(found.values()) == [law] * 4


def test_a_sample_has_what_the_columns_have() -> None:
    scenario = precess.Scenario.from_text(BUS)
    samples: list[precess.ControllerSample] = []

    def kept(sample: precess.ControllerSample) -> dict[str, list[float]]:
        samples.append(sample)
        return {"motors": [0.01] * len(sample.joints)}

    result = scenario.run(controllers={"aocs": kept})
    assert [sample.time for sample in samples] == [0.25 * k for k in range(20)]
    assert samples[0].elapsed == 0.0 and samples[1].elapsed == 0.25
    for k, sample in enumerate(samples):
        assert sample.omega == tuple(result["omega"][k])
        assert sample.attitude == tuple(result[f"q{i}"][k] for i in range(4))
        assert sample.joints[1][1] == result["rwy.spin"][k]
        assert sample.reference.attitude == tuple(
            result[f"aocs.reference_q{i}"][k] for i in range(4)
        )
    assert not samples[0].limited and samples[0].external == (0.0, 0.0, 0.0)
    # Held from 0.1 s on: the wheel accelerates against a hub of which it is 1/500.
    assert result["rwz.spin"][-1] == pytest.approx(0.01 * 4.9 / 0.02, abs=0.2)


def test_what_is_wrong_is_said() -> None:
    scenario = precess.Scenario.from_text(BUS)
    with pytest.raises(KeyError, match="no controller is named 'rcs'; there are: aocs"):
        scenario.run(controllers={"rcs": damping})
    for answer, message in (
        ([1.0, 2.0], "three numbers"),
        (None, "three numbers"),
        ({"torques": [0, 0, 0]}, "three numbers"),
        ({"torque": [0, 0, 0], "motors": [0, 0, 0]}, "three numbers"),
    ):
        with pytest.raises(TypeError, match=message):
            scenario.run(controllers={"aocs": lambda sample, answer=answer: answer})
    for numbers, message in (
        ([0.0, float("nan"), 0.0], "number 2 of its answer is NaN"),
        ({"motors": [0.0]}, "1 torques of motors for 3 joints"),
    ):
        with pytest.raises(precess.RunError, match=message):
            scenario.run(controllers={"aocs": lambda sample, numbers=numbers: numbers})

    def late(sample: precess.ControllerSample) -> list[float]:
        if sample.time > 1.0:
            raise LookupError("lost")
        return [0.0, 0.0, 0.0]

    with pytest.raises(LookupError, match="lost"):
        scenario.run(controllers={"aocs": late})
