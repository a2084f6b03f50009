"""Plans: the samples of a campaign in order, each with what it sets."""

from __future__ import annotations

import json
import os
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import _native
from .._tables import overrides_of, toml_of
from .._wanted import items, table, text, whole

__all__ = ["Plan", "grid", "latin_hypercube", "listed", "monte_carlo", "sobol"]

#: A plan file with ``[[vary]]`` tables, or these tables.
Vary = str | os.PathLike[str] | Sequence[Mapping[str, Any]]


@dataclass(frozen=True)
class Plan:
    """The samples of a campaign.

    Attributes
    ----------
    labels : tuple of str
        The varied keys with the units of the values: ``hub.mass [kg]``.
    values : tuple of tuple
        The values of each sample, one for each label: numbers, or texts.
    overrides : tuple of tuple of str
        What sets the keys of each sample, as ``--set`` takes it.
    """

    labels: tuple[str, ...]
    values: tuple[tuple[Any, ...], ...]
    overrides: tuple[tuple[str, ...], ...]

    def __len__(self) -> int:
        return len(self.values)

    def __repr__(self) -> str:
        return f"<precess.campaign.Plan: {len(self)} samples of {', '.join(self.labels)}>"


def grid(axes: Mapping[str, str]) -> Plan:
    """Every combination of the values of some keys, the last key fastest.

    ``{"hub.mass": "100..900 kg:9"}``: nine values with equal differences; ``"1..100 kg:log 5"``: five with equal
    ratios; ``"1, 2, 5 kg"``: these.
    """
    pairs = table("the axes of a sweep", axes).items()
    return _of(
        _native.plan_of_axes([f"{text('a key', key)}={text(key, values)}" for key, values in pairs])
    )


def monte_carlo(vary: Vary, samples: int, seed: int = 1) -> Plan:
    """Independent draws, those of ``precess montecarlo``. More samples keep the earlier ones."""
    return _drawn(vary, samples, seed, False)


def latin_hypercube(vary: Vary, samples: int, seed: int = 1) -> Plan:
    """One draw in each of ``samples`` equally probable parts of the distribution of every key."""
    return _drawn(vary, samples, seed, True)


def sobol(vary: Vary, samples: int, seed: int = 1) -> Plan:
    """The first points of a scrambled Sobol sequence of SciPy; take a power of two of them.

    More samples keep the earlier ones, with the same version of SciPy.
    """
    from scipy.stats import qmc

    samples, seed = whole("samples", samples, 1), whole("seed", seed)

    def planned(path: str) -> Any:
        keys = len(_native.plan_keys(path))
        points = qmc.Sobol(keys, scramble=True, bits=30, seed=seed).random(samples)
        # Points are multiples of 2^-30: the middle of each cell is between zero and one.
        return _native.plan_of_probabilities(path, (points + 2.0**-31).tolist())

    return _of(_with_file(vary, planned))


def listed(samples: Mapping[str, Sequence[Any]]) -> Plan:
    """These samples: a list for each key, all of one length. Values are texts with units, or numbers in SI units."""
    lengths = {len(values) for values in table("samples", samples).values()}
    if len(lengths) != 1 or lengths == {0}:
        raise ValueError(
            f"lists of {sorted(lengths)} values make no samples; give each key as many, one at least"
        )
    rows = tuple(zip(*samples.values(), strict=True))
    sets = tuple(tuple(overrides_of(dict(zip(samples, row, strict=True)))) for row in rows)
    return Plan(tuple(samples), rows, sets)


def _drawn(vary: Vary, samples: int, seed: int, latin: bool) -> Plan:
    samples, seed = whole("samples", samples), whole("seed", seed)
    # Memory for the values: a MemoryError, or nothing.
    np.empty(samples)
    return _of(_with_file(vary, lambda path: _native.plan_of_draws(path, samples, seed, latin)))


def _of(facts: tuple[list[str], list[tuple[list[float], list[str]]]]) -> Plan:
    labels, samples = facts
    return Plan(
        tuple(labels),
        tuple(tuple(values) for values, _ in samples),
        tuple(tuple(overrides) for _, overrides in samples),
    )


def _with_file(vary: Vary, planned: Any) -> Any:
    """A plan of a file, or of tables, which are written to one: one reader, the same messages."""
    if isinstance(vary, str | os.PathLike):
        return planned(os.fspath(vary))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "plan.toml")
        tables = items("vary", vary, "a path, or a list of tables")
        rows = [dict(table("a table of vary", of)) for of in tables]
        path.write_text(toml_of({"format": 1, "vary": rows}), encoding="utf-8")
        return planned(str(path))


def digestible(plan: Plan, start: int, stop: int) -> str:
    """A slice of a plan as a text that is the same wherever it is made."""
    slice_ = [start, plan.labels, plan.overrides[start:stop]]
    return json.dumps(slice_, ensure_ascii=True, separators=(",", ":"))
