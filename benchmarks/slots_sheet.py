"""Contact sheets of strips with the slots that a network found and missed, and the ground that is not free."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from detections_sheet import FALSE, HIDDEN, HIT, MISSED, write_pictures
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from slot_measures import SURE, Understood
from slot_pairs import TrueSlots, matched_slots
from strip_labels import StripLabels
from strips import Strip

__all__ = ["write_slots_sheet"]

_TICK_PX, _END_PX = 12.0, 2.0
_SAID_TAKEN, _TAKEN_FOR_FREE = (255, 90, 40), (255, 0, 255)
_FAINT, _STRONG = 0.3, 0.5


def write_slots_sheet(
    strips: Sequence[Strip],
    found: Sequence[Understood],
    truths: Sequence[TrueSlots],
    threshold: float,
    path: Path,
    *,
    labels: Sequence[StripLabels] = (),
) -> None:
    """Draw strips from all over a list with the slots that were found in them.

    Green entries are of slots that were found, red ones were missed, and yellow ones are of no slot; blue ones do not
    count. A tick shows into which direction a found slot goes, with a dot if it is said to be occupied. Ground that is
    said not to be free is orange, and violet is what was taken for free and is not.

    Parameters
    ----------
    strips, found, truths
        The strips, what is found in each, and what is there.
    threshold
        Slots that are less sure than this are left out.
    path
        A PNG.
    labels
        Of the strips, if there are any: what is free.
    """

    def picture(number: int) -> Image.Image:
        known = labels[number] if labels else None
        return _marked(strips[number].pixels, found[number], truths[number], threshold, known)

    write_pictures(len(strips), picture, path)


def _marked(
    pixels: NDArray[np.uint8], found: Understood, true: TrueSlots, threshold: float, labels: StripLabels | None
) -> Image.Image:
    said_free = found.free >= SURE
    shown = _tinted(pixels.astype(np.float64), ~said_free, _SAID_TAKEN, _FAINT)
    if labels is not None:
        shown = _tinted(shown, said_free & labels.is_known & ~labels.is_free, _TAKEN_FOR_FREE, _STRONG)
    picture = Image.fromarray(shown.astype(np.uint8))
    draw = ImageDraw.Draw(picture)
    sure = found.slots.of(found.slots.confidence >= threshold)
    result = matched_slots(sure, true)
    hit = set(result.owner.tolist())
    for number, entry in enumerate(true.entries_px.tolist()):
        if number not in hit:
            draw.line([tuple(end) for end in entry], fill=MISSED if true.counts[number] else HIDDEN)
    occupied = found.occupied[found.slots.confidence >= threshold]
    for number, owner in zip(result.number.tolist(), result.owner.tolist(), strict=True):
        colour, entry = FALSE if owner < 0 else HIT, sure.entries_px[number]
        start = entry.mean(axis=0)
        x, y = start + sure.direction[number] * _TICK_PX
        draw.line([tuple(end) for end in entry.tolist()], fill=colour, width=2)
        draw.line([tuple(start.tolist()), (x, y)], fill=colour)
        if occupied[number] >= SURE:
            draw.ellipse((x - _END_PX, y - _END_PX, x + _END_PX, y + _END_PX), fill=colour)
    return picture


def _tinted(
    pixels: NDArray[np.float64], mask: NDArray[np.bool_], colour: tuple[int, int, int], share: float
) -> NDArray[np.float64]:
    return np.where(mask[..., None], pixels * (1 - share) + np.array(colour) * share, pixels)
