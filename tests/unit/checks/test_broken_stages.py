"""A good stage with one thing edited, as another tool might: exactly the rule meant for it reports it."""

import math

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSemantics, Vt
from support.small_garage import SETTINGS

from garage2usd import GarageConfig, build
from garage2usd.checks import check
from garage2usd.checks.stage_reader import subject_of_stage
from garage2usd.errors import StageError
from garage2usd.profiles import load_profile

PROFILE = load_profile("cn-jgj100")
FOUND_IN_GOOD_ONE = {"personnel-exits"}  # a garage without stair cores
GRAPH = "/Garage/LaneGraph"
TILES = "/Garage/Tiles"
STALL_1_1 = f"{TILES}/Row_r00/Tile_r00_c01"


@pytest.fixture(scope="module")
def stage_file(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("small") / "small.usda").stage


@pytest.fixture
def stage(stage_file):
    """The good stage; edits go to a session layer of its own."""
    stage = Usd.Stage.Open(str(stage_file))
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


def rules_found(stage, profile=PROFILE):
    return {finding.rule for finding in check(subject_of_stage(stage, source="edited"), profile)}


def moved(path, x=0.0, y=0.0, z=0.0):
    def edit(stage):
        attribute = stage.GetPrimAtPath(path).GetAttribute("xformOp:translate")
        attribute.Set(attribute.Get() + Gf.Vec3f(x, y, z))

    return edit


def changed(curves, name, index, value):
    """One value of an attribute of the lane graph."""

    def edit(stage):
        attribute = stage.GetPrimAtPath(f"{GRAPH}/{curves}").GetAttribute(name)
        values = attribute.Get()
        values[index] = value
        attribute.Set(values)

    return edit


def resized(stall, across_m=0.0, along_m=0.0):
    """The outline of a stall along Z that grows by so much on each side."""

    def edit(stage):
        attribute = stage.GetPrimAtPath(f"{GRAPH}/Stalls").GetAttribute("points")
        points = np.array(attribute.Get())
        outline = points[4 * stall : 4 * stall + 4]
        outline += np.sign(outline - outline.mean(axis=0)) * (across_m, 0.0, along_m)
        attribute.Set(Vt.Vec3fArray.FromNumpy(points))

    return edit


def box(x, y, z, *, label=None, side=0.4, scale=(1.0, 1.0, 1.0)):
    def edit(stage):
        cube = UsdGeom.Cube.Define(stage, "/Garage/Added")
        cube.CreateSizeAttr(side)
        cube.CreateExtentAttr([(-side / 2,) * 3, (side / 2,) * 3])
        cube.AddTranslateOp().Set((x, y + side * scale[1] / 2, z))
        cube.AddScaleOp().Set(scale)
        if label:
            UsdSemantics.LabelsAPI.Apply(cube.GetPrim(), "class").CreateLabelsAttr([label])

    return edit


def all_of(*edits):
    def edit(stage):
        for one in edits:
            one(stage)

    return edit


def without_lane_graph(stage):
    stage.GetPrimAtPath(GRAPH).SetActive(False)


def without(start, *, keep=0):
    """Take the objects away that hang on walls and columns and whose names begin so, but for some."""

    def edit(stage):
        children = stage.GetPrimAtPath("/Garage/FireProtection").GetChildren()
        for prim in [prim for prim in children if prim.GetName().startswith(start)][keep:]:
            prim.SetActive(False)

    return edit


def without_lights(stage):
    for prim in list(stage.Traverse()):
        if prim.GetName().startswith("Tube"):
            prim.SetActive(False)


def in_centimetres(stage):
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    scale = UsdGeom.Xformable(stage.GetPrimAtPath("/Garage")).AddScaleOp(UsdGeom.XformOp.PrecisionFloat)
    scale.Set((100.0, 100.0, 100.0))


def z_up(stage):
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.Xformable(stage.GetPrimAtPath("/Garage")).AddRotateXOp().Set(90.0)


def missing_asset(stage):
    stage.DefinePrim("/Garage/Lost", "Xform").GetReferences().AddReference("./lost.usdc")


COLUMN = "/Garage/Columns/Column_r01_c02"
BROKEN = {
    "an aisle told too narrow": ("aisle-width", changed("Edges", "garage:lane:width", 1, 4.0)),
    "a column in the aisle": ("aisle-width", moved(COLUMN, z=2.5)),
    "a wall in the aisle": ("aisle-width", moved("/Garage/Walls/Wall_r00_c00_Up", x=12.0, z=10.5)),
    "a cone on the lane": ("lane-blocked", box(16.2, 0.0, 12.15, label="traffic_cone")),
    "a car left on the lane": ("lane-blocked", moved(f"{STALL_1_1}/Car_1", z=6.7)),
    "a column in a stall": ("column-in-stall", moved(COLUMN, x=-4.05, z=-3.0)),
    "a sign in a stall": ("stall-blocked", box(12.15, 0.0, 5.0, label="traffic_sign")),
    "a wall through stalls": ("stall-blocked", moved("/Garage/Walls/Wall_r00_c02_Up", z=4.0)),
    "a column against a car's door": ("column-clearance", moved(COLUMN, x=-0.16, z=-2.0)),
    "a wall against a car's side": ("wall-clearance", moved("/Garage/Walls/Wall_r00_c00_Left", x=8.35)),
    "a wall against a car's rear": ("end-clearance", moved("/Garage/Walls/Wall_r00_c02_Up", z=2.812)),
    "a car out of its stall": ("car-outside-stall", moved(f"{STALL_1_1}/Car_1", x=-0.5)),
    "a car on the access aisle": (
        "stall-kept-free",
        all_of(moved(f"{TILES}/Row_r02/Tile_r02_c02/Car_3", x=-2.4, z=-13.25)),
    ),
    "two cars in a stall": ("stall-two-cars", moved(f"{TILES}/Row_r02/Tile_r02_c02/Car_3", x=-12.9, z=-13.25)),
    "a narrow stall": ("stall-width", resized(1, across_m=-0.1)),
    "a short stall": ("stall-length", resized(1, along_m=-0.15)),
    "a stall over its neighbours": ("stall-overlap", resized(1, across_m=0.1)),
    "a stall's prim moved alone": ("stall-outline", moved(f"{STALL_1_1}/Stall_2", z=0.3)),
    "a stall that the lane graph does not know": (
        "stall-outline",
        changed("Stalls", "garage:stall:id", 1, "Stall_r00_c01_9"),
    ),
    "a stall far from its lane": ("stall-detached", changed("Stalls", "garage:stall:accessNode", 0, 2)),
    "a stall that opens onto the entrance": ("stall-detached", changed("Stalls", "garage:stall:accessNode", 0, 0)),
    "a stall that opens onto nothing": ("lane-graph", changed("Stalls", "garage:stall:accessNode", 0, -1)),
    "an unknown use": ("lane-graph", changed("Stalls", "garage:stall:use", 0, "bicycles")),
    "an edge to nowhere": ("lane-graph", changed("Edges", "garage:lane:to", 1, 99)),
    "a lane without a width": ("lane-graph", changed("Edges", "garage:lane:width", 1, math.nan)),
    "a node without widths": ("lane-graph", changed("Nodes", "garage:lane:widths", 3, Gf.Vec2f(math.inf, 1.0))),
    "a node of an unknown kind": ("lane-graph", changed("Nodes", "garage:lane:kind", 1, "roundabout")),
    "no lane graph": ("lane-graph", without_lane_graph),
    "no exit": ("exit-missing", changed("Nodes", "garage:lane:kind", 3, "entrance")),
    "no entrance": ("entrance-missing", changed("Nodes", "garage:lane:kind", 0, "exit")),
    "an entrance without a lane": (
        "portal-cut-off",
        all_of(changed("Edges", "garage:lane:from", 0, 1), changed("Edges", "garage:lane:to", 0, 2)),
    ),
    "a one-way lane the wrong way round": (
        "stall-route",
        all_of(
            changed("Edges", "garage:lane:from", 1, 2),
            changed("Edges", "garage:lane:to", 1, 1),
            changed("Edges", "garage:lane:direction", 1, "forward"),
        ),
    ),
    "a trolley before a mouth": ("swept-path", box(12.15, 0.0, 8.28, label="static", side=0.3)),
    "a sign before a mouth": ("swept-path", box(12.0, 0.0, 8.28, label="traffic_sign", side=0.3, scale=(1, 4, 1))),
    "a wall before a mouth": ("swept-path", box(12.15, 0.0, 8.28, label="wall", side=1.0, scale=(2.4, 3.2, 0.1))),
    "a bollard before a mouth": ("swept-path", box(12.4, 0.0, 8.28, label="bollard", side=0.3, scale=(1, 3, 1))),
    "a gate on the lane before a mouth": ("swept-path", box(12.15, 0.0, 9.6, label="barrier", side=1.5)),
    "a kerb before a mouth": ("swept-path", box(12.15, 0.0, 8.28, label="kerb", side=0.3, scale=(4.0, 0.4, 1.0))),
    "one hydrant alone": ("hydrant-cabinet-distance", without("HydrantCabinet", keep=1)),
    "no extinguisher": ("fire-extinguisher-distance", without("FireExtinguisher")),
    "a low duct": ("headroom", moved(f"{TILES}/Row_r01/Tile_r01_c02/Duct", y=-0.1)),
    "a pipe of another tool, hung too low": ("headroom", box(12.15, 1.9, 5.0, label="pipe")),
    "a high wheel stop": ("wheel-stop-height", moved(f"{STALL_1_1}/WheelStop_2", y=0.05)),
    "a high speed bump": ("speed-bump-height", moved(f"{TILES}/Row_r01/Tile_r01_c01/SpeedBump", y=0.03)),
    "a stall where the access aisle was": ("access-aisle", changed("Stalls", "garage:stall:use", 4, "standard")),
    "a shape without a label": ("unlabelled-shape", box(12.15, 2.6, 5.0)),
    "another unit": ("stage-units", in_centimetres),
    "another axis": ("stage-units", z_up),
    "an asset that is not there": ("usd-validation", missing_asset),
}


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
    (finding,) = [f for f in check(subject_of_stage(stage, source=""), PROFILE) if f.rule == "aisle-width"]
    assert (finding.place, finding.position_m) == ("[1, 1]-[1, 2]", (16.2, 12.15))
    assert (finding.measured, finding.required, finding.unit) == (4.0, 5.5, "m")
    assert finding.source == "JGJ 100-2015 (high)"


def test_a_stall_that_no_car_gets_into_is_named_with_what_is_in_the_way(stage):
    box(12.15, 0.0, 8.28, label="static", side=0.3)(stage)
    found = [f for f in check(subject_of_stage(stage, source=""), PROFILE) if f.rule == "swept-path"]
    assert [(f.place, f.position_m, f.severity, f.unit) for f in found] == [
        ("Stall_r00_c01_2", (12.15, 5.45), "error", "m")
    ]
    assert "; in the way: /Garage/Added, " in found[0].message
    # half the car and half the box
    assert found[0].required == 0.05
    assert -1.3 < found[0].measured < -0.9


@pytest.mark.parametrize("clear", [0.03, 2.1])
def test_what_is_flat_or_higher_than_the_car_is_in_no_cars_way(clear, stage):
    """A mat, and an arm at 2.1 m on a post beside the row of stalls."""
    if clear < 1:
        box(12.15, 0.0, 8.28, label="static", side=0.3, scale=(1.0, clear / 0.31, 1.0))(stage)
    else:
        box(12.15, clear, 8.28, label="static", side=0.3)(stage)
    assert "swept-path" not in rules_found(stage)


def test_what_another_rule_reports_is_not_reported_again(stage):
    """A column in one stall is in the way of its neighbours too, and a trolley at the mouth of the same stall."""
    all_of(moved(COLUMN, x=-4.05, z=-1.0), box(12.15, 0.0, 8.28, label="static", side=0.3))(stage)
    assert rules_found(stage) - FOUND_IN_GOOD_ONE == {"column-in-stall"}


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
    found = [f for f in check(subject_of_stage(stage, source=""), PROFILE) if f.rule == "swept-path"]
    assert [f.place for f in found] == ["Stall_r00_c01_2"]
    assert "; in the way: /Garage/Added, " in found[0].message


@pytest.mark.parametrize("far_m", [1e7, 1e200])
def test_what_lies_beyond_all_measure_is_named(far_m, stage):
    box(12.15, 0.0, 8.28, label="static", side=0.3)(stage)
    UsdGeom.Xformable(stage.GetPrimAtPath("/Garage/Added")).AddTranslateOp(opSuffix="far").Set((0, 0, far_m))
    with pytest.raises(StageError, match=r"/Garage/Added lies 1e\+\d+ m from the origin"):
        subject_of_stage(stage, source="")


def test_points_of_an_instancer_stand_where_they_are_drawn(stage):
    instancer = UsdGeom.PointInstancer.Define(stage, "/Garage/Cones")
    cone = UsdGeom.Cube.Define(stage, "/Garage/Cones/Prototypes/Cone")
    cone.CreateSizeAttr(0.4)
    UsdSemantics.LabelsAPI.Apply(cone.GetPrim(), "class").CreateLabelsAttr(["traffic_cone"])
    instancer.CreatePrototypesRel().SetTargets([cone.GetPath()])
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(3.0, 0.2, 3.0), (16.2, 0.2, 12.15)])
    found = [f for f in check(subject_of_stage(stage, source=""), PROFILE) if f.rule == "lane-blocked"]
    assert [(f.place, f.position_m) for f in found] == [("/Garage/Cones[1]", (16.2, 12.15))]


def test_a_stage_that_is_no_garage_is_said_to_have_no_lane_graph():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(stage.DefinePrim(Sdf.Path("/World"), "Xform"))
    assert "lane-graph" in rules_found(stage)
