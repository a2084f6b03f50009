"""Telemetry that is watched: arrays in, alarms and the series of every quantity out; files and frames give the same."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import precess

SET = {
    "controller.aocs.rate": "100 Hz",
    "controller.aocs.delay": "10 ms",
    "controller.aocs.reference.start": "0 s",
    "controller.aocs.sensors": {"seed": 1, "gyro": {"angle_random_walk": "0.001 deg/sqrt(h)"}},
    "requirement": [],
    "run.duration": "50 s",
    "output.rate": "100 Hz",
    "device.rw1.wheel.rate": "1080 rpm",
    "device.rw2.wheel.rate": "1170 rpm",
    "device.rw3.wheel.rate": "-1260 rpm",
    "device.rw4.wheel.rate": "1350 rpm",
}
LENGTHS = {"block": 1.0, "learn": 25.0}
#: When something changes, s.
ONSET = 35.0

Data = dict[str, npt.NDArray[np.float64]]


@pytest.fixture(scope="module")
def bus() -> precess.Scenario:
    path = Path(__file__).resolve().parents[2] / "scenarios" / "four-wheel-slew.toml"
    return precess.Scenario.from_toml(path, set=SET)


@pytest.fixture(scope="module")
def data(bus: precess.Scenario) -> Data:
    """What the sensors of a run read: tachometers with noise."""
    result = bus.run()
    noise = np.random.default_rng(1)
    found = {"time": result.time}
    for axis in "xyz":
        found[f"aocs.gyro_{axis}"] = result[f"aocs.gyro_{axis}"]
    for wheel in range(1, 5):
        spin = result[f"rw{wheel}.spin"]
        found[f"rw{wheel}.spin"] = spin + 0.01 * noise.standard_normal(len(spin))
        found[f"rw{wheel}.u_w"] = result[f"rw{wheel}.u_w"]
    return found


def test_without_a_change_there_is_no_alarm_and_every_quantity_has_its_series(
    bus: precess.Scenario, data: Data
) -> None:
    found = precess.watch(bus, data=data, **LENGTHS)
    assert found.alarms == () and found.remarks == ()
    assert len(found.start) == len(found.end) == 50
    np.testing.assert_allclose(found.end - found.start, 1.0, atol=0.02)
    for wheel, u_s in (("rw1", 1.5e-6), ("rw4", 1.5e-6)):
        series = found.series[f"static imbalance of {wheel}"]
        assert series.unit == "kg m" and series.values.shape == (50,)
        ratios = (series.values - u_s) / series.deviations
        # A mean of 50 amplitudes: their own noise raises it, and the rigid model is exact.
        assert abs(np.mean(ratios)) < 1.0, wheel
    drag = found.series["drag torque of rw2"]
    assert drag.reference is not None and abs(drag.reference) < 1e-4
    # The scale of a wheel's variances is that of the likelihood; of everything else it is at least one.
    assert drag.scatter is not None and 0.5 < drag.scatter < 2.0
    assert all(of.scatter is None or of.scatter >= 1.0 for name, of in found.series.items() if "drag" not in name)
    # In the series of drag, by the time the block tells it.
    assert found.series["torque constant of rw1"].reference is None
    assert "50 blocks" in repr(found) and "0 alarms" in repr(found)


def test_a_weaker_motor_and_a_gyro_step_are_found(bus: precess.Scenario, data: Data) -> None:
    later = data["time"] >= ONSET
    changed = {
        **data,
        "rw1.u_w": np.where(later, 1.0 / 0.8, 1.0) * data["rw1.u_w"],
        "aocs.gyro_y": np.where(later, 1e-4, 0.0) + data["aocs.gyro_y"],
    }
    found = precess.watch(bus, data=changed, **LENGTHS)
    assert all(of.time >= ONSET for of in found.alarms)
    alarms = {of.name: of for of in found.alarms}
    gyro = alarms["gyro bias about y"]
    assert gyro.unit == "rad/s" and gyro.low < 1e-4 < gyro.high
    motor = [of for of in found.alarms if "rw1" in of.name and ("drag" in of.name or "torque" in of.name)]
    assert motor and all(of.low < of.change < of.high and of.alike for of in motor)
    assert abs(motor[0].onset - ONSET) <= 2.0


def test_files_and_frames_give_the_same(
    bus: precess.Scenario, data: Data, tmp_path: Path
) -> None:
    found = precess.watch(bus, data=data, **LENGTHS)
    np.savez(tmp_path / "telemetry.npz", **data)  # type: ignore[arg-type]
    of_file = precess.watch(bus, data=tmp_path / "telemetry.npz", controller="aocs", **LENGTHS)
    pd = pytest.importorskip("pandas")
    frame = pd.DataFrame(data).set_index("time")
    of_frame = precess.watch(bus, data=frame, **LENGTHS)
    for other in (of_file, of_frame):
        for name, series in found.series.items():
            np.testing.assert_array_equal(series.values, other.series[name].values)
    rows = found.to_pandas()
    assert rows.index.name == "start" and len(rows) == 50
    assert list(rows.columns[:3]) == ["end", "static imbalance of rw1", "static imbalance of rw1, deviation"]
    assert list(found.alarms_to_pandas().columns[:3]) == ["name", "unit", "time"]


def test_what_cannot_be_watched_is_an_error(bus: precess.Scenario, data: Data) -> None:
    with pytest.raises(precess.SignalError, match="time"):
        precess.watch(bus, data={"t": data["time"]})
    with pytest.raises(precess.SignalError, match="no controller `servo`"):
        precess.watch(bus, data=data, controller="servo")
    with pytest.raises(precess.SignalError, match="the length of a block is -1 s; it must be finite and positive"):
        precess.watch(bus, data=data, block=-1.0)
    with pytest.raises(precess.SignalError, match="learn for longer, or make blocks shorter"):
        precess.watch(bus, data=data, block=2.0, learn=2.0)
    with pytest.raises(precess.SignalError, match="false alarm"):
        precess.watch(bus, data=data, false_alarms=0.0)
    with pytest.raises(ValueError, match=r"the column 'time' has the shape \(2, 3\)"):
        precess.watch(bus, data={"time": np.zeros((2, 3))})
    wrong: Any = 3
    with pytest.raises(TypeError, match="scenario is 3; it needs a precess.Scenario, or a path"):
        precess.watch(wrong, data=data)
