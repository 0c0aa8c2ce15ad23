"""Stages that someone edited: a layer over a stage, or a stage that refers to it."""

from pxr import Gf, Sdf, Usd, UsdGeom

READ = ("Ramps", "LaneGraph")
"""Groups of a level that its lanes and ramps are read from."""


def edited(source, path, *edits):
    """Write a layer over a stage with some edits."""
    layer = Sdf.Layer.CreateNew(str(path))
    layer.subLayerPaths.append(str(source))
    below = Sdf.Layer.FindOrOpen(str(source))
    layer.defaultPrim = below.defaultPrim
    stage = Usd.Stage.Open(layer)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    for edit in edits:
        edit(stage)
    layer.Save()
    return path


def referring(source, path, *, up="Y", metres_per_unit=1.0, move=(0.0, 0.0, 0.0), yaw_deg=0.0):
    """Write a stage that refers to another one, moved and turned, with axes and units of its own."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, metres_per_unit)
    UsdGeom.SetStageUpAxis(stage, up)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/World").GetPrim())
    garage = UsdGeom.Xform.Define(stage, "/World/Site/Building")
    garage.GetPrim().GetReferences().AddReference(str(source))
    garage.AddTranslateOp().Set(Gf.Vec3d(*move))
    (garage.AddRotateZOp() if up == "Z" else garage.AddRotateYOp()).Set(yaw_deg)
    if up == "Z":
        garage.AddRotateXOp(opSuffix="up").Set(90.0)
    garage.AddScaleOp().Set(Gf.Vec3f(1 / metres_per_unit))
    stage.GetRootLayer().Save()
    return path


def without_what_lanes_do_without(stage):
    """Deactivate most objects of each level, which are read slowly."""
    for level in stage.GetPrimAtPath("/Garage/Levels").GetChildren():
        for group in level.GetChildren():
            if group.GetName() not in READ:
                group.SetActive(False)


def moved(*, x=0.0, y=0.0, z=0.0, yaw_deg=0.0, pitch_deg=0.0, path="/Garage"):
    """Return an edit that moves and turns a prim."""

    def edit(stage):
        place = UsdGeom.Xformable(stage.GetPrimAtPath(path))
        place.AddTranslateOp(opSuffix="edit").Set(Gf.Vec3d(x, y, z))
        place.AddRotateXYZOp(opSuffix="edit").Set(Gf.Vec3f(pitch_deg, yaw_deg, 0.0))

    return edit


def scaled(factor, path="/Garage"):
    """Return an edit that scales a prim."""

    def edit(stage):
        UsdGeom.Xformable(stage.GetPrimAtPath(path)).AddScaleOp(opSuffix="edit").Set(Gf.Vec3f(factor))

    return edit


def inactive(*paths):
    """Return an edit that deactivates prims."""

    def edit(stage):
        for path in paths:
            stage.GetPrimAtPath(path).SetActive(False)

    return edit


def hidden(*paths):
    """Return an edit that hides prims."""

    def edit(stage):
        for path in paths:
            UsdGeom.Imageable(stage.GetPrimAtPath(path)).MakeInvisible()

    return edit


def chosen(**variants):
    """Return an edit that selects variants of the garage."""

    def edit(stage):
        for name, choice in variants.items():
            stage.GetPrimAtPath("/Garage").GetVariantSet(name).SetVariantSelection(choice)

    return edit


def copied(level, name, height_m):
    """Return an edit that copies a level to another height."""

    def edit(stage):
        below = stage.GetRootLayer().subLayerPaths[0]
        copy = stage.DefinePrim(f"/Garage/Levels/{name}")
        copy.GetReferences().AddReference(below, f"/Garage/Levels/{level}")
        copy.GetAttribute("xformOp:translate").Set(Gf.Vec3f(0, height_m, 0))

    return edit
