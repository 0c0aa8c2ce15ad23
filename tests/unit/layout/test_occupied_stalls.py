"""Which stalls hold a car: stage, report and labels against where the cars stand, in every form of the stage."""

import json
import re

import numpy as np
import pytest
import shapely
from pxr import Usd, UsdGeom
from support.label_tables import labelled_objects
from support.soak import soak_but

from garage2usd.common.errors import StageError
from garage2usd.config import GarageConfig
from garage2usd.pipeline import build
from garage2usd.reading.label_table import LabelTable, read_label_table
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.report import read_report

SITE = {"width_cells": 8, "height_cells": 7, "min_portal_distance_cells": 3}
FORMS = {
    "instanced": ("garage.usda", {}),
    "crate": ("garage.usdc", {"form": "instanced"}),
    "package": ("garage.usdz", {}),
    "shared": ("one/garage.usdc", {"assets": "shared"}),
    "flat": ("garage.usdc", {"form": "flat"}),
    "nested": ("garage.usdc", {"form": "nested", "arrangements": 3}),
}


@pytest.fixture(scope="module", params=soak_but(["instanced", "flat", "nested"], FORMS))
def made(request, tmp_path_factory):
    name, stage = FORMS[request.param]
    config = GarageConfig(seed=6, site=SITE, plan={"episodes": 200}, stage=stage)
    return request.param, build(config, tmp_path_factory.mktemp(request.param) / name)


def cars_by_place(stage, outlines):
    """Path of the car whose bounds have their middle in each stall, from geometry alone."""
    cache = UsdGeom.BBoxCache(Usd.TimeCode.Default(), [UsdGeom.Tokens.default_])
    grounds = {name: shapely.Polygon(corners) for name, corners in outlines.items()}
    found = {}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if list(prim.GetAttribute("semantics:labels:class").Get() or []) != ["car"] or "/Asset" in str(prim.GetPath()):
            continue
        x, _, z = cache.ComputeWorldBound(prim).ComputeCentroid()
        (home,) = [name for name, ground in grounds.items() if ground.contains(shapely.Point(x, z))]
        assert home not in found
        found[home] = str(prim.GetPath())
    return found


def outlines_of(stage):
    prim = UsdGeom.BasisCurves(stage.GetPrimAtPath("/Garage/LaneGraph/Stalls"))
    corners = np.array(prim.GetPointsAttr().Get())[:, [0, 2]].reshape(-1, 4, 2)
    names = prim.GetPrim().GetAttribute("garage:stall:id").Get()
    occupied = prim.GetPrim().GetAttribute("garage:stall:occupied").Get()
    return dict(zip(names, corners, strict=True)), dict(zip(names, occupied, strict=True))


def stall_prims(stage):
    """The prims of stalls by their ids: the square is that of the tile, the number that of the prim."""
    prims = {}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        found = re.search(r"/Tile_(r\d+_c\d+)(?:/Parking)?/Stall_(\d+)$", str(prim.GetPath()))
        if found:
            prims[f"Stall_{found[1]}_{found[2]}"] = prim
    return prims


def test_stage_report_and_labels_say_which_stall_holds_which_car(made):
    form, built = made
    stage = Usd.Stage.Open(str(built.stage))
    outlines, occupied = outlines_of(stage)
    cars = cars_by_place(stage, outlines)
    assert 5 < len(cars) < len(outlines) - 5
    assert {name: bool(said) for name, said in occupied.items()} == {name: name in cars for name in outlines}

    prims = stall_prims(stage)
    assert prims.keys() == outlines.keys()
    for name, prim in prims.items():
        targets = [str(target) for target in prim.GetRelationship("garage:stall:car").GetTargets()]
        assert targets == ([cars[name]] if name in cars else [])
        said = prim.GetAttribute("garage:stall:occupied").Get()
        assert said is (None if form == "nested" else name in cars)

    assert {stall.name: stall.occupied for stall in read_report(built.report).levels[0].stalls} == {
        name: name in cars for name in outlines
    }
    paths = {entry["id"]: entry["path"] for entry in labelled_objects(built.labels)}
    parked = {paths[stall]: paths[car] for stall, car in json.loads(built.labels.read_text())["parked"]}
    assert parked == {str(prims[name].GetPath()): car for name, car in cars.items()}
    assert {stall.name: dict(stall.facts)["occupied"] for stall in read_lanes(stage).stalls} == {
        name: name in cars for name in outlines
    }


def test_no_stall_is_occupied_in_the_variant_without_cars(made):
    form, built = made
    stage = Usd.Stage.Open(str(built.stage))
    if form == "flat":
        assert not stage.GetPrimAtPath("/Garage").GetVariantSets().GetNames()
        return
    before = outlines_of(stage)[1]
    said = {name: prim.GetAttribute("garage:stall:occupied").Get() for name, prim in stall_prims(stage).items()}
    choices = stage.GetPrimAtPath("/Garage").GetVariantSets().GetVariantSet("occupancy")
    choices.SetVariantSelection("empty")
    outlines, occupied = outlines_of(stage)
    assert cars_by_place(stage, outlines) == {}
    assert set(occupied.values()) == {0}
    assert not any(prim.GetAttribute("garage:stall:occupied").Get() for prim in stall_prims(stage).values())
    choices.SetVariantSelection("parked")
    assert outlines_of(stage)[1] == before
    assert {name: prim.GetAttribute("garage:stall:occupied").Get() for name, prim in stall_prims(stage).items()} == said


def test_a_table_that_parks_what_is_not_there_is_refused(made, tmp_path):
    _, built = made
    document = json.loads(built.labels.read_text())
    last = max(row[1] for rows in document["objects"].values() for row in rows)
    document["parked"][0][1] = last + 1
    (tmp_path / "garage_labels.json").write_text(json.dumps(document))
    with pytest.raises(StageError, match=f"parked names the id {last + 1}"):
        read_label_table(tmp_path / "garage.usda")
    assert LabelTable.model_validate(document | {"parked": []}).parked == ()
