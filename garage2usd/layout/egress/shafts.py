"""Stair shafts, cores above one another on all levels, and the choice among those that could be built."""
# Over 300 lines: the candidates, and the choice that compares them level by level.

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.config import GarageConfig
from garage2usd.layout.egress.cores import (
    RECESS_M,
    Core,
    core_candidates,
    gap_to_stalls_m,
    is_wide_enough,
    names_of_rows,
)
from garage2usd.layout.placement import point_inside, rounded
from garage2usd.native import elementary
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lane_graph import LaneSquares, Square
from garage2usd.structure.stalls import Edge, StallRow

_LONGEST_PASSAGE_M = 3.6
"""Greatest distance from the door of a core to the lane, between stalls."""
_TOUCH_M = 1e-3
Points = NDArray[np.float64]
_EXIT_WORTH_STALLS = 20
"""A missing exit counts as much as this number of stalls out of reach."""
_ROUNDS = 6


class LevelPlan(NamedTuple):
    """The plan of a level: S with R and C, its lanes and rows of stalls, and its settings."""

    structure: Structure
    graph: LaneSquares
    config: GarageConfig


Shaft = tuple[Core | None, ...]
"""The core of each level from the top, some of them without a door; None below the shaft."""


def has_doors(shaft: Shaft) -> bool:
    """True if a shaft has a door on every level."""
    return all(core is not None and core.has_door for core in shaft)


def squares_of(shaft: Shaft) -> set[Square]:
    """Squares of a shaft, and of the lanes before its doors."""
    cores = [core for core in shaft if core is not None]
    return {core.square for core in cores} | {core.lane for core in cores if core.has_door}


def shaft_candidates(levels: Sequence[LevelPlan]) -> Iterator[Shaft]:
    """Yield the candidate shafts, each from the top level down to the lowest level on which it has a door.

    The ground is that of a candidate for one level alone, also with room for doors on its other sides. On the other
    levels, a passage of up to 3.6 m leads from its door to a lane; it has no door on a level above without such a lane.
    It replaces all stalls there that it leaves too narrow.
    """
    if len(levels) == 1:
        yield from ((core,) for core in core_candidates(*levels[0]))
        return
    sites = [_ShaftSite(level) for level in levels]
    seen: set[tuple[float, ...]] = set()
    for number, level in enumerate(levels):
        for core in _with_slender(core_candidates(*level), level.structure):
            box = tuple(np.round(_block(core).bounds, 3).tolist())
            if box not in seen:
                parts: list[Core | None] = []
                for other, site in enumerate(sites):
                    part = core if other == number else site.core_at(core)
                    if part is None:
                        break
                    parts.append(part)
                while parts and parts[-1] is not None and not parts[-1].has_door:
                    parts.pop()
                if len(parts) > number:
                    seen.add(box)
                    yield (*parts, *[None] * (len(levels) - len(parts)))


def _with_slender(cores: Iterable[Core], structure: Structure) -> Iterator[Core]:
    """Yield the cores, and a slenderer copy of each with room for a door on every side."""
    for core in cores:
        yield core
        row, col = core.square
        sides_m = float(structure.column_widths_mm[col]) / 1000, float(structure.row_depths_mm[row]) / 1000
        side_m, across_m = sides_m if core.along_x else sides_m[::-1]
        low = max(core.along_m - core.width_m / 2, RECESS_M - side_m / 2)
        high = min(core.along_m + core.width_m / 2, side_m / 2 - RECESS_M)
        depth_m = min(core.depth_m, across_m - RECESS_M - core.recess_m)
        if is_wide_enough(high - low, depth_m) and (high - low, depth_m) != (core.width_m, core.depth_m):
            along_m = (low + high) / 2
            middle = point_inside(structure, core.square, core.edge, along_m, core.recess_m + depth_m / 2)
            yield replace(
                core,
                centre_m=rounded(middle),
                width_m=round(high - low, 6),
                depth_m=round(depth_m, 6),
                along_m=round(along_m, 6),
            )


def _block(core: Core) -> shapely.Polygon:
    """Outline (x, z) of a core without the floor in front of its door."""
    return replace(core, recess_m=0.0).ground


class _ShaftSite:
    """A level that the shafts of other levels pass through."""

    def __init__(self, level: LevelPlan) -> None:
        self._level = level
        names: list[str] = []
        grounds: list[shapely.Polygon] = []
        for row, of_row in names_of_rows(level.graph).values():
            names += of_row
            grounds += _widened_grounds(level, row)
        self._names, self._stalls = names, shapely.STRtree(grounds)

    def core_at(self, core: Core) -> Core | None:
        """Return the core on the same ground, with the door that replaces the fewest stalls or without one.

        None if the ground is not free on this level.
        """
        structure, graph, _ = self._level
        if structure.cell_at(core.square) is not Cell.FREE:
            return None
        found = []
        for edge in Edge:
            lane = edge.beyond(core.square)
            if lane in graph.graph and structure.cells[lane] == Cell.LANE:
                door = self._with_door(core, edge)
                if door is not None:
                    found.append(door)
        if found:
            return min(found, key=lambda door: (len(door.stalls), door.recess_m, door.edge))
        closed = replace(core, recess_m=0.0, has_door=False)
        return replace(closed, stalls=self._replaced(closed))

    def _replaced(self, core: Core) -> tuple[str, ...]:
        """Ids of the stalls that a core and its passage replace."""
        touched = self._stalls.query(core.ground.buffer(-_TOUCH_M, join_style="mitre"), predicate="intersects")
        return tuple(self._names[index] for index in sorted(touched.tolist()))

    def _with_door(self, core: Core, edge: Edge) -> Core | None:
        structure, _, config = self._level
        origin, along, inside = (
            np.array(point_inside(structure, core.square, edge, *at)) for at in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
        )
        off = np.array(core.centre_m) - origin
        along_m, middle_m = float(off @ (along - origin)), float(off @ (inside - origin))
        turned = core.along_x is not edge.along_x
        width_m, depth_m = (core.depth_m, core.width_m) if turned else (core.width_m, core.depth_m)
        recess_m = round(middle_m - depth_m / 2, 6)
        row, col = core.square
        side_mm = structure.column_widths_mm[col] if edge.along_x else structure.row_depths_mm[row]
        reach_m = abs(along_m) + width_m / 2 + config.bay.column_size_m / 2
        if not RECESS_M <= recess_m <= _LONGEST_PASSAGE_M or reach_m > side_mm / 2000:
            return None
        found = Core(core.square, edge, core.centre_m, width_m, depth_m, round(along_m, 6), recess_m)
        return replace(found, stalls=self._replaced(found))


def _widened_grounds(level: LevelPlan, row: StallRow) -> Iterator[shapely.Polygon]:
    """Yield the outlines (x, z) of the stalls of a row, with the room beside them that their cars need at a wall."""
    shape, gap_m = row.shape, gap_to_stalls_m(row.shape.width_m, level.config.standard)
    lean_m = row.lean * shape.slope * shape.depth_m
    for start in row.starts_m:
        low, high = start - gap_m, start + shape.pitch_m + gap_m
        corners = ((low, 0.0), (high, 0.0), (high + lean_m, shape.depth_m), (low + lean_m, shape.depth_m))
        yield shapely.Polygon([point_inside(level.structure, row.square, row.edge, *at) for at in corners])


class Places(NamedTuple):
    """Candidates of one compartment.

    Attributes
    ----------
    shafts
        The cores of each candidate, one for each level.
    doors
        Positions (x, z) of their doors, infinite on levels without one; shape (levels, candidates, 2).
    price_m
        Costs of the candidates in metres, as the mean of all levels; shape (candidates,).
    stalls
        Numbers of stalls that they replace on all levels; shape (candidates,).
    squares
        Squares of each candidate, and of the lanes before its doors.
    through
        Numbers of the candidates with a door on each level; shape (n,).
    """

    shafts: list[Shaft]
    doors: Points
    price_m: NDArray[np.float64]
    stalls: NDArray[np.intp]
    squares: list[set[Square]]
    through: NDArray[np.intp]


def chosen_shafts(
    points: list[Points], places: Places | None, fixed: Points, exits: int, reach_m: float, budget: int
) -> list[Shaft]:
    """Choose the fewest cores of a compartment that give each level enough exits, and each stall one within reach."""
    chosen: list[int] = []
    if places is None:
        return []
    doors, are_reached = fixed, False
    for count in range(max(exits - fixed.shape[1], 0), len(places.through) + 1):
        chosen = _snapped(places, _spread(np.concatenate(points), fixed[0], count))
        doors = np.concatenate([fixed, places.doors[:, chosen]], axis=1)
        are_reached = bool(doors.shape[1]) and _are_reached(points, doors, reach_m)
        if are_reached:
            break
    is_enough = are_reached and doors.shape[1] >= exits and places.stalls[chosen].sum() <= budget
    if len(points) > 1 and not is_enough:
        chosen = _covering(points, places, fixed, exits, reach_m)
    return [places.shafts[index] for index in chosen]


def _are_reached(points: list[Points], doors: Points, reach_m: float) -> bool:
    """True if a door is within reach of each stall, on each level."""
    return all(
        float(_distances(own, near).min(axis=1).max(initial=0.0)) <= reach_m
        for own, near in zip(points, doors, strict=True)
    )


def _covering(points: list[Points], places: Places, fixed: Points, exits: int, reach_m: float) -> list[int]:
    """Choose shafts until all stalls have an exit within reach and all levels enough exits, as far as possible.

    In each step the shaft is added that adds the most for the stalls that it replaces, among equals the one farthest
    from the others.
    """
    has_door = np.isfinite(places.doors[..., 0])
    near = [
        (_distances(own, doors) <= reach_m) & there
        for own, doors, there in zip(points, places.doors, has_door, strict=True)
    ]
    left = [~(_distances(own, doors) <= reach_m).any(axis=1) for own, doors in zip(points, fixed, strict=True)]
    missing = np.full(len(points), exits - fixed.shape[1])
    free = np.ones(len(places.shafts), dtype=bool)
    chosen: list[int] = []
    while True:
        gains = sum(reached[still].sum(axis=0) for reached, still in zip(near, left, strict=True))
        gains = gains + _EXIT_WORTH_STALLS * (np.maximum(missing, 0) @ has_door)
        worth = np.where(free, gains / (1 + places.stalls), 0.0).round(9)
        if worth.max() <= 0:
            return chosen
        equal = np.flatnonzero(worth == worth.max())
        best = int(equal[np.argmax(_far_m(places, fixed, chosen)[equal])])
        chosen.append(best)
        free &= [not places.squares[best] & squares for squares in places.squares]
        missing -= has_door[:, best]
        left = [still & ~reached[:, best] for reached, still in zip(near, left, strict=True)]


def _far_m(places: Places, fixed: Points, chosen: list[int]) -> NDArray[np.float64]:
    """Distance of each candidate's doors to the nearest existing door, on any level; shape (candidates,)."""
    doors = np.concatenate([fixed, places.doors[:, chosen]], axis=1)
    if not doors.shape[1]:
        return np.zeros(len(places.shafts))
    with np.errstate(invalid="ignore"):
        nearest = [_distances(own, there).min(axis=1) for own, there in zip(places.doors, doors, strict=True)]
    far: NDArray[np.float64] = np.nan_to_num(nearest, nan=np.inf, posinf=np.inf).min(axis=0).round(6)
    return far


def _spread(points: Points, fixed: Points, count: int) -> Points:
    """Spread `count` places over points, in addition to fixed places."""
    centres = fixed
    for _ in range(count):
        if len(centres):
            nearest = _distances(points, centres).min(axis=1)
            centres = np.concatenate([centres, points[[int(np.argmax(nearest.round(6)))]]])
        else:
            centres = points[[int(np.argmin(points.sum(axis=1).round(6)))]]
    moving = centres[len(fixed) :].copy()
    for _ in range(_ROUNDS):
        owner = _distances(points, np.concatenate([fixed, moving])).round(6).argmin(axis=1) - len(fixed)
        for index in range(count):
            own = points[owner == index]
            if len(own):
                moving[index] = (own.min(axis=0) + own.max(axis=0)) / 2
    return moving


def _snapped(places: Places, centres: Points) -> list[int]:
    """Numbers of the candidates nearest to the places, at most one on each square."""
    chosen: list[int] = []
    middles, price_m = places.doors[:, places.through].mean(axis=0), places.price_m[places.through]
    squares = [places.squares[index] for index in places.through.tolist()]
    taken: set[Square] = set()
    for centre in centres:
        far = np.array([bool(own & taken) for own in squares])
        if far.all():
            break
        price = _distances(middles, centre[None])[:, 0] + price_m
        at = int(np.argmin(np.where(far, np.inf, price.round(6))))
        taken |= squares[at]
        chosen.append(int(places.through[at]))
    return chosen


def _distances(points: Points, others: Points) -> Points:
    off = points[:, None] - others[None]
    return elementary.hypot(off[..., 0], off[..., 1])
