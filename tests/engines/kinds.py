"""Writes tests/fixtures/kinds.json: random spacecraft with devices of every kind, springs, wrenches
and modes, as two engines see them.

    python kinds.py                  evaluates all spacecraft in both engines; writes if they agree
    python kinds.py --check          the same, compared with the stored file; writes nothing
    python kinds.py --more N PATH    N more spacecraft; writes them to PATH, whatever they differ

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import sys
from pathlib import Path

MISSING = 77
FIXTURE = Path(__file__).resolve().parent.parent / "fixtures" / "kinds.json"

try:
    import chains_with_mujoco
    import chains_with_pinocchio
    from agreement import Worst
    from chains import all_spacecraft, all_stops, more_spacecraft
    from fixture import lines
except ModuleNotFoundError as error:
    if error.name not in ("mujoco", "numpy", "pinocchio"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

# The engines against each other, in units of each block's largest magnitude. MuJoCo refers every
# body to the centre of mass of the spacecraft, where a fast wheel far from it costs digits; whose
# rounding it is, the suite measures in double-double.
AGREEMENT = 1e-8

# An engine against what it gave before: another version or processor may order its sums anew, which
# makes as large a difference as its rounding.
REPRODUCTION = {"pinocchio": 1e-11, "mujoco": AGREEMENT}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    instead = arguments.add_mutually_exclusive_group()
    instead.add_argument("--check", action="store_true", help="compare and write nothing")
    instead.add_argument("--more", nargs=2, metavar=("N", "PATH"), help="write N more to PATH")
    given = arguments.parse_args()
    if given.more:
        count, path = int(given.more[0]), Path(given.more[1])
        found, disagreement = evaluated(more_spacecraft(count), Worst(float("inf")))
        path.write_text(lines(found) + "\n", encoding="utf-8")
        print(f"{count} more: engines differ by {disagreement:.1e} of the block; wrote {path}")
        return

    found, disagreement = evaluated(all_spacecraft(), Worst(AGREEMENT))
    found["stops"] = [
        {**craft, "pinocchio": chains_with_pinocchio.stopped(craft)} for craft in all_stops()
    ]
    versions = " against ".join(f"{name} {version}" for name, version in found["engines"].items())
    print(f"{versions}: worst {disagreement:.1e} of the block")
    if not given.check:
        FIXTURE.write_text(lines(found) + "\n", encoding="utf-8")
        print(f"wrote {FIXTURE.name}")
        return
    if not FIXTURE.exists():
        sys.exit(f"{FIXTURE} is missing; run kinds.py")
    difference = compared(found, json.loads(FIXTURE.read_text(encoding="utf-8")))
    print(f"against {FIXTURE.name}: worst {difference:.1e} of the block")


def evaluated(spacecraft, worst):
    """The whole content of the file, and the engines' worst disagreement."""
    found = []
    for craft in spacecraft:
        pinocchio = chains_with_pinocchio.evaluate(craft)
        mujoco = chains_with_mujoco.evaluate(craft)
        alike = {key: pinocchio[key] for key in mujoco}
        worst.take(f"{craft['name']}, mujoco against pinocchio", mujoco, alike)
        found.append({**craft, "pinocchio": pinocchio, "mujoco": mujoco})
    engines = {
        "pinocchio": chains_with_pinocchio.VERSION,
        "mujoco": chains_with_mujoco.VERSION,
    }
    return {"engines": engines, "spacecraft": found, "stops": []}, worst.error


def compared(found, stored):
    """The worst difference from the stored file: inputs must be the same numbers."""
    bounds = {engine: Worst(bound) for engine, bound in REPRODUCTION.items()}
    ours, theirs = ([*file["spacecraft"], *file.get("stops", [])] for file in (found, stored))
    if len(ours) != len(theirs):
        sys.exit(f"{FIXTURE.name} has {len(theirs)} spacecraft; run kinds.py")
    for new, old in zip(ours, theirs):
        if inputs(new) != inputs(old):
            sys.exit(f"{old['name']}: the stored inputs are not those of its seed; run kinds.py")
        for engine in REPRODUCTION.keys() & old.keys():
            whose = f"{old['name']}, {engine} against the file"
            bounds[engine].take(whose, new[engine], old[engine])
    return max(worst.error for worst in bounds.values())


def inputs(craft):
    return {key: value for key, value in craft.items() if key not in REPRODUCTION}


if __name__ == "__main__":
    main()
