"""Shortest routes on the lane graph to a stall and away from it."""

from collections.abc import Sequence
from dataclasses import dataclass

from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import find_named
from garage2usd.garage import LaneGraph, LaneKind, Point, Stall

__all__ = ["Route", "Ways", "find_stall", "route_of", "ways_on_level"]

_SHOWN_NUMBERS = 3


@dataclass(frozen=True)
class Route:
    """Lane nodes of the shortest routes from an entrance to the lane before a stall, and from there to an exit."""

    to_stall: tuple[int, ...]
    from_stall: tuple[int, ...]


@dataclass(frozen=True)
class Ways:
    """Places (x, z) of the routes to a stall and away from it on one level, in the direction of driving."""

    to_stall: tuple[Point, ...]
    from_stall: tuple[Point, ...]


def find_stall(stalls: Sequence[Stall], number: str) -> Stall:
    """Find a stall by its number (``B2-07``) or id (``Stall_r03_c07_2``), ignoring case.

    Raises
    ------
    ConfigError
        If there is no such stall.
    """
    names = {stall: [str(name) for name in (stall.number, stall.name) if name] for stall in stalls}
    found = find_named(number, names)
    if len(found) == 1:
        return found[0]
    some = [str(stall.number) for stall in stalls if stall.number]
    known = f"numbers as {', '.join(some[:_SHOWN_NUMBERS])}" if some else "ids as in the report"
    raise ConfigError("stall", number, known)


def route_of(lanes: LaneGraph, stall: Stall) -> Route:
    """Find the shortest routes from any entrance to a stall and from it to any exit, not through other portals."""
    arrivals = (lanes.shortest_way(portal, stall.access) for portal in lanes.portals(LaneKind.ENTRANCE))
    departures = (lanes.shortest_way(stall.access, portal) for portal in lanes.portals(LaneKind.EXIT))
    # both exist, as every stall is reachable
    to_stall, from_stall = (min(filter(None, ways), key=lanes.way_m) for ways in (arrivals, departures))
    return Route(tuple(to_stall), tuple(from_stall))


def ways_on_level(lanes: LaneGraph, stall: Stall, level: int = 0) -> Ways:
    """Return the routes of `route_of` as far as they are on a level, with the ramps down to it."""
    route = route_of(lanes, stall)
    to_stall, from_stall = (
        tuple(node.position for node in map(lanes.nodes.__getitem__, way) if node.level == level)
        for way in (route.to_stall, route.from_stall)
    )
    return Ways(to_stall, from_stall)
