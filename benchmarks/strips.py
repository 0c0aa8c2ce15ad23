"""Strips: pictures of the ground beside a car, with the entry corners of the slots in them, as folders keep them.

A folder of strips has ``corners.json``, in which each picture's name has its entry corners as [x px, y px, is occluded]
from the left upper edge, and the pictures themselves in folders that are called after a garage and the side of the car
that they show: ``garage_a_left/000017.jpg``, ``garage_a_right/000017.jpg``. All are 96 px wide and 300 px high,
forwards at the top. Where they show the right side the car is at their left edge: they are mirrored, so that there is
one kind.
"""

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from garage2usd.common.errors import ConfigError

__all__ = ["CORNERS_FILE", "SIDES", "SIZE_PX", "Strip", "is_mirrored", "read_strips", "write_strips"]

SIZE_PX = 96, 300
"""Width and height of all strips."""
SIDES = ("left", "right")
CORNERS_FILE = "corners.json"
_FIELDS = 3


@dataclass(frozen=True, eq=False)
class Strip:
    """A picture of the ground to the left of a car, whose edge is the picture's right one.

    Attributes
    ----------
    name
        File and folder it was read from.
    garage
        The garage that it shows.
    pixels
        uint8, shape (300, 96, 3).
    corners_px
        (column, row) of the entry corners, the pixel (i, j) covers [i, i + 1) x [j, j + 1); float64, shape (n, 2).
    is_occluded
        Which of them something hides; bool, shape (n,).
    """

    name: str
    garage: str
    pixels: NDArray[np.uint8]
    corners_px: NDArray[np.float64]
    is_occluded: NDArray[np.bool_]

    @property
    def seen_px(self) -> NDArray[np.float64]:
        """The corners that nothing hides; float64, shape (n, 2)."""
        return self.corners_px[~self.is_occluded]


def read_strips(folder: Path) -> list[Strip]:
    """The strips of a folder, by their names.

    Raises
    ------
    ConfigError
        If the folder, its table or a picture is missing or is not as it should be; names the file.
    """
    table = folder / CORNERS_FILE
    try:
        corners = json.loads(table.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise ConfigError("FOLDER", str(folder), f"a folder with {CORNERS_FILE}, a JSON table of corners") from None
    if not isinstance(corners, dict) or not corners:
        raise ConfigError("FOLDER", str(table), "a table with the corners of each picture by its name")
    return [_strip(folder, name, corners[name]) for name in sorted(corners)]


def write_strips(folder: Path, corners: dict[str, list[tuple[float, float, bool]]]) -> None:
    """Write the table of strips whose pictures stand in the folder already."""
    lines = ",\n".join(f"{json.dumps(name)}: {json.dumps(corners[name])}" for name in sorted(corners))
    (folder / CORNERS_FILE).write_text(f"{{\n{lines}\n}}\n", encoding="utf-8")


def is_mirrored(name: str) -> bool:
    """Whether a picture of a folder of strips shows the right side of a car, and is therefore read mirrored."""
    return Path(name).parent.name.endswith("_right")


def _strip(folder: Path, name: str, corners: object) -> Strip:
    place, file = folder / name, str(folder / name)
    garage, _, side = place.parent.name.rpartition("_")
    if not garage or side not in SIDES:
        raise ConfigError("FOLDER", file, "pictures in folders called GARAGE_left and GARAGE_right")
    try:
        with Image.open(place) as image:
            pixels = np.asarray(image.convert("RGB"))
    except (OSError, UnidentifiedImageError):
        raise ConfigError("FOLDER", file, f"a picture, as {CORNERS_FILE} has its corners") from None
    if pixels.shape[1::-1] != SIZE_PX:
        raise ConfigError(
            "FOLDER", file, f"pictures of {SIZE_PX[0]} x {SIZE_PX[1]} px, not {image.width} x {image.height}"
        )
    places, is_occluded = _corners(file, corners)
    if is_mirrored(name):
        pixels = pixels[:, ::-1]
        places[:, 0] = SIZE_PX[0] - places[:, 0]
    return Strip(name, garage, np.ascontiguousarray(pixels), places, is_occluded)


def _corners(file: str, corners: object) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Places and whether they are hidden."""
    allowed = f"its corners in {CORNERS_FILE} as [x px, y px, is occluded], within the picture"
    if not isinstance(corners, Sequence):
        raise ConfigError("FOLDER", file, allowed)
    try:
        rows = np.array([[float(value) for value in corner] for corner in corners]).reshape(-1, _FIELDS)
    except (TypeError, ValueError):
        raise ConfigError("FOLDER", file, allowed) from None
    if not ((rows[:, :2] >= 0) & (rows[:, :2] <= SIZE_PX)).all():
        raise ConfigError("FOLDER", file, allowed)
    return rows[:, :2].copy(), rows[:, 2] > 0
