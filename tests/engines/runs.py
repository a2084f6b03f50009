"""The command line of a script that stores a run of Basilisk: run, compare or write; no engine.

A run is stored with the spacecraft, and the states at the start and after every so many steps.
"""

import argparse
import json
import sys
from pathlib import Path

from fixture import lines

MISSING = 77
FIXTURES = Path(__file__).resolve().parent.parent / "fixtures"

# Basilisk against what it gave before, of the block's largest magnitude: another processor may order its
# sums anew, and a run adds up what it rounds.
REPRODUCTION = 1e-12


def main(doc, name, craft, basilisk):
    """`NAME.json` of the spacecraft; `basilisk` has `VERSION`, `samples` and `Run.states`."""
    arguments = argparse.ArgumentParser(description=doc.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    fixture = FIXTURES / f"{name}.json"
    found = {"basilisk": basilisk.VERSION, **craft, "samples": basilisk.samples(craft)}
    print(f"basilisk {basilisk.VERSION}: {craft['steps']} steps of {craft['step']} s")
    if not check:
        fixture.write_text(lines(found) + "\n", encoding="utf-8")
        print(f"wrote {fixture.name}")
        return
    if not fixture.exists():
        sys.exit(f"{fixture} is missing; run {name}.py")
    stored = json.loads(fixture.read_text(encoding="utf-8"))
    if any(found[key] != stored.get(key) for key in craft):
        sys.exit(f"{fixture.name} has another spacecraft; run {name}.py")
    if [sample["steps"] for sample in found["samples"]] != [s["steps"] for s in stored["samples"]]:
        sys.exit(f"{fixture.name} has other samples; run {name}.py")
    block, error = worst(found["samples"], stored["samples"], basilisk.Run.states)
    print(f"against {fixture.name}: worst {error:.1e} of the block, {block}")
    # A NaN is above every bound.
    if not error <= REPRODUCTION:
        sys.exit(f"{block} differs by {error:e} of the block, above {REPRODUCTION:g}")


def mounted(device):
    """The device with its mount, from a quaternion of whole numbers: the same doubles on every machine."""
    mount = rotation(*device["quaternion"])
    kept = {key: value for key, value in device.items() if key != "quaternion"}
    return {"mount": mount, **kept}


def rotation(a, b, c, d):
    square = a * a + b * b + c * c + d * d
    rows = [
        [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
        [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
        [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
    ]
    return [[entry / square for entry in row] for row in rows]


def worst(found, stored, blocks):
    """The block with the largest difference in units of its largest magnitude, and that difference."""

    def error(name):
        pairs = [(x, y) for a, b in zip(found, stored) for x, y in zip(a[name], b[name], strict=True)]
        return max(abs(x - y) for x, y in pairs) / max(abs(y) for _, y in pairs)

    return max(((name, error(name)) for name in blocks), key=lambda pair: pair[1])
