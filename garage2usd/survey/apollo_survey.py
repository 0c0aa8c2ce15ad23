"""Surveys as Apollo's OpenDRIVE: points of the earth instead of places along reference lines."""

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage import Point
from garage2usd.survey.lanelets import line_between
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.survey import Survey, Unplaced
from garage2usd.survey.text import number_of

Floats = NDArray[np.float64]

_DRIVING = {"driving", "citydriving", "parking"}
"""Types of lanes on which cars drive; in Apollo a parking lane is the lane of a car park."""
_MOST_LONGITUDE, _MOST_LATITUDE = 180.0, 90.0


class _Line(NamedTuple):
    """Points as given, for a stall or for a border or centre line of a lane."""

    name: str
    points: list[tuple[float, float]]


def is_apollo(root: ET.Element) -> bool:
    """Return True for Apollo's kind of OpenDRIVE, whose lanes and objects have points of their own."""
    roads = root.findall("road")
    return any(
        road.find("planView") is None
        and (road.find(".//cornerGlobal") is not None or road.find(".//centerLine") is not None)
        for road in roads
    )


def read_apollo_survey(root: ET.Element, file: str) -> Survey:
    """Read a survey from the root of Apollo's OpenDRIVE.

    Parameters
    ----------
    root
        Its root element.
    file
        Name of the file, for messages.

    Notes
    -----
    Points are longitude and latitude, as Apollo's converter asks; points beyond these are metres. Stalls are objects
    ``parkingSpace`` with an outline of ``cornerGlobal``. The lanes of a section are one lane between its outermost
    borders, two-way if it has lanes on both sides of its centre; without borders each lane is one along its
    ``centerLine``, as wide as its ``sampleAssociate`` tell.

    Raises
    ------
    ConfigError
        If a point is not two numbers; names the road.
    MissingExtraError
        For longitudes and latitudes, without the extra ``maps``.
    """
    stalls: list[_Line] = []
    sections: list[tuple[str, ET.Element]] = []
    for index, road in enumerate(root.findall("road")):
        name = f"road {road.get('id', index)}"
        for element in road.findall("objects/object"):
            if element.get("type") == "parkingSpace":
                title = f"{name}, object {element.get('id', 'without id')}"
                stalls.append(_Line(title, _points(element.findall("outline/cornerGlobal"), f"{file}: {title}")))
        sections += [(name, section) for section in road.findall("lanes/laneSection")]
    lanes = [lane for name, section in sections for lane in _lanes_of(section, name, f"{file}: {name}")]
    given = [point for stall in stalls for point in stall.points]
    given += [point for lane in lanes for line in lane.lines for point in line]
    ground, origin_deg = _ground(given, file)
    places = iter(ground)

    def taken(points: Sequence[Point]) -> list[Point]:
        return [next(places) for _ in points]

    parts = SurveyParts()
    for stall in stalls:
        parts.add_stall(stall.name, taken(stall.points))
    for lane in lanes:
        lines = [taken(line) for line in lane.lines]
        if min(map(len, lines)) < 2:  # noqa: PLR2004 - a line
            parts.unread.append(Unplaced(lane.name, "a lane without length"))
            continue
        line, width_m = lines[0], lane.width_m
        if len(lines) > 1:
            line, width_m = line_between(*map(np.array, lines))
        parts.add_lane(lane.name, line[::-1] if lane.way < 0 else line, width_m, one_way=lane.way != 0)
    return parts.survey(origin_deg=origin_deg)


class _ApolloLane(NamedTuple):
    """A lane: one centre line or both borders, its width if it is known, and 1, -1 or 0 as cars drive along it."""

    name: str
    lines: list[list[tuple[float, float]]]
    width_m: float | None
    way: int


def _lanes_of(section: ET.Element, road: str, place: str) -> Iterator[_ApolloLane]:
    """Yield the lane between the outer borders of a section, or all of its lanes along their centre lines."""
    sides = {
        side: [lane for lane in section.findall(f"{side}/lane") if lane.get("type", "").lower() in _DRIVING]
        for side in ("left", "right")
    }
    outer = [max(lanes, key=lambda lane: abs(_id(lane)), default=None) for lanes in sides.values()]
    centre = section.find("center/lane")
    borders = [_line((centre if lane is None else lane), "border", place) for lane in outer]
    lanes = [lane for of_side in sides.values() for lane in of_side]
    if not lanes:
        return
    if all(len(border) > 1 for border in borders) and borders[0] != borders[1]:
        ways = {_way(lane, place) for lane in lanes}
        yield _ApolloLane(road, borders, None, ways.pop() if len(ways) == 1 else 0)
        return
    for lane in lanes:
        name = f"{road}, lane {lane.get('id', 'without id')}"
        widths = [
            number_of(sample.get("leftWidth"), f"{place}, leftWidth")
            + number_of(sample.get("rightWidth"), f"{place}, rightWidth")
            for sample in lane.findall("sampleAssociates/sampleAssociate")
        ]
        width_m = float(np.mean(widths)) if widths and min(widths) > 0 else None
        way = {"backward": -1, "bidirection": 0}.get(lane.get("direction", "").lower(), 1)
        yield _ApolloLane(name, [_line(lane, "centerLine", place)], width_m, way)


def _id(lane: ET.Element) -> int:
    text = lane.get("id", "")
    return int(text) if text.removeprefix("-").isdecimal() else 0


def _way(lane: ET.Element, place: str) -> int:
    """Return 1 if cars drive along the border of a lane, -1 against it, and 0 for both."""
    direction = {"backward": -1, "bidirection": 0}.get(lane.get("direction", "").lower(), 1)
    border, centre = (_line(lane, tag, place) for tag in ("border", "centerLine"))
    if len(border) < 2 or len(centre) < 2:  # noqa: PLR2004 - a line
        return direction if _id(lane) < 0 else -direction
    along = np.subtract(border[-1], border[0]) @ np.subtract(centre[-1], centre[0])
    return direction if along >= 0 else -direction


def _line(lane: ET.Element | None, tag: str, place: str) -> list[tuple[float, float]]:
    return [] if lane is None else _points(lane.findall(f"{tag}/geometry/pointSet/point"), place)


def _points(elements: Sequence[ET.Element], place: str) -> list[tuple[float, float]]:
    return [
        (
            number_of(each.get("x"), f"{place}, x", unit="degrees"),
            number_of(each.get("y"), f"{place}, y", unit="degrees"),
        )
        for each in elements
    ]


def _ground(given: list[tuple[float, float]], file: str) -> tuple[list[Point], tuple[float, float] | None]:
    """Return (x, z) of all points, and latitude and longitude of (0, 0) if they are degrees."""
    points = np.array(given, np.float64).reshape(-1, 2)
    if not len(points) or (np.abs(points) > (_MOST_LONGITUDE, _MOST_LATITUDE)).any():
        return [(x, -y) for x, y in points.tolist()], None
    from garage2usd.survey.earth import ground_of  # noqa: PLC0415 - files in metres do without its extra

    ground, origin_deg = ground_of(points, file)
    return [(x, z) for x, z in ground.tolist()], origin_deg
