"""Writes tests/fixtures/lumped.json: the wheels of wheels.py with their imbalance lumped, and friction.

    python lumped.py           runs it in Basilisk; writes its states
    python lumped.py --check   the same, compared with the stored file; writes nothing

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import sys

import runs
import wheels
from runs import mounted

# Viscous friction, N m s: at these rates of the size of the motors' torques.
VISCOUS = [3e-4, 2e-4, 5e-4]


def main():
    try:
        import lumped_with_basilisk
    except ModuleNotFoundError as error:
        if error.name not in ("Basilisk", "numpy"):
            raise
        print(error, file=sys.stderr)
        sys.exit(runs.MISSING)
    own = [
        {**mounted(wheel), "viscous": viscous}
        for wheel, viscous in zip(wheels.CRAFT["wheels"], VISCOUS)
    ]
    craft = {**wheels.CRAFT, "lumped": True, "wheels": own}
    runs.main(__doc__, "lumped", craft, lumped_with_basilisk)


if __name__ == "__main__":
    main()
