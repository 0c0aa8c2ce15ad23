"""A garage of twelve squares, for checks that break one thing at a time."""

from pxr import Usd, UsdGeom, UsdSemantics

PLAN = """
....
E==X
....
"""
SETTINGS = {
    "seed": 2,
    "site": {"structure": PLAN},
    "bay": {"dimensioned": False},
    "parking": {"accessible_share": 0.1, "occupancy": 0.5, "occupied_stalls": ["Stall_r00_c01_1", "Stall_r02_c02_3"]},
    "fittings": {"speed_bump_rate": 1.0, "cone_rate": 0.0},
    "stage": {"texture_quality": "low"},
}


def with_trolley(stage_path, path, *, label=None):
    """Write the garage with a cube of a metre in the way of a stall."""
    stage = Usd.Stage.Open(str(stage_path))
    stage.SetEditTarget(stage.GetSessionLayer())
    cube = UsdGeom.Cube.Define(stage, "/Garage/Trolley")
    cube.CreateSizeAttr(1.0)
    cube.AddTranslateOp().Set((12.15, 0.5, 5.0))
    if label is not None:
        UsdSemantics.LabelsAPI.Apply(cube.GetPrim(), "class").CreateLabelsAttr([label])
    stage.Export(str(path))
    return path
