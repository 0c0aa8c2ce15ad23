"""Zone plates on columns and walls."""

import math
import string
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from shapely import affinity

from garage2usd.assets.faces import bent
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import GLYPH_PITCH, GLYPH_WIDTH, text_shape
from garage2usd.assets.mesh import Asset, Face, make_part, pascal_case
from garage2usd.objects.column import ROUND_SEGMENTS
from garage2usd.objects.kind import Kind, Point, Spec

KIND = Kind(
    "zone_plate",
    number=21,
    label="zone_plate",
    cityscapes="traffic sign",
    is_solid=False,
    group="Columns",
    scattered="ZonePlates",
)

ZONE_PLATE_HEIGHT_M = 0.36
_LIFT_M, _INK_M = 0.004, 0.007
"""Distance from the wall or column to a zone plate's front, and to its lettering."""
_TEXT_SHARE = (0.86, 0.74)
"""Share of a field's width and height that the lettering of a zone plate may fill."""
_HUES = ("zone_blue", "zone_orange", "zone_green", "zone_red", "zone_violet", "zone_teal")
_SHARE, _BENT_SHARE = 0.88, 0.6
"""Width of a zone plate as a share of a column's side, and of a bent plate as a share of a round column's diameter."""
_YAWS_RAD = (0.0, math.pi / 2, math.pi, -math.pi / 2)
_Faces = NDArray[np.float64]


class Plate(NamedTuple):
    """A zone plate: its text, the middle (x, z) of its lower edge, its direction, its width and its bending radius.

    The bending radius is that of a round column; None for a flat plate.
    """

    text: str
    middle: Point
    yaw_rad: float
    width_m: float
    radius_m: float | None = None


@dataclass(frozen=True)
class ZonePlateSpec(Spec, kind=KIND):
    """A plate with the name of a zone, ``B12``, facing +Z; origin in the middle of its lower edge."""

    text: str
    width_m: float

    def plates(self) -> tuple[Plate, ...]:
        """Return the single zone plate."""
        return (Plate(self.text, (0.0, 0.0), 0.0, self.width_m),)

    def asset(self) -> Asset:
        """Make the meshes of a zone plate: letter in white on the zone's colour, number in that colour on white."""
        return _asset(self.plates())


@dataclass(frozen=True)
class ColumnPlatesSpec(Spec, kind=KIND):
    """The zone plates on a column; origin on its axis, at their lower edges.

    Attributes
    ----------
    sides
        Zones on the sides facing +Z, +X, -Z and -X; empty for a bare side.
    column_size_m
        Side of the column's bounding square.
    sides_m
        Distances from the column's axis to these sides; empty if they are those of the square.
    is_round
        True if the column is round, so that plates bend around it.
    """

    sides: tuple[str, ...]
    column_size_m: float
    sides_m: tuple[float, ...] = ()
    is_round: bool = False

    def plates(self) -> tuple[Plate, ...]:
        """Return the zone plates of a column, one on each side that is not bare."""
        front, right, back, left = self.sides_m or (self.column_size_m / 2,) * len(self.sides)
        middles = (0.0, front), (right, 0.0), (0.0, -back), (-left, 0.0)
        share, radius = (_BENT_SHARE, front) if self.is_round else (_SHARE, None)
        # the width of a side is the distance between the two adjacent sides
        widths = (right + left, front + back) * 2
        return tuple(
            Plate(zone, middle, yaw, round(share * width, 6), radius)
            for zone, middle, yaw, width in zip(self.sides, middles, _YAWS_RAD, widths, strict=True)
            if zone
        )

    def asset(self) -> Asset:
        """Make the meshes of a column's zone plates, each as in `ZonePlateSpec`."""
        return _asset(self.plates())


def _asset(plates: Iterable[Plate]) -> Asset:
    """Make the meshes of zone plates, one part per material."""
    faces: dict[str, list[Face]] = {}
    for plate in plates:
        cos, sin = round(math.cos(plate.yaw_rad)), round(math.sin(plate.yaw_rad))
        turn = np.array([(cos, 0, -sin), (0, 1, 0), (sin, 0, cos)])
        place = np.array((plate.middle[0], 0.0, plate.middle[1]))
        for material, found in _faces(plate.text, plate.width_m, plate.radius_m):
            faces.setdefault(material, []).extend(face @ turn + place for face in found)
    return Asset(tuple(make_part(pascal_case(key), each, key) for key, each in sorted(faces.items())))


@lru_cache(maxsize=1024)
def _faces(text: str, width_m: float, radius_m: float | None) -> tuple[tuple[str, tuple[Face, ...]], ...]:
    """Return material and faces of each field of a zone plate facing +Z, and of its lettering.

    They are cached, as a garage repeats a plate on many columns.
    """
    fields = ((material, [*triangles]) for material, triangles in _fields(text, width_m))
    if radius_m is not None:
        fields = ((material, bent(flat, radius_m, segments=ROUND_SEGMENTS)) for material, flat in fields)
    return tuple((material, tuple(found)) for material, found in fields)


def _fields(text: str, width_m: float) -> Iterator[tuple[str, _Faces]]:
    """Return material and faces of a zone plate's letter field, of its number field and of their lettering."""
    hue = _HUES[string.ascii_uppercase.index(text[0]) % len(_HUES)]
    fields = ((text[0], -width_m / 2, 0.0, hue, "sign_white"), (text[1:], 0.0, width_m / 2, "sign_white", hue))
    for written, left, right, ground, ink in fields:
        height, length = ZONE_PLATE_HEIGHT_M, GLYPH_WIDTH + GLYPH_PITCH * (len(written) - 1)
        shape = text_shape(written, min(_TEXT_SHARE[1] * height, _TEXT_SHARE[0] * (right - left) / length))
        shape = affinity.translate(shape, (left + right) / 2)
        yield (
            ground,
            np.array([[(left, 0, _LIFT_M), (right, 0, _LIFT_M), (right, height, _LIFT_M), (left, height, _LIFT_M)]]),
        )
        yield ink, upright_triangles(shape, middle_m=height / 2, front_m=_INK_M)
