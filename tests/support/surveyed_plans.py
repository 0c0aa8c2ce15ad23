"""Generated garages as surveys: their stalls, lanes, columns, portals and outline in metres, without squares."""

import networkx as nx
import numpy as np
import shapely

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import LaneKind
from garage2usd.survey.survey import (
    PortalKind,
    Survey,
    SurveyedColumn,
    SurveyedLane,
    SurveyedPortal,
    SurveyedStall,
)


def survey_of(layout):
    """The survey that someone who measures a garage would write."""
    graph = layout.lane_graph
    stalls = tuple(
        SurveyedStall(stall.name, tuple(stall.corners), 0, stall.use, SizeClass(stall.size), str(stall.number or ""))
        for stall in layout.quads
    )
    columns = tuple(
        SurveyedColumn((place.position_m[0], place.position_m[2]), place.spec.size_m)
        for place in layout.of_kind("column")
    )
    outline = shapely.Polygon(max(shapely.get_parts(_ground(layout)), key=lambda part: part.area).exterior)
    portals = tuple(
        SurveyedPortal((place.position_m[0], place.position_m[2]), PortalKind(_kind(place.spec)))
        for place in layout.of_kind("portal")
    )
    corners = tuple((float(x), float(z)) for x, z in shapely.get_coordinates(outline.simplify(1e-3))[:-1])
    blocks = [place for place in layout.of_kind("obstacle") if place.name.startswith("Obstacle")]
    solids = tuple(tuple(place.outlines()[0]) for place in blocks)
    return Survey(stalls, tuple(_lanes(graph)), columns, portals, corners, solids=solids)


def _kind(spec):
    return "entrance" if spec.is_entrance else "exit"


def _ground(layout):
    structure = layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    from garage2usd.structure.grid import outside_squares

    squares = np.argwhere(~outside_squares(structure.cells)).tolist()
    return shapely.union_all([shapely.box(x[col], z[row], x[col + 1], z[row + 1]) for row, col in squares])


def _lanes(graph):
    """Straight stretches between the bends, junctions and tips of lanes; portals are doors, not lanes."""
    nodes = graph.nodes
    portals = {number for number, node in enumerate(nodes) if node.kind in {LaneKind.ENTRANCE, LaneKind.EXIT}}
    edges = [edge for edge in graph.edges if not {edge.start, edge.end} & portals]
    beside = nx.Graph((edge.start, edge.end) for edge in edges)
    of = {frozenset((edge.start, edge.end)): edge for edge in edges}
    left = set(of)
    while left:
        edge = of[min(left, key=sorted)]
        way = [edge.start, edge.end]
        left.discard(frozenset(way))
        for is_back in (False, True):
            while (onward := _onward(way, beside, nodes)) is not None and frozenset((way[-1], onward)) in left:
                following = of[frozenset((way[-1], onward))]
                is_against = edge.one_way and (following.end if is_back else following.start) != way[-1]
                if is_against or (following.one_way, following.width_m) != (edge.one_way, edge.width_m):
                    break
                left.discard(frozenset((way[-1], onward)))
                way.append(onward)
            way.reverse()
        yield SurveyedLane((nodes[way[0]].position, nodes[way[-1]].position), edge.width_m, edge.one_way)


def _onward(way, beside, nodes):
    """The next node straight ahead."""
    ahead = np.subtract(nodes[way[-1]].position, nodes[way[-2]].position)
    for other in beside[way[-1]]:
        step = np.subtract(nodes[other].position, nodes[way[-1]].position)
        if other != way[-2] and ahead @ step > 0.999 * np.linalg.norm(ahead) * np.linalg.norm(step):
            return other
    return None
