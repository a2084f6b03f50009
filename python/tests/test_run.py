"""Runs: columns, files, cancellation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import precess


def test_files_have_the_bits_of_the_arrays(wheels: str, tmp_path: Path) -> None:
    result = precess.Scenario.from_text(wheels).run(formats=["npz", "csv"], out=tmp_path)
    stored = np.load(tmp_path / "scenario.npz")
    assert stored["columns"].tolist() == list(result.keys())
    np.testing.assert_array_equal(stored["samples"], np.column_stack([result[k] for k in result]))
    rows = np.loadtxt(tmp_path / "scenario.csv", delimiter=",", comments="#", skiprows=0, dtype=str)
    np.testing.assert_array_equal(rows[1:].astype(float), stored["samples"])
    result.save(tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == (tmp_path / "scenario.npz").read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "again.npz",
        "scenario.csv",
        "scenario.npz",
    ]


def test_names_vectors_and_units(wheels: str) -> None:
    result = precess.Scenario.from_text(wheels).run()
    assert result["omega"].shape == (len(result), 3)
    np.testing.assert_array_equal(result["omega.x"], result["omega_x"])
    assert result.units["wheel1.spin"] == "rad/s"
    with pytest.raises(KeyError, match="omega_x"):
        result["omga_x"]


def test_progress_cancels_and_its_exceptions_pass_through(wheels: str) -> None:
    scenario = precess.Scenario.from_text(wheels, set={"run.duration": 1e4, "output.rate": 1.0})
    result = scenario.run(progress=lambda time: False)
    assert result.end == "cancelled" and result.end_time < 1e4

    def fails(time: float) -> None:
        raise LookupError("stop")

    with pytest.raises(LookupError, match="stop"):
        scenario.run(progress=fails)
