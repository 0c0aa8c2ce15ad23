"""Stages that others wrote, as they come with packages that the tests need, and small ones with one trap each."""

import importlib.util
from pathlib import Path

from pxr import Gf, Sdf, Usd, UsdGeom

__all__ = ["TRAPS", "installed_stages"]

PACKAGES = ("newton", "warp")
LARGEST_BYTES = 20_000_000


def installed_stages():
    """Paths of the stages in installed packages of others, each by a short name."""
    found = {}
    for package in PACKAGES:
        root = Path(importlib.util.find_spec(package).origin).parent
        for path in sorted(root.rglob("*.usd*")):
            if path.suffix in {".usd", ".usda", ".usdc", ".usdz"} and path.stat().st_size < LARGEST_BYTES:
                found[f"{package}/{path.relative_to(root).as_posix()}"] = path
    return found


def xform(stage, path, *, move=None, turn_deg=None, scale=None):
    prim = UsdGeom.Xform.Define(stage, path)
    if move:
        prim.AddTranslateOp().Set(Gf.Vec3d(*move))
    if turn_deg:
        prim.AddRotateXYZOp().Set(Gf.Vec3f(*turn_deg))
    if scale:
        prim.AddScaleOp().Set(Gf.Vec3f(*scale))
    return prim


def mesh(stage, path):
    """A tetrahedron that no symmetry maps onto itself."""
    shape = UsdGeom.Mesh.Define(stage, path)
    shape.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 2, 0), (0, 0, 3)])
    shape.CreateFaceVertexCountsAttr([3, 3, 3, 3])
    shape.CreateFaceVertexIndicesAttr([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3])
    return shape


def reset_in_the_open(stage):
    xform(stage, "/World", move=(100, 0, 0), turn_deg=(0, 30, 0))
    freed = xform(stage, "/World/Freed", move=(1, 2, 3))
    freed.SetResetXformStack(True)
    mesh(stage, "/World/Freed/Mesh")
    mesh(stage, "/World/Held")


def reset_under_a_label(stage):
    car = xform(stage, "/World/Car", move=(5, 0, 5), scale=(2, 1, 1))
    label(car.GetPrim(), "car")
    mesh(stage, "/World/Car/Body")
    wheel = xform(stage, "/World/Car/Wheel", move=(0, 1, 0))
    wheel.SetResetXformStack(True)
    mesh(stage, "/World/Car/Wheel/Mesh")


def reset_in_a_prototype(stage):
    part = stage.CreateClassPrim("/Part")
    mesh(stage, "/Part/Mesh")
    freed = xform(stage, "/Part/Freed", move=(0, 7, 0))
    freed.SetResetXformStack(True)
    mesh(stage, "/Part/Freed/Mesh")
    instances(stage, part, [(1, 0, 0), (2, 0, 0)])


def centimetres_and_z_up(stage):
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    xform(stage, "/World", move=(100, 200, 300), turn_deg=(10, 20, 30))
    freed = xform(stage, "/World/Freed", move=(50, 60, 70))
    freed.SetResetXformStack(True)
    mesh(stage, "/World/Freed/Mesh")
    mesh(stage, "/World/Mesh")


def time_samples(stage):
    stage.SetStartTimeCode(1)
    moving = UsdGeom.Xform.Define(stage, "/World/Moving").AddTranslateOp()
    moving.Set(Gf.Vec3d(9, 9, 9))
    for time in (10, 20):
        moving.Set(Gf.Vec3d(time, 0, 0), time)
    mesh(stage, "/World/Moving/Mesh")
    blinking = mesh(stage, "/World/Blinking").CreateVisibilityAttr()
    blinking.Set("invisible", 10)
    blinking.Set("inherited", 20)
    waking = mesh(stage, "/World/Waking").CreateVisibilityAttr()
    waking.Set("invisible")
    waking.Set("inherited", 5)
    mesh(stage, "/World/Still")


def purposes(stage):
    for purpose in ("default", "render", "proxy", "guide"):
        group = xform(stage, f"/World/{purpose}")
        group.CreatePurposeAttr(purpose)
        mesh(stage, f"/World/{purpose}/Inherits").AddTranslateOp().Set(Gf.Vec3d(len(purpose), 0, 0))
        for number, own in enumerate(("default", "render", "proxy", "guide")):
            shape = mesh(stage, f"/World/{purpose}/{own}")
            shape.CreatePurposeAttr(own)
            shape.AddTranslateOp().Set(Gf.Vec3d(len(purpose), number + 1, 0))


def purposes_of_instances(stage):
    part = stage.CreateClassPrim("/Part")
    mesh(stage, "/Part/Inherits")
    own = mesh(stage, "/Part/Own")
    own.CreatePurposeAttr("render")
    own.AddTranslateOp().Set(Gf.Vec3d(0, 5, 0))
    for number, prim in enumerate(instances(stage, part, [(k, 0, 0) for k in range(3)])):
        UsdGeom.Imageable(prim).CreatePurposeAttr(("default", "guide", "render")[number])


def hidden_parents(stage):
    UsdGeom.Imageable(xform(stage, "/World/Hidden")).MakeInvisible()
    below = mesh(stage, "/World/Hidden/Group/Mesh")
    below.CreateVisibilityAttr("inherited")
    stage.DefinePrim("/World/Typeless")
    mesh(stage, "/World/Typeless/Mesh").AddTranslateOp().Set(Gf.Vec3d(0, 0, 4))


def nested_instances(stage):
    bolt = stage.CreateClassPrim("/Bolt")
    mesh(stage, "/Bolt/Mesh").AddRotateXYZOp().Set(Gf.Vec3f(0, 0, 90))
    wheel = stage.CreateClassPrim("/Wheel")
    for number in range(3):
        placed(stage, f"/Wheel/Bolt{number}", bolt, (0, number, 1))
    mesh(stage, "/Wheel/Rim")
    car = stage.CreateClassPrim("/Car")
    for number in range(4):
        placed(stage, f"/Car/Wheel{number}", wheel, (number, 0, 0))
    for number, prim in enumerate(instances(stage, car, [(10, 0, 0), (20, 0, 0)])):
        label(prim, ("car", "truck")[number])


def labelled_parts_of_instances(stage):
    part = stage.CreateClassPrim("/Part")
    mesh(stage, "/Part/Body")
    lamp = mesh(stage, "/Part/Lamp")
    lamp.AddTranslateOp().Set(Gf.Vec3d(0, 1, 0))
    label(lamp.GetPrim(), "light")
    for prim in instances(stage, part, [(1, 0, 0), (2, 0, 0)])[:1]:
        label(prim, "car")


def point_instancers(stage, *, prototype="def"):
    xform(stage, "/World", move=(0, 0, 50), turn_deg=(0, 90, 0))
    points = UsdGeom.PointInstancer.Define(stage, "/World/Points")
    xform(stage, "/World/Points/Kinds", move=(0, 1000, 0))
    for number in range(2):
        path = f"/World/Points/Kinds/Kind{number}"
        if prototype == "over":
            stage.OverridePrim(path)
        elif prototype == "def":
            xform(stage, path, move=(0, number, 0.5), scale=(1, 2, 1))
        mesh(stage, f"{path}/Mesh").AddTranslateOp().Set(Gf.Vec3d(0.25, 0, 0))
        points.CreatePrototypesRel().AddTarget(path)
    points.CreateProtoIndicesAttr([0, 1, 1, 0])
    points.CreatePositionsAttr([(k, 0, 0) for k in range(4)])
    points.CreateOrientationsAttr([Gf.Quath(1), Gf.Quath(0.5, 0.5, 0.5, 0.5), Gf.Quath(1), Gf.Quath(0.6, 0, 0.8, 0)])
    points.CreateScalesAttr([(1, 1, 1), (2, 1, 1), (1, 1, 1), (1, 1, 3)])
    points.InvisId(2, Usd.TimeCode.Default())
    return points


def point_instancers_of_overs(stage):
    point_instancers(stage, prototype="over")


def point_instancers_in_instances(stage):
    shelf = stage.CreateClassPrim("/Shelf")
    points = UsdGeom.PointInstancer.Define(stage, "/Shelf/Cans")
    mesh(stage, "/Shelf/Cans/Can").AddTranslateOp().Set(Gf.Vec3d(0, 0, 0.5))
    points.CreatePrototypesRel().AddTarget("/Shelf/Cans/Can")
    points.CreateProtoIndicesAttr([0, 0])
    points.CreatePositionsAttr([(0, 1, 0), (0, 2, 0)])
    mesh(stage, "/Shelf/Board")
    instances(stage, shelf, [(3, 0, 0), (6, 0, 0)])


def instances_of_points(stage):
    wheel = stage.CreateClassPrim("/Wheel")
    mesh(stage, "/Wheel/Rim").AddTranslateOp().Set(Gf.Vec3d(0, 0.5, 0))
    points = UsdGeom.PointInstancer.Define(stage, "/World/Points")
    placed(stage, "/World/Points/Wheel", wheel, (0, 0, 2))
    points.CreatePrototypesRel().AddTarget("/World/Points/Wheel")
    points.CreateProtoIndicesAttr([0, 0])
    points.CreatePositionsAttr([(1, 0, 0), (2, 0, 0)])


def label(prim, word):
    prim.ApplyAPI("SemanticsLabelsAPI", "class")
    prim.CreateAttribute("semantics:labels:class", Sdf.ValueTypeNames.TokenArray).Set([word])


def placed(stage, path, part, move):
    prim = xform(stage, path, move=move).GetPrim()
    prim.GetReferences().AddInternalReference(part.GetPath())
    prim.SetInstanceable(True)
    return prim


def instances(stage, part, moves):
    xform(stage, "/World", move=(0, 0, -5), turn_deg=(0, 45, 0))
    return [placed(stage, f"/World/Instance{number}", part, move) for number, move in enumerate(moves)]


TRAPS = {
    make.__name__: make
    for make in (
        reset_in_the_open,
        reset_under_a_label,
        reset_in_a_prototype,
        centimetres_and_z_up,
        time_samples,
        purposes,
        purposes_of_instances,
        hidden_parents,
        nested_instances,
        labelled_parts_of_instances,
        point_instancers,
        point_instancers_of_overs,
        point_instancers_in_instances,
        instances_of_points,
    )
}
