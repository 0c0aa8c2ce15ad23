"""Lanes of OpenDRIVE's connecting roads, laid from middle to middle of the roads that they connect."""

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.survey.lanelets import line_between
from garage2usd.survey.opendrive_lanes import RoadLane

Floats = NDArray[np.float64]
_DIGITS = 3


class Link(NamedTuple):
    """What a road element says of its neighbours.

    Attributes
    ----------
    is_connecting
        True if the road belongs to a junction.
    roads
        Ids of the roads before and after it; None where it links to none.
    """

    is_connecting: bool
    roads: tuple[str | None, str | None]


def with_joined_lanes(
    lanes: Mapping[str, Sequence[RoadLane]], links: Mapping[str, Link]
) -> Iterator[tuple[str, int, RoadLane]]:
    """Yield the lanes of roads with the id of each road and their numbers on it, connecting ones from middle to middle.

    Notes
    -----
    The lanes of a connecting road continue single lanes of the roads that it connects, beside the middle of these if
    they are driven in both directions. A survey has one centre line for such a road, so the ends of connecting lanes
    are moved onto it. Lanes that are the same then are one, and one of both directions, in the middle of both, where
    they lead both ways.
    """
    joined: dict[tuple[tuple[float, ...], tuple[float, ...], frozenset[str | None]], tuple[str, int, RoadLane]] = {}
    for road, found in lanes.items():
        for number, lane in enumerate(found):
            if not links[road].is_connecting:
                yield road, number, lane
                continue
            ends = [_ends_of(lanes.get(other or "", ())) for other in links[road].roads]
            moved = _moved(lane, [end for own in ends for end in own])
            start, end = (tuple(np.round(moved.points[place], _DIGITS).tolist()) for place in (0, -1))
            roads = frozenset(links[road].roads)  # those of another level may have the same ends
            if (end, start, roads) in joined:
                other_road, other_number, other = joined[end, start, roads]
                width_m = other.width_m + lane.width_m
                middle, _ = line_between(other.points, moved.points[::-1])
                joined[end, start, roads] = other_road, other_number, RoadLane(np.array(middle), width_m, one_way=False)
            else:
                joined.setdefault((start, end, roads), (road, number, moved))
    yield from joined.values()


def _ends_of(lanes: Sequence[RoadLane]) -> Iterator[tuple[Floats, float]]:
    """Yield both ends of the lanes of a road that are driven in both directions, and the half width there."""
    for lane in lanes:
        if not lane.one_way:
            yield from ((lane.points[place], lane.width_m / 2) for place in (0, -1))


def _moved(lane: RoadLane, ends: Sequence[tuple[Floats, float]]) -> RoadLane:
    """Return a lane whose ends are the nearest of some ends, where these lie within their half width of it."""
    shifts = np.zeros((2, 2))
    for index, place in enumerate((0, -1)):
        away = [(float(np.linalg.norm(end - lane.points[place])), end, half_m) for end, half_m in ends]
        near = min(away, key=lambda each: each[0], default=None)
        if near is not None and near[0] <= near[2]:
            shifts[index] = near[1] - lane.points[place]
    runs = np.concatenate([[0.0], np.linalg.norm(np.diff(lane.points, axis=0), axis=1).cumsum()])
    share = (runs / runs[-1])[:, None]
    return lane._replace(points=lane.points + (1 - share) * shifts[0] + share * shifts[1])
