"""Writes tests/fixtures/loops.json: poles and margins of sampled loops by python-control.

    python loops.py           closes the loops; writes the file
    python loops.py --check   the same, compared with the stored file; writes nothing

A hub turns about one axis, with a balanced wheel, and with a panel on a spring whose centre of mass is on its hinge.
Coordinates theta (hub), phi (panel relative to it), psi (wheel relative to the hub):

    [I Ip J; Ip Ip 0; J 0 J] q'' + [0; c phi'; 0] + [0; k phi; 0] = [0; 0; u]

The law commands a torque tau, so the wheel is to have psi'' = -tau / J; u is what gives that at the sample, and is held from
the delay on. tau = -K theta / 4 - P (omega + K_I z), z = sum T K theta / 4 + I omega, I with the panel.

Exit status: 0 if all is well, 1 if something disagrees, 77 if a package is missing: see
requirements.txt.
"""

import argparse
import json
import math
import sys
from pathlib import Path

MISSING = 77
FIXTURE = Path(__file__).resolve().parent.parent / "fixtures" / "loops.json"
# Of the largest value, against what it gave before.
REPRODUCTION = 1e-9

try:
    import control
    import numpy as np
    from fixture import lines
    from scipy.linalg import expm
except ModuleNotFoundError as error:
    if error.name not in ("control", "numpy", "scipy"):
        raise
    print(error, file=sys.stderr)
    sys.exit(MISSING)

HUB, PANEL, WHEEL = 10.0, 3.0, 0.02
# Across the axis the wheel has 0.01 kg m^2, and so have two others about it.
ACROSS = 0.02
ATTITUDE, RATE, PERIOD = 8.0, 6.0, 0.25
CASES = [
    {"delay": delay, "stiffness": stiffness, "damping": damping, "integral": integral}
    for stiffness, damping in ((0.0, 0.0), (60.0, 0.3), (700.0, 1.0))
    for delay, integral in ((0.0, 0.0), (0.1, 0.0), (0.25, 0.004), (0.6, 0.0))
]


def plant(case):
    """A and B of [theta, phi, theta', phi'] by u, and the servo: u by the state and by tau."""
    inertia = HUB + WHEEL + ACROSS
    if case["stiffness"] == 0.0:
        m = np.array([[inertia, WHEEL], [WHEEL, WHEEL]])
        springs = [(np.zeros((2, 2)), np.zeros((2, 2)))]
    else:
        m = np.array([[inertia + PANEL, PANEL, WHEEL], [PANEL, PANEL, 0], [WHEEL, 0, WHEEL]])
        k, c = np.zeros((3, 3)), np.zeros((3, 3))
        k[1, 1], c[1, 1] = case["stiffness"], case["damping"]
        springs = [(k, c)]
    k, c = springs[0]
    n = len(m) - 1
    inverse = np.linalg.inv(m)
    a = np.zeros((2 * n, 2 * n))
    a[:n, n:] = np.eye(n)
    a[n:, :n] = -(inverse @ k)[:n, :n]
    a[n:, n:] = -(inverse @ c)[:n, :n]
    b = np.zeros((2 * n, 1))
    b[n:, 0] = inverse[:n, n]
    # The wheel's acceleration is prescribed: the others follow, and u is the wheel's row.
    others = np.linalg.inv(m[:n, :n])
    by_state = -m[n, :n] @ others @ np.hstack([k[:n, :n], c[:n, :n]])
    by_tau = -(m[n, n] - m[n, :n] @ others @ m[:n, n]) / WHEEL
    return a, b, by_state.reshape(1, -1), by_tau


def held(a, b, t):
    """State and input after a time."""
    n = len(a)
    both = np.zeros((n + 1, n + 1))
    both[:n, :n], both[:n, n:] = a, b
    both = expm(both * t)
    return both[:n, :n], both[:n, n:]


def closed(case):
    """The loop: L from tau to tau, and the closed loop's poles."""
    a, b, by_state, by_tau = plant(case)
    n = len(a)
    whole = math.floor(case["delay"] / PERIOD + 1e-9)
    rest = max(case["delay"] - whole * PERIOD, 0.0)
    before, older = held(a, b, rest)
    after, newer = held(a, b, PERIOD - rest)
    phi, older = after @ before, after @ older
    # The state, then commands that wait, the newest first.
    size = n + whole + 1
    f, g = np.zeros((size, size)), np.zeros((size, 1))
    f[:n, :n] = phi
    f[:n, n + whole : n + whole + 1] = older
    if whole == 0:
        g[:n] = newer
    else:
        f[:n, n + whole - 1 : n + whole] = newer
    g[n] = 1.0
    for k in range(1, whole + 1):
        f[n + k, n + k - 1] = 1.0
    f[:, :n] += g @ by_state
    measured = np.zeros((2, size))
    measured[0, 0], measured[1, n // 2] = 1.0, 1.0
    spacecraft = control.ss(f, g * by_tau, measured, np.zeros((2, 1)), dt=PERIOD)
    gain = case["integral"]
    inertia = HUB + WHEEL + ACROSS + (PANEL if case["stiffness"] else 0.0)
    step = ATTITUDE / 4 * PERIOD
    d = np.array([[ATTITUDE / 4 + RATE * gain * step, RATE * (1 + gain * inertia)]])
    if gain == 0.0:
        law = control.ss([], [], [], d, dt=PERIOD)
    else:
        law = control.ss([[1.0]], [[step, 0.0]], [[RATE * gain]], d, dt=PERIOD)
    opened = law * spacecraft
    return opened, control.feedback(opened, 1, sign=-1).poles()


def evaluated():
    """The content of the file."""
    cases = []
    for case in CASES:
        opened, poles = closed(case)
        stable = bool(max(abs(poles)) < 1.0)
        # Real part, then imaginary part, of those that are not over within a sample.
        kept = [pole for pole in poles if abs(pole) > 1e-3 and pole.imag >= -1e-12]
        kept.sort(key=lambda pole: (round(abs(pole), 9), round(pole.real, 9)))
        entry = {
            **case,
            "stable": stable,
            "poles": [[float(pole.real), abs(float(pole.imag))] for pole in kept],
        }
        if stable:
            gain, phase, _, at_gain, at_phase, _ = control.stability_margins(
                opened, returnall=True, method="poly"
            )
            up = [(g, w) for g, w in zip(gain, at_gain) if g > 1.0 and w > 0.0]
            entry["gain_up"] = [float(x) for x in min(up)] if up else None
            turns = [(min(abs(p) % 360, 360 - abs(p) % 360), w) for p, w in zip(phase, at_phase)]
            entry["phase"] = [float(x) for x in min(turns)] if turns else None
        cases.append(entry)
    return {"control": control.__version__, "cases": cases}


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
    if len(found["cases"]) != len(stored["cases"]):
        sys.exit(f"{FIXTURE.name} has {len(stored['cases'])} loops; run loops.py")
    worst = 0.0
    for new, old in zip(found["cases"], stored["cases"], strict=True):
        new, old = numbers(new["poles"]), numbers(old["poles"])
        worst = max([worst, *(abs(a - b) for a, b in zip(new, old, strict=True))])
    print(f"python-control {control.__version__} against {FIXTURE.name}: worst pole {worst:.1e}")
    if worst > REPRODUCTION:
        sys.exit(f"more than {REPRODUCTION:g}")


if __name__ == "__main__":
    main()
