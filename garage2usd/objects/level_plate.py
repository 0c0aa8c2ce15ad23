"""Plates with the name of a level beside the doors of stair cores."""

from dataclasses import dataclass

import numpy as np

from garage2usd.assets.countries import Country
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import text_length, text_shape
from garage2usd.assets.mesh import Asset, make_part
from garage2usd.objects.kind import Spec
from garage2usd.objects.signage import SIGNAGE
from garage2usd.objects.zone_plate import ZonePlateSpec

LEVEL_PLATE_WIDTH_M, _HEIGHT_M = 0.46, 0.36
_LIFT_M, _INK_M = 0.004, 0.007
"""Distances from the wall to the plate's front, and to its lettering."""
_NAME_M, _WORD_M, _MOST_WORD_M = 0.2, 0.075, 0.36
"""Heights of the name and of the word over it, and greatest length of the word."""
_NAME_AT_M, _WORD_AT_M = 0.135, 0.295
"""Heights of their middles over the lower edge."""


@dataclass(frozen=True)
class LevelPlateSpec(Spec, kind=ZonePlateSpec.kind):
    """A plate with the name of a level, ``U2``, facing +Z; origin in the middle of its lower edge.

    It is one field with the word for levels over the name, where plates of zones are a letter and a number on two.
    """

    text: str
    country: Country = Country.NONE

    def asset(self) -> Asset:
        """Make the meshes of a plate: white lettering on blue."""
        half = LEVEL_PLATE_WIDTH_M / 2
        field = np.array(
            [(-half, 0, _LIFT_M), (half, 0, _LIFT_M), (half, _HEIGHT_M, _LIFT_M), (-half, _HEIGHT_M, _LIFT_M)]
        )
        word = SIGNAGE[self.country].level
        word_m = min(_WORD_M, _MOST_WORD_M / text_length(word))
        parts = ("Word", word, word_m, _WORD_AT_M), ("Name", self.text, _NAME_M, _NAME_AT_M)
        return Asset(
            (
                make_part("Plate", [field], "sign_blue"),
                *(
                    make_part(
                        name, upright_triangles(text_shape(text, size), middle_m=at, front_m=_INK_M), "sign_white"
                    )
                    for name, text, size, at in parts
                ),
            )
        )
