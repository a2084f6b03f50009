"""Writes tests/fixtures/filters.json: filters of second order by SciPy.

    python filters.py           designs the filters and filters a signal; writes the file
    python filters.py --check   the same, compared with the stored file; writes nothing

`butter` and `iirnotch` are prewarped at their frequency; `bilinear` with the sampling rate is not, and with
w / (2 tan(w / (2 f))) it is at w. `settled` are SciPy's states of a constant input of one.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import math
import random
import sys
from pathlib import Path

MISSING = 77
FIXTURE = Path(__file__).resolve().parent.parent / "fixtures" / "filters.json"
# Of the largest value, against what it gave before: another version or processor may order its sums anew.
REPRODUCTION = 1e-13
SAMPLES = 60

try:
    import numpy as np
    import scipy
    from fixture import lines
    from scipy import signal
except ModuleNotFoundError as error:
    if error.name not in ("numpy", "scipy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)


def section(b, a):
    """A row of SciPy's second-order sections."""
    return [*b, *[0.0] * (3 - len(b)), *a, *[0.0] * (3 - len(a))]


def analog(numerator, denominator, rate, prewarped):
    """By the bilinear transform; prewarped at a frequency in rad/s, or None."""
    if prewarped is not None:
        rate = prewarped / (2 * math.tan(prewarped / (2 * rate)))
    return section(*signal.bilinear(numerator, denominator, rate))


def cases():
    """Name, what the filter is of, sampling rate in Hz, prewarped frequency in rad/s, sections."""
    for rate in (10.0, 1000.0):
        for share in (0.004, 0.1, 0.45):
            w = 2 * math.pi * share * rate
            for order in (1, 2):
                kind = {"kind": f"butterworth {order}", "cutoff": w}
                by_scipy = signal.butter(order, share * rate, fs=rate, output="sos")
                yield kind, rate, w, by_scipy.tolist()
                b, a = signal.butter(order, w, analog=True)
                yield kind, rate, None, [analog(b, a, rate, None)]
            quality = 3.0
            # The digital half-power bandwidth in terms of the poles' damping.
            turn = 2 * math.pi * share
            poles = math.tan(turn / (2 * quality)) / math.sin(turn)
            kind = {"kind": "notch", "frequency": w, "zeros": 0.0, "poles": poles}
            yield kind, rate, w, [section(*signal.iirnotch(share * rate, quality, fs=rate))]
            for prewarped in (w, None):
                zeros, poles = 0.05, 0.6
                b, a = [1, 2 * zeros * w, w * w], [1, 2 * poles * w, w * w]
                kind = {"kind": "notch", "frequency": w, "zeros": zeros, "poles": poles}
                yield kind, rate, prewarped, [analog(b, a, rate, prewarped)]
                for zero, pole in ((0.3 * w, 1.5 * w), (1.2 * w, 0.2 * w)):
                    kind = {"kind": "lead-lag", "zero": zero, "pole": pole}
                    b, a = [1 / zero, 1], [1 / pole, 1]
                    yield kind, rate, prewarped, [analog(b, a, rate, prewarped)]


def evaluated():
    """The content of the file."""
    chance = random.Random(39)
    inputs = [chance.uniform(-1.0, 1.0) for _ in range(SAMPLES)]
    filters = []
    for kind, rate, prewarped, sections in cases():
        settled = signal.sosfilt_zi(np.array(sections))
        filters.append(
            {
                **kind,
                "rate": rate,
                "prewarped": prewarped,
                "section": sections[0],
                "settled": settled[0].tolist(),
                "output": signal.sosfilt(sections, inputs).tolist(),
            }
        )
    chain = [one["section"] for one in filters[:14:4]]
    return {
        "scipy": scipy.__version__,
        "input": inputs,
        "filters": filters,
        "chain": {"sections": chain, "output": signal.sosfilt(chain, inputs).tolist()},
    }


def numbers(value):
    """All numbers of a document, in order."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return [number for element in value for number in numbers(element)]
    return [value] if isinstance(value, float) else []


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--check", action="store_true", help="compare and write nothing")
    check = arguments.parse_args().check
    found = evaluated()
    if not check:
        FIXTURE.write_text(lines(found) + "\n", encoding="utf-8")
        print(f"wrote {FIXTURE.name}")
        return
    stored = json.loads(FIXTURE.read_text(encoding="utf-8"))
    worst = 0.0
    pairs = [(found["input"], stored["input"]), (found["chain"], stored["chain"])]
    if len(found["filters"]) != len(stored["filters"]):
        sys.exit(f"{FIXTURE.name} has {len(stored['filters'])} filters; run filters.py")
    for new, old in [*pairs, *zip(found["filters"], stored["filters"])]:
        new, old = numbers(new), numbers(old)
        size = max(map(abs, old))
        worst = max([worst, *(abs(a - b) / size for a, b in zip(new, old, strict=True))])
    print(f"scipy {scipy.__version__} against {FIXTURE.name}: worst {worst:.1e}")
    if worst > REPRODUCTION:
        sys.exit(f"more than {REPRODUCTION:g}")


if __name__ == "__main__":
    main()
