"""A survey: the stalls, lanes, columns and portals of an existing garage in metres, turned to axes along its stalls."""

import math
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
import shapely

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import Point, StallUse

Corners = tuple[Point, Point, Point, Point]
"""(x, z) of the corners of a stall in order."""
Ground: TypeAlias = shapely.Polygon | shapely.MultiPolygon
"""The ground inside the outline of a garage, or inside those of several lots."""
FRAME_KEY = "surveyFrame"
"""Name of the custom data of a stage with the frame of its survey on the earth."""
_QUARTER = math.pi / 2
_BIN_RAD = math.radians(0.5)
_MARGIN_M = 0.1
"""Distance in metres between the parts of a survey without an outline and its walls."""
_CLOSED_M = 10.0
"""Half the width in metres of gaps between parts that belong to the garage."""
_FILLED = 0.7
"""Share of a rectangle around all parts from which on it is the outline."""
_SMOOTHED_M = 1.0
_SLIT_M = 0.01
_USUAL_LANE_M = 6.0
_DIGITS = 6


class PortalKind(StrEnum):
    """Directions in which cars drive through a portal."""

    ENTRANCE = "entrance"
    EXIT = "exit"
    BOTH = "both"


class Unplaced(NamedTuple):
    """A part of a survey that its garage lacks, by its id in the source, with the reason."""

    name: str
    reason: str


@dataclass(frozen=True)
class SurveyedStall:
    """A stall of a survey.

    Attributes
    ----------
    name
        Id in the source.
    corners
        (x, z) of the four corners in order, either way round.
    mouth
        Number of the side that cars cross, the one from ``corners[mouth]`` to the next corner; None if unknown.
    use
        Use of the stall.
    size
        Its size class.
    number
        Number that is painted in the stall; empty if unknown.
    """

    name: str
    corners: Corners
    mouth: int | None = None
    use: StallUse = StallUse.STANDARD
    size: SizeClass = SizeClass.STANDARD
    number: str = ""


@dataclass(frozen=True)
class SurveyedLane:
    """The centre line of a lane, in the direction of driving if it is one-way.

    Attributes
    ----------
    points
        (x, z) of two points or more.
    width_m
        Width of the carriageway; None if unknown.
    one_way
        True if cars drive along the points only.
    """

    points: tuple[Point, ...]
    width_m: float | None = None
    one_way: bool = False


class SurveyedColumn(NamedTuple):
    """A square column: (x, z) of its middle, and its side."""

    centre: Point
    size_m: float


class SurveyedPortal(NamedTuple):
    """A place, (x, z), on or near the outline where cars enter or leave."""

    position: Point
    kind: PortalKind = PortalKind.BOTH


@dataclass(frozen=True)
class Survey:
    """An existing garage in metres, seen from above: x to the right, z downwards.

    Attributes
    ----------
    stalls, lanes, columns, portals
        Its parts. Without lanes, these are derived from the ground between the stalls.
    outline
        Inner faces of the outer walls, (x, z); None for a rectangle around all parts.
    other_outlines
        Those of further lots, apart from the first one and from each other.
    unread
        Parts of the source that are not in the survey.
    origin_deg
        Latitude and longitude of (0, 0) if the source has geographic coordinates.
    solids
        Corners (x, z) of each block on the floor, as of stairs, lifts and rooms.
    clear_height_m, ceiling_height_m
        Height below which nothing hangs, and that of the ceiling's underside; None if unknown.
    remarks
        What was mended or added to parts of the source, each with the name of the part.
    """

    stalls: tuple[SurveyedStall, ...]
    lanes: tuple[SurveyedLane, ...] = ()
    columns: tuple[SurveyedColumn, ...] = ()
    portals: tuple[SurveyedPortal, ...] = ()
    outline: tuple[Point, ...] | None = None
    other_outlines: tuple[tuple[Point, ...], ...] = field(default=(), kw_only=True)
    unread: tuple[Unplaced, ...] = field(default=(), repr=False)
    origin_deg: tuple[float, float] | None = None
    solids: tuple[tuple[Point, ...], ...] = ()
    remarks: tuple[str, ...] = ()
    clear_height_m: float | None = None
    ceiling_height_m: float | None = None

    def moved(self, turn_rad: float, shift_m: Point) -> "Survey":
        """Return the survey turned about (0, 0), from x towards z, and then shifted."""
        place = mover(turn_rad, shift_m)

        def places(points: tuple[Point, ...]) -> tuple[Point, ...]:
            return tuple(map(place, points))

        def quad(corners: Corners) -> Corners:
            one, other, beyond_other, beyond_one = map(place, corners)
            return one, other, beyond_other, beyond_one

        return replace(
            self,
            stalls=tuple(replace(stall, corners=quad(stall.corners)) for stall in self.stalls),
            lanes=tuple(replace(lane, points=places(lane.points)) for lane in self.lanes),
            columns=tuple(column._replace(centre=place(column.centre)) for column in self.columns),
            portals=tuple(portal._replace(position=place(portal.position)) for portal in self.portals),
            outline=None if self.outline is None else places(self.outline),
            other_outlines=tuple(map(places, self.other_outlines)),
            solids=tuple(map(places, self.solids)),
        )

    @property
    def ground(self) -> Ground:
        """The ground inside its outlines, of which there is one or more."""
        first, *others = map(shapely.Polygon, (self.outline, *self.other_outlines))
        return shapely.MultiPolygon([first, *others]) if others else first

    def stall_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each stall."""
        return [shapely.Polygon(stall.corners) for stall in self.stalls]

    def solid_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each block."""
        return [shapely.Polygon(corners) for corners in self.solids]

    def column_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each column."""
        return [shapely.Point(column.centre).buffer(column.size_m / 2, cap_style="square") for column in self.columns]


class Alignment(NamedTuple):
    """Rotation of a survey about its (0, 0), from x towards z, and the shift that follows."""

    turn_rad: float
    shift_m: Point

    def frame(self, origin_deg: tuple[float, float] | None) -> dict[str, str]:
        """Return latitude and longitude of (0, 0), turn and shift as custom data of a stage; empty without degrees."""
        if origin_deg is None:
            return {}
        return {FRAME_KEY: " ".join(map(repr, map(float, (*origin_deg, self.turn_rad, *self.shift_m))))}


def mover(turn_rad: float, shift_m: Point) -> Callable[[Point], Point]:
    """Return the function that turns a point (x, z) about (0, 0), from x towards z, and then shifts it."""
    cos, sin = float(np.cos(turn_rad)), float(np.sin(turn_rad))

    def place(point: Point) -> Point:
        x, z = point
        return round(x * cos - z * sin + shift_m[0], _DIGITS), round(x * sin + z * cos + shift_m[1], _DIGITS)

    return place


def aligned(survey: Survey) -> tuple[Survey, Alignment]:
    """Turn a survey so that most sides of its stalls lie along the axes, and shift its outline to (0, 0).

    Returns
    -------
    tuple
        The survey, which has an outline, and how it was moved.
    """
    (found,), alignment = aligned_together([survey])
    return found, alignment


def aligned_together(surveys: Sequence[Survey]) -> tuple[list[Survey], Alignment]:
    """Turn and shift surveys in one frame alike, as `aligned` does a single one."""
    turn_rad = -_main_direction_rad([stall for survey in surveys for stall in survey.stalls])
    turned = [survey.moved(turn_rad, (0.0, 0.0)) if turn_rad else survey for survey in surveys]
    turned = [
        replace(survey, outline=_outline_around(survey)) if survey.outline is None else survey for survey in turned
    ]
    left, top, _, _ = shapely.total_bounds([survey.ground for survey in turned]).tolist()
    shift_m = round(-left, _DIGITS), round(-top, _DIGITS)
    return [survey.moved(0.0, shift_m) for survey in turned], Alignment(turn_rad, shift_m)


def outlined(survey: Survey) -> Survey:
    """Return a survey with an outline around its stalls and lanes, along its stalls."""
    turn_rad = _main_direction_rad(survey.stalls)
    corners = _outline_around(replace(survey.moved(-turn_rad, (0.0, 0.0)), columns=()))
    return replace(survey, outline=tuple(map(mover(turn_rad, (0.0, 0.0)), corners)))


def _main_direction_rad(stalls: Iterable[SurveyedStall]) -> float:
    """Return the direction of most metres of the sides of stalls, within an eighth of a turn either way of an axis."""
    lengths_m: defaultdict[int, float] = defaultdict(float)
    moments: defaultdict[int, float] = defaultdict(float)
    for stall in stalls:
        for (x, z), (next_x, next_z) in pairwise((*stall.corners, stall.corners[0])):
            length_m = math.hypot(next_x - x, next_z - z)
            angle = math.remainder(math.atan2(next_z - z, next_x - x), _QUARTER)
            number = round(angle / _BIN_RAD)
            lengths_m[number] += length_m
            moments[number] += length_m * angle
    if not lengths_m:
        return 0.0
    main = max(lengths_m, key=lambda number: (round(lengths_m[number], 3), -abs(number)))
    near = [number for number in (main - 1, main, main + 1) if number in lengths_m]
    return round(sum(moments[number] for number in near) / sum(lengths_m[number] for number in near), 9)


def _outline_around(survey: Survey) -> tuple[Point, ...]:
    """Return an outline around all parts of a survey: a rectangle, unless the parts leave much of it empty."""
    parts: list[shapely.Geometry] = list(survey.stall_polygons())
    parts += [
        shapely.LineString(lane.points).buffer(width_m / 2, cap_style="flat", join_style="mitre")
        for lane in survey.lanes
        for width_m in [lane.width_m or _USUAL_LANE_M]
    ]
    parts += survey.column_polygons()
    rectangle = shapely.box(*shapely.total_bounds(parts)).buffer(_MARGIN_M, join_style="mitre")
    around = shapely.union_all(parts).buffer(_CLOSED_M, join_style="mitre").buffer(-_CLOSED_M, join_style="mitre")
    if around.geom_type == "Polygon" and around.area < _FILLED * rectangle.area:
        wider = shapely.Polygon(around.exterior).buffer(_SMOOTHED_M, join_style="mitre")
        outline = wider.simplify(_SMOOTHED_M - _MARGIN_M)
    else:
        outline = rectangle
    corners = _rounded(outline)
    if not shapely.Polygon(corners).is_valid:
        # it touches itself
        parts = shapely.get_parts(outline.buffer(-_SLIT_M, join_style="mitre"))
        corners = _rounded(shapely.Polygon(max(parts, key=shapely.area).exterior))
    return corners


def _rounded(outline: shapely.Polygon) -> tuple[Point, ...]:
    corners = shapely.get_coordinates(shapely.normalize(outline))[:-1]
    return tuple((round(float(x), 3), round(float(z), 3)) for x, z in corners)
