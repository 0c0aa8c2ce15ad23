"""Stalls side by side along a run of squares, past the columns at the squares' corners."""

import math
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from functools import cached_property, lru_cache
from itertools import pairwise, zip_longest
from typing import NamedTuple

from garage2usd.config.site import BayConfig
from garage2usd.garage import StallKind
from garage2usd.structure.stalls import StallShape

_MM_PER_M = 1000
_BEHIND_CAR_M = 0.25
"""What columns leave clear before the rectangle of an angled stall, where the tail of a parked car is."""
_CLEAR_MOUTH = 0.5
"""Share of an angled stall's mouth, at the corner of its rectangle, that columns leave clear for cars that turn in.
With 0.45 the design car gets into 2,274 of 2,284 stalls at 60 degrees, with 0.5 into all, on as much floor."""

_Corners = tuple[tuple[float, float], ...]


class Surroundings(NamedTuple):
    """What is around the squares of a run.

    Attributes
    ----------
    is_served
        For each square, whether it is free and beside a lane.
    has_rear_column
        For each square, whether a column stands at its end behind the stalls: both squares there are inside.
    """

    is_served: tuple[bool, ...]
    has_rear_column: tuple[bool, ...]


class Packing:
    """The stalls of a run, in millimetres from its beginning and inwards from the line of their mouths.

    Parameters
    ----------
    bay
        Sizes of columns and gaps.
    shape, lean
        The stalls, and the direction in which they lean.
    along_mm, depth_mm
        Sides of the squares along the run, and their depth.
    around
        What is around each square.
    shares
        For each square, how many runs share its depth.
    """

    def __init__(
        self,
        bay: BayConfig,
        shape: StallShape,
        lean: int,
        along_mm: Sequence[int],
        depth_mm: int,
        around: Surroundings,
        shares: Sequence[int],
    ) -> None:
        self._pitch_mm = round(shape.pitch_m * _MM_PER_M)
        self._lean_mm = lean * shape.slope * round(shape.depth_m * _MM_PER_M)
        self._gap_mm = round(bay.row_ends_m * _MM_PER_M / 2)
        self._borders_mm = [0]
        for side_mm in along_mm:
            self._borders_mm.append(self._borders_mm[-1] + side_mm)
        needed_mm = depth_needed_m(shape, bay) * _MM_PER_M
        self._has_stalls = [
            is_served and needed_mm * share <= depth_mm
            for is_served, share in zip(around.is_served, shares, strict=True)
        ]
        self._has_rear_column = around.has_rear_column
        self._columns = _taken_by_columns_mm(shape, lean, bay, depth_mm)

    @property
    def count(self) -> int:
        """Number of stalls."""
        return len(self._packed)

    def starts_m(self) -> Iterator[tuple[int, tuple[float, ...]]]:
        """Yield each square, by its number, on which mouths have their middles, and the starts of these in metres.

        Starts are measured from the middle of the square's edge.
        """
        starts: dict[int, list[float]] = {}
        for start in self._centred():
            number = bisect_right(self._borders_mm, start + self._pitch_mm / 2) - 1
            left, right = self._borders_mm[number : number + 2]
            # doubled, so that it is a whole number
            starts.setdefault(number, []).append((2 * start - left - right) / (2 * _MM_PER_M))
        for number, found in starts.items():
            yield number, tuple(found)

    @cached_property
    def _packed(self) -> list[int]:
        """Starts of the mouths, each as near to the beginning as what is taken and the stall before allow."""
        starts: list[int] = []
        if not any(self._has_stalls):
            return starts
        place, most = self._reach_mm
        for low, high in (*self._taken, (most, math.inf)):
            while place <= min(low, most):
                starts.append(place)
                place += self._pitch_mm
            if place < high < math.inf:
                place = int(high)
        return starts

    def _centred(self) -> Iterator[int]:
        """Yield the starts with stalls that touch one another moved to the middle of the room that they have."""
        starts, most = self._packed, self._reach_mm[1]
        group: list[int] = []
        for start, following in zip_longest(starts, starts[1:]):
            group.append(start)
            if following == start + self._pitch_mm:
                continue
            room = most - start if following is None else following - self._pitch_mm - start
            room = min([room, *(low - own for own in group for low, _ in self._taken if low >= own)])
            yield from (own + room // 2 for own in group)
            group = []

    @cached_property
    def _reach_mm(self) -> tuple[int, int]:
        """Least and greatest start of a mouth with which a stall lies within the ends of the run."""
        least = self._gap_mm - math.floor(min(0, self._lean_mm))
        return least, self._borders_mm[-1] - self._gap_mm - self._pitch_mm - math.ceil(max(0, self._lean_mm))

    @cached_property
    def _taken(self) -> list[tuple[int, int]]:
        """Open intervals of starts at which a stall would touch a column, or a square without stalls; in order."""
        taken = [
            (left - self._pitch_mm, right)
            for (left, right), has_stalls in zip(pairwise(self._borders_mm), self._has_stalls, strict=True)
            if not has_stalls
        ]
        at_mouth, at_rear = self._columns
        for border, has_rear_column in zip(self._borders_mm[1:-1], self._has_rear_column, strict=False):
            taken.append((border + at_mouth[0], border + at_mouth[1]))
            if has_rear_column and at_rear is not None:
                taken.append((border + at_rear[0], border + at_rear[1]))
        return sorted(taken)


def depth_needed_m(shape: StallShape, bay: BayConfig) -> float:
    """Return the depth of a square for stalls of a shape: parallel ones keep the wall gap behind them."""
    return round(shape.depth_m + (bay.wall_gap_m if shape.kind is StallKind.PARALLEL else 0.0), 6)


def lost_at_columns_m(shape: StallShape, bay: BayConfig) -> tuple[float, ...]:
    """Return the lengths of a long run that each column may cost: by its foot at the mouths, or also by one behind.

    A column costs none where it stands in the triangles at the mouths and the rears of angled stalls.
    """
    mouth, rear = _taken_by_columns_mm(shape, 1, bay, math.ceil(shape.depth_m * _MM_PER_M))
    pitch_mm = round(shape.pitch_m * _MM_PER_M)
    both = mouth if rear is None else (min(mouth[0], rear[0]), max(mouth[1], rear[1]))
    return tuple(sorted({max(high - low - pitch_mm, 0) / _MM_PER_M for low, high in (mouth, both)}))


@lru_cache(maxsize=4096)
def _taken_by_columns_mm(
    shape: StallShape, lean: int, bay: BayConfig, depth_mm: int
) -> tuple[tuple[int, int], tuple[int, int] | None]:
    """Return the open intervals of starts, from a column's middle, that columns at the mouths and the rears take.

    The rears of the squares are `depth_mm` behind the mouths. The second is None if the stalls end before them.
    """
    column_mm = bay.column_size_m * _MM_PER_M / 2
    ground_mm = _ground_of_car_mm(shape, lean, bay)

    def taken(near_mm: float, far_mm: float) -> tuple[int, int] | None:
        along = [x for x, inwards in ground_mm if near_mm < inwards < far_mm]
        for (x, inwards), (next_x, next_inwards) in pairwise((*ground_mm, ground_mm[0])):
            along.extend(
                x + (next_x - x) * (cut - inwards) / (next_inwards - inwards)
                for cut in (near_mm, far_mm)
                if min(inwards, next_inwards) < cut < max(inwards, next_inwards)
            )
        if not along:
            return None
        low, high = (round(end, 3) for end in (-column_mm - max(along), column_mm - min(along)))
        return math.floor(low), math.ceil(high)

    at_mouth = taken(-math.inf, column_mm)
    assert at_mouth is not None
    return at_mouth, taken(depth_mm - column_mm, math.inf)


def _ground_of_car_mm(shape: StallShape, lean: int, bay: BayConfig) -> _Corners:
    """Corners of the ground that columns leave clear, along the run from the start of the mouth, and inwards.

    It is the rectangle for a car, at each side as much as between a wall and a stall, and before an angled one the room
    to turn in.
    """
    margin_mm = (bay.row_ends_m - bay.column_size_m) / 2 * _MM_PER_M
    pitch, depth = shape.pitch_m * _MM_PER_M, shape.depth_m * _MM_PER_M
    if shape.kind is not StallKind.ANGLED:
        return (-margin_mm, 0.0), (pitch + margin_mm, 0.0), (pitch + margin_mm, depth), (-margin_mm, depth)
    angle = math.radians(shape.angle_deg)
    sin, cos = math.sin(angle), math.cos(angle)
    right, left = margin_mm, -shape.width_m * _MM_PER_M - margin_mm
    near, far = -_BEHIND_CAR_M * _MM_PER_M, shape.length_m * _MM_PER_M
    # a stall that leans towards +, from the corner of its rectangle on the line of the mouths
    corners = [
        (pitch + across * sin + inwards * cos, -across * cos + inwards * sin)
        for across, inwards in ((right, near), (right, far), (left, far), (left, near))
    ]
    corners.append(((1 - _CLEAR_MOUTH) * pitch, 0.0))
    return tuple(corners if lean > 0 else [(pitch - x, inwards) for x, inwards in corners])
