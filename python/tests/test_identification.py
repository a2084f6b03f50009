"""Identification from telemetry: arrays in, estimates with intervals out, what the data do not tell, and which manoeuvre would."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import precess

GYRO = {
    "output": "integrating",
    "angle_random_walk": "0.001 deg/sqrt(h)",
    "rate_random_walk": "0.01 deg/h/sqrt(h)",
    "bias": "0.5, -0.3, 0.4 deg/h",
}
SET = {
    "controller.aocs.rate": "100 Hz",
    "controller.aocs.delay": "10 ms",
    "controller.aocs.reference.start": "0 s",
    "controller.aocs.sensors": {"seed": 1, "gyro": GYRO},
    "requirement": [],
    "run.duration": "6 s",
    "output.rate": "100 Hz",
    "device.rw1.wheel.rate": "1080 rpm",
    "device.rw2.wheel.rate": "1170 rpm",
    "device.rw3.wheel.rate": "-1260 rpm",
    "device.rw4.wheel.rate": "1350 rpm",
}
TRUTH = {
    "hub.inertia": "41.3, 34.2, 30.6 kg m^2",
    "device.rw2.imbalance": {"static": "0.3 g cm", "dynamic": "4 g cm^2", "phase": "40 deg"},
}
PRIORS = {"static": "1 g cm", "dynamic": "20 g cm^2"}
UNKNOWN = {
    "unknown": {
        "hub_moments": "3 kg m^2",
        "gyro_bias": "2 deg/h",
        "device": [{"name": "rw", "imbalance": PRIORS}],
    },
    "noise": {"tachometer": "0.05 rad/s"},
}

#: One wheel: each unknown is a column more of the Jacobian of every step.
ONE_WHEEL = {
    **UNKNOWN,
    "unknown": {"hub_moments": "3 kg m^2", "device": [{"name": "rw2", "imbalance": PRIORS}]},
}

Data = dict[str, npt.NDArray[np.float64]]


@pytest.fixture(scope="module")
def bus() -> precess.Scenario:
    path = Path(__file__).resolve().parents[2] / "scenarios" / "four-wheel-slew.toml"
    return precess.Scenario.from_toml(path, set=SET)


@pytest.fixture(scope="module")
def data(bus: precess.Scenario) -> Data:
    return telemetry(bus.with_values(TRUTH))


def telemetry(scenario: precess.Scenario) -> Data:
    """What the sensors of a run read: tachometers with noise."""
    result = scenario.run()
    noise = np.random.default_rng(1)
    found = {"time": result.time}
    for axis in "xyz":
        found[f"aocs.gyro_{axis}"] = result[f"aocs.gyro_{axis}"]
    for wheel in range(1, 5):
        spin = result[f"rw{wheel}.spin"]
        found[f"rw{wheel}.spin"] = spin + 0.05 * noise.standard_normal(len(spin))
        found[f"rw{wheel}.u_w"] = result[f"rw{wheel}.u_w"]
    return found


def test_the_truth_of_a_run_is_within_the_intervals(bus: precess.Scenario, data: Data) -> None:
    found = precess.identify(bus, data=data, unknown=UNKNOWN)
    assert found.holds and found.is_told and found.span == (0.0, 6.0)
    truth = {
        "hub.i_b_bc_xx": (41.3, found.numbers["hub.i_b_bc_xx"].estimate),
        "hub.i_b_bc_yy": (34.2, found.numbers["hub.i_b_bc_yy"].estimate),
        "hub.i_b_bc_zz": (30.6, found.numbers["hub.i_b_bc_zz"].estimate),
        "U_s of rw2": (3e-6, found.wheels["rw2"].u_s),
        "U_d of rw2": (4e-7, found.wheels["rw2"].u_d),
        "phase of rw2": (np.radians(40.0), found.wheels["rw2"].phase),
    }
    for name, (value, estimate) in truth.items():
        # Once in 16,000 by chance.
        assert abs(value - estimate.value) < 4.0 * estimate.deviation, f"{name}: {estimate}"
        assert estimate.low < estimate.value < estimate.high
    assert not found.wheels["rw2"].hidden[0]
    count = len(found.numbers)
    assert found.covariance.shape == found.correlation.shape == (count, count)
    np.testing.assert_allclose(np.diagonal(found.correlation), 1.0)
    # The last row of a run has the reading of the row before: which of the two is held is unknown.
    assert found.residuals["gyro"].count == 3 * 598 and found.residuals["gyro"].holds
    assert any("2 left out" in of for of in found.exclusions)
    assert "[hub]" in found.to_toml() and "rw2" in found.to_toml()


def test_tables_files_and_frames_give_the_same(
    bus: precess.Scenario, data: Data, tmp_path: Path
) -> None:
    from precess._tables import toml_of

    found = precess.identify(bus, data=data, unknown=ONE_WHEEL, near=True)
    (tmp_path / "unknown.toml").write_text(toml_of({"format": 1, **ONE_WHEEL}), encoding="utf-8")
    np.savez(tmp_path / "telemetry.npz", **data)  # type: ignore[arg-type]
    of_files = precess.identify(
        bus, data=tmp_path / "telemetry.npz", unknown=tmp_path / "unknown.toml", near=True
    )
    assert of_files.numbers == found.numbers and of_files.wheels == found.wheels
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(data).set_index("time")
    of_frame = precess.identify(bus, data=frame, unknown=ONE_WHEEL, near=True)
    assert of_frame.numbers == found.numbers
    rows = found.to_pandas()
    assert list(rows.columns) == ["value", "deviation", "low", "high", "unit", "told"]
    assert rows.loc["rw2.u_s", "value"] == found.wheels["rw2"].u_s.value
    assert rows.loc["hub.i_b_bc_xx", "unit"] == "kg m²"


def test_a_slew_tells_what_a_record_at_rest_does_not(bus: precess.Scenario) -> None:
    rest = bus.with_values({"controller.aocs.reference.start": "60 s"})
    unknown = {**UNKNOWN, "unknown": {"hub_moments": "1 kg m^2"}}
    found = precess.identify(rest, data=telemetry(rest), unknown=unknown, near=True)
    assert found.untold and all(of.has_prior for of in found.untold)
    design = found.design({"rest": rest, "slew": bus})
    assert design.manoeuvres == ("rest", "slew")
    np.testing.assert_allclose(design.durations, 6.0, atol=0.05)
    assert design.names == ("hub.i_b_bc_xx", "hub.i_b_bc_yy", "hub.i_b_bc_zz")
    assert design.deviations.shape == (len(design.untold), 2)
    assert (design.deviations[:, 1] < design.deviations[:, 0]).all()
    assert (design.with_manoeuvre[:, 1] < 0.5 * design.with_manoeuvre[:, 0]).all()
    pytest.importorskip("pandas")
    assert list(design.to_pandas().columns) == ["unit", "record", "rest", "slew"]


def test_bad_data_are_named(bus: precess.Scenario, data: Data) -> None:
    turned = {**data, "aocs.gyro_z": -data["aocs.gyro_z"]}
    with pytest.raises(precess.SignalError, match=r"axes or unit are others .* the column -z"):
        precess.identify(bus, data=turned, unknown=ONE_WHEEL)
    with pytest.raises(precess.SignalError, match="time"):
        precess.identify(bus, data={"t": data["time"]}, unknown=UNKNOWN)
    with pytest.raises(precess.ScenarioError, match="no device is named"):
        tables: dict[str, Any] = {"unknown": {"device": [{"name": "wheel", "viscous": True}]}}
        precess.identify(bus, data=data, unknown=tables)
    with pytest.raises(ValueError, match=r"the column 'time' has the shape \(2, 3\)"):
        precess.identify(bus, data={"time": np.zeros((2, 3))}, unknown=UNKNOWN)
    other = precess.Scenario.from_text(
        "format = 1\n[hub]\nmass = '9 kg'\ninertia = '1, 1, 1 kg m^2'\n[run]\nduration = '1 s'\n[output]\nrate = '9 Hz'\n"
    )
    of_bias = {**UNKNOWN, "unknown": {"gyro_bias": "2 deg/h"}}
    # Of the bus that the scenario describes: with wrong imbalances the steps to the optimum are many.
    nominal = telemetry(bus)
    bias = precess.identify(bus, data=nominal, unknown=of_bias, near=True)
    with pytest.raises(precess.SignalError, match="numbers of the spacecraft"):
        bias.design({"again": bus})
    moments = {**UNKNOWN, "unknown": {"hub_moments": "3 kg m^2"}}
    found = precess.identify(bus, data=nominal, unknown=moments, near=True)
    with pytest.raises(precess.SignalError, match="devices are others"):
        found.design({"other": other})
