"""Sweeps: runs of a scenario over the values of one key or several, as ``precess sweep`` makes them, in memory.

For sweeps that are kept on the disk and continued, see :mod:`precess.campaign`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from . import _native
from ._rows import OfRows, Rows, StrPath, evaluate
from ._wanted import number
from .campaign.plan import grid
from .scenario import Scenario

__all__ = ["Sweep", "run"]

Array = npt.NDArray[np.float64]


class Sweep(OfRows):
    """The numbers of a sweep by name, one array each over the axes: ``sweep["omega rms"]``, shape :attr:`shape`.

    Numbers of a sample that failed are NaN.
    """

    def __init__(self, rows: Rows, axes: Sequence[Array]) -> None:
        super().__init__(rows)
        self.axes = tuple(axes)
        """The values of each key in its unit, in order."""
        self.shape = tuple(len(axis) for axis in axes)
        """How many values each key has."""

    @property
    def errors(self) -> dict[tuple[int, ...], str]:
        """Why each sample that failed has no numbers, by its place along the axes."""
        places = {index: np.unravel_index(index, self.shape) for index in self._rows.errors}
        return {
            tuple(int(of) for of in places[index]): why for index, why in self._rows.errors.items()
        }

    def __getitem__(self, name: str) -> Array:
        return self._rows.column(name).reshape(self.shape)

    def keep_out(self, name: str, limit: float | None = None) -> list[tuple[float, float]]:
        """Intervals of the only key in which a number exceeds a limit, or in which a sample failed.

        Parameters
        ----------
        name : str
            A number, or a requirement, whose limit is that of the scenario.
        limit : float, optional
            Another limit, SI.
        """
        if len(self.axes) != 1:
            raise ValueError(f"a sweep over {len(self.axes)} keys has no intervals of one")
        if name in self.limits:
            limit = self.limits[name] if limit is None else limit
            name = f"requirement {name}"
        if limit is None:
            raise ValueError(f"`{name}` has no limit of its own; state one")
        limit = number("limit", limit)
        numbers = [None if np.isnan(of) else float(of) for of in self[name]]
        return _native.keep_out(self.axes[0].tolist(), numbers, limit)

    def __repr__(self) -> str:
        return f"<precess.sweep.Sweep over {', '.join(self.labels)}: {len(self._rows.plan)} samples>"


def run(
    scenario: Scenario | StrPath,
    over: Mapping[str, str],
    *,
    columns: Sequence[str] = ("omega",),
    lines: int = 0,
    start: float = 0.0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Sweep:
    """Runs every combination of the values of some keys.

    Parameters
    ----------
    scenario : Scenario or path
        What is run.
    over : mapping
        ``{"hub.mass": "100..900 kg:9"}``: nine values with equal differences; ``"1..100 kg:log 5"``: five with equal ratios;
        ``"1, 2, 5 kg"``: these.
    columns, lines, start
        Columns or vectors of which RMS, peak and the strongest lines are computed, from the time ``start``, s, on. A row also
        has the statistic of each requirement, and each column at the end.
    threads : int, optional
        All cores by default; numbers do not depend on it.
    progress : callable, optional
        Called with the number of samples that are finished and that of all.

    Raises
    ------
    ScenarioError, RecordError
        Where the scenario cannot be read, or has no such column.
    """
    plan = grid(over)
    values = np.array(plan.values, dtype=np.float64)
    # In the order of the axis: the first of each value.
    axes = [np.array(list(dict.fromkeys(column.tolist()))) for column in values.T]
    if int(np.prod([len(axis) for axis in axes])) != len(plan):
        raise ValueError("a key has one value twice")
    return Sweep(evaluate(scenario, plan, columns, lines, start, threads, progress), axes)
