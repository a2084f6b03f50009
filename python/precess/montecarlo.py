"""Monte Carlo campaigns: runs of a scenario whose keys are drawn from distributions, as ``precess montecarlo`` makes them.

For campaigns that are kept on the disk and continued, or that run on a cluster, see :mod:`precess.campaign`.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _native, _wanted
from ._rows import OfRows, StrPath, evaluate
from .campaign.plan import Vary, _with_file, latin_hypercube, monte_carlo
from .scenario import Scenario

__all__ = ["Estimate", "Samples", "Sensitivities", "run", "sensitivities"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """A value and the interval that contains the true one with the stated probability at least."""

    value: float
    interval: tuple[float, float]


class Samples(OfRows):
    """The numbers of a campaign by name, one array each: ``samples["omega rms"]``, shape ``(samples,)``; and the drawn values
    of a key, ``samples.values("hub.mass")``. Numbers of a sample that failed are NaN."""

    @property
    def errors(self) -> dict[int, str]:
        """Why each sample that failed has no numbers."""
        return self._rows.errors

    def __len__(self) -> int:
        return len(self._rows.plan)

    def __getitem__(self, name: str) -> Array:
        return self._rows.column(name)

    def values(self, key: str) -> Array:
        """The drawn values of a key, in the unit of its label."""
        bare = [label.split(" [")[0] for label in self.labels]
        if key not in bare:
            raise KeyError(f"`{key}` is not drawn; there are {', '.join(bare)}")
        return np.array([row[bare.index(key)] for row in self._rows.plan.values], dtype=np.float64)

    def percentile(self, name: str, share: float, level: float = 0.95) -> Estimate:
        """The percentile of a number, with an interval that holds for any continuous distribution."""
        numbers = self[name]
        found = _native.estimate_percentile(
            np.sort(numbers[~np.isnan(numbers)]).tolist(),
            _wanted.share("share", share),
            _wanted.share("level", level),
        )
        if found is None:
            raise ValueError(f"no sample has `{name}`")
        return Estimate(found[0], found[1:])

    def probability(self, requirement: str, level: float = 0.95) -> Estimate:
        """The probability that a requirement is met, by Clopper and Pearson. A sample that failed meets none.

        Where samples that were run could not evaluate it, the value is NaN, and the interval is from that with none of
        them meeting it to that with all of them.
        """
        if requirement not in self.limits:
            raise KeyError(f"no requirement `{requirement}`; there are {', '.join(self.limits)}")
        level = _wanted.share("level", level)
        numbers = self[f"requirement {requirement}"]
        met = int((numbers <= self.limits[requirement]).sum())
        unknown = int(np.isnan(numbers).sum()) - len(self.errors)
        found = _native.estimate_probability(met, len(self), level, unknown)
        if found is None:
            raise ValueError("there are no samples")
        return Estimate(found[0], found[1:])

    def rank_correlation(self, name: str, key: str) -> float | None:
        """Rank correlation by Spearman of a number and a key; None where one of them does not vary."""
        numbers, values = self[name], self.values(key)
        there = ~np.isnan(numbers)
        return _native.rank_correlation(values[there].tolist(), numbers[there].tolist())

    def __repr__(self) -> str:
        return f"<precess.montecarlo.Samples: {len(self)} of {', '.join(self.labels)}>"


@dataclass(frozen=True, eq=False)
class Sensitivities:
    """Exact derivatives of numbers by keys, about the middle of each distribution.

    Attributes
    ----------
    labels : tuple of str
        The keys that have a derivative, with their units.
    deviations : array, shape (keys,)
        Standard deviation of each key, in its unit.
    slopes : dict of str to array
        Derivatives of each number, shape ``(keys,)``, in its SI unit by the key's unit; a number without is left out.
    difference : float
        Largest share by which a number of the differentiated run differs from that of the scenario's own.
    """

    labels: tuple[str, ...]
    deviations: Array
    slopes: dict[str, Array]
    difference: float

    def ranked(self, name: str) -> list[tuple[str, float]]:
        """Keys and magnitudes of derivative times deviation, the largest first."""
        sizes = np.abs(self.slopes[name] * self.deviations)
        return [(self.labels[k], float(sizes[k])) for k in np.argsort(-sizes, kind="stable")]


def run(
    scenario: Scenario | StrPath,
    vary: Vary,
    samples: int,
    seed: int = 1,
    *,
    latin: bool = False,
    columns: Sequence[str] = ("omega",),
    lines: int = 0,
    start: float = 0.0,
    threads: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Samples:
    """Runs samples that are drawn from distributions: those of ``precess montecarlo`` with the same seed.

    Parameters
    ----------
    scenario : Scenario or path
        What is run.
    vary : path or list of dict
        A plan file with ``[[vary]]`` tables, or these tables.
    samples, seed : int
        More samples of a seed keep the earlier ones.
    latin : bool
        A Latin hypercube in place of independent draws.
    columns, lines, start, threads, progress
        As of :func:`precess.sweep.run`.

    Raises
    ------
    ScenarioError, RecordError
        Where scenario or plan cannot be read, or there is no such column.
    """
    plan = (latin_hypercube if latin else monte_carlo)(vary, samples, seed)
    return Samples(evaluate(scenario, plan, columns, lines, start, threads, progress))


def sensitivities(
    scenario: StrPath,
    vary: Vary,
    *,
    set: Sequence[str] = (),
    columns: Sequence[str] = ("omega",),
    start: float = 0.0,
) -> Sensitivities:
    """Derivatives of requirements, and of RMS and peak of columns, by a run of fixed steps with its derivatives: exact to rounding.

    Parameters
    ----------
    scenario : path
        A scenario file.
    vary : path or list of dict
        Whose middles and deviations are taken.
    set : sequence of str
        Overrides ``KEY = VALUE`` in TOML.

    Raises
    ------
    UnsupportedError
        A scenario that is not differentiated, with the reason.
    """
    overrides, of, from_ = (
        _wanted.names("set", set),
        _wanted.names("columns", columns),
        _wanted.number("start", start),
    )

    def differentiated(plan: str) -> tuple[list[str], list[float], list[list[float] | None], float]:
        return _native.plan_sensitivities(
            os.fspath(scenario), overrides, plan, of, from_
        )

    labels, deviations, slopes, difference = _with_file(vary, differentiated)
    numbers = [f"requirement {name}" for name in _requirements(scenario, overrides)]
    numbers += [f"{column} {kind}" for column in of for kind in ("rms", "peak")]
    named = {
        name: np.array(slope)
        for name, slope in zip(numbers, slopes, strict=True)
        if slope is not None
    }
    return Sensitivities(tuple(labels), np.array(deviations), named, difference)


def _requirements(scenario: StrPath, overrides: Sequence[str]) -> list[str]:
    native = _native.NativeScenario.from_file(os.fspath(scenario), list(overrides))
    return [name for name, _ in _native.limits(native)]
