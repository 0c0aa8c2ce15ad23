"""Widths of one-way aisles by the kind of their stalls: narrower between angled or parallel ones."""

from collections import defaultdict
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from garage2usd.config import BayConfig
from garage2usd.garage import StallKind
from garage2usd.planning.dimensions import driven_squares
from garage2usd.profiles import Profile
from garage2usd.structure.directions import LaneDirections
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.stall_runs import StallRun, lean_of_traffic
from garage2usd.structure.stall_shapes import StallShape

__all__ = ["narrow_aisles_m", "one_way_aisle_m"]

Line = tuple[int, int]
"""Axis of a line of squares (0 for rows, 1 for columns), and its number."""
_ANGLES_DEG, _SWEPT_M = (45.0, 60.0, 75.0, 90.0), (3.2, 3.2, 4.2, 5.2)
"""Aisles in which the swept path of a car of 4.8 x 1.8 m enters stalls with at most two changes of gear."""
_SWEPT_PARALLEL_M = 3.5


def one_way_aisle_m(shape: StallShape, profile: Profile) -> float | None:
    """Return the least clear width of a one-way aisle between stalls of a shape.

    Parameters
    ----------
    shape
        Stalls on both sides.
    profile
        ``angled_aisle_widths`` and ``parallel_aisle_width``.

    Returns
    -------
    float or None
        The width in metres that the profile asks for, or that of the swept path where it is wider; None for
        perpendicular stalls and where the profile has no clause, so that the aisle stays as wide as a two-way one.
    """
    if shape.kind is StallKind.PARALLEL:
        clause = profile.parallel_aisle_width
        return max(clause.amount, _SWEPT_PARALLEL_M) if clause else None
    angled, upright = profile.angled_aisle_widths, profile.aisle_width
    if shape.kind is StallKind.PERPENDICULAR or angled is None:
        return None
    asked_m = angled.amount_at(shape.angle_deg, upright.amount if upright else None)
    return max(asked_m, round(float(np.interp(shape.angle_deg, _ANGLES_DEG, _SWEPT_M)), 3))


def narrow_aisles_m(
    structure: Structure, bay: BayConfig, profile: Profile, runs: Sequence[StallRun], directions: LaneDirections
) -> dict[Line, float]:
    """Return the lines of lanes that may be narrower than a two-way aisle, with their least clear width in metres.

    Notes
    -----
    All cars along such a line drive one way, all stalls that open across it are angled or parallel, and angled ones
    lean with the traffic. The line is as wide as the widest of these stalls needs. Portals are driven one way.
    """
    asked: dict[Line, list[float | None]] = defaultdict(list)
    for run in runs:
        axis = 0 if run.edge.along_x else 1
        leans_back = run.shape.kind is StallKind.ANGLED and any(
            run.lean != lean_of_traffic(square, run.edge, directions) for square in run.squares
        )
        width_m = None if leans_back else one_way_aisle_m(run.shape, profile)
        for number in {run.edge.beyond(square)[axis] for square in run.squares}:
            asked[axis, number].append(width_m)
    narrow = {}
    for line, widths_m in asked.items():
        found_m = _widest(widths_m)
        if found_m is not None and found_m < bay.aisle_width_m and _is_one_way(structure, line, directions):
            narrow[line] = found_m
    return narrow


def _widest(widths_m: Sequence[float | None]) -> float | None:
    """Return the greatest width; None if some stall needs that of a two-way aisle."""
    known = [width for width in widths_m if width is not None]
    return max(known) if len(known) == len(widths_m) else None


def _is_one_way(structure: Structure, line: Line, directions: LaneDirections) -> bool:
    """Return True if cars drive along a line, and everywhere on it in one direction."""
    axis, number = line
    if not driven_squares(structure.cells)[axis].take(number, axis=axis).any():
        return False
    is_lane = (structure.cells.take(number, axis=axis) == Cell.LANE).tolist()

    def square(at: int) -> tuple[int, int]:
        return (number, at) if axis == 0 else (at, number)

    steps = (at for at, pair in enumerate(pairwise(is_lane)) if all(pair))
    return all(directions.is_one_way(square(at), square(at + 1)) for at in steps)
