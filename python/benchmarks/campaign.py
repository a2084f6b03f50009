"""What a campaign costs on this machine: threads of one process, and workers of Dask on loopback.

    python python/benchmarks/campaign.py scenarios/wheel-data-sheet.toml scenarios/plans/wheel-imbalance.toml

Prints the table of docs/clusters.md. Everything but the row that says so is measured.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from machine import processor
from precess import campaign


@contextmanager
def scheduler(workers: int) -> Iterator[Any]:
    """Workers of one thread each, each a process."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(
            n_workers=workers, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        Client(cluster) as client,
    ):
        # Imports are no part of a campaign.
        client.run(__import__, "precess.campaign")
        yield client


def measured(arguments: argparse.Namespace, **options: Any) -> float:
    """Seconds of a campaign in an empty folder."""
    plan = campaign.monte_carlo(arguments.plan, arguments.samples)
    with tempfile.TemporaryDirectory() as out:
        start = time.perf_counter()
        found = campaign.run(
            arguments.scenario, plan, out, partition=arguments.partition, **options
        )
        seconds = time.perf_counter() - start
        assert not found.failed, found.failed
        arguments.bytes = found.samples.stat().st_size
    return seconds


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenario")
    parser.add_argument("plan")
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--partition", type=int, default=16)
    parser.add_argument("--turns", type=int, default=3)
    arguments = parser.parse_args()
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    rows: dict[str, list[float]] = {}
    # Turn by turn, so that what else the machine does meets all alike.
    for _ in range(arguments.turns):
        for threads in sorted({1, cores}):
            name = f"one process, {threads} thread{'s' if threads > 1 else ''}"
            rows.setdefault(name, []).append(measured(arguments, threads=threads))
        for workers in sorted({1, cores}):
            name = f"Dask, {workers} worker{'s' if workers > 1 else ''} on loopback"
            with scheduler(workers) as client:
                rows.setdefault(name, []).append(measured(arguments, client=client))
    print(f"{processor()}, {cores} cores; {arguments.samples} samples of {arguments.scenario}, ")
    print(f"partitions of {arguments.partition}, the quickest of {arguments.turns} turns")
    print()
    print("| | seconds | ms a sample |")
    print("|---|---:|---:|")
    best = {name: min(seconds) for name, seconds in rows.items()}
    for name, seconds in best.items():
        print(f"| {name} | {seconds:.2f} | {1e3 * seconds / arguments.samples:.2f} |")
    size = arguments.bytes / arguments.samples
    print(f"\n`samples.parquet`: {size:.0f} bytes a sample")
    single = best["Dask, 1 worker on loopback"] / arguments.samples
    hours = 1e6 * single / 3600.0
    print(
        f"reckoned for a million samples: {hours:.1f} hours of a core "
        f"({hours / 100:.2f} hours on 100 cores that are no slower, if the client keeps up), {size / 1e3:.2f} GB"
    )
    start = time.perf_counter()
    subprocess.run([sys.executable, "-c", "import precess.campaign"], check=True)
    print(f"a process and its imports: {time.perf_counter() - start:.2f} s")


if __name__ == "__main__":
    main()
