"""Writes tests/fixtures/engines.json: random spacecraft as two engines see them.

    python store.py           evaluates all spacecraft in both engines; writes if they agree
    python store.py --check   the same, compared with the stored file; writes nothing
    python store.py --more N  N more spacecraft: how far the engines disagree; writes nothing

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import sys
from pathlib import Path

MISSING = 77
HERE = Path(__file__).resolve().parent
FIXTURE = HERE.parent / "fixtures" / "engines.json"

try:
    import with_mujoco
    import with_pinocchio
    from agreement import Worst, errors
    from fixture import lines
    from spacecraft import all_spacecraft, more_spacecraft
except ModuleNotFoundError as error:
    if error.name not in ("mujoco", "numpy", "pinocchio"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

# The engines against each other, in units of each block's largest magnitude: what the project
# allows an acceleration in double precision (a light body moved by a heavy one loses four of
# sixteen digits).
AGREEMENT = 1e-11

# The same for velocities and accelerations of bodies seen from B. MuJoCo refers them to the
# spacecraft's centre of mass: 1e6 m/s^2 of a fast wheel metres away from it cancel, rounded, to
# leave the 10 m/s^2 of a slow gimbal. Pinocchio, which is stored, refers them to each joint.
SEEN_FROM_B = {"r_prime": 1e-10, "r_dprime": 1e-10}

# An engine against what it gave before, same unit and size: another version or processor may
# order its sums anew.
REPRODUCTION = 1e-11

ACCELERATIONS = ("r_b_n_ddot", "omega_dot", "gamma_o_ddot", "gamma_i_ddot", "spin_dot")
STORED_OF_MUJOCO = ("r_b_n_ddot", "omega_dot", "accelerations", "energy")


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    instead = arguments.add_mutually_exclusive_group()
    instead.add_argument("--check", action="store_true", help="compare and write nothing")
    instead.add_argument("--more", type=int, metavar="N", help="judge N more and write nothing")
    given = arguments.parse_args()
    if given.more is not None:
        if given.more < 1:
            arguments.error(f"--more {given.more}: at least 1")
        return judge_more(given.more)
    check = given.check

    found, disagreement = evaluated()
    versions = " against ".join(f"{name} {version}" for name, version in found["engines"].items())
    print(f"{versions}: worst {disagreement:.1e} of the block")
    if check:
        if not FIXTURE.exists():
            sys.exit(f"{FIXTURE} is missing; run store.py")
        difference = compared(found, json.loads(FIXTURE.read_text(encoding="utf-8")))
        print(f"against {FIXTURE.name}: worst {difference:.1e} of the block")
    else:
        FIXTURE.write_text(lines(found) + "\n", encoding="utf-8")
        print(f"wrote {FIXTURE.name}")


def evaluated():
    """The whole content of the file, and the engines' worst disagreement."""
    spacecraft, disagreement = [], Worst(AGREEMENT, SEEN_FROM_B)
    for craft in all_spacecraft():
        pinocchio, mujoco = with_pinocchio.evaluate(craft), with_mujoco.evaluate(craft)
        disagreement.take(f"{craft['name']}, mujoco against pinocchio", mujoco, pinocchio)
        kept = {key: mujoco[key] for key in STORED_OF_MUJOCO}
        spacecraft.append({**craft, "pinocchio": pinocchio, "mujoco": kept})
    engines = {"pinocchio": with_pinocchio.VERSION, "mujoco": with_mujoco.VERSION}
    return {"engines": engines, "spacecraft": spacecraft}, disagreement.error


def judge_more(number):
    """Prints how often and how far the engines' accelerations disagree on as many more."""
    disagreements = []
    for craft in more_spacecraft(number):
        pinocchio, mujoco = with_pinocchio.evaluate(craft), with_mujoco.evaluate(craft)
        found = errors(craft["name"], mujoco, pinocchio)
        disagreements.append(max(found[block] for block in ACCELERATIONS))
    above = sum(not error <= AGREEMENT for error in disagreements)
    print(
        f"{number} more spacecraft: accelerations disagree by more than {AGREEMENT:g} of the block "
        f"on {above}, worst {max(disagreements):.1e}"
    )


def compared(found, stored):
    """The worst difference from the stored file: inputs must be the same numbers."""
    worst = Worst(REPRODUCTION)
    if len(found["spacecraft"]) != len(stored["spacecraft"]):
        sys.exit(f"{FIXTURE.name} has {len(stored['spacecraft'])} spacecraft; run store.py")
    for new, old in zip(found["spacecraft"], stored["spacecraft"]):
        if inputs(new) != inputs(old):
            sys.exit(f"{old['name']}: the stored inputs are not those of its seed; run store.py")
        for engine in ("pinocchio", "mujoco"):
            worst.take(f"{old['name']}, {engine} against the file", new[engine], old[engine])
    return worst.error


def inputs(craft):
    return {key: value for key, value in craft.items() if key not in ("pinocchio", "mujoco")}


if __name__ == "__main__":
    main()
