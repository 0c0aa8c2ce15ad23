"""Autoware's requirements on a Lanelet2 map, rebuilt from the descriptions of autoware_lanelet2_map_validator.

Each rule is named by the code of its issue. The map is read from its XML as Autoware's projector `Local` does: x and y
from `local_x` and `local_y`, z from `ele`. Relations between lanelets are those of Lanelet2's routing graph.
"""

import math
import xml.etree.ElementTree as ET
from collections import defaultdict
from functools import cached_property

import numpy as np
import shapely

WIDER = 0.05
"""Share of its width by which a lanelet is widened to find lanelets beside it."""
LEAST_OF_BOTH = 0.05
"""Intersection over union from which lanelets that conflict count as two ways over the same ground."""
COVERED = 0.99
TOUCHING = 0.01
"""Share of a lanelet's ground from which another one on it has to yield."""
SIGNAL_M = 15.0
SPEEDS_KM_H = 1.0, 80.0
LENGTHS_M = 1.0, 50.0
LONGEST_RULE_M = 200.0
NEAR_SPACE_M = 5.0
AREA_M2 = 1e-6
DIRECTIONS = {"left", "straight", "right"}


class Lanelet:
    def __init__(self, number, tags, left, right, rules):
        self.number, self.tags, self.left, self.right, self.rules = number, tags, left, right, rules


class AutowareMap:
    """A map as Autoware's loader reads it."""

    def __init__(self, path):
        root = ET.parse(path).getroot()
        tags = {id(one): {tag.get("k"): tag.get("v") for tag in one.iter("tag")} for one in root}
        self.nodes = {int(one.get("id")): tags[id(one)] for one in root.iter("node")}
        self.ways = {
            int(one.get("id")): ([int(nd.get("ref")) for nd in one.iter("nd")], tags[id(one)])
            for one in root.iter("way")
        }
        self.relations = {
            int(one.get("id")): (
                [(member.get("type"), int(member.get("ref")), member.get("role")) for member in one.iter("member")],
                tags[id(one)],
            )
            for one in root.iter("relation")
        }

    @cached_property
    def places(self):
        return {
            number: tuple(float(tags.get(key, "nan")) for key in ("local_x", "local_y", "ele"))
            for number, tags in self.nodes.items()
        }

    @cached_property
    def said(self):
        """What rules have said."""
        return {}

    def flat(self, points):
        return [self.places[point][:2] for point in points]

    @cached_property
    def lanelets(self):
        return {
            number: self._lanelet(number, members, tags)
            for number, (members, tags) in self.relations.items()
            if tags.get("type") == "lanelet"
        }

    def _lanelet(self, number, members, tags):
        (left,), (right,) = ([ref for _, ref, role in members if role == wanted] for wanted in ("left", "right"))
        rules = [ref for _, ref, role in members if role == "regulatory_element"]
        lanelet = Lanelet(number, tags, left, right, rules)
        one, other = self.ways[left][0], self.ways[right][0]
        # as Lanelet2 aligns them: each bound is turned until the middle of the other one lies on its side
        if self._side(one, other) > 0:
            one = one[::-1]
        if self._side(other, one) < 0:
            other = other[::-1]
        lanelet.bounds = one, other
        lanelet.ground = shapely.Polygon(self.flat([*one, *reversed(other)]))
        return lanelet

    def _side(self, line, other):
        """Positive if the middle of another line lies to the left of the nearest part of a line."""
        places = np.array(self.flat(other))
        middle = places[len(places) // 2] if len(places) > 2 else places.mean(axis=0)
        points = np.array(self.flat(line))
        steps = shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1))
        start, end = shapely.get_coordinates(steps[shapely.distance(steps, shapely.Point(middle)).argmin()])
        along, away = end - start, middle - start
        return along[0] * away[1] - along[1] * away[0]

    @cached_property
    def centres(self):
        found = {}
        for number, lanelet in self.lanelets.items():
            lines = [shapely.LineString(self.flat(points)) for points in lanelet.bounds]
            runs = np.linspace(0, 1, 41)
            pair = [
                shapely.get_coordinates(shapely.line_interpolate_point(line, runs, normalized=True)) for line in lines
            ]
            found[number] = shapely.LineString((pair[0] + pair[1]) / 2)
        return found

    @cached_property
    def following(self):
        starts = defaultdict(list)
        for number, lanelet in self.lanelets.items():
            starts[tuple(points[0] for points in lanelet.bounds)].append(number)
        return {
            number: starts[tuple(points[-1] for points in lanelet.bounds)] for number, lanelet in self.lanelets.items()
        }

    @cached_property
    def before(self):
        found = {number: [] for number in self.lanelets}
        for number, onward in self.following.items():
            for other in onward:
                found[other].append(number)
        return found

    def are_joined(self, one, other):
        """Whether one lanelet follows the other, or they lie side by side in the same direction."""
        if other in self.following[one] or one in self.following[other]:
            return True
        first, second = self.lanelets[one], self.lanelets[other]
        return first.bounds[0] == second.bounds[1] or first.bounds[1] == second.bounds[0]

    @cached_property
    def conflicting(self):
        """Lanelets that lie over each other without being joined, with the share of the first one's ground."""
        numbers = list(self.lanelets)
        grounds = np.array([shapely.make_valid(self.lanelets[number].ground) for number in numbers])
        one, other = shapely.STRtree(grounds).query(grounds, predicate="intersects")
        shared = shapely.area(shapely.intersection(grounds[one], grounds[other]))
        found = {number: {} for number in numbers}
        for first, second, area in zip(one.tolist(), other.tolist(), shared.tolist(), strict=True):
            a, b = numbers[first], numbers[second]
            if a != b and area > AREA_M2 and not self.are_joined(a, b):
                found[a][b] = area / grounds[first].area
        return found

    def typed(self, kind):
        return {number: way for number, way in self.ways.items() if way[1].get("type") == kind}

    def rules(self, subtype):
        return {
            number: (members, tags)
            for number, (members, tags) in self.relations.items()
            if tags.get("type") == "regulatory_element" and tags.get("subtype") == subtype
        }

    def referrers(self, rule):
        return [lanelet for lanelet in self.lanelets.values() if rule in lanelet.rules]

    def polygon(self, way):
        return shapely.Polygon(self.flat(self.ways[way][0]))


RULES = {}


def rule(*codes):
    def add(function):
        for code in codes:
            RULES[code] = function
        return function

    return add


def complaints(found, code):
    """What a rule says of a map, for one of its codes."""
    if RULES[code] not in found.said:
        found.said[RULES[code]] = [*RULES[code](found)]
    return [f"{number}: {words}" for own, number, words in found.said[RULES[code]] if own == code]


def _roads(found):
    return [lanelet for lanelet in found.lanelets.values() if lanelet.tags.get("subtype") == "road"]


@rule("Lane.RoadLaneletAttribute-001", "Lane.RoadLaneletAttribute-002")
def _attributes(found):
    for lanelet in _roads(found):
        if lanelet.tags.get("location") not in {"urban", "private"}:
            yield "Lane.RoadLaneletAttribute-001", lanelet.number, lanelet.tags.get("location")
        if lanelet.tags.get("one_way") != "yes":
            yield "Lane.RoadLaneletAttribute-002", lanelet.number, lanelet.tags.get("one_way")


@rule("Lane.LaneletGeometry-001")
def _shared_points(found):
    for lanelet in found.lanelets.values():
        if set(lanelet.bounds[0]) & set(lanelet.bounds[1]):
            yield "Lane.LaneletGeometry-001", lanelet.number, "both bounds have a point"


@rule("Lane.SpeedLimitValidity-001", "Lane.SpeedLimitValidity-002")
def _speeds(found):
    for lanelet in _roads(found):
        said = lanelet.tags.get("speed_limit", "")
        try:
            limit = float(said)
        except ValueError:
            limit = 0.0
        if limit <= 0:
            yield "Lane.SpeedLimitValidity-001", lanelet.number, said
        elif not SPEEDS_KM_H[0] <= limit <= SPEEDS_KM_H[1]:
            yield "Lane.SpeedLimitValidity-002", lanelet.number, said


@rule(
    "Lane.LocalCoordinatesDeclaration-001",
    "Lane.LocalCoordinatesDeclaration-002",
    "Lane.LocalCoordinatesDeclaration-003",
)
def _local(found):
    for number, tags in found.nodes.items():
        has = "local_x" in tags, "local_y" in tags
        if has != (True, True):
            code = {(False, False): 1, (True, False): 2, (False, True): 3}[has]
            yield f"Lane.LocalCoordinatesDeclaration-00{code}", number, has


@rule("Lane.LaneChangeAttribute-001", "Lane.LaneChangeAttribute-002")
def _lane_change(found):
    of = defaultdict(list)
    for lanelet in _roads(found):
        of[lanelet.left].append(("left", lanelet))
        of[lanelet.right].append(("right", lanelet))
    for way, sides in of.items():
        beside = {side for side, _ in sides} == {"left", "right"}
        said = found.ways[way][1].get("lane_change")
        if beside and said is None:
            yield "Lane.LaneChangeAttribute-001", way, "missing"
        if said not in {None, "yes", "no"}:
            yield "Lane.LaneChangeAttribute-002", way, said


@rule(
    "Lane.LateralSubtypeConnection-001",
    "Lane.LongitudinalSubtypeConnection-001",
    "Lane.LongitudinalSubtypeConnection-002",
)
def _subtypes(found):
    for number, lanelet in found.lanelets.items():
        own = lanelet.tags.get("subtype")
        onward = [found.lanelets[other].tags.get("subtype") for other in found.following[number]]
        if own in {"crosswalk", "walkway"} and onward:
            yield "Lane.LongitudinalSubtypeConnection-001", number, own
        if any(other != own for other in onward):
            yield "Lane.LongitudinalSubtypeConnection-002", number, onward
    for one, lanelet in found.lanelets.items():
        for other in found.lanelets.values():
            kinds = {lanelet.tags.get("subtype"), other.tags.get("subtype")}
            if lanelet.bounds[1] == other.bounds[0] and not kinds <= {"road", "road_shoulder"}:
                yield "Lane.LateralSubtypeConnection-001", one, kinds


@rule("Lane.BorderSharing-001", "Lane.BorderSharing-002")
def _borders(found):
    numbers = list(found.lanelets)
    grounds = np.array([shapely.make_valid(found.lanelets[number].ground) for number in numbers])
    tree, suspicious = shapely.STRtree(grounds), set()
    lines = {
        number: [shapely.LineString(found.flat(points)) for points in found.lanelets[number].bounds]
        for number in numbers
    }
    for number in numbers:
        wide = shapely.make_valid(_widened(found, found.lanelets[number]))
        shapely.prepare(wide)
        for index in tree.query(shapely.box(*wide.bounds)).tolist():
            other = numbers[index]
            if other == number or found.are_joined(number, other):
                continue
            if other in found.conflicting[number]:
                shared = wide.intersection(grounds[index]).area
                if shared / (wide.area + grounds[index].area - shared) > LEAST_OF_BOTH:
                    continue
            first, second = found.lanelets[number].bounds, found.lanelets[other].bounds
            if first[1] == second[1][::-1] or first[0] == second[0][::-1]:
                continue
            if any(wide.covers(line) for line in lines[other]):
                suspicious.add((number, other))
    for one, other in suspicious:
        if (other, one) in suspicious:
            yield "Lane.BorderSharing-001", one, f"beside {other}"
        else:
            yield "Lane.BorderSharing-002", one, f"along {other}"


def _widened(found, lanelet):
    left, right = (np.array(found.flat(points)) for points in lanelet.bounds)
    by_m = (np.linalg.norm(left[0] - right[0]) + np.linalg.norm(left[-1] - right[-1])) / 2 * WIDER
    return shapely.Polygon([*_aside(left, by_m), *_aside(right[::-1], by_m)])


def _aside(line, by_m):
    """A line moved to its left, and longer at both ends."""
    steps = np.diff(line, axis=0)
    steps /= np.linalg.norm(steps, axis=1)[:, None]
    along = np.concatenate([steps[:1], (steps[:-1] + steps[1:]) / 2, steps[-1:]])
    along /= np.maximum(np.linalg.norm(along, axis=1), 1e-9)[:, None]
    moved = line + by_m * np.stack([-along[:, 1], along[:, 0]], axis=1)
    moved[0] -= by_m * steps[0]
    moved[-1] += by_m * steps[-1]
    return moved


def _areas(found):
    return found.typed("intersection_area")


@rule("Intersection.IntersectionAreaDanglingReference-001")
def _dangling(found):
    for lanelet in found.lanelets.values():
        area = lanelet.tags.get("intersection_area")
        if area is not None and int(area) not in _areas(found):
            yield "Intersection.IntersectionAreaDanglingReference-001", lanelet.number, area


@rule(*(f"Intersection.IntersectionAreaTagging-00{number}" for number in range(1, 5)))
def _tagging(found):
    code = "Intersection.IntersectionAreaTagging-00"
    for way in _areas(found):
        area = shapely.make_valid(found.polygon(way))
        for lanelet in _roads(found):
            ground = shapely.make_valid(lanelet.ground)
            if ground.intersection(area).area / ground.area >= COVERED:
                tagged = lanelet.tags.get("intersection_area")
                if tagged is None:
                    yield f"{code}1", lanelet.number, way
                elif int(tagged) != way:
                    yield f"{code}2", lanelet.number, f"{tagged} instead of {way}"
    for lanelet in found.lanelets.values():
        tagged = lanelet.tags.get("intersection_area")
        if "turn_direction" in lanelet.tags and tagged is None:
            yield f"{code}4", lanelet.number, lanelet.tags["turn_direction"]
        if tagged is not None and int(tagged) in _areas(found):
            ground, area = (shapely.make_valid(one) for one in (lanelet.ground, found.polygon(int(tagged))))
            share = ground.intersection(area).area / ground.area
            if share < COVERED:
                yield f"{code}3", lanelet.number, f"{share:.3f} of it in {tagged}"


@rule("Intersection.IntersectionAreaValidity-001")
def _valid_areas(found):
    for way in _areas(found):
        polygon = found.polygon(way)
        if not polygon.is_valid:
            yield "Intersection.IntersectionAreaValidity-001", way, shapely.is_valid_reason(polygon)


@rule("Intersection.IntersectionAreaSegmentType-001")
def _segments(found):
    allowed = {point for points, _ in found.typed("road_border").values() for point in points}
    for lanelet in _roads(found):
        allowed |= {points[end] for points in lanelet.bounds for end in (0, -1)}
    for way, (points, _) in _areas(found).items():
        if others := set(points) - allowed:
            yield "Intersection.IntersectionAreaSegmentType-001", way, sorted(others)


@rule("Intersection.TurnDirectionTagging-001", "Intersection.TurnDirectionTagging-002")
def _directions(found):
    for way in _areas(found):
        area = found.polygon(way)
        for lanelet in _roads(found):
            points = [point for bound in lanelet.bounds for point in found.flat(bound)]
            said = lanelet.tags.get("turn_direction")
            if shapely.covers(shapely.make_valid(area), shapely.points(points)).all() and said is None:
                yield "Intersection.TurnDirectionTagging-001", lanelet.number, way
    for lanelet in _roads(found):
        if lanelet.tags.get("turn_direction") not in {None, *DIRECTIONS}:
            yield "Intersection.TurnDirectionTagging-002", lanelet.number, lanelet.tags["turn_direction"]


@rule("Intersection.IntersectionLaneletBorderType-001")
def _border_types(found):
    for lanelet in found.lanelets.values():
        kinds = {found.ways[way][1].get("type") for way in (lanelet.left, lanelet.right)}
        if "intersection_area" in lanelet.tags and not kinds <= {"virtual", "road_border"}:
            yield "Intersection.IntersectionLaneletBorderType-001", lanelet.number, kinds


@rule("Intersection.LaneletDivision-001")
def _division(found):
    for number, lanelet in found.lanelets.items():
        area = lanelet.tags.get("intersection_area")
        for other in found.following[number]:
            if area is not None and found.lanelets[other].tags.get("intersection_area") == area:
                yield "Intersection.LaneletDivision-001", number, other


@rule(*(f"Intersection.RightOfWayWithoutTrafficLights-00{number}" for number in range(1, 6)))
def _right_of_way(found):
    code = "Intersection.RightOfWayWithoutTrafficLights-00"
    has_rule = defaultdict(bool)
    rules = found.rules("right_of_way")
    for number, lanelet in found.lanelets.items():
        own = [one for one in lanelet.rules if one in rules]
        if area := lanelet.tags.get("intersection_area"):
            # Lanelet2 reads no rule to which nobody has to yield
            has_rule[area] |= any(role == "yield" for one in own for _, _, role in rules[one][0])
        for one in own:
            members, _ = rules[one]
            first = [ref for _, ref, role in members if role == "right_of_way"]
            if len(first) != 1:
                yield f"{code}1", one, first
                continue
            if first != [number]:
                yield f"{code}2", one, first
                continue
            yields = {ref for _, ref, role in members if role == "yield"}
            wanted = {
                other
                for other, share in found.conflicting[number].items()
                if share >= TOUCHING and not set(found.before[number]) & set(found.before[other])
            }
            for missing in wanted - yields:
                yield f"{code}3", one, missing
            # where lanes only part, those of the same lane are all that a rule can name
            for more in yields - (wanted or found.conflicting[number].keys()):
                yield f"{code}4", one, more
    for area, has_any in has_rule.items():
        if not has_any:
            yield f"{code}5", area, "no right of way"


@rule("Intersection.TurnSignalDistanceOverlap-001")
def _signals(found):
    for number, lanelet in found.lanelets.items():
        opposite = {"left": "right", "right": "left"}.get(lanelet.tags.get("turn_direction"))
        if opposite is None:
            continue
        reach = float(lanelet.tags.get("turn_signal_distance", SIGNAL_M))
        queue, seen = [(other, found.centres[other].length) for other in found.before[number]], set()
        while queue:
            other, length = queue.pop(0)
            if other in seen or length > reach:
                continue
            seen.add(other)
            if found.lanelets[other].tags.get("turn_direction") == opposite:
                yield "Intersection.TurnSignalDistanceOverlap-001", number, other
            queue += [(more, length + found.centres[more].length) for more in found.before[other]]


@rule("StopLine.MissingRegulatoryElements-001")
def _stop_lines(found):
    used = {
        ref
        for members, tags in found.relations.values()
        if tags.get("type") == "regulatory_element"
        for kind, ref, role in members
        if kind == "way" and role in {"ref_line", "refers"}
    }
    for way in found.typed("stop_line").keys() - used:
        yield "StopLine.MissingRegulatoryElements-001", way, "no rule refers to it"


@rule(*(f"StopLine.RegulatoryElementDetailsForTrafficSigns-00{number}" for number in range(1, 6)))
def _signs(found):
    code = "StopLine.RegulatoryElementDetailsForTrafficSigns-00"
    for number, (members, _) in found.rules("traffic_sign").items():
        refers, lines = ([ref for _, ref, role in members if role == wanted] for wanted in ("refers", "ref_line"))
        if not refers:
            yield f"{code}1", number, "no refers"
        for way in refers:
            tags = found.ways[way][1]
            if (tags.get("type"), tags.get("subtype")) != ("traffic_sign", "stop_sign"):
                yield f"{code}2", way, tags
        if not lines:
            yield f"{code}3", number, "no ref_line"
        for way in lines:
            if found.ways[way][1].get("subtype") != "stop_line":
                yield f"{code}4", way, found.ways[way][1]
        points = [point for way in (*refers, *lines) for point in found.ways[way][0]]
        points += [point for lanelet in found.referrers(number) for bound in lanelet.bounds for point in bound]
        if points and np.hypot(*np.ptp(np.array(found.flat(points)), axis=0)) > LONGEST_RULE_M:
            yield f"{code}5", number, "its parts lie far from one another"


@rule(*(f"Area.BufferZoneValidity-00{number}" for number in (1,)))
def _buffer_zones(found):
    for way in found.typed("hatched_road_markings"):
        if not found.polygon(way).is_valid:
            yield "Area.BufferZoneValidity-001", way, "not valid"


# what Autoware's documents and its code ask for, without a code of the validator


@rule("Extension.Elevation")
def _elevation(found):
    for number, tags in found.nodes.items():
        if not math.isfinite(float(tags.get("ele", "nan"))):
            yield "Extension.Elevation", number, tags


@rule("Extension.TurnDirection")
def _conflicts(found):
    for number, others in found.conflicting.items():
        if max(others.values(), default=0.0) > TOUCHING and "turn_direction" not in found.lanelets[number].tags:
            yield "Extension.TurnDirection", number, others


@rule("Extension.SpeedBump")
def _bumps(found):
    rules = found.rules("speed_bump")
    referred = [ref for members, _ in rules.values() for _, ref, role in members if role == "refers"]
    for way, (_, tags) in found.typed("speed_bump").items():
        if referred.count(way) != 1 or tags.get("area") != "yes" or not float(tags.get("height", "0")) > 0:
            yield "Extension.SpeedBump", way, tags
    for number, (members, _) in rules.items():
        if len(members) != 1 or not found.referrers(number):
            yield "Extension.SpeedBump", number, members


@rule("Documents.LaneletLength")
def _lengths(found):
    for number, centre in found.centres.items():
        if not LENGTHS_M[0] <= centre.length <= LENGTHS_M[1]:
            yield "Documents.LaneletLength", number, f"{centre.length:.2f} m"


@rule("Documents.Connection")
def _connected(found):
    for number in found.lanelets:
        if not found.following[number] and not found.before[number]:
            yield "Documents.Connection", number, "joined to no other"


@rule("Parking.Space")
def _spaces(found):
    """A line with a width in one lot, and a lanelet within 5 m of its mouth, as Autoware's query wants."""
    lots = [found.polygon(way) for way in found.typed("parking_lot")]
    grounds = shapely.STRtree([shapely.make_valid(lanelet.ground) for lanelet in found.lanelets.values()])
    for way, (points, tags) in found.typed("parking_space").items():
        if len(points) != 2 or not float(tags.get("width", "0")) > 0 or not tags.get("subtype"):
            yield "Parking.Space", way, tags
            continue
        line = shapely.LineString(found.flat(points))
        if sum(lot.covers(line) for lot in lots) != 1:
            yield "Parking.Space", way, "not within one lot"
        if not len(grounds.query(shapely.Point(line.coords[0]), predicate="dwithin", distance=NEAR_SPACE_M)):
            yield "Parking.Space", way, "no lanelet before it"


@rule("Parking.Lot")
def _lots(found):
    if not found.typed("parking_lot") and found.typed("parking_space"):
        yield "Parking.Lot", 0, "no lots"
    for way, (_, tags) in found.typed("parking_lot").items():
        lot = found.polygon(way)
        if not lot.is_valid or tags.get("area") != "yes":
            yield "Parking.Lot", way, tags
        elif not any(lot.intersects(lanelet.ground) for lanelet in found.lanelets.values()):
            yield "Parking.Lot", way, "no lanelet on it"


@rule("Vocabulary")
def _vocabulary(found):
    """Things that this judge has no rules for, such as traffic lights and crosswalks, are not in the map."""
    for number, (_, tags) in found.relations.items():
        if tags.get("type") == "lanelet" and tags.get("subtype") != "road":
            yield "Vocabulary", number, tags
        if tags.get("type") == "regulatory_element" and tags["subtype"] not in {
            "traffic_sign",
            "speed_bump",
            "right_of_way",
        }:
            yield "Vocabulary", number, tags
    for number, (_, tags) in found.ways.items():
        if tags.get("type") in {
            "traffic_light",
            "light_bulbs",
            "crosswalk_polygon",
            "detection_area",
            "no_parking_area",
            "no_stopping_area",
            "bus_stop_area",
        }:
            yield "Vocabulary", number, tags


CODES = sorted(RULES)
