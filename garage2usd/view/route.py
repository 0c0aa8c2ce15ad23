"""The routes to a stall and away from it, on lanes."""

from dataclasses import dataclass

from garage2usd.common.errors import ConfigError
from garage2usd.common.spelling import called
from garage2usd.garage import LaneKind
from garage2usd.layout import Layout, PlacedStall
from garage2usd.structure.lane_graph import LaneSquares, Square

__all__ = ["Route", "find_stall", "route_of"]

_SHOWN_NUMBERS = 3


@dataclass(frozen=True)
class Route:
    """Squares from an entrance to the lane before a stall, and from there to an exit, each the shortest way."""

    to_stall: tuple[Square, ...]
    from_stall: tuple[Square, ...]


def find_stall(layout: Layout, number: str) -> PlacedStall:
    """The stall of a number (``B2-07``) or an id (``Stall_r03_c07_2``), in letters of whatever case.

    Raises
    ------
    ConfigError
        If there is no such stall.
    """
    found = called(number, {stall: [name for name in (stall.number, stall.name) if name] for stall in layout.stalls})
    if len(found) == 1:
        return found[0]
    some = [stall.number for stall in layout.stalls if stall.number]
    known = f"numbers as {', '.join(some[:_SHOWN_NUMBERS])}" if some else "ids as in the report"
    raise ConfigError("stall", number, known)


def route_of(graph: LaneSquares, stall: PlacedStall) -> Route:
    """The shortest routes from any entrance to a stall and from it to any exit, not through another portal."""

    def nearest(kind: LaneKind) -> list[Square]:
        portals = sorted(square for square in graph.graph if graph.kind(square) is kind)
        ways = [graph.shortest_way(portal, stall.access_square) for portal in portals]
        # there is one of each, as every stall is reached
        return min(filter(None, ways), key=graph.length_m)

    return Route(tuple(nearest(LaneKind.ENTRANCE)), tuple(reversed(nearest(LaneKind.EXIT))))
