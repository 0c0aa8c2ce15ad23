"""OpenDRIVE as the standard's equations say it, with numpy alone: places of objects, heights and lanes."""

import xml.etree.ElementTree as ET

import numpy as np


def _numbers(element, *names):
    return [float(element.get(name)) for name in names]


def _polynomial(elements, start, s):
    """The value at s of the cubic that begins last before it."""
    chosen = max((one for one in elements if float(one.get(start)) <= s + 1e-9), key=lambda one: float(one.get(start)))
    a, b, c, d = _numbers(chosen, "a", "b", "c", "d")
    ds = s - float(chosen.get(start))
    return a + b * ds + c * ds**2 + d * ds**3


class OpenDrive:
    """A map."""

    def __init__(self, path):
        self.root = ET.parse(path).getroot()
        self.roads = {road.get("id"): road for road in self.root.iter("road")}

    def line(self, road, s):
        """(x, y, heading) of a road's reference line (OpenDRIVE 1.8, 9.3 and 9.5)."""
        pieces = road.find("planView").findall("geometry")
        piece = max((one for one in pieces if float(one.get("s")) <= s + 1e-9), key=lambda one: float(one.get("s")))
        start, x, y, heading = _numbers(piece, "s", "x", "y", "hdg")
        run, arc = s - start, piece.find("arc")
        if arc is None:
            return x + run * np.cos(heading), y + run * np.sin(heading), heading
        curvature = float(arc.get("curvature"))
        chord, turned = 2 / curvature * np.sin(run * curvature / 2), run * curvature
        return x + chord * np.cos(heading + turned / 2), y + chord * np.sin(heading + turned / 2), heading + turned

    def place(self, road, s, t):
        """(x, y) at s and t, and the heading there."""
        x, y, heading = self.line(road, s)
        return np.array([x - t * np.sin(heading), y + t * np.cos(heading)]), heading

    def height(self, road, s):
        return _polynomial(road.find("elevationProfile"), "s", s)

    def lanes(self, road, s):
        """Number, t of the middle, width of each driving lane at s (11.4 and 11.6)."""
        offsets = road.find("lanes").findall("laneOffset")
        offset = _polynomial(offsets, "s", s) if offsets else 0.0
        section = road.find("lanes/laneSection")
        found = []
        for side, sign in (("left", 1), ("right", -1)):
            edge = offset
            for lane in sorted(section.findall(f"{side}/lane"), key=lambda one: abs(int(one.get("id")))):
                width = _polynomial(lane.findall("width"), "sOffset", s)
                found.append((int(lane.get("id")), edge + sign * width / 2, width))
                edge += sign * width
        return found

    def objects(self, *types):
        """Each object with its road, and the corners (x, y) of its outline (13.3, 13.5)."""
        for road in self.roads.values():
            for thing in road.iter("object"):
                if types and thing.get("type") not in types:
                    continue
                s, t, turn = _numbers(thing, "s", "t", "hdg")
                assert 0 <= s <= float(road.get("length")) + 1e-6
                middle, heading = self.place(road, s, t)
                cos, sin = np.cos(heading + turn), np.sin(heading + turn)
                local = np.array([_numbers(corner, "u", "v") for corner in thing.iter("cornerLocal")])
                yield road, thing, middle + local @ np.array([[cos, sin], [-sin, cos]])


def data_of(element):
    """What is said of an element beyond the standard."""
    return {one.get("code"): one.get("value") for one in element.findall("userData")}
