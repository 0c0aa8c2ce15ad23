"""What ``render`` makes of a stage before Blender draws it."""

import importlib.util
import json
import shutil
import sys

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Gf, Usd, UsdGeom
from support.label_tables import labelled_objects
from support.sample_files import REPOSITORY
from support.soak import soak_but

from garage2usd.cli import main
from garage2usd.common import package
from garage2usd.common.errors import ConfigError, StageError
from garage2usd.common.package import installation_of
from garage2usd.common.progress import silent, time_in_words
from garage2usd.reading.labels import read_labels
from garage2usd.render import Picture, blender_process, devices, drawing
from garage2usd.render.cameras import find_views
from garage2usd.render.devices import ComputeDevice, Device, drawing_s, find_device
from garage2usd.render.drawn_prims import read_drawn_prims
from garage2usd.render.free_views import free_view
from garage2usd.render.pictures import visible_instances

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"


@pytest.fixture
def build(builds):
    return builds(HAND_DRAWN, "usdc", "instanced")


def run(*arguments):
    return CliRunner().invoke(main, ["render", *(str(argument) for argument in arguments)])


@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested", "flat"]))
def test_a_stage_without_a_table_tells_the_same_objects_and_classes(builds, tmp_path, form):
    made = builds(HAND_DRAWN, "usdc", form)
    stage = Usd.Stage.Open(str(made.stage))
    listed, told = read_labels(stage, made.stage), read_labels(stage, tmp_path / "none.usdc")
    assert {path: listed.class_ids[number] for path, number in listed.ids.items()} == {
        path: told.class_ids[number] for path, number in told.ids.items()
    }
    assert listed.classes == told.classes


@pytest.mark.parametrize("form", ["instanced", "nested"])
def test_every_object_is_drawn_once_with_all_of_its_parts(builds, form):
    made = builds(HAND_DRAWN, "usdc", form)
    stage = Usd.Stage.Open(str(made.stage))
    labels = read_labels(stage, made.stage)
    scene = read_drawn_prims(stage, labels.ids)
    assert set(scene.instance.tolist()) == set(labels.ids.values())
    table = labelled_objects(made.labels)
    low, high = (np.array([entry[end] for entry in table]) for end in ("min_m", "max_m"))
    found = np.full((len(table), 3), np.inf), np.full((len(table), 3), -np.inf)
    for shape, instance, place in zip(scene.shape.tolist(), scene.instance.tolist(), scene.to_world, strict=True):
        points = local_points(stage.GetPrimAtPath(scene.shapes[shape])) @ place[:3, :3].T + place[:3, 3]
        found[0][instance - 1] = np.minimum(found[0][instance - 1], points.min(axis=0))
        found[1][instance - 1] = np.maximum(found[1][instance - 1], points.max(axis=0))
    row_of = {entry["path"]: row for row, entry in enumerate(table)}
    for path, row in row_of.items():  # an object's bounds are around what is painted on it too
        if (around := row_of.get(path.rpartition("/")[0])) is not None:
            found[0][around] = np.minimum(found[0][around], found[0][row])
            found[1][around] = np.maximum(found[1][around], found[1][row])
    assert found[0] == pytest.approx(low, abs=1e-3)
    assert found[1] == pytest.approx(high, abs=1e-3)


def local_points(prim):
    if prim.IsA(UsdGeom.Mesh):
        return np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get())
    half = prim.GetAttribute("inputs:width").Get() / 2, prim.GetAttribute("inputs:height").Get() / 2
    return np.array([(x * half[0], y * half[1], 0.0) for x in (-1, 1) for y in (-1, 1)])


def test_shapes_are_shared(build):
    stage = Usd.Stage.Open(str(build.stage))
    scene = read_drawn_prims(stage, read_labels(stage, build.stage).ids)
    assert len(scene.shapes) < len(scene.shape) / 2


def test_centimetres_and_another_axis_become_metres():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    cube = UsdGeom.Cube.Define(stage, "/Cube")
    UsdGeom.XformCommonAPI(cube).SetTranslate((100, 200, 300))
    camera = UsdGeom.Camera.Define(stage, "/Camera")
    camera.AddTranslateOp().Set(Gf.Vec3d(0, 0, 1000))
    scene = read_drawn_prims(stage, {"/Cube": 7})
    assert scene.instance.tolist() == [7]
    assert scene.to_world[0] @ [1, 1, 1, 1] == pytest.approx([1.01, 2.01, 3.01, 1])
    (view,) = find_views(stage)
    # straight down: what is right stays right, what is up in the picture has a smaller row
    x, y, z = view.lens.matrix((200, 100)) @ (view.world_to_camera() @ [1.0, 2.0, 0.0, 1.0])[:3]
    assert z == pytest.approx(10.0)
    focal_px = 200 * camera.GetFocalLengthAttr().Get() / camera.GetHorizontalApertureAttr().Get()
    assert (x / z, y / z) == pytest.approx((100 + focal_px * 0.1, 50 - focal_px * 0.2))


def test_points_of_an_instancer_take_their_prototypes_with_them():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.XformCommonAPI(UsdGeom.Xform.Define(stage, "/World")).SetTranslate((10, 0, 0))
    instancer = UsdGeom.PointInstancer.Define(stage, "/World/Trees")
    # what stands over a prototype does not move its points, what it says of itself does
    UsdGeom.XformCommonAPI(UsdGeom.Xform.Define(stage, "/World/Trees/Kinds")).SetTranslate((0, 100, 0))
    tree = UsdGeom.Xform.Define(stage, "/World/Trees/Kinds/Tree")
    UsdGeom.XformCommonAPI(tree).SetTranslate((0, 0, 5))
    UsdGeom.XformCommonAPI(UsdGeom.Cube.Define(stage, "/World/Trees/Kinds/Tree/Crown")).SetTranslate((0, 3, 0))
    instancer.CreatePrototypesRel().AddTarget(tree.GetPath())
    instancer.CreateProtoIndicesAttr([0, 0, 0])
    instancer.CreatePositionsAttr([(0, 0, 0), (1, 0, 0), (2, 0, 0)])
    instancer.CreateOrientationsAttr([Gf.Quath(1), Gf.Quath(0.5**0.5, 0, 0.5**0.5, 0), Gf.Quath(1)])
    instancer.InvisId(2, Usd.TimeCode.Default())
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    scene = read_drawn_prims(stage, {"/World/Trees[0]": 4, "/World/Trees": 9})
    assert scene.instance.tolist() == [4, 9]
    middles = (scene.to_world @ [0, 0, 0, 1])[:, :3]
    # a quarter turn about +Y takes +Z to +X
    assert middles == pytest.approx(np.array([(10, 3, 5), (16, 3, 0)]), abs=1e-2)


@pytest.mark.parametrize(
    ("frames", "names"),
    [
        ("0", ["Drive_0000"]),
        ("0:96x48, 7", ["Drive_0000", "Drive_0048", "Drive_0096", "Drive_0007"]),
        ("2.5", ["Drive_2_5"]),
    ],
)
def test_frames_are_chosen_as_usdrecord_has_them(build, frames, names):
    stage = Usd.Stage.Open(str(build.stage))
    assert [view.name for view in find_views(stage, cameras=["/Garage/Cameras/Drive"], frames=frames)] == names


def test_all_cameras_and_every_second_second_are_usual(build):
    stage = Usd.Stage.Open(str(build.stage))
    views = find_views(stage)
    assert {view.camera.rpartition("/")[2] for view in views} == {"Inside", "Above", "Drive"}
    times = [view.frame for view in views if view.frame is not None]
    assert times == [48.0 * step for step in range(len(times))]
    assert 0 <= stage.GetEndTimeCode() - times[-1] < 48


@pytest.mark.parametrize("frames", ["", "x", "1:", "0:1e12", "5:1", "0:9x0", "nan", "0:inf", "0:9x1e-9"])
def test_frames_that_are_none_are_refused(build, frames):
    with pytest.raises(ConfigError, match="frames"):
        find_views(Usd.Stage.Open(str(build.stage)), frames=frames)


def test_a_camera_that_is_not_there_is_named_with_those_that_are(build):
    with pytest.raises(ConfigError, match=r"Wrong.*/Garage/Cameras/Inside"):
        find_views(Usd.Stage.Open(str(build.stage)), cameras=["Wrong"])


@pytest.mark.parametrize("name", ["inside", "INSIDE", "/garage/cameras/inside"])
def test_a_camera_is_found_in_letters_of_another_case(build, name):
    stage = Usd.Stage.Open(str(build.stage))
    (view,) = find_views(stage, cameras=[name, "Inside"])
    assert (view.name, view.camera) == ("Inside", "/Garage/Cameras/Inside")


def test_letters_as_they_are_go_before_those_of_another_case():
    stage = Usd.Stage.CreateInMemory()
    for path in ("/A/eye", "/B/Eye", "/C/EYE"):
        UsdGeom.Camera.Define(stage, path)
    assert [view.camera for view in find_views(stage, cameras=["Eye"])] == ["/B/Eye"]
    assert [view.camera for view in find_views(stage, cameras=["eYE"])] == ["/A/eye", "/B/Eye", "/C/EYE"]


@pytest.mark.parametrize("up", [UsdGeom.Tokens.y, UsdGeom.Tokens.z])
@pytest.mark.parametrize("target", [(4.0, 1.0, -3.0), (1.0, 9.0, 2.0), (1.0, -9.0, 2.0), (1.0, 2.0, 9.0)])
def test_a_free_camera_looks_at_its_place_and_has_up_above(up, target):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)  # places are in metres nevertheless
    eye = np.array([1.0, 2.0, 2.0])
    view = free_view(stage, tuple(eye), target, (200, 100), [])
    matrix = view.camera_to_world
    assert matrix[:3, 3] == pytest.approx(eye)
    assert matrix[:3, :3] @ matrix[:3, :3].T == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(matrix) == pytest.approx(1.0)
    x, y, z = view.lens.matrix((200, 100)) @ (view.world_to_camera() @ [*target, 1.0])[:3]
    assert (x / z, y / z, z) == pytest.approx((100, 50, np.linalg.norm(eye - target)))
    upwards = np.eye(3)[1 if up == UsdGeom.Tokens.y else 2]
    level = eye + (np.array(target) - eye) * (1 - upwards)
    if np.allclose(level, eye):  # straight up or down: the top of the picture is north
        assert matrix[:3, 1] == pytest.approx([0, 0, -1] if up == UsdGeom.Tokens.y else [0, 1, 0])
    else:
        assert matrix[:3, 0] @ upwards == pytest.approx(0)
        assert matrix[:3, 1] @ upwards > 0


def test_the_view_of_a_free_camera_has_a_name_of_its_own():
    stage = Usd.Stage.CreateInMemory()
    assert free_view(stage, (0, 0, 0), (1, 0, 0), (64, 48), ["FreeCamera"]).name == "FreeCamera_"


@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        (["--at", "1,2"], 2, "'1,2' is not a place such as"),
        (["--at", "1,2,x", "--look-at", "1,2,3"], 2, "'1,2,x' is not a place such as"),
        (["--at", "1,2,3"], 1, "look_at: got None"),
        (["--look-at", "1,2,3"], 1, "at: got None"),
        (["--at", "1,nan,3", "--look-at", "1,2,3"], 1, "at: got [1.0, nan, 3.0]; allowed: X,Y,Z in metres"),
        (["--at", "1,2,3", "--look-at", "1,2,inf"], 1, "look_at: got [1.0, 2.0, inf]"),
        (["--at", "1,2,3", "--look-at", "1,2,3"], 1, "another place than that of the camera"),
    ],
)
def test_places_that_a_camera_cannot_take_are_refused(build, tmp_path, monkeypatch, options, code, said):
    monkeypatch.setattr(package, "find_spec", lambda _name: True)
    result = run(build.stage, "-o", tmp_path / "out", *options)
    assert result.exit_code == code
    assert said in result.output
    assert list(tmp_path.iterdir()) == []


NO_GPU = {"CPU": ["Xeon"], "OPTIX": [], "CUDA": [], "HIP": []}
CUDA = {"CPU": ["Xeon"], "OPTIX": [], "CUDA": ["H100", "H100 #2"]}
BOTH = {"CPU": ["Xeon"], "OPTIX": ["RTX"], "CUDA": ["RTX"]}


@pytest.mark.parametrize(
    ("there", "asked", "has_rays", "kind"),
    [
        (NO_GPU, Device.AUTO, False, "CPU"),
        (CUDA, Device.AUTO, False, "CUDA"),
        (CUDA, Device.AUTO, True, "CPU"),  # lenses of rigs are shaders, which only OptiX runs
        (CUDA, Device.CPU, False, "CPU"),
        (BOTH, Device.AUTO, False, "OPTIX"),
        (BOTH, Device.GPU, True, "OPTIX"),
    ],
)
def test_a_gpu_draws_where_there_is_one_that_can(monkeypatch, there, asked, has_rays, kind):
    monkeypatch.setattr(devices, "_devices", lambda _blender: there)
    assert find_device(asked, has_rays=has_rays).kind == kind


def test_a_gpu_that_is_not_there_is_refused_with_what_is(build, tmp_path, monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda _name: True)
    monkeypatch.setattr(devices, "_devices", lambda _blender: NO_GPU)
    result = run(build.stage, "-o", tmp_path / "out", "--device", "gpu")
    assert result.exit_code == 1
    (line,) = result.output.strip().splitlines()
    assert (
        line == "Error: device: got 'gpu'; allowed: auto or cpu where Cycles does not find a GPU; it finds Xeon (CPU)"
    )
    monkeypatch.setattr(devices, "_devices", lambda _blender: CUDA)
    with pytest.raises(ConfigError, match=r"a GPU with OPTIX, .*; it finds Xeon \(CPU\), H100 \(CUDA\), H100 #2"):
        find_device(Device.GPU, has_rays=True)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
def test_blender_says_which_devices_it_has():
    found = devices._devices()
    assert len(found["CPU"]) == 1
    assert find_device(Device.AUTO, has_rays=False).kind in found


def test_what_is_drawn_is_said_before_and_how_long_a_picture_takes_when_one_is(build, tmp_path, monkeypatch):
    seconds = iter([100.0, 104.0, 109.0, 112.0, 130.0])
    monkeypatch.setattr(drawing.time, "monotonic", lambda: next(seconds))
    jobs = []

    def pretend(job, _folder, done, _blender):
        jobs.append(job)
        for samples in (0, 3, 8, 9, 24):
            done(samples)

    monkeypatch.setattr(drawing, "run_blender", pretend)
    stage = Usd.Stage.Open(str(build.stage))
    labels = read_labels(stage, build.stage)
    views = find_views(stage, cameras=["Drive"], frames="0:96x48", size_px=(64, 36))
    work, said = tmp_path / "work", []
    work.mkdir()
    gpu = ComputeDevice("OPTIX", "RTX")
    drawn = drawing.Drawing(stage, labels, views, [[]] * 3, [Picture.COLOUR], 8, 0, tmp_path / "out", device=gpu)
    drawn.draw(work, silent, said.append)
    assert said == [
        "3 views, 3 of 64 x 36 pixels: colour with 8 samples on the GPU RTX (OPTIX)",
        "a picture takes 9.0 s, 2 more about 18 s",
    ]
    assert jobs[0]["device"] == "OPTIX"
    said.clear()
    seconds = iter([100.0, 104.0, 109.0, 112.0, 130.0])
    monkeypatch.setattr(drawing, "cores", lambda: 2)
    kinds = [Picture.COLOUR]
    drawing.Drawing(stage, labels, views[:1], [[]], kinds, 1, 0, tmp_path / "cpu").draw(work, silent, said.append)
    took = time_in_words(drawing_s([(64, 36)], [], samples=1, cores=2))
    assert said[0] == f"1 view, 1 of 64 x 36 pixels: colour with 1 sample on the CPU; about {took}"


def test_a_process_that_says_nothing_is_heard_of_every_second(tmp_path, monkeypatch):
    monkeypatch.setattr(blender_process, "_HEARTBEAT_S", blender_process._LOOK_S)
    report, ends = tmp_path / "report.txt", []
    report.write_bytes(b"0\n1")
    numbers = blender_process._numbers(report, lambda: bool(ends))
    assert [next(numbers) for _ in range(3)] == [0, 0, 0]
    with report.open("ab") as file:
        file.write(b"2\n20\n")
    assert [next(numbers) for _ in range(4)] == [12, 20, 20, 20]
    with report.open("ab") as file:
        file.write(b"24\n")
    ends.append(True)  # what was written before the end is heard
    assert list(numbers) == [24]


def change_object(table, **values):
    """The fourth object of the first tile."""
    row = next(iter(table["objects"].values()))[3]
    for column, value in values.items():
        row[table["columns"].index(column)] = value


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda table: change_object(table, id=0), "greater than or equal to 1"),
        (lambda table: change_object(table, id=2**24), "less than or equal"),
        (lambda table: change_object(table, id=5), "occurs twice"),
        (lambda table: change_object(table, name="Floor"), "occurs twice"),
        (lambda table: change_object(table, class_id=200), "of the class 200, which is not listed"),
        (lambda table: table.pop("classes"), "classes"),
    ],
)
def test_a_broken_table_is_refused(build, tmp_path, change, said):
    table = json.loads(build.labels.read_text())
    change(table)
    (tmp_path / "g_labels.json").write_text(json.dumps(table))
    with pytest.raises(StageError, match=said):
        read_labels(Usd.Stage.Open(str(build.stage)), tmp_path / "g.usdc")


def test_boxes_hold_all_pixels_of_an_instance():
    instance = np.zeros((6, 8), dtype=np.int32)
    instance[1:3, 2:7] = 5
    instance[5, 0] = instance[0, 7] = 9
    five, nine = visible_instances(instance)
    assert (five.id, five.box_px, five.pixels) == (5, (2, 1, 7, 3), 10)
    assert (nine.id, nine.box_px, nine.pixels) == (9, (0, 0, 8, 6), 2)


def test_without_blender_one_line_names_the_extra(build, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "bpy", None)
    result = run(build.stage, "-o", tmp_path / "out")
    assert result.exit_code == 1
    (line,) = result.output.strip().splitlines()
    assert installation_of("blender") in line
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "arguments",
    [
        ["--size", "1280"],
        ["--size", "axb"],
        ["--only", "colour,smell"],
        ["--samples", "0"],
        ["--seed", "-1"],
        ["--frames", "a"],
    ],
)
def test_bad_usage_ends_in_two(build, tmp_path, arguments):
    assert run(build.stage, "-o", tmp_path / "out", *arguments).exit_code == 2
    assert not (tmp_path / "out").exists()


@pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only")
@pytest.mark.parametrize("content", [None, b"", b"#usda 1.0\n(", b"PXR-USDC" + bytes(80)])
def test_what_is_no_stage_ends_in_one_line(tmp_path, content):
    path = tmp_path / "g.usdc"
    if content is not None:
        path.write_bytes(content)
    result = run(path, "-o", tmp_path / "out", "--size", "64x36")
    assert result.exit_code == 1
    assert len(result.output.strip().splitlines()) == 1
    assert str(path) in result.output
    assert not (tmp_path / "out").exists()


def test_the_stage_is_left_as_it_is(build, tmp_path):
    from garage2usd.render.drawn_prims import write_shapes

    copy = tmp_path / build.stage.name
    shutil.copyfile(build.stage, copy)
    shutil.copytree(build.asset_folder, tmp_path / build.asset_folder.name)
    stage = Usd.Stage.Open(str(copy))
    scene = read_drawn_prims(stage, read_labels(stage, build.stage).ids)
    before = {path: path.read_bytes() for path in tmp_path.rglob("*.usd*")}
    write_shapes(stage, scene, tmp_path / "shapes.usda")
    assert {path: path.read_bytes() for path in before} == before
    over = Usd.Stage.Open(str(tmp_path / "shapes.usda"))
    for number, shape in enumerate(scene.shapes):
        prim = over.GetPrimAtPath(shape)
        assert not prim.IsInstanceProxy()
        assert prim.GetAttribute("userProperties:garage2usd_shape").Get() == number
