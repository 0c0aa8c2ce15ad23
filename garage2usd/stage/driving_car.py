"""A car that drives a trajectory over time, in a layer over a garage's stage."""

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf

from garage2usd.assets import MATERIALS, NON_VISUAL, Asset, Part, finished, pascal_case
from garage2usd.assets.number_plates import painted_plates
from garage2usd.config.outputs import TextureQuality
from garage2usd.config.own_cars import OwnCar
from garage2usd.config.vehicles import DRIVEN_BODIES, DRIVEN_PAINT, DRIVEN_PLATE, CarBody
from garage2usd.driving import DesignCar
from garage2usd.driving.timing import Motion
from garage2usd.driving.trajectory import Trajectory
from garage2usd.objects.car import car_spec
from garage2usd.stage.authoring import attribute, define, new_layer, operation, order_operations
from garage2usd.stage.cameras import FRAMES_PER_SECOND, bends, set_frames
from garage2usd.stage.looks import TEXTURE_FOLDER, define_material, named_textures, textures_of
from garage2usd.stage.prototype_layer import define_mesh
from garage2usd.stage.prototypes import asset_of

CAR_NAME = "DrivingCar"
"""Name of the car below ``/Garage``."""
_PAINT = "car_paint"
_QUALITY = TextureQuality.HIGH
"""Texture quality, which affects only the user's models; their textures are used unchanged."""
_WHEEL_REACH_M, _WHEEL_MARGIN_M = 0.45, 0.01
"""Inward extent of wheels from a car's side, and tolerance of their radius, as their outline is a polygon."""
_TYPES = Sdf.ValueTypeNames


def body_within(car: DesignCar) -> CarBody:
    """Select the longest driving body that lies within a car, with the rear axles at the same place.

    Mirrors may protrude, as those of the design car do. If no body fits, the shortest is selected.
    """
    fitting = [body for body in DRIVEN_BODIES if _lies_within(body, car)]
    return (
        max(fitting, key=lambda body: body.length_m) if fitting else min(DRIVEN_BODIES, key=lambda body: body.length_m)
    )


def _lies_within(body: CarBody, car: DesignCar) -> bool:
    behind_m = body.length_m - body.ahead_m
    return body.ahead_m <= car.ahead_m and behind_m <= car.rear_overhang_m and body.width_m <= car.width_m


def write_driving_car(path: Path, motion: Motion, car: CarBody | None = None) -> tuple[Path, ...]:
    """Write a layer ``over /Garage`` with the car at ``/Garage/DrivingCar`` and its wheels below it.

    Parameters
    ----------
    path
        The file.
    motion
        Trajectory of the design car.
    car
        Visible car, of the catalogue or a model of the user; if left out, the result of `body_within`.

    Returns
    -------
    tuple of Path
        Textures beside the file that it refers to, which only a model of the user has.

    Notes
    -----
    24 frames per second, as in the stage, from frame 0. The car's origin is the centre of its rear axle on the floor.
    The wheels roll, and the front ones steer. Samples are left out where a value changes linearly, as USD interpolates.
    """
    last = math.ceil(motion.ends_s * FRAMES_PER_SECOND - 1e-6)
    frames = np.arange(last + 1)
    states = motion.at(frames / FRAMES_PER_SECOND)
    body = car or body_within(motion.car)
    with new_layer(path, default_prim="Garage") as layer:
        set_frames(layer, last)
        garage = Sdf.CreatePrimInLayer(layer, "/Garage")
        garage.specifier = Sdf.SpecifierOver
        place = garage.path.AppendChild(CAR_NAME)
        root = define(layer, place, "Xform", kind=Kind.Tokens.component, label=body.semantic_class.value)
        _author_drive(layer, root, states)
        _author_body(layer, root.path, body, states)
    return write_car_textures(path.parent, driven_asset(body))


def _author_drive(layer: Sdf.Layer, car: Sdf.PrimSpec, states: Trajectory) -> None:
    places = np.stack([states.x_m, states.y_m, states.z_m], axis=1)
    _sampled(layer, car, "translate", places)
    _sampled(layer, car, "rotateY", np.degrees(states.yaw_rad)[:, None])
    _sampled(layer, car, "rotateX", np.degrees(states.pitch_rad)[:, None])
    order_operations(car, ["translate", "rotateY", "rotateX"])
    for name in ("speed_m_s", "acceleration_m_s2", "steering_rad"):
        values = getattr(states, name)
        spec = attribute(car, f"garage:drive:{name.split('_', maxsplit=1)[0]}", _TYPES.Double, float(values[0]))
        for frame in bends(values[:, None]):
            layer.SetTimeSample(spec.path, float(frame), round(float(values[frame]), 6))


@lru_cache(maxsize=32)
def driven_asset(body: CarBody) -> Asset:
    """Return the asset of a driving car with its own number plates, in the axes of a parked car.

    Raises
    ------
    ConfigError
        If the file of a model of the user has changed since the settings were read.
    """
    asset = asset_of(car_spec(body, DRIVEN_PAINT))
    return replace(asset, parts=(*asset.parts, *painted_plates(body, DRIVEN_PLATE)))


def define_car_looks(layer: Sdf.Layer, car: Sdf.Path, asset: Asset) -> Sdf.Path:
    """Define the materials of a driving car below it; return the path of their scope.

    The layer refers to textures of a model of the user in the folder ``textures`` beside it, which `write_car_textures`
    writes.
    """
    looks = define(layer, car.AppendChild("Looks"), "Scope").path
    for key in sorted(asset.materials):
        # the paint of one variant; the material of the catalogue has no colour
        finish = finished(asset.paints[DRIVEN_PAINT] if key == _PAINT and asset.paints else key, asset.finishes)
        material = named_textures(finish.material, _QUALITY, folder=f"./{TEXTURE_FOLDER}")
        is_own = key in asset.finishes
        define_material(
            layer,
            looks.AppendChild(pascal_case(key)),
            material,
            non_visual=NON_VISUAL[finish.key if is_own else key],
            finish=finish.key if is_own else "",
        )
    return looks


def write_car_textures(folder: Path, asset: Asset) -> tuple[Path, ...]:
    """Write the textures of a driving car into the subfolder ``textures`` of a folder; return the files."""
    files = textures_of(asset.materials, asset.finishes, _QUALITY)
    if files:
        (folder / TEXTURE_FOLDER).mkdir(exist_ok=True)
    for file in files:
        (folder / TEXTURE_FOLDER / file.name).write_bytes(file.data)
    return tuple(folder / TEXTURE_FOLDER / file.name for file in files)


def _author_body(layer: Sdf.Layer, car: Sdf.Path, body: CarBody, states: Trajectory) -> None:
    asset = driven_asset(body)
    axle_m = body.rear_axle_m
    looks = define_car_looks(layer, car, asset)
    shell = define(layer, car.AppendChild("Body"), "Xform")
    operation(shell, "translate", _TYPES.Float3, Gf.Vec3f(0, 0, -axle_m))
    order_operations(shell, ["translate"])
    wheels: dict[tuple[int, int], list[Part]] = {}
    for part in asset.parts:
        turns = _turns(part, body)
        for corner, piece in _by_corner(part, turns, axle_m - body.wheelbase_m / 2):
            wheels.setdefault(corner, []).append(piece)
        if not turns.all():
            finish = finished(part.material, asset.finishes).material
            still = replace(part if not turns.any() else _with_faces(part, ~turns), collider=None)
            define_mesh(layer, shell.path.AppendChild(part.name), still, looks, finish=finish)
    rolled = np.concatenate([[0.0], np.cumsum(states.gear[1:] * np.diff(states.arc_m))])
    rolled_deg = -np.degrees(rolled / body.wheel_radius_m)
    for (side, end), parts in sorted(wheels.items()):
        name = f"{'Rear' if end > 0 else 'Front'}{'Right' if side > 0 else 'Left'}Wheel"
        wheel = define(layer, car.AppendChild(name), "Xform")
        points = np.concatenate([part.points for part in parts])
        hub = ((points.min(axis=0) + points.max(axis=0)) / 2).astype(np.float32)
        operation(wheel, "translate", _TYPES.Float3, Gf.Vec3f(float(hub[0]), float(hub[1]), float(hub[2]) - axle_m))
        order = ["translate"]
        if end < 0:
            _sampled(layer, wheel, "rotateY", np.degrees(states.steering_rad)[:, None])
            order.append("rotateY")
        _sampled(layer, wheel, "rotateX", rolled_deg[:, None])
        order_operations(wheel, [*order, "rotateX"])
        for part in parts:
            # in the catalogue, tyres and rims are identified by their materials
            moved = replace(part, points=part.points - hub, collider=None, pose=None)
            is_own = part.material in asset.finishes
            name = part.name if is_own else pascal_case(part.material)
            finish = finished(part.material, asset.finishes).material
            define_mesh(layer, wheel.path.AppendChild(name), moved, looks, finish=finish)


def _turns(part: Part, body: CarBody) -> NDArray[np.bool_]:
    """Find the faces of a part on a car's wheels: tyres and rims, or faces inside the wheels of a custom car."""
    if not isinstance(body, OwnCar):
        return np.full(len(part.face_counts), part.material in {"tyre", "rim"})
    x, y, z = part.points.astype(np.float64).T
    is_at_side = np.abs(x) > body.width_m / 2 - _WHEEL_REACH_M
    result = np.zeros(len(part.face_counts), dtype=np.bool_)
    for axle_z_m in (body.front_overhang_m - body.length_m / 2, body.rear_axle_m):
        is_inside = is_at_side & (
            np.hypot(y - body.wheel_radius_m, z - axle_z_m) < body.wheel_radius_m + _WHEEL_MARGIN_M
        )
        starts = np.cumsum(part.face_counts) - part.face_counts
        result |= np.logical_and.reduceat(is_inside[part.face_indices], starts)
    return result


def _by_corner(part: Part, turns: NDArray[np.bool_], middle_z_m: float) -> Iterator[tuple[tuple[int, int], Part]]:
    """Split the merged wheel mesh into one part per wheel, by the quadrant around the centre between the axles."""
    starts = np.cumsum(part.face_counts) - part.face_counts
    first = part.points[part.face_indices[starts]]
    corners = np.stack([np.sign(first[:, 0]), np.sign(first[:, 2] - middle_z_m)], axis=1).astype(int)
    for corner in np.unique(corners[turns], axis=0).tolist():
        yield (corner[0], corner[1]), _with_faces(part, turns & (corners == corner).all(axis=1))


def _with_faces(part: Part, faces: NDArray[np.bool_]) -> Part:
    """Select faces of a part, with the points, normals and texture coordinates that they use."""
    corners = np.repeat(faces, part.face_counts)
    used, indices = np.unique(part.face_indices[corners], return_inverse=True)
    normals, normal_indices = np.unique(part.normal_indices[corners], return_inverse=True)
    is_textured = len(part.st_indices) > 0 and part.material not in MATERIALS
    st, st_indices = np.unique(part.st_indices[corners] if is_textured else part.st_indices[:0], return_inverse=True)
    return replace(
        part,
        points=part.points[used],
        face_counts=part.face_counts[faces],
        face_indices=indices.astype(np.int32),
        normals=part.normals[normals],
        normal_indices=normal_indices.astype(np.int32),
        st=part.st[st],
        st_indices=st_indices.astype(np.int32),
    )


def _sampled(layer: Sdf.Layer, prim: Sdf.PrimSpec, name: str, values: NDArray[np.float64]) -> None:
    """Author a transform operation with samples at the frames where its values, shape (frames, n), change slope."""
    is_vector = values.shape[1] > 1

    def value(frame: int) -> object:
        row = np.round(values[frame], 6).tolist()
        return Gf.Vec3d(*row) if is_vector else row[0]

    spec = operation(prim, name, _TYPES.Double3 if is_vector else _TYPES.Double, value(0))
    for frame in bends(np.round(values, 6)):
        layer.SetTimeSample(spec.path, float(frame), value(frame))
