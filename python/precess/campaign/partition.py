"""Partitions: consecutive samples of a plan, named by everything that their rows depend on."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

from .bundle import Bundle
from .job import Job
from .plan import Plan, digestible

__all__ = ["Partition", "partitions"]


@dataclass(frozen=True)
class Partition:
    """Samples from ``start`` to before ``stop``, in the file ``name``."""

    name: str
    start: int
    stop: int

    def samples(self, plan: Plan) -> list[tuple[str, ...]]:
        """What sets the keys of each sample."""
        return list(plan.overrides[self.start : self.stop])


def identity(job: Job, bundle: Bundle) -> str:
    """What every partition of a campaign depends on: scenario with its files, numbers, versions."""
    # Needs pyarrow, which sweeps and samples in memory do not.
    from .store import WRITER

    return f"precess campaign 1\n{WRITER}\n{job.identity()}\n{bundle.digest()}"


def partitions(job: Job, bundle: Bundle, plan: Plan, size: int) -> list[Partition]:
    """The partitions of a plan, each of ``size`` samples but for the last."""
    common = identity(job, bundle)

    def named(start: int) -> Partition:
        stop = min(start + size, len(plan))
        text = f"{common}\n{digestible(plan, start, stop)}"
        return Partition(f"{hashlib.sha256(text.encode()).hexdigest()}.parquet", start, stop)

    return [named(start) for start in range(0, len(plan), size)]
