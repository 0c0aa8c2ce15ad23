"""What Lanelet2 reads in a map, as JSON: lanelets and where they lead, areas, lines; runs where lanelet2 is installed.

usage: lanelet2_dump.py MAP LATITUDE LONGITUDE OUTPUT
"""

import json
import sys

from lanelet2 import core, geometry, io, projection, routing, traffic_rules

COST = 1e9
APART_M = 0.05
"""As in Lanelet2's check `mapping.points_too_close`, which its wheel for Python lacks."""

map_path, latitude_deg, longitude_deg, output_path = sys.argv[1:]
projector = projection.LocalCartesianProjector(io.Origin(float(latitude_deg), float(longitude_deg)))


def tags_of(thing):
    return {entry.key(): entry.data() for entry in thing.attributes}


def place_of(point):
    """(x, y) on the plane that touches the earth at the origin, and the height over the ellipsoid."""
    return [point.x, point.y, projector.reverse(core.BasicPoint3d(point.x, point.y, point.z)).alt]


def line_of(line):
    return {"id": line.id, "tags": tags_of(line), "places": [place_of(point) for point in line]}


def is_close(point):
    """Whether the nearest other point on the plane is too close in space."""
    around = garage.pointLayer.nearest(core.BasicPoint2d(point.x, point.y), 2)
    return any(other.id != point.id and geometry.distance(point, other) < APART_M for other in around)


garage, errors = io.loadRobust(map_path, projector)
rules = traffic_rules.create(traffic_rules.Locations.Germany, traffic_rules.Participants.Vehicle)
graph = routing.RoutingGraph(garage, rules)
found = {
    "errors": list(errors),
    "faults": list(graph.checkValidity(False)),
    "close": [place_of(point) for point in garage.pointLayer if is_close(point)],
    "points": [
        [*place_of(point), float(point.attributes["local_x"]), float(point.attributes["local_y"])]
        for point in garage.pointLayer
    ],
    "lanelets": [
        {
            "id": lanelet.id,
            "tags": tags_of(lanelet),
            "left": line_of(lanelet.leftBound),
            "right": line_of(lanelet.rightBound),
            "points": [point.id for bound in (lanelet.leftBound, lanelet.rightBound) for point in bound],
            "passable": rules.canPass(lanelet),
            "one_way": rules.isOneWay(lanelet),
            "limit": str(rules.speedLimit(lanelet).speedLimit),
            "following": [other.id for other in graph.following(lanelet)],
            "beside": [other.id for other in graph.besides(lanelet) if other.id != lanelet.id],
            "reaches": [other.id for other in graph.reachableSet(lanelet, COST, 0)],
            "rules": [
                {
                    "kind": type(rule).__name__,
                    "sign": rule.type(),
                    "refers": [line_of(line) for line in rule.trafficSigns()],
                    "stops": [line_of(line) for line in rule.refLines()],
                }
                for rule in lanelet.regulatoryElements
                if isinstance(rule, core.TrafficSign)
            ],
        }
        for lanelet in garage.laneletLayer
    ],
    "areas": [
        {
            "tags": tags_of(area),
            "places": [place for line in area.outerBound for place in line_of(line)["places"][:-1]],
            "points": [point.id for line in area.outerBound for point in line],
        }
        for area in garage.areaLayer
    ],
    "lines": [line_of(line) for line in garage.lineStringLayer],
    "polygons": [line_of(polygon) for polygon in garage.polygonLayer],
}
with open(output_path, "w", encoding="utf-8") as file:
    json.dump(found, file)
