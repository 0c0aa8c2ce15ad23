"""A survey: the stalls, lanes, columns and portals of an existing garage in metres, as its drawings have them."""

from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import Point, StallUse

__all__ = [
    "Corners",
    "PortalKind",
    "Survey",
    "SurveyedColumn",
    "SurveyedLane",
    "SurveyedPortal",
    "SurveyedStall",
    "Unplaced",
]

Corners = tuple[Point, Point, Point, Point]
"""(x, z) of the corners of a stall in order."""


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
    unread
        Parts of the source that are not in the survey.
    origin_deg
        Latitude and longitude of (0, 0) if the source has geographic coordinates.
    solids
        Corners (x, z) of each block on the floor, as of stairs, lifts and rooms.
    """

    stalls: tuple[SurveyedStall, ...]
    lanes: tuple[SurveyedLane, ...] = ()
    columns: tuple[SurveyedColumn, ...] = ()
    portals: tuple[SurveyedPortal, ...] = ()
    outline: tuple[Point, ...] | None = None
    unread: tuple[Unplaced, ...] = field(default=(), repr=False)
    origin_deg: tuple[float, float] | None = None
    solids: tuple[tuple[Point, ...], ...] = ()

    def moved(self, turn_rad: float, shift_m: Point) -> "Survey":
        """Return the survey turned about (0, 0), from x towards z, and then shifted."""
        cos, sin = float(np.cos(turn_rad)), float(np.sin(turn_rad))

        def place(point: Point) -> Point:
            x, z = point
            return round(x * cos - z * sin + shift_m[0], 6), round(x * sin + z * cos + shift_m[1], 6)

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
            solids=tuple(map(places, self.solids)),
        )

    def stall_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each stall."""
        return [shapely.Polygon(stall.corners) for stall in self.stalls]

    def solid_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each block."""
        return [shapely.Polygon(corners) for corners in self.solids]

    def column_polygons(self) -> list[shapely.Polygon]:
        """Return the ground of each column."""
        return [shapely.Point(column.centre).buffer(column.size_m / 2, cap_style="square") for column in self.columns]
