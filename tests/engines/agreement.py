"""How far two results differ, block by block: the unit is the largest magnitude of the block."""

import sys


class Worst:
    """The worst difference so far; none may exceed the bound, its own for some blocks."""

    def __init__(self, bound, of_block=None):
        self.bound, self.of_block, self.error = bound, of_block or {}, 0.0

    def take(self, whose, actual, expected):
        for name, error in errors(whose, actual, expected).items():
            bound = self.of_block.get(name, self.bound)
            # A NaN is above every bound.
            if not error <= bound:
                sys.exit(f"{whose}: {name} differs by {error:e} of the block, above {bound:e}")
            self.error = max(self.error, error)


def errors(whose, actual, expected):
    """The largest difference of each block, in units of its largest magnitude."""
    actual, expected = blocks(actual), blocks(expected)
    if actual.keys() != expected.keys():
        sys.exit(f"{whose}: {sorted(actual)} where {sorted(expected)} are expected")

    def error(name, numbers):
        unit = max(abs(x) for x in numbers)
        apart = max(abs(a - e) for a, e in zip(actual[name], numbers, strict=True))
        # Nothing accelerates that is held: zero in both.
        return apart / unit if unit > 0.0 else apart * float("inf") if apart else 0.0

    return {name: error(name, numbers) for name, numbers in expected.items()}


def blocks(result):
    """All numbers of one kind, over all devices and bodies, by the name of the kind."""
    found = {}

    def walk(name, value):
        if isinstance(value, dict):
            for key, inner in value.items():
                walk(key, inner)
        elif isinstance(value, list):
            for inner in value:
                walk(name, inner)
        else:
            found.setdefault(name, []).append(value)

    walk("", result)
    return found
