"""A good stage with one thing edited, as another tool might: exactly the rule meant for it reports it."""

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSemantics
from support.broken_stages import BROKEN, COLUMN, all_of, box, changed, moved, without_lights
from support.edited_stages import edited, hidden, referring, scaled
from support.edited_stages import moved as turned_and_moved
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.as_built.garage import garage_of_stage
from garage2usd.as_built.shapes import Body, MeshShape
from garage2usd.checks import RULES, findings_of, swept_path, usd
from garage2usd.common.errors import StageError
from garage2usd.config.vehicles import body_named
from garage2usd.driving import way_search
from garage2usd.garage_sources import read_built
from garage2usd.profiles import load_profile
from garage2usd.reading.files import open_stage
from garage2usd.reading.lanes import read_lanes
from garage2usd.stage.ego_car import write_stage_with_car

PROFILE = load_profile("cn-jgj100")
FOUND_IN_GOOD_ONE = {"personnel-exits"}  # a garage without stair cores


@pytest.fixture(scope="module")
def stage_file(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("small") / "small.usda").stage


@pytest.fixture(scope="module")
def opened(stage_file):
    """Keeps the contents of the files, so that they are read once."""
    return Usd.Stage.Open(str(stage_file))


@pytest.fixture
def stage(opened):
    """The good stage; edits go to a session layer of its own."""
    stage = Usd.Stage.Open(opened.GetRootLayer())
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


def rules_found(stage, profile=PROFILE):
    return {finding.rule for finding in findings_of(garage_of_stage(stage, source="edited"), profile)}


def test_the_good_stage_breaks_nothing_else(stage):
    assert rules_found(stage) == FOUND_IN_GOOD_ONE


@pytest.mark.parametrize(("rule", "edit"), BROKEN.values(), ids=BROKEN)
def test_a_broken_stage_is_reported_by_the_rule_meant_for_it(rule, edit, stage):
    edit(stage)
    assert rules_found(stage) - FOUND_IN_GOOD_ONE == {rule}


def test_a_stage_without_light_is_dark(stage):
    without_lights(stage)
    assert rules_found(stage) - FOUND_IN_GOOD_ONE == {"lane-illuminance", "stall-illuminance"}


def test_a_finding_names_its_place_and_figures(stage):
    changed("Edges", "garage:lane:width", 1, 4.0)(stage)
    (finding,) = [f for f in findings_of(garage_of_stage(stage, source=""), PROFILE) if f.rule == "aisle-width"]
    assert (finding.place, finding.position_m) == ("[1, 1]-[1, 2]", (16.2, 12.15))
    assert (finding.measured, finding.required, finding.unit) == (4.0, 5.5, "m")
    assert finding.source == "JGJ 100-2015 (high)"


def test_a_stall_that_no_car_gets_into_is_named_with_what_is_in_the_way(stage):
    box(12.15, 0.0, 8.28, label="static", side=0.3)(stage)
    found = [f for f in findings_of(garage_of_stage(stage, source=""), PROFILE) if f.rule == "swept-path"]
    assert [(f.place, f.position_m, f.severity, f.unit) for f in found] == [
        ("Stall_r00_c01_2", (12.15, 5.45), "error", "m")
    ]
    assert "; in the way: /Garage/Added, " in found[0].message
    # half the car and half the box
    assert found[0].required == 0.05
    assert -1.3 < found[0].measured < -0.9


def test_stalls_whose_search_ended_at_its_bound_are_undecided_and_no_errors(stage, monkeypatch):
    monkeypatch.setattr(way_search, "_PASSES", ((0.36, 20), (0.24, 20)))
    monkeypatch.setattr(way_search, "_MOST_PLACES", 20)
    found = findings_of(garage_of_stage(stage, source=""), PROFILE)
    assert {f.rule for f in found} - FOUND_IN_GOOD_ONE == {"swept-path-undecided"}
    undecided = [f for f in found if f.rule == "swept-path-undecided"]
    assert {f.severity for f in undecided} == {"warning"}
    assert all(f.message.startswith("the search for ways ended at its bound") for f in undecided)


@pytest.mark.parametrize("clear", [0.03, 2.1])
def test_what_is_flat_or_higher_than_the_car_is_in_no_cars_way(clear, stage):
    """A mat, and an arm at 2.1 m on a post beside the row of stalls."""
    if clear < 1:
        box(12.15, 0.0, 8.28, label="static", side=0.3, scale=(1.0, clear / 0.31, 1.0))(stage)
    else:
        box(12.15, clear, 8.28, label="static", side=0.3)(stage)
    assert "swept-path" not in rules_found(stage)


def test_what_another_rule_reports_is_not_reported_again(stage):
    """A column in one stall is in the way of its neighbours too, and a trolley at the mouth of the same stall.

    It divides the mouths of its neighbours as well, which columns in the front half of stalls do.
    """
    all_of(moved(COLUMN, x=-4.05, z=-1.0), box(12.15, 0.0, 8.28, label="static", side=0.3))(stage)
    assert rules_found(stage) - FOUND_IN_GOOD_ONE == {"column-in-stall", "column-spacing"}


def test_a_garage_is_read_in_its_own_frame_wherever_it_is_moved_to(stage_file, opened, tmp_path):
    rules = [rule for rule in RULES if rule not in (*usd.BOOK.rules, *swept_path.BOOK.rules)]
    as_built = garage_of_stage(opened, source="")
    place = {"x": -13.7, "y": 5.0, "z": 200.0, "yaw_deg": 133.0, "pitch_deg": 7.0}
    for file in (
        edited(stage_file, tmp_path / "away.usda", turned_and_moved(**place), hidden("/Garage", "/Garage/Walls")),
        referring(stage_file, tmp_path / "z_up.usda", up="Z", metres_per_unit=0.01, move=(4, 5, 6), yaw_deg=20),
    ):
        garage, profile, *_ = read_built(file)
        assert profile.name == PROFILE.name
        (level,) = garage.levels
        found = {finding.rule for rule in rules for finding in rule.findings(level, profile)}
        assert found == FOUND_IN_GOOD_ONE
        told, lanes = as_built.lanes.positions_m, garage.lanes.positions_m
        assert np.abs(told - lanes).max() < 1e-4
        assert [stall.name for stall in garage.stalls] == [stall.name for stall in as_built.stalls]
        assert len(garage.things) == len(as_built.things)
        # what a rig records is where its drive is
        write_stage_with_car(tmp_path / "with_car.usdc", garage.stage, body_named("hatchback"))
        assert np.abs(told - read_lanes(open_stage(tmp_path / "with_car.usdc")).graph.positions_m).max() < 1e-4
    flat = edited(stage_file, tmp_path / "flat.usda", scaled(0.0))
    with pytest.raises(StageError, match="scale of 0"):
        read_built(flat)


def test_a_floor_of_a_ramp_without_area_has_no_faces(stage):
    """An array of points that was emptied, or squeezed to a point, as of a prim with a scale of 0."""
    shape = MeshShape(np.zeros((4, 3)), np.array([4]), np.arange(4))
    assert list(Body(shape, np.eye(4), touches=True).faces()) == []


def test_what_is_hidden_or_a_guide_is_in_nobodys_way(stage):
    box(16.2, 0.0, 12.15, label="traffic_cone")(stage)
    cube = UsdGeom.Imageable(stage.GetPrimAtPath("/Garage/Added"))
    cube.CreateVisibilityAttr(UsdGeom.Tokens.invisible)
    assert rules_found(stage) == FOUND_IN_GOOD_ONE
    cube.GetVisibilityAttr().Clear()
    cube.CreatePurposeAttr(UsdGeom.Tokens.guide)
    assert rules_found(stage) == FOUND_IN_GOOD_ONE


def test_a_sheet_without_any_thickness_is_in_the_way(stage):
    """A net across a mouth, with more points along it than a polygon of the ground would keep."""
    net = UsdGeom.Mesh.Define(stage, "/Garage/Added")
    across = np.linspace(11.5, 12.8, 12)
    points = [(x, y, 8.28) for x in across for y in (0.0, 1.0)]
    faces = [(2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2) for k in range(11)]
    net.CreatePointsAttr(points)
    net.CreateFaceVertexCountsAttr([4] * 11)
    net.CreateFaceVertexIndicesAttr([corner for face in faces for corner in face])
    UsdSemantics.LabelsAPI.Apply(net.GetPrim(), "class").CreateLabelsAttr(["static"])
    found = [f for f in findings_of(garage_of_stage(stage, source=""), PROFILE) if f.rule == "swept-path"]
    assert [f.place for f in found] == ["Stall_r00_c01_2"]
    assert "; in the way: /Garage/Added, " in found[0].message


@pytest.mark.parametrize("far_m", [1e7, 1e200])
def test_what_lies_beyond_all_measure_is_named(far_m, stage):
    box(12.15, 0.0, 8.28, label="static", side=0.3)(stage)
    UsdGeom.Xformable(stage.GetPrimAtPath("/Garage/Added")).AddTranslateOp(opSuffix="far").Set((0, 0, far_m))
    with pytest.raises(StageError, match=r"/Garage/Added lies 1e\+\d+ m from the origin"):
        garage_of_stage(stage, source="")


def test_points_of_an_instancer_stand_where_they_are_drawn(stage):
    instancer = UsdGeom.PointInstancer.Define(stage, "/Garage/Cones")
    cone = UsdGeom.Cube.Define(stage, "/Garage/Cones/Prototypes/Cone")
    cone.CreateSizeAttr(0.4)
    UsdSemantics.LabelsAPI.Apply(cone.GetPrim(), "class").CreateLabelsAttr(["traffic_cone"])
    instancer.CreatePrototypesRel().SetTargets([cone.GetPath()])
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(3.0, 0.2, 3.0), (16.2, 0.2, 12.15)])
    found = [f for f in findings_of(garage_of_stage(stage, source=""), PROFILE) if f.rule == "lane-blocked"]
    assert [(f.place, f.position_m) for f in found] == [("/Garage/Cones[1]", (16.2, 12.15))]


def test_a_stage_that_is_no_garage_is_said_to_have_no_lane_graph():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(stage.DefinePrim(Sdf.Path("/World"), "Xform"))
    assert "lane-graph" in rules_found(stage)
