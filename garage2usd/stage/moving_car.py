"""The prims of a car that moves, with wheels that turn, and values over time that USD interpolates linearly."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf

from garage2usd.assets import MATERIALS, NON_VISUAL, Asset, Part, finished, pascal_case
from garage2usd.config.outputs import TextureQuality
from garage2usd.config.own_cars import OwnCar
from garage2usd.config.vehicles import CarBody
from garage2usd.stage.authoring import define, operation, order_operations
from garage2usd.stage.looks import TEXTURE_FOLDER, define_material, named_textures, textures_of
from garage2usd.stage.prototype_layer import define_mesh

_PAINT = "car_paint"
_QUALITY = TextureQuality.HIGH
"""Texture quality, which affects only the user's models; their textures are used unchanged."""
_WHEEL_REACH_M, _WHEEL_MARGIN_M = 0.45, 0.01
"""Inward extent of wheels from a car's side, and tolerance of their radius, as their outline is a polygon."""
_TYPES = Sdf.ValueTypeNames


def define_looks(layer: Sdf.Layer, root: Sdf.Path, asset: Asset, paint: str = "") -> Sdf.Path:
    """Define the materials of an asset below a prim, of a car in one of its paints; return the path of their scope.

    The layer refers to textures in the folder ``textures`` beside it, which `write_textures` writes.
    """
    looks = define(layer, root.AppendChild("Looks"), "Scope").path
    for key in sorted(asset.materials):
        # the paint of one variant; the material of the catalogue has no colour
        finish = finished(asset.paints[paint] if key == _PAINT and asset.paints else key, asset.finishes)
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


def write_textures(folder: Path, *assets: Asset) -> tuple[Path, ...]:
    """Write the textures of assets of `define_looks` into the subfolder ``textures`` of a folder; return the files."""
    files = sorted({file for asset in assets for file in textures_of(asset.materials, asset.finishes, _QUALITY)})
    if files:
        (folder / TEXTURE_FOLDER).mkdir(exist_ok=True)
    for file in files:
        (folder / TEXTURE_FOLDER / file.name).write_bytes(file.data)
    return tuple(folder / TEXTURE_FOLDER / file.name for file in files)


def define_parts(layer: Sdf.Layer, root: Sdf.Path, parts: Sequence[Part], asset: Asset, looks: Sdf.Path) -> None:
    """Define the meshes of parts of an asset, without colliders, below a prim."""
    for part in parts:
        finish = finished(part.material, asset.finishes).material
        define_mesh(layer, root.AppendChild(part.name), replace(part, collider=None), looks, finish=finish)


def define_car(
    layer: Sdf.Layer,
    car: Sdf.Path,
    body: CarBody,
    asset: Asset,
    *,
    paint: str,
    turned: Callable[[Sdf.PrimSpec, bool], Sequence[str]],
) -> None:
    """Define body, wheels and materials of a car below a prim whose origin is the centre of its rear axle on the floor.

    Parameters
    ----------
    layer, car
        The layer, and the path of the prim.
    body, asset, paint
        The car: its measures, its meshes in the axes of a parked car, and the paint.
    turned
        Authors the operations that turn a wheel, given its prim and True for a front wheel; returns their names.
    """
    axle_m = body.rear_axle_m
    looks = define_looks(layer, car, asset, paint)
    shell = define(layer, car.AppendChild("Body"), "Xform")
    operation(shell, "translate", _TYPES.Float3, Gf.Vec3f(0, 0, -axle_m))
    order_operations(shell, ["translate"])
    wheels: dict[tuple[int, int], list[Part]] = {}
    for part in asset.parts:
        turns = _turns(part, body)
        for corner, piece in _by_corner(part, turns, axle_m - body.wheelbase_m / 2):
            wheels.setdefault(corner, []).append(piece)
        if not turns.all():
            define_parts(layer, shell.path, [part if not turns.any() else _with_faces(part, ~turns)], asset, looks)
    for (side, end), parts in sorted(wheels.items()):
        name = f"{'Rear' if end > 0 else 'Front'}{'Right' if side > 0 else 'Left'}Wheel"
        wheel = define(layer, car.AppendChild(name), "Xform")
        points = np.concatenate([part.points for part in parts])
        hub = ((points.min(axis=0) + points.max(axis=0)) / 2).astype(np.float32)
        operation(wheel, "translate", _TYPES.Float3, Gf.Vec3f(float(hub[0]), float(hub[1]), float(hub[2]) - axle_m))
        order_operations(wheel, ["translate", *turned(wheel, end < 0)])
        for part in parts:
            # in the catalogue, tyres and rims are identified by their materials
            own_name = part.name if part.material in asset.finishes else pascal_case(part.material)
            moved = replace(part, name=own_name, points=part.points - hub, pose=None)
            define_parts(layer, wheel.path, [moved], asset, looks)


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
