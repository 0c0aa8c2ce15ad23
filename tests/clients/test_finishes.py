"""What a look asks for is what each program shows: tints of floors, gloss, worn paint and the colours of lamps."""

import importlib.util
import json
import subprocess
import sys
import zipfile
from pathlib import Path, PurePosixPath

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade
from support.browser import find_browser, find_three, load_in_three
from support.finishes import (
    assert_shown,
    blender_surface,
    glb_surface,
    grouped,
    lamp_of,
    pxr_surface,
    surfaces_by_object,
    three_surface,
    viewer_surface,
)
from support.glb_reader import Glb
from support.sample_files import REPOSITORY

from garage2usd.config import load_config
from garage2usd.look import finishes_of
from garage2usd.maps.glb import write_glb
from garage2usd.reading.files import open_stage
from garage2usd.view.viewer import ViewerServer, read_scene

pytestmark = pytest.mark.client

SAMPLE = REPOSITORY / "samples" / "looks.toml"


@pytest.fixture(scope="module")
def built(builds):
    return builds(SAMPLE, "usdz")


@pytest.fixture(scope="module")
def surfaces(built):
    """Surfaces of each object by path and material, by the settings alone."""
    return surfaces_by_object(built.garage.layout, built.garage.config.stage.texture_quality)


@pytest.fixture(scope="module")
def expected(surfaces):
    return {path: set(own.values()) for path, own in surfaces.items()}


@pytest.fixture(scope="module")
def files(built):
    """What the package's pictures hold, by name."""
    with zipfile.ZipFile(built.stage) as archive:
        names = [name for name in archive.namelist() if name.endswith((".png", ".jpg"))]
        return {PurePosixPath(name).name: (archive.read(name), archive.getinfo(name).CRC) for name in names}


def test_the_look_has_all_that_is_to_be_shown(built, surfaces):
    """Else the other tests would say nothing."""
    look = load_config(SAMPLE).look
    finishes = finishes_of(built.garage.layout.look)
    floors = {own["FloorConcrete"] for own in surfaces.values() if "FloorConcrete" in own}
    (floor,) = floors
    asked = [int(look.floor.colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    # a tint times the mean of its neutral texture is the colour that was asked for, in its hue
    assert np.argsort(floor.colour_rgb).tolist() == np.argsort(asked).tolist()
    assert max(floor.colour_rgb) < 1
    assert floor.packed.startswith("gloss_mirror_")
    paints = {own[name] for own in surfaces.values() for name in own if name.startswith("PaintStall")}
    assert {paint.colour.rpartition("_")[0] for paint in paints} == {"wear_worn", "wear_gone"}
    assert {"paint_stall", "floor_concrete", "wall_band"} <= finishes.keys()
    lamps = {lamp_of(place.spec) for place in built.garage.layout.of_kind("light")}
    assert all(lamp.is_round for lamp in lamps)
    assert {lamp.intensity > 0 for lamp in lamps} == {True, False}
    assert len({lamp.colour_rgb for lamp in lamps}) > 2
    glows = {own["TubeGlow"].glow_rgb for own in surfaces.values() if "TubeGlow" in own}
    assert len(glows) > 2


def test_pxr_reads_them(built, expected):
    stage = Usd.Stage.Open(str(built.stage))
    found = []
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdGeom.Mesh):
            shader, _, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].ComputeSurfaceSource()
            found.append((str(prim.GetPath()), pxr_surface(shader)))
    assert_shown(grouped(found, expected), expected)


@pytest.mark.skipif(find_browser() is None or find_three() is None, reason="no browser or no three.js")
def test_three_shows_them(built, expected, files, tmp_path):
    scene = load_in_three(built.stage, tmp_path)
    names = {mark: name for name, (_, mark) in files.items()}
    found = [(item["path"], three_surface(item["surface"], names)) for item in scene["objects"] if item["mesh"]]
    assert_shown(grouped(found, expected), expected)
    lamps = {
        path: lamp_of(place.spec)
        for path, place in zip(expected, built.garage.layout.placements, strict=True)
        if place.kind == "light"
    }
    assert len(scene["lights"]) == len(lamps)
    for light in scene["lights"]:
        lamp = lamps[light["path"].removesuffix("/Asset/Light")]
        assert light["rgb"] == pytest.approx(lamp.colour_rgb, abs=1e-6)
        assert light["intensity"] == pytest.approx(lamp.intensity, rel=1e-5)
        # three.js has no disks: it takes the square around one, which is 4 / pi times as bright
        assert (light["type"], light["width"], light["height"]) == pytest.approx(("RectAreaLight", *lamp.sides_m))


def test_a_glb_carries_them(built, expected, files, tmp_path):
    write_glb(Usd.Stage.Open(str(built.stage)), tmp_path / "garage.glb")
    glb = Glb((tmp_path / "garage.glb").read_bytes())
    names = {data: name for name, (data, _) in files.items()}
    found = [
        (node["name"], glb_surface(glb, own["material"], names))
        for number, node in enumerate(glb.nodes)
        if "mesh" in node
        for own in glb.primitives(number)
    ]
    assert_shown(grouped(found, expected), expected)


def test_the_viewer_shows_them(built, expected, files):
    scene = read_scene(open_stage(built.stage), built.stage)
    assert scene.remarks == []
    found = [
        (item.path, viewer_surface(scene.surfaces[scene.palettes[item.palette][piece.slot]], scene.textures))
        for item in scene.objects
        for piece in scene.shapes[item.shape].pieces
    ]
    assert_shown(grouped(found, expected), expected, normals=False)
    with ViewerServer() as server:
        server.show(scene)
        sent = {server.answer(f"/textures/{number}")[1] for number in range(len(scene.textures))}
    colours = {surface.colour for own in expected.values() for surface in own if surface.colour}
    assert sent >= {files[name][0] for name in colours}
    lamps = [lamp_of(place.spec) for place in built.garage.layout.of_kind("light")]
    lights = [light for item in scene.objects for light in scene.shapes[item.shape].lights]
    assert sorted((light.kind, light.candela > 0) for light in lights) == sorted(
        ("DiskLight", lamp.intensity > 0) for lamp in lamps
    )
    for light in lights:
        assert any(
            light.colour_rgb == pytest.approx(lamp.colour_rgb, abs=1e-6)
            and light.candela == pytest.approx(np.pi / 4 * np.prod(lamp.sides_m) * lamp.intensity, rel=1e-4)
            for lamp in lamps
        )


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_blender_shows_them(builds, surfaces, tmp_path):
    script, output = Path(__file__).with_name("blender_dump.py"), tmp_path / "dump.json"
    stage = builds(SAMPLE, "usdc").stage
    subprocess.run([sys.executable, str(script), str(stage), str(output)], check=True, capture_output=True, timeout=600)
    found, expected = {}, {}
    for material in json.loads(output.read_text())["materials"]:
        found.setdefault(material.pop("name"), set()).add(blender_surface(material))
    for own in surfaces.values():
        for name, surface in own.items():
            expected.setdefault(name, set()).add(surface)
    assert_shown(found, expected)
