"""Choice among candidate stair shafts: enough exits on foot, within reach of every stall of all levels."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.layout.egress.shafts import Shaft
from garage2usd.native import elementary
from garage2usd.structure.lane_graph import Square

__all__ = ["Places", "Points", "chosen_shafts"]

Points = NDArray[np.float64]

_EXIT_WORTH_STALLS = 20
"""A missing exit counts as much as this number of stalls out of reach."""
_ROUNDS = 6


class Places(NamedTuple):
    """Candidates of one compartment.

    Attributes
    ----------
    shafts
        The core of each level, of each candidate.
    doors
        Positions (x, z) of their doors, infinite on levels without one; shape (levels, candidates, 2).
    price_m
        Their costs in metres, as the mean of all levels; shape (candidates,).
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
    """Least set of cores for a compartment that has enough exits and one within reach of each stall, on each level."""
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
    """Choose shafts until all stalls that can be reached are, and all levels that can have enough exits have them.

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
    """Distance of each candidate's doors to the nearest door that is there, on any level; shape (candidates,)."""
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
