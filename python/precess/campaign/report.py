"""The merged report: what the rows of a campaign say, as a page of Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

from .. import _native
from .plan import Plan

__all__ = ["report"]

#: Shares of which percentiles are estimated, and the level of their intervals.
_SHARES = (0.05, 0.5, 0.95, 0.99)
_LEVEL = 0.95
#: Samples that failed and are listed.
_LISTED = 20


def report(
    title: str,
    plan: Plan,
    fields: Sequence[tuple[str, str]],
    limits: Sequence[tuple[str, float]],
    samples: Path,
) -> str:
    """The page, from the merged file; one column at a time is in memory."""
    file = pq.ParquetFile(samples)
    states = file.read(["state"])["state"].to_pylist()
    failed = [(index, state) for index, state in enumerate(states) if state != "ok"]
    shown = [field for field in fields if not field[0].startswith("end ")]
    columns = {
        name: np.asarray(file.read([name])[name].to_numpy(zero_copy_only=False), dtype=float)
        for name, _ in shown
    }
    lines = [f"# {title}", "", f"{len(states)} samples of {', '.join(plan.labels)}.", ""]
    lines += _percentiles(shown, columns)
    lines += _requirements(limits, columns, len(states), len(failed))
    lines += _correlations(plan, shown, columns, file)
    lines += _failures(failed)
    return "\n".join(lines)


def _percentiles(shown: Sequence[tuple[str, str]], columns: dict[str, np.ndarray]) -> list[str]:
    heads = ["number", "unit", *(f"{100 * share:g} %" for share in _SHARES), "largest", "of sample"]
    lines = ["## Percentiles", "", _row(heads), _row(["---"] * len(heads))]
    for name, unit in shown:
        values = columns[name]
        there = np.sort(values[~np.isnan(values)])
        cells = [name, unit]
        for share in _SHARES:
            found = _native.estimate_percentile(there.tolist(), share, _LEVEL)
            cells.append("none" if found is None else _interval(*found))
        worst = int(np.nanargmax(values)) if len(there) else None
        cells += ["none", ""] if worst is None else [_six(values[worst]), str(worst)]
        lines.append(_row(cells))
    note = f"Intervals contain the percentile of independent samples with a probability of {_LEVEL:g} at least."
    return [*lines, "", note, ""]


def _requirements(
    limits: Sequence[tuple[str, float]], columns: dict[str, np.ndarray], count: int, failed: int
) -> list[str]:
    if not limits:
        return []
    heads = ["requirement", "limit, SI", "met by", "not evaluated by", "probability"]
    lines = ["## Requirements", "", _row(heads), _row(["---"] * len(heads))]
    for name, limit in limits:
        values = columns.get(f"requirement {name}")
        if values is None:
            continue
        met = int(np.count_nonzero(values <= limit))
        unknown = int(np.count_nonzero(np.isnan(values))) - failed
        found = _native.estimate_probability(met, count, _LEVEL, unknown)
        if found is None:
            share = "none"
        elif unknown:
            share = f"{_six(found[1])} to {_six(found[2])}"
        else:
            share = _interval(*found)
        lines.append(_row([name, _six(limit), f"{met} of {count}", str(unknown), share]))
    note = (
        "A sample that failed meets none. Of samples that could not evaluate a requirement it is not known whether they "
        "meet it: the interval is from that with none of them to that with all."
    )
    return [*lines, "", note, ""]


def _correlations(
    plan: Plan,
    shown: Sequence[tuple[str, str]],
    columns: dict[str, np.ndarray],
    file: pq.ParquetFile,
) -> list[str]:
    lines = []
    for label in plan.labels:
        try:
            keys = np.asarray(file.read([label])[label].to_numpy(zero_copy_only=False), dtype=float)
        except ValueError:
            continue  # Texts have no ranks.
        for name, _ in shown:
            there = ~np.isnan(columns[name])
            found = _native.rank_correlation(keys[there].tolist(), columns[name][there].tolist())
            if found is not None:
                lines.append(_row([name, label, f"{found:.3f}"]))
    if not lines:
        return []
    heads = ["number", "key", "rank correlation"]
    return ["## Rank correlations", "", _row(heads), _row(["---"] * 3), *lines, ""]


def _failures(failed: Sequence[tuple[int, str]]) -> list[str]:
    if not failed:
        return ["Every sample was run.", ""]
    lines = [f"## Samples that failed: {len(failed)}", "", _row(["sample", "why"]), _row(["---"] * 2)]
    lines += [_row([str(index), why.replace("|", "\\|")]) for index, why in failed[:_LISTED]]
    rest = len(failed) - _LISTED
    return [*lines, "", *([f"And {rest} more.", ""] if rest > 0 else [])]


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _interval(value: float, lower: float, upper: float) -> str:
    return f"{_six(value)} ({_six(lower)} to {_six(upper)})"


def _six(value: float) -> str:
    return f"{value:.6g}"
