"""Lit signs over vehicle doors: who may drive through, and who may not."""

import numpy as np
import shapely
from shapely import affinity

from garage2usd.assets.countries import Country
from garage2usd.assets.faces import box_faces, moved
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import text_length, text_shape
from garage2usd.assets.han_glyphs import is_han
from garage2usd.assets.mesh import Part, make_part
from garage2usd.objects.signage import SIGNAGE, Way

__all__ = ["lit_sign"]

_MOST_HEIGHT_M, _LEAST_HEIGHT_M = 0.5, 0.06
_LENGTH = 5.6
"""In heights of the sign, as all measures of what is on it."""
_TEXT, _HAN_TEXT, _TEXT_LENGTH = 0.5, 0.66, 3.4
_SYMBOLS_AT = (-2.3, 2.3)
_ARROW = ((-0.1, -0.36), (0.1, -0.36), (0.1, 0.0), (0.3, 0.0), (0.0, 0.36), (-0.3, 0.0), (-0.1, 0.0))
_PLATE, _DISC, _BAR = 0.84, 0.38, (0.27, 0.07)
"""Of the sign of no entry: side of the white plate, radius of the disc, half of its bar's length and width."""
_DEPTH_M, _LIFT_M = 0.06, 0.004


def lit_sign(
    name: str,
    way: Way,
    across_m: tuple[float, float],
    heights_m: tuple[float, float],
    wall_m: float,
    *,
    country: Country = Country.NONE,
    looks_back: bool = False,
) -> list[Part]:
    """A lit sign on a wall, as large as its room allows; none where that is too low.

    Parameters
    ----------
    name
        What its parts' names begin with.
    way
        What it says.
    across_m, heights_m
        The room for it along X and Y.
    wall_m
        Where the wall's face is along Z.
    country
        Whose words it has.
    looks_back
        Whether it looks to -Z, not to +Z.

    Notes
    -----
    Over a lane, green with an arrow that points down says that it is open (Vienna Convention on Road Signs and Signals,
    article 23), and a red disc with a white bar that nobody may enter (its sign C, 1; on a plate as R5-1 of the MUTCD).
    Letters and arrows are white, as on signs that show the way.
    """
    (left, right), (low, high) = across_m, heights_m
    height = min(high - low, (right - left) / _LENGTH, _MOST_HEIGHT_M)
    if height < _LEAST_HEIGHT_M:
        return []
    symbol = shapely.Polygon(_ARROW) if way.is_open else _around_disc()
    words = SIGNAGE[country].of(way)
    text = text_shape(words, min(_HAN_TEXT if is_han(words) else _TEXT, _TEXT_LENGTH / text_length(words)))
    drawn = shapely.union_all([text, *(affinity.translate(symbol, end) for end in _SYMBOLS_AT)])
    drawn = affinity.scale(drawn, height, height, origin=(0, 0))
    x, y = _LENGTH * height / 2, (low + high) / 2
    box = box_faces((-x, y - height / 2, 0.0), (x, y + height / 2, _DEPTH_M), without="n")
    legend = upright_triangles(drawn, middle_m=y, front_m=_DEPTH_M + _LIFT_M)
    turn = np.array([-1.0, 1.0, -1.0] if looks_back else [1.0, 1.0, 1.0])
    place = ((left + right) / 2, 0.0, wall_m)
    hue = "sign_green" if way.is_open else "sign_red"
    return [
        make_part(name, moved([face * turn for face in box], place), hue),
        make_part(f"{name}Legend", moved([face * turn for face in legend], place), "exit_white"),
    ]


def _around_disc() -> shapely.Geometry:
    """The white of the sign of no entry: its plate around the disc, and the bar on it."""
    bar = shapely.box(-_BAR[0], -_BAR[1], *_BAR)
    disc = shapely.Point(0, 0).buffer(_DISC, quad_segs=6).difference(bar)
    return shapely.box(-_PLATE / 2, -_PLATE / 2, _PLATE / 2, _PLATE / 2).difference(disc)
