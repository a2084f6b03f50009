"""NumPy is the one package that is needed: an environment that has only it imports and runs what names no other."""

from __future__ import annotations

import importlib.util
import json
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path

import numpy as np
import pytest

import precess

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
#: Modules for other packages, and the package that each names where it is missing.
NEED_OTHERS = {
    "precess.campaign.cluster": {"cloudpickle", "distributed"},
    "precess.campaign.report": {"pyarrow"},
    "precess.campaign.store": {"pyarrow"},
    "precess.casadi": {"casadi"},
    "precess.jax": {"jax"},
}
BLOCK = re.compile(r"^```python\n(.*?)^```$", re.DOTALL | re.MULTILINE)
IMPORTED = re.compile(r"^(?:import|from) (\w+)", re.MULTILINE)


def environment(folder: Path) -> Path:
    """The interpreter of an environment with NumPy and the package, those of this one, and nothing else."""
    venv.create(folder, with_pip=False, symlinks=sys.platform != "win32")
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    program = "import sysconfig; print(sysconfig.get_path('purelib'))"
    printed = subprocess.run([python, "-I", "-c", program], check=True, capture_output=True, text=True)
    packages = Path(printed.stdout.strip())
    for module in (np, precess):
        assert module.__file__ is not None
        found = Path(module.__file__).parent
        for part in (found, found.with_name(f"{found.name}.libs")):
            if part.is_dir():
                shutil.copytree(part, packages / part.name)
    return python


def blocks_for_numpy(page: str) -> list[str]:
    """The blocks of a page that import no other package."""
    known = {"numpy", "precess", *sys.stdlib_module_names}
    blocks = BLOCK.findall((ROOT / page).read_text(encoding="utf-8"))
    return [block for block in blocks if set(IMPORTED.findall(block)) <= known]


def test_an_environment_with_only_numpy_has_every_module_and_every_block(tmp_path: Path) -> None:
    python = environment(tmp_path / "environment")
    for other in ("pyarrow", "scipy", "pandas", "pytest"):
        found = subprocess.run([python, "-I", "-c", f"import {other}"], capture_output=True)
        assert found.returncode != 0, f"{other} is there"
    shutil.copytree(ROOT / "scenarios", tmp_path / "scenarios")
    blocks = blocks_for_numpy("docs/python.md")
    assert len(blocks) >= 5
    ran = subprocess.run(
        [python, "-I", HERE / "numpy_alone.py"],
        input=json.dumps(blocks),
        capture_output=True,
        text=True,
        cwd=tmp_path,
    )
    assert ran.returncode == 0, ran.stderr
    missing = json.loads(ran.stdout.splitlines()[-1])
    assert missing.keys() == NEED_OTHERS.keys()
    for module, package in missing.items():
        assert package in NEED_OTHERS[module], f"{module} does not say what it needs but {package}"


def test_public_modules_need_no_other_package() -> None:
    """Those of ``precess.__all__``, which are imported where they are first used."""
    public = {f"precess.{name}" for name in precess.__all__}
    assert not public & NEED_OTHERS.keys()
    for name in ("campaign", "montecarlo", "sweep"):
        assert importlib.util.find_spec(f"precess.{name}") is not None and name in precess.__all__


@pytest.mark.parametrize("module", ["montecarlo", "sweep"])
def test_what_is_missing_is_not_what_an_import_asks_for(module: str) -> None:
    program = f"import precess.{module}, sys; print(sorted(set(sys.modules) & {{'pyarrow', 'scipy'}}))"
    ran = subprocess.run([sys.executable, "-I", "-c", program], capture_output=True, text=True)
    assert (ran.returncode, ran.stdout) == (0, "[]\n"), ran.stderr
