"""What an OpenSCENARIO file says, with numpy and shapely alone, in the frame of maps."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import shapely


class OpenScenario:
    """A scenario.

    Its vehicles stand by the standard: a position is that of the middle of the rear axle.
    """

    def __init__(self, path):
        self.root = ET.parse(path).getroot()
        self.vehicles = {one.get("name"): one.find("Vehicle") for one in self.root.iter("ScenarioObject")}
        self.inits = {one.get("entityRef"): positions(one)[0] for one in self.root.iter("Private")}

    @property
    def road_file(self):
        """The map that it names."""
        (road,) = self.root.iter("LogicFile")
        return road.get("filepath")

    def track(self):
        """Time, x, y, z, heading, pitch and roll of each vertex of the trajectory."""
        (line,) = self.root.iter("Polyline")
        times = [[float(vertex.get("time"))] for vertex in line.findall("Vertex")]
        return np.hstack([times, positions(line)])

    def box(self, name):
        """The ground of a vehicle as it stands at first, and the direction of its nose."""
        vehicle = self.vehicles[name]
        assert float(vehicle.find(".//RearAxle").get("positionX")) == 0
        size, centre = (vehicle.find(f"BoundingBox/{tag}") for tag in ("Dimensions", "Center"))
        length, width, ahead = float(size.get("length")), float(size.get("width")), float(centre.get("x"))
        x, y, _, heading, _, _ = self.inits[name]
        along = np.array([math.cos(heading), math.sin(heading)])
        across = np.array([-along[1], along[0]])
        signs = ((1, 1), (1, -1), (-1, -1), (-1, 1))
        corners = [[x, y] + along * (ahead + s * length / 2) + across * t * width / 2 for s, t in signs]
        return shapely.Polygon(corners), along


def positions(element):
    """Places and angles of all positions in an element."""
    return [[float(at.get(name)) for name in ("x", "y", "z", "h", "p", "r")] for at in element.iter("WorldPosition")]
