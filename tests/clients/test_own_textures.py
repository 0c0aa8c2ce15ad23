"""Textures of one's own, in the shapes that packs come in, are what each program shows."""

import importlib.util
import json
import subprocess
import sys
import zipfile
from pathlib import Path, PurePosixPath

import pytest
from pxr import Usd, UsdGeom, UsdShade
from support.browser import find_browser, find_three, load_in_three
from support.finishes import blender_surface, glb_surface, materials_by_mesh, pxr_surface, three_surface
from support.foreign_set import SHOWN, assert_foreign_set, foreign_config, halves_of
from support.glb_reader import Glb

import garage2usd
from garage2usd.maps.glb import write_glb

pytestmark = pytest.mark.client


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("own")
    return garage2usd.build(foreign_config(folder / "set"), folder / "own.usdz")


@pytest.fixture(scope="module")
def files(built):
    """What the package's pictures hold, by name."""
    with zipfile.ZipFile(built.stage) as archive:
        names = [name for name in archive.namelist() if name.endswith((".png", ".jpg"))]
        return {PurePosixPath(name).name: (archive.read(name), archive.getinfo(name).CRC) for name in names}


def by_name(pairs):
    found = {}
    for name, surface in pairs:
        found.setdefault(name, set()).add(surface)
    return found


def test_pxr_reads_them(built, files):
    stage = Usd.Stage.Open(str(built.stage))
    found = []
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdGeom.Mesh):
            material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
            if material.GetPrim().GetName() in SHOWN:
                shader, _, _ = material.ComputeSurfaceSource()
                found.append((material.GetPrim().GetName(), pxr_surface(shader)))
    assert_foreign_set(by_name(found), lambda name: halves_of(files[name][0]))


@pytest.mark.skipif(find_browser() is None or find_three() is None, reason="no browser or no three.js")
def test_three_shows_them(built, files, tmp_path):
    scene = load_in_three(built.stage, tmp_path)
    assert (scene["complaints"], scene["missing"], scene["failed"]) == ([], [], [])
    marks = {name: str(mark) for name, (_, mark) in files.items()}
    names = {mark: name for name, (_, mark) in files.items()}
    materials = materials_by_mesh(built.garage.layout)
    found = [
        (materials[item["path"]], three_surface(item["surface"], names)) for item in scene["objects"] if item["mesh"]
    ]
    assert {name for name, _ in found} >= SHOWN.keys()
    assert_foreign_set(by_name(found), lambda name: scene["textures"][marks[name]]["halves"])


def test_a_glb_carries_them(built, files, tmp_path):
    write_glb(Usd.Stage.Open(str(built.stage)), tmp_path / "own.glb")
    glb = Glb((tmp_path / "own.glb").read_bytes())
    names = {data: name for name, (data, _) in files.items()}
    found = [
        (material["name"], glb_surface(glb, number, names)) for number, material in enumerate(glb.json["materials"])
    ]
    assert_foreign_set(by_name(found), lambda name: halves_of(files[name][0]))


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_blender_shows_them(built, files, tmp_path):
    script, output = Path(__file__).with_name("blender_dump.py"), tmp_path / "dump.json"
    subprocess.run(
        [sys.executable, str(script), str(built.stage), str(output)], check=True, capture_output=True, timeout=600
    )
    scene = json.loads(output.read_text())
    found = [(material.pop("name"), blender_surface(material)) for material in scene["materials"]]
    assert {image["name"] for image in scene["images"] if image["read"]} >= {name for name in files if "own_" in name}
    assert_foreign_set(by_name(found), lambda name: halves_of(files[name][0]))
