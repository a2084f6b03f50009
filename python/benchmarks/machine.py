"""The machine that a benchmark runs on."""

from __future__ import annotations

import platform
import sys
from pathlib import Path


def processor() -> str:
    """Its name."""
    if sys.platform == "linux":
        text = Path("/proc/cpuinfo").read_text()
        names = [line.split(":")[1].strip() for line in text.splitlines() if "model name" in line]
        if names:
            return names[0]
    return platform.processor() or platform.machine()
