"""Campaigns on a cluster: what dies and comes back; nothing is lost, nothing counted twice, the bytes are those of one process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("distributed")

import cloudpickle

import precess
from precess import campaign

# Workers cannot import this file: functions go to them by value.
cloudpickle.register_pickle_by_value(sys.modules[__name__])

pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")

SAMPLES = 24
PLAN: dict[str, Any] = {"title": [f"sample {index}" for index in range(SAMPLES)]}
FIELDS = {"end": "rad/s"}


def slow(scenario: precess.Scenario) -> dict[str, float]:
    """A run, slow enough to be killed, that leaves a trace."""
    trace = os.path.join(os.environ["PRECESS_TEST_FOLDER"], "trace")
    with open(trace, "a") as file:
        file.write(f"{scenario.title}\n")
    time.sleep(0.05)
    return {"end": float(scenario.run()["omega_x"][-1])}


def poison(scenario: precess.Scenario) -> dict[str, float]:
    """A run; one of the samples kills its process."""
    if scenario.title == "sample 7":
        os.kill(os.getpid(), signal.SIGKILL)
    return {"end": float(scenario.run()["omega_x"][-1])}


def files_of(folder: Path) -> dict[str, bytes]:
    """Every file of a campaign, by its path."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def evaluated(tmp_path: Path) -> int:
    trace = tmp_path / "trace"
    return len(trace.read_text().splitlines()) if trace.exists() else 0


def one_process(scenario: Path, tmp_path: Path, measure: Any = slow) -> dict[str, bytes]:
    """What the campaign is without a cluster."""
    folder = tmp_path / "one process"
    plan = campaign.listed(PLAN)
    campaign.run(scenario, plan, folder, partition=4, threads=1, measure=measure, fields=FIELDS)
    return files_of(folder)


class Running(threading.Thread):
    """A campaign on a cluster, in a thread of the test."""

    def __init__(self, scenario: Path, out: Path, address: str, measure: Any = slow) -> None:
        super().__init__()
        self.arguments = (scenario, campaign.listed(PLAN), out)
        self.options: Any = {
            "partition": 4, "client": address, "measure": measure, "fields": FIELDS, "patience": 120,
        }
        self.error: BaseException | None = None
        self.found: campaign.Campaign | None = None
        self.start()

    def run(self) -> None:
        try:
            self.found = campaign.run(*self.arguments, **self.options)
        except BaseException as error:  # the test raises it
            self.error = error

    def result(self) -> campaign.Campaign:
        self.join(240.0)
        assert not self.is_alive(), "the campaign has not ended"
        if self.error is not None:
            raise self.error
        assert self.found is not None
        return self.found


def test_the_bytes_are_those_of_one_process(
    scenario: Path, tmp_path: Path, cluster: Any
) -> None:
    cluster.start_worker()
    cluster.start_worker()
    found = Running(scenario, tmp_path / "out", cluster.address).result()
    assert found.evaluated == SAMPLES and not found.failed
    assert files_of(tmp_path / "out") == one_process(scenario, tmp_path)
    again = Running(scenario, tmp_path / "out", cluster.address).result()
    assert again.evaluated == 0


def test_a_worker_is_killed(scenario: Path, tmp_path: Path, cluster: Any) -> None:
    doomed = cluster.start_worker()
    running = Running(scenario, tmp_path / "out", cluster.address)
    cluster.wait_for(lambda: evaluated(tmp_path) >= 6)
    os.killpg(doomed.pid, signal.SIGKILL)
    cluster.start_worker()
    assert not running.result().failed
    # The samples of the partition that the worker had are run again, and counted once.
    assert evaluated(tmp_path) > SAMPLES
    assert files_of(tmp_path / "out") == one_process(scenario, tmp_path)


def test_the_scheduler_is_restarted(scenario: Path, tmp_path: Path, cluster: Any) -> None:
    cluster.start_worker()
    running = Running(scenario, tmp_path / "out", cluster.address)
    cluster.wait_for(lambda: evaluated(tmp_path) >= 9)
    os.killpg(cluster.scheduler.pid, signal.SIGKILL)
    cluster.scheduler.wait()
    time.sleep(1.0)
    assert running.is_alive()
    cluster.start_scheduler()
    cluster.start_worker()
    assert not running.result().failed
    assert files_of(tmp_path / "out") == one_process(scenario, tmp_path)


CLIENT = """
import sys
import cloudpickle
from precess import campaign
measure, plan, scenario, out, address = cloudpickle.load(open(sys.argv[1], "rb"))
campaign.run(scenario, plan, out, partition=4, client=address, measure=measure, fields={"end": "rad/s"})
"""


def test_the_client_is_killed_and_resumed(
    scenario: Path, tmp_path: Path, cluster: Any
) -> None:
    cluster.start_worker()
    out = tmp_path / "out"
    arguments = (slow, campaign.listed(PLAN), scenario, out, cluster.address)
    (tmp_path / "arguments").write_bytes(cloudpickle.dumps(arguments))
    command = [sys.executable, "-c", CLIENT, str(tmp_path / "arguments")]
    client = subprocess.Popen(command)
    cluster.wait_for(lambda: len(list(out.glob("partitions/*.parquet"))) >= 2)
    client.send_signal(signal.SIGKILL)
    client.wait()
    left = len(list(out.glob("partitions/*.parquet")))
    assert left < SAMPLES // 4 and not (out / "samples.parquet").exists()
    found = Running(scenario, out, cluster.address).result()
    assert found.evaluated == SAMPLES - 4 * left
    assert files_of(out) == one_process(scenario, tmp_path)


def test_a_sample_that_kills_its_worker_is_a_row(
    scenario: Path, tmp_path: Path, cluster: Any
) -> None:
    # Each has a nanny that starts it again.
    cluster.start_worker(nanny=True)
    cluster.start_worker(nanny=True)
    found = Running(scenario, tmp_path / "out", cluster.address, poison).result()
    assert found.failed == {7: "the process that ran it was ended by signal 9 (SIGKILL)"}
    frame = found.to_pandas()
    assert frame["end"].notna().sum() == SAMPLES - 1
    # In one process the sample ends it; the next call runs its partition in a process of its own.
    folder = tmp_path / "one process"
    program = CLIENT.replace("client=address", "threads=1")
    arguments = (poison, campaign.listed(PLAN), scenario, folder, "")
    (tmp_path / "arguments").write_bytes(cloudpickle.dumps(arguments))
    command = [sys.executable, "-c", program, str(tmp_path / "arguments")]
    assert subprocess.run(command, check=False).returncode == -signal.SIGKILL
    assert subprocess.run(command, check=False).returncode == 0
    assert files_of(tmp_path / "out") == files_of(folder)


def test_a_sample_that_cannot_be_read_is_a_row(
    scenario: Path, tmp_path: Path, cluster: Any
) -> None:
    cluster.start_worker()
    plan = campaign.listed({"hub.mass": ["90 kg", "ninety", "95 kg"]})
    found = campaign.run(scenario, plan, tmp_path / "out", client=cluster.address)
    assert list(found.failed) == [1]
    alone = campaign.run(scenario, plan, tmp_path / "alone", threads=1)
    assert files_of(tmp_path / "out") == files_of(tmp_path / "alone")
    assert alone.failed == found.failed


def test_a_scheduler_that_stays_away_is_an_error(scenario: Path, tmp_path: Path) -> None:
    plan = campaign.listed(PLAN)
    with pytest.raises(precess.Error, match="no scheduler at"):
        campaign.run(scenario, plan, tmp_path / "out", client="tcp://127.0.0.1:9", patience=1.0)
