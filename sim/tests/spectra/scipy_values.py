"""SciPy's spectra of a small record of integers, as the arrays of sim/src/spectra/stored.rs.

    python3 scipy_values.py        (NumPy and SciPy; the stored values are of SciPy 1.17.1)
"""

import numpy
import scipy
from scipy import signal

RATE = 12.0
INDEX = numpy.arange(96)
X = ((INDEX * INDEX * 37 + INDEX * 11) % 101 - 50).astype(float)
Y = ((INDEX * INDEX * 53 + INDEX * 29) % 97 - 48 + numpy.roll(X, 2)).astype(float)


def show(name, values):
    print(f"const {name}: [f64; {len(values)}] = [")
    for value in values:
        print(f"    {float(value)!r},")
    print("];")


print(f"// SciPy {scipy.__version__}")
half = {"window": "hann", "nperseg": 32, "noverlap": 16, "detrend": "constant"}
show("HANN", signal.welch(X, RATE, **half)[1])
show("FLAT_TOP", signal.welch(X, RATE, window="flattop", nperseg=32, noverlap=20, detrend="linear")[1])
show("ODD", signal.welch(X, RATE, **(half | {"nperseg": 33}))[1])
show("CROSS_RE", signal.csd(X, Y, RATE, **half)[1].real)
show("CROSS_IM", signal.csd(X, Y, RATE, **half)[1].imag)
show("COHERENCE", signal.coherence(X, Y, RATE, **half)[1])
