"""Section of a garage of several levels: the cut of its meshes by a plane along the ramps, and outlines behind it."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.layout_reader import model_of
from garage2usd.as_built.openings import face_cuts
from garage2usd.as_built.shapes import Body, turned_about_y
from garage2usd.garage_model import GarageLevel
from garage2usd.layout import Layout, Placement
from garage2usd.objects.kind import Spec
from garage2usd.stage.prototypes import asset_of
from garage2usd.view.drawing import Colour, Drawing, Line, Point, Region, Text, text_width
from garage2usd.view.plan_sheet import GREY, INK, PAPER

_CUT: Colour = (96, 90, 86)
_CAR = "car"
_BEHIND: dict[str, Colour] = {"wall": (240, 238, 232), "column": (222, 220, 214), _CAR: (196, 208, 224)}
"""Kinds that are drawn behind the plane; walls hide objects behind them."""
_MASSIVE = ("beam", "ceiling", "column", "wall")
"""Kinds whose meshes lack faces that nobody sees."""
_DEPTH_M = 12.0
"""Greatest distance behind the plane of objects that are drawn."""
_OFF_AXIS_M = 0.013
"""The plane lies beside the middle of a ramp, where meshes have edges."""
_ROUNDING_M = 1e-4
_STRAIGHT_SIN = 0.02
_MAX_PX_PER_M, _MAX_SIDE_PX = 24.0, 4000
_LETTERS_SHARE, _LETTERS_M = 1 / 90, 0.6
_MARGIN_LETTERS, _HEAD_LETTERS, _FOOT_LETTERS = 9.0, 5.0, 4.0
_SCALE_BAR_M = 10.0

_Array = NDArray[np.float64]


@dataclass(frozen=True)
class _Plane:
    """An upright plane, seen along its normal.

    Attributes
    ----------
    origin
        (x, z) of a place on it.
    along
        Unit vector (x, z) to the right of somebody who looks at it; the normal away from them is to its left.
    """

    origin: Point
    along: Point

    @property
    def normal(self) -> _Array:
        """Unit vector of the direction of view; float64, shape (3,)."""
        return np.array([self.along[1], 0.0, -self.along[0]])

    @property
    def level(self) -> float:
        """Distance from the origin along its normal."""
        return self.origin[0] * self.along[1] - self.origin[1] * self.along[0]

    def drawn(self, points: _Array) -> _Array:
        """Return (along, depth below the street's floor) of points (x, height, z); shape (n, 2)."""
        return self.local(points)[:, :2] * [1.0, -1.0]

    def local(self, points: _Array) -> _Array:
        """Return (along, height, behind) of points (x, height, z); shape (n, 3)."""
        x, z = points[:, 0] - self.origin[0], points[:, 2] - self.origin[1]
        along_x, along_z = self.along
        return np.stack([x * along_x + z * along_z, points[:, 1], x * along_z - z * along_x], axis=1)


def draw_section(levels: Sequence[GarageLevel], *, storey_m: float) -> Drawing:
    """Draw the section of a garage of several levels along its ramps, or through both of its helices.

    Parameters
    ----------
    levels
        The levels, the top one first.
    storey_m
        Height from floor to floor.

    Notes
    -----
    Meshes are cut as they are written into the stage. Walls, columns and cars up to 12 m behind the plane are drawn as
    outlines.
    """
    plane = _plane(levels[0].layout)
    behind: list[tuple[float, Region]] = []
    cut: list[Region | Line] = []
    for level in levels:
        for placement in level.layout.placements:
            away_m, reach_m = plane.local(np.array([placement.position_m]))[0, 2], _reach_m(placement.spec)
            found: list[Region | Line] = []
            if abs(away_m) < reach_m and placement.kind != _CAR:
                found = list(_cut(placement, plane, level.floor_m))
            cut += found
            if placement.kind in _BEHIND and not found and 0 < away_m < _DEPTH_M:
                behind += [(away_m, region) for region in _silhouettes(placement, plane, level.floor_m)]
    ends = np.concatenate([element.points for element in cut])
    low, high = ends.min(axis=0), ends.max(axis=0)
    side_m = float((high - low).max())
    letters = max(_LETTERS_M, side_m * _LETTERS_SHARE)
    elements = [
        *(region for _, region in sorted(behind, key=lambda pair: -pair[0])),
        *sorted(cut, key=lambda element: isinstance(element, Line)),
        *_levels_marked(levels, storey_m, (float(low[0]), float(high[0])), letters),
        *_captions(levels, storey_m, low, high, letters),
    ]
    return Drawing(
        (float(low[0]) - _MARGIN_LETTERS * letters, float(low[1]) - _HEAD_LETTERS * letters),
        (float(high[0]) + _MARGIN_LETTERS * letters, float(high[1]) + _FOOT_LETTERS * letters),
        min(_MAX_PX_PER_M, _MAX_SIDE_PX / side_m),
        PAPER,
        f"Section through a parking garage of {len(levels)} levels",
        elements,
    )


def _plane(layout: Layout) -> _Plane:
    """Return the plane along the straight ramp down, or through the middles of both helices."""
    assert layout.well is not None
    down, up = ([(x, z) for x, _, z in lane.points] for lane in layout.well.lanes(layout.structure))
    first, last, back = np.array(down[0]), np.array(down[-1]), np.array(down[-2])
    way, way_out = last - first, last - back
    turn = (way[0] * way_out[1] - way[1] * way_out[0]) / (math.hypot(*way) * math.hypot(*way_out))
    if abs(turn) < _STRAIGHT_SIN:
        origin, across = first, way
    else:
        origin = _middle(down)
        across = _middle(up) - origin
    # orient the section to the right or downwards on the plan
    along = across / math.hypot(*across)
    along = along if along.sum() > 0 else -along
    beside = np.array([along[1], -along[0]]) * _OFF_AXIS_M
    x, z = origin + beside
    return _Plane((float(x), float(z)), (round(float(along[0])), round(float(along[1]))))


def _middle(points: Sequence[Point]) -> _Array:
    """Return the middle of the box around a line."""
    corners = np.array(points)
    middle: _Array = (corners.min(axis=0) + corners.max(axis=0)) / 2
    return middle


@lru_cache(maxsize=4096)
def _reach_m(spec: Spec) -> float:
    """Return the greatest distance of the meshes of a spec from its axis."""
    return max(
        (float(np.hypot(part.points[:, 0], part.points[:, 2]).max()) for part in asset_of(spec).parts), default=0
    )


def _bodies(placement: Placement, floor_m: float) -> tuple[Body, ...]:
    """Return the meshes of a placement in the garage."""
    x, y, z = placement.position_m
    matrix = turned_about_y(placement.yaw_rad, (x, y + floor_m, z))
    return model_of(placement.spec.shape).placed(matrix)


def _cut(placement: Placement, plane: _Plane, floor_m: float) -> Iterator[Region | Line]:
    """Yield the areas that the meshes of a placement close in the plane, and their lines."""
    found = []
    for body in _bodies(placement, floor_m):
        for cut in face_cuts(body, plane.normal, plane.level):
            ends = np.round(plane.drawn(cut) / _ROUNDING_M) * _ROUNDING_M
            found += [pair for pair in ends.reshape(-1, 2, 2) if not np.array_equal(*pair)]
    drawn = shapely.union_all(shapely.linestrings(np.array(found).reshape(-1, 2, 2)))
    areas = drawn.convex_hull if placement.kind in _MASSIVE else shapely.polygonize([*shapely.get_parts(drawn)])
    for area in shapely.get_parts(areas):
        if isinstance(area, shapely.Polygon):
            yield Region([(x, z) for x, z in area.exterior.coords[:-1]], _CUT, f"cut {placement.kind}")
    merged = shapely.line_merge(drawn) if drawn.geom_type == "MultiLineString" else drawn
    for line in shapely.get_parts(merged):
        yield Line([(x, z) for x, z in line.coords], INK, 0.02, f"cut {placement.kind}")


def _silhouettes(placement: Placement, plane: _Plane, floor_m: float) -> Iterator[Region]:
    """Yield the outlines of the touchable parts of a placement behind the plane."""
    for body in _bodies(placement, floor_m):
        hull = shapely.convex_hull(shapely.multipoints(plane.drawn(body.world_points())))
        if body.touches and isinstance(hull, shapely.Polygon):
            yield Region(list(hull.exterior.coords[:-1]), _BEHIND[placement.kind], placement.kind)


def _levels_marked(
    levels: Sequence[GarageLevel], storey_m: float, ends: tuple[float, float], letters: float
) -> Iterator[Line | Text]:
    """Mark the floor of each level with its name and height, and dimension the storeys."""
    left, right = ends[0] - letters, ends[1] + 3 * letters
    for level in levels:
        down = -level.floor_m
        words = f"{level.name}  {level.floor_m:+.2f}" if level.floor_m else f"{level.name}  0.00"
        yield Line([(left - text_width(words, letters), down), (ends[0], down)], GREY, letters / 20, "level")
        yield Text((left - text_width(words, letters), down - 0.6 * letters), words, letters, INK, True, kind="level")
        yield Line([(ends[1], down), (right + letters / 2, down)], GREY, letters / 20, "level")
    for upper in levels[:-1]:
        top = -upper.floor_m
        yield Line([(right, top), (right, top + storey_m)], INK, letters / 16, "dimension")
        at = right + letters, top + storey_m / 2
        yield Text(at, f"{storey_m:.2f}", letters, INK, is_turned=True, kind="dimension")


def _captions(
    levels: Sequence[GarageLevel], storey_m: float, low: _Array, high: _Array, letters: float
) -> Iterator[Line | Text]:
    """Draw the title above, and a scale bar of ten metres below."""
    stalls = sum(level.layout.parking_stalls for level in levels)
    words = f"Section through the ramps: {len(levels)} levels, {storey_m:.2f} m from floor to floor, {stalls} stalls"
    at = float(low[0]), float(low[1]) - 3 * letters
    yield Text(at, words, 1.4 * letters, INK, is_left=True, kind="title")
    x, z = float(low[0]), float(high[1]) + 2 * letters
    tick = letters / 3
    bar = [(x, z - tick), (x, z), (x + _SCALE_BAR_M, z), (x + _SCALE_BAR_M, z - tick)]
    yield Line(bar, INK, letters / 10, "scale")
    yield Text((x + _SCALE_BAR_M + letters / 2, z), "10 m", letters, INK, is_left=True, kind="scale")
