"""Partitions on a cluster, by Dask distributed. Workers return rows; only the client writes files.

A task that is on a worker that dies is given to another one; after some of them (``distributed.scheduler.allowed-failures``) its samples
are run in processes of their own. A scheduler that is lost is waited for, and what is not on the disk is given to it
again.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any

import cloudpickle
import distributed
from distributed.comm import CommClosedError

from ..errors import Error
from .bundle import Bundle
from .isolated import isolated_rows
from .job import Job, Row, VersionError
from .partition import Partition
from .plan import Plan

__all__ = ["ClusterError", "evaluate"]

#: How long a connection may take, s.
_CONNECT = 10.0

#: What a lost scheduler shows itself as.
_LOST = (distributed.client.FutureCancelledError, CommClosedError, TimeoutError, OSError)


class ClusterError(Error, RuntimeError):
    """A scheduler that is not there."""


class _Lost(Exception):
    pass


def evaluate(
    client: distributed.Client | str,
    job: Job,
    bundle: Bundle,
    plan: Plan,
    missing: Sequence[Partition],
    patience: float,
    finished: Callable[[Partition, list[Row]], None],
) -> None:
    """Runs partitions on the workers of a scheduler, in any order.

    Raises
    ------
    ClusterError
        Where the scheduler stays away for ``patience`` seconds.
    VersionError
        Where a worker has another version of the package.
    """
    given = None if isinstance(client, str) else client
    address = client if isinstance(client, str) else str(client.scheduler.address)
    security = None if given is None else given.security
    pending = {part.name: part for part in missing}
    alone: set[str] = set()
    own: Any = None
    try:
        while pending:
            if given is None and own is None:
                own = _connected(address, security, patience)
            try:
                # For this thread only: `as_completed` needs the client.
                with (given or own).as_current():
                    _round(given or own, job, bundle, plan, pending, alone, finished)
            except _Lost:
                # The client of the caller is of a scheduler that is gone.
                given = None
                if own is not None:
                    _closed(own)
                    own = None
    finally:
        if own is not None:
            _closed(own)


def _round(
    client: Any,
    job: Job,
    bundle: Bundle,
    plan: Plan,
    pending: dict[str, Partition],
    alone: set[str],
    finished: Callable[[Partition, list[Row]], None],
) -> None:
    """Gives every pending partition to the scheduler, and takes rows as they come."""

    # By value where the function of a job is in a notebook; the scheduler does not import it.
    packed = cloudpickle.dumps(job)

    def submit(part: Partition) -> Any:
        isolated = part.name in alone
        key = f"precess-{part.name}-{'isolated' if isolated else 'shared'}"
        samples = part.samples(plan)
        # Earlier partitions first.
        return client.submit(
            _rows, packed, files, samples, isolated, key=key, priority=-part.start, pure=True
        )

    try:
        # A task, not scattered data: it is computed again where its worker dies.
        files = client.submit(_same, bundle, key=f"precess-files-{bundle.digest()}", pure=True)
        parts = {submit(part): part for part in pending.values()}
        waiting = distributed.as_completed(list(parts))
    except _LOST as error:
        raise _Lost from error
    while parts:
        future = _next(waiting)
        part = parts.pop(future)
        try:
            found = future.result()
        except distributed.scheduler.KilledWorker:
            alone.add(part.name)
            try:
                again = submit(part)
            except _LOST as error:
                raise _Lost from error
            parts[again] = part
            waiting.add(again)
            continue
        except _LOST as error:
            raise _Lost from error
        finished(part, found)
        del pending[part.name]
        future.release()


def _next(waiting: Any) -> Any:
    try:
        return next(waiting)
    except (StopIteration, *_LOST) as error:
        raise _Lost from error


def _connected(address: str, security: Any, patience: float) -> distributed.Client:
    """A client of the scheduler, as soon as it is there."""
    until = time.monotonic() + patience
    while True:
        try:
            return distributed.Client(
                address, security=security, timeout=_CONNECT, set_as_default=False
            )
        except (TimeoutError, OSError) as error:
            if time.monotonic() > until:
                raise ClusterError(
                    f"no scheduler at {address} for {patience:g} s; start one there and call run again: "
                    "partitions that are finished are kept"
                ) from error
            time.sleep(0.5)


def _closed(client: distributed.Client) -> None:
    try:
        client.close(timeout=2.0)
    # Of a scheduler that is gone.
    except (TimeoutError, OSError, RuntimeError):
        pass


def _same(bundle: Bundle) -> Bundle:
    return bundle


def _rows(packed: bytes, bundle: Bundle, samples: list[tuple[str, ...]], isolated: bool) -> list[Row]:
    """On a worker."""
    from .. import __version__

    job: Job = cloudpickle.loads(packed)
    if job.version != __version__:
        raise VersionError(
            f"a worker has precess {__version__}, the client {job.version}; install one version on both"
        )
    return isolated_rows(job, bundle, samples) if isolated else job.rows(bundle, samples)
