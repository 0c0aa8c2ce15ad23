"""Programs that are not ours read the GLB of every sample: Khronos' validator, three.js, Blender and trimesh."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom, UsdLux
from support.browser import find_browser, find_three, load_in_three
from support.foreign_materials import (
    BROKEN_PICTURES,
    MATERIALS,
    RGB,
    STAGE,
    case,
    material_stage,
    moved,
    odd_pictures,
    primvar,
    texture,
    write_pictures,
)
from support.glb_reader import Glb
from support.gltf_validator import VALIDATOR_VERSION, find_node, find_validator, validated
from support.pictures import difference, read_png, store, stored
from support.places import MILLIMETRE
from support.sample_files import OBJECT_SAMPLES, REPOSITORY, each_object_sample
from support.soak import soak_but

from garage2usd.config.look import ColumnSection
from garage2usd.maps.glb import write_glb

pytestmark = pytest.mark.client
JUDGED = REPOSITORY / "samples" / "looks.toml"
"""The sample that all four judges read in `make test`; others are read by Khronos' validator."""
by_all_judges = pytest.mark.parametrize("sample", soak_but([JUDGED], OBJECT_SAMPLES), ids=lambda path: path.stem)
NO_BLENDER = importlib.util.find_spec("bpy") is None
LARGEST_DIFFERENCE = 1.0


@pytest.fixture(scope="module")
def files(builds, tmp_path_factory):
    made = {}

    def glb_of(sample):
        if sample not in made:
            built = builds(sample, "usdz")
            made[sample] = tmp_path_factory.mktemp("glb") / f"{sample.stem}.glb"
            write_glb(Usd.Stage.Open(str(built.stage)), made[sample])
        return made[sample]

    return glb_of


def camera_of(stage_path):
    """Place, a point ahead and vertical angle of the stage's camera Inside."""
    stage = Usd.Stage.Open(str(stage_path))
    camera = UsdGeom.Camera(stage.GetPrimAtPath("/Garage/Cameras/Inside")).GetCamera(0)
    matrix = np.array(camera.transform)
    place, ahead = matrix[3, :3], -matrix[2, :3]
    return json.dumps([place.tolist(), (place + ahead).tolist(), camera.GetFieldOfView(Gf.Camera.FOVVertical)])


def bounds_of(glb):
    """By name: class and stall as a node says, and the corners of its bounds with what is painted on it."""

    def below(number):
        yield number
        for child in glb.nodes[number].get("children", ()):
            yield from below(child)

    found = {}
    for number, node in enumerate(glb.nodes):
        if "mesh" in node:
            points = np.concatenate([glb.points(other) for other in below(number) if "mesh" in glb.nodes[other]])
            found[node["name"]] = node["extras"], points.min(axis=0), points.max(axis=0)
    return found


@each_object_sample
@pytest.mark.skipif(
    find_node() is None or find_validator() is None, reason="environment.sh test installs the validator"
)
def test_the_validator_finds_nothing(sample, files):
    report = validated(files(sample))
    assert report["validatorVersion"] == VALIDATOR_VERSION
    issues = report["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    # of the other remarks only this one: textures need not have 2^n pixels
    assert {message["code"] for message in issues["messages"]} <= {"IMAGE_NPOT_DIMENSIONS"}


@pytest.fixture(scope="module")
def in_three(builds, files, tmp_path_factory):
    def load(sample, *, pictures=False):
        folder = tmp_path_factory.mktemp("browser")
        camera = camera_of(builds(sample, "usdz").stage)
        return load_in_three(files(sample), folder, pictures=pictures, page="glb.html", camera=camera)

    return load


@by_all_judges
@pytest.mark.skipif(find_browser() is None or find_three() is None, reason="no browser or no three.js")
def test_three_agrees(sample, files, in_three):
    glb, scene = Glb(files(sample).read_bytes()), in_three(sample)
    assert (scene["complaints"], scene["missing"]) == ([], [])
    expected = bounds_of(glb)
    found = {item["name"]: item for item in scene["objects"] if item["said"].get("class")}
    assert found.keys() == expected.keys()
    for name, (said, low, high) in expected.items():
        item = found[name]
        assert {key: item["said"].get(key) for key in said} == said
        assert np.abs(np.array([item["low"], item["high"]]) - [low, high]).max() < MILLIMETRE
    primitives = [own for mesh in glb.json["meshes"] for own in mesh["primitives"]]
    shapes = {(own["indices"], *sorted(own["attributes"].items())) for own in primitives}
    assert scene["geometries"] == len(shapes)
    assert scene["textures"] == len(glb.json["images"])


@pytest.mark.skipif(find_browser() is None or find_three() is None, reason="no browser or no three.js")
def test_three_draws_the_stored_picture(in_three, write_pictures):
    scene = in_three(REPOSITORY / "samples" / "paper_7x9.toml", pictures=True)
    assert scene["complaints"] == []
    picture = read_png(scene["pictures"]["Inside"])
    if write_pictures:
        store("threejs_glb_inside", picture)
    assert difference(picture, stored("threejs_glb_inside")) < LARGEST_DIFFERENCE


@by_all_judges
@pytest.mark.skipif(NO_BLENDER, reason="Blender's bpy is made for Python 3.11 only")
def test_blender_agrees(sample, builds, files, tmp_path):
    script, output = Path(__file__).with_name("glb_blender_dump.py"), tmp_path / "dump.json"
    camera = camera_of(builds(sample, "usdz").stage)
    command = [sys.executable, str(script), str(files(sample)), str(output), "", camera]
    subprocess.run(command, check=True, capture_output=True, timeout=600)
    scene, glb = json.loads(output.read_text()), Glb(files(sample).read_bytes())
    expected = bounds_of(glb)
    found = {item["name"]: item for item in scene["objects"] if "class" in item["said"]}
    assert found.keys() == expected.keys()
    for name, (said, low, high) in expected.items():
        item = found[name]
        assert {key: item["said"].get(key) for key in said} == said
        assert np.abs(np.array([item["low"], item["high"]]) - [low, high]).max() < MILLIMETRE
    assert len({item["mesh"] for item in found.values()}) == len(glb.json["meshes"])
    assert len(scene["images"]) == len(glb.json["images"])
    assert all(image["values"] for image in scene["images"])
    # what has no normals is faceted, and the rest is smooth where it is round
    for number, node in enumerate(glb.nodes):
        if "class" in node.get("extras", {}):
            attributes = [primitive["attributes"] for primitive in glb.primitives(number)]
            smooth = found[node["name"]]["smooth"]
            assert smooth == 0 or any("NORMAL" in own for own in attributes), node["name"]
            # for the sake of a normal map what is flat has them too, and tangents
            assert smooth > 0 or all("NORMAL" not in own or "TANGENT" in own for own in attributes), node["name"]
    layout = builds(sample, "usdz").garage.layout
    has_round_columns = layout.look.columns.section is ColumnSection.ROUND
    facets = {item["said"]["class"]: item["smooth"] for item in found.values()}
    assert facets["wall"] == 0
    assert (facets["column"] > 0) == has_round_columns
    assert 0.2 < facets["car"] < 1


def test_trimesh_agrees(files):
    trimesh = pytest.importorskip("trimesh")
    file = files(JUDGED)
    expected, scene = bounds_of(Glb(file.read_bytes())), trimesh.load(file)
    low, high = (np.array([bounds[side] for bounds in expected.values()]) for side in (1, 2))
    assert np.abs(scene.bounds - [low.min(axis=0), high.max(axis=0)]).max() < MILLIMETRE


@pytest.fixture(scope="module")
def foreign(tmp_path_factory):
    """Every small stage of `support.foreign_materials` beside each other in one GLB, with lights of each kind."""
    folder = tmp_path_factory.mktemp("foreign")
    write_pictures(folder)
    odd = {name: case(texture("T", name), primvar(), diffuseColor=RGB) for name in odd_pictures(folder)}
    broken = {name: case(texture("T", name), primvar(), roughness="T.outputs:g") for name in BROKEN_PICTURES}
    for name, data in BROKEN_PICTURES.items():
        (folder / name).write_bytes(data)
    stage = Usd.Stage.CreateNew(str(folder / "all.usda"))
    for number, said in enumerate([*MATERIALS.values(), *odd.values(), *broken.values()]):
        (folder / f"{number}.usda").write_text(STAGE.format(**said))
        square = stage.DefinePrim(f"/Square_{number}")
        square.GetReferences().AddReference(f"{number}.usda")
        UsdGeom.XformCommonAPI(square).SetTranslate(Gf.Vec3d(2 * number, 0, 0))
    for kind in (UsdLux.SphereLight, UsdLux.DistantLight, UsdLux.RectLight, UsdLux.DiskLight, UsdLux.CylinderLight):
        light = kind.Define(stage, f"/{kind.__name__}")
        light.CreateEnableColorTemperatureAttr(True)
        light.CreateColorTemperatureAttr(3000)
    UsdLux.ShapingAPI.Apply(stage.GetPrimAtPath("/SphereLight")).CreateShapingConeAngleAttr(30)
    stage.Save()
    write_glb(stage, folder / "all.glb")
    return folder / "all.glb"


@pytest.mark.skipif(
    find_node() is None or find_validator() is None, reason="environment.sh test installs the validator"
)
def test_the_validator_finds_nothing_in_stages_of_others(foreign):
    issues = validated(foreign)["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
    assert {message["code"] for message in issues["messages"]} <= {"IMAGE_NPOT_DIMENSIONS"}


@pytest.mark.skipif(find_browser() is None or find_three() is None, reason="no browser or no three.js")
def test_three_opens_stages_of_others(foreign, tmp_path):
    scene = load_in_three(foreign, tmp_path, page="glb.html", camera=json.dumps([[0, 0, 5], [0, 0, 0], 40]))
    assert (scene["complaints"], scene["missing"]) == ([], [])


@pytest.mark.skipif(find_browser() is None or find_three() is None, reason="no browser or no three.js")
def test_three_turns_textures_as_usd_does(tmp_path):
    """What UsdTransform2d does to coordinates looks like coordinates to which it is done by hand."""
    turn = {"scale": (1.5, 1.5), "rotation": 30, "translation": (0.25, -0.4)}
    cos, sin = 1.5 * np.cos(np.radians(30)), 1.5 * np.sin(np.radians(30))
    by_hand = [(cos * u - sin * v + 0.25, sin * u + cos * v - 0.4) for u, v in ((0, 0), (1, 0), (1, 1), (0, 1))]
    glow = {"diffuseColor": (0, 0, 0), "emissiveColor": RGB}
    pictures = []
    for name, said, corners in (
        ("moved", case(texture("T", "noise.png", "X"), moved("X", **turn), primvar(), **glow), None),
        ("by_hand", case(texture("T", "noise.png"), primvar(), **glow), by_hand),
        ("not_at_all", case(texture("T", "noise.png"), primvar(), **glow), None),
    ):
        folder = tmp_path / name
        folder.mkdir()
        stage = material_stage(folder, said)
        if corners:
            stage.GetPrimAtPath("/W/Square").GetAttribute("primvars:st").Set(corners)
        write_glb(stage, folder / "square.glb")
        camera = json.dumps([[0.5, 0.5, 2], [0.5, 0.5, 0], 35])
        scene = load_in_three(folder / "square.glb", folder, pictures=True, page="glb.html", camera=camera)
        assert scene["complaints"] == []
        pictures.append(read_png(scene["pictures"]["Inside"]))
    moved_picture, drawn_by_hand, not_moved = pictures
    assert difference(moved_picture, drawn_by_hand) < 0.1
    assert difference(moved_picture, not_moved) > 1


@pytest.mark.skipif(NO_BLENDER, reason="Blender's bpy is made for Python 3.11 only")
def test_blender_opens_stages_of_others(foreign, tmp_path):
    script, output = Path(__file__).with_name("glb_blender_dump.py"), tmp_path / "dump.json"
    command = [sys.executable, str(script), str(foreign), str(output), "", json.dumps([[0, 0, 5], [0, 0, 0], 40])]
    subprocess.run(command, check=True, capture_output=True, timeout=600)
    scene, glb = json.loads(output.read_text()), Glb(foreign.read_bytes())
    assert len([item for item in scene["objects"] if "low" in item]) == sum("mesh" in node for node in glb.nodes)
    assert len(scene["images"]) >= len(glb.json["images"])
    assert all(image["values"] for image in scene["images"])


def test_trimesh_measures_what_is_not_convex(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    stage = Usd.Stage.CreateInMemory()
    mesh = UsdGeom.Mesh.Define(stage, "/L")
    mesh.CreatePointsAttr([(10, 0, 4), (4, 0, 4), (4, 0, 10), (0, 0, 10), (0, 0, 0), (10, 0, 0)])
    mesh.CreateFaceVertexCountsAttr([6])
    mesh.CreateFaceVertexIndicesAttr(list(range(6)))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    write_glb(stage, tmp_path / "l.glb")
    assert trimesh.load(tmp_path / "l.glb").area == pytest.approx(64)
