"""Paint is floor to whoever reads a stage for its rules, though it has classes of its own."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdSemantics
from support.label_tables import labelled_objects
from support.soak import soak_but

from garage2usd.as_built.contents import read_contents
from garage2usd.as_built.solids import Solids
from garage2usd.config import GarageConfig
from garage2usd.objects import PIECE_LABELS
from garage2usd.pipeline import build
from garage2usd.structure.grid import Cell

SITE = {"width_cells": 8, "height_cells": 7, "min_portal_distance_cells": 3}


def level_area_m2(thing):
    area = 0.0
    for body in thing.bodies:
        points, start = body.world_points()[:, [0, 2]], 0
        for count in body.shape.counts.tolist():
            x, z = points[body.shape.indices[start : start + count]].T
            area += abs(x @ np.roll(z, -1) - z @ np.roll(x, -1)) / 2
            start += count
    return area


@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested", "flat"]))
def test_floors_and_stalls_with_their_paint_cover_every_square_once(form, tmp_path):
    config = GarageConfig(seed=6, site=SITE, plan={"episodes": 200}, stage={"form": form})
    built = build(config, tmp_path / "garage.usdc")
    structure = built.garage.layout.structure
    things = read_contents(Usd.Stage.Open(str(built.stage))).things
    assert not {thing.label for thing in things} & PIECE_LABELS
    assert {entry["class"] for entry in labelled_objects(built.labels)} >= {"stall_line", "lane_line", "lane_arrow"}
    squares = np.outer(structure.row_depths_mm, structure.column_widths_mm) / 1e6
    covered = sum(level_area_m2(thing) for thing in things if thing.label in {"floor", "parking_stall"})
    assert covered == pytest.approx(squares[structure.cells != Cell.OBSTACLE].sum(), rel=1e-5)


def test_paint_that_belongs_to_no_object_is_nothing_solid():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    for name, label in (("Line", "stall_line"), ("Block", "obstacle")):
        cube = UsdGeom.Cube.Define(stage, f"/{name}")
        UsdSemantics.LabelsAPI.Apply(cube.GetPrim(), "class").CreateLabelsAttr([label])
    things = read_contents(stage).things
    assert [thing.name for thing in things] == ["/Line", "/Block"]
    assert Solids(things).labels == {"stall_line", "obstacle"} - PIECE_LABELS
