"""Placements of objects and stalls: engine-neutral values in metres, Y up, +X along columns, +Z along rows."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeVar

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallKind, StallUse
from garage2usd.native import elementary
from garage2usd.objects.kind import Box, Point, Polygon, Spec
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import Square, StallType
from garage2usd.structure.stalls import PERPENDICULAR_DEG, Edge, kind_of_angle, slope_of_angle

_S = TypeVar("_S", bound=Spec)


@dataclass(frozen=True, slots=True)
class Placement:
    """An object placed in the garage.

    Attributes
    ----------
    name
        Prim name, PascalCase, unique within its square or, without a square, within its kind. Equal on squares with
        equal objects.
    spec
        Shape of the object, whose type determines its kind; equal specs share one prototype.
    position_m
        (x, y, z) of the shape's origin.
    yaw_rad
        Right-handed rotation about +Y.
    square
        (row, col) of its tile; None for objects of the whole building.
    ordinal
        Number on that square of its stall; None for objects without a stall.
    """

    name: str
    spec: Spec
    position_m: tuple[float, float, float]
    yaw_rad: float = 0.0
    square: Square | None = None
    ordinal: int | None = None

    @property
    def kind(self) -> str:
        """Name of the object's kind, a key of `garage2usd.objects.KINDS`."""
        return self.spec.kind.name

    def to_world(self, point: Point) -> Point:
        """Transform a point of the shape to (x, z) in the garage."""
        x, _, z = self.position_m
        return to_world(point, (x, z), self.yaw_rad)

    def local(self, point: Point) -> Point:
        """Transform a point (x, z) in the garage to the coordinates of the shape."""
        x, _, z = self.position_m
        return to_local(point, (x, z), self.yaw_rad)

    @property
    def stall(self) -> str | None:
        """Name of the object's stall, for example of a car, a wheel stop or a painted number; None without one."""
        return None if self.square is None or self.ordinal is None else stall_name(self.square, self.ordinal)

    def outlines(self) -> list[Polygon]:
        """Convex outlines (x, z) in the garage of the object's parts within reach of a car; empty if there are none."""
        return [tuple(map(self.to_world, outline)) for outline in self.spec.outlines()]


@dataclass(frozen=True, slots=True)
class PlacedStall:
    """A parking stall on its square; `garage2usd.garage.Stall` is its counterpart without squares.

    Attributes
    ----------
    square
        (row, col) of its free square.
    ordinal
        Number on the square, from 1.
    edge
        Edge of the square at the stall's entry.
    stall_type
        The paper's type of the square.
    centre_m
        (x, z) of its centre.
    width_m, length_m
        Sides of its rectangle for a car, between the centres of the lines.
    yaw_rad
        Rotation about +Y; at 0 a car parked nose-in faces -Z, and the entry of all but parallel stalls faces +Z.
    use
        Use of the stall.
    angle_deg
        Angle of its long sides to the lane.
    turn
        1 for a stall entered by a right turn off the lane, -1 for a left turn; for parallel stalls, the side of the
        lane.
    size
        Size class.
    number
        Painted number with its zone, ``B2-07``; empty if nobody parks there.
    """

    square: Square
    ordinal: int
    edge: Edge
    stall_type: StallType
    centre_m: Point
    width_m: float
    length_m: float
    yaw_rad: float = field(repr=False)
    use: StallUse = StallUse.STANDARD
    number: str = ""
    angle_deg: float = PERPENDICULAR_DEG
    turn: int = 1
    size: str = SizeClass.STANDARD.value

    @property
    def name(self) -> str:
        """Deterministic id, ``Stall_r03_c07_2``."""
        return stall_name(self.square, self.ordinal)

    @property
    def access_square(self) -> Square:
        """(row, col) of the lane square at its entry."""
        return self.edge.beyond(self.square)

    def placement(
        self,
        name: str,
        spec: Spec,
        point: Point = (0.0, 0.0),
        *,
        yaw_rad: float | None = None,
        piece: int | None = None,
    ) -> Placement:
        """Place an object of this stall at (x, z) from its centre, with the entry at +Z.

        It has the stall's yaw unless `yaw_rad` is given. In the second stall of a square, ``Car`` is named ``Car_2``,
        and piece 3 of ``Cone`` is named ``Cone_2_3``.
        """
        return placed(
            f"{name}_{self.ordinal}" + ("" if piece is None else f"_{piece}"),
            spec,
            self.to_world(point),
            yaw_rad=self.yaw_rad if yaw_rad is None else yaw_rad,
            square=self.square,
            ordinal=self.ordinal,
        )

    def to_world(self, point: Point) -> Point:
        """Transform a point relative to the stall's centre, with the entry at +Z, to (x, z) in the garage."""
        return to_world(point, self.centre_m, self.yaw_rad)

    def corners_m(self) -> Polygon:
        """(x, z) of the four corners: entry left, entry right, rear right, rear left as seen by an entering driver."""
        return tuple(map(self.to_world, self.outline()))

    def rectangle_m(self) -> Polygon:
        """(x, z) of the corners of the rectangle for a car, in the order of `corners_m`; all of most stalls."""
        x, z = self.width_m / 2, self.length_m / 2
        if self.stall_kind is not StallKind.ANGLED:
            return self.corners_m()
        return tuple(self.to_world(corner) for corner in ((-x, z), (x, z), (x, -z), (-x, -z)))

    @property
    def stall_kind(self) -> StallKind:
        """Orientation of the stall to the lane."""
        return kind_of_angle(self.angle_deg)

    @property
    def slope(self) -> float:
        """Slope of entry and rear: rise towards the entry per metre to the right, in the stall's coordinates."""
        return self.turn * slope_of_angle(self.angle_deg)

    def outline(self) -> Polygon:
        """Corners relative to the stall's centre, with the entry at +Z; beside the car in a parallel stall."""
        x, z = self.width_m / 2, self.length_m / 2
        if self.stall_kind is StallKind.PARALLEL:
            x, z = -x * self.turn, -z * self.turn
            return (x, z), (x, -z), (-x, -z), (-x, z)
        rise = self.slope * x
        z += abs(rise)
        return (-x, z - rise), (x, z + rise), (x, rise - z), (-x, -rise - z)


def stall_name(square: Square, ordinal: int) -> str:
    """Id of a stall by its square and its number on the square."""
    return f"Stall_r{square[0]:02d}_c{square[1]:02d}_{ordinal}"


def placed(
    name: str,
    spec: Spec,
    point: Point,
    *,
    height_m: float = 0.0,
    yaw_rad: float = 0.0,
    square: Square | None = None,
    ordinal: int | None = None,
) -> Placement:
    """Place an object above a point (x, z) of the garage, rounded to the micrometre."""
    x, z = rounded(point)
    return Placement(name, spec, (x, height_m, z), yaw_rad, square, ordinal)


def of_spec(placements: Iterable[Placement], spec: type[_S]) -> Iterator[tuple[Placement, _S]]:
    """Yield the placements whose shape has a type, each with its shape."""
    return ((place, place.spec) for place in placements if isinstance(place.spec, spec))


def rounded(point: Point) -> Point:
    """Round a point to the micrometre."""
    return round(point[0], 6), round(point[1], 6)


def box_inside(edge: Edge, half_m: Point, along_m: tuple[float, float], depth_m: tuple[float, float]) -> Box:
    """Make a box on a square from its extents along an edge, from the edge's centre, and inwards from the edge.

    Parameters
    ----------
    edge
        An edge of the square.
    half_m
        Half the square's extent along X and Z.
    along_m, depth_m
        Start and end along the edge, and inwards.

    Returns
    -------
    Box
        Left, top, right and bottom, relative to the square's centre.
    """
    x, z = half_m
    (start, end), (near, far) = along_m, depth_m
    return {
        Edge.UP: (start, near - z, end, far - z),
        Edge.DOWN: (start, z - far, end, z - near),
        Edge.LEFT: (near - x, start, far - x, end),
        Edge.RIGHT: (x - far, start, x - near, end),
    }[edge]


def point_inside(structure: Structure, square: Square, edge: Edge, along_m: float, inside_m: float) -> Point:
    """Point (x, z) in the garage at a distance along an edge of a square, from its centre, and inwards."""
    row, col = square
    x, z = structure.column_edges_m, structure.row_edges_m
    left, top, right, bottom = float(x[col]), float(z[row]), float(x[col + 1]), float(z[row + 1])
    half_m = (right - left) / 2, (bottom - top) / 2
    off_x, off_z, *_ = box_inside(edge, half_m, (along_m, along_m), (inside_m, inside_m))
    return (left + right) / 2 + off_x, (top + bottom) / 2 + off_z


def edge_yaw_rad(edge: Edge) -> float:
    """Yaw that rotates +Z towards an edge of a square."""
    return _EDGE_YAWS_RAD[edge]


def turned_yaw_rad(edge: Edge, turn: int, angle_deg: float) -> float:
    """Yaw of a car in a stall with an angle to an edge of a square; exact for multiples of 90 degrees."""
    if angle_deg == PERPENDICULAR_DEG:
        return _EDGE_YAWS_RAD[edge]
    return sum_of_yaws(_EDGE_YAWS_RAD[edge], turn * math.radians(PERPENDICULAR_DEG - angle_deg))


_QUARTER_RAD = 1e-9
_EDGE_YAWS_RAD = {Edge.UP: math.pi, Edge.DOWN: 0.0, Edge.LEFT: -math.pi / 2, Edge.RIGHT: math.pi / 2}
_EXACT_QUARTER = {math.pi: (-1.0, 0.0), 0.0: (1.0, 0.0), -math.pi / 2: (0.0, -1.0), math.pi / 2: (0.0, 1.0)}


def sum_of_yaws(yaw_rad: float, turn_rad: float) -> float:
    """Add a turn to a yaw; within half a turn, and exact for multiples of 90 degrees."""
    if not turn_rad:
        return yaw_rad
    turned = math.remainder(yaw_rad + turn_rad, math.tau)
    quarter = next((yaw for yaw in _EXACT_QUARTER if abs(math.remainder(turned - yaw, math.tau)) < _QUARTER_RAD), None)
    return round(turned, 9) if quarter is None else quarter


def cos_sin(yaw_rad: float) -> tuple[float, float]:
    """Cosine and sine of a yaw; exact for multiples of 90 degrees."""
    return _EXACT_QUARTER.get(yaw_rad) or (elementary.cos(yaw_rad), elementary.sin(yaw_rad))


def to_world(point: Point, origin: Point, yaw_rad: float) -> Point:
    """Rotate a local (x, z) by a yaw about +Y and translate it to `origin`; exact for multiples of 90 degrees."""
    cos, sin = cos_sin(yaw_rad)
    x, z = point
    return origin[0] + x * cos + z * sin, origin[1] - x * sin + z * cos


def to_local(point: Point, origin: Point, yaw_rad: float) -> Point:
    """Transform (x, z) in the garage to local coordinates, the inverse of `to_world`."""
    return to_world((point[0] - origin[0], point[1] - origin[1]), (0.0, 0.0), -yaw_rad + 0.0)
