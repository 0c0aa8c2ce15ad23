"""Lit signs over vehicle doors: ways in and out, and no entry."""

import numpy as np
import shapely
from shapely import affinity

from garage2usd.assets.countries import Country
from garage2usd.assets.faces import box_faces, moved
from garage2usd.assets.flat import upright_triangles
from garage2usd.assets.glyphs import is_han, text_length, text_shape
from garage2usd.assets.mesh import Part, make_part
from garage2usd.objects.signage import SIGNAGE, Way

_MOST_HEIGHT_M = 0.5
LEAST_SIGN_M = 0.06
"""Least height of a lit sign."""
_LENGTH = 5.6
"""Length of a lit sign in sign heights, the unit of all measures on it."""
_TEXT, _HAN_TEXT, _TEXT_LENGTH = 0.5, 0.66, 3.4
_SYMBOLS_AT = (-2.3, 2.3)
_ARROW = ((-0.1, -0.36), (0.1, -0.36), (0.1, 0.0), (0.3, 0.0), (0.0, 0.36), (-0.3, 0.0), (-0.1, 0.0))
_PLATE, _DISC, _BAR = 0.84, 0.38, (0.27, 0.07)
"""Measures of the no-entry sign: side of its white plate, radius of its disc, half length and half width of its bar."""
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
    """Make a lit sign on the wall over a vehicle door, as large as fits; none if the space is too low.

    Parameters
    ----------
    name
        Prefix of the names of the sign's parts.
    way
        Message of the sign.
    across_m, heights_m
        Space for the sign along X and Y.
    wall_m
        Z of the wall's face.
    country
        Country of the sign's words.
    looks_back
        True if the sign faces -Z, else +Z.

    Notes
    -----
    A green sign with an arrow that points down marks an open lane (Vienna Convention on Road Signs and Signals, article
    23). A red disc with a white bar forbids entry (its sign C, 1; on a plate as R5-1 of the MUTCD). Letters and arrows
    are white, as on direction signs.
    """
    (left, right), (low, high) = across_m, heights_m
    height = min(high - low, (right - left) / _LENGTH, _MOST_HEIGHT_M)
    if height < LEAST_SIGN_M:
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
    """Return the white areas of a no-entry sign: the plate around the disc, and the bar."""
    bar = shapely.box(-_BAR[0], -_BAR[1], *_BAR)
    disc = shapely.Point(0, 0).buffer(_DISC, quad_segs=6).difference(bar)
    return shapely.box(-_PLATE / 2, -_PLATE / 2, _PLATE / 2, _PLATE / 2).difference(disc)
