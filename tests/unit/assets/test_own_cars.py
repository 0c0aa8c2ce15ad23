"""Cars of one's own: foreign models stand in garages as cars do, and what is no car is refused in one line."""

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pxr import Gf, Usd, UsdGeom, UsdShade
from support.foreign_cars import NORMAL_RGB, ROUGH_RGB, write_glb, write_parts, write_z_up

import garage2usd
from garage2usd.assets import MATERIALS
from garage2usd.assets.cars import lit
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.config.own_cars import ModelFolder, cars_by_name, read_own_cars
from garage2usd.recordings.birds_eye import ego_triangles_m
from garage2usd.scenes.foreign_models import read_model
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping
from garage2usd.stage.driving_car import CAR_NAME, driven_asset
from garage2usd.stage.ego_car import lamp_places


@pytest.fixture(scope="module")
def models(tmp_path_factory):
    folder = tmp_path_factory.mktemp("models")
    write_glb(folder / "box.glb")
    write_z_up(folder / "van.usdc")
    write_parts(folder)
    return folder


def settings(folder, **others):
    return GarageConfig(
        site={"width_cells": 5, "height_cells": 5},
        parking={"occupancy": 1.0},
        vehicles={"models": str(folder), "share": 1.0},
        **others,
    )


@pytest.fixture(scope="module")
def built(models, tmp_path_factory):
    # of this seed in each place of a car one of the models has room
    return garage2usd.build(settings(models, seed=2), tmp_path_factory.mktemp("out") / "garage.usdc")


def test_measures_are_found_whatever_units_axes_and_files(models):
    _, cars = read_own_cars(ModelFolder(folder=str(models)))
    assert len(cars) == 3
    for car in cars:
        body = car
        assert [body.length_m, body.height_m, body.wheelbase_m, body.wheel_radius_m] == pytest.approx(
            [4.2, 1.5, 2.5, 0.32], abs=0.01
        )
        assert body.front_overhang_m == pytest.approx(0.85, abs=0.01)
        # without names the mirrors are part of the body
        assert body.width_m == pytest.approx(1.99 if car.path.endswith("van.usdc") else 1.7, abs=0.01)
        assert body.overall_width_m == pytest.approx(1.99, abs=0.01)
        (front, _, nose), (rear, _, tail) = body.plates
        assert (front, rear) == (-1, 1)
        assert (nose, tail) == pytest.approx((-2.104, 2.104), abs=0.001)


def test_models_stand_as_cars_with_class_and_plates_within_their_stalls(built):
    stage = Usd.Stage.Open(str(built.stage))
    boxes = UsdGeom.BBoxCache(Usd.TimeCode.Default(), ["default", "render"])
    cars = [
        prim
        for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
        if list(prim.GetAttribute("semantics:labels:class").Get() or ()) == ["car"]
    ]
    plates = [prim for prim in stage.Traverse() if prim.GetName().startswith("NumberPlate_")]
    assert len(cars) > 10
    assert len(plates) == len(cars)
    for car in cars:
        size = boxes.ComputeUntransformedBound(car).ComputeAlignedRange().GetSize()
        assert Gf.Vec3d(size)[2] == pytest.approx(4.2, abs=0.01)
    assert {prim.GetTypeName() for car in cars for prim in Usd.PrimRange(car, Usd.TraverseInstanceProxies())} >= {
        "Mesh"
    }


def test_same_models_give_the_same_bytes_and_a_changed_file_another_digest(models, tmp_path):
    one = settings(models).digest()
    assert settings(models, seed=0).digest() == one
    given = settings(models)
    path = models / "inner" / "cabin.usdc"
    before = path.read_bytes()
    try:
        stage = Usd.Stage.Open(str(path))
        UsdGeom.Mesh(stage.GetPrimAtPath("/Part/Mesh")).GetPointsAttr().Set(
            np.asarray(UsdGeom.Mesh(stage.GetPrimAtPath("/Part/Mesh")).GetPointsAttr().Get()) * np.float32(0.99)
        )
        stage.Save()
        assert settings(models).digest() != one
        with pytest.raises(ConfigError, match="models that it was given with"):
            garage2usd.build(given, tmp_path / "garage.usdc")
    finally:
        path.write_bytes(before)


def test_finishes_of_own_cars_are_their_pictures(tmp_path):
    (tmp_path / "models").mkdir()
    write_glb(tmp_path / "models" / "box.glb", finish=True)
    made = garage2usd.build(settings(tmp_path / "models"), tmp_path / "garage.usdc")
    stage = Usd.Stage.Open(str(made.stage))
    pictures, scales = {}, {}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if "/Looks/Own" in str(prim.GetPath()) and prim.GetName().endswith("Texture"):
            shader = UsdShade.Shader(prim)
            pictures[prim.GetName()] = Image.open(shader.GetInput("file").Get().resolvedPath).getpixel((3, 3))
            scales[prim.GetName()] = shader.GetInput("scale").Get() if shader.GetInput("scale") else None
    assert pictures == {
        "ColourTexture": (10, 160, 40),
        "PackedTexture": (180, 100, 100),  # occlusion, half the roughness, metallic
        "NormalTexture": NORMAL_RGB,
    }
    assert tuple(scales["ColourTexture"]) == pytest.approx((1.0, 1.0, 0.2, 1.0))


def test_channels_of_a_preview_surface_are_packed(tmp_path):
    write_z_up(tmp_path / "van.usdc", finish=True)
    (surface,) = {part.surface for part in read_model(tmp_path / "van.usdc", field="models").parts}
    assert surface.colour_rgb == pytest.approx((0.6, 0.02, 0.02))
    assert (surface.picture, surface.normals) == (None, None)
    assert Image.open(io.BytesIO(surface.packed.data)).getpixel((0, 0)) == (255, ROUGH_RGB[0], ROUGH_RGB[2])


@pytest.fixture(scope="module")
def rigs(models):
    """A rig file for each model beside their folder."""
    for name in ("box", "van", "parts"):
        models.with_name(f"{name}.toml").write_text(
            f'name = "own"\nmodels = "{models.name}"\ncar = "{name}"\n'
            '[[sensors]]\nkind = "pinhole"\nname = "front"\nposition_m = [1, 0, 1.4]\n'
            "size_px = [64, 48]\nfocal_px = [40, 40]\n"
        )
    return models.parent


@pytest.mark.parametrize("name", ["box", "van", "parts"])
def test_one_drives_with_wheels_that_roll_and_its_own_textures(built, rigs, tmp_path, name):
    stall = next(stall.name for stall in built.garage.layout.stalls if stall.use == "standard")
    layer = tmp_path / "car.usdc"
    options = ["--stall", stall, "--leg", "in", "--animate", "--rig", str(rigs / f"{name}.toml"), "-o", str(layer)]
    main(["drive", str(built.stage), *options], standalone_mode=False)
    root = Usd.Stage.CreateInMemory()
    root.GetRootLayer().subLayerPaths = [str(layer), str(built.stage)]
    last = Usd.Stage.Open(str(layer)).GetEndTimeCode()
    boxes, turns = UsdGeom.BBoxCache(0.0, ["default"]), set()
    for wheel in ("FrontLeft", "FrontRight", "RearLeft", "RearRight"):
        prim = root.GetPrimAtPath(f"/Garage/{CAR_NAME}/{wheel}Wheel")
        size = np.array(boxes.ComputeUntransformedBound(prim).ComputeAlignedRange().GetSize())
        assert size == pytest.approx([0.2, 0.64, 0.64], abs=0.01)
        matrices = [UsdGeom.Xformable(prim).GetLocalTransformation(frame) for frame in np.linspace(0, last, 50)]
        assert matrices[0].ExtractTranslation()[1] == pytest.approx(0.32, abs=0.005)
        turns |= {round(matrix[1][1], 2) for matrix in matrices}
    assert len(turns) > 20
    body = root.GetPrimAtPath(f"/Garage/{CAR_NAME}/Body")
    low, high = (np.array(corner) for corner in _range(boxes.ComputeUntransformedBound(body)))
    assert low[1] == pytest.approx(0.25, abs=0.01), "no wheel is left in the body"
    assert high[2] - low[2] == pytest.approx(4.2, abs=0.02)
    files = [
        UsdShade.Shader(prim).GetInput("file").Get().resolvedPath
        for prim in root.Traverse()
        if str(prim.GetPath()).startswith(f"/Garage/{CAR_NAME}") and prim.GetName() == "ColourTexture"
    ]
    assert len(files) == (name == "box")
    assert all(Path(file).is_file() and Path(file).parent == tmp_path / "textures" for file in files)


def _range(bound):
    found = bound.ComputeAlignedRange()
    return found.GetMin(), found.GetMax()


def test_the_masks_of_a_rig_show_its_own_car(rigs, models):
    rig = read_rig(rigs / "van.toml")
    assert (rig.body.length_m, rig.body.name[:8]) == (pytest.approx(4.2), "own_van_")
    triangles = ego_triangles_m(rig.body)
    low, high = triangles.reshape(-1, 3).min(axis=0), triangles.reshape(-1, 3).max(axis=0)
    assert high - low == pytest.approx([4.21, 1.99, 1.5], abs=0.02)
    assert high[0] == pytest.approx(rig.body.ahead_m, abs=0.02)
    assert rig_from_mapping(rig.model_dump(mode="json")) == rig
    catalogue = read_rig("avp_surround").body
    assert catalogue == cars_by_name(None)["hatchback"]
    assert cars_by_name(ModelFolder(folder=str(models)))["van"] == rig.body


def test_lamps_of_an_own_car_glow_and_shine_where_they_are(tmp_path):
    write_glb(tmp_path / "lit.glb", lit=True)
    write_glb(tmp_path / "dark.glb")
    cars = cars_by_name(ModelFolder(folder=str(tmp_path)))
    asset = driven_asset(cars["lit"])
    places = lamp_places(asset)
    assert places["HeadLeft"] == pytest.approx([-0.5, 0.7, -2.15], abs=0.03)
    assert places["TailRight"] == pytest.approx([0.5, 0.7, 2.15], abs=0.03)
    of_lit = lamp_places(lit(asset))
    assert {name: place.tolist() for name, place in of_lit.items()} == {
        name: place.tolist() for name, place in places.items()
    }
    glowing = [
        part.material for part in lit(asset).parts if part.material in MATERIALS and part.name.startswith("Part")
    ]
    assert sorted(glowing) == ["lamp_front_lit"] * 2 + ["lamp_rear_lit"] * 2
    with pytest.raises(ConfigError, match="lamps: got 'on'; allowed: a car with parts or materials named as head"):
        lamp_places(driven_asset(cars["dark"]))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"car": "lorry"}, r"rig\.car: got 'lorry'; allowed: one of .*hatchback, .*, van, .*, box, parts$"),
        ({"models": "nowhere"}, r"rig\.models: got 'nowhere'; allowed: a folder that can be read"),
        ({"car": 7}, r"rig\.car: got 7"),
    ],
)
def test_a_rig_whose_car_is_not_there_is_refused_in_a_line(rigs, models, given, said):
    sensors = read_rig(rigs / "van.toml").model_dump(mode="json")["sensors"]
    with pytest.raises(ConfigError, match=said) as error:
        rig_from_mapping({"name": "own", "models": str(models), "car": "van", "sensors": sensors, **given})
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("write", "said"),
    [
        (lambda path: path.write_bytes(b"glTF and no more"), "a GLB that can be read"),
        (lambda path: write_glb(path, wheels=False), "with 0 wheels"),
        (lambda path: write_glb(path, length_m=40.0), r"of 40\.\d\d m.*2\.0 to 7\.0 m long"),
        (
            lambda path: (
                write_glb(path),
                path.with_name("models.toml").write_text('[bad]\nsemantic_class = "boat"\n'),
            ),
            r"vehicles\.models\.bad\.semantic_class: got 'boat'.*'car', 'van' or 'truck'",
        ),
    ],
)
def test_what_is_no_car_is_refused_in_a_line(tmp_path, write, said):
    write(tmp_path / "bad.glb")
    with pytest.raises(ConfigError, match=said) as error:
        settings(tmp_path)
    assert "\n" not in str(error.value)
    assert "bad" in str(error.value)
