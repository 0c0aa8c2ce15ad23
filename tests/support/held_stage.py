"""A garage that another stage holds, in other units and axes."""

from pxr import Gf, Usd, UsdGeom


def held_aloft(stage, folder):
    """A stage in centimetres with Z up that holds a garage 3 m to the east, 2 m to the south and 4.5 m up."""
    over = Usd.Stage.CreateNew(str(folder / "over.usda"))
    UsdGeom.SetStageUpAxis(over, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(over, 0.01)
    held = UsdGeom.Xform.Define(over, "/Held")
    held.AddTranslateOp().Set(Gf.Vec3d(300.0, -200.0, 450.0))
    held.AddScaleOp().Set(Gf.Vec3f(100.0))
    held.AddRotateXOp().Set(90.0)
    held.GetPrim().GetReferences().AddReference(stage.GetRootLayer().realPath)
    over.SetDefaultPrim(held.GetPrim())
    return over
