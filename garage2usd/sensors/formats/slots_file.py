"""The file ``slots.json``: the parking slots of a stage, and their visibility in each frame of a recording."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.version import VERSION
from garage2usd.sensors.slots import CORNERS, PLACES_PX, SlotRecord, Slots

__all__ = ["slots_document"]

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


def slots_document(slots: Slots, frames: Mapping[str, Sequence[SlotRecord]], *, stage: str) -> dict[str, Any]:
    """Return the parking slots of a stage and of its frames as a JSON object.

    Parameters
    ----------
    slots
        All slots of the stage.
    frames
        Visible slots of each frame, by frame name.
    stage
        Name of the stage's file.
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
