"""Exits on foot as a stage shows them, whoever edited it."""

import math

import numpy as np
import pytest
from pxr import Usd, Vt
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.as_built.core_reader import core_doors
from garage2usd.as_built.layout_reader import level_of_layout
from garage2usd.as_built.stage_reader import level_of_stage
from garage2usd.checks import safety
from garage2usd.profiles import load_profile
from garage2usd.structure.grid import Cell

CN = load_profile("cn-jgj100")
PLAN = "\n".join(
    ["............", "E==========X", *(["............", ".=........=.", ".==========."] * 3), "............"]
)
PLAN = PLAN.replace("............\n.=........=.", ".=........=.\n.=........=.")
FORMS = ["instanced", "nested", "flat"]


@pytest.fixture(scope="module", params=soak_but(1, FORMS))
def made(request, tmp_path_factory):
    config = GarageConfig(
        site={"structure": PLAN},
        parking={"occupancy": 0.1},
        stage={"form": request.param, "texture_quality": "low"},
    )
    return build(config, tmp_path_factory.mktemp(request.param) / "g.usda")


@pytest.fixture(scope="module")
def opened(made):
    """Keeps the file's contents, so that it is read once."""
    return Usd.Stage.Open(str(made.stage))


@pytest.fixture
def stage(opened):
    """The stage as it was built; edits go to a session layer of its own."""
    stage = Usd.Stage.Open(opened.GetRootLayer())
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


def found_in(stage):
    subject = level_of_stage(stage, source="edited")
    rules = [rule for rule in safety.BOOK.rules if "compartment" in rule.name or "exit" in rule.name]
    return [(finding.rule, finding.place) for rule in rules for finding in rule.findings(subject, CN)]


def core_prims(stage):
    return [prim for prim in stage.GetPrimAtPath("/Garage/Obstacles").GetChildren() if "Core" in prim.GetName()]


def test_the_doors_of_a_stage_are_those_of_its_layout(made, stage):
    garage = made.garage
    placed = sorted(core.door_m for core in garage.layout.cores)
    assert len(placed) >= 2
    for subject in (
        level_of_stage(stage, source="stage"),
        level_of_layout(garage.layout, source="layout", kind="plan"),
    ):
        found = sorted(door.position for door in core_doors(subject))
        assert len(found) == len(placed)
        assert max(map(math.dist, found, placed)) < 0.1
        assert (subject.compartments == garage.layout.compartments).all()
    assert found_in(stage) == []


def test_a_core_that_is_taken_away_is_missed_in_its_compartment(stage):
    gone = core_prims(stage)[0]
    gone.SetActive(False)
    assert len([place for rule, place in found_in(stage) if rule == "personnel-exits" and place.startswith("F")]) == 1


def test_a_core_far_from_any_lane_is_no_exit(stage):
    moved = core_prims(stage)[0].GetAttribute("xformOp:translate")
    moved.Set(moved.Get() + type(moved.Get())(0, 0, 500))
    assert "personnel-exits" in {rule for rule, _ in found_in(stage)}


def test_floor_that_declares_no_compartments_is_too_large_for_one(stage):
    root = stage.GetDefaultPrim()
    count = len(root.GetCustomDataByKey("fireCompartments"))
    root.SetCustomDataByKey("fireCompartments", Vt.IntArray([1] * count))
    assert ("fire-compartment-sprinklered", "F1") in found_in(stage)
    root.SetCustomDataByKey("fireCompartments", Vt.IntArray([1]))
    assert ("fire-compartment-sprinklered", "") in found_in(stage)


def test_a_square_that_belongs_to_no_compartment_has_no_exits(made, stage):
    root = stage.GetDefaultPrim()
    numbers = np.array(root.GetCustomDataByKey("fireCompartments"))
    corner = int(np.flatnonzero(made.garage.layout.structure.cells.ravel() == Cell.FREE)[0])
    numbers[corner] = 0
    root.SetCustomDataByKey("fireCompartments", Vt.IntArray(numbers.tolist()))
    assert ("personnel-exits", "") in found_in(stage)
