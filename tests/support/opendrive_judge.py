"""What is wrong with an OpenDRIVE map of a stage, as programs of others and the standard's equations see it."""

from pathlib import Path

import networkx as nx
import numpy as np
import shapely
from pxr import UsdGeom

from support.map_judges import carla_map, sumo_spaces
from support.opendrive_reader import OpenDrive, data_of
from support.rays import Rays
from support.stage_lanes import judged_stage

NEAR_M = 1e-3
ON_RAMP_M = 0.1
GROOVE_M = 0.0125
"""Depth of the grooves of ramps, and what a profile of straight stretches adds."""
STILL_PARALLEL, NEARLY_PARALLEL = 1 - 1e-7, 0.9
LEAST_SHARE = {"column": 0.75, "wall": 0.5, "barrier": 0.02, "speed_bump": 0.75, "obstacle": 0.5}
"""Of the bounds of what stands: walls have stripes and doors, and the arm of a gate is no part of what stands."""
ACCESS = {"standard": "car", "accessible": "handicapped", "ev": "electric", "motorcycle": "all"}


class MapJudge:
    """Compares a map with the stage that it was made of.

    Parameters
    ----------
    stage
        The stage's file, with its table of labels beside it.
    path
        The map.
    folder
        For what the programs write.
    """

    def __init__(self, stage, path, folder):
        self.path, self.folder, self.map = Path(path), folder, OpenDrive(path)
        self.judged = judged_stage(stage)
        self.stage, self.lanes, self.labelled = self.judged.stage, self.judged.lanes, self.judged.labelled

    def complaints(self):
        return [*self.of_objects(), *self.of_carla(), *self.of_sumo()]

    # Lanes as CARLA or another program has them: places, heights, ways

    def of_carla(self):
        yield from self.of_lanes(*carla_map(self.path, self.folder))

    def of_lanes(self, points, ways):
        """Of rows (road, lane, x, z, height, degrees from X to Z, width) of places on lanes, and of pairs of lanes."""
        yield from self._lanes_off_their_place(points)
        yield from self._off_the_floor(points)
        yield from astray_on_ramps(self.lanes, points)
        yield from self._reached_otherwise(points, ways)

    def _lanes_off_their_place(self, points):
        """On half of an aisle each, to the right of its middle."""
        yaw = np.radians(points[:, 5])
        ahead, place = np.stack([np.cos(yaw), np.sin(yaw)], axis=1), points[:, 2:4]
        for start, end, width, one_way in self.lanes.edges:
            a, b = self.lanes.middles[[start, end]]
            along = (b - a) / np.linalg.norm(b - a)
            right = np.array([-along[1], along[0]])
            run, aside = (place - a) @ along, (place - a) @ right
            cosine = ahead @ along
            on_it = (run >= 0) & (run <= np.linalg.norm(b - a)) & (np.abs(aside) < width / 2)
            # the lane of a portal comes from the middle of its door to the right half of the aisle
            on_it &= np.abs(cosine) > (NEARLY_PARALLEL if one_way else STILL_PARALLEL)
            if one_way:  # on the square of the portal alone: the next one is driven on in both directions
                at = start if self.lanes.kinds[start] == "entrance" else end
                on_it &= (np.abs(place - self.lanes.middles[at]) < self.lanes.widths[at] / 2).all(axis=1)
            for sign in (1, -1):
                own = on_it & (cosine * sign > 0)
                if own.any() != (sign == 1 or not one_way):
                    yield f"{'a' if own.any() else 'no'} lane from {(start, end)[::sign]}"
                if not one_way and own.any():
                    off = np.abs(sign * aside[own] - width / 4).max(), np.abs(points[own, 6] - width / 2).max()
                    if max(off) > NEAR_M:
                        yield f"lane {(start, end)[::sign]} is off by {off[0]:.4f} m, its width by {off[1]:.4f} m"

    def _off_the_floor(self, points):
        floors = [thing["path"] for thing in self.labelled if thing["class"] in {"floor", "ramp"}]
        rays = Rays(self.stage, {path: number for number, path in enumerate(floors, start=1)})
        # a millimetre towards the middle of the square: lanes of dead ends end on the edge of the floor
        away = self.lanes.middles - points[:, None, 2:4]
        inwards = away[np.arange(len(points)), np.linalg.norm(away, axis=2).argmin(axis=1)]
        x, z = (points[:, 2:4] + NEAR_M * inwards).T
        above = np.stack([x, points[:, 4] + 1, z], axis=1)
        owner, place, _ = rays.cast(above, np.tile((0.0, -1.0, 0.0), (len(points), 1)))
        if (owner == 0).any():
            yield f"{(owner == 0).sum()} of {len(points)} waypoints have no floor under them"
        off = np.abs(place[owner > 0, 1] - points[owner > 0, 4]).max()
        if off > GROOVE_M:
            yield f"a waypoint is {off:.3f} m from the floor"

    def _reached_otherwise(self, points, ways):
        graph = nx.DiGraph(ways)
        on = {}
        for number, (middle, widths) in enumerate(zip(self.lanes.middles, self.lanes.widths, strict=True)):
            inside = (np.abs(points[:, 2:4] - middle) < widths / 2).all(axis=1)
            on[number] = {(int(road), int(lane)) for road, lane in points[inside, :2]}
        asked = {stall["access"] for stall in self.lanes.stalls.values()}
        asked |= {number for number, kind in enumerate(self.lanes.kinds) if kind in {"entrance", "exit"}}
        driven, beyond = self.lanes.graph(), {}
        for number in sorted(asked):
            reached = set(on[number])
            for lane in on[number] & set(graph):
                if lane not in beyond:
                    beyond[lane] = nx.descendants(graph, lane)
                reached |= beyond[lane]
            expected = {number, *nx.descendants(driven, number)} & asked
            found = {other for other in asked if on[other] & reached}
            if found != expected:
                yield f"from node {number} {sorted(found ^ expected)[:6]} are reached in one of stage and map only"

    # SUMO: places of spaces

    def of_sumo(self):
        found = sumo_spaces(self.path, self.folder)
        spaces = {int(thing.get("id")): thing for _, thing, _ in self.map.objects("parkingSpace")}
        if found.keys() != spaces.keys():
            yield f"SUMO has {len(found)} of {len(spaces)} spaces"
        for number, corners in found.items():
            expected = box_around(self.lanes.stalls[spaces[number].get("name")]["corners"])
            apart = np.linalg.norm(corners[:, None] - expected, axis=2)
            if max(apart.min(axis=0).max(), apart.min(axis=1).max()) > NEAR_M:
                yield f"SUMO has {spaces[number].get('name')} {apart.min(axis=0).max():.4f} m off"

    # the standard's equations: stalls, building, signs

    def of_objects(self):
        yield from self._stalls()
        yield from self._building()
        yield from self._signs()
        header = self.map.root.find("header")
        said = self.stage.GetDefaultPrim().GetCustomData()
        if [data_of(header).get(name) for name in ("version", "seed")] != [str(said["version"]), str(said["seed"])]:
            yield "the header does not say version and seed"
        limits = [road.findall("type/speed") + road.findall(".//lane/speed") for road in self.map.roads.values()]
        lanes = sum(lane.get("type") == "driving" for lane in self.map.root.iter("lane"))
        said_of = [(speed.get("max"), speed.get("unit")) for limit in limits for speed in limit]
        if set(said_of) != {("10", "km/h")} or len(said_of) != lanes + len(self.map.roads):
            yield f"speed limits {set(said_of)}, said {len(said_of)} times"
        numbers = [one.get("id") for tag in ("object", "signal") for one in self.map.root.iter(tag)]
        numbers_of_roads = [one.get("id") for tag in ("road", "junction") for one in self.map.root.iter(tag)]
        if any(len(set(map(int, ids))) != len(ids) for ids in (numbers, numbers_of_roads)):
            yield "a number is given twice"

    def _stalls(self):
        taken, seen = self.judged.taken, set()
        lines = {}
        for _, thing, corners in self.map.objects("parkingSpace", "none"):
            name, data = thing.get("name"), data_of(thing)
            stall = self.lanes.stalls[name]
            seen.add(name)
            if np.abs(corners * (1, -1) - stall["corners"]).max() > NEAR_M:
                yield f"{name} has corners elsewhere or in another order"
            space = thing.find("parkingSpace")
            if (space.get("access") if space is not None else None) != ACCESS.get(stall["use"]):
                yield f"{name} is open to others than its use {stall['use']} says"
            if data["use"] != stall["use"] or data["number"] != stall["number"]:
                yield f"{name} has the number {data['number']}"
            if (data["occupied"] == "true") != (name in taken):
                yield f"{name} is said to be occupied: {data['occupied']}"
            pairs = [{int(one.get("id")) for one in line} for line in thing.iter("marking")]
            if stall["use"] in ACCESS and sorted(map(sorted, pairs)) != [[0, 3], [1, 2], [2, 3]]:
                yield f"{name} has lines at {pairs}"
            middle, half = self.lanes.middles[stall["access"]], self.lanes.widths[stall["access"]] / 2 + NEAR_M
            road = self.map.roads.get(data.get("accessRoad"))
            if road is None and "accessJunction" not in data:
                yield f"{name} opens onto nothing"
            if road is not None:
                if road not in lines:
                    runs = np.linspace(0, float(road.get("length")), 200)
                    lines[road] = np.array([self.map.place(road, run, 0)[0] for run in runs]) * (1, -1)
                if not (np.abs(lines[road] - middle) <= half).all(axis=1).any():
                    yield f"{name} does not open onto road {road.get('id')}"
        if seen != set(self.lanes.stalls):
            yield f"{len(set(self.lanes.stalls) - seen)} stalls are missing"

    def _building(self):
        kinds = {
            "column": ("pole", "column"),
            "wall": ("barrier", "wall"),
            "barrier": ("barrier", "gate"),
            "speed_bump": ("roadSurface", "speedBump"),
            "obstacle": ("building", "core"),
        }
        found = [(road, thing, corners) for road, thing, corners in self.map.objects()]
        for label, kind in kinds.items():
            own = [one for one in found if (one[1].get("type"), one[1].get("subtype")) == kind]
            ground = shapely.union_all(
                [shapely.Polygon(corners).buffer(0.02, join_style="mitre") for *_, corners in own]
            )
            for thing in self.labelled:
                if thing["class"] == label:
                    (x0, _, z0), (x1, _, z1) = thing["min_m"], thing["max_m"]
                    share = ground.intersection(shapely.box(x0, -z1, x1, -z0)).area / ((x1 - x0) * (z1 - z0))
                    if share < LEAST_SHARE[label]:
                        yield f"{share:.2f} of {thing['path']} is in the map"
            bounds = [one for one in self.labelled if one["class"] == label]
            wide = [shapely.box(o["min_m"][0], -o["max_m"][2], o["max_m"][0], -o["min_m"][2]) for o in bounds]
            if own and not shapely.union_all(wide).buffer(0.1).contains(ground):
                yield f"a {label} of the map is larger than that of the stage"
            top = max((one["max_m"][1] for one in bounds), default=0.0)
            for road, thing, _ in own:
                base = self.map.height(road, float(thing.get("s"))) + float(thing.get("zOffset"))
                if base < -0.05 or base + float(thing.get("height")) > top + 0.05:
                    yield f"{thing.get('name')} reaches from {base:.2f} m to {base + float(thing.get('height')):.2f} m"

    def _signs(self):
        signs = {
            Path(one["path"]).as_posix(): one
            for one in self.labelled
            if one["class"] in {"traffic_sign", "exit_sign", "lane_sign"}
        }
        places, fronts = UsdGeom.XformCache(), []
        for path in signs:
            matrix = np.array(places.GetLocalToWorldTransform(self.stage.GetPrimAtPath(path)))
            fronts.append((matrix[3, 0], -matrix[3, 2], np.arctan2(-matrix[2, 2], matrix[2, 0])))
        found = list(self.map.root.iter("signal"))
        if len(found) != len(fronts):
            yield f"{len(found)} of {len(fronts)} signs"
        for road in self.map.roads.values():
            for sign in road.iter("signal"):
                place, heading = self.map.place(road, float(sign.get("s")), float(sign.get("t")))
                turn = heading + float(sign.get("hOffset"))
                near = [
                    np.hypot(place[0] - x, place[1] - y) < 0.3 and np.cos(turn - front) > 0.999
                    for x, y, front in fronts
                ]
                if not any(near):
                    yield f"sign {sign.get('name')} stands elsewhere or looks elsewhere"


def box_around(corners):
    """The corners of a stall's box along its sides, which is all that SUMO has of a slanted one."""
    back = corners[2:].mean(axis=0) - corners[:2].mean(axis=0)
    along = back / np.linalg.norm(back)
    axes = np.array([along, (-along[1], along[0])])
    low, high = (corners @ axes.T).min(axis=0), (corners @ axes.T).max(axis=0)
    return np.array([(low[0], low[1]), (low[0], high[1]), (high[0], high[1]), (high[0], low[1])]) @ axes


def astray_on_ramps(lanes, points):
    """What is wrong with lanes on ramps, of rows as `MapJudge.of_lanes` takes them.

    A ramp belongs to the portal at its foot; its head, at the street, may be nearer to another portal of the site.
    """
    roads = {int(road): points[points[:, 0] == road] for road in np.unique(points[points[:, 4] > ON_RAMP_M, 0])}
    feet = np.array([own[own[:, 4].argmin(), 2:4] for own in roads.values()]).reshape(-1, 2)
    portals = [number for number, kind in enumerate(lanes.kinds) if kind in {"entrance", "exit"}]
    nearest = np.linalg.norm(feet[:, None] - lanes.middles[portals], axis=2).argmin(axis=1)
    for index, number in enumerate(portals):
        ramps = [
            own[own[:, 4] > ON_RAMP_M] for own, other in zip(roads.values(), nearest, strict=True) if other == index
        ]
        if not ramps:
            yield f"no lane on the ramp of portal {number}"
            continue
        own = np.concatenate(ramps)
        yaw, away = np.radians(own[:, 5]), own[:, 2:4] - lanes.middles[number]
        outwards = (np.stack([np.cos(yaw), np.sin(yaw)], axis=1) * away).sum(axis=1) > 0
        if (outwards != (lanes.kinds[number] == "exit")).any():
            yield f"lanes on the ramp of portal {number} run the wrong way"
        aside = np.abs(away).min(axis=1).max()
        if aside > NEAR_M:
            yield f"the lane on the ramp of portal {number} is {aside:.4f} m beside the middle of its door"
