"""Strips as parts of a whole around view, for detectors that were made for such: framed, and what is found taken back.

Those detectors know a car in the middle of a grey square that shows 10 m of ground. A strip is shown whole and as it
is, its car continued to the frame's right edge in black, the other sides in the strip's mean grey. The car's other side
is left out: with the strip mirrored to that side fewer corners are found in photographs.
"""

import numpy as np
from average_precision import Detections
from corner_maps import peaks
from numpy.typing import NDArray
from PIL import Image
from strips import SIZE_PX, Strip

__all__ = ["FRAME_PX", "corners_in_strip", "framed"]

FRAME_PX = 160, 320
"""Width and height of frames: multiples of 32, by which networks make pictures smaller and larger again."""
_AT_PX = 44, 10
"""Column and row of a frame where the strip's upper left corner is."""
_LEFT, _TOP = _AT_PX
_RIGHT, _BOTTOM = _LEFT + SIZE_PX[0], _TOP + SIZE_PX[1]


def framed(strip: Strip) -> NDArray[np.float32]:
    """The strip in its frame, with mean 0 and standard deviation 1; float32, shape (320, 160)."""
    grey = np.asarray(Image.fromarray(strip.pixels).convert("L"), dtype=np.float32)
    frame = np.full(FRAME_PX[::-1], grey.mean(), dtype=np.float32)
    frame[:, _RIGHT:] = 0
    frame[_TOP:_BOTTOM, _LEFT:_RIGHT] = grey
    return (frame - frame.mean()) / max(frame.std(), 1.0)


def corners_in_strip(confidence: NDArray[np.floating]) -> Detections:
    """The peaks of a frame's map, shape (320, 160), that are in its strip, at their places there."""
    found = peaks(confidence, cell_px=1)
    places_px = found.places_px - _AT_PX
    is_inside = ((places_px >= 0) & (places_px <= SIZE_PX)).all(axis=1)
    return Detections(places_px[is_inside], found.confidence[is_inside])
