"""All objects and lights of a stage in metres, Y up, whatever its units and form."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom, UsdLux, UsdPhysics, Vt

from garage2usd.checks.shapes import Array, Body, Shape, Thing, box_shape
from garage2usd.errors import StageError
from garage2usd.stage.reading import metres_y_up, number_of
from garage2usd.stage.taxonomy import label_of

__all__ = ["RectLight", "Scene", "read_scene"]

_FARTHEST_M = 1e6
_LUMINANCE = "garage:light:luminance"


class RectLight(NamedTuple):
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
class Scene:
    """What stands, hangs and shines on a stage."""

    things: tuple[Thing, ...]
    lights: tuple[RectLight, ...]


class _Entry(NamedTuple):
    """A mesh or a light below a prim: to which object it belongs, and where it is."""

    thing: str
    label: str
    matrix: Array
    shape: Shape | None
    touches: bool
    light: tuple[float, float, float] | None


def read_scene(stage: Usd.Stage) -> Scene:
    """Read all labelled objects, each with its meshes, and what is not labelled, mesh by mesh.

    Notes
    -----
    What is drawn by a shared prototype is read once. Guides, and what is hidden, is left out.

    Raises
    ------
    StageError
        If something lies more than 1000 km from the origin, where geometry loses its millimetres.
    """
    reader = _Reader()
    things: dict[str, tuple[str, list[Body]]] = {}
    lights = []
    entries = list(reader.below(stage.GetPseudoRoot(), metres_y_up(stage), "", ""))
    _check_reach(stage, entries)
    for entry in entries:
        if entry.light is not None:
            lights.append(RectLight(entry.matrix, *entry.light))
        if entry.shape is not None:
            _, bodies = things.setdefault(entry.thing, (entry.label, []))
            bodies.append(Body(entry.shape, entry.matrix, entry.touches))
    return Scene(
        tuple(Thing(name, label, tuple(bodies)) for name, (label, bodies) in things.items()),
        tuple(lights),
    )


def _check_reach(stage: Usd.Stage, entries: list[_Entry]) -> None:
    if not entries:
        return
    matrices = np.abs([entry.matrix for entry in entries])
    sizes = np.array([0.0 if entry.shape is None else entry.shape.reach for entry in entries])
    reach_m = (matrices[:, :3, :3].sum(axis=1) * sizes[:, None] + matrices[:, 3, :3]).max(axis=1)
    far = np.flatnonzero(~(reach_m <= _FARTHEST_M))  # as NaN is
    if len(far):
        prim = entries[far[0]].thing or "a light"
        raise StageError(stage.GetRootLayer().realPath, f"{prim} lies {reach_m[far[0]]:.3g} m from the origin")


class _Reader:
    def __init__(self) -> None:
        self._prototypes: dict[str, list[_Entry]] = {}

    def below(self, prim: Usd.Prim, matrix: Array, thing: str, label: str) -> Iterator[_Entry]:
        """The meshes and lights of a prim and of all below it.

        Parameters
        ----------
        prim
            Where to begin; not a proxy.
        matrix
            From the coordinates of its parent to the world's.
        thing, label
            The object that it is part of; empty if none.
        """
        imageable = UsdGeom.Imageable(prim)
        if imageable and (
            imageable.GetPurposeAttr().Get() == UsdGeom.Tokens.guide
            or imageable.GetVisibilityAttr().Get() == UsdGeom.Tokens.invisible
        ):
            return
        own = label_of(prim)
        if own:
            thing, label = str(prim.GetPath()), own
        matrix = _placed(prim, matrix)
        if prim.IsInstance():
            for entry in self._in_prototype(prim.GetPrototype()):
                yield _moved(entry, matrix, str(prim.GetPath()), thing, label)
            return
        if prim.IsA(UsdGeom.PointInstancer):
            yield from self._points(UsdGeom.PointInstancer(prim), matrix, label)
            return
        if prim.IsA(UsdGeom.Gprim):
            shape = _shape(prim)
            if shape is not None:
                touches = prim.HasAPI(UsdPhysics.CollisionAPI)
                yield _Entry(thing or str(prim.GetPath()), label, matrix, shape, touches, None)
        elif prim.IsA(UsdLux.RectLight):
            yield _Entry(thing, label, matrix, None, touches=False, light=_light(UsdLux.RectLight(prim), matrix))
        for child in prim.GetChildren():
            yield from self.below(child, matrix, thing, label)

    def _in_prototype(self, prototype: Usd.Prim) -> list[_Entry]:
        """What is in a prototype, with names that begin at its root and in its own coordinates."""
        path = str(prototype.GetPath())
        if path not in self._prototypes:
            entries = [entry for child in prototype.GetChildren() for entry in self.below(child, np.eye(4), "", "")]
            self._prototypes[path] = [
                entry._replace(thing=entry.thing.removeprefix(path) if entry.label else "") for entry in entries
            ]
        return self._prototypes[path]

    def _points(self, instancer: UsdGeom.PointInstancer, matrix: Array, label: str) -> Iterator[_Entry]:
        """What a point instancer draws; each point is an object of its own."""
        stage, path = instancer.GetPrim().GetStage(), str(instancer.GetPath())
        numbers = instancer.GetProtoIndicesAttr().Get() or ()
        places = instancer.ComputeInstanceTransformsAtTime(
            Usd.TimeCode.Default(), Usd.TimeCode.Default(), UsdGeom.PointInstancer.IncludeProtoXform
        )
        shapes = []
        for target in instancer.GetPrototypesRel().GetForwardedTargets():
            prim = stage.GetPrimAtPath(target)
            # the instancer's transforms hold the prototype's own already
            back = np.linalg.pinv(_placed(prim, np.eye(4))) if prim else np.eye(4)
            entries = self.below(prim, np.eye(4), "", "") if prim else ()
            shapes.append([entry._replace(matrix=entry.matrix @ back) for entry in entries])
        for index, (number, place) in enumerate(zip(numbers, places or (), strict=False)):
            for entry in shapes[number] if 0 <= number < len(shapes) else ():
                to_world = np.array(place) @ matrix
                yield entry._replace(
                    thing=f"{path}[{index}]", label=entry.label or label, matrix=entry.matrix @ to_world
                )


def _moved(entry: _Entry, matrix: Array, path: str, thing: str, label: str) -> _Entry:
    """An entry of a prototype as an instance at `path` has it."""
    moved = entry.matrix @ matrix
    if entry.label:
        return entry._replace(thing=path + entry.thing, matrix=moved)
    return entry._replace(thing=thing or path, label=label, matrix=moved)


def _placed(prim: Usd.Prim, matrix: Array) -> Array:
    xformable = UsdGeom.Xformable(prim)
    if not xformable:
        return matrix
    local = np.array(xformable.GetLocalTransformation())
    if not np.isfinite(local).all():
        return matrix
    return local if xformable.GetResetXformStack() else local @ matrix


def _shape(prim: Usd.Prim) -> Shape | None:
    """The mesh of a prim, or the box around any other shape; None where it has neither points nor extent."""
    if prim.IsA(UsdGeom.Mesh):
        mesh = UsdGeom.Mesh(prim)
        arrays = (
            mesh.GetPointsAttr().Get(),
            mesh.GetFaceVertexCountsAttr().Get(),
            mesh.GetFaceVertexIndicesAttr().Get(),
        )
        if any(array is None or not len(array) for array in arrays):
            return None
        points, counts, indices = (np.asarray(array) for array in arrays)
        if not np.isfinite(points).all():
            return None
        if counts.sum() != len(indices) or counts.min() < 1 or indices.min() < 0 or indices.max() >= len(points):
            return None
        return Shape(points.astype(np.float64), counts.astype(np.int64), indices.astype(np.int64))
    if prim.IsA(UsdGeom.Curves) or prim.IsA(UsdGeom.Points):
        return None
    extent = UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), Usd.TimeCode.Default())
    return box_shape(*_corners(extent)) if extent and np.isfinite(np.asarray(extent)).all() else None


def _corners(extent: Vt.Vec3fArray) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    low, high = (np.array(Gf.Vec3d(corner)) for corner in extent)
    return low, high


def _light(light: UsdLux.RectLight, matrix: Array) -> tuple[float, float, float]:
    """Width and height in metres, and luminance."""
    width, height = (
        number_of(attribute) * float(np.linalg.norm(matrix[row, :3]))
        for row, attribute in enumerate((light.GetWidthAttr(), light.GetHeightAttr()))
    )
    luminance = light.GetPrim().GetAttribute(_LUMINANCE)
    return width, height, number_of(luminance) if luminance else 0.0
