"""Cars of one's own: foreign models stand in garages as cars do, and what is no car is refused in one line."""

import numpy as np
import pytest
from pxr import Gf, Usd, UsdGeom
from support.foreign_cars import write_glb, write_parts, write_z_up

import garage2usd
from garage2usd.config import GarageConfig
from garage2usd.config.own_cars import ModelFolder, read_own_cars
from garage2usd.errors import ConfigError


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
    return garage2usd.build(settings(models), tmp_path_factory.mktemp("out") / "garage.usdc")


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
