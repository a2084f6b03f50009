"""Small op4 files, a Craig-Bampton model and its responses, by pyYeti.

    pip install pyyeti
    python tests/engines/structures.py          # writes sim/tests/structure/files
    python tests/engines/structures.py --check  # computes again and compares; writes nothing

The structure is a free beam of ten elements along x (bending in y and z, axial, torsion: six coordinates at
each of eleven grids), written out below. pyYeti reduces it (Craig and Bampton; boundary: both ends), writes
the matrices in every form of op4 that it knows, reads them back, and solves for frequency responses.
"""

import json
import sys
import tempfile
from pathlib import Path

try:
    import numpy as np
    import scipy.linalg as la
    import pyyeti
    from pyyeti import ode
    from pyyeti.nastran import op4
except ImportError as missing:
    print(f"{missing}; install with `pip install pyyeti`", file=sys.stderr)
    sys.exit(77)

FOLDER = Path(__file__).resolve().parents[2] / "sim" / "tests" / "structure" / "files"
LENGTH, GRIDS = 2.0, 11
EA, GJ, EIY, EIZ = 2.0e6, 3.0e3, 4.0e3, 7.0e3
RHO_A, RHO_J = 1.5, 0.004
# Modes of the fixed interface that are kept, damping ratio of every mode.
KEPT, DAMPING = 8, 0.01
FREQUENCIES = [0.5, 3.0, 11.0, 40.0, 90.0]


def element(length):
    """Stiffness and consistent mass of a beam element along x: x y z rx ry rz at both ends."""
    k, m = np.zeros((12, 12)), np.zeros((12, 12))

    def add(matrix, places, values):
        for i, row in enumerate(places):
            for j, column in enumerate(places):
                matrix[row, column] += values[i][j]

    l = length
    rod, rod_mass = [[1, -1], [-1, 1]], [[2, 1], [1, 2]]
    add(k, [0, 6], np.array(rod) * EA / l)
    add(m, [0, 6], np.array(rod_mass) * RHO_A * l / 6)
    add(k, [3, 9], np.array(rod) * GJ / l)
    add(m, [3, 9], np.array(rod_mass) * RHO_J * l / 6)
    for places, stiffness, s in ([1, 5, 7, 11], EIZ, 1.0), ([2, 4, 8, 10], EIY, -1.0):
        turn = np.diag([1, s, 1, s])
        bending = np.array(
            [
                [12, 6 * l, -12, 6 * l],
                [6 * l, 4 * l * l, -6 * l, 2 * l * l],
                [-12, -6 * l, 12, -6 * l],
                [6 * l, 2 * l * l, -6 * l, 4 * l * l],
            ]
        )
        inertial = np.array(
            [
                [156, 22 * l, 54, -13 * l],
                [22 * l, 4 * l * l, 13 * l, -3 * l * l],
                [54, 13 * l, 156, -22 * l],
                [-13 * l, -3 * l * l, -22 * l, 4 * l * l],
            ]
        )
        add(k, places, turn @ bending @ turn * stiffness / l**3)
        add(m, places, turn @ inertial @ turn * RHO_A * l / 420)
    return k, m


def beam():
    size = 6 * GRIDS
    k, m = np.zeros((size, size)), np.zeros((size, size))
    ke, me = element(LENGTH / (GRIDS - 1))
    for grid in range(GRIDS - 1):
        part = slice(6 * grid, 6 * grid + 12)
        k[part, part] += ke
        m[part, part] += me
    return k, m


def craig_bampton(k, m):
    """Boundary first (both ends), then the modes of the fixed interface."""
    ends = np.r_[0:6, 6 * (GRIDS - 1) : 6 * GRIDS]
    inner = np.setdiff1d(np.arange(6 * GRIDS), ends)
    constraint = -la.solve(k[np.ix_(inner, inner)], k[np.ix_(inner, ends)])
    _, fixed = la.eigh(k[np.ix_(inner, inner)], m[np.ix_(inner, inner)])
    fixed = fixed[:, :KEPT]
    turn = np.zeros((6 * GRIDS, 12 + KEPT))
    turn[ends, :12] = np.eye(12)
    turn[np.ix_(inner, np.arange(12))] = constraint
    turn[np.ix_(inner, np.arange(12, 12 + KEPT))] = fixed
    symmetric = lambda a: 0.5 * (a + a.T)
    return symmetric(turn.T @ k @ turn), symmetric(turn.T @ m @ turn)


def responses(values, vectors):
    """Accelerance of both ends, by pyYeti's solver in the frequency domain, real and imaginary parts."""
    solver = ode.SolveUnc(
        np.ones(len(values)),
        2 * DAMPING * np.sqrt(np.maximum(values, 0)),
        np.where(np.arange(len(values)) < 6, 0.0, values),
        rb=np.arange(6),
    )
    frequencies = np.array(FREQUENCIES)
    columns = []
    for force in range(12):
        modal = vectors[force, :][:, None] * np.ones(len(frequencies))
        columns.append(vectors[:12] @ solver.fsolve(modal, frequencies).a)
    # Frequency, row, column.
    return np.transpose(np.array(columns), (2, 1, 0))


def matrices():
    """Matrices that show every part of the format: gaps, single rows, complex and empty columns."""
    rng = np.random.default_rng(42)
    real = np.zeros((9, 5))
    real[2:5, 0] = rng.normal(size=3)
    real[[0, 3, 8], 2] = [1e-30, -2.5e20, 3.0]
    real[7, 3] = np.pi
    square = rng.normal(size=(4, 4))
    return {
        "rect": real,
        "cplx": real[:, :4] + 1j * np.roll(real[:, :4], 1, axis=0),
        "sym": square + square.T,
        "none": np.zeros((3, 2)),
    }


def files():
    """Every file as (name, bytes), and the values that pyYeti reads back."""
    k, m = beam()
    kcb, mcb = craig_bampton(k, m)
    values, vectors = la.eigh(kcb, mcb)
    found, stored = {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for sparse in ("dense", "nonbigmat", "bigmat"):
            for form, options in {
                "ascii": {"binary": False, "digits": 16},
                "little": {"binary": True, "endian": "<"},
                "big": {"binary": True, "endian": ">"},
            }.items():
                name = f"{sparse}-{form}.op4"
                path = Path(folder) / name
                op4.write(str(path), matrices(), sparse=sparse, **options)
                found[name] = path.read_bytes()
                read = op4.read(str(path), sparse=False)
                stored[name] = {
                    key: {
                        "shape": list(value.shape),
                        "real": np.real(value).ravel().tolist(),
                        "imaginary": np.imag(value).ravel().tolist(),
                    }
                    for key, value in read.items()
                }
        for name, content in {
            "craig-bampton.op4": {"kxx": kcb, "mxx": mcb},
            "modes.op4": {"phg": vectors[:12], "lama": values[:, None]},
        }.items():
            path = Path(folder) / name
            op4.write(str(path), content, binary=True, endian="<")
            found[name] = path.read_bytes()
    whole = la.eigh(k, m, eigvals_only=True)
    accelerance = responses(values, vectors)
    model = {
        "pyyeti": pyyeti.__version__,
        "eigenvalues": values.tolist(),
        "eigenvalues_of_the_whole": whole[:14].tolist(),
        "mass": RHO_A * LENGTH,
        "damping": DAMPING,
        "frequencies_hz": FREQUENCIES,
        "accelerance_real": accelerance.real.ravel().tolist(),
        "accelerance_imaginary": accelerance.imag.ravel().tolist(),
    }
    found["read.json"] = (json.dumps(stored) + "\n").encode()
    found["model.json"] = (json.dumps(model, indent=1) + "\n").encode()
    return found


def main():
    found = files()
    if "--check" not in sys.argv[1:]:
        FOLDER.mkdir(parents=True, exist_ok=True)
        for name, content in found.items():
            (FOLDER / name).write_bytes(content)
        return 0
    stale = []
    for name, content in found.items():
        path = FOLDER / name
        if not path.exists():
            stale.append(f"{name} is missing")
        elif name == "model.json":
            # Eigenvalues and responses depend on the machine's LAPACK by rounding; the six of rigid motion
            # are rounding throughout.
            old, new = json.loads(path.read_text()), json.loads(content)
            for key in ("eigenvalues", "accelerance_real", "accelerance_imaginary"):
                a, b = np.array(old[key]), np.array(new[key])
                if np.abs(a - b).max() > 1e-9 * np.abs(a).max():
                    stale.append(f"{key} of {name} differ")
        elif name.endswith(".json") and json.loads(path.read_text()) != json.loads(content):
            stale.append(f"{name} differs")
        elif name.startswith(("dense", "nonbigmat", "bigmat")) and path.read_bytes() != content:
            stale.append(f"{name} differs")
    for line in stale:
        print(line, file=sys.stderr)
    return 1 if stale else 0


if __name__ == "__main__":
    sys.exit(main())
