"""Floor pictograms for pedestrians and drivers, as polygons without holes with their tops towards -Z."""

from functools import lru_cache
from itertools import pairwise

import shapely
from shapely import affinity

from garage2usd.config.look import Pictogram
from garage2usd.objects.outline import Polygon

__all__ = ["chevron", "pictogram"]

_STROKE, _FRAME = 0.09, 0.05
"""Widths of strokes and frame, as shares of the pictogram's size."""


@lru_cache(maxsize=64)
def chevron(size_m: float) -> tuple[Polygon, ...]:
    """Return two chevrons that point up (-Z), `size_m` wide."""
    half, rise, thick = size_m / 2, size_m * 0.3, size_m * 0.2
    return tuple(
        tuple(
            (round(x, 6), round(z + shift, 6))
            for x, z in (
                (-half, rise), (0.0, 0.0), (half, rise), (half, rise + thick), (0.0, thick), (-half, rise + thick),
            )
        )
        for shift in (-size_m * 0.35, size_m * 0.05)
    )  # fmt: skip


@lru_cache(maxsize=64)
def pictogram(of: Pictogram, size_m: float) -> tuple[Polygon, ...]:
    """Return the polygons of a pictogram in a square of `size_m` around the origin; empty for `Pictogram.NONE`."""
    if of is Pictogram.NONE:
        return ()
    shape = {Pictogram.WALKER: _walker, Pictogram.CAR: _car, Pictogram.LIFT: _lift}[of]()
    scaled = affinity.scale(shape, size_m, size_m, origin=(0, 0))
    pieces: list[Polygon] = []
    # parts with holes are cut through the middle of each hole
    for part in shapely.get_parts(scaled):
        cuts = [part]
        if part.interiors:
            left, top, right, bottom = part.bounds
            xs = sorted({left, right, *(sum(hole.bounds[::2]) / 2 for hole in part.interiors)})
            cuts = [
                piece
                for start, end in pairwise(xs)
                for piece in shapely.get_parts(part.intersection(shapely.box(start, top, end, bottom)))
            ]
        pieces += [
            tuple((round(x, 6), round(z, 6)) for x, z in shapely.get_coordinates(cut.exterior)[:-1].tolist())
            for cut in cuts
            if cut.geom_type == "Polygon"
        ]
    return tuple(pieces)


def _strokes(*lines: tuple[tuple[float, float], ...], width: float = _STROKE) -> list[shapely.Geometry]:
    """Return polylines as strokes of a width."""
    return [shapely.LineString(line).buffer(width / 2, cap_style="flat", join_style="mitre") for line in lines]


def _person(x: float, height: float) -> list[shapely.Geometry]:
    """Return a standing person at `x`, in front view."""
    top = -height / 2
    return [
        shapely.Point(x, top + 0.11 * height).buffer(0.11 * height, quad_segs=3),
        shapely.box(x - 0.12 * height, top + 0.25 * height, x + 0.12 * height, top + 0.62 * height),
        shapely.box(x - 0.11 * height, top + 0.6 * height, x - 0.02 * height, top + height),
        shapely.box(x + 0.02 * height, top + 0.6 * height, x + 0.11 * height, top + height),
    ]


def _walker() -> shapely.Geometry:
    """Return a walking person."""
    limbs = _strokes(
        ((0.02, -0.26), (-0.02, 0.08)),
        ((-0.02, 0.02), (0.14, 0.22), (0.16, 0.48)),
        ((-0.02, 0.02), (-0.08, 0.26), (-0.22, 0.46)),
        ((0.02, -0.2), (0.16, -0.04), (0.28, -0.02)),
        ((0.0, -0.2), (-0.14, -0.06), (-0.18, 0.08)),
        width=0.1,
    )
    return shapely.union_all([shapely.Point(0.04, -0.39).buffer(0.09, quad_segs=3), *limbs], grid_size=1e-4)


def _car() -> shapely.Geometry:
    """Return a car in side view."""
    body = shapely.Polygon(
        [(-0.5, 0.16), (-0.5, -0.02), (-0.34, -0.06), (-0.2, -0.24), (0.16, -0.24), (0.32, -0.05), (0.5, 0.0),
         (0.5, 0.16)]
    )  # fmt: skip
    windows = shapely.union_all(
        [
            shapely.Polygon([(-0.24, -0.06), (-0.15, -0.18), (-0.03, -0.18), (-0.03, -0.06)]),
            shapely.Polygon([(0.03, -0.06), (0.03, -0.18), (0.13, -0.18), (0.22, -0.06)]),
        ]
    )
    wheels = [shapely.Point(x, 0.16).buffer(0.11, quad_segs=3) for x in (-0.28, 0.28)]
    gaps = [shapely.Point(x, 0.16).buffer(0.14, quad_segs=3) for x in (-0.28, 0.28)]
    shell = shapely.difference(body, shapely.union_all([windows, *gaps]))
    return shapely.union_all([shell, *wheels], grid_size=1e-4)


def _lift() -> shapely.Geometry:
    """Return the symbol of a lift: three people in a cabin below two arrows."""
    cabin = shapely.difference(
        shapely.box(-0.46, -0.18, 0.46, 0.5), shapely.box(-0.46 + _FRAME, -0.18 + _FRAME, 0.46 - _FRAME, 0.5 - _FRAME)
    )
    people = [affinity.translate(shape, 0.0, 0.16) for x in (-0.25, 0.0, 0.25) for shape in _person(x, 0.46)]
    up = shapely.Polygon([(-0.2, -0.5), (-0.06, -0.3), (-0.34, -0.3)])
    down = shapely.Polygon([(0.2, -0.28), (0.06, -0.48), (0.34, -0.48)])
    return shapely.union_all([cabin, *people, up, down], grid_size=1e-4)
