"""Hatching at the ends of rows of stalls, beside columns."""

import shapely

from garage2usd.config.look import MarkingsLook
from garage2usd.garage import StallKind
from garage2usd.layout.tiles import StallPlace, Tile, row_rectangle
from garage2usd.objects.outline import rectangle
from garage2usd.objects.panel import Marking, Paint, Surface

__all__ = ["row_end_hatching"]

_LEAST_M = 0.2
"""Least width of hatched floor."""
_STRIPE_M, _PERIOD_M = 0.14, 0.62
_LEAST_M2 = 1e-4


def row_end_hatching(tile: Tile, places: list[StallPlace], look: MarkingsLook) -> tuple[Marking, ...]:
    """Hatch the floor between the outermost stalls of a square and its sides; adjacent hatchings form chevrons."""
    markings: list[Marking] = []
    line = look.line_width_m
    for place in places:
        row, edge, count = place.row, place.row.edge, place.row.count
        if row.shape.kind is StallKind.ANGLED:
            continue
        half, length = tile.half_x_m if edge.along_x else tile.half_z_m, row.shape.depth_m
        inner = -row.starts_m[0] + line / 2
        if half - inner < _LEAST_M:
            continue
        ends = [-1] * (place.is_first and place.slot == 0) + [1] * (place.is_last and place.slot == count - 1)
        for side in ends:
            for polygon in _stripes(inner, half, length, line):
                corners = [row_rectangle(tile, edge, side * x, side * x, (z, z))[0] for x, z in polygon]
                markings.append(Marking(tuple(corners), Surface.PAINT_EDGE, Paint.HATCHING))
    return tuple(markings)


def _stripes(inner: float, outer: float, length: float, line: float) -> list[tuple[tuple[float, float], ...]]:
    """Frame and stripes in coordinates along the row, from its centre, and inwards from the stalls' entries."""
    field = shapely.box(inner, line, outer, length - line)
    shapes = [rectangle(inner, 0.0, outer, line), rectangle(inner, length - line, outer, length)]
    wide = outer - inner
    for index in range(int((length + wide) / _PERIOD_M) + 1):
        near = index * _PERIOD_M - wide
        bar = shapely.Polygon(
            [(inner, near), (outer, near + wide), (outer, near + wide + _STRIPE_M), (inner, near + _STRIPE_M)]
        ).intersection(field)
        if bar.geom_type == "Polygon" and bar.area > _LEAST_M2:
            shapes.append(tuple(map(tuple, shapely.get_coordinates(bar.exterior)[:-1].tolist())))
    return shapes
