"""Sweeps, Monte Carlo campaigns and fits: the numbers of single runs, of plans, and of a wheel that is known."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import precess
from precess import campaign, fit, montecarlo, sweep

REQUIREMENT = """
[[requirement]]
name = "slow"
quantity = "omega"
statistic = "peak"
limit = "0.04 rad/s"
"""
VARY = [
    {"key": "hub.mass", "distribution": "uniform", "from": "300 kg", "to": "400 kg"},
    {
        "key": "device.wheel1.wheel.rate",
        "distribution": "normal",
        "mean": "3000 rpm",
        "deviation": "100 rpm",
    },
]


@pytest.fixture
def scenario(wheels: str) -> precess.Scenario:
    return precess.Scenario.from_text(wheels + REQUIREMENT)


def test_a_sweep_has_the_numbers_of_single_runs(scenario: precess.Scenario) -> None:
    over = {"hub.mass": "300..400 kg:3", "device.wheel1.wheel.rate": "1000, 3000 rpm"}
    found = sweep.run(scenario, over, threads=2)
    assert found.shape == (3, 2) and found.labels == ("hub.mass [kg]", "device.wheel1.wheel.rate [rpm]")
    np.testing.assert_array_equal(found.axes[0], [300.0, 350.0, 400.0])
    values = {"hub.mass": "350 kg", "device.wheel1.wheel.rate": "1000 rpm"}
    result = scenario.with_values(values).run()
    assert found["end omega_x"][1, 0] == result["omega_x"][-1]
    peak = np.linalg.norm(result["omega"], axis=1).max()
    np.testing.assert_allclose(found["omega peak"][1, 0], peak, rtol=1e-14)
    assert found.units["omega rms"] == "rad/s" and found.limits == {"slow": 0.04}
    again = sweep.run(scenario, over, threads=1)
    np.testing.assert_array_equal(again["omega rms"], found["omega rms"])


def test_samples_that_fail_have_their_reason_and_are_kept_out(scenario: precess.Scenario) -> None:
    found = sweep.run(scenario, {"hub.mass": "-1, 300, 350 kg"})
    assert list(found.errors) == [(0,)] and "hub.mass" in found.errors[(0,)]
    assert np.isnan(found["omega rms"][0]) and not np.isnan(found["omega rms"][1:]).any()
    assert found.keep_out("slow") == [(-1.0, 300.0)]
    limit = float(found["omega rms"][1:].min()) / 2
    assert found.keep_out("omega rms", limit) == [(-1.0, 350.0)]
    with pytest.raises(KeyError, match="omega rms"):
        found["omega"]
    assert found.states("slow")[0] == "failed" and "failed" not in found.states("slow")[1:]


def test_a_requirement_without_data_is_neither_met_nor_violated(wheels: str) -> None:
    empty = """
[[requirement]]
name = "empty"
quantity = "omega"
statistic = "smear"
exposure = "1000 s"
limit = "1 rad/s"
"""
    scenario = precess.Scenario.from_text(wheels + REQUIREMENT + empty)
    slow, nothing = scenario.run().requirements
    assert slow.state in ("met", "violated") and slow.reason is None
    assert slow.met == (slow.state == "met")
    assert nothing.state == "not evaluated" and not nothing.met and nothing.value is None
    assert nothing.reason is not None and "needs 1000 s" in nothing.reason
    found = sweep.run(scenario, {"hub.mass": "300, 350 kg"})
    assert found.states("empty") == ["not evaluated"] * 2
    drawn = montecarlo.run(scenario, VARY, samples=3)
    unknown = drawn.probability("empty")
    assert np.isnan(unknown.value) and unknown.interval == (0.0, 1.0)


def test_samples_side_by_side_have_the_bits_of_each_by_itself(scenario: precess.Scenario) -> None:
    over = {"hub.mass": "300..400 kg:7", "device.wheel2.wheel.torque": "0, 0.01, 0.02 N m"}
    apart = {"run.step": "1, 0.7 ms", "output.rate": "1000, 333 Hz", "hub.mass": "300, 350 kg"}
    columns = ["omega", "wheel1.spin", "acceleration"]
    for keys in (over, apart):
        # As many threads as samples: one at a time.
        together, alone = (
            sweep.run(scenario, keys, columns=columns, threads=threads) for threads in (1, 64)
        )
        assert not together.errors
        for name in together.keys():
            np.testing.assert_array_equal(together[name], alone[name], err_msg=name)
    values = {"hub.mass": "350 kg", "device.wheel2.wheel.torque": "0.01 N m"}
    result = scenario.with_values(values).run()
    found = sweep.run(scenario, over, columns=columns, threads=1)
    for name in ("omega_x", "wheel1.spin"):
        assert found[f"end {name}"][3, 1] == result[name][-1], name


def test_draws_are_those_of_the_plan(scenario: precess.Scenario) -> None:
    found = montecarlo.run(scenario, VARY, 12, seed=5, columns=["omega", "wheel1.spin"])
    plan = campaign.monte_carlo(VARY, 12, 5)
    np.testing.assert_array_equal(found.values("hub.mass"), [row[0] for row in plan.values])
    mass, rate = plan.values[3]
    one = scenario.with_values(
        {"hub.mass": f"{mass!r} kg", "device.wheel1.wheel.rate": f"{rate!r} rpm"}
    )
    assert found["end omega_x"][3] == one.run()["omega_x"][-1]
    median = found.percentile("omega peak", 0.5)
    assert median.value == np.sort(found["omega peak"])[5]
    assert median.interval[0] <= median.value <= median.interval[1]
    met = (found["requirement slow"] <= 0.04).mean()
    assert found.probability("slow").value == met
    rank = found.rank_correlation("end wheel1.spin", "device.wheel1.wheel.rate")
    assert rank is not None and rank > 0.99
    assert not found.errors and len(found) == 12


def test_sensitivities_are_those_of_differences(wheels: str, tmp_path: Path) -> None:
    path = tmp_path / "wheels.toml"
    path.write_text(wheels)
    found = montecarlo.sensitivities(path, VARY)
    assert found.labels == ("hub.mass [kg]", "device.wheel1.wheel.rate [rpm]")
    np.testing.assert_allclose(found.deviations, [100.0 / np.sqrt(12.0), 100.0], rtol=1e-12)

    rates = {"device.wheel1.wheel.rate": "2999, 3001 rpm"}
    low, high = sweep.run(path, {"hub.mass": "350 kg"} | rates)["omega rms"][0]
    np.testing.assert_allclose(found.slopes["omega rms"][1], (high - low) / 2.0, rtol=1e-3)
    assert found.ranked("omega rms")[0][0] == "device.wheel1.wheel.rate [rpm]"
    assert found.difference < 1e-9


def known_wheel(u_s: float, u_d: float, lead: float) -> list[fit.Record]:
    """Records of a rigid wheel with imbalance, in noise."""
    rng = np.random.default_rng(11)
    rate, records = 2048.0, []
    for rpm in (900, 1200, 1500, 1900, 2300, 2700):
        speed = rpm * np.pi / 30
        angle = speed * np.arange(8192) / rate
        force, torque = u_s * speed**2, u_d * speed**2
        samples = np.zeros((8192, 6))
        samples[:, 1], samples[:, 2] = force * np.cos(angle), force * np.sin(angle)
        samples[:, 4] = torque * np.cos(angle + lead)
        samples[:, 5] = torque * np.sin(angle + lead)
        samples += rng.standard_normal(samples.shape) * [0.01, 0.01, 0.01, 0.001, 0.001, 0.001]
        records.append(fit.Record(samples, rate, speed, name=f"{rpm} rpm"))
    return records


def test_a_fit_finds_the_wheel_that_is_known() -> None:
    u_s, u_d, lead = 8e-6, 3e-7, 0.5
    found = fit.fit_records(known_wheel(u_s, u_d, lead), harmonics=[1.0], speed_accuracy=1e-6)
    imbalance = found.imbalance
    # Six standard deviations: the noise is drawn once.
    assert abs(imbalance.u_s.value - u_s) < 6 * imbalance.u_s.deviation < 0.2 * u_s
    assert abs(imbalance.u_d.value - u_d) < 6 * imbalance.u_d.deviation < 0.2 * u_d
    assert imbalance.phase is not None
    assert abs(imbalance.phase.value - lead) < 6 * imbalance.phase.deviation < 0.5
    device, sources = found.to_toml("rw", (4.0, 0.0288, 0.015))
    assert 'name = "rw"' in device and "imbalance" in device and "[[source]]" in sources
    assert "harmonics 1" in repr(found)


def test_records_that_determine_nothing_are_rejected() -> None:
    with pytest.raises(precess.SignalError):
        fit.fit_records(known_wheel(1e-6, 1e-8, 0.0)[:2])
    with pytest.raises(ValueError, match="they need"):
        fit.fit_records([fit.Record(np.zeros((512, 3)), 100.0, 10.0)] * 3)
