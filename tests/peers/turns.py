"""The three commands of every runner in Python: `check FILE`, `time FILE`, `turns FILE`.

What is timed has `check()`, `run(calls)`, `units` (evaluations or steps in a call), and `least_batch`. Times are
those of the processor in all threads of the process: a batch of these programs is longer than the scheduler's
slice, so on a core that others use too the clock on the wall would count their time in every batch.
"""

import json
import statistics
import sys
import time

# As of the native runners and of Precess.
TURN = 0.05
REPEATS = 21


def answer(open_file):
    """Opens the file of the command line and does what it says."""
    words = sys.argv[1:]
    if len(words) < 2 or words[0] not in ("check", "time", "turns"):
        sys.exit(f"usage: {sys.argv[0]} check|time|turns FILE")
    timed = open_file(*words[1:])
    if words[0] == "check":
        say(timed.check())
        return
    calls = 1
    while batch(timed, calls) < timed.least_batch:
        calls *= 2
    if words[0] == "time":
        say({"ns": [turn(timed, calls) for _ in range(REPEATS)]})
        return
    say({"ready": True})
    for _ in sys.stdin:
        say({"ns": turn(timed, calls)})


def turn(timed, calls):
    """Nanoseconds per evaluation or step: the median of as many batches as a turn has time for."""
    start, batches = time.perf_counter(), []
    while not batches or time.perf_counter() - start < TURN:
        batches.append(batch(timed, calls))
    return 1e9 * statistics.median(batches) / (calls * timed.units)


def batch(timed, calls):
    """Seconds of the processor in so many calls."""
    start = time.process_time()
    timed.run(calls)
    return time.process_time() - start


def say(line):
    print(json.dumps(line), flush=True)
