"""Lit exit signs over the aisles."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from shapely import affinity

from garage2usd.assets.countries import Country
from garage2usd.assets.faces import box_faces
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import text_length, text_shape
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.objects.kind import Kind, Spec, VariantSet
from garage2usd.objects.signage import SIGNAGE, Signage, running_man

KIND = Kind("exit_sign", number=24, label="exit_sign", cityscapes="traffic sign", follows=VariantSet.CEILING)


class Turn(StrEnum):
    """The direction of the arrow on an exit sign."""

    LEFT = "left"
    AHEAD = "ahead"
    RIGHT = "right"


_ARROW_DEG = {Turn.LEFT: -90.0, Turn.AHEAD: 0.0, Turn.RIGHT: 90.0}
EXIT_SIGN_WIDTH_M = 0.8
_SIGN_DEPTH_M = 0.05
_LEGEND_M, _GAP_M = (-0.37, 0.12), 0.04
_RUNNER, _RUNNER_HALF, _WORD = 0.86, 0.62, 0.62
"""Heights of the pictogram and the word as shares of the exit sign's, and half the pictogram's width per height."""
# strokes of E, X, I and T as quadrilaterals in a cell of 1 x 1, counter-clockwise
_BAR = 0.2
_LETTERS: dict[str, list[tuple[tuple[float, float], ...]]] = {
    "E": [((0, 0), (_BAR, 0), (_BAR, 1), (0, 1))]
    + [((_BAR + 0.01, y), (0.75, y), (0.75, y + _BAR), (_BAR + 0.01, y + _BAR)) for y in (0.0, 0.4, 0.8)],
    "X": [
        ((0, 0), (0.24, 0), (0.8, 1), (0.56, 1)),
        ((0.56, 0), (0.8, 0), (0.5, 0.44), (0.38, 0.32)),
        ((0.3, 0.56), (0.42, 0.68), (0.24, 1), (0, 1)),
    ],
    "I": [((0.3, 0), (0.5, 0), (0.5, 1), (0.3, 1))],
    "T": [((0.3, 0), (0.5, 0), (0.5, 0.79), (0.3, 0.79)), ((0, 0.8), (0.8, 0.8), (0.8, 1), (0, 1))],
}


@dataclass(frozen=True)
class ExitSignSpec(Spec, kind=KIND):
    """A lit exit sign facing +Z; origin on the ceiling over its middle, its top `top_m` below the ceiling."""

    turn: Turn
    top_m: float
    height_m: float
    country: Country = Country.NONE

    def asset(self) -> Asset:
        """Make the meshes of an exit sign: a box on two rods with an arrow and the country's pictogram or word."""
        signs = SIGNAGE[self.country]
        ground, ink = ("housing_white", "sign_red") if signs.is_red else ("exit_green", "exit_white")
        half, low = EXIT_SIGN_WIDTH_M / 2, -self.top_m - self.height_m
        box = box_faces((-half, low, -_SIGN_DEPTH_M / 2), (half, -self.top_m, _SIGN_DEPTH_M / 2))
        rods: list[Face] = []
        for x in (-half * 0.8, half * 0.8):
            rods += box_faces((x - 0.008, -self.top_m, -0.008), (x + 0.008, 0.0, 0.008))
        front, middle = _SIGN_DEPTH_M / 2 + 0.002, low + self.height_m / 2
        return Asset(
            (
                make_part("Box", box, ground, collider=Collider.BOX),
                make_part("Rods", rods, "steel_dark"),
                *_arrow(_ARROW_DEG[self.turn], 0.24, middle, front, self.height_m * 0.4, ink),
                *(
                    _legend(signs, middle, front, self.height_m, ink)
                    if self.country
                    else _letters(middle, front, self.height_m * 0.5)
                ),
            ),
        )


def _arrow(turn_deg: float, x: float, y: float, z: float, reach: float, ink: str) -> list[Part]:
    """Make the arrow of an exit sign from a shaft and a head."""
    angle = -np.radians(turn_deg)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    shaft = [(-0.018, -reach), (0.018, -reach), (0.018, 0.1 * reach), (-0.018, 0.1 * reach)]
    head = [(-0.06, 0.1 * reach), (0.06, 0.1 * reach), (0.0, reach)]
    faces = [np.column_stack([np.array(shape) @ turn + (x, y), np.full(len(shape), z)]) for shape in (shaft, head)]
    return [make_part(name, [face], ink) for name, face in zip(("ArrowShaft", "ArrowHead"), faces, strict=True)]


def _legend(signs: Signage, y: float, z: float, height_m: float, ink: str) -> list[Part]:
    """Make the pictogram and the word on the left of an exit sign."""
    left, right = _LEGEND_M
    shapes = []
    if signs.has_runner:
        side = _RUNNER * height_m
        man = affinity.affine_transform(running_man(), [side, 0, 0, -side, 0, side / 2])
        x = left + side * _RUNNER_HALF if signs.exit_sign else (left + right) / 2
        shapes.append(("Runner", affinity.translate(man, x)))
        left += side * 2 * _RUNNER_HALF + _GAP_M
    if signs.exit_sign:
        size = min(_WORD * height_m, (right - left) / text_length(signs.exit_sign))
        shapes.append(("Word", affinity.translate(text_shape(signs.exit_sign, size), (left + right) / 2)))
    return [make_part(name, upright_triangles(shape, middle_m=y, front_m=z), ink) for name, shape in shapes]


def _letters(y: float, z: float, size: float) -> list[Part]:
    """Make the word EXIT on the left of an exit sign, one part per stroke."""
    parts = []
    for index, letter in enumerate("EXIT"):
        left = -0.34 + index * size * 0.95
        for number, stroke in enumerate(_LETTERS[letter], start=1):
            face = np.array([(left + px * size, y + (py - 0.5) * size, z) for px, py in stroke])
            parts.append(make_part(f"Letter{letter}{number}", [face], "exit_white"))
    return parts
