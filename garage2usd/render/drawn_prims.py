"""Drawn prims of a stage: its distinct shapes, all their placements, and those above the height of a car."""

from collections.abc import Hashable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom, UsdLux, UsdShade

from garage2usd.as_built.contents import read_contents
from garage2usd.as_built.driven_ground import CAR_HEIGHT_M
from garage2usd.as_built.driven_road import DrivenFloor
from garage2usd.garage.levels import LevelPlace
from garage2usd.reading.labels import owner_of
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles, triangles_of
from garage2usd.scenes.prims import DrawnPart, PlacedObject, once_for_each_look
from garage2usd.scenes.values import metres_per_unit
from garage2usd.scenes.walk import placed_objects
from garage2usd.sensors.rig.poses import y_up_to_stage

SHAPE_PROPERTY = "garage2usd_shape"
"""Custom property that holds the shape's index on a Blender object."""
_ROUNDING_M = 0.01
"""Tolerance of heights, for grooves of ramps and single precision."""
_LOOKS_DOWN = -0.5
"""Upper limit of the upward component of an underside's normal."""


@dataclass(frozen=True, eq=False)
class DrawnPrims:
    """The drawn prims of a stage.

    Attributes
    ----------
    shapes
        Path of one prim for each distinct mesh or light, shared by instances.
    materials
        Paths of the materials that the shapes are bound to.
    domes
        Paths of the dome lights.
    shape
        Shape index of each drawn prim; int32, shape (n,).
    instance
        Instance id of each drawn prim's object, 0 for none; int32, shape (n,).
    to_world
        Transform from local space to the stage's axes, in metres, for column vectors; float64, shape (n, 4, 4).
    """

    shapes: tuple[Sdf.Path, ...]
    materials: tuple[Sdf.Path, ...]
    domes: tuple[Sdf.Path, ...]
    shape: NDArray[np.int32]
    instance: NDArray[np.int32]
    to_world: NDArray[np.float64]


_DOMES = (UsdLux.DomeLight, UsdLux.DomeLight_1)


def read_drawn_prims(stage: Usd.Stage, ids: Mapping[str, int]) -> DrawnPrims:
    """Read all drawn prims of a stage.

    Parameters
    ----------
    stage
        The stage; instances and point instancers are expanded.
    ids
        Instance ids by prim path; a point of an instancer has its index in brackets after the instancer's path. A drawn
        prim belongs to its nearest ancestor with an id.

    Notes
    -----
    See `garage2usd.scenes.walk.placed_objects` for the prims that are drawn.
    """
    metres = metres_per_unit(stage)
    numbers: dict[Hashable, int] = {}
    shapes: list[Sdf.Path] = []
    materials: set[Sdf.Path] = set()
    domes: list[Sdf.Path] = []
    drawn: list[tuple[int, int, NDArray[np.float64]]] = []

    def look_of(placed: PlacedObject) -> list[tuple[int, DrawnPart]]:
        """Return the placed drawable parts of an object, each with the index of its shape."""
        look = []
        for part in placed.parts:
            twin = Sdf.Path(placed.twin + part.path)
            if any(part.prim.IsA(dome) for dome in _DOMES):
                domes.append(twin)
                continue
            number = numbers.setdefault((part.prim.GetPath(), part.inherited), len(shapes))
            if number == len(shapes):
                shapes.append(twin)
                materials.update(_materials(stage.GetPrimAtPath(twin)))
            look.append((number, part))
        return look

    remembered = once_for_each_look(look_of)
    for placed in placed_objects(stage, np.diag([metres, metres, metres, 1.0])):
        for number, part in remembered(placed):
            drawn.append((number, owner_of(placed.path + part.path, ids), (part.matrix @ placed.matrix).T))
    shape, instance, to_world = zip(*drawn, strict=True) if drawn else ((), (), ())
    return DrawnPrims(
        tuple(shapes),
        tuple(sorted(materials)),
        tuple(domes),
        np.array(shape, dtype=np.int32),
        np.array(instance, dtype=np.int32),
        np.array(to_world, dtype=np.float64).reshape(-1, 4, 4),
    )


def write_shapes(stage: Usd.Stage, scene: DrawnPrims, path: Path) -> None:
    """Write an override layer in which no shape is an instance and each has its index as a custom property."""
    layer = Sdf.Layer.CreateAnonymous(path.suffix)
    layer.subLayerPaths.append(str(Path(stage.GetRootLayer().realPath)))
    over = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(over, UsdGeom.GetStageUpAxis(stage))
    UsdGeom.SetStageMetersPerUnit(over, metres_per_unit(stage))
    with Sdf.ChangeBlock():
        for number, shape in enumerate(scene.shapes):
            for parent in shape.GetPrefixes():
                if stage.GetPrimAtPath(parent).IsInstance() or stage.GetPrimAtPath(parent).IsInstanceable():
                    Sdf.CreatePrimInLayer(layer, parent).SetInfo("instanceable", False)
            spec = Sdf.CreatePrimInLayer(layer, shape)
            mark = Sdf.AttributeSpec(
                spec, f"userProperties:{SHAPE_PROPERTY}", Sdf.ValueTypeNames.Int, declaresCustom=True
            )
            mark.default = number
    layer.Export(str(path))


def _materials(prim: Usd.Prim) -> Iterator[Sdf.Path]:
    parts = UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim))
    for bound in (prim, *(part.GetPrim() for part in parts)):
        material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial(UsdShade.Tokens.preview)
        if material:
            yield material.GetPath()


@dataclass(frozen=True, eq=False)
class Overhead:
    """Drawn prims of a stage that hang above a car's height over drivable ground.

    Attributes
    ----------
    hangs
        Mask of prims that hang as a whole; bool, shape (n,).
    cut_m
        World height along the up axis above which a prim hangs in part, as the head of a door frame on its posts; NaN
        for prims without such a part; float64, shape (n,).
    """

    hangs: NDArray[np.bool_]
    cut_m: NDArray[np.float64]


def find_overhead(stage: Usd.Stage, scene: DrawnPrims, ids: Mapping[str, int]) -> Overhead:
    """Find geometry that hangs high enough for the design car to drive under, on ramps too.

    Parameters
    ----------
    stage
        The stage.
    scene
        Drawn prims of the stage.
    ids
        Instance ids by prim path, which tell the level of an object; each hangs over the floor of its own level.
    """
    levels, things = levels_of(stage), read_contents(stage).things
    floors = DrivenFloor.of_levels(levels, read_lanes(stage).graph, things)
    level = _levels(levels, scene, ids)
    to_y_up = np.linalg.inv(y_up_to_stage(stage))
    hangs, cut_m = np.zeros(len(scene.shape), dtype=bool), np.full(len(scene.shape), np.nan)
    for number, path in enumerate(scene.shapes):
        prim = stage.GetPrimAtPath(path)
        shape = triangles_of(prim) if prim.GetTypeName() in DRAWN_TYPES else None
        if shape is None:
            continue
        rows = np.flatnonzero(scene.shape == number)
        places = to_y_up @ scene.to_world[rows]
        high = _heights(shape, places).max(axis=1)
        is_high = high >= np.array([floor.level_m for floor in floors])[level[rows]] + CAR_HEIGHT_M
        for row, place in zip(rows[is_high].tolist(), places[is_high], strict=True):
            hangs[row], cut_m[row] = _over_the_ground(shape, place, floors[level[row]])
    return Overhead(hangs, cut_m)


def _levels(levels: Sequence[LevelPlace], scene: DrawnPrims, ids: Mapping[str, int]) -> NDArray[np.int64]:
    """Return the level of each drawn prim; 0 without levels, and for what belongs to none."""
    found = {
        number: index
        for path, number in ids.items()
        for index, level in enumerate(levels)
        if path.startswith(f"{level.path}/")
    }
    return np.array([found.get(number, 0) for number in scene.instance.tolist()], dtype=np.int64)


def _heights(shape: Triangles, places: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the heights of the corners of a shape's bounding box at each placement, shape (places, 8)."""
    ends = np.stack([shape.positions_m.min(axis=0), shape.positions_m.max(axis=0)]).astype(np.float64)
    corners = np.stack(np.meshgrid(*ends.T, indexing="ij"), axis=-1).reshape(-1, 3)
    heights: NDArray[np.float64] = corners @ places[:, 1, :3].T + places[:, 1, 3]
    return heights.T


def _over_the_ground(shape: Triangles, place: NDArray[np.float64], floor: DrivenFloor) -> tuple[bool, float]:
    """Test if a placed shape hangs entirely above a car; otherwise find the height above which part of it does."""
    points = shape.positions_m.astype(np.float64) @ place[:3, :3].T + place[:3, 3]
    over_m = points[:, 1] - floor.heights_m(points[:, 0], points[:, 2])
    is_high = over_m >= CAR_HEIGHT_M - _ROUNDING_M
    if is_high.all():
        return True, np.nan
    first, second, third = (points[shape.indices[:, corner]] for corner in range(3))
    normals = np.cross(second - first, third - first)
    if np.linalg.det(place[:3, :3]) < 0:
        normals = -normals
    lengths = np.linalg.norm(normals, axis=1)
    is_underside = (normals[:, 1] < _LOOKS_DOWN * lengths) & is_high[shape.indices].all(axis=1)
    if not is_underside.any():
        return False, np.nan
    # the underside itself is removed too
    return False, float(points[shape.indices[is_underside], 1].min()) - _ROUNDING_M
