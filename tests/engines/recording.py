"""Reads an MCAP file of `precess run` back with the package `mcap`, against the NPZ file of the same run.

    python recording.py           runs the imaging satellite; compares
    python recording.py --check   the same

Each channel has a message for each sample, or for the frames as many as the page says; each column is in one
schema, and its last value is the same double; checksums are right; statistics count the messages. Nothing is stored.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

MISSING = 77
ROOT = Path(__file__).resolve().parent.parent.parent
SCENARIO = ROOT / "scenarios" / "imaging-satellite.toml"
# As docs/scenarios.md has it, and the last sample.
FRAMES_MAX = 1001

try:
    import numpy as np
    import programs
    from mcap.reader import make_reader
except ModuleNotFoundError as error:
    if error.name not in ("mcap", "numpy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="the same: nothing is stored")
    arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        result = recorded(folder)
        npz, channels = np.load(f"{result}.npz"), read(f"{result}.mcap")
        compare(list(npz["columns"]), npz["samples"], channels)


def recorded(folder):
    """Runs the scenario; the path of its results without the ending."""
    run = [programs.folder() / "precess", "run", SCENARIO]
    options = ["--no-report", "--out", folder, "--set", 'output.formats=["mcap", "npz"]']
    subprocess.run([*run, *options], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    return Path(folder) / SCENARIO.stem


def read(path):
    """Of each topic: schema, number of messages, the last one."""
    channels = {}
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True)
        statistics = reader.get_summary().statistics
        for schema, channel, message in reader.iter_messages():
            _, count, _ = channels.get(channel.topic, (None, 0, None))
            found = (json.loads(schema.data), count + 1, json.loads(message.data))
            channels[channel.topic] = found
    counted = sum(count for _, count, _ in channels.values())
    if counted != statistics.message_count:
        sys.exit(f"{counted} messages, {statistics.message_count} in the statistics")
    return channels


def compare(columns, samples, channels):
    seen = 0
    for topic, (schema, count, last) in channels.items():
        titles = {key: of.get("title") for key, of in schema["properties"].items()}
        if not all(title in columns for title in titles.values()):
            continue
        if count != len(samples):
            sys.exit(f"{topic} has {count} messages, the run {len(samples)} samples")
        for key, title in titles.items():
            expected = samples[-1, columns.index(title)]
            if last[key] != expected:
                sys.exit(f"{topic}.{key} ends at {last[key]!r}, {title} at {expected!r}")
            seen += 1
    if seen != len(columns):
        sys.exit(f"{seen} columns in the schemas, {len(columns)} in the run")
    frames = channels["/scene/frames"][1]
    if not 2 <= frames <= FRAMES_MAX:
        sys.exit(f"{frames} messages with frames")
    messages = sum(count for _, count, _ in channels.values())
    print(f"{messages} messages: the last of {seen} columns over {len(samples)} samples, and {frames} of frames")


if __name__ == "__main__":
    main()
