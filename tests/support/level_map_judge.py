"""Judge of maps of garages of several levels by what CARLA, libOpenDRIVE, SUMO, ASAM and Lanelet2 make of them."""

import xml.etree.ElementTree as ET
from functools import cached_property

import networkx as nx
import numpy as np
import shapely

from support.drive_judge import assert_on_the_ground
from support.libopendrive_judge import dumped
from support.map_judges import carla_map, lanelet2_map, sumo_spaces
from support.opendrive_judge import ACCESS

MILLIMETRE = 1e-3
STREET_M = 2.5
"""Height over the upper floor at which the street is nearer than the garage."""
LEAST_ON_RAMPS = 100
"""Places every half metre on the lanes of all ramps between levels."""
ROUNDED_M = 2e-3
"""Of heights in a Lanelet2 map."""


class LevelMapJudge:
    """Compares maps with the stage that they were made of.

    Parameters
    ----------
    judge
        The `LevelJudge` of the stage.
    storey_m
        Height of a storey.
    folder
        For what the programs write.
    """

    def __init__(self, judge, storey_m, folder):
        self.judge, self.folder = judge, folder
        self.floors_m = [-storey_m * number for number in range(len(judge.names))]

    @cached_property
    def ground(self):
        return self.judge.ground()

    @cached_property
    def squares(self):
        """Ground (x, z) of the squares that stalls of the lowest level open onto, by their lane nodes."""
        judge, lowest = self.judge, len(self.floors_m) - 1
        nodes = {node for node, level in zip(judge.access, judge.stall_levels, strict=True) if level == lowest}
        corners = {node: (judge.places[node, [0, 2]], judge.widths[node] / 2) for node in sorted(nodes)}
        return {node: shapely.box(*(middle - half), *(middle + half)) for node, (middle, half) in corners.items()}

    def of_carla(self, path):
        return self.of_lanes(*carla_map(path, self.folder))

    def of_libopendrive(self, path, program):
        points, ways, spaces = dumped(program, path)
        yield from self.of_lanes(points, ways)
        given = zip(self.judge.stall_ids, self.judge.outlines[:, :, [0, 2]], self.judge.uses, strict=True)
        stalls = {name: corners for name, corners, use in given if use in ACCESS}
        for name in sorted(spaces.keys() ^ stalls.keys()):
            yield f"{name} is in one of stage and map only"
        for name in spaces.keys() & stalls.keys():
            if shapely.Polygon(spaces[name]).hausdorff_distance(shapely.Polygon(stalls[name])) > MILLIMETRE:
                yield f"{name} is elsewhere"

    def of_lanes(self, points, ways):
        """Of rows (road, lane, x, z, height, ...) of places on lanes, and of pairs of lanes that follow each other."""
        places = points[:, [2, 4, 3]]
        assert_on_the_ground(self.ground, places, self.floors_m)
        lanes = [(int(road), int(lane)) for road, lane in points[:, :2]]
        street = {lane for lane, height in zip(lanes, points[:, 4], strict=True) if height > STREET_M}
        off_m = np.abs(points[:, 4, None] - self.floors_m).min(axis=1)
        if ((points[:, 4] < -MILLIMETRE) & (off_m > MILLIMETRE)).sum() <= LEAST_ON_RAMPS:
            yield "there are hardly any places on the ramps between levels"
        is_low = np.abs(points[:, 4] - self.floors_m[-1]) < MILLIMETRE
        for word, led in zip(("to", "from"), led_by(nx.DiGraph(ways), street), strict=True):
            on_led = shapely.multipoints(points[is_low & [lane in led for lane in lanes]][:, 2:4])
            for node, square in self.squares.items():
                if not square.intersects(on_led):
                    yield f"no lane {word} the street on the square at {self.judge.places[node].round(2)}"

    def of_sumo(self, path):
        """SUMO has every parking space of an OpenDRIVE map where the stage has the stall."""
        spaces = sumo_spaces(path, self.folder)
        names = {
            int(thing.get("id")): thing.get("name")
            for thing in ET.parse(path).getroot().iter("object")
            if thing.get("type") == "parkingSpace"
        }
        if not spaces or spaces.keys() != names.keys():
            yield f"SUMO has {len(spaces)} of {len(names)} spaces"
        outlines = dict(zip(self.judge.stall_ids, self.judge.outlines, strict=True))
        for number in spaces.keys() & names.keys():
            stall = shapely.Polygon(outlines[names[number]][:, [0, 2]])
            if shapely.Polygon(spaces[number]).hausdorff_distance(stall) > MILLIMETRE:
                yield f"SUMO has {names[number]} elsewhere"

    def of_lanelet2(self, path, origin=(49.0, 9.0)):
        """Routes lead from every stall of the lowest level to the street and back; only ramps lead to other levels."""
        found = lanelet2_map(path, self.folder, *origin)
        yield from found["errors"]
        if found["close"]:
            yield f"{len(found['close'])} points lie within 5 cm of another, as {found['close'][:2]}"
        lanelets = {lanelet["id"]: lanelet for lanelet in found["lanelets"]}
        heights = {
            number: np.array([place[2] for side in ("left", "right") for place in lanelet[side]["places"]])
            for number, lanelet in lanelets.items()
        }
        street = {number for number, height in heights.items() if height.max() > STREET_M}
        portals = sum(kind in {"entrance", "exit"} for kind in self.judge.kinds)
        if len(street) != portals:
            yield f"{len(street)} lanelets lead over {portals} portals to the street"
        routes = nx.DiGraph((number, other) for number, lanelet in lanelets.items() for other in lanelet["following"])
        out, into = led_by(routes, street)
        rises = {number: np.ptp(height) for number, height in heights.items() if height.max() < MILLIMETRE}
        climbing = {number for number, rise in rises.items() if rise > ROUNDED_M}
        if not climbing <= out | into:
            yield "a ramp between levels does not belong to a way from the street or to it"
        storeys = sum(rises[number] for number in climbing) / -self.floors_m[1]
        if abs(storeys - 2 * (len(self.floors_m) - 1)) > ROUNDED_M:
            yield f"lanelets of ramps rise over {storeys:.3f} storeys"
        low = {
            number: shapely.Polygon(
                [(x, -y) for x, y, _ in (*lanelet["left"]["places"], *reversed(lanelet["right"]["places"]))]
            )
            for number, lanelet in lanelets.items()
            if np.abs(heights[number] - self.floors_m[-1]).max() < ROUNDED_M
        }
        for word, led in zip(("to", "from"), (out, into), strict=True):
            ground = shapely.union_all([low[number] for number in low.keys() & led])
            for node, square in self.squares.items():
                if not square.intersection(ground).area > 1.0:
                    yield f"no lanelet {word} the street on the square at {self.judge.places[node].round(2)}"
        for number, lanelet in lanelets.items():
            for other in lanelet["following"]:
                if abs(heights[number].mean() - heights[other].mean()) > -self.floors_m[1] / 2 + MILLIMETRE:
                    yield f"lanelet {number} is followed by {other} of another level"


def led_by(ways, street):
    """What leads to the street, and what the street leads to."""
    street = street & set(ways)
    return (
        set().union(street, *(nx.ancestors(ways, lane) for lane in street)),
        set().union(street, *(nx.descendants(ways, lane) for lane in street)),
    )
