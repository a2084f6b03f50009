"""Do the peers compute the same accelerations? Every one against Pinocchio's default build.

    python agree.py target/peers

Prints the worst deviation of each block, in units of the block's largest magnitude, and leaves
with status 1 if one is above the bound or if nothing could be compared.
"""

import json
import subprocess
import sys
from pathlib import Path

# What the project allows an acceleration in double precision. It holds for every peer on the
# spacecraft that prepare.py chose; MuJoCo would need 1e-8 on any spacecraft (tests/engines).
BOUND = 1e-11

REFERENCE = "Pinocchio, default build"
BLOCKS = {
    "r_b_n_ddot": slice(0, 3), "omega_dot": slice(3, 6), "gamma_o_ddot": slice(6, None, 3),
    "gamma_i_ddot": slice(7, None, 3), "spin_dot": slice(8, None, 3),
}  # fmt: skip


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    listed = json.loads((folder / "peers.json").read_text(encoding="utf-8"))
    peers = {peer["name"]: peer for peer in listed if peer.get("subject") == "evaluation"}
    if REFERENCE not in peers or len(peers) == 1:
        sys.exit(f"nothing to compare: {folder / 'peers.json'} has {', '.join(peers) or 'no peer'}")
    reference = {n: accelerations(peers[REFERENCE], folder, n) for n in cases(peers[REFERENCE])}
    print(f"{'':24}    N  " + " ".join(f"{name:>12}" for name in BLOCKS))
    worst = 0.0
    for name, peer in peers.items():
        for n in (n for n in cases(peer) if name != REFERENCE and n in reference):
            found = deviations(accelerations(peer, folder, n), reference[n])
            print(f"{name:24} {n:4}  " + " ".join(f"{x:12.1e}" for x in found))
            worst = max(worst, *found)
    print(f"worst {worst:.1e} of a block, bound {BOUND:g}")
    sys.exit(0 if worst <= BOUND else 1)


def cases(peer):
    """The numbers of devices that it takes."""
    return [int(case) for case in peer["cases"]]


def accelerations(peer, folder, n):
    words = [*peer["command"], "check", str(folder / f"{n}.json"), *peer["options"]]
    printed = subprocess.run(words, check=True, capture_output=True, text=True).stdout
    return json.loads(printed)["accelerations"]


def deviations(actual, expected):
    """The largest difference of each block; infinite where a number is missing or none."""
    if len(actual) != len(expected):
        return [float("inf")] * len(BLOCKS)

    def deviation(block):
        unit = max(abs(x) for x in expected[block])
        differences = [abs(a - e) / unit for a, e in zip(actual[block], expected[block])]
        return max(x if x == x else float("inf") for x in differences)

    return [deviation(block) for block in BLOCKS.values()]


if __name__ == "__main__":
    main()
