"""The page in the package is what its source builds to, and its source is well typed."""

import shutil
import subprocess

import pytest
from support.sample_files import REPOSITORY

SOURCE = REPOSITORY / "garage2usd" / "view" / "web"
BUILT = REPOSITORY / "garage2usd" / "view" / "page"
MODULES = SOURCE / "node_modules"

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(
        shutil.which("node") is None or not MODULES.is_dir(),
        reason="no node, or what builds the page is not installed; environment.sh test does it",
    ),
]


def run(folder, tool, *arguments):
    script = {"vite": "vite/bin/vite.js", "tsc": "typescript/bin/tsc"}[tool]
    subprocess.run(
        ["node", str(MODULES / script), *arguments], cwd=folder, check=True, capture_output=True, timeout=300
    )


def test_a_rebuild_gives_the_same_bytes(tmp_path):
    web = tmp_path / "web"
    shutil.copytree(SOURCE, web, ignore=shutil.ignore_patterns("node_modules"))
    (web / "node_modules").symlink_to(MODULES)
    run(web, "vite", "build", "--logLevel", "error")
    built, kept = ({file.name: file.read_bytes() for file in folder.iterdir()} for folder in (tmp_path / "page", BUILT))
    pages = {"index.html", "index.css", "viewer.js", "draw.html", "draw.js", "trace.html", "trace.js"}
    assert built.keys() == kept.keys() == pages | {"file_bar.css", "file_bar.js", "licenses.txt"}
    for name, data in kept.items():
        assert built[name] == data, f"{name}: run `npm run build` in {SOURCE.relative_to(REPOSITORY)}"
    assert b"MIT" in kept["licenses.txt"]


@pytest.mark.soak
def test_the_source_is_well_typed():
    run(SOURCE, "tsc", "--noEmit")
