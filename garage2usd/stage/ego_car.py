"""A stage with an additional ego car at the origin, which the renderer moves."""

from pathlib import Path

from pxr import Gf, Sdf, Usd, UsdGeom

from garage2usd.assets import finished
from garage2usd.assets.cars import lit
from garage2usd.config.vehicles import CarBody
from garage2usd.scenes.values import metres_per_unit, metres_y_up
from garage2usd.stage.authoring import define, operation, order_operations, save_file
from garage2usd.stage.driving_car import CAR_NAME, define_car_looks, driven_asset, write_car_textures
from garage2usd.stage.lamp_lights import define_lamp_lights
from garage2usd.stage.prototype_layer import define_mesh

__all__ = ["EGO_PATH", "write_stage_with_car"]

EGO_PATH = "/EgoCar"
"""Path of the car's prim."""


def write_stage_with_car(path: Path, stage: Usd.Stage, car: CarBody, *, is_lit: bool = False) -> None:
    """Write a layer over a stage that adds a car at `EGO_PATH`.

    The centre of the rear axle on the floor is the origin, and the car faces -Z in a Y-up frame. An animated car in the
    stage, written by `garage2usd drive --animate`, is deactivated, as the ego car replaces it. If `is_lit`, the head
    and tail lamps glow and illuminate their surroundings.
    """
    layer = Sdf.Layer.CreateNew(str(path))
    if not stage.GetSessionLayer().empty:
        layer.TransferContent(stage.GetSessionLayer())
    layer.subLayerPaths.append(str(Path(stage.GetRootLayer().realPath)))
    with Sdf.ChangeBlock():
        layer.timeCodesPerSecond = stage.GetTimeCodesPerSecond()
        root = layer.pseudoRoot
        root.SetInfo(UsdGeom.Tokens.upAxis, UsdGeom.GetStageUpAxis(stage))
        root.SetInfo(UsdGeom.Tokens.metersPerUnit, metres_per_unit(stage))
        for prim in stage.GetPseudoRoot().GetChildren():
            driving = prim.GetPath().AppendChild(CAR_NAME)
            if stage.GetPrimAtPath(driving):
                over = Sdf.CreatePrimInLayer(layer, driving)
                over.specifier = Sdf.SpecifierOver
                over.active = False
        _author_car(layer, stage, car, is_lit=is_lit)
    save_file(layer, path)
    write_car_textures(path.parent, driven_asset(car))


def _author_car(layer: Sdf.Layer, stage: Usd.Stage, car: CarBody, *, is_lit: bool) -> None:
    root = define(layer, Sdf.Path(EGO_PATH), "Xform")
    operation(root, "transform", Sdf.ValueTypeNames.Matrix4d, Gf.Matrix4d(metres_y_up(stage)).GetInverse())
    order_operations(root, ["transform"])
    asset = lit(driven_asset(car)) if is_lit else driven_asset(car)
    looks = define_car_looks(layer, root.path, asset)
    body = define(layer, root.path.AppendChild("Body"), "Xform")
    operation(body, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(0, 0, -car.rear_axle_m))
    order_operations(body, ["translate"])
    for part in asset.parts:
        finish = finished(part.material, asset.finishes).material
        define_mesh(layer, body.path.AppendChild(part.name), part, looks, finish=finish)
    if is_lit:
        define_lamp_lights(layer, body.path, asset)
