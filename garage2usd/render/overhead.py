"""Overhead geometry: prims above the height of a car, which bird's-eye views hide."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.as_built.contents import read_contents
from garage2usd.as_built.driven_floor import DrivenFloor
from garage2usd.as_built.driven_ground import CAR_HEIGHT_M
from garage2usd.garage.level_place import LevelPlace
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.render.drawn_prims import DrawnPrims
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles, triangles_of
from garage2usd.sensors.rig.poses import y_up_to_stage

__all__ = ["Overhead", "find_overhead"]

_ROUNDING_M = 0.01
"""Tolerance of heights, for grooves of ramps and single precision."""
_LOOKS_DOWN = -0.5
"""Upper limit of the upward component of an underside's normal."""


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
    # the underside itself goes too
    return False, float(points[shape.indices[is_underside], 1].min()) - _ROUNDING_M
