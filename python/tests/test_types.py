"""Types: the stub of the native module is that of the module, and a type checker takes a program that uses the package."""

from __future__ import annotations

import importlib.util
import runpy
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
SAMPLE = HERE / "typed_sample.py"
#: A wrong use of the package, and what the checker says of it.
WRONG = {
    "precess.Scenario.from_toml(3)\n": "arg-type",
    "precess.Scenario.from_text('').run().omega\n": "attr-defined",
    "precess.Batch(3)\n": "arg-type",
}

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("mypy") is None, reason="mypy is not installed"
)


def checked(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """What mypy says, of the package as it is installed."""
    return subprocess.run(
        [sys.executable, "-m", *arguments], capture_output=True, text=True, cwd=folder
    )


def test_the_stub_has_the_names_and_signatures_of_the_module(tmp_path: Path) -> None:
    found = checked("mypy.stubtest", "precess._native", folder=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_package_is_strict(tmp_path: Path) -> None:
    # Without these, what they decorate and what derives from their classes has no type.
    for module in ("jax", "casadi"):
        pytest.importorskip(module)
    # Its sources: of an installed package, mypy tells nothing.
    cache = f"--cache-dir={tmp_path / 'cache'}"
    found = checked("mypy", "--strict", cache, "-p", "precess", folder=HERE.parent)
    assert found.returncode == 0, found.stdout + found.stderr


def test_a_checker_takes_what_uses_the_package(tmp_path: Path) -> None:
    found = checked("mypy", "--strict", "--no-incremental", str(SAMPLE), folder=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_a_checker_sees_what_is_wrong(tmp_path: Path) -> None:
    for number, (program, code) in enumerate(WRONG.items()):
        path = tmp_path / f"wrong{number}.py"
        path.write_text(f"import precess\n\n{program}")
        found = checked("mypy", "--strict", "--no-incremental", str(path), folder=tmp_path)
        assert found.returncode == 1 and f"[{code}]" in found.stdout, found.stdout


def test_the_sample_runs(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(SAMPLE), run_name="__main__")
    assert "jitter" in capsys.readouterr().out
