"""A stage with an additional ego car at the origin, which the renderer moves, and the lights of its lamps."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux

from garage2usd.assets import Asset, Rgb
from garage2usd.assets.cars import lamps_of, lit
from garage2usd.assets.light import USUAL_LAMP_RGB
from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import DRIVEN_PAINT, CarBody
from garage2usd.reading.lights import luminance_of
from garage2usd.scenes.values import metres_per_unit, metres_y_up
from garage2usd.stage.authoring import apply_schemas, attribute, define, operation, order_operations, save_file
from garage2usd.stage.driving_car import CAR_NAME, driven_asset
from garage2usd.stage.moving_car import define_looks, define_parts, write_textures
from garage2usd.stage.prototype_layer import NITS_PER_INTENSITY

_TYPES = Sdf.ValueTypeNames
_AHEAD_M = 0.03
"""Distance of a light in front of its lens."""
_HEAD_LM = 700.0
"""Luminous flux of one head lamp's low beam."""
_CONE_DEG, _CUT_OFF_DEG, _SOFTNESS = 35.0, 0.6, 0.15
"""Half of the beam's angle, dip of its upper edge (1 %, ECE R48), and the share of the beam that fades. Assumptions
except for the dip: a real beam is flatter and wider."""
_TAIL_RGB: Rgb = (1.0, 0.02, 0.01)
_TAIL_CD, _TAIL_DOWN_DEG = 12.0, 20.0
"""Luminous intensity of a tail lamp, for which ECE R7 allows 4 to 17 candela, and its downward angle."""
EGO_PATH = "/EgoCar"
"""Path of the car's prim."""
AGENTS_PATH = "/Agents"
"""Path of the prim above other agents."""


class RestingAgent(NamedTuple):
    """An agent at the origin: path of its prim below `AGENTS_PATH`, its meshes in axes that face -Z, and its paint."""

    path: str
    asset: Asset
    paint: str = ""


class _Lamp(NamedTuple):
    """Light of a lamp: its part, the part in words, light type, radius, intensity on its axis, colour and dip."""

    part: str
    words: str
    type_name: str
    radius_m: float
    candela: float
    colour_rgb: Rgb
    down_deg: float


_LAMPS = {
    "Head": _Lamp(
        "lamp_front",
        "head lamps",
        "SphereLight",
        0.04,
        _HEAD_LM / (math.tau * (1 - math.cos(math.radians(_CONE_DEG)))),
        USUAL_LAMP_RGB,
        _CONE_DEG + _CUT_OFF_DEG,
    ),
    "Tail": _Lamp("lamp_rear", "tail lamps", "DiskLight", 0.06, _TAIL_CD, _TAIL_RGB, _TAIL_DOWN_DEG),
}


def lamp_places(asset: Asset) -> dict[str, NDArray[np.float64]]:
    """Return the light positions of a car's lamps, in front of the centre of the lenses on each side.

    Returns
    -------
    dict
        Positions in metres in the axes of the asset, shape (3,), by ``HeadLeft``, ``HeadRight``, ``TailLeft`` and
        ``TailRight``.

    Raises
    ------
    ConfigError
        If the car has no head lamps or no tail lamps, which can occur with a model of the user.
    """
    places = {}
    for end, lamp in _LAMPS.items():
        parts = lamps_of(asset, lamp.part)
        if not parts:
            raise ConfigError("lamps", "on", f"a car with parts or materials named as {lamp.words} are")
        points = np.concatenate([part.points for part in parts]).astype(np.float64)
        for name, side in (("Left", -1.0), ("Right", 1.0)):
            own = points[points[:, 0] * side > 0]
            x, y = own[:, :2].mean(axis=0)
            z = own[:, 2].max() + _AHEAD_M if end == "Tail" else own[:, 2].min() - _AHEAD_M
            places[f"{end}{name}"] = np.array((x, y, z))
    return places


def define_lamp_lights(layer: Sdf.Layer, car: Sdf.Path, asset: Asset) -> None:
    """Define a spot light for each head lamp and a red disc light for each pair of tail lenses, below a car's body."""
    for name, place in lamp_places(asset).items():
        lamp = _LAMPS[name[:4]]
        light = define(layer, car.AppendChild(f"{name}Light"), lamp.type_name)
        nit = lamp.candela / (math.pi * lamp.radius_m**2)
        brighter = luminance_of(USUAL_LAMP_RGB) / luminance_of(lamp.colour_rgb)
        attribute(light, "inputs:radius", _TYPES.Float, lamp.radius_m)
        attribute(light, "inputs:color", _TYPES.Color3f, Gf.Vec3f(*lamp.colour_rgb))
        attribute(light, "inputs:intensity", _TYPES.Float, nit / NITS_PER_INTENSITY * brighter)
        attribute(light, "inputs:normalize", _TYPES.Bool, value=False)
        if lamp.type_name == "SphereLight":
            apply_schemas(light, "ShapingAPI")
            attribute(light, UsdLux.Tokens.inputsShapingConeAngle, _TYPES.Float, _CONE_DEG)
            attribute(light, UsdLux.Tokens.inputsShapingConeSoftness, _TYPES.Float, _SOFTNESS)
        # lights shine along -Z, the forward axis of cars
        operation(light, "translate", _TYPES.Float3, Gf.Vec3f(*place.tolist()))
        operation(light, "rotateY", _TYPES.Float, 180.0 if lamp.part == "lamp_rear" else 0.0)
        operation(light, "rotateX", _TYPES.Float, -lamp.down_deg)
        order_operations(light, ["translate", "rotateY", "rotateX"])


def write_stage_with_car(
    path: Path, stage: Usd.Stage, car: CarBody, *, is_lit: bool = False, others: Sequence[RestingAgent] = ()
) -> None:
    """Write a layer over a stage that adds a car at `EGO_PATH`, and other agents at the origin.

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
        if others:
            _author_agents(layer, stage, others)
    save_file(layer, path)
    write_textures(path.parent, driven_asset(car), *(agent.asset for agent in others))


def _define_root(layer: Sdf.Layer, stage: Usd.Stage, path: str) -> Sdf.PrimSpec:
    """Define a prim whose axes are metres with Y up."""
    root = define(layer, Sdf.Path(path), "Xform")
    operation(root, "transform", Sdf.ValueTypeNames.Matrix4d, Gf.Matrix4d(metres_y_up(stage)).GetInverse())
    order_operations(root, ["transform"])
    return root


def _author_agents(layer: Sdf.Layer, stage: Usd.Stage, agents: Sequence[RestingAgent]) -> None:
    _define_root(layer, stage, AGENTS_PATH)
    for agent in agents:
        for place in Sdf.Path(agent.path).GetPrefixes()[1:]:
            define(layer, place, "Xform")
        define_parts(layer, place, agent.asset.parts, agent.asset, define_looks(layer, place, agent.asset, agent.paint))


def _author_car(layer: Sdf.Layer, stage: Usd.Stage, car: CarBody, *, is_lit: bool) -> None:
    root = _define_root(layer, stage, EGO_PATH)
    asset = lit(driven_asset(car)) if is_lit else driven_asset(car)
    looks = define_looks(layer, root.path, asset, DRIVEN_PAINT)
    body = define(layer, root.path.AppendChild("Body"), "Xform")
    operation(body, "translate", Sdf.ValueTypeNames.Float3, Gf.Vec3f(0, 0, -car.rear_axle_m))
    order_operations(body, ["translate"])
    define_parts(layer, body.path, asset.parts, asset, looks)
    if is_lit:
        define_lamp_lights(layer, body.path, asset)
