"""Pictures by few rays, against the inverse square law and the law of reflection; what is hidden, unseen or moved."""

import math

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdShade
from support.sample_files import REPOSITORY

from garage2usd.cli import main
from garage2usd.reading.labels import read_labels
from garage2usd.render.cameras import View, find_views
from garage2usd.render.ray_pictures import RayPictures
from garage2usd.sensors.rays.lenses import Pinhole

ALBEDO, LAMP_M, LAMP_UP_M, NIT = 0.4, 0.1, 3.0, 1000.0
SIZE_PX, FOCAL_PX = (48, 32), 40.0


def quad(stage, path, corners_m, *, diffuse=0.0, emissive=0.0, roughness=1.0, metallic=0.0):
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr([Gf.Vec3f(*corner) for corner in corners_m])
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    mesh.CreateSubdivisionSchemeAttr("none")
    mesh.CreateDoubleSidedAttr(True)
    material = UsdShade.Material.Define(stage, f"{path}/Look")
    shader = UsdShade.Shader.Define(stage, f"{path}/Look/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    for name, value in (("diffuseColor", diffuse), ("emissiveColor", emissive)):
        shader.CreateInput(name, Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(value))
    for name, value in (("roughness", roughness), ("metallic", metallic)):
        shader.CreateInput(name, Sdf.ValueTypeNames.Float).Set(value)
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
    return mesh


def level(half_m, up_m, *, x_m=0.0):
    """Corners of a horizontal square."""
    low, high = x_m - half_m, x_m + half_m
    return [(low, up_m, -half_m), (low, up_m, half_m), (high, up_m, half_m), (high, up_m, -half_m)]


@pytest.fixture
def stage(tmp_path):
    made = Usd.Stage.CreateNew(str(tmp_path / "room.usda"))
    UsdGeom.SetStageUpAxis(made, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(made, 1.0)
    UsdGeom.Xform.Define(made, "/Room")
    quad(made, "/Room/Floor", level(20.0, 0.0), diffuse=ALBEDO)
    return made


def lamp(stage, up_m=LAMP_UP_M):
    light = UsdLux.DiskLight.Define(stage, "/Room/Lamp")
    light.CreateRadiusAttr(LAMP_M)
    light.CreateIntensityAttr(NIT)
    UsdGeom.XformCommonAPI(light.GetPrim()).SetTranslate((0.0, up_m, 0.0))
    UsdGeom.XformCommonAPI(light.GetPrim()).SetRotate((-90.0, 0.0, 0.0))


def view_down(up_m=2.0, *, x_m=0.0):
    """A camera that looks straight down, whose pictures have X to the right and Z down."""
    matrix = np.eye(4)
    matrix[:3, :3] = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])  # columns: right, up and backwards
    matrix[:3, 3] = x_m, up_m, 0.0
    lens = Pinhole(size_px=SIZE_PX, centre_px=(SIZE_PX[0] / 2, SIZE_PX[1] / 2), focal_px=(FOCAL_PX, FOCAL_PX))
    return View("Down", "Down", None, lens, SIZE_PX, matrix)


def floor_places(up_m=2.0, *, x_m=0.0):
    """X and Z of the floor that the pixels of such a camera see."""
    rows, columns = np.indices(SIZE_PX[::-1]) + 0.5
    return x_m + (columns - SIZE_PX[0] / 2) * up_m / FOCAL_PX, (rows - SIZE_PX[1] / 2) * up_m / FOCAL_PX


def taken(stage, view, samples=16):
    labels = read_labels(stage, None)
    return RayPictures(stage, labels, samples, 0).taken(view, (), (), {})


def test_the_light_of_a_lamp_falls_by_the_inverse_square_law(stage):
    lamp(stage)
    light, surfaces = taken(stage, view_down())
    x_m, z_m = floor_places()
    square_m2 = x_m**2 + z_m**2 + LAMP_UP_M**2
    lux = NIT * math.pi * LAMP_M**2 * LAMP_UP_M**2 / square_m2**2  # the cosines at both ends are LAMP_UP_M / distance
    distance_m, from_camera_m = np.sqrt(square_m2), np.sqrt(x_m**2 + z_m**2 + 4.0)
    cosines = LAMP_UP_M / distance_m + 2.0 / from_camera_m
    reflectance = 0.04  # facets of roughness 1 have a density of 1 / pi, and hide one another as Smith has it
    radiance = lux * (ALBEDO * (1 - reflectance) / math.pi + reflectance / (2 * math.pi * cosines))
    inner = slice(7, -7), slice(7, -7)  # nearer to the edge light is smoothed to one side
    assert light[(*inner, 1)] == pytest.approx(radiance[inner], rel=0.01)
    assert surfaces.depth_m == pytest.approx(np.full(SIZE_PX[::-1], 2.0), abs=1e-5)  # along the axis
    assert surfaces.normal == pytest.approx(np.broadcast_to([0, 1, 0], (*SIZE_PX[::-1], 3)), abs=1e-6)


def test_what_stands_between_lamp_and_floor_throws_a_shadow_where_rays_tell(stage):
    lamp(stage)
    quad(stage, "/Room/Board", level(0.2, 1.5, x_m=0.75))
    view = {"up_m": 1.2, "x_m": 1.5}
    light, _ = taken(stage, view_down(**view))
    x_m, z_m = floor_places(**view)
    # half way up, the board's shadow is twice as large, and soft by the lamp's size
    inside = (np.abs(x_m - 1.5) < 0.4 - 2 * LAMP_M) & (np.abs(z_m) < 0.4 - 2 * LAMP_M)
    outside = (np.abs(x_m - 1.5) > 0.4 + 2 * LAMP_M) | (np.abs(z_m) > 0.4 + 2 * LAMP_M)
    assert inside.sum() > 20 < outside.sum()
    assert light[inside].max() < 0.04 * light[outside].min()


def test_a_mirror_shows_what_glows_where_the_law_of_reflection_has_it(stage):
    quad(stage, "/Room/Mirror", level(3.0, 0.001), diffuse=0.9, roughness=0.0, metallic=1.0)
    quad(stage, "/Room/Panel", level(0.15, 4.0, x_m=1.0), emissive=20.0)
    light, _ = taken(stage, view_down(), 64)
    x_m, z_m = floor_places()
    weight = light[..., 1] * (light[..., 1] > light[..., 1].max() / 4)
    # the panel's image is as deep below the floor as it is high: the line to it from 2 m meets the floor at a third
    assert (weight * x_m).sum() / weight.sum() == pytest.approx(1 / 3, abs=0.03)
    assert (weight * z_m).sum() / weight.sum() == pytest.approx(0, abs=0.03)


def test_a_wall_throws_light_back_to_the_floor(stage):
    lamp(stage)
    alone, _ = taken(stage, view_down())
    quad(stage, "/Room/Wall", [(1.5, 0, -9), (1.5, 3, -9), (1.5, 3, 9), (1.5, 0, 9)], diffuse=0.8)
    with_wall, _ = taken(stage, view_down())
    x_m, _ = floor_places()
    gain = with_wall[..., 1] - alone[..., 1]
    near, far = (x_m > 0.9) & (x_m < 1.4), x_m < -0.7
    assert gain[near].mean() > 1.5 * gain[far].mean() > 0


def test_the_same_seed_gives_the_same_picture_and_another_one_another(stage):
    lamp(stage)
    quad(stage, "/Room/Board", level(0.2, 1.5, x_m=0.75), diffuse=0.5)
    view, labels = view_down(), read_labels(stage, None)
    first, again, other = (RayPictures(stage, labels, 2, seed).taken(view, (), (), {})[0] for seed in (0, 0, 1))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_objects_are_hidden_looked_through_or_moved(builds):
    made = builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdc", "instanced")
    stage = Usd.Stage.Open(str(made.stage))
    labels = read_labels(stage, made.stage)
    (view,) = find_views(stage, cameras=["Inside"], size_px=(160, 90))
    pictures = RayPictures(stage, labels, 2, 0)
    _, surfaces = pictures.taken(view, (), (), {})
    cars = [number for number, kind in labels.class_ids.items() if labels.classes[kind].name == "car"]
    number = max(cars, key=lambda each: (surfaces.instance == each).sum())
    mask = surfaces.instance == number
    assert mask.sum() > 50
    without, hidden = pictures.taken(view, (number,), (), {})
    through, unseen = pictures.taken(view, (), (number,), {})
    assert not (hidden.instance == number).any()
    assert np.array_equal(hidden.instance, unseen.instance)
    assert np.allclose(
        hidden.depth_m[np.isfinite(hidden.depth_m)], unseen.depth_m[np.isfinite(unseen.depth_m)], atol=1e-3
    )
    assert through[mask].mean() < without[mask].mean()  # its shadow is there
    upwards = np.eye(4)
    upwards[1, 3] = 0.5
    _, raised = pictures.taken(view, (), (), {number: upwards})
    rows = [np.flatnonzero((each == number).any(axis=1)) for each in (surfaces.instance, raised.instance)]
    assert rows[1].max() < rows[0].max()


def test_birds_eye_views_are_refused_before_the_work(builds, tmp_path):
    made = builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdc", "instanced")
    asked = ["render", str(made.stage), "--rig", "avp_surround", "--along", "1:A1-01", "--birds-eye", "0.05"]
    told = CliRunner().invoke(main, [*asked, "--device", "rays", "-o", str(tmp_path / "out")])
    assert told.exit_code != 0
    assert "device" in told.output
    assert "bird's-eye" in told.output
