"""Widths of lanes of a survey, from the ground between what stands beside them."""

import math
from collections import defaultdict
from dataclasses import replace

import shapely

from garage2usd.garage import LaneGraph, Point

__all__ = ["with_clear_widths"]

_LEAST_CLEAR_M, _MOST_CLEAR_M = 2.0, 12.0
_APART_M, _AXIS_M = 0.02, 0.08
_COLUMN_M = 1.0
_DIGITS = 4


def with_clear_widths(network: LaneGraph, standing: shapely.Geometry) -> LaneGraph:
    """Return a lane graph whose lanes are as wide as the ground between what stands beside them.

    Parameters
    ----------
    network
        The lane graph.
    standing
        Stalls, columns and walls, (x, z).

    Notes
    -----
    The width is twice the distance of a stretch from what stands nearest beside it. The given width stays where that is
    over twelve metres, on open ground, and where it is less than two, as centre lines of maps may cross stalls.
    """
    portals = {number for number, node in enumerate(network.nodes) if node.is_portal}
    width_m: defaultdict[int, float] = defaultdict(float)
    edges = []
    for edge in network.edges:
        if not portals & {edge.start, edge.end}:
            ends = [network.nodes[number].position for number in (edge.start, edge.end)]
            line = _longer(*ends)
            beside = standing.intersection(line.buffer(_MOST_CLEAR_M, cap_style="flat"))
            clear_m = math.inf if beside.is_empty else round(2 * beside.distance(line), _DIGITS)
            if _LEAST_CLEAR_M <= clear_m <= _MOST_CLEAR_M:
                edge = edge._replace(width_m=clear_m)  # noqa: PLW2901 - the same edge with its width
            for number in (edge.start, edge.end):
                width_m[number] = max(width_m[number], edge.width_m)
        edges.append(edge)
    # a door's road is as wide as the lane that it meets
    edges = [
        edge._replace(width_m=max(width_m[edge.start], width_m[edge.end]) or edge.width_m)
        if portals & {edge.start, edge.end}
        else edge
        for edge in edges
    ]
    nodes = []
    for number, node in enumerate(network.nodes):
        side_m = width_m[number] or node.widths_m[0]
        widths_m = _along_its_lane(network, number, side_m) if number not in portals else (side_m, side_m)
        nodes.append(replace(node, widths_m=widths_m, sides_m=widths_m))
    return LaneGraph(tuple(nodes), tuple(edges))


def _longer(start: Point, end: Point) -> shapely.LineString:
    """Return a stretch that is longer at both ends, as columns beside its ends count."""
    share = _COLUMN_M / (math.dist(start, end) or 1.0)
    off_x, off_z = share * (end[0] - start[0]), share * (end[1] - start[1])
    return shapely.LineString([(start[0] - off_x, start[1] - off_z), (end[0] + off_x, end[1] + off_z)])


def _along_its_lane(network: LaneGraph, number: int, side_m: float) -> tuple[float, float]:
    """Return the extent of a node's ground along X and Z, which ends where that of the nodes beside it begins."""
    node, halves_m = network.nodes[number], []
    axes = set()
    for other in network.beside[number]:
        beyond = network.nodes[other]
        away = [abs(one - two) for one, two in zip(beyond.position, node.position, strict=True)]
        axes.add(0 if away[1] < _AXIS_M else 1 if away[0] < _AXIS_M else None)
        halves_m.append(max(away) - beyond.widths_m[0] / 2 if beyond.is_portal else max(away) / 2)
    if len(axes) != 1 or None in axes:
        return side_m, side_m
    along_m = round(min(side_m, 2 * min(halves_m) - _APART_M), _DIGITS)
    return (along_m, side_m) if axes == {0} else (side_m, along_m)
