"""Painted markings in metres: lane lines, arrows, zebra crossings, hatching, and pictograms for the floor."""

from functools import lru_cache
from itertools import pairwise

import shapely
from shapely import affinity

from garage2usd.config.look import Pictogram
from garage2usd.layout.placement import box_inside
from garage2usd.objects.kind import Polygon, rectangle
from garage2usd.objects.panel import Marking, Paint, Surface
from garage2usd.structure.stalls import Edge

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
_LEAST_M2 = 1e-6
_STROKE, _FRAME = 0.09, 0.05
"""Widths of strokes and frame, as shares of the pictogram's size."""


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


def area_markings(
    area: shapely.Geometry, surface: Surface, paint: Paint | None = Paint.LANE_LINE
) -> tuple[Marking, ...]:
    """Convert an area to markings: polygons without holes."""
    parts = [part for part in shapely.get_parts(area) if part.geom_type == "Polygon" and part.area > _LEAST_M2]
    whole = []
    for part in parts:
        if not part.interiors:
            whole.append(part)
            continue
        left, top, right, bottom = part.bounds
        middle = (left + right) / 2
        for side in (shapely.box(left, top, middle, bottom), shapely.box(middle, top, right, bottom)):
            whole += list(shapely.get_parts(part.intersection(side)))
    return tuple(Marking(polygon_of(part), surface, paint) for part in sorted(whole, key=lambda part: part.bounds))


def polygon_of(shape: shapely.Polygon) -> Polygon:
    """Convert a shapely polygon to corners, rounded to the micrometre."""
    return tuple((round(x, 6), round(z, 6)) for x, z in shapely.get_coordinates(shape.exterior)[:-1].tolist())


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
