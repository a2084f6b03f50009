"""A small scenario, and a scheduler and workers as processes on loopback."""

from __future__ import annotations

import contextlib
import os
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

pytest.importorskip("pyarrow")

#: An imbalanced wheel on a free hub, for a twentieth of a second; based on a second file.
WHEEL = """format = 1
base = "hub.toml"
title = "A wheel"

[[device]]
name = "wheel"
kind = "reaction_wheel"

[device.wheel]
mass = "4 kg"
centre_of_mass = "0, 0.08, 0 mm"
inertia = "0.02, 0.012, 0.011 kg m^2"
rate = "600 rad/s"

[[requirement]]
name = "quiet"
quantity = "omega"
statistic = "peak"
limit = "10 urad/s"

[run]
duration = "0.05 s"

[output]
rate = "1 kHz"
"""
HUB = """format = 1

[hub]
mass = "96 kg"
centre_of_mass = "1, 2, 0 mm"
inertia = "20, 18, 15 kg m^2"
"""


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """A scenario file that is based on another one."""
    folder = tmp_path / "scenario"
    folder.mkdir()
    (folder / "hub.toml").write_text(HUB)
    path = folder / "wheel.toml"
    path.write_text(WHEEL)
    return path


class Cluster:
    """A scheduler and its workers. Each is a process that a test may kill."""

    def __init__(self, folder: Path, environment: dict[str, str]) -> None:
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.folder = folder
        self.environment = environment | {"DASK_DISTRIBUTED__ADMIN__LOW_LEVEL_LOG_LENGTH": "0"}
        self.processes: list[subprocess.Popen[bytes]] = []
        self.scheduler = self.start_scheduler()

    def _start(self, name: str, *arguments: str) -> subprocess.Popen[bytes]:
        log = open(self.folder / f"{name}.log", "ab")
        process = subprocess.Popen(
            [sys.executable, "-m", "distributed.cli." + arguments[0], *arguments[1:]],
            stdout=log,
            stderr=log,
            env=os.environ | self.environment,
            start_new_session=True,
            cwd=self.folder,
        )
        self.processes.append(process)
        return process

    def start_scheduler(self) -> subprocess.Popen[bytes]:
        self.scheduler = self._start(
            "scheduler", "dask_scheduler", "--host", "127.0.0.1", "--port", str(self.port),
            "--no-dashboard", "--no-show",
        )
        return self.scheduler

    def start_worker(self, nanny: bool = False) -> subprocess.Popen[bytes]:
        return self._start(
            f"worker{len(self.processes)}", "dask_worker", self.address, "--nthreads", "1",
            "--nanny" if nanny else "--no-nanny", "--no-dashboard", "--death-timeout", "60",
            "--local-directory", str(self.folder),
        )

    @staticmethod
    def wait_for(condition: Callable[[], bool], seconds: float = 60.0) -> None:
        """Waits until something is true."""
        until = time.monotonic() + seconds
        while not condition():
            assert time.monotonic() < until, "it has not come true"
            time.sleep(0.02)

    def close(self) -> None:
        for process in self.processes:
            with contextlib.suppress(ProcessLookupError):
                # The session of this process: a nanny and its worker.
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


@pytest.fixture
def cluster(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Cluster]:
    """A scheduler on loopback, without workers."""
    pytest.importorskip("distributed")
    folder = tmp_path / "cluster"
    folder.mkdir()
    here = Cluster(folder, {"PRECESS_TEST_FOLDER": str(tmp_path)})
    monkeypatch.setenv("PRECESS_TEST_FOLDER", str(tmp_path))
    try:
        yield here
    finally:
        here.close()
