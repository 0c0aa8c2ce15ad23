"""The notebooks of the documentation run from top to bottom in a kernel, and show what they say."""

import json
import re
from xml.etree import ElementTree as ET

import nbformat
import pytest
from nbclient import NotebookClient
from support.browser import find_browser
from support.framed_page import framed
from support.sample_files import REPOSITORY

NOTEBOOKS = sorted((REPOSITORY / "docs").rglob("*.ipynb"))
SVG = "{http://www.w3.org/2000/svg}svg"


def run(name, folder, *, seen=None):
    """Run a notebook of the documentation; `seen` is given each output with an inline frame while the kernel lives."""
    notebook = nbformat.read(REPOSITORY / "docs" / name, as_version=4)
    nbformat.validate(notebook)
    client = NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(folder)}})
    with client.setup_kernel():
        for index, cell in enumerate(notebook.cells):
            client.execute_cell(cell, index)
            for output in cell.get("outputs", ()):
                if "<iframe" in output.get("data", {}).get("text/html", ""):
                    seen(output.data["text/html"])
    return {cell.id: cell.outputs for cell in notebook.cells if cell.cell_type == "code"}


@pytest.mark.soak
def test_prediction_tasks_are_drawn(tmp_path):
    outputs = run("prediction_tasks.ipynb", tmp_path)
    (picture,) = [output for output in outputs["draw"] if "data" in output]
    assert len(picture.data["image/png"]) > 10_000


@pytest.mark.client
@pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path")
def test_a_first_garage_is_drawn_and_its_viewer_stands_in_a_frame(tmp_path):
    shown = []
    outputs = run("first_garage.ipynb", tmp_path, seen=lambda html: shown.append((html, framed(html))))
    whole, drawn = (svgs(outputs[cell][0].data["text/html"]) for cell in ("build", "tracks_on_plan"))
    assert len(whole) == len(drawn) == 3  # two levels and the section
    ways = [len([line for line in svg.iter() if line.get("class", "").startswith("track ")]) for svg in drawn]
    assert min(ways[:2]) > 0
    assert len(svgs(outputs["tracks"][0].data["text/html"])) == 2
    for cell in ("floor", "plan"):
        assert ET.fromstring(outputs[cell][0].data["image/svg+xml"]).tag == SVG
    assert "0 findings against cn-jgj100" in outputs["check"][-1].text
    ((html, viewer),) = shown
    stalls = re.search(r"([0-9]+) stalls on 2 levels", outputs["build"][0].data["text/html"])[1]
    assert f"{stalls} stalls" in viewer.facts
    assert viewer.colours > 1000
    assert viewer.complaints == []
    # the last cell has closed it
    assert framed(html, timeout_ms=2000).facts == ""


def svgs(html):
    return list(ET.fromstring(f"<div>{html}</div>").iter(SVG))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.name)
def test_a_notebook_has_the_form_of_version_4_5_without_outputs(path):
    notebook = json.loads(path.read_text())
    assert (notebook["nbformat"], notebook["nbformat_minor"]) == (4, 5)
    assert notebook["metadata"]["kernelspec"]["language"] == "python"
    ids = [cell["id"] for cell in notebook["cells"]]
    assert len(set(ids)) == len(ids)
    for cell in notebook["cells"]:
        assert all(isinstance(line, str) for line in cell["source"])
        assert cell["cell_type"] == "markdown" or (cell["outputs"], cell["execution_count"]) == ([], None)
