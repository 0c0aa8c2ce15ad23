"""Columns of the building, with their guards and boards."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.faces import box_faces
from garage2usd.assets.mesh import Asset, Collider, Face, Part, make_part
from garage2usd.config.look import ColumnSection, Guard
from garage2usd.objects.kind import Kind, Point, Polygon, Spec, square

KIND = Kind("column", number=7, label="column", cityscapes="pole", group="Columns")

ROUND_SEGMENTS = 32
"""Number of sides of the prism that approximates a round column."""
_BEVEL_M = 0.03
_SHORT = 0.7
"""Short side of a rectangular section, as a share of the long one."""
_RUBBER_M = 0.012
_LEG_M = 0.1
"""Length of a rubber corner guard along a column's side, in metres."""
_BLOCK_M = 0.15
"""Approximate height of the black and yellow blocks of a rubber guard."""
_LEAST_BOARD = 0.8
"""Largest half width of a board, as a share of a round column's radius."""
_PAINTED = {
    Guard.YELLOW_BLACK: "guard_yellow_black",
    Guard.RED_WHITE: "guard_red_white",
    Guard.BLUE_YELLOW: "guard_blue_yellow",
}


class Board(NamedTuple):
    """A board on a column that fills the gap behind a mounted object.

    Attributes
    ----------
    side
        Side of the column that the board faces: 0 for +Z, 1 for +X, 2 for -Z, 3 for -X.
    left_m, right_m
        Extent across that side, from its middle; +X is to the right on side 0.
    low_m, high_m
        Extent above the floor.
    """

    side: int
    left_m: float
    right_m: float
    low_m: float
    high_m: float


@dataclass(frozen=True)
class ColumnSpec(Spec, kind=KIND):
    """A column; origin in the middle of its foot.

    Attributes
    ----------
    size_m
        Side of the bounding square of the section; a square column fills it.
    height_m
        Height of the column.
    section
        Shape of the section: a round one is as wide as the square, a rectangular one as long.
    is_long_along_x
        True if a rectangular section is long along X, else along Z.
    guard
        Guard that protects the column's foot.
    guard_height_m
        Height of that guard.
    head_m
        Height of the square head that carries beams, for a column that does not fill its square.
    boards
        Boards that carry mounted objects where the column does not reach the side of its square.
    """

    size_m: float
    height_m: float
    section: ColumnSection = ColumnSection.SQUARE
    is_long_along_x: bool = False
    guard: Guard = Guard.YELLOW_BLACK
    guard_height_m: float = 1.2
    head_m: float = 0.0
    boards: tuple[Board, ...] = ()

    @property
    def is_round(self) -> bool:
        """True if the column's section is a circle."""
        return self.section is ColumnSection.ROUND

    @property
    def fills_square(self) -> bool:
        """True if the column's sides are those of its bounding square."""
        return self.section is ColumnSection.SQUARE and self.guard is not Guard.RUBBER

    @property
    def halves_m(self) -> Point:
        """Half extents of the column's shaft along X and Z."""
        half = self.size_m / 2
        short = half * _SHORT if self.section is ColumnSection.RECTANGULAR else half
        x, z = (half, short) if self.is_long_along_x else (short, half)
        inset = _RUBBER_M if self.guard is Guard.RUBBER else 0.0
        return round(x - inset, 6), round(z - inset, 6)

    def side_m(self, side: int) -> float:
        """Return the distance from the column's axis to its surface on a side, numbered as in `Board`."""
        return self.halves_m[1 - side % 2]

    @property
    def diagonal_m(self) -> float:
        """Distance from the column's axis to its surface along the diagonals of its square."""
        x, z = self.halves_m
        if self.is_round:
            return x
        return min(min(x, z) * math.sqrt(2), (x + z - _BEVEL_M) / math.sqrt(2))

    def asset(self) -> Asset:
        """Make the meshes of a column: its shaft, and its guard, head and boards if any."""
        top = round(self.height_m - self.head_m, 6)
        guard_top = min(self.guard_height_m, top)
        is_painted = self.guard in _PAINTED
        parts = []
        if is_painted:
            parts.append(self._shaft("Guard", 0.0, guard_top, _PAINTED[self.guard]))
        if not is_painted or guard_top < top:
            parts.append(self._shaft("Shaft", guard_top if is_painted else 0.0, top, "column_concrete"))
        if self.guard is Guard.RUBBER:
            parts += self._rubber(guard_top)
        if self.head_m:
            half = self.size_m / 2
            head = box_faces((-half, top, -half), (half, self.height_m, half))
            parts.append(make_part("Head", head, "ceiling_concrete", collider=Collider.BOX))
        parts += [self._board(number, board) for number, board in enumerate(self.boards, start=1)]
        return Asset(tuple(parts))

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the bounding square of the column, whatever its section.

        Plans, stalls and proofs thus do not depend on the look of columns, and proofs are on the safe side. Colliders
        have the true shape.
        """
        return (square(self.size_m),)

    def _shaft(self, name: str, low: float, high: float, material: str) -> Part:
        faces = _prism(self._ring(*self.halves_m), low, high)
        around = _around(self.halves_m[0]) if self.is_round else None
        return make_part(name, faces, material, collider=Collider.CONVEX_HULL, project=around)

    def _ring(self, x: float, z: float) -> list[Point]:
        """Return the outline of a column's section with half extents, from +Z towards +X."""
        if self.is_round:
            angles = np.arange(ROUND_SEGMENTS) * (2 * np.pi / ROUND_SEGMENTS)
            return [(x * math.sin(angle), x * math.cos(angle)) for angle in angles.tolist()]
        b = _BEVEL_M
        ring = [(x - b, z), (x, z - b), (x, b - z), (x - b, -z)]
        return [*ring, *((-a, -c) for a, c in ring)]

    def _rubber(self, top: float) -> list[Part]:
        """Make the black and yellow blocks of a rubber guard: a collar on a round column, else an angle per edge."""
        x, z = self.halves_m
        outer, inner = self._ring(x + _RUBBER_M, z + _RUBBER_M), self._ring(x, z)
        strips = [([*outer, outer[0]], [*inner, inner[0]])] if self.is_round else list(self._corners(outer))
        count = max(2 * round((top / _BLOCK_M - 1) / 2) + 1, 1)
        levels = np.linspace(0.0, top, count + 1).round(6).tolist()
        faces: list[list[Face]] = [[], []]
        for number, (low, high) in enumerate(pairwise(levels)):
            for outside, inside in strips:
                faces[number % 2] += _shell(outside, inside, low, high, is_closed=self.is_round)
        around = _around(x) if self.is_round else None
        return [
            make_part(name, each, material, collider=Collider.MESH, project=around)
            for name, each, material in zip(
                ("Rubber", "YellowRubber"), faces, ("rubber_black", "rubber_yellow"), strict=True
            )
            if each
        ]

    def _corners(self, outer: Sequence[Point]) -> list[tuple[list[Point], list[Point]]]:
        """Return the outer and the inner line of each rubber corner of a column."""
        x, z = self.halves_m
        inner = self._ring(x, z)
        # for each bevel, from +Z towards +X, with the legs on both sides of it
        found = []
        for first in (0, 2, 4, 6):
            lines = []
            for ring in (outer, inner):
                ends = np.array([ring[first], ring[first + 1]])
                before, after = np.array(ring[first - 1]), np.array(ring[(first + 2) % len(ring)])
                legs = [ends[0] + _along(ends[0], before), *ends, ends[1] + _along(ends[1], after)]
                lines.append([(float(a), float(b)) for a, b in legs])
            # cut the leg at a right angle to the side
            for end, at in ((0, 1), (-1, 2)):
                axis = int(np.argmin(np.abs(np.subtract(lines[0][at], lines[0][end]))))
                point = list(lines[1][end])
                point[1 - axis] = lines[0][end][1 - axis]
                lines[1][end] = (point[0], point[1])
            found.append((lines[0], lines[1]))
        return found

    def _board(self, number: int, board: Board) -> Part:
        """Make a board from the side of the column's square back to the shaft, or into a round one up to its edges."""
        left, right = board.left_m, board.right_m
        front, back = self.size_m / 2, self.side_m(board.side)
        if self.is_round:
            most = _LEAST_BOARD * back
            left, right = max(left, -most), min(right, most)
            back = math.sqrt(back**2 - max(abs(left), abs(right)) ** 2)
        faces = box_faces((left, board.low_m, back), (right, board.high_m, front))
        for _ in range(board.side):
            # a quarter turn from +Z towards +X
            faces = [face[:, [2, 1, 0]] * (1.0, 1.0, -1.0) for face in faces]
        return make_part(f"Board{number}", faces, "column_concrete", collider=Collider.BOX)


def _along(start: NDArray[np.float64], to: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the leg of a rubber corner from a point towards another, less than half of the distance."""
    way = to - start
    far = float(np.linalg.norm(way))
    return way / far * min(_LEG_M, 0.4 * far)


def _prism(ring: Sequence[Point], low: float, high: float) -> list[Face]:
    """Return the faces of a closed prism over a column's convex section."""
    faces = [
        np.array([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)])
        for (x0, z0), (x1, z1) in pairwise([*ring, ring[0]])
    ]
    faces.append(np.array([(x, high, z) for x, z in ring]))
    faces.append(np.array([(x, low, z) for x, z in reversed(ring)]))
    return faces


def _shell(
    outside: Sequence[Point], inside: Sequence[Point], low: float, high: float, *, is_closed: bool
) -> list[Face]:
    """Return the faces of a rubber guard between two lines and two heights, without its inner side."""
    faces = []
    for ((x0, z0), (x1, z1)), ((u0, w0), (u1, w1)) in zip(pairwise(outside), pairwise(inside), strict=True):
        faces.append(np.array([(x0, low, z0), (x1, low, z1), (x1, high, z1), (x0, high, z0)]))
        faces.append(np.array([(x0, high, z0), (x1, high, z1), (u1, high, w1), (u0, high, w0)]))
    if not is_closed:
        for (x, z), (u, w), turn in ((outside[0], inside[0], 1), (outside[-1], inside[-1], -1)):
            faces.append(np.array([(u, low, w), (x, low, z), (x, high, z), (u, high, w)])[::turn])
    return faces


def _around(radius_m: float) -> Callable[[NDArray[np.float64], NDArray[np.float64]], NDArray[np.float64]]:
    """Return texture coordinates around a round column, from -Z and upwards."""

    def project(corners: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
        x, y, z = corners.T
        facing = np.arctan2(normals[:, 0], normals[:, 2])
        # unwrap angles near that of the face, so that no face spans the seam
        angle = facing + (np.arctan2(x, z) - facing + np.pi) % (2 * np.pi) - np.pi
        is_level = np.abs(normals[:, 1]) > 1 / 2
        return np.stack([np.where(is_level, x, angle * radius_m), np.where(is_level, -z, y)], axis=1)

    return project
