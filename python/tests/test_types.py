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


@pytest.fixture(scope="module")
def cache(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Option of mypy: what one run has read of NumPy, the next does not read again."""
    return f"--cache-dir={tmp_path_factory.mktemp('mypy')}"


def test_the_stub_has_the_names_and_signatures_of_the_module(tmp_path: Path) -> None:
    found = checked("mypy.stubtest", "precess._native", folder=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_the_package_is_strict(cache: str) -> None:
    # Without these, what they decorate and what derives from their classes has no type.
    for module in ("jax", "casadi"):
        pytest.importorskip(module)
    # Its sources: of an installed package, mypy tells nothing.
    found = checked("mypy", "--strict", cache, "-p", "precess", folder=HERE.parent)
    assert found.returncode == 0, found.stdout + found.stderr


def test_a_checker_takes_what_uses_the_package(cache: str, tmp_path: Path) -> None:
    found = checked("mypy", "--strict", cache, str(SAMPLE), folder=tmp_path)
    assert found.returncode == 0, found.stdout + found.stderr


def test_a_checker_sees_what_is_wrong(cache: str, tmp_path: Path) -> None:
    for number, program in enumerate(WRONG):
        (tmp_path / f"wrong{number}.py").write_text(f"import precess\n\n{program}")
    names = [f"wrong{number}.py" for number in range(len(WRONG))]
    found = checked("mypy", "--strict", cache, *names, folder=tmp_path)
    assert found.returncode == 1, found.stdout
    for name, code in zip(names, WRONG.values(), strict=True):
        lines = [line for line in found.stdout.splitlines() if line.startswith(f"{name}:")]
        assert any(f"[{code}]" in line for line in lines), found.stdout


def test_the_sample_runs(capsys: pytest.CaptureFixture[str]) -> None:
    runpy.run_path(str(SAMPLE), run_name="__main__")
    assert "jitter" in capsys.readouterr().out
