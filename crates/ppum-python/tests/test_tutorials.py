"""The notebooks of docs/tutorials run as they stand; their cells assert their numbers. Skipped where nbclient is not installed."""

import os

import pytest
from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

TUTORIALS = sorted((ROOT / "docs/tutorials").glob("*.ipynb"))


def test_there_are_tutorials():
    page = (ROOT / "docs/tutorials/README.md").read_text()
    assert len(TUTORIALS) >= 5 and all(f"({path.name})" in page for path in TUTORIALS)


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_a_tutorial_runs(path, tmp_path, monkeypatch):
    from nbclient import NotebookClient

    pytest.importorskip("anywidget")
    pytest.importorskip("matplotlib")
    monkeypatch.setenv("PPUM_SMALL", "1")
    monkeypatch.setenv("IPYTHONDIR", str(tmp_path))
    notebook = nbformat.read(path, as_version=4)
    assert all(not cell.get("outputs") and cell.get("execution_count") is None for cell in notebook.cells)
    NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": tmp_path}}).execute()
    outputs = [o for cell in notebook.cells for o in cell.get("outputs", ())]
    assert all("image/png" in o.data for o in outputs if o.get("data", {}).get("application/vnd.jupyter.widget-view+json"))
    assert any("image/png" in o.get("data", {}) for o in outputs) and "PPUM_SMALL" in os.environ
