"""Jitter budgets: lines of rotors over the speed, through structure and devices, against the limits of lines of sight."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _native
from ._tables import Overrides, overrides_of
from ._wanted import whole

__all__ = ["Budget", "Contributor", "Limit", "budget"]


@dataclass(frozen=True)
class Contributor:
    """A tone: of which rotor, by what cause, at which multiple of its rate."""

    rotor: str
    cause: str
    order: float


@dataclass(frozen=True)
class Limit:
    """A requirement on a line of sight, and what the sweep says of it. Numbers are SI.

    Attributes
    ----------
    name, sight, metric : str
        The requirement, its line of sight, and what is limited.
    limit : float
        The bound.
    unit : (str, float)
        The unit in which it is shown, and its size.
    values : array, shape (speeds,)
        The metric at each speed.
    worst : float
        The speed at which it is largest, rad/s.
    shares : dict of Contributor to float
        Shares of the mean square there, as the phases of the budget add tones up, largest first; with ``noise``, that of
        broadband noise, they add up to one. With given phases the share of a tone is its projection on the sum, and may be negative.
    keep_out : list of (float, float)
        Speeds at which the limit is violated, rad/s.
    state : str
        ``"met"``, ``"violated"`` or ``"not evaluated"``: no line and no noise has a share in the metric at any speed.
    reason : str or None
        Why it is not evaluated.
    """

    name: str
    sight: str
    metric: str
    limit: float
    unit: tuple[str, float]
    values: npt.NDArray[np.float64]
    worst: float
    shares: dict[Contributor, float]
    noise: float
    keep_out: list[tuple[float, float]]
    state: str
    reason: str | None

    @property
    def value(self) -> float:
        """The metric at the worst speed."""
        return float(self.values.max())

    @property
    def met(self) -> bool:
        """Whether it is met at every speed: one that is not evaluated is neither met nor violated."""
        return self.state == "met"

    def __repr__(self) -> str:
        unit, size = self.unit
        if self.reason is not None:
            return f"<{self.name!r} of {self.sight}: not evaluated: {self.reason}>"
        return (
            f"<{self.name!r} of {self.sight}: {self.value / size:.4g} of {self.limit / size:.4g} {unit}, {self.state}>"
        )


class Budget:
    """What a sweep found: ``speeds``, rad/s, and a :class:`Limit` for each requirement."""

    def __init__(self, native: Any) -> None:
        self.title: str = native.title
        self.speeds = np.array(native.speeds)
        self.contributors = [Contributor(*facts) for facts in native.contributors]
        self.left_out: list[str] = native.left_out
        self.limits = [self._limit(*facts) for facts in native.requirements]

    def _limit(self, facts: Any, swept: Any, parts: Any, keep_out: Any, verdict: Any) -> Limit:
        name, sight, metric, limit, unit, size = facts
        values, worst = swept
        shares, noise = parts
        by = {self.contributors[index]: share for index, share in shares}
        speed = float(self.speeds[worst])
        ranges = [(lower, upper) for lower, upper in keep_out]
        return Limit(
            name, sight, metric, limit, (unit, size), np.array(values), speed, by, noise, ranges, *verdict
        )

    @property
    def met(self) -> bool:
        """Whether every requirement is met at every speed."""
        return all(limit.met for limit in self.limits)

    def __repr__(self) -> str:
        return f"<precess.jitter.Budget {self.title!r}: {self.limits}>"


def budget(
    path: str | os.PathLike[str], set: Overrides | None = None, threads: int | None = None
) -> Budget:
    """Sweeps the speeds of a budget file, as ``precess jitter`` does.

    ``set`` replaces keys of its scenario, and with the prefix ``budget.`` those of the file.

    Raises
    ------
    ScenarioError
        Where budget or scenario cannot be read.
    RunError
        Where the model has no answer.
    """
    count = (0 if threads is None else whole("threads", threads)) or os.cpu_count() or 1
    return Budget(_native.jitter_budget(os.fspath(path), overrides_of(set), count))
