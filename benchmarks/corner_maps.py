"""Maps of corners, as detectors of keypoints have them: a peak at each corner, 4 x 4 pixels of a picture to a cell."""

import numpy as np
from average_precision import Detections
from numpy.typing import NDArray
from strips import SIZE_PX

__all__ = ["MAP_SIZE", "STRIDE_PX", "corner_map", "peaks"]

STRIDE_PX = 4
MAP_SIZE = SIZE_PX[1] // STRIDE_PX, SIZE_PX[0] // STRIDE_PX
"""Rows and columns."""
_PEAK_SD_CELLS = 0.8
_LEAST_CONFIDENCE = 0.03


def corner_map(corners_px: NDArray[np.float64]) -> NDArray[np.float32]:
    """1 in the cells that hold corners, shape (n, 2), and less the farther from them; float32, shape `MAP_SIZE`."""
    rows, columns = np.mgrid[: MAP_SIZE[0], : MAP_SIZE[1]]
    heat = np.zeros(MAP_SIZE)
    for column, row in np.minimum(corners_px // STRIDE_PX, np.array(MAP_SIZE[::-1]) - 1):
        apart = (columns - column) ** 2 + (rows - row) ** 2
        heat = np.maximum(heat, np.exp(-apart / (2 * _PEAK_SD_CELLS**2)))
    return heat.astype(np.float32)


def peaks(heat: NDArray[np.floating], cell_px: int = STRIDE_PX) -> Detections:
    """The cells of a map that are no less than the eight around them, as corners; so many pixels to a cell."""
    around = np.pad(heat, 1, constant_values=-np.inf)
    highest = np.max(np.lib.stride_tricks.sliding_window_view(around, (3, 3)), axis=(2, 3))
    rows, columns = np.nonzero((heat >= highest) & (heat > _LEAST_CONFIDENCE))
    places_px = (np.stack([columns, rows], axis=1) + 0.5) * cell_px
    return Detections(places_px, heat[rows, columns].astype(np.float64))
