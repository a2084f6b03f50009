"""A scenario and telemetry as arguments: of a path, of columns, of a frame."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from ._wanted import table, text
from .scenario import Scenario

__all__ = ["columns_of", "file_of", "scenario_of"]

Array = npt.NDArray[np.float64]


def scenario_of(scenario: Any) -> Scenario:
    """The scenario, or that of a path."""
    if isinstance(scenario, Scenario):
        return scenario
    if not isinstance(scenario, str | os.PathLike):
        raise TypeError(f"scenario is {scenario!r}; it needs a precess.Scenario, or a path")
    return Scenario.from_toml(scenario)


def file_of(data: Any) -> str | None:
    """The path of a file of telemetry; None of columns."""
    return os.fspath(data) if isinstance(data, str | os.PathLike) else None


def columns_of(data: Any) -> list[tuple[str, Array]]:
    """The columns of a mapping or of a frame."""
    columns: dict[str, Any] = {}
    if hasattr(data, "columns") and hasattr(data, "index"):
        columns = {name: data[name].to_numpy() for name in data.columns}
        name = data.index.name
        if name is not None and name not in columns:
            columns[name] = data.index.to_numpy()
    else:
        columns = dict(table("data", data))
    found = []
    for name, of in columns.items():
        array = np.asarray(of, dtype=np.float64)
        if array.ndim != 1:
            raise ValueError(f"the column {name!r} has the shape {array.shape}; it needs (readings,)")
        found.append((text("the name of a column", name), array))
    return found
