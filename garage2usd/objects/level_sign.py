"""Hanging signs with the name of a level: the one that a ramp leads to, or the present one."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import shapely
from shapely import affinity

from garage2usd.assets.countries import Country
from garage2usd.assets.faces import box_faces
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import is_han, text_length, text_shape
from garage2usd.assets.mesh import Asset, Collider, Face, make_part
from garage2usd.objects.kind import Spec
from garage2usd.objects.lane_sign import LaneSignSpec
from garage2usd.objects.signage import SIGNAGE

_DEPTH_M, _ROD_M, _ON_FACE_M = 0.03, 0.008, 0.002
_MARGIN, _GAP = 0.28, 0.24
"""Space beside the legend and between its parts. These and all below are shares of the sign's height."""
_BORDER, _LINE = 0.05, 0.035
"""Distance of the white line from the edge, and its width."""
_NAME, _WORD, _HAN_WORD = 0.62, 0.36, 0.46
"""Heights of the level's name and of the words."""
_ARROW_LENGTH = 0.64
_ARROW = ((-0.06, 0.32), (0.06, 0.32), (0.06, -0.02), (0.2, -0.02), (0.0, -0.32), (-0.2, -0.02), (-0.06, -0.02))
"""Outline of the arrow that points up; its second coordinate is downwards."""
_ARROW_DEG = {"up": 0.0, "right": 90.0, "down": 180.0, "left": -90.0}


class Heading(StrEnum):
    """The direction of the arrow on a level sign; up also means straight ahead."""

    LEFT = "left"
    UP = "up"
    RIGHT = "right"
    DOWN = "down"


@dataclass(frozen=True)
class LevelSignSpec(Spec, kind=LaneSignSpec.kind):
    """A sign of a level facing +Z on two rods; origin on the ceiling over its middle, its top `top_m` below.

    Attributes
    ----------
    text
        Name of the level, ``U2``.
    heading
        Way to it; None for the level on which the sign hangs, which has the country's word for levels before its name.
    top_m, height_m
        Distance of the top below the ceiling, and height of the sign.
    is_way_out
        True if this is the way to the street too: then the country's word for vehicle exits follows.
    country
        Country of the words.
    """

    text: str
    heading: Heading | None
    top_m: float
    height_m: float
    is_way_out: bool = False
    country: Country = Country.NONE

    @property
    def width_m(self) -> float:
        """Width of the board."""
        parts = list(self._legend())
        length = sum(length for _, length, _ in parts) + _GAP * (len(parts) - 1)
        return round((length + 2 * _MARGIN) * self.height_m, 3)

    def asset(self) -> Asset:
        """Make the meshes of a sign: a blue board with a white border and legend, on two rods."""
        half, middle, front = self.width_m / 2, -self.top_m - self.height_m / 2, _DEPTH_M / 2
        low = -self.top_m - self.height_m
        board = box_faces((-half, low, -front), (half, -self.top_m, front))
        rods: list[Face] = []
        for x in (-half * 0.7, half * 0.7):
            rods += box_faces((x - _ROD_M, -self.top_m, -_ROD_M), (x + _ROD_M, 0.0, _ROD_M))
        across = half / self.height_m
        outer = shapely.box(_BORDER - across, _BORDER - 0.5, across - _BORDER, 0.5 - _BORDER)
        drawn = [("Border", outer.difference(outer.buffer(-_LINE, join_style="mitre")))]
        at = _MARGIN - across
        for name, length, shape in self._legend():
            drawn.append((name, affinity.translate(shape, at + length / 2)))
            at += length + _GAP
        return Asset(
            (
                make_part("Board", board, "sign_blue", collider=Collider.BOX),
                make_part("Rods", rods, "steel_dark"),
                *(
                    make_part(
                        name,
                        upright_triangles(
                            affinity.scale(shape, self.height_m, self.height_m, origin=(0, 0)),
                            middle_m=middle,
                            front_m=front + _ON_FACE_M,
                        ),
                        "sign_white",
                    )
                    for name, shape in drawn
                ),
            ),
        )

    def _legend(self) -> Iterator[tuple[str, float, shapely.Geometry]]:
        """Yield name, length and outline around the origin of each part of the legend from the left, for height 1."""
        words = SIGNAGE[self.country]
        if self.heading:
            arrow = affinity.rotate(shapely.Polygon(_ARROW), _ARROW_DEG[self.heading], origin=(0, 0))
            yield "Arrow", _ARROW_LENGTH, arrow
        else:
            yield _text("Word", words.level, _HAN_WORD if is_han(words.level) else _WORD)
        yield _text("Name", self.text, _NAME)
        if self.is_way_out:
            yield _text("Word", words.exit, _HAN_WORD if is_han(words.exit) else _WORD)


def _text(name: str, text: str, height: float) -> tuple[str, float, shapely.Geometry]:
    return name, text_length(text) * height, text_shape(text, height)
