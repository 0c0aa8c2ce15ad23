"""Maps that a network of slots learns and answers with, 4 x 4 pixels of a picture to a cell as in `corner_maps`."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from corner_maps import MAP_SIZE, STRIDE_PX, corner_map, peaks
from numpy.typing import NDArray
from slot_pairs import FoundSlots, MarkingPoints, TrueSlots
from strip_changes import moved_px, warped
from strip_labels import StripLabels
from strips import SIZE_PX

from garage2usd.sensors.slots import Visibility

__all__ = ["CHANNELS", "SlotMaps", "logistic", "moved", "points_in", "shares_occupied", "slot_maps", "true_slots"]

CHANNELS = 9
"""Of a network's answer: confidence, offset from the cell's middle in cells (column, row), direction (column, row),
slot to the right and to the left of it, occupied, free ground. All but offset and direction are logits."""
_CONFIDENCE, _OFFSET, _DIRECTION, _OPENS = 0, slice(1, 3), slice(3, 5), slice(5, 7)
OCCUPIED, FREE = 7, 8
_SAME_POINT_PX = 3.0
_INWARDS_PX = 10.0
"""From the middle of an entry to where the network says whether the slot is occupied."""

Floats = NDArray[np.float64]
Map = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class SlotMaps:
    """What is to be learnt of a strip; several strips are stacked in front of the shapes that are given here.

    Attributes
    ----------
    heat
        1 in the cells of marking points that are seen, and less the farther from them; shape `MAP_SIZE`.
    hidden
        Cells that nothing is learnt about confidence in, as a hidden point is there; shape `MAP_SIZE`.
    point
        Offset, direction and both `MarkingPoints.opens` in the 3 x 3 cells of a point; shape (rows, columns, 6).
    is_point
        Which cells these are; shape `MAP_SIZE`.
    occupied, is_slot
        Whether the slot of a cell is occupied, and the 3 x 3 cells where that is asked; shape `MAP_SIZE`.
    free, is_known
        Shares of a cell's pixels: of free ones among the known ones, and of known ones; shape `MAP_SIZE`.
    """

    heat: Map
    hidden: Map
    point: Map
    is_point: Map
    occupied: Map
    is_slot: Map
    free: Map
    is_known: Map

    def arrays(self) -> dict[str, Map]:
        """By name."""
        return vars(self)

    @classmethod
    def stacked(cls, maps: list[Self]) -> Self:
        """Maps of several strips as one."""
        return cls(**{name: np.stack([vars(each)[name] for each in maps]) for name in vars(maps[0])})


def slot_maps(labels: StripLabels) -> SlotMaps:
    """What is to be learnt of a strip."""
    points, is_seen = _points_of(labels)
    heat, hidden = corner_map(points.places_px[is_seen]), np.zeros(MAP_SIZE, dtype=np.float32)
    values, is_point = np.zeros((*MAP_SIZE, 6), dtype=np.float32), np.zeros(MAP_SIZE, dtype=np.float32)
    occupied, is_slot = np.zeros(MAP_SIZE, dtype=np.float32), np.zeros(MAP_SIZE, dtype=np.float32)
    for place in points.places_px[~is_seen]:
        hidden[_cells(place)] = 1
    hidden[heat == 1] = 0
    nearest = np.full(MAP_SIZE, np.inf)
    for place, direction, opens in zip(
        points.places_px[is_seen], points.direction[is_seen], points.opens[is_seen], strict=True
    ):
        rows, columns = _cells(place)
        offset = place / STRIDE_PX - np.stack([columns, rows], axis=1) - 0.5
        distance = np.hypot(*offset.T)
        is_nearer = distance < nearest[rows, columns]
        rows, columns, offset = rows[is_nearer], columns[is_nearer], offset[is_nearer]
        nearest[rows, columns], is_point[rows, columns] = distance[is_nearer], 1
        values[rows, columns] = np.concatenate([offset, np.tile([*direction, *opens], (len(rows), 1))], axis=1)
    slots = true_slots(labels)
    for place, is_occupied in zip(_asked_px(slots.entries_px, slots.direction), slots.is_occupied, strict=True):
        if ((place >= 0) & (place < SIZE_PX)).all():
            occupied[_cells(place)], is_slot[_cells(place)] = is_occupied, 1
    known = _shares(labels.is_known)
    free = np.where(known > 0, _shares(labels.is_free & labels.is_known) / np.maximum(known, 1e-6), 0)
    return SlotMaps(heat, hidden, values, is_point, occupied, is_slot, free.astype(np.float32), known)


def true_slots(labels: StripLabels) -> TrueSlots:
    """The slots of a drawn strip; those count whose entry is seen at both ends."""
    entries = labels.corners_px[:, :2]
    inwards = labels.corners_px[:, 2:].mean(axis=1) - entries.mean(axis=1)
    counts = (labels.visibility == Visibility.SEEN).all(axis=1)
    return TrueSlots(entries, _unit(inwards), labels.is_occupied, counts)


def moved(labels: StripLabels, matrix: Floats) -> StripLabels:
    """The labels of a strip whose places a matrix moves, shape (3, 3), as `strip_changes` does.

    What comes into the picture from beyond its edges is not known, nor are entries that come in from there seen.
    """
    corners, visibility = moved_px(labels.corners_px, matrix), labels.visibility
    inside = ((corners[:, :2] >= 0) & (corners[:, :2] < SIZE_PX)).all(axis=2)
    visibility = np.where(inside, np.maximum(visibility, Visibility.OCCLUDED), Visibility.NOT_IN_PICTURE)
    if np.linalg.det(matrix) < 0:  # what was left is right
        corners, visibility = corners[:, [1, 0, 3, 2]], visibility[:, ::-1]
    free, known = (warped(mask.astype(np.uint8), matrix, beyond=0) > 0 for mask in (labels.is_free, labels.is_known))
    return StripLabels(corners, visibility, labels.is_occupied, free, known)


def points_in(answer: NDArray[np.floating]) -> MarkingPoints:
    """The marking points in a network's answer, shape (*`MAP_SIZE`, `CHANNELS`), where it is surer than all around."""
    found = peaks(logistic(answer[..., _CONFIDENCE]))
    columns, rows = (found.places_px // STRIDE_PX).astype(np.int64).T
    values = answer[rows, columns].astype(np.float64)
    places = found.places_px + values[:, _OFFSET] * STRIDE_PX
    return MarkingPoints(places, _unit(values[:, _DIRECTION]), logistic(values[:, _OPENS]), found.confidence)


def shares_occupied(answer: NDArray[np.floating], slots: FoundSlots) -> Floats:
    """How surely slots are occupied by a network's answer; float64, shape (n,)."""
    columns, rows = np.clip(
        _asked_px(slots.entries_px, slots.direction) // STRIDE_PX, 0, np.array(MAP_SIZE[::-1]) - 1
    ).T
    return logistic(answer[rows.astype(np.int64), columns.astype(np.int64), OCCUPIED].astype(np.float64))


def _points_of(labels: StripLabels) -> tuple[MarkingPoints, NDArray[np.bool_]]:
    """The ends of entries in the picture, those that neighbours share once, and which of them are seen."""
    places: list[Floats] = []
    directions: list[Floats] = []
    opens: list[list[float]] = []
    is_seen: list[bool] = []
    for corners, visibility in zip(labels.corners_px, labels.visibility.tolist(), strict=True):
        for end in (0, 1):
            if visibility[end] == Visibility.NOT_IN_PICTURE:
                continue
            direction = _unit(corners[3 - end] - corners[end])
            same = [
                number
                for number, place in enumerate(places)
                if np.hypot(*(place - corners[end])) <= _SAME_POINT_PX and directions[number] @ direction > 0
            ]
            if same:
                opens[same[0]][end] = 1.0
                is_seen[same[0]] |= visibility[end] == Visibility.SEEN
            else:
                places.append(corners[end])
                directions.append(direction)
                opens.append([float(end == 0), float(end == 1)])
                is_seen.append(visibility[end] == Visibility.SEEN)
    shape = (-1, 2)
    points = MarkingPoints(
        np.array(places).reshape(shape),
        np.array(directions).reshape(shape),
        np.array(opens).reshape(shape),
        np.ones(len(places)),
    )
    return points, np.array(is_seen, dtype=bool)


def _asked_px(entries_px: Floats, direction: Floats) -> Floats:
    """Where it is asked whether slots are occupied: a little inwards of their entries, as far as the picture goes."""
    middles = entries_px.mean(axis=1)
    inside = np.clip(middles + direction * _INWARDS_PX, 0, np.array(SIZE_PX) - 1)
    is_in_picture = ((middles >= 0) & (middles < SIZE_PX)).all(axis=1)
    return np.where(is_in_picture[:, None], inside, middles)


def _cells(place_px: Floats) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Rows and columns of the 3 x 3 cells about a place."""
    column, row = np.minimum(place_px // STRIDE_PX, np.array(MAP_SIZE[::-1]) - 1).astype(np.int64)
    rows, columns = (each.ravel() for each in np.mgrid[row - 1 : row + 2, column - 1 : column + 2])
    inside = (rows >= 0) & (rows < MAP_SIZE[0]) & (columns >= 0) & (columns < MAP_SIZE[1])
    return rows[inside], columns[inside]


def _shares(mask: NDArray[np.bool_]) -> Map:
    cells = mask.reshape(MAP_SIZE[0], STRIDE_PX, MAP_SIZE[1], STRIDE_PX)
    return cells.mean(axis=(1, 3), dtype=np.float32)


def _unit(vectors: Floats) -> Floats:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=-1, keepdims=True), 1e-9)


def logistic(logits: NDArray[np.floating]) -> Floats:
    """What logits are worth, from 0 to 1."""
    return 1 / (1 + np.exp(-np.clip(logits.astype(np.float64), -60, 60)))
