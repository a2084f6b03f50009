"""Every block of Python in the pages runs as written, in order, in an empty folder that has the scenarios."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: What pages need beside the package and NumPy.
NEEDS = {
    "README.md": [],
    "docs/clusters.md": ["pyarrow", "pandas"],
    "docs/control.md": [],
    "docs/python.md": [],
    "docs/structure.md": [],
}
#: Excerpts of programs inside Basilisk, whose like tests/engines/effector.py runs.
IN_BASILISK = {"docs/basilisk.md"}
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)


def blocks(page: str) -> list[str]:
    """The blocks of a page."""
    return BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))


def test_every_page_with_blocks_is_run() -> None:
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
    names = [page.relative_to(ROOT).as_posix() for page in pages]
    assert {name for name in names if blocks(name)} - IN_BASILISK <= set(NEEDS)
    assert len(blocks("docs/python.md")) >= 4


@pytest.mark.parametrize("page", NEEDS)
def test_blocks_run_as_written(
    page: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for needed in NEEDS[page]:
        pytest.importorskip(needed)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.chdir(tmp_path)
    shutil.copytree(ROOT / "scenarios", tmp_path / "scenarios")
    names: dict[str, Any] = {"__name__": "__main__"}
    for number, block in enumerate(blocks(page), 1):
        # What the block itself imports and is not installed is no fault of it.
        for needed in re.findall(r"^import (jax|casadi)$", block, re.MULTILINE):
            pytest.importorskip(needed)
        exec(compile(block, f"{page}, block {number}", "exec"), names)
