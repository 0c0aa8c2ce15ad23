"""The way to a stall and away from it, on lanes."""

from dataclasses import dataclass

import networkx as nx

from garage2usd.errors import ConfigError
from garage2usd.layout import Layout, Stall
from garage2usd.structure.lane_graph import LaneGraph, LaneKind, Square

__all__ = ["Route", "find_stall", "route_of"]

_PORTALS = {LaneKind.ENTRANCE, LaneKind.EXIT}
_SHOWN_NUMBERS = 3


@dataclass(frozen=True)
class Route:
    """Squares from an entrance to the lane before a stall, and from there to an exit, each the shortest way."""

    to_stall: tuple[Square, ...]
    from_stall: tuple[Square, ...]


def find_stall(layout: Layout, number: str) -> Stall:
    """The stall of a number (``B2-07``) or an id (``Stall_r03_c07_2``).

    Raises
    ------
    ConfigError
        If there is none.
    """
    for stall in layout.stalls:
        if number in {stall.number, stall.name}:
            return stall
    some = [stall.number for stall in layout.stalls if stall.number]
    known = f"numbers as {', '.join(some[:_SHOWN_NUMBERS])}" if some else "ids as in the report"
    raise ConfigError("stall", number, known)


def route_of(graph: LaneGraph, stall: Stall) -> Route:
    """The shortest routes from any entrance to a stall and from it to any exit, not through another portal."""
    squares = graph.graph.nodes
    lanes = [square for square in squares if graph.kind(square) not in _PORTALS]

    def nearest(kind: LaneKind) -> list[Square]:
        ways = []
        for portal in sorted(square for square in squares if graph.kind(square) is kind):
            roads = graph.graph.subgraph([*lanes, portal])
            if nx.has_path(roads, portal, stall.access_square):
                ways.append(nx.shortest_path(roads, portal, stall.access_square, weight="length_m"))
        # there is one of each, as every stall is reached
        return min(ways, key=lambda way: nx.path_weight(graph.graph, way, "length_m"))

    return Route(tuple(nearest(LaneKind.ENTRANCE)), tuple(reversed(nearest(LaneKind.EXIT))))
