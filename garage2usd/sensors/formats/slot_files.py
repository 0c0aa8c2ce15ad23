"""Files of parking slots: ``slots.json``, and the label format of DMPR-PS for marking points.

Huang et al., *DMPR-PS: A novel approach for parking-slot detection using directional marking-point regression* (2019),
in the JSON form of its labels of the data set ps2.0 (Zhang et al., *Vision-based parking-slot detection: a DCNN-based
approach and a large-scale benchmark dataset*, 2018).
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import VERSION
from garage2usd.garage import StallKind
from garage2usd.sensors.slots import CORNERS, PLACES_PX, SlotRecord, Slots, Visibility

_MATLAB = 0.5
"""Offset of MATLAB's pixel coordinates in ps2.0, where the middle of the first pixel is (1, 1)."""
_ARM_PX = 50.0
_SAME_M = 0.05
"""Distance in metres below which the marking points of two stalls are merged."""
_T, _L = 0, 1
_RIGHT_ANGLED, _ACUTE, _OBTUSE = 1, 2, 3
_QUARTER_DEG = 90.0
_PLACES = 3
_PLACES_M = 6
_CONVENTIONS = {
    "corners": f"{', '.join(CORNERS)}: left and right as a driver sees them who drives in forwards; the first two are "
    "the entry line",
    "corners_m": "on the floor, in the stage's axes and in metres",
    "angle_deg": "from the entry line, left to right, to the left side",
    "corners_px": "(column, row); pixel (column, row) covers [column, column + 1); null for what the lens does not see",
    "visibility": "of each corner: 0 is not in the picture, 1 is in it and hidden, 2 is seen: the pixel that holds it "
    "shows the floor or its paint",
    "outline_px": "polygons of the whole ground in the picture, hidden or not",
    "seen_px": "pixels that show the ground",
    "frames": "a frame lists the slots of which it shows a corner or a pixel of their ground",
}


def dmpr_ps(records: Sequence[SlotRecord], slots: Slots) -> dict[str, Any]:
    """Return the DMPR-PS labels of one bird's-eye picture.

    Parameters
    ----------
    records
        Slots visible in the picture.
    slots
        All slots of the stage; neighbouring slots determine the shapes of marks.

    Returns
    -------
    dict
        ``marks``: for each mark x, y, a point 50 pixels along its direction, and its shape, 0 for T and 1 for L.
        ``slots``: for each slot the numbers of its marks, counted from 1, its type (1 right-angled, 2 acute, 3 obtuse)
        and its angle in degrees.

    Notes
    -----
    A slot is labelled if it takes cars, both corners of its entry lie in the picture, and at least one of them is
    visible. The first mark is at the entry's left corner, so that the slot lies to the left of the direction from the
    first to the second mark. A mark between two adjacent stalls is a T and points into the slots. A mark at the end of
    a row is an L, whose second arm is a quarter turn clockwise in the picture: the direction points into the slot at
    the left corner and along the entry at the right one. Stall lines leave the entry open, so the arm across the entry
    is not painted.
    """
    marks: list[list[float]] = []
    numbers: dict[tuple[int, int], int] = {}
    found = []
    corners_m = np.stack([slot.corners_m[:2] for slot in slots.slots])

    def number_of(record: SlotRecord, corner: int) -> int:
        """Return the number of the mark at a corner of a slot's entry, adding the mark if it is new."""
        near = np.linalg.norm(corners_m - record.slot.corners_m[corner], axis=2) < _SAME_M
        stall, end = (int(first[0]) for first in np.nonzero(near))
        key = (stall, end)
        if key not in numbers:
            left, right, _, rear_left = record.corners_px
            along, inwards = (right - left), (rear_left - left)
            is_shared = _meets_neighbour(near)
            arm = inwards if is_shared or corner == 0 else -along
            x, y = record.corners_px[corner] + _MATLAB
            dx, dy = _ARM_PX * arm / np.linalg.norm(arm)
            marks.append([*(round(float(value), _PLACES) for value in (x, y, x + dx, y + dy)), _T if is_shared else _L])
            numbers[key] = len(marks)
        return numbers[key]

    for record in records:
        entry = record.visibility[:2]
        if record.slot.stall.use.takes_cars and Visibility.NOT_IN_PICTURE not in entry and Visibility.SEEN in entry:
            pair = [number_of(record, corner) for corner in (0, 1)]
            found.append([*pair, _type_of(record), round(record.slot.stall.angle_deg)])
    return {"marks": marks, "slots": found}


def _meets_neighbour(near: NDArray[np.bool_]) -> bool:
    """Test if the left corner of one entry meets the right corner of another at a mark; `near` has shape (n, 2)."""
    left, right = near.any(axis=0).tolist()
    return bool(left and right)


def _type_of(record: SlotRecord) -> int:
    if record.slot.stall.kind is not StallKind.ANGLED:
        return _RIGHT_ANGLED
    return _ACUTE if record.slot.stall.angle_deg < _QUARTER_DEG else _OBTUSE


def slots_document(
    slots: Slots, frames: Mapping[str, Sequence[SlotRecord]], *, stage: str, is_changing: bool = False
) -> dict[str, Any]:
    """Return the parking slots of a stage and of its frames as a JSON object.

    Parameters
    ----------
    slots
        All slots of the stage.
    frames
        Visible slots of each frame, by frame name.
    stage
        Name of the stage's file.
    is_changing
        True to tell of each slot in each frame whether it is occupied.
    """
    return {
        "version": VERSION,
        "stage": stage,
        "conventions": _CONVENTIONS,
        "slots": [
            {
                **slot.facts,
                "corners_m": rounded(slot.corners_m, _PLACES_M),
            }
            for slot in slots.slots
        ],
        "frames": [
            {
                "name": name,
                "slots": [
                    {
                        "name": record.slot.stall.name,
                        "corners_px": [
                            place if None not in place else None for place in rounded(record.corners_px, PLACES_PX)
                        ],
                        "visibility": list(record.visibility),
                        "outline_px": [rounded(part, PLACES_PX) for part in record.outline_px],
                        "seen_px": record.seen_px,
                        **({"occupied": record.slot.stall.is_occupied} if is_changing else {}),
                    }
                    for record in records
                ],
            }
            for name, records in frames.items()
        ],
    }


def rounded(values: NDArray[np.float64], places: int) -> list[list[float | None]]:
    """Round rows of numbers for a JSON file; None for values that are not finite."""
    rows = (np.round(values, places) + 0.0).tolist()
    return [[number if np.isfinite(number) else None for number in row] for row in rows]
