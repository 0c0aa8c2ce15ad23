"""Surveys as TOML: the drawing of a garage in metres, with single stalls, runs of equal ones, lanes and columns."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from garage2usd.common.documents import read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, validated
from garage2usd.config.stalls import AngleDeg, SizeClass
from garage2usd.garage import Point, StallKind, StallUse
from garage2usd.native import elementary
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import PortalKind, Survey
from garage2usd.survey.text import MOST_M

Metres = Annotated[float, Field(ge=-MOST_M, le=MOST_M)]
Place = tuple[Metres, Metres]
SideM = Annotated[float, Field(gt=0, le=100)]
_MOST_STALLS = 10_000
_WHOLE = 1e-6
_WIDTH_M, _LENGTH_M = 2.5, 5.0


class DrawnStall(Settings):
    """A stall, by its four corners or as a rectangle around its middle."""

    id: str = ""
    """Name in messages and in the stage; left out, its place in the file."""
    corners: tuple[Place, Place, Place, Place] | None = None
    """(x, z) of the corners in order, either way round."""
    centre: Place | None = None
    """(x, z) of the middle of a rectangle."""
    heading_deg: float | None = Field(None, ge=-360, le=360)
    """Heading of a car parked nose in in the rectangle, counter-clockwise from x as seen from above."""
    width_m: SideM | None = None
    """Width of the rectangle, across the heading."""
    length_m: SideM | None = None
    """Length of the rectangle, along the heading."""
    mouth: int | None = Field(None, ge=0, le=3)
    """Number of the corner at which the side starts that cars cross; left out, the one towards the lane."""
    use: StallUse = StallUse.STANDARD
    """Use of the stall."""
    size: SizeClass = SizeClass.STANDARD
    """Size class of the stall."""
    number: str | int = ""
    """Number that is painted in the stall."""

    @model_validator(mode="after")
    def _in_one_form(self) -> Self:
        rectangle = (self.centre, self.heading_deg, self.width_m, self.length_m)
        if self.corners is None and None in rectangle:
            raise ValueError("corners, or centre, heading_deg, width_m and length_m")
        if self.corners is not None and any(value is not None for value in rectangle):
            raise ValueError("either corners, or centre, heading_deg, width_m and length_m")
        if self.corners is None and self.mouth is not None:
            raise ValueError("mouth for stalls with corners; the mouth of others is at the tail of their heading")
        return self

    def quad(self) -> tuple[Point, Point, Point, Point]:
        """Return the corners (x, z); of a stall with a heading, those of its mouth first."""
        if self.corners is not None:
            return self.corners
        x, z = self.centre or (0.0, 0.0)
        heading = math.radians(self.heading_deg or 0.0)
        cos, sin = elementary.cos(heading), elementary.sin(heading)
        length_m, width_m = (self.length_m or 0.0) / 2, (self.width_m or 0.0) / 2

        def at(along: float, left: float) -> Point:
            return x + along * cos - left * sin, z - along * sin - left * cos

        return at(-length_m, width_m), at(-length_m, -width_m), at(length_m, -width_m), at(length_m, width_m)


class DrawnRun(Settings):
    """Equal stalls side by side along a straight line in front of them, the line of their mouths."""

    id: str = ""
    """Name that those of the stalls begin with; left out, its place in the file."""
    first: Place
    """(x, z) of one end of the line."""
    last: Place
    """(x, z) of its other end."""
    side: Literal["left", "right"]
    """The side of the stalls, for somebody who looks from first to last."""
    count: int | None = Field(None, ge=1, le=_MOST_STALLS)
    """Number of the stalls; left out, as many as the line has room for."""
    width_m: SideM | None = None
    """Width of a stall, across its car; left out, the share of the line, and 2.5 m in parallel stalls."""
    length_m: SideM | None = None
    """Length of a stall, along its car; left out, 5 m, and in parallel stalls the share of the line. If count and the
    measure along the line are both given, the stalls begin at first."""
    kind: StallKind = StallKind.PERPENDICULAR
    """'perpendicular', 'angled' or 'parallel'."""
    angle_deg: AngleDeg | None = None
    """Angle of angled stalls to the line."""
    leans: Literal["towards last", "towards first"] = "towards last"
    """The end of the line towards which cars drive into angled stalls."""
    use: StallUse = StallUse.STANDARD
    """Use of the stalls."""
    size: SizeClass = SizeClass.STANDARD
    """Size class of the stalls."""
    number: int | None = Field(None, ge=0)
    """Number that is painted in the first stall; those of the others follow."""

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if (self.kind is StallKind.ANGLED) != (self.angle_deg is not None):
            raise ValueError("angle_deg for angled stalls, and for these only")
        if self.first == self.last:
            raise ValueError("two ends, first and last, that are apart")
        pitch_m = self._pitch_m
        if pitch_m is None:
            if self.count is None:
                raise ValueError(f"count or {'length_m' if self.kind is StallKind.PARALLEL else 'width_m'}")
            return self
        room = self._room(pitch_m)
        if not (self.count or 1) <= room <= _MOST_STALLS:
            raise ValueError(f"{self.count or 1} to {_MOST_STALLS} stalls on the line, which has room for {room}")
        return self

    @property
    def _pitch_m(self) -> float | None:
        """Length of a mouth, along the line, if it is given."""
        if self.kind is StallKind.PARALLEL:
            return self.length_m
        if self.width_m is None or self.angle_deg is None:
            return self.width_m
        return self.width_m / elementary.sin(math.radians(self.angle_deg))

    def _room(self, pitch_m: float) -> int:
        return math.floor(math.dist(self.first, self.last) / pitch_m + _WHOLE)

    def quads(self) -> Iterator[tuple[Point, Point, Point, Point]]:
        """Yield the corners of each stall from first to last, its mouth first.

        With width w, length l and angle a, angled stalls are parallelograms whose mouths are w / sin a long and whose
        depth is l sin a + w cos a.
        """
        line_m = math.dist(self.first, self.last)
        along = ((self.last[0] - self.first[0]) / line_m, (self.last[1] - self.first[1]) / line_m)
        # z points down, so that the left of (x, z) is (z, -x)
        into = (along[1], -along[0]) if self.side == "left" else (-along[1], along[0])
        pitch_m = self._pitch_m or line_m / (self.count or 1)
        count = self.count or self._room(pitch_m)
        length_m = _LENGTH_M if self.length_m is None else self.length_m
        depth_m, shift_m = length_m, 0.0
        if self.kind is StallKind.PARALLEL:
            depth_m = _WIDTH_M if self.width_m is None else self.width_m
        elif self.angle_deg is not None:
            angle = math.radians(self.angle_deg)
            cos, sin = elementary.cos(angle), elementary.sin(angle)
            depth_m = length_m * sin + pitch_m * sin * cos
            shift_m = depth_m * cos / sin * (1 if self.leans == "towards last" else -1)

        def at(run_m: float, deep_m: float) -> Point:
            return (
                self.first[0] + along[0] * run_m + into[0] * deep_m,
                self.first[1] + along[1] * run_m + into[1] * deep_m,
            )

        for number in range(count):
            start_m, end_m = number * pitch_m, (number + 1) * pitch_m
            yield (
                at(start_m, 0.0),
                at(end_m, 0.0),
                at(end_m + shift_m, depth_m),
                at(start_m + shift_m, depth_m),
            )


class DrawnLane(Settings):
    """The centre line of a lane."""

    id: str = ""
    """Name in messages."""
    points: tuple[Place, ...] = Field(min_length=2)
    """(x, z) along the lane, in the direction of driving if it is one-way."""
    width_m: SideM | None = None
    """Width of the carriageway; left out, as far as stalls and walls leave room."""
    one_way: bool = False
    """True if cars drive along the points only."""


class DrawnColumn(Settings):
    """A square column."""

    at: Place
    """(x, z) of its middle."""
    size_m: SideM = 0.4
    """Its side."""


class DrawnPortal(Settings):
    """A place where cars enter or leave."""

    at: Place
    """(x, z) on the outline or near it."""
    kind: PortalKind = PortalKind.BOTH
    """'entrance', 'exit' or 'both'."""


class DrawnSolid(Settings):
    """A block on the floor that cars and people go around: stairs, a lift, a room for machines."""

    id: str = ""
    """Name in messages; left out, its place in the file."""
    corners: tuple[Place, ...] = Field(min_length=3)
    """(x, z) of its corners in order."""


class DrawnGarage(Settings):
    """The drawing of an existing garage in metres, seen from above: x to the right, z downwards."""

    outline: tuple[Place, ...] | None = Field(None, min_length=3)
    """Inner faces of the outer walls, (x, z) in order; left out, a rectangle around all parts."""
    stalls: tuple[DrawnStall, ...] = ()
    """Single stalls."""
    runs: tuple[DrawnRun, ...] = ()
    """Equal stalls side by side."""
    lanes: tuple[DrawnLane, ...] = ()
    """Lanes; without any, these are derived from the ground between the stalls."""
    columns: tuple[DrawnColumn, ...] = ()
    """Columns."""
    portals: tuple[DrawnPortal, ...] = ()
    """Entrances and exits."""
    solids: tuple[DrawnSolid, ...] = ()
    """Blocks on the floor; those beside a lane that are large enough are stair cores."""


def read_toml_survey(path: Path) -> Survey:
    """Read the drawing of a garage, the tables of `DrawnGarage`.

    Raises
    ------
    ConfigError
        If the file is not TOML, or a key or value is invalid; names its place.
    """
    try:
        drawing = validated(DrawnGarage, read_toml(path, field="SOURCE"))
    except ConfigError as error:
        if error.field == "SOURCE":
            raise
        raise ConfigError(f"{path.name}: {error.field}", error.value, error.allowed) from None
    parts = SurveyParts()
    _add_stalls(parts, drawing)
    for index, lane in enumerate(drawing.lanes):
        parts.add_lane(lane.id or f"lanes.{index}", lane.points, lane.width_m, one_way=lane.one_way)
    for column in drawing.columns:
        parts.add_square_column(column.at, column.size_m)
    for portal in drawing.portals:
        parts.add_portal(portal.at, portal.kind)
    for index, solid in enumerate(drawing.solids):
        parts.add_solid(solid.id or f"solids.{index}", solid.corners)
    if drawing.outline is not None:
        parts.add_outline("outline", drawing.outline)
    return parts.survey()


def _add_stalls(parts: SurveyParts, drawing: DrawnGarage) -> None:
    for index, stall in enumerate(drawing.stalls):
        corners = stall.quad()
        mouth = 0 if stall.corners is None else stall.mouth
        parts.add_stall(
            stall.id or f"stalls.{index}",
            corners,
            mouth_at=None if mouth is None else _middle(corners[mouth], corners[(mouth + 1) % 4]),
            use=stall.use,
            size=stall.size,
            number=str(stall.number),
        )
    for index, run in enumerate(drawing.runs):
        for place, quad in enumerate(run.quads()):
            parts.add_stall(
                f"{run.id or f'runs.{index}'}.{place}",
                quad,
                mouth_at=_middle(quad[0], quad[1]),
                use=run.use,
                size=run.size,
                number="" if run.number is None else str(run.number + place),
            )


def _middle(start: Point, end: Point) -> Point:
    return (start[0] + end[0]) / 2, (start[1] + end[1]) / 2
