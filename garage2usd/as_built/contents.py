"""Objects and lights of a stage, in metres, Y up, and the meshes of an object that is placed many times."""

from collections.abc import Collection, Hashable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import repeat
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, UsdPhysics, Vt

from garage2usd.as_built.shapes import Array, Body, MeshShape, Thing, box_shape
from garage2usd.assets.light import USUAL_LAMP_RGB
from garage2usd.common.errors import StageError
from garage2usd.objects import PIECE_LABELS
from garage2usd.reading.lights import DOMES, LIGHT_TYPES, LightSource, light_of, luminance_of
from garage2usd.scenes.prims import PlacedObject, once_for_each_look
from garage2usd.scenes.values import READ_AT, metres_per_unit, metres_y_up, opinions_of
from garage2usd.scenes.walk import placed_objects
from garage2usd.stage.prototype_layer import NITS_PER_INTENSITY

_DIGITS = 12
"""Digits of a mesh's place in its object: what sines and cosines of half a turn have beyond is noise."""
_FARTHEST_M = 1e6
_CALIBRATED = "garage:light:luminance"
"""Attribute that marks lights written by this program, whose intensities are scaled."""
_NOWHERE = "DistantLight"


@dataclass(frozen=True, eq=False)
class Model:
    """Meshes of an object in its own coordinates, of which there may be many in a garage.

    Attributes
    ----------
    bodies
        The meshes, placed in the object.
    """

    bodies: tuple[Body, ...]

    @cached_property
    def _matrices(self) -> Array | None:
        """Place of each mesh; None if all are in the axes of the object, as most are."""
        matrices = np.round([body.matrix for body in self.bodies], _DIGITS).reshape(-1, 4, 4)
        return None if (matrices == np.eye(4)).all() else matrices

    def placed(self, matrix: Array) -> tuple[Body, ...]:
        """Return the meshes of an object that a matrix places, for row vectors; float64, shape (4, 4)."""
        places = repeat(matrix) if self._matrices is None else self._matrices @ matrix
        return tuple(
            Body(shape, place, touches) for (shape, _, touches), place in zip(self.bodies, places, strict=False)
        )


class PlacedLight(NamedTuple):
    """A light with a position.

    Attributes
    ----------
    matrix
        From its coordinates to the world's, for row vectors.
    source
        Intensity and size of the light.
    nits_per_unit
        Factor on the intensity of a white light of the source, from its colour and the meaning of an intensity of 1.
    """

    matrix: Array
    source: LightSource
    nits_per_unit: float


@dataclass(frozen=True, eq=False)
class Contents:
    """Objects and lights of a stage."""

    things: tuple[Thing, ...]
    lights: tuple[PlacedLight, ...]


def read_contents(stage: Usd.Stage, objects: Iterable[PlacedObject] | None = None) -> Contents:
    """Read all objects of a stage with their meshes, and its lights except suns and skies, which are outside.

    Parameters
    ----------
    stage
        The stage.
    objects
        Result of `garage2usd.scenes.walk.placed_objects` in metres, Y up, if already known.

    Notes
    -----
    For the definition of an object see `garage2usd.scenes.walk.placed_objects`. A prim with a class of pieces, such as
    paint, counts as part of the object above it: paint is floor.

    Raises
    ------
    StageError
        If something is more than 1000 km from the origin, where geometry loses millimetre precision.
    """
    things: dict[str, Thing] = {}
    lights: list[PlacedLight] = []
    units = metres_per_unit(stage)
    look_of = once_for_each_look(partial(_look, shapes=_Shapes()))
    if objects is None:
        objects = placed_objects(stage, metres_y_up(stage), with_looks=False)
    for placed in objects:
        look = look_of(placed)
        lights += [placed_light(light, matrix @ placed.matrix, units) for light, matrix in look.lights]
        if look.model.bodies:
            bodies = look.model.placed(placed.matrix)
            whole = _whole(placed, things)
            if whole is None:
                things[placed.path] = Thing(placed.path, placed.label, bodies)
            else:
                things[whole.name] = replace(whole, bodies=whole.bodies + bodies)
    _check_reach(stage, things.values(), lights)
    return Contents(tuple(things.values()), tuple(lights))


def _whole(placed: PlacedObject, things: Mapping[str, Thing]) -> Thing | None:
    """Return the object that contains a labelled piece, such as the floor under paint; None for other objects."""
    if placed.label not in PIECE_LABELS:
        return None
    path = placed.path
    while path and path not in things:
        path = path.rpartition("/")[0]
    return things.get(path)


class _Look(NamedTuple):
    """Meshes and lights of an object in its own space."""

    model: Model
    lights: list[tuple[Usd.Prim, Array]]


def _look(placed: PlacedObject, shapes: "_Shapes") -> _Look:
    bodies: list[Body] = []
    lights: list[tuple[Usd.Prim, Array]] = []
    for prim, _, matrix, _ in placed.parts:
        if prim.GetTypeName() in LIGHT_TYPES - DOMES - {_NOWHERE}:
            lights.append((prim, matrix))
        elif prim.IsA(UsdGeom.Gprim):
            shape = shapes.of(prim)
            if shape is not None:
                bodies.append(Body(shape, matrix, prim.HasAPI(UsdPhysics.CollisionAPI)))
    return _Look(Model(tuple(bodies)), lights)


class _Shapes:
    """Cache of prims' meshes; equal meshes are shared, so that their properties are computed once."""

    def __init__(self) -> None:
        self._of_opinions: dict[Hashable, MeshShape | None] = {}
        self._known: dict[tuple[bytes, ...], MeshShape] = {}

    def of(self, prim: Usd.Prim) -> MeshShape | None:
        """Return the mesh of a prim."""
        key = opinions_of(prim)
        if key not in self._of_opinions:
            shape = _shape(prim)
            if shape is not None:
                arrays = shape.points, shape.counts, shape.indices
                shape = self._known.setdefault(tuple(array.tobytes() for array in arrays), shape)
            self._of_opinions[key] = shape
        return self._of_opinions[key]


def _check_reach(stage: Usd.Stage, things: Collection[Thing], lights: list[PlacedLight]) -> None:
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
    """Return the mesh of a prim, or the bounding box of any other shape; None without points and extent."""
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


def placed_light(prim: Usd.Prim, matrix: Array, metres_per_unit: float) -> PlacedLight:
    """Read a light of `garage2usd.reading.lights.LIGHT_TYPES`, with the meaning that the stage gives to its intensity.

    `matrix` leads from its space to metres with Y up.
    """
    attribute = prim.GetAttribute(_CALIBRATED)
    is_ours = attribute and attribute.HasAuthoredValue()
    scale = NITS_PER_INTENSITY / luminance_of(USUAL_LAMP_RGB) if is_ours else 1.0
    source = light_of(prim, matrix, metres_per_unit)
    return PlacedLight(matrix, source, scale * source.brightness)
