"""All objects and lights of a stage in metres, Y up, as the rules look at them."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdPhysics, Vt

from garage2usd.checks.shapes import Array, Body, MeshShape, Thing, box_shape
from garage2usd.errors import StageError
from garage2usd.reading.objects import PlacedObject, once_for_each_look
from garage2usd.reading.values import READ_AT, metres_y_up, number_of
from garage2usd.reading.walk import placed_objects

__all__ = ["Contents", "PlacedLight", "read_contents"]

_FARTHEST_M = 1e6
_LUMINANCE = "garage:light:luminance"


class PlacedLight(NamedTuple):
    """A rectangle that shines down.

    Attributes
    ----------
    matrix
        From its coordinates to the world's, for row vectors.
    width_m, height_m
        Its extent.
    luminance_nit
        cd/m2.
    """

    matrix: Array
    width_m: float
    height_m: float
    luminance_nit: float


@dataclass(frozen=True, eq=False)
class Contents:
    """What stands, hangs and shines on a stage."""

    things: tuple[Thing, ...]
    lights: tuple[PlacedLight, ...]


def read_contents(stage: Usd.Stage) -> Contents:
    """Read all objects of a stage, each with its meshes, and its rectangular lights.

    Notes
    -----
    See `garage2usd.reading.walk.placed_objects` for what an object is.

    Raises
    ------
    StageError
        If something lies more than 1000 km from the origin, where geometry loses its millimetres.
    """
    things: list[Thing] = []
    lights: list[PlacedLight] = []
    shape_of = cache(_shape)
    look_of = once_for_each_look(lambda placed: _look(placed, shape_of))
    for placed in placed_objects(stage, metres_y_up(stage)):
        look = look_of(placed)
        lights += [_light(light, matrix @ placed.matrix) for light, matrix in look.lights]
        if look.bodies:
            bodies = (Body(shape, matrix @ placed.matrix, touches) for shape, matrix, touches in look.bodies)
            things.append(Thing(placed.path, placed.label, tuple(bodies)))
    _check_reach(stage, things, lights)
    return Contents(tuple(things), tuple(lights))


class _Look(NamedTuple):
    """What an object consists of in its own space."""

    bodies: list[Body]
    lights: list[tuple[UsdLux.RectLight, Array]]


def _look(placed: PlacedObject, shape_of: Callable[[Usd.Prim], MeshShape | None]) -> _Look:
    look = _Look([], [])
    for prim, _, matrix in placed.parts:
        if prim.IsA(UsdLux.RectLight):
            look.lights.append((UsdLux.RectLight(prim), matrix))
        elif prim.IsA(UsdGeom.Gprim):
            shape = shape_of(prim)
            if shape is not None:
                look.bodies.append(Body(shape, matrix, prim.HasAPI(UsdPhysics.CollisionAPI)))
    return look


def _check_reach(stage: Usd.Stage, things: list[Thing], lights: list[PlacedLight]) -> None:
    placed = [(thing.name, body.matrix, body.shape.reach) for thing in things for body in thing.bodies]
    placed += [("a light", light.matrix, 0.0) for light in lights]
    if not placed:
        return
    matrices = np.abs([matrix for _, matrix, _ in placed])
    sizes = np.array([size for *_, size in placed])
    reach_m = (matrices[:, :3, :3].sum(axis=1) * sizes[:, None] + matrices[:, 3, :3]).max(axis=1)
    far = np.flatnonzero(~(reach_m <= _FARTHEST_M))  # as NaN is
    if len(far):
        name = placed[far[0]][0]
        raise StageError(stage.GetRootLayer().realPath, f"{name} lies {reach_m[far[0]]:.3g} m from the origin")


def _shape(prim: Usd.Prim) -> MeshShape | None:
    """The mesh of a prim, or the box around any other shape; None where it has neither points nor extent."""
    if prim.IsA(UsdGeom.Mesh):
        mesh = UsdGeom.Mesh(prim)
        arrays = (
            mesh.GetPointsAttr().Get(READ_AT),
            mesh.GetFaceVertexCountsAttr().Get(READ_AT),
            mesh.GetFaceVertexIndicesAttr().Get(READ_AT),
        )
        if any(array is None or not len(array) for array in arrays):
            return None
        points, counts, indices = (np.asarray(array) for array in arrays)
        if not np.isfinite(points).all():
            return None
        if counts.sum() != len(indices) or counts.min() < 1 or indices.min() < 0 or indices.max() >= len(points):
            return None
        return MeshShape(points.astype(np.float64), counts.astype(np.int64), indices.astype(np.int64))
    if prim.IsA(UsdGeom.Curves) or prim.IsA(UsdGeom.Points):
        return None
    extent = UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), READ_AT)
    return box_shape(*_corners(extent)) if extent and np.isfinite(np.asarray(extent)).all() else None


def _corners(extent: Vt.Vec3fArray) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    low, high = (np.array(Gf.Vec3d(corner)) for corner in extent)
    return low, high


def _light(light: UsdLux.RectLight, matrix: Array) -> PlacedLight:
    width_m, height_m = (
        number_of(attribute) * float(np.linalg.norm(matrix[row, :3]))
        for row, attribute in enumerate((light.GetWidthAttr(), light.GetHeightAttr()))
    )
    luminance = light.GetPrim().GetAttribute(_LUMINANCE)
    return PlacedLight(matrix, width_m, height_m, number_of(luminance) if luminance else 0.0)
