"""Notebooks are committed without outputs, and run to their end."""

from __future__ import annotations

import base64
import os
import shutil
from pathlib import Path

import pytest

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

FOLDER = Path(__file__).parents[1] / "notebooks"
#: What each needs beside the package and matplotlib.
NEEDS = {"campaign": ["pyarrow", "pandas"], "identification": ["pandas"]}
#: Programs that one starts.
STARTS = {"own-device": "cargo"}
#: Seconds of a cell: one compiles the derivation, two minutes of a core.
LONGEST = 900

NOTEBOOKS = sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def test_there_are_notebooks() -> None:
    known = {"campaign", "identification", "jitter-budget", "own-device", "sensitivities", "table-1"}
    assert known <= set(NOTEBOOKS)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_has_no_outputs(name: str) -> None:
    notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    nbformat.validate(notebook)
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(not cell.outputs and cell.execution_count is None for cell in code)


@pytest.mark.parametrize("name", NOTEBOOKS)
def test_a_notebook_runs(name: str) -> None:
    pytest.importorskip("matplotlib")
    for needed in NEEDS.get(name, []):
        pytest.importorskip(needed)
    if name in STARTS and shutil.which(STARTS[name]) is None:
        pytest.skip(f"no {STARTS[name]}")
    notebook = nbformat.read(FOLDER / f"{name}.ipynb", as_version=4)
    client = nbclient.NotebookClient(
        notebook, timeout=LONGEST, resources={"metadata": {"path": str(FOLDER)}}
    )
    client.execute()
    figures = [
        base64.b64decode(output["data"]["image/png"])
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert figures
    # A folder to look at the figures in.
    if folder := os.environ.get("PRECESS_NOTEBOOK_FIGURES"):
        for index, figure in enumerate(figures):
            Path(folder, f"{name}-{index}.png").write_bytes(figure)
