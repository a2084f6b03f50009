"""Steps of RK4 of 256 states of four double-gimbal gyros on one thread: the batch of Python beside that of Rust, beside
`mujoco.rollout` and mjbatch.

    cargo build --release -p precess-lanes --features precess-dynamics/avx512 --example throughput
    pip install mujoco==4.0.0 pin==4.1.0
    pip install --target "$VIRTUAL_ENV/mjbatch" --requirement tests/peers/requirements-mjbatch.txt
    python python/benchmarks/throughput.py --rust target/release/examples/throughput

Prints the table of docs/python.md. The spacecraft is the one of four gyros that `tests/fixtures/engines.json` stores with what
Pinocchio gives for it, which is compared first. Times are those of the processor in all threads of a process, turn by turn, the
least of all turns: what else the machine does is not counted. Programs that are not there have no row.
"""

from __future__ import annotations

import argparse
import json
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import numpy as np

import precess
from machine import processor

ROOT = Path(__file__).resolve().parents[2]
STORED = ROOT / "tests" / "fixtures" / "engines.json"
PEERS = ROOT / "tests" / "peers" / "mujoco_batch.py"
STATES = 256
#: Steps in a call, as of `tests/peers`; and of a run of some length.
STEPS, LONG = 10, 1000
#: As of the example in Rust: between the body rates of two neighbours, and the step, s.
APART, STEP = 1e-3, 1e-7
#: As of the suite `engines`: of the largest number of a block.
AGREEMENT = 1e-11
#: Steps and states of a turn, about.
TURN = 400_000


def stored() -> dict[str, Any]:
    """The spacecraft of four gyros."""
    all_of_them = json.loads(STORED.read_text(encoding="utf-8"))["spacecraft"]
    found: dict[str, Any] = next(craft for craft in all_of_them if len(craft["devices"]) == 4)
    return found


def tensor(entries: list[float]) -> dict[str, list[float]]:
    """Of 11, 12, 13, 22, 23, 33."""
    xx, xy, xz, yy, yz, zz = entries
    return {"inertia": [xx, yy, zz], "products_of_inertia": [xy, xz, yz]}


def device(number: int, of: dict[str, Any]) -> dict[str, Any]:
    p = of["parameters"]

    def body(mass: str, centre: list[float], inertia: str, joint: tuple[str, str, str]) -> dict[str, Any]:
        entries = [p[f"{inertia}_{place}"] for place in ("11", "12", "13", "22", "23", "33")]
        angle, rate, motor = joint
        moving = {"angle": of["angles"][angle], "rate": of["rates"][rate], "torque": of["motors"][motor]}
        return {"mass": p[mass], "centre_of_mass": centre, **tensor(entries), **moving}

    def vector(name: str, axes: str) -> list[float]:
        return [p[f"{name}_{axes}{axis}"] for axis in "xyz"]

    outer = body("m_go", vector("r_goc_go", "go"), "i_go", ("gamma_o", "gamma_o_dot", "u_o"))
    inner = body("m_gi", vector("r_gic_gi", "gi"), "i_gi", ("gamma_i", "gamma_i_dot", "u_i"))
    wheel = body("m_w", [0.0, p["d"], 0.0], "j", ("theta", "spin", "u_w"))
    return {
        "name": f"cmg{number}",
        "kind": "dgvscmg",
        # Stored in the device's axes.
        "position": (np.array(of["mount"]) @ vector("r_go_b", "b")).tolist(),
        "mount": {"dcm": of["mount"]},
        "outer_gimbal": outer,
        "inner_gimbal": inner | {"origin": vector("l_o", "")},
        "wheel": wheel | {"origin": vector("l_i", "")},
    }


def scenario_of(craft: dict[str, Any]) -> precess.Scenario:
    hub = craft["hub"]
    return precess.Scenario(
        format=1,
        hub={"mass": hub["m_b"], "centre_of_mass": hub["r_bc_b"], **tensor(hub["i_b"])},
        initial={"velocity": craft["r_b_n_dot"], "angular_velocity": craft["omega"]},
        device=[device(number, of) for number, of in enumerate(craft["devices"], 1)],
        run={"duration": 1.0},
    )


def compared(craft: dict[str, Any], of: precess.Spacecraft) -> float:
    """Largest share of a block by which accelerations differ from the stored ones."""
    inputs = of.inputs()
    inputs.force, inputs.torque = craft["force"], craft["torque_b"]
    found = of.accelerations(of.initial_state(), inputs)
    expected = craft["pinocchio"]
    joints = np.array([list(row.values()) for row in expected["accelerations"]])
    blocks = [(found.r_ddot, expected["r_b_n_ddot"]), (found.omega_dot, expected["omega_dot"])]
    ours = found.to_array()[6:].reshape(-1, 3)
    blocks += [(ours[:, column], joints[:, column]) for column in range(3)]
    return max(float(np.abs(a - np.asarray(b)).max() / np.abs(b).max()) for a, b in blocks)


def in_python(batch: precess.Batch, steps: int) -> Callable[[], float]:
    """Nanoseconds per step and state."""
    y = batch.states(STATES)
    y[:, 10:13] *= ((1.0 + APART) ** np.arange(STATES))[:, None]
    calls = max(1, TURN // (STATES * steps))

    def turn() -> float:
        start = time.process_time()
        for _ in range(calls):
            batch.run(y, STEP, steps, threads=1)
        return 1e9 * (time.process_time() - start) / (STATES * steps * calls)

    return turn


def in_rust(program: str, file: Path, steps: int) -> Callable[[], float]:
    """The same of the program, less what it takes to start."""
    calls = max(1, TURN // (STATES * steps))

    def spent(count: int) -> float:
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        words = [program, str(file), str(STATES), str(steps), str(count)]
        subprocess.run(words, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)

    def turn() -> float:
        return 1e9 * (spent(calls) - spent(0)) / (STATES * steps * calls)

    return turn


def by_peer(engine: str, file: Path, stack: ExitStack) -> Callable[[], float] | None:
    """A turn of MuJoCo, which keeps to the lines of `tests/peers`; none where it is not there."""
    words = [sys.executable, "-B", str(PEERS), "turns", str(file), engine]
    program = stack.enter_context(
        subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    )
    assert program.stdin is not None and program.stdout is not None and program.stderr is not None
    if not program.stdout.readline():
        print(f"no {engine}: {program.stderr.read().strip().splitlines()[-1]}", file=sys.stderr)
        return None
    requests, answers = program.stdin, program.stdout

    def turn() -> float:
        requests.write("\n")
        requests.flush()
        return float(json.loads(answers.readline())["ns"])

    return turn


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--rust", help="the example `throughput` of precess-lanes")
    parser.add_argument("--turns", type=int, default=11)
    arguments = parser.parse_args()
    craft = stored()
    scenario = scenario_of(craft)
    difference = compared(craft, scenario.spacecraft)
    assert difference < AGREEMENT, difference
    batch = precess.Batch(scenario)
    assert batch.in_lanes
    with tempfile.TemporaryDirectory() as folder, ExitStack() as stack:
        file = Path(folder, "scenario.toml")
        file.write_text(scenario.to_toml(), encoding="utf-8")
        # Where the programs of `tests/peers` expect it.
        Path(folder, "steps").mkdir()
        Path(folder, "4.json").write_text(json.dumps(craft), encoding="utf-8")
        rows: dict[str, Callable[[], float] | None] = {}
        for steps in (STEPS, LONG):
            rows[f"Python, {steps} steps a call"] = in_python(batch, steps)
            if arguments.rust:
                rows[f"Rust, {steps} steps a call"] = in_rust(arguments.rust, file, steps)
        for engine in ("rollout", "mjbatch"):
            name = {"rollout": "`mujoco.rollout`", "mjbatch": "mjbatch"}[engine]
            rows[f"{name}, {STEPS} steps a call"] = by_peer(engine, Path(folder, "steps", "4.json"), stack)
        there = {name: turn for name, turn in rows.items() if turn is not None}
        best = dict.fromkeys(there, float("inf"))
        # Turn by turn, so that what else the machine does meets all alike.
        for _ in range(arguments.turns):
            for name, turn in there.items():
                best[name] = min(best[name], turn())
    print(f"{processor()}, one thread, the least of {arguments.turns} turns, time of the processor")
    print(f"accelerations differ from the stored ones by {difference:.0e} of a block\n")
    print("| | ns per step and state | of Python's |")
    print("|---|---:|---:|")
    for name, ns in best.items():
        own = best[f"Python, {LONG if str(LONG) in name else STEPS} steps a call"]
        print(f"| {name} | {ns:.0f} | {ns / own:.2f} |")


if __name__ == "__main__":
    main()
