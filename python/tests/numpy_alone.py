"""Run by test_numpy_alone in an environment that has only NumPy and the package: imports every module, runs blocks.

Reads blocks of a page from the standard input, as JSON; writes what needs another package to the standard output.
"""

from __future__ import annotations

import importlib
import json
import pkgutil
import sys
from typing import Any

import precess


def main() -> None:
    missing: dict[str, str | None] = {}
    for module in pkgutil.walk_packages(precess.__path__, "precess."):
        try:
            importlib.import_module(module.name)
        except ModuleNotFoundError as error:
            missing[module.name] = error.name
    names: dict[str, Any] = {"__name__": "__main__"}
    for number, block in enumerate(json.load(sys.stdin), 1):
        exec(compile(block, f"block {number}", "exec"), names)
    print()
    print(json.dumps(missing))


if __name__ == "__main__":
    main()
