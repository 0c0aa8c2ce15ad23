"""Surveys as OpenDRIVE: parking spaces and columns beside roads, and the driving lanes of the roads."""
# Over 300 lines: an object beside a road has many forms, all of which end as corners.

import math
import re
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage import Point, StallUse
from garage2usd.survey.apollo_survey import is_apollo, read_apollo_survey
from garage2usd.survey.opendrive_floors import Floors, level_name
from garage2usd.survey.opendrive_junctions import Link, with_joined_lanes
from garage2usd.survey.opendrive_lanes import lanes_of_road, parking_lanes
from garage2usd.survey.opendrive_lines import RoadLine, cubics_of, road_line
from garage2usd.survey.paired_lanes import paired_lanes
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import Survey, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel, SurveyedRamp
from garage2usd.survey.text import MOST_M, number_of, portal_kind_of, positive_of, read_xml, refuse, size_of, use_of

Floats = NDArray[np.float64]

_MOST_REPEATS = 10_000
_ANGLE = 1e6
_BEYOND_M = 1.0
_WHOLE = 1e-6
_DEGREES = re.compile(r"\+(proj|lat_0|lon_0|x_0|y_0)=(\S+)")
_STALL_TYPES = {"parkingSpace", "parking"}
_STALL_NAMES = {"parkingspace", "parking space", "parking", ""}
_COLUMN_WORDS = ("column", "pillar")
_ALONG_M, _ACROSS_M = 6.0, 2.5
"""Length along the road of each stall of a parking lane without stalls of its own, parallel to it or across it."""
_LEAST_ALONG_M, _LEAST_ACROSS_M = 1.8, 4.2
"""Width of a parking lane from which on cars stand in it along the road, or across it."""


class _Pose(NamedTuple):
    """A place of an object beside a road: its sides if a repetition has them, and how it was moved and turned."""

    s_m: float
    t_m: float
    width_m: float | None
    length_m: float | None
    shift_s_m: float
    shift_t_m: float
    turned_rad: float


def read_opendrive_survey(path: Path) -> Survey | SurveyedBuilding:
    """Read a survey from an OpenDRIVE map.

    Parameters
    ----------
    path
        OpenDRIVE 1.4 to 1.8. Stalls are objects of the type ``parkingSpace``, or ``parking`` as in some maps, with
        outlines, repetitions or as boxes; objects named ``column`` or ``pillar`` are columns. The driving lanes of a
        road are one lane, two-way if they lead in both directions. The parking lanes of a map without stalls, as of
        CARLA's towns, are divided. Apollo's kind is read as well (`garage2usd.survey.apollo_survey`). The user data
        ``outline``, ``block``, ``entrance`` and ``exit`` of the header are those of `garage2usd.maps.opendrive`.
        Roads that lie a storey or more above others are levels, and those between them ramps.

    Raises
    ------
    ConfigError
        If the file is not OpenDRIVE; names the road and the object.
    """
    root = read_xml(path, "OpenDRIVE", "an OpenDRIVE map")
    if is_apollo(root):
        return read_apollo_survey(root, path.name)
    roads = _roads(root)
    lines = {key: road_line(road, f"{path.name}: road {key}") for key, road in roads.items()}
    heights = {
        key: cubics_of(road.findall("elevationProfile/elevation"), "s", f"{path.name}: road {key}, elevation")
        for key, road in roads.items()
    }
    floors = Floors.of([(heights[key], line.length_m) for key, line in lines.items()])
    of_floor = {height_m: SurveyParts() for height_m in floors.heights_m}
    ramps = []
    lanes = {key: tuple(lanes_of_road(road, lines[key], f"{path.name}: road {key}")) for key, road in roads.items()}
    for key, number, lane in with_joined_lanes(lanes, {key: _link(road) for key, road in roads.items()}):
        title = f"road {key}" if number == 0 else f"road {key}, part {number + 1}"
        points = _ground(lane.points)
        start_m, end_m = floors.joined(heights[key], lines[key].length_m)
        if start_m == end_m:
            of_floor[start_m].add_lane(title, points, lane.width_m, one_way=lane.one_way)
            continue
        if math.dist(lane.points[0], lines[key].beside(np.zeros(1), np.zeros(1))[0]) > lane.width_m:
            start_m, end_m = end_m, start_m  # the lane leads against its road
        names = level_name(start_m), level_name(end_m)
        ramps.append(SurveyedRamp(title, tuple(points), names, lane.width_m, one_way=lane.one_way))
    has_stalls = any(_is_stall(element) for road in roads.values() for element in road.findall("objects/object"))
    for key, road in roads.items():
        name, place, line = f"road {key}", f"{path.name}: road {key}", lines[key]
        for element in road.findall("objects/object"):
            height_m = floors.nearest(float(heights[key].at(np.array([_float_of(element.get("s", ""))]))[0]))
            _add_object(of_floor[height_m], element, line, name, place)
        if not has_stalls:
            height_m = floors.nearest(float(heights[key].at(np.array([line.length_m / 2]))[0]))
            _add_parking_lanes(of_floor[height_m], road, line, name, place)
    for parts in of_floor.values():
        parts.lanes = paired_lanes(parts.lanes)
    _add_told(list(of_floor.values()), root)
    surveys = {height_m: parts.survey(origin_deg=_origin(root)) for height_m, parts in of_floor.items()}
    if len(surveys) == 1:
        return surveys.popitem()[1]
    levels = (SurveyedLevel(level_name(height_m), survey, height_m, height_m) for height_m, survey in surveys.items())
    return SurveyedBuilding(tuple(levels), tuple(ramps))


def _roads(root: ET.Element) -> dict[str, ET.Element]:
    """Return the roads by their ids; by their places in the file where the id is missing or taken."""
    roads: dict[str, ET.Element] = {}
    for index, road in enumerate(root.findall("road")):
        key = road.get("id", str(index))
        roads[f"{key}, number {index}" if key in roads else key] = road
    return roads


def _link(road: ET.Element) -> Link:
    found = (road.find(f"link/{side}") for side in ("predecessor", "successor"))
    before, after = (
        None if each is None or each.get("elementType") != "road" else each.get("elementId") for each in found
    )
    return Link(road.get("junction", "-1") != "-1", (before, after))


def _add_told(levels: Sequence[SurveyParts], root: ET.Element) -> None:
    """Add the outlines, blocks and doors of levels, from above, that the user data tell as x y after x y.

    Their codes are such as ``outline U2``; without a level, the first one is meant.
    """
    for data in root.findall("header/userData"):
        code, _, level = data.get("code", "").partition(" ")
        number = int(level[1:]) if re.fullmatch(r"U[1-9]\d?", level) else 1
        kind = portal_kind_of(code)
        if number > len(levels):
            continue
        parts = levels[number - 1]
        if code not in {"outline", "block"} and kind is None:
            continue
        numbers = [_float_of(word) for word in data.get("value", "").split()]
        points = [(x, -y) for x, y in zip(numbers[::2], numbers[1::2], strict=False)]
        if not numbers or len(numbers) % 2 or not all(abs(number) <= MOST_M for number in numbers):
            parts.unread.append(Unplaced(code, "user data that are not pairs of metres"))
        elif code == "outline":
            parts.add_outline(code, points)
        elif kind is None:
            parts.add_solid(code, points)
        else:
            parts.add_portal(points[0], kind)


def _origin(root: ET.Element) -> tuple[float, float] | None:
    """Return latitude and longitude of (0, 0) of a transverse Mercator; None for other projections and for offsets."""
    if root.find("header/offset") is not None:
        return None
    facts = dict(_DEGREES.findall(root.findtext("header/geoReference", "")))
    if facts.get("proj") != "tmerc" or any(_float_of(facts.get(key, "0")) != 0 for key in ("x_0", "y_0")):
        return None
    latitude, longitude = (_float_of(facts.get(key, "")) for key in ("lat_0", "lon_0"))
    if not (abs(latitude) <= 90 and abs(longitude) <= 180):  # noqa: PLR2004 - of the earth
        return None
    return latitude, longitude


def _float_of(text: str) -> float:
    """Return the number that a text is, or NaN."""
    try:
        return float(text)
    except ValueError:
        return math.nan


def _add_object(parts: SurveyParts, element: ET.Element, line: RoadLine, road: str, road_place: str) -> None:
    """Add a parking space or a column, once for each repetition."""
    facts = {data.get("code", ""): data.get("value", "") for data in element.findall("userData")}
    words = f"{element.get('name', '')} {element.get('subtype', '')}".lower()
    space = element.find("parkingSpace")
    is_stall = _is_stall(element) or (element.get("type") == "none" and facts.get("use", "") in set(StallUse))
    is_column = not is_stall and any(word in words for word in _COLUMN_WORDS)
    if not is_stall and not is_column:
        return
    number = element.get("id", "without id")
    place = f"{road_place}, object {number}"
    name = element.get("name", "")
    title = f"{road}, object {number}" if name.lower() in _STALL_NAMES else name
    access = "" if space is None else space.get("access", "")
    poses = list(_poses(element, line, place))
    for turn, pose in enumerate(poses, 1):
        name = title if len(poses) == 1 else f"{title}, repetition {turn}"
        corners, mouth = _outline(element, line, pose, place)
        if not -_BEYOND_M <= pose.s_m <= line.length_m + _BEYOND_M:
            reason = f"s = {pose.s_m:g} is beyond the ends of its road of {line.length_m:g} m"
            parts.unread.append(Unplaced(name, reason))
        elif corners is None:
            parts.unread.append(Unplaced(name, "an object without outline, width and length"))
        elif is_column:
            parts.add_column(name, _ground(corners))
        else:
            mouth_at = None if mouth is None else _middle(corners, mouth)
            use = use_of([facts.get("use", ""), access])
            size, number = size_of([facts.get("size", "")]), facts.get("number", "")
            parts.add_stall(name, _ground(corners), mouth_at=mouth_at, use=use, size=size, number=number)
    if not poses:
        parts.unread.append(Unplaced(title, "an object that is repeated without distance, as one long body"))


def _is_stall(element: ET.Element) -> bool:
    return element.get("type") in _STALL_TYPES or element.find("parkingSpace") is not None


def _add_parking_lanes(parts: SurveyParts, road: ET.Element, line: RoadLine, name: str, place: str) -> None:
    """Divide the parking lanes of a road without stalls of its own: narrow ones lengthways, wide ones across."""
    for lane in parking_lanes(road, line, place):
        start_m, end_m, width_m = lane.wide_run(_LEAST_ALONG_M)
        pitch_m, kind = (_ALONG_M, "parallel") if width_m < _LEAST_ACROSS_M else (_ACROSS_M, "perpendicular")
        count = min(math.floor((end_m - start_m) / pitch_m + _WHOLE), _MOST_REPEATS)
        title = f"{name}, lane {lane.number} at {lane.start_m:.0f} m"
        if count < 1:
            parts.unread.append(Unplaced(title, "a parking lane too short or too narrow for a car"))
            continue
        parts.unread.append(Unplaced(title, f"a parking lane without stalls; {count} {kind} ones are laid along it"))
        s_m = start_m + pitch_m * np.arange(count + 1)
        inner, outer = (line.beside(s_m, t_m) for t_m in lane.borders_at(s_m))
        for stall in range(count):
            corners = np.array([inner[stall], inner[stall + 1], outer[stall + 1], outer[stall]])
            parts.add_stall(f"{title}, stall {stall + 1}", _ground(corners), mouth_at=_middle(corners, 0))


def _poses(element: ET.Element, line: RoadLine, place: str) -> Iterator[_Pose]:
    """Yield the place of an object, or those of its repetitions instead."""
    s_m = number_of(element.get("s"), f"{place}, s")
    t_m = number_of(element.get("t", 0), f"{place}, t")
    repeats = element.findall("repeat")
    if not repeats:
        yield _Pose(s_m, t_m, None, None, 0.0, 0.0, 0.0)
    for repeat in repeats:
        here = f"{place}, repeat"
        start_m, length_m, step_m = (
            number_of(repeat.get(key), f"{here}, {key}") for key in ("s", "length", "distance")
        )
        if step_m < _WHOLE:
            continue
        count = math.floor(max(length_m, 0.0) / step_m + _WHOLE) + 1
        if count > _MOST_REPEATS:
            refuse(f"{here}, length", length_m, f"at most {_MOST_REPEATS} repetitions")
        ends = {}
        for key, usual in (("t", t_m), ("width", None), ("length", None)):
            texts = [repeat.get(f"{key}Start"), repeat.get(f"{key}End")]
            numbers = [None if text is None else number_of(text, f"{here}, {key}Start") for text in texts]
            start = usual if numbers[0] is None else numbers[0]
            ends[key] = start, start if numbers[1] is None else numbers[1]
        # as esmini does, objects are turned with the line along which they are repeated
        (first_t, last_t), run_m = ends["t"], max(length_m, _WHOLE)
        turned_rad = math.atan2((last_t or 0.0) - (first_t or 0.0), run_m)
        for number in range(count):
            run_m = number * step_m
            if start_m + run_m > line.length_m + _WHOLE:
                break
            share = run_m / length_m if length_m > 0 else 0.0
            at = {
                key: None if low is None or high is None else low + share * (high - low)
                for key, (low, high) in ends.items()
            }
            at_t_m = at["t"] or 0.0
            yield _Pose(
                start_m + run_m,
                at_t_m,
                at["width"] or None,
                at["length"] or None,
                start_m + run_m - s_m,
                at_t_m - t_m,
                turned_rad,
            )


def _outline(element: ET.Element, line: RoadLine, pose: _Pose, place: str) -> tuple[Floats | None, int | None]:
    """Return the corners (x, y) of an object and the number of the only side without a marking, if there is one."""
    outlines = element.findall("outlines/outline") + element.findall("outline")
    outer = [outline for outline in outlines if outline.get("outer", "true") != "false"]
    if outer:
        local, along = outer[0].findall("cornerLocal"), outer[0].findall("cornerRoad")
        corners = local or along
        names = ("u", "v") if local else ("s", "t")
        values = np.array(
            [[number_of(corner.get(key), f"{place}, corner {key}") for key in names] for corner in corners]
        ).reshape(-1, 2)
        ids = [corner.get("id", str(index)) for index, corner in enumerate(corners)]
        mouth = _unmarked(element, ids)
        if not local:
            return line.beside(values[:, 0] + pose.shift_s_m, values[:, 1] + pose.shift_t_m), mouth
        return _turned(element, line, pose, values, place), mouth
    sides = []
    for key, repeated in (("length", pose.length_m), ("width", pose.width_m)):
        if repeated is None and element.get(key) is None:
            return None, None
        sides.append(positive_of(repeated if repeated is not None else element.get(key), f"{place}, {key}"))
    box = np.array([(-1, 1), (-1, -1), (1, -1), (1, 1)]) * np.array(sides) / 2
    return _turned(element, line, pose, box, place), None


def _turned(element: ET.Element, line: RoadLine, pose: _Pose, local: Floats, place: str) -> Floats:
    """Return the points (x, y) of points (u, v) of an object at a pose."""
    s_m, t_m = np.array([pose.s_m]), np.array([pose.t_m])
    (origin,) = line.beside(s_m, t_m)
    _, (heading,) = line.at(s_m)
    heading += number_of(element.get("hdg", 0), f"{place}, hdg", most=_ANGLE, unit="radians")
    heading += pose.turned_rad
    cos, sin = math.cos(heading), math.sin(heading)
    u, v = local.T
    return np.stack([origin[0] + u * cos - v * sin, origin[1] + u * sin + v * cos], axis=1)


def _unmarked(element: ET.Element, ids: list[str]) -> int | None:
    """Return the number of the only one of four sides without a marking: cars cross it."""
    sides = {frozenset({ids[index], ids[(index + 1) % len(ids)]}): index for index in range(len(ids))}
    marked: Counter[int] = Counter()
    for marking in element.findall("markings/marking"):
        ends = [reference.get("id", "") for reference in marking.findall("cornerReference")]
        marked.update(sides[pair] for pair in map(frozenset, pairwise(ends)) if pair in sides)
    if len(ids) != 4 or len(marked) != 3:  # noqa: PLR2004 - three of four sides
        return None
    (mouth,) = set(range(4)) - set(marked)
    return mouth


def _ground(corners: Floats) -> list[Point]:
    return [(x, -y) for x, y in corners.tolist()]


def _middle(corners: Floats, side: int) -> Point:
    x, y = ((corners[side] + corners[(side + 1) % len(corners)]) / 2).tolist()
    return x, -y
