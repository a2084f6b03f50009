"""Partitions on the cores of this machine, by threads of this process."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .bundle import Bundle
from .isolated import isolated_rows
from .job import Job, Row, in_groups
from .partition import Partition
from .plan import Plan

__all__ = ["evaluate"]


def evaluate(
    job: Job,
    bundle: Bundle,
    plan: Plan,
    missing: Sequence[Partition],
    folder: Path,
    threads: int | None,
    finished: Callable[[Partition, list[Row]], None],
) -> None:
    """Runs the samples of each partition side by side, one partition after another.

    A partition that is being run has a marker beside its file. One that has a marker before it is run may have ended
    this process: its samples are run in a process of their own.
    """
    count = threads or len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else threads
    workers = count or os.cpu_count() or 1
    with ThreadPoolExecutor(workers, "precess-campaign") as pool:
        try:
            for part in missing:
                marker = folder / f"{part.name}.running"
                samples = part.samples(plan)
                if marker.exists():
                    rows = isolated_rows(job, bundle, samples)
                else:
                    marker.touch()
                    groups = in_groups(samples, workers)
                    of_groups = pool.map(lambda group: job.rows(bundle, group), groups)
                    rows = [row for of_group in of_groups for row in of_group]
                finished(part, rows)
                marker.unlink(missing_ok=True)
        except BaseException:
            # Samples that have begun run to their end.
            pool.shutdown(cancel_futures=True)
            raise
