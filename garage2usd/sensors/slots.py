"""Parking slots in camera frames: the visible part of each stall, the source of all slot formats."""

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.common.errors import StageError
from garage2usd.garage import LaneNode, Stall
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.scenes.values import metres_y_up, up_axis
from garage2usd.sensors.rays.sight import outline_in_picture, polygons_of

CORNERS = ("entry_left", "entry_right", "rear_right", "rear_left")
"""Corners of a slot in order; left and right as seen by a driver who enters forwards."""

PLACES_PX = 3
"""Decimals of corner coordinates in files; corners are rounded before their visibility is tested."""

_ON_FLOOR_M = 0.02
"""Height difference up to which a surface counts as the floor; lines are painted a few millimetres over it."""
_LEAST_AREA_PX = 1e-6
_DEGREES = 3

Points = NDArray[np.float64]
_Floats = NDArray[np.floating[Any]]


class Visibility(IntEnum):
    """Visibility of a slot's corner, as in COCO keypoints."""

    NOT_IN_PICTURE = 0
    OCCLUDED = 1
    SEEN = 2


@dataclass(frozen=True, eq=False)
class Slot:
    """A parking slot: a stall in the axes of its stage.

    Attributes
    ----------
    stall
        The stall.
    corners_m
        The slot's `CORNERS` on the floor, in the stage's axes and in metres; float64, shape (4, 3).
    level
        Name of its level in a garage of several.
    """

    stall: Stall
    corners_m: Points
    level: str | None = None

    @property
    def facts(self) -> dict[str, object]:
        """Attributes of the slot for files, without its coordinates."""
        stall = self.stall
        return {
            "name": stall.name,
            **({} if self.level is None else {"level": self.level}),
            "number": stall.number,
            "use": str(stall.use),
            "type": str(stall.kind),
            "angle_deg": round(stall.angle_deg, _DEGREES),
            "occupied": stall.is_occupied,
            "blocked_by": stall.blocked_by,
        }


@dataclass(frozen=True, eq=False)
class SlotFrame:
    """A picture in which parking slots are looked for: its projection and the points that it shows.

    Attributes
    ----------
    name
        Name of the frame.
    size_px
        Width and height.
    project
        Projection from points in the stage's axes and in metres, shape (n, 3), to (column, row) in pixels, float64,
        shape (n, 2). Pixel (i, j) covers [i, i + 1) x [j, j + 1); points outside the field of view are NaN.
    seen_m
        First hit of the ray through the middle of each pixel, in the stage's axes; not finite without a hit; shape
        (rows, columns, 3).
    shows_floor
        Mask of pixels that show a class of the floor; bool, shape (rows, columns). None if unknown; the floor is then
        found by height only.
    """

    name: str
    size_px: tuple[int, int]
    project: Callable[[Points], Points]
    seen_m: NDArray[np.floating[Any]]
    shows_floor: NDArray[np.bool_] | None = None

    def floor_heights_m(self, up_axis: int) -> NDArray[np.floating[Any]]:
        """Return the floor's height in each pixel, infinite where the pixel shows no floor; shape (rows, columns)."""
        heights = self.seen_m[..., up_axis]
        return heights if self.shows_floor is None else np.where(self.shows_floor, heights, np.inf)


@dataclass(frozen=True, eq=False)
class SlotRecord:
    """A parking slot in a frame.

    Attributes
    ----------
    slot
        The slot.
    corners_px
        (column, row) of the slot's `CORNERS`, also outside the picture; NaN outside the field of view; float64, shape
        (4, 2).
    visibility
        `Visibility` of each corner: 0 outside the picture, 1 hidden, 2 visible.
    outline_px
        Polygons of the slot's whole ground in the picture, hidden or not; each float64, shape (n, 2).
    seen_px
        Number of pixels that show the slot's ground.
    """

    slot: Slot
    corners_px: Points
    visibility: tuple[int, int, int, int]
    outline_px: tuple[Points, ...]
    seen_px: int

    @property
    def entry_px(self) -> Points:
        """The slot's entry line in pixels, from left to right; float64, shape (2, 2)."""
        return self.corners_px[:2]


@dataclass(frozen=True, eq=False)
class Slots:
    """The parking slots of a stage.

    Attributes
    ----------
    slots
        Slots in the stage's order.
    ground_axes, up_axis
        Indices of the stage's horizontal axes and of its up axis.
    """

    slots: tuple[Slot, ...]
    ground_axes: tuple[int, int]
    up_axis: int

    def taken(self, names: Collection[str]) -> "Slots":
        """Return the slots with cars in those of some names."""
        slots = (
            replace(slot, stall=slot.stall.vacated(is_taken=True)) if slot.stall.name in names else slot
            for slot in self.slots
        )
        return replace(self, slots=tuple(slots)) if names else self

    def seen_in(self, frame: SlotFrame) -> list[SlotRecord]:
        """Find the parking slots visible in a frame: by a corner, or by a pixel of their ground.

        Notes
        -----
        A corner is visible if its pixel shows the floor or its paint: a surface of such a class within 2 cm of the
        floor's height. The middle of the pixel decides, so that a pixel never mixes two objects. The foot of a wall and
        the edge of a wheel stop are not floor.
        """
        if not self.slots:
            return []
        width, height = frame.size_px
        floor_m = frame.floor_heights_m(self.up_axis)
        corners_m = np.stack([slot.corners_m for slot in self.slots])
        corners_px = np.round(frame.project(corners_m.reshape(-1, 3)), PLACES_PX).reshape(-1, 4, 2)
        visibility = _visibility(floor_m, corners_px, corners_m[..., self.up_axis])
        picture = shapely.box(0, 0, width, height)
        records = []
        for slot, places, seen in zip(self.slots, corners_px, visibility.tolist(), strict=True):
            outline = outline_in_picture(slot.corners_m, frame.project).intersection(picture)
            parts = [part for part in polygons_of(outline) if part.area > _LEAST_AREA_PX]
            seen_px = self._seen_pixels(slot, frame.seen_m, floor_m, outline) if parts else 0
            if seen_px or Visibility.SEEN in seen:
                rings = tuple(np.asarray(part.exterior.coords)[:-1] for part in parts)
                records.append(SlotRecord(slot, places, tuple(seen), rings, seen_px))
        return records

    def _seen_pixels(self, slot: Slot, seen_m: _Floats, floor_m: _Floats, outline: shapely.Geometry) -> int:
        """Count the pixels that show the ground of a parking slot."""
        left, top, right, bottom = outline.bounds
        rows, columns = slice(math.floor(top), math.ceil(bottom)), slice(math.floor(left), math.ceil(right))
        on_floor = np.abs(floor_m[rows, columns] - slot.corners_m[0, self.up_axis]) <= _ON_FLOOR_M
        ground = shapely.Polygon(slot.corners_m[:, self.ground_axes])
        return int(shapely.contains_xy(ground, seen_m[rows, columns][on_floor][:, self.ground_axes]).sum())


def read_slots(stage: Usd.Stage) -> Slots:
    """Read the parking slots of a stage from its lane graph, which holds the stalls' outlines.

    Raises
    ------
    StageError
        If the stage has no lane graph.
    """
    lanes = read_lanes(stage)
    if not lanes.stalls:
        said = "; ".join(fault.message for fault in lanes.faults) or "its lane graph has no stalls"
        raise StageError(stage.GetRootLayer().realPath, f"no slots in it: {said}")
    to_metres = metres_y_up(stage)
    turn = to_metres[:3, :3] / np.linalg.norm(to_metres[0, :3])  # for row vectors: from the stage's axes to Y up
    up = up_axis(stage)
    levels = levels_of(stage)
    slots = tuple(
        replace(_slot(stall, lanes.nodes[stall.access], turn), level=levels[stall.level].name or None)
        for stall in lanes.stalls
    )
    return Slots(slots, (0, 3 - up), up)


def _slot(stall: Stall, access: LaneNode, turn: Points) -> Slot:
    corners = np.array([(x, access.height_m, z) for x, z in stall.corners])
    return Slot(stall, np.round(corners @ turn.T, 6) + 0.0)


def _visibility(floor_m: _Floats, corners_px: Points, heights_m: Points) -> NDArray[np.int64]:
    """Return the `Visibility` of each slot corner, shape (slots, 4), from the floor height that each pixel shows."""
    inside = _in_picture(corners_px, floor_m.shape[::-1])
    columns, rows = np.where(inside[..., None], np.floor(np.nan_to_num(corners_px)), 0).astype(np.int64).T
    on_floor = np.abs(floor_m[rows.T, columns.T] - heights_m) <= _ON_FLOOR_M
    seen = np.where(on_floor, Visibility.SEEN, Visibility.OCCLUDED)
    return np.where(inside, seen, Visibility.NOT_IN_PICTURE)


def _in_picture(places_px: Points, size_px: tuple[int, ...]) -> NDArray[np.bool_]:
    """Test if pixel coordinates, shape (..., 2), lie in the picture; False for NaN."""
    inside: NDArray[np.bool_] = ((places_px >= 0) & (places_px < np.array(size_px))).all(axis=-1)
    return inside
