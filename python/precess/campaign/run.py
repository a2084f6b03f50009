"""A campaign from scenario and plan to its files."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import _native
from .._wanted import function, instance, names, number, table, whole
from ..scenario import Scenario
from . import local
from .bundle import Bundle
from .job import Job, Measure, Row
from .partition import Partition, identity, partitions
from .plan import Plan

__all__ = ["Campaign", "run"]

StrPath = str | os.PathLike[str]


@dataclass(frozen=True)
class Campaign:
    """A campaign that is finished, in a folder.

    Attributes
    ----------
    folder : Path
        Where its files are.
    samples : Path
        Every row, in the order of the samples: Parquet.
    report : Path
        What they say: Markdown.
    partitions : tuple of Path
        The partitions, in order.
    evaluated : int
        How many samples this call has run; the others were there.
    """

    folder: Path
    samples: Path
    report: Path
    partitions: tuple[Path, ...]
    evaluated: int

    def table(self) -> Any:
        """The rows as a ``pyarrow.Table``."""
        import pyarrow.parquet as pq

        return pq.read_table(self.samples)

    def to_pandas(self) -> Any:
        """The rows as a ``pandas.DataFrame`` with ``sample`` as its index."""
        return self.table().to_pandas().set_index("sample")

    @property
    def failed(self) -> dict[int, str]:
        """Why each sample that failed has no numbers."""
        states = self.table().select(["sample", "state"]).to_pylist()
        return {row["sample"]: row["state"] for row in states if row["state"] != "ok"}

    def __repr__(self) -> str:
        return f"<precess.campaign.Campaign in {self.folder}: {self.evaluated} samples run now>"


def run(
    scenario: Scenario | StrPath,
    plan: Plan,
    out: StrPath,
    *,
    columns: Sequence[str] = ("omega",),
    lines: int = 0,
    start: float = 0.0,
    measure: Measure | None = None,
    fields: Mapping[str, str] | None = None,
    partition: int = 256,
    client: Any = None,
    threads: int | None = None,
    patience: float = 600.0,
    progress: Callable[[int, int], None] | None = None,
) -> Campaign:
    """Runs every sample of a plan that the folder ``out`` does not have.

    The same call continues a campaign that was ended, and does nothing for one that is finished. A sample that cannot be read or
    run, or that ends its process, is a row whose ``state`` is the reason.

    Parameters
    ----------
    scenario : Scenario or path
        What is run. Workers get the files that it names.
    plan : Plan
        The samples: of :func:`grid`, :func:`monte_carlo`, :func:`latin_hypercube`, :func:`sobol` or :func:`listed`.
    out : path
        The folder of the results; it is made where it is missing.
    columns, lines, start
        Columns or vectors of which RMS, peak and the strongest lines are computed, from the time ``start``, s, on. A row also
        has the statistic of each requirement, and each column at the end.
    measure : callable, optional
        Computes the numbers of a row instead, from the :class:`precess.Scenario` of a sample: a mapping with the keys of
        ``fields``. Workers need what it imports.
    fields : mapping, optional
        The names of these numbers and their units.
    partition : int
        Samples of a file, and of a task.
    client : distributed.Client or str, optional
        A client of Dask, or the address of a scheduler. Without it, threads of this process.
    threads : int, optional
        How many, without a client; all cores by default.
    patience : float
        How long a scheduler may stay away, s.
    progress : callable, optional
        Called with the number of samples that are finished and that of all.

    Returns
    -------
    Campaign

    Raises
    ------
    ScenarioError, RecordError
        Where the scenario cannot be read, or has no such column.
    OSError
        Where a file cannot be written; what is finished is kept.
    """
    from . import store

    plan = instance("plan", plan, Plan, "a precess.campaign.Plan")
    columns, lines = tuple(names("columns", columns)), whole("lines", lines)
    start, patience = number("start", start), number("patience", patience)
    partition = whole("partition", partition, 1)
    threads = None if threads is None else whole("threads", threads)
    progress, measure = function("progress", progress), function("measure", measure)
    fields = None if fields is None else table("fields", fields)
    scenario = scenario if isinstance(scenario, Scenario) else Scenario.from_toml(scenario)
    job = _job(scenario, columns, lines, start, measure, fields)
    bundle = Bundle.of(scenario)
    parts = partitions(job, bundle, plan, partition)
    folder = Path(out)
    files = folder / "partitions"
    files.mkdir(parents=True, exist_ok=True)
    for of_clients in (folder, files):
        store.remove_partial(of_clients)
    missing = [part for part in parts if not (files / part.name).exists()]
    columns_ = store.schema(plan, job.fields, _about(scenario, job, bundle))
    done = len(plan) - sum(part.stop - part.start for part in missing)

    def finished(part: Partition, found: list[Row]) -> None:
        nonlocal done
        store.write(store.table(columns_, plan, part.start, found), files / part.name)
        done += part.stop - part.start
        if progress is not None:
            progress(done, len(plan))

    evaluated = len(plan) - done
    if progress is not None:
        progress(done, len(plan))
    if missing and client is None:
        local.evaluate(job, bundle, plan, missing, files, threads, finished)
    elif missing:
        from . import cluster

        cluster.evaluate(client, job, bundle, plan, missing, patience, finished)
    result = Campaign(
        folder,
        folder / "samples.parquet",
        folder / "report.md",
        tuple(files / part.name for part in parts),
        evaluated,
    )
    _merged(result, scenario, job, plan, columns_, _manifest(scenario, job, bundle, plan, parts))
    return result


def _job(
    scenario: Scenario,
    columns: tuple[str, ...],
    lines: int,
    start: float,
    measure: Measure | None,
    fields: Mapping[str, str] | None,
) -> Job:
    from .. import __version__

    if (measure is None) != (fields is None):
        raise ValueError("measure and fields belong together; state both or none")
    if fields is not None:
        named = [(str(name), str(unit)) for name, unit in fields.items()]
    else:
        named = _native.row_fields(scenario._native, list(columns), lines)
    return Job(columns, lines, float(start), tuple(named), measure, __version__)


def _about(scenario: Scenario, job: Job, bundle: Bundle) -> dict[str, str]:
    return {
        "precess.version": job.version,
        "precess.scenario": scenario.name,
        "precess.identity": hashlib.sha256(identity(job, bundle).encode()).hexdigest(),
    }


def _manifest(
    scenario: Scenario, job: Job, bundle: Bundle, plan: Plan, parts: Sequence[Partition]
) -> str:
    about = _about(scenario, job, bundle) | {
        "samples": len(plan),
        "keys": list(plan.labels),
        "partitions": [part.name for part in parts],
    }
    return json.dumps(about, indent=1, ensure_ascii=False) + "\n"


def _merged(
    result: Campaign, scenario: Scenario, job: Job, plan: Plan, columns: Any, manifest: str
) -> None:
    """Writes what is made of all partitions; the manifest is last, so with it everything is there."""
    from . import store
    from .report import report

    path = result.folder / "campaign.json"
    there = result.samples.exists() and result.report.exists() and path.exists()
    if there and path.read_text(encoding="utf-8") == manifest:
        return
    path.unlink(missing_ok=True)
    store.merge(result.partitions, columns, result.samples)
    limits = _native.limits(scenario._native) if job.measure is None else []
    page = report(f"{scenario.title}: campaign", plan, job.fields, limits, result.samples)
    store.atomic_text(result.report, page)
    store.atomic_text(path, manifest)
