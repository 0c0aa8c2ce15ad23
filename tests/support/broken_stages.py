"""The stage of the small garage with one thing edited, as another tool might, and the rule meant for it."""

import math

import numpy as np
from pxr import Gf, UsdGeom, UsdSemantics, Vt

GRAPH = "/Garage/LaneGraph"
TILES = "/Garage/Tiles"
STALL_1_1 = f"{TILES}/Row_r00/Tile_r00_c01"


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
    "an asset that is not there": ("usd-validation", missing_asset),
}
