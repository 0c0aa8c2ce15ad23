"""Painted lane lines, arrows, zebra crossings and hatching, in metres relative to the centre of a floor panel."""

from functools import lru_cache

import shapely

from garage2usd.layout.placement import box_inside
from garage2usd.objects.outline import Polygon, rectangle
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.structure.stalls import Edge

__all__ = [
    "LINE_WIDTH_M",
    "arrow",
    "corner_lines",
    "dashes",
    "edge_line",
    "hatching",
    "stripes",
    "two_way_arrows",
    "zebra",
]

LINE_WIDTH_M = 0.12
_DASH_LENGTH_M = 2.0
_DASH_PERIOD_M = 4.05
_ZEBRA_BAR_M = 0.45
_ZEBRA_DEPTH_M = 3.0
_HATCH_WIDTH_M = 0.3
_HATCH_PERIOD_M = 1.2
_HATCH_MARGIN_M = 0.6
_HATCH_GAP_M = 0.1
_MIN_HATCHED_M = 1.0
_STRIPE_WIDTH_M, _STRIPE_PERIOD_M = 0.15, 0.5


@lru_cache(maxsize=4096)
def edge_line(edge: Edge, half_x: float, half_z: float, setback: float, trims: tuple[float, float]) -> Marking:
    """Return the yellow line along one edge of a lane square, `setback` inside the edge.

    ``trims`` shortens the line at its two ends (left and right, or top and bottom). All lengths are in metres.
    """
    half, (low, high) = half_x if edge.along_x else half_z, trims
    box = box_inside(edge, (half_x, half_z), (low - half, half - high), (setback, setback + LINE_WIDTH_M))
    return Marking(rectangle(*box), Surface.PAINT_YELLOW, Paint.LANE_LINE)


@lru_cache(maxsize=4096)
def corner_lines(vertical: Edge, horizontal: Edge, half_x: float, half_z: float, setback: float) -> tuple[Marking, ...]:
    """Return the yellow L-shaped line around a column in a corner between two open edges of a lane square."""
    inner = setback + LINE_WIDTH_M
    sign_z = -1 if vertical is Edge.UP else 1
    sign_x = -1 if horizontal is Edge.LEFT else 1

    def piece(x0: float, x1: float, z0: float, z1: float) -> Marking:
        """Return a rectangle of line by its distances from the corner's two edges."""
        xs = sorted((sign_x * (half_x - x0), sign_x * (half_x - x1)))
        zs = sorted((sign_z * (half_z - z0), sign_z * (half_z - z1)))
        return Marking(rectangle(xs[0], zs[0], xs[1], zs[1]), Surface.PAINT_YELLOW, Paint.LANE_LINE)

    return piece(0, inner, setback, inner), piece(setback, inner, 0, setback)


@lru_cache(maxsize=1024)
def dashes(half_x: float, half_z: float, *, along_x: bool) -> tuple[Marking, ...]:
    """Return the dashed white centre line of a two-way lane square; a whole number of dashes fits the square."""
    half_length, half_line = (half_x if along_x else half_z), LINE_WIDTH_M / 2
    count = max(1, round(2 * half_length / _DASH_PERIOD_M))
    period = 2 * half_length / count
    half_dash = min(_DASH_LENGTH_M, period / 2) / 2
    shapes: list[Polygon] = []
    for index in range(count):
        middle = -half_length + (index + 0.5) * period
        if along_x:
            shapes.append(rectangle(middle - half_dash, -half_line, middle + half_dash, half_line))
        else:
            shapes.append(rectangle(-half_line, middle - half_dash, half_line, middle + half_dash))
    return tuple(Marking(shape, Surface.PAINT_WHITE, Paint.LANE_LINE) for shape in shapes)


def arrow(x: float, z: float, towards: Edge) -> Marking:
    """Return a straight-ahead lane arrow, 2.4 m long, centred at (x, z)."""
    outline = ((-0.08, 1.2), (0.08, 1.2), (0.08, -0.2), (0.3, -0.2), (0.0, -1.2), (-0.3, -0.2), (-0.08, -0.2))
    turns = {
        Edge.UP: lambda p: (p[0], p[1]),
        Edge.DOWN: lambda p: (-p[0], -p[1]),
        Edge.LEFT: lambda p: (p[1], -p[0]),
        Edge.RIGHT: lambda p: (-p[1], p[0]),
    }
    turned = (turns[towards](point) for point in outline)
    return Marking(tuple((x + px, z + pz) for px, pz in turned), Surface.PAINT_WHITE, Paint.LANE_ARROW)


def two_way_arrows(half_x: float, half_z: float, setback: float, *, along_x: bool) -> tuple[Marking, Marking]:
    """Return one arrow for each direction of a two-way lane square, for traffic on the right."""
    if along_x:
        offset = (half_z - setback) / 2
        return arrow(0, offset, Edge.RIGHT), arrow(0, -offset, Edge.LEFT)
    offset = (half_x - setback) / 2
    return arrow(offset, 0, Edge.UP), arrow(-offset, 0, Edge.DOWN)


@lru_cache(maxsize=256)
def zebra(half_x: float, half_z: float, setback: float, *, along_x: bool, offset_m: float = 0.0) -> tuple[Marking, ...]:
    """Return the zebra crossing of a straight lane square, `offset_m` along the lane from the square's middle.

    The bars are parallel to the lane.
    """
    most = max((half_x if along_x else half_z) - _ZEBRA_DEPTH_M / 2, 0.0)
    offset_m = round(min(max(offset_m, -most), most), 6)
    room = 2 * ((half_z if along_x else half_x) - setback - LINE_WIDTH_M - _ZEBRA_BAR_M / 2)
    count = int((room + _ZEBRA_BAR_M) / (2 * _ZEBRA_BAR_M))
    half_bar, half_length = _ZEBRA_BAR_M / 2, _ZEBRA_DEPTH_M / 2
    bars: list[Polygon] = []
    for index in range(count):
        middle = round((index - (count - 1) / 2) * 2 * _ZEBRA_BAR_M, 6)
        across, along = (middle - half_bar, middle + half_bar), (offset_m - half_length, offset_m + half_length)
        (x0, x1), (z0, z1) = (along, across) if along_x else (across, along)
        bars.append(rectangle(x0, z0, x1, z1))
    return tuple(Marking(bar, Surface.PAINT_WHITE, Paint.CROSSING) for bar in bars)


@lru_cache(maxsize=256)
def stripes(left: float, top: float, right: float, bottom: float) -> tuple[Marking, ...]:
    """Return yellow diagonal stripes over a narrow keep-clear rectangle."""
    area = shapely.box(left, top, right, bottom)
    reach = (right - left) + (bottom - top)
    bars = []
    for index in range(int(reach / _STRIPE_PERIOD_M) + 1):
        start = left - (bottom - top) + index * _STRIPE_PERIOD_M
        corners = [(start, top), (start + _STRIPE_WIDTH_M, top)]
        corners += [(x + bottom - top, bottom) for x, _ in reversed(corners)]
        bars.append(shapely.Polygon(corners).intersection(area))
    shapes = [bar.exterior.coords[:-1] for bar in bars if bar.geom_type == "Polygon" and bar.area > 1e-6]  # noqa: PLR2004
    return tuple(
        Marking(tuple((round(x, 6), round(z, 6)) for x, z in shape), Surface.PAINT_YELLOW, Paint.HATCHING)
        for shape in shapes
    )


@lru_cache(maxsize=256)
def hatching(
    half_x: float, half_z: float, *, margin_m: float = _HATCH_MARGIN_M, surface: Surface = Surface.PAINT_YELLOW
) -> tuple[Marking, ...]:
    """Return the frame and stripes of a no-parking area, `margin_m` inside the edges; empty if the area is small."""
    x, z = half_x - margin_m, half_z - margin_m
    if min(x, z) < _MIN_HATCHED_M / 2:
        return ()
    area = shapely.box(-x, -z, x, z)
    inside = area.buffer(-LINE_WIDTH_M - _HATCH_GAP_M, join_style="mitre")
    reach = x + z
    stripes = []
    for index in range(int(2 * reach / _HATCH_PERIOD_M) + 1):
        start = -reach + index * _HATCH_PERIOD_M
        stripe = shapely.Polygon(
            [(start - z, -z), (start + _HATCH_WIDTH_M - z, -z), (start + _HATCH_WIDTH_M + z, z), (start + z, z)]
        )
        stripes.append(stripe.intersection(inside))
    frame = (
        rectangle(-x, -z, x, -z + LINE_WIDTH_M),
        rectangle(-x, z - LINE_WIDTH_M, x, z),
        rectangle(-x, -z + LINE_WIDTH_M, -x + LINE_WIDTH_M, z - LINE_WIDTH_M),
        rectangle(x - LINE_WIDTH_M, -z + LINE_WIDTH_M, x, z - LINE_WIDTH_M),
    )
    shapes = [*frame, *(tuple(s.exterior.coords)[:-1] for s in stripes if s.geom_type == "Polygon" and s.area > 1e-6)]  # noqa: PLR2004
    return tuple(
        Marking(tuple((round(px, 6), round(pz, 6)) for px, pz in shape), surface, Paint.HATCHING) for shape in shapes
    )
