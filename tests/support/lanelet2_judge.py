"""What is wrong with a Lanelet2 map of a stage, as Lanelet2 itself reads it."""

from collections import defaultdict
from itertools import pairwise
from xml.parsers import expat

import networkx as nx
import numpy as np
import shapely

from support.map_judges import lanelet2_map
from support.rays import Rays
from support.stage_lanes import judged_stage

NEAR_M = 1e-3
APART_M = 0.05
"""Least distance between two points of a map."""
SAG_M = 2.5e-3
"""How far a bound may lie off its bend: a millimetre, and more where points of others stand in the way of its own."""
TIGHT_M = 0.02
"""How far a bound may lie off a bend whose points cannot be nearer to one another."""
GROOVE_M = 0.012
"""Depth of the grooves of ramps, and what single precision adds."""
LEAST_IN_SQUARE_M = 1.0
"""Of a lane that crosses a square: others reach a little into those of junctions."""
STRAIGHT_RAD = 0.1
PORTALS = {"entrance", "exit"}
PARKED_IN = {"standard", "accessible", "ev", "motorcycle"}
SIGNS = {"barrier": "stop_sign", "speed_bump": "de112"}
ORIGIN = 49.0, 9.0


class Lanelet2Judge:
    """Compares a map with the stage that it was made of.

    Parameters
    ----------
    stage
        The stage's file, with its table of labels beside it.
    path
        The map.
    folder
        For what Lanelet2 says.
    origin
        Latitude and longitude of the stage's origin in degrees.
    limit_km_h
        The speed limit.
    """

    def __init__(self, stage, path, folder, *, origin=ORIGIN, limit_km_h=10.0):
        self.judged, self.map = judged_stage(stage), lanelet2_map(path, folder, *origin)
        self.stage, self.lanes, self.labelled = self.judged.stage, self.judged.lanes, self.judged.labelled
        self.path, self.limit_km_h = path, limit_km_h
        self.lanelets = {lanelet["id"]: lanelet for lanelet in self.map["lanelets"]}
        self.middles = {number: _middle(lanelet) for number, lanelet in self.lanelets.items()}
        self.grounds = {number: _ground(lanelet) for number, lanelet in self.lanelets.items()}

    def complaints(self):
        yield from self._said()
        yield from self._off_their_place()
        yield from self._bounds()
        yield from self._lanes_of_aisles()
        yield from self._turns()
        yield from self._heights()
        yield from self._stalls()
        yield from self._spaces()
        yield from self._before_stalls()
        yield from self._lots()
        yield from self._reached_otherwise()
        yield from self._rules()

    def _said(self):
        yield from self.map["errors"]
        yield from self.map["faults"]
        if self.map["close"]:
            yield f"{len(self.map['close'])} points lie within {APART_M} m of another, as {self.map['close'][:2]}"
        header, said = _header(self.path)
        facts = self.stage.GetDefaultPrim().GetCustomData()
        if header.get("generator") != f"garage2usd {facts['version']}" or said["map_version"] != facts["version"]:
            yield "the header does not say what made it"
        if said["seed"] != str(facts["seed"]):
            yield f"the header says seed {said['seed']}"
        for number, lanelet in self.lanelets.items():
            if not lanelet["passable"] or not lanelet["one_way"] or lanelet["beside"]:
                yield f"lanelet {number} is closed, driven in both directions or left for another one beside it"
            if abs(float(lanelet["limit"].split()[0]) - self.limit_km_h) > 1e-6:
                yield f"lanelet {number} has the speed limit {lanelet['limit']}"

    def _off_their_place(self):
        points = np.array(self.map["points"])
        off = np.abs(points[:, :2] - points[:, 3:]).max()
        if off > NEAR_M:
            yield f"a point lies {off:.4f} m from where its local_x and local_y say"

    def _bounds(self):
        for number, lanelet in self.lanelets.items():
            if not self.grounds[number].is_valid:
                yield f"lanelet {number} crosses itself"
            straight = [side for side in ("left", "right") if self._is_straight_in_a_bend(number, side)]
            if len(straight) > 1:
                yield f"both bounds of lanelet {number} cut a bend"
            # the inner one of a bend that is tighter than its lane is wide is straight, or all but has a corner
            for side in {"left", "right"} - set(straight):
                following = [n for n in lanelet["following"] if not self._is_straight_in_a_bend(n, side)]
                for onward in [self.lanelets[n][side]["places"][1:] for n in following] or [[]]:
                    sags, shorter_m = _sags([*lanelet[side]["places"], *onward])
                    # no point lies 5 cm from two others that are less than 10 cm apart
                    sag_m = sags[sags > np.where(shorter_m > 2 * APART_M, SAG_M, TIGHT_M)]
                    if len(sag_m):
                        yield f"the {side} bound of lanelet {number} cuts a bend by {sag_m.max():.4f} m"
            middle = self.middles[number]
            x, y = middle.interpolate(0.5, normalized=True).coords[0]
            (x0, y0), (x1, y1) = (middle.interpolate(share, normalized=True).coords[0] for share in (0.45, 0.55))
            left = shapely.LineString(np.array(lanelet["left"]["places"])[:, :2])
            across = shapely.shortest_line(shapely.Point(x, y), left).coords
            if (x1 - x0) * (across[1][1] - y) - (y1 - y0) * (across[1][0] - x) <= 0:
                yield f"the left bound of lanelet {number} lies to its right"

    def _is_straight_in_a_bend(self, number, side):
        if abs(_turned_rad(self.middles[number])) <= STRAIGHT_RAD:
            return False
        bound = self.lanelets[number][side]["places"]
        return _sags(bound)[0].max(initial=0.0) < 1e-6 or self._is_centre_of_bend(number, side)

    def _is_centre_of_bend(self, number, side):
        """Whether a bound has one corner, around which the other bound turns as far from it as the lane is wide."""
        other = "left" if side == "right" else "right"
        bound, far = (np.array(self.lanelets[number][which]["places"])[:, :2] for which in (side, other))
        turned = _turns_rad(bound)
        if len(turned) == 0 or turned.max() < 0.95 * turned.sum():
            return False
        widths = [np.linalg.norm(bound[end] - far[end]) for end in (0, -1)]
        off = np.linalg.norm(far - bound[1 + turned.argmax()], axis=1)
        return min(widths) - TIGHT_M <= off.min() and off.max() <= max(widths) + TIGHT_M

    def _lanes_of_aisles(self):
        """In squares driven straight through: in each direction one on its right half, with one line between them."""
        beside = nx.Graph(self.lanes.graph())
        for start, end, width, one_way in self.lanes.edges:
            for node, other in ((start, end), (end, start)):
                away = self.lanes.middles[list(beside[node])] - self.lanes.middles[node]
                is_through = len(away) == 2 and np.abs(away[0] @ away[1] + np.prod(np.hypot(*away.T))) < NEAR_M
                if not one_way and self.lanes.kinds[node] not in PORTALS and (len(away) == 1 or is_through):
                    yield from self._lanes_of_aisle(node, other, width)

    def _lanes_of_aisle(self, node, other, width):
        middle, beyond = self.lanes.middles[[node, other]] * (1, -1)
        along = (beyond - middle) / np.linalg.norm(beyond - middle)
        between = []
        for sign in (1, -1):
            place = shapely.Point(middle + sign * width / 4 * np.array([along[1], -along[0]]))
            own = [number for number, ground in self.grounds.items() if ground.contains(place)]
            if len(own) != 1 or self.middles[own[0]].distance(place) > NEAR_M:
                yield f"{len(own)} lanelets on one half of square {node}"
                continue
            line = self.middles[own[0]]
            ahead = np.subtract(line.coords[-1], line.coords[0])
            if sign * (ahead @ along) < (1 - 1e-6) * np.linalg.norm(ahead):
                yield f"lanelet {own[0]} on square {node} does not lead on to the right of its aisle"
            between.append(self.lanelets[own[0]]["left"])
        if len({line["id"] for line in between}) != 1:
            yield f"the lanelets of square {node} have no line between them in common"
        for line in between:
            painted = [line["tags"].get(tag) for tag in ("type", "subtype", "lane_change")]
            if painted != ["line_thin", "dashed", "no"]:
                yield f"the line between the lanelets of square {node} is {painted}"

    def _turns(self):
        """Those that branch off say where they lead, and no others say so."""
        degree = nx.Graph(self.lanes.graph()).degree
        portals = {number for number, kind in enumerate(self.lanes.kinds) if kind in PORTALS}
        junctions = [number for number, beside in degree if beside + (number in portals) > 2]
        squares = shapely.union_all([self._square(number) for number in junctions])
        for number, lanelet in self.lanelets.items():
            inside_m = self.middles[number].intersection(squares).length
            is_inside = inside_m > max(LEAST_IN_SQUARE_M, self.middles[number].length - LEAST_IN_SQUARE_M)
            turned = _turned_rad(self.middles[number])
            expected = "straight" if abs(turned) < STRAIGHT_RAD else "left" if turned > 0 else "right"
            said = _turn(lanelet)
            if is_inside != (said is not None) or (is_inside and said != expected):
                yield f"lanelet {number} turns {expected} and says {said}"

    def _heights(self):
        floors = [thing["path"] for thing in self.labelled if thing["class"] in {"floor", "ramp"}]
        rays = Rays(self.stage, {path: number for number, path in enumerate(floors, start=1)})
        places = []
        for lanelet in self.lanelets.values():
            left, right = (np.array(lanelet[side]["places"]) for side in ("left", "right"))
            inner = (left + right)[1:-1] / 2 if len(left) == len(right) else np.zeros((0, 3))
            ends = np.array([left[0] + right[0], left[-1] + right[-1]]) / 2
            towards = (ends[::-1] - ends) / np.linalg.norm(ends[1] - ends[0])
            # not on the edge of the floor, where lanes end
            places += [*inner, *(ends + NEAR_M * towards)]
        places = np.array(places)
        above = np.stack([places[:, 0], places[:, 2] + 1, -places[:, 1]], axis=1)
        owner, place, _ = rays.cast(above, np.tile((0.0, -1.0, 0.0), (len(places), 1)))
        off = np.abs(np.where(owner > 0, place[:, 1], np.inf) - places[:, 2])
        if off.max() > GROOVE_M:
            yield f"{(off > GROOVE_M).sum()} places of lanelets are off the floor, by up to {off.max():.3f} m"
        lines = shapely.union_all(list(self.middles.values()))
        for thing in self.labelled:
            if thing["class"] == "ramp":
                x0, y0, x1, y1 = _outline(thing).bounds
                if lines.intersection(_outline(thing)).length < 0.9 * max(x1 - x0, y1 - y0):
                    yield f"no lanelet leads over {thing['path']}"

    def _parking(self):
        return {name: stall for name, stall in self.lanes.stalls.items() if stall["use"] in PARKED_IN}

    def _stalls(self):
        taken, parking = self.judged.taken, self._parking()
        areas = [area for area in self.map["areas"] if area["tags"]["subtype"] == "parking"]
        hatched = [one for one in self.map["polygons"] if one["tags"]["type"] == "hatched_road_markings"]
        for found, expected in ((areas, parking), (hatched, self.lanes.stalls.keys() - parking.keys())):
            if sorted(one["tags"]["name"] for one in found) != sorted(expected):
                yield f"{len(found)} of {len(expected)} stalls"
        for area in (*areas, *hatched):
            tags, places = area["tags"], np.array(area["places"])
            stall = self.lanes.stalls[tags["name"]]
            corners = stall["corners"] * (1, -1)
            apart = np.linalg.norm(places[:, None, :2] - corners, axis=2)
            if len(places) != 4 or apart.min(axis=0).max() > NEAR_M or np.abs(places[:, 2]).max() > NEAR_M:
                yield f"{tags['name']} has corners elsewhere"
            elif abs(shapely.Polygon(places).area - shapely.Polygon(corners).area) > 0.01:
                yield f"{tags['name']} has its corners in another order"
            if (tags["use"], tags["ref"]) != (stall["use"], stall["number"]):
                yield f"{tags['name']} is said to be {tags['ref']} for {tags['use']}"
            if (tags["occupied"] == "yes") != (tags["name"] in taken):
                yield f"{tags['name']} is said to be occupied: {tags['occupied']}"

    def _spaces(self):
        """Autoware's: from the middle of the mouth to that of the rear, with a width."""
        parking = self._parking()
        lines = [line for line in self.map["lines"] if line["tags"].get("type") == "parking_space"]
        if sorted(line["tags"]["name"] for line in lines) != sorted(parking):
            yield f"{len(lines)} of {len(parking)} parking spaces"
        for line in lines:
            corners = self.lanes.stalls[line["tags"]["name"]]["corners"] * (1, -1)
            mouth, side = corners[1] - corners[0], corners[2] - corners[1]
            if np.linalg.norm(mouth) > np.linalg.norm(side) and abs(mouth @ side) < NEAR_M:
                corners, mouth, side = np.roll(corners, -1, axis=0), side, mouth  # parallel: along the car
            ends = np.array([corners[:2].mean(axis=0), corners[2:].mean(axis=0)])
            between = abs(mouth[0] * side[1] - mouth[1] * side[0]) / np.linalg.norm(side)
            wide = float(line["tags"]["width"]) - between
            if max(np.abs(np.array(line["places"])[:, :2] - ends).max(), abs(wide)) > NEAR_M:
                yield f"the parking space {line['tags']['name']} lies elsewhere or is of another width"

    def _before_stalls(self):
        """Nothing lies open between a stall, the ground before it, and a lane of the square that it opens onto."""
        holders = defaultdict(list)
        for area in self.map["areas"]:
            if area["tags"]["subtype"] == "parking_access":
                for point in set(area["points"]):
                    holders[point].append(area)
        on = self._lanelets_on_nodes()
        for area in self.map["areas"]:
            if area["tags"]["subtype"] != "parking":
                continue
            stall = self.lanes.stalls[area["tags"]["name"]]
            lanes = shapely.union_all([self.grounds[number] for number in on[stall["access"]]])
            mouth = shapely.LineString(stall["corners"][:2] * (1, -1))
            counts = defaultdict(int)
            for point in set(area["points"]):
                for access in holders[point]:
                    counts[id(access)] += 1
            accesses = [access for point in area["points"] for access in holders[point] if counts[id(access)] > 1]
            grounds = [shapely.Polygon([place[:2] for place in access["places"]]) for access in accesses]
            between = shapely.union_all([lanes, *grounds]).buffer(NEAR_M)
            gap = mouth.difference(between.buffer(NEAR_M)).length
            touching = between.intersection(mouth.buffer(NEAR_M))
            if gap > NEAR_M or not any(
                part.intersects(lanes) and part.intersects(touching) for part in shapely.get_parts(between)
            ):
                yield f"{area['tags']['name']} has a gap between its mouth and the lane"
            if grounds and min(ground.distance(lanes) for ground in grounds) > NEAR_M:
                yield f"the ground before {area['tags']['name']} does not reach the lane"

    def _lots(self):
        lots = [
            shapely.Polygon([place[:2] for place in one["places"]])
            for one in self.map["polygons"]
            if one["tags"]["type"] == "parking_lot"
        ]
        if not all(lot.is_valid for lot in lots):
            yield "a parking lot crosses itself"
        wide = [lot.buffer(NEAR_M) for lot in lots]
        on = self._lanelets_on_nodes()
        for name, stall in self._parking().items():
            ground = shapely.Polygon(stall["corners"] * (1, -1))
            own = [lot for lot, around in zip(lots, wide, strict=True) if around.contains(ground)]
            if not own:
                yield f"{name} is in no parking lot"
            elif not any(own[0].intersection(self.grounds[number]).area > 1.0 for number in on[stall["access"]]):
                yield f"the parking lot of {name} does not reach its lane"

    def _square(self, number):
        middle, half = self.lanes.middles[number] * (1, -1), self.lanes.widths[number] / 2
        return shapely.box(*(middle - half), *(middle + half))

    def _lanelets_on_nodes(self):
        """Numbers of the lanelets that cross each square."""
        tree = shapely.STRtree(list(self.middles.values()))
        numbers = list(self.middles)
        on = {}
        for node in range(len(self.lanes.kinds)):
            square = self._square(node)
            near = [numbers[index] for index in tree.query(square, predicate="intersects")]
            on[node] = [one for one in near if self.middles[one].intersection(square).length > LEAST_IN_SQUARE_M]
        return on

    def _reached_otherwise(self):
        on = self._lanelets_on_nodes()
        asked = {stall["access"] for stall in self._parking().values()}
        portals = {number: kind for number, kind in enumerate(self.lanes.kinds) if kind in PORTALS}
        asked |= portals.keys()
        driven = self.lanes.graph()
        reaches = {number: set(lanelet["reaches"]) for number, lanelet in self.lanelets.items()}
        beyond = {
            number: set().union(*(reaches[other] for other in lanelet["following"]))
            for number, lanelet in self.lanelets.items()
        }
        for start in sorted(asked):
            expected = nx.descendants(driven, start) & asked - {start}
            after = set().union(*(beyond[number] for number in on[start]))
            found = {node for node in asked - {start} if after & set(on[node]) or self._is_ahead(on, start, node)}
            if found != expected:
                yield f"from node {start} {sorted(found ^ expected)[:6]} are reached in one of stage and map only"
        entered = set().union(
            *(beyond[one] | {one} for node in portals if portals[node] == "entrance" for one in on[node])
        )
        leaves = {one for node in portals if portals[node] == "exit" for one in on[node]}
        for name, stall in self._parking().items():
            own = set(on[stall["access"]])
            if not own & entered or not any((beyond[one] | {one}) & leaves for one in own):
                yield f"{name} is not reached from an entrance, or no exit from it"

    def _is_ahead(self, on, start, end):
        """Whether a lane leads from one square to another without ending between them."""
        places = [shapely.Point(self.lanes.middles[node] * (1, -1)) for node in (start, end)]
        both = set(on[start]) & set(on[end])
        return any(self.middles[number].project(places[0]) < self.middles[number].project(places[1]) for number in both)

    def _rules(self):
        """Lanes across which a gate or a bump lies have a line before it."""
        expected = {thing["path"]: thing for thing in self.labelled if thing["class"] in SIGNS}
        named = defaultdict(set)
        for number, lanelet in self.lanelets.items():
            for rule in lanelet["rules"]:
                (thing,), (stop,) = rule["refers"], rule["stops"]
                name, middle = thing["tags"]["name"], self.middles[number]
                named[name].add(number)
                line, symbol = (shapely.LineString(np.array(one["places"])[:, :2]) for one in (stop, thing))
                ahead_m = middle.project(symbol.centroid) - middle.project(line.centroid)
                off_m = line.centroid.distance(symbol.centroid)
                if stop["tags"]["type"] != "stop_line" or ahead_m < 0 or not 0.7 < off_m < 2.5:
                    yield f"the line before {name} lies {off_m:.2f} m off, {ahead_m:.2f} m before it"
                if not line.intersects(middle):
                    yield f"the line before {name} does not lie across lanelet {number}"
                if name not in expected or rule["sign"] != SIGNS[expected[name]["class"]]:
                    yield f"{name} has the sign {rule['sign']}"
                elif not symbol.intersects(_outline(expected[name]).buffer(0.1)):
                    yield f"{name} lies elsewhere"
        for name, thing in expected.items():
            across = {number for number, line in self.middles.items() if line.crosses(_outline(thing))}
            if not named[name] or (thing["class"] == "speed_bump" and named[name] != across):
                yield f"lanelets {sorted(named[name])} have a rule for {name}, {sorted(across)} lead over it"


def _header(path):
    """Attributes of the root of a map and of its first element; of what follows only that it is sound XML."""
    found = {}

    def start(name, attributes):
        found[name] = attributes
        if len(found) == 2:
            parser.StartElementHandler = None

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    with path.open("rb") as file:
        parser.ParseFile(file)
    return found["osm"], found["MetaInfo"]


def _outline(thing):
    """What an object with a label covers, seen from above, at most."""
    (x0, _, z0), (x1, _, z1) = thing["min_m"], thing["max_m"]
    return shapely.box(x0, -z1, x1, -z0)


def _sags(places):
    """How far the arcs that corners of a polyline stand for lie off it at most, and the shorter side of each corner."""
    places = np.array(places)[:, :2]
    lengths = np.linalg.norm(np.diff(places, axis=0), axis=1)
    shorter = np.minimum(lengths[1:], lengths[:-1])
    return shorter * np.tan(_turns_rad(places) / 4) / 2, shorter


def _turns_rad(places):
    """By how much a polyline turns at each of its corners, to either side."""
    return np.abs([np.arctan2(a[0] * b[1] - a[1] * b[0], a @ b) for a, b in pairwise(np.diff(places, axis=0))])


def _turn(lanelet):
    return lanelet["tags"].get("turn_direction")


def _middle(lanelet):
    """A lane's middle line, half way between equal shares of its bounds."""
    left, right = (shapely.LineString(np.array(lanelet[side]["places"])[:, :2]) for side in ("left", "right"))
    shares = np.linspace(0, 1, 41)
    return shapely.LineString(
        [
            np.mean([bound.interpolate(share, normalized=True).coords[0] for bound in (left, right)], axis=0)
            for share in shares
        ]
    )


def _ground(lanelet):
    left, right = (np.array(lanelet[side]["places"])[:, :2] for side in ("left", "right"))
    return shapely.Polygon(np.concatenate([left, right[::-1]]))


def _turned_rad(line):
    points = np.array(line.coords)
    (a, b), (c, d) = points[1] - points[0], points[-1] - points[-2]
    return np.arctan2(a * d - b * c, a * c + b * d)
