"""Strips changed at random as cameras and drives change them, so that a network learns from more than there are.

What is drawn anew each time that a strip is learnt from: where the car stands and how far the ground is off its scale,
light on the floor, what the cameras and the around view that is made of them do to it, and the exposure.
"""

import math
from collections.abc import Callable, Sequence

import cv2
import numpy as np
from corner_maps import corner_map
from numpy.typing import NDArray
from strips import SIZE_PX

__all__ = ["changed", "changed_and_moved", "moved_px", "warped"]

Picture = NDArray[np.float32]
"""From 0 to 1, float32, shape (300, 96, 3)."""

_WARPED_SHARE = 0.9
_TURN_SD_RAD, _SCALE_SD, _SHIFT_SD_PX = math.radians(6.0), 0.08, (6.0, 12.0)
_SHARES = {
    "shades": 0.5,
    "bars": 0.5,
    "smear": 0.5,
    "seams": 0.5,
    "grey": 0.5,
    "sharp": 0.4,
    "coarse": 0.4,
    "jpeg": 0.4,
}
"""How many strips each change is made to, in this order."""

_FLIPPED_SHARE, _BLURRED_SHARE = 0.5, 0.5
_GAMMA_SD, _GAIN_SD, _CAST_SD, _OFFSET_SD = 0.35, 0.25, 0.06, 0.05
_MOST_NOISE = 0.03
_OUT_OF_FOCUS_SHARE = 0.5
_CAR_END_PX = 52.0, 79.0
"""How far from the middle of a strip, least and most, the cars of around views end."""
_RAY_SIZE = 96, 256
"""Distances and directions of pictures of rays."""
_FAR_PX = 120.0
_SMEARED = np.array([-0.5, -0.25, 0.25, 0.5], dtype=np.float32)


def changed(
    pixels: NDArray[np.uint8], corners_px: Sequence[NDArray[np.float64]], random: np.random.Generator
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Pictures of other places, light, cameras and exposure, some of them as if the car drove backwards.

    Parameters
    ----------
    pixels
        uint8, shape (n, 300, 96, 3).
    corners_px
        The corners to learn in each, as `Strip.seen_px` has them, shapes (m, 2). Those that leave the picture when it
        is warped are left out.
    random
        What is drawn from.

    Returns
    -------
    tuple
        Pictures from about 0 to about 1, float32, of the same shape, and their maps as `corner_map` makes them,
        float32, shape (n, *MAP_SIZE).
    """
    x, matrices = changed_and_moved(pixels, random)
    moved = [moved_px(corners, matrix) for corners, matrix in zip(corners_px, matrices, strict=True)]
    inside = [corners[((corners >= 0) & (corners <= SIZE_PX)).all(axis=1)] for corners in moved]
    return x, np.stack([corner_map(corners) for corners in inside])


def changed_and_moved(
    pixels: NDArray[np.uint8], random: np.random.Generator
) -> tuple[NDArray[np.float32], list[NDArray[np.float64]]]:
    """Pictures as `changed` has them, and where each has its places: matrices for `moved_px`, shape (3, 3)."""
    pairs = [_warped(each, random) for each in pixels]
    x = [_exposed(_lit_and_taken(picture.astype(np.float32) / 255, random), random) for picture, _ in pairs]
    return np.stack(x), [matrix for _, matrix in pairs]


def moved_px(places_px: NDArray[np.float64], matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where places of a strip are in the changed one; shape (..., 2)."""
    moved: NDArray[np.float64] = places_px @ matrix[:2, :2].T + matrix[:2, 2]
    return moved


def warped(picture: NDArray[np.uint8], matrix: NDArray[np.float64], *, beyond: int | None = None) -> NDArray[np.uint8]:
    """A picture whose places are moved, what stands at its edges continued over them; masks have a value beyond."""
    # of pixels' middles, which are half a pixel from the edges that corners count from
    centred = matrix[:2, 2] + matrix[:2, :2] @ (0.5, 0.5) - 0.5
    affine = np.column_stack([matrix[:2, :2], centred])
    if beyond is None:
        flags, border = cv2.INTER_LINEAR, {"borderMode": cv2.BORDER_REPLICATE}
    else:
        flags, border = cv2.INTER_NEAREST, {"borderMode": cv2.BORDER_CONSTANT, "borderValue": beyond}
    return np.asarray(cv2.warpAffine(picture, affine, SIZE_PX, flags=flags, **border))


def _warped(pixels: NDArray[np.uint8], random: np.random.Generator) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    """A strip turned over, turned, scaled and shifted, and the matrix that does so."""
    matrix = np.eye(3)
    if random.random() < _FLIPPED_SHARE:
        matrix = np.array([[1.0, 0.0, 0.0], [0.0, -1.0, SIZE_PX[1]], [0.0, 0.0, 1.0]])
    if random.random() < _WARPED_SHARE:
        turn, scale = random.normal(0.0, _TURN_SD_RAD), math.exp(random.normal(0.0, _SCALE_SD))
        linear = scale * np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
        middle = np.array(SIZE_PX) / 2
        shift = middle - linear @ middle + random.normal(0.0, _SHIFT_SD_PX)
        matrix = np.vstack([np.column_stack([linear, shift]), [0.0, 0.0, 1.0]]) @ matrix
    return warped(pixels, matrix), matrix


def _lit_and_taken(x: Picture, random: np.random.Generator) -> Picture:
    for name, share in _SHARES.items():
        if random.random() < share:
            x = _CHANGES[name](x, random)
    return x


def _exposed(x: Picture, random: np.random.Generator) -> Picture:
    """A picture with other exposure, cast, noise and blur."""
    x = cv2.pow(x, math.exp(random.normal(0.0, _GAMMA_SD)))
    gains = math.exp(random.normal(0.0, _GAIN_SD)) * np.exp(random.normal(0.0, _CAST_SD, 3))
    offset = random.normal(0.0, _OFFSET_SD)
    x = cv2.transform(x, np.column_stack([np.diag(gains), [offset] * 3]))
    if random.random() < _BLURRED_SHARE:
        x = cv2.GaussianBlur(x, (3, 3), 0)
    noise_sd = np.float32(random.uniform(0.0, _MOST_NOISE))
    return x + random.standard_normal(x.shape, dtype=np.float32) * noise_sd


def _shades(x: Picture, random: np.random.Generator) -> Picture:
    """Broad differences of light, as between lamps."""
    coarse = random.normal(0.0, random.uniform(0.1, 0.5), (int(random.integers(2, 7)), int(random.integers(2, 4))))
    return _times(x, [np.exp(_resized(coarse.astype(np.float32)))] * 3)


def _bars(x: Picture, random: np.random.Generator) -> Picture:
    """Lamps that the floor mirrors: bars of light along rays from a camera; the car mirrors none."""
    count = int(random.integers(1, 16))
    distance, direction = (np.arange(size, dtype=np.float32) / size for size in _RAY_SIZE)
    start, length = random.uniform(0.0, 0.9, (count, 1)), random.uniform(0.1, 0.6, (count, 1))
    along = (distance - start) / length
    profile = np.where(along < 0, np.exp(-((along / 0.15) ** 2)), np.exp(-((along / 0.6) ** 2)))
    across = (direction - random.uniform(0.0, 1.0, (count, 1))) / random.uniform(0.002, 0.015, (count, 1))
    strength = random.uniform(0.05, random.uniform(0.1, 0.9), count)
    rays = (np.exp(-(across**2) / 2).T * strength) @ profile
    distance_px, angle = cv2.cartToPolar(*_from_camera(random))
    light = _remapped(
        rays.astype(np.float32), distance_px * (_RAY_SIZE[0] / _FAR_PX), (angle / math.pi - 0.5) * _RAY_SIZE[1]
    )
    light *= np.minimum(cv2.cvtColor(x, cv2.COLOR_RGB2GRAY) * 20, 1)
    return np.asarray(cv2.add(x, cv2.merge([light * tint for tint in _tint(random)])))


def _smear(x: Picture, random: np.random.Generator) -> Picture:
    """Blur along the rays of a camera that grows with distance, as its pixels cover ever more ground."""
    left, ahead = _from_camera(random)
    growing = np.sqrt(left * left + ahead * ahead) * np.float32(random.uniform(2.0, 14.0) / _FAR_PX**2)
    along_x, along_y = left * growing, ahead * growing
    rows, columns = _ROWS_COLUMNS
    total = x
    for place in _SMEARED:
        total = cv2.add(total, _remapped(x, columns + along_x * place, rows + along_y * place))
    return total / np.float32(len(_SMEARED) + 1)


def _seams(x: Picture, random: np.random.Generator) -> Picture:
    """The views of the cameras in front and behind, brighter or darker beyond a seam at each end of the car."""
    rows, columns = _ROWS_COLUMNS
    for towards in (-1, 1):
        slope, end = random.uniform(0.2, 1.5), random.uniform(*_CAR_END_PX)
        beyond = (rows - SIZE_PX[1] / 2) * towards - end - (SIZE_PX[0] - columns) * slope
        share = np.clip(beyond / random.uniform(1.0, 12.0) + 0.5, 0, 1)
        brighter = math.exp(random.normal(0.0, 0.25))
        x = _times(x, [1 + share * (brighter * tint - 1) for tint in _tint(random)])
    return x


def _grey(x: Picture, random: np.random.Generator) -> Picture:
    """Less colour."""
    kept = random.uniform(0.0, 1.0)
    grey = cv2.cvtColor(x, cv2.COLOR_RGB2GRAY)
    return np.asarray(cv2.addWeighted(x, kept, cv2.merge([grey] * 3), 1 - kept, 0))


def _sharp(x: Picture, random: np.random.Generator) -> Picture:
    """Sharpened, as cameras do."""
    blurred = cv2.GaussianBlur(x, (0, 0), random.uniform(0.7, 2.0))
    return np.clip(x + (x - blurred) * np.float32(random.uniform(0.3, 2.0)), 0, 1)


def _coarse(x: Picture, random: np.random.Generator) -> Picture:
    """Of fewer pixels, some more so across than along, or out of focus."""
    if random.random() < _OUT_OF_FOCUS_SHARE:
        return np.asarray(cv2.GaussianBlur(x, (0, 0), random.uniform(0.5, 1.6), sigmaY=random.uniform(0.5, 1.6)))
    width, height = (round(side * random.uniform(0.4, 0.9)) for side in SIZE_PX)
    return _resized(cv2.resize(x, (width, height), interpolation=cv2.INTER_AREA), cv2.INTER_LINEAR)


def _jpeg(x: Picture, random: np.random.Generator) -> Picture:
    """Kept as a JPEG."""
    pixels = (np.clip(x, 0, 1) * 255).astype(np.uint8)
    _, coded = cv2.imencode(".jpg", pixels, (cv2.IMWRITE_JPEG_QUALITY, int(random.integers(25, 90))))
    return cv2.imdecode(coded, cv2.IMREAD_COLOR).astype(np.float32) / 255


def _resized(x: NDArray[np.float32], interpolation: int = cv2.INTER_CUBIC) -> NDArray[np.float32]:
    return np.asarray(cv2.resize(x, SIZE_PX, interpolation=interpolation))


def _remapped(x: NDArray[np.float32], columns: NDArray[np.float32], rows: NDArray[np.float32]) -> NDArray[np.float32]:
    return np.asarray(cv2.remap(x, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE))


def _times(x: Picture, gains: Sequence[NDArray[np.float32]]) -> Picture:
    """A picture, its red, green and blue times maps of its size."""
    return np.asarray(cv2.multiply(x, cv2.merge(gains)))


def _tint(random: np.random.Generator) -> list[float]:
    """What red, green and blue of a light are multiplied by."""
    return [float(each) for each in np.exp(random.normal(0.0, 0.05, 3))]


def _from_camera(random: np.random.Generator) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """How far each pixel is to the right (below 0) and to the rear of a camera on the car (px)."""
    rows, columns = _ROWS_COLUMNS
    column, row = SIZE_PX[0] + random.uniform(0.5, 20.0), SIZE_PX[1] / 2 + random.normal(0.0, 30.0)
    return columns - np.float32(column), rows - np.float32(row)


_ROWS_COLUMNS = np.mgrid[: SIZE_PX[1], : SIZE_PX[0]].astype(np.float32)

_CHANGES: dict[str, Callable[[Picture, np.random.Generator], Picture]] = {
    "shades": _shades,
    "bars": _bars,
    "smear": _smear,
    "seams": _seams,
    "grey": _grey,
    "sharp": _sharp,
    "coarse": _coarse,
    "jpeg": _jpeg,
}
