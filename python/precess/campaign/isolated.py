"""Samples in a process of their own: one that ends its process is a row, and the next one has another process."""

from __future__ import annotations

import os
import pickle
import signal
import struct
import subprocess
import sys
from collections.abc import Sequence
from typing import IO, Any

from .bundle import Bundle
from .job import Job, Row

__all__ = ["died", "isolated_rows"]

_LENGTH = struct.Struct("<Q")


def isolated_rows(job: Job, bundle: Bundle, samples: Sequence[tuple[str, ...]]) -> list[Row]:
    """The rows of some samples, one after another, run by a process that may end."""
    found: list[Row] = []
    child: subprocess.Popen[bytes] | None = None
    try:
        for overrides in samples:
            if child is None:
                child = _started(job, bundle)
            assert child.stdin is not None and child.stdout is not None
            try:
                _send(child.stdin, overrides)
                found.append(_receive(child.stdout))
            except (EOFError, OSError):
                code = child.wait()
                _close(child)
                child = None
                found.append((None, died(code)))
    finally:
        if child is not None:
            _close(child)
            child.wait()
    return found


def died(code: int) -> str:
    """What a row says of a sample whose process ended, by the exit code of the process."""
    if code < 0:
        how = f"signal {-code} ({signal.Signals(-code).name})"
    else:
        how = f"exit code {code}"
    return f"the process that ran it was ended by {how}"


def _started(job: Job, bundle: Bundle) -> subprocess.Popen[bytes]:
    command = [sys.executable, "-m", "precess.campaign.isolated"]
    child = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    assert child.stdin is not None
    _send(child.stdin, sys.path)
    _send(child.stdin, (job, bundle))
    return child


def _close(child: subprocess.Popen[bytes]) -> None:
    for stream in (child.stdin, child.stdout):
        try:
            if stream is not None:
                stream.close()
        # What was not written is of no use any more.
        except OSError:
            pass


def _send(stream: IO[bytes], value: Any) -> None:
    try:
        # By value, so that functions of a notebook reach the process; it comes with Dask.
        from cloudpickle import dumps
    except ImportError:
        from pickle import dumps
    data = dumps(value)
    stream.write(_LENGTH.pack(len(data)) + data)
    stream.flush()


def _receive(stream: IO[bytes]) -> Any:
    head = _exactly(stream, _LENGTH.size)
    return pickle.loads(_exactly(stream, _LENGTH.unpack(head)[0]))


def _exactly(stream: IO[bytes], count: int) -> bytes:
    data = stream.read(count)
    if len(data) < count:
        raise EOFError
    return data


def _serve() -> None:
    """The process: a job, then samples until there are no more."""
    requests = os.fdopen(os.dup(0), "rb")
    answers = os.fdopen(os.dup(1), "wb")
    # What a function prints is no answer.
    os.dup2(2, 1)
    sys.path[:] = _receive(requests)
    job, bundle = _receive(requests)
    while True:
        try:
            overrides = _receive(requests)
        except EOFError:
            return
        _send(answers, job.rows(bundle, [overrides])[0])


if __name__ == "__main__":
    _serve()
