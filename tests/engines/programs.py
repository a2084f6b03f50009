"""The workspace's programs that scripts run: those that the tests have built, or built by cargo."""

import os
import subprocess
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
# What `cargo xtask test` names: the command `precess`, beside which lies all else that it has built.
VARIABLE = "PRECESS_COMMAND"


@cache
def folder():
    """The folder of `precess`, `precess-bake` and the engine's library, which are built."""
    if VARIABLE in os.environ:
        return Path(os.environ[VARIABLE]).parent
    cargo = os.environ.get("CARGO", "cargo")
    build = [cargo, "build", "--quiet", "-p", "precess", "-p", "precess-bake", "-p", "precess-fmu", "--bins", "--lib"]
    subprocess.run(build, cwd=ROOT, check=True)
    target = os.environ.get("CARGO_TARGET_DIR", ROOT / "target")
    return Path(target) / "debug"
