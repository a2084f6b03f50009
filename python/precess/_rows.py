"""Rows of numbers of the samples of a plan, in memory: what sweeps and Monte Carlo campaigns are made of."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _native
from ._wanted import function, names, number, whole
from .campaign.bundle import Bundle
from .campaign.job import Job, in_groups
from .campaign.plan import Plan
from .scenario import Scenario

__all__ = ["OfRows", "Rows", "evaluate"]

Array = npt.NDArray[np.float64]
StrPath = str | os.PathLike[str]


@dataclass(frozen=True, eq=False)
class Rows:
    """The numbers of the samples of a plan.

    Attributes
    ----------
    plan : Plan
        The samples.
    units : dict
        The unit of each number by its name: ``requirement NAME``, ``omega rms``, ``omega peak``, ``omega line 1 frequency``,
        ``end omega_x``.
    numbers : array, shape (samples, numbers)
        NaN of a sample that failed.
    limits : dict
        The limit of each requirement, SI.
    errors : dict
        Why each sample that failed has no numbers.
    """

    plan: Plan
    units: dict[str, str]
    numbers: Array
    limits: dict[str, float]
    errors: dict[int, str]

    def column(self, name: str) -> Array:
        """A number of each sample."""
        known = list(self.units)
        if name not in known:
            raise KeyError(f"no number is named `{name}`; there are {', '.join(known)}")
        return self.numbers[:, known.index(name)]


class OfRows:
    """What a study has of its rows: labels, units, limits, and the names of its numbers."""

    def __init__(self, rows: Rows) -> None:
        self._rows = rows

    @property
    def labels(self) -> tuple[str, ...]:
        """The keys with the units of their values: ``hub.mass [kg]``."""
        return self._rows.plan.labels

    @property
    def units(self) -> dict[str, str]:
        """The unit of each number by its name."""
        return self._rows.units

    @property
    def limits(self) -> dict[str, float]:
        """The limit of each requirement, SI."""
        return self._rows.limits

    def keys(self) -> tuple[str, ...]:
        """The names of the numbers."""
        return tuple(self._rows.units)

    def states(self, requirement: str) -> list[str]:
        """What became of a requirement in each sample, in their order: ``"met"``, ``"violated"``, ``"not evaluated"`` where the
        run has no data for it, or ``"failed"`` where there was no run."""
        if requirement not in self.limits:
            raise KeyError(f"no requirement `{requirement}`; there are {', '.join(self.limits)}")
        limit = self.limits[requirement]

        def state(sample: int, number: float) -> str:
            if sample in self._rows.errors:
                return "failed"
            if np.isnan(number):
                return "not evaluated"
            return "met" if number <= limit else "violated"

        numbers = self._rows.column(f"requirement {requirement}")
        return [state(sample, float(number)) for sample, number in enumerate(numbers)]


def evaluate(
    scenario: Scenario | StrPath,
    plan: Plan,
    columns: Sequence[str],
    lines: int,
    start: float,
    threads: int | None,
    progress: Callable[[int, int], None] | None,
) -> Rows:
    """Runs every sample on threads of this process. Numbers do not depend on how many."""
    from . import __version__

    columns, lines = names("columns", columns), whole("lines", lines)
    start, progress = number("start", start), function("progress", progress)
    workers = (0 if threads is None else whole("threads", threads)) or os.cpu_count() or 1
    scenario = scenario if isinstance(scenario, Scenario) else Scenario.from_toml(scenario)
    fields = _native.row_fields(scenario._native, columns, lines)
    job = Job(tuple(columns), lines, start, tuple(fields), None, __version__)
    bundle = Bundle.of(scenario)
    numbers = np.full((len(plan), len(fields)), np.nan)
    errors: dict[int, str] = {}
    with ThreadPoolExecutor(workers, "precess") as pool:
        try:
            groups = in_groups(plan.overrides, workers)
            of_groups = pool.map(lambda group: job.rows(bundle, group), groups)
            rows = (row for of_group in of_groups for row in of_group)
            for index, (row, error) in enumerate(rows):
                if row is None:
                    errors[index] = error or "the run was cancelled"
                else:
                    numbers[index] = row
                if progress is not None:
                    progress(index + 1, len(plan))
        except BaseException:
            # Samples that have begun run to their end.
            pool.shutdown(cancel_futures=True)
            raise
    return Rows(plan, dict(fields), numbers, dict(_native.limits(scenario._native)), errors)
