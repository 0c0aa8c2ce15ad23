"""What stands where: engine-neutral values in metres, Y up, +X along columns, +Z along rows."""

import math
from dataclasses import dataclass
from enum import StrEnum

from garage2usd.objects.kind import Spec
from garage2usd.structure.grid import NEIGHBOUR_STEPS
from garage2usd.structure.lane_graph import Square, StallType
from garage2usd.structure.stalls import Edge

__all__ = ["Placement", "Stall", "StallUse", "edge_yaw_rad", "stall_name", "to_world"]


class StallUse(StrEnum):
    """What a stall is for."""

    STANDARD = "standard"
    TURNING = "turning"
    """Kept free, so that cars turn at the end of a long dead-end aisle."""
    EV = "ev"
    """With a charger."""
    ACCESSIBLE = "accessible"
    """For people with a disability, beside an access aisle."""
    ACCESS_AISLE = "access_aisle"
    """Hatched and kept free, so that wheelchairs get to the accessible stalls beside it."""
    UNREACHABLE = "unreachable"
    """Hatched and kept free, because cars do not get into it and out of it."""

    @property
    def takes_cars(self) -> bool:
        """Whether cars park there."""
        return self not in {StallUse.TURNING, StallUse.ACCESS_AISLE, StallUse.UNREACHABLE}


@dataclass(frozen=True, slots=True)
class Placement:
    """One object in the world.

    Attributes
    ----------
    name
        Prim name, PascalCase, unique within its square or, without a square, within its kind. On squares that hold
        the same, the same.
    spec
        The shape that is placed, which says what kind of object it is; equal specs share one prototype.
    position_m
        (x, y, z) of the shape's origin.
    yaw_rad
        Right-handed turn about +Y.
    square
        (row, col) of the tile that it belongs to, None for what belongs to the building.
    ordinal
        Number on that square of the stall that it belongs to, None for what belongs to no stall.
    """

    name: str
    spec: Spec
    position_m: tuple[float, float, float]
    yaw_rad: float = 0.0
    square: Square | None = None
    ordinal: int | None = None

    @property
    def kind(self) -> str:
        """Name of its kind of object, one of `garage2usd.objects.KINDS`."""
        return self.spec.kind.name

    @property
    def stall(self) -> str | None:
        """Name of the stall that it belongs to, as a car, a wheel stop or a painted number does."""
        return None if self.square is None or self.ordinal is None else stall_name(self.square, self.ordinal)

    def outlines(self) -> list[tuple[tuple[float, float], ...]]:
        """Convex outlines (x, z) in the garage of what a car could touch of it; empty where a car touches nothing."""
        origin = self.position_m[0], self.position_m[2]
        return [tuple(to_world(corner, origin, self.yaw_rad) for corner in outline) for outline in self.spec.outlines()]


@dataclass(frozen=True, slots=True)
class Stall:
    """One parking stall.

    Attributes
    ----------
    square
        (row, col) of the free square that it lies on.
    ordinal
        Its number on the square, from 1.
    edge
        Edge of the square that its mouth lies on.
    stall_type
        The paper's type of the square.
    centre_m
        (x, z) of its middle.
    width_m, length_m
        Its size between the lines' middles.
    use
        What it is for.
    number
        As people read it, ``B2-07``: zone, and what is painted at its mouth; empty where nobody parks.
    """

    square: Square
    ordinal: int
    edge: Edge
    stall_type: StallType
    centre_m: tuple[float, float]
    width_m: float
    length_m: float
    use: StallUse = StallUse.STANDARD
    number: str = ""

    @property
    def name(self) -> str:
        """Deterministic id, ``Stall_r03_c07_2``."""
        return stall_name(self.square, self.ordinal)

    @property
    def access_square(self) -> Square:
        """(row, col) of the lane square beyond the mouth."""
        step = NEIGHBOUR_STEPS[self.edge]
        return self.square[0] + step[0], self.square[1] + step[1]

    @property
    def yaw_rad(self) -> float:
        """Turn about +Y; at 0 the mouth looks to +Z and a car parked nose-in looks to -Z."""
        return edge_yaw_rad(self.edge)

    def placement(
        self,
        name: str,
        spec: Spec,
        point: tuple[float, float] = (0.0, 0.0),
        *,
        yaw_rad: float | None = None,
        piece: int | None = None,
    ) -> Placement:
        """Place an object that belongs to this stall at (x, z) from its middle, the mouth at +Z.

        It is turned as the stall is unless `yaw_rad` is given. In the second stall of a square, ``Car`` is named
        ``Car_2``, and piece 3 of ``Cone`` is named ``Cone_2_3``.
        """
        x, z = to_world(point, self.centre_m, self.yaw_rad)
        return Placement(
            f"{name}_{self.ordinal}" + ("" if piece is None else f"_{piece}"),
            spec,
            (round(x, 6), 0.0, round(z, 6)),
            self.yaw_rad if yaw_rad is None else yaw_rad,
            self.square,
            self.ordinal,
        )

    def corners_m(self) -> tuple[tuple[float, float], ...]:
        """(x, z) of the four corners: mouth left, mouth right, rear right, rear left as a driver sees them."""
        half_width, half_length = self.width_m / 2, self.length_m / 2
        local = (-half_width, half_length), (half_width, half_length), (half_width, -half_length)
        return tuple(to_world(point, self.centre_m, self.yaw_rad) for point in (*local, (-half_width, -half_length)))


def stall_name(square: Square, ordinal: int) -> str:
    """Id of a stall by its square and its number there."""
    return f"Stall_r{square[0]:02d}_c{square[1]:02d}_{ordinal}"


def edge_yaw_rad(edge: Edge) -> float:
    """Yaw that turns +Z towards an edge of a square."""
    return _EDGE_YAWS_RAD[edge]


_EDGE_YAWS_RAD = {Edge.UP: math.pi, Edge.DOWN: 0.0, Edge.LEFT: -math.pi / 2, Edge.RIGHT: math.pi / 2}
_EXACT_QUARTER = {math.pi: (-1.0, 0.0), 0.0: (1.0, 0.0), -math.pi / 2: (0.0, -1.0), math.pi / 2: (0.0, 1.0)}


def to_world(point: tuple[float, float], origin: tuple[float, float], yaw_rad: float) -> tuple[float, float]:
    """Turn a local (x, z) by a yaw about +Y and move it to `origin`; quarter turns are exact."""
    cos, sin = _EXACT_QUARTER.get(yaw_rad) or (math.cos(yaw_rad), math.sin(yaw_rad))
    x, z = point
    return origin[0] + x * cos + z * sin, origin[1] - x * sin + z * cos
