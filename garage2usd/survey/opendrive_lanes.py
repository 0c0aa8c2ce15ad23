"""Driving lanes of OpenDRIVE roads as centre lines."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.survey.opendrive_lines import Cubics, RoadLine, cubics_of
from garage2usd.survey.text import number_of, refuse

Floats = NDArray[np.float64]

_DRIVING = {"driving", "entry", "exit", "onRamp", "offRamp", "connectingRamp", "bidirectional", "slipLane"}
_STEP_M = 0.25
_MOST_STEPS = 20_000
_STRAIGHT_M = 0.01
_LEAST_WIDTH_M = 0.1
_MOST_LANES = 1000


class RoadLane(NamedTuple):
    """A lane: points (x, y) of its centre line, its mean width, and whether cars drive along the points only."""

    points: Floats
    width_m: float
    one_way: bool


class _Lane(NamedTuple):
    """A lane of a section: number, directions of driving along the road (1, -1), and width or border."""

    number: int
    directions: tuple[int, ...]
    extent: Cubics
    is_border: bool


class _Section(NamedTuple):
    """A lane section: where it begins, its left lanes outwards, and its right lanes outwards."""

    start_m: float
    left: tuple[_Lane, ...]
    right: tuple[_Lane, ...]

    @property
    def directions(self) -> tuple[int, ...]:
        """The directions of driving along the road."""
        return tuple(sorted({way for lane in (*self.left, *self.right) for way in lane.directions}))


def lanes_of_road(road: ET.Element, line: RoadLine, place: str) -> Iterator[RoadLane]:
    """Yield the driving lanes of a road; adjacent lanes are merged, in one direction or in both.

    The centre line is the middle between the outer borders of the driving lanes.

    Raises
    ------
    ConfigError
        If a lane is invalid.
    """
    offsets = cubics_of(road.findall("lanes/laneOffset"), "s", f"{place}, laneOffset")
    is_left_hand = road.get("rule") == "LHT"
    sections = sorted(
        (
            _section(element, f"{place}, laneSection {index}", is_left_hand=is_left_hand)
            for index, element in enumerate(road.findall("lanes/laneSection"))
        ),
        key=lambda section: section.start_m,
    )
    if not sections:  # roads that only carry objects have none
        return
    ends = [*(section.start_m for section in sections[1:]), line.length_m]
    runs: list[tuple[tuple[int, ...], list[Floats], list[Floats], list[Floats]]] = []
    for section, end_m in zip(sections, ends, strict=True):
        if end_m <= section.start_m or not section.directions:
            runs.append(((), [], [], []))
            continue
        s_m = _samples(section.start_m, end_m, line)
        low, high, width = _borders(section, s_m)
        if not runs or runs[-1][0] != section.directions:
            runs.append((section.directions, [], [], []))
        middle_t = offsets.at(s_m) + (low + high) / 2
        runs[-1][1].append(line.beside(s_m, middle_t))
        runs[-1][2].append(width)
        runs[-1][3].append(s_m)
    for directions, points, widths, _ in runs:
        if not points:
            continue
        width_m = float(np.concatenate(widths).mean())
        found = np.concatenate(points)
        if width_m < _LEAST_WIDTH_M or not np.ptp(found, axis=0).any():
            continue
        centre = shapely.get_coordinates(shapely.LineString(found).simplify(_STRAIGHT_M))
        yield RoadLane(centre[:: -1 if directions == (-1,) else 1], width_m, len(directions) == 1)


def _samples(start_m: float, end_m: float, line: RoadLine) -> Floats:
    count = min(math.ceil((end_m - start_m) / _STEP_M) + 1, _MOST_STEPS)
    inner = [joint for joint in line.joints_m if start_m < joint < end_m]
    samples: Floats = np.union1d(np.linspace(start_m, end_m, max(count, 2)), inner)
    return samples


def _borders(section: _Section, s_m: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the lowest and highest offset from the middle lane, to the left, of driving lanes, and their width."""
    edges: list[Floats] = []
    width = np.zeros(len(s_m))
    for lanes, sign in ((section.left, 1), (section.right, -1)):
        inner = np.zeros(len(s_m))
        for lane in lanes:
            extent = lane.extent.at(s_m - section.start_m)
            outer = sign * extent if lane.is_border else inner + sign * extent
            if lane.directions:
                edges += [inner, outer]
                width = width + np.abs(outer - inner)
            inner = outer
    return np.min(edges, axis=0), np.max(edges, axis=0), width


def _section(element: ET.Element, place: str, *, is_left_hand: bool) -> _Section:
    start_m = number_of(element.get("s"), f"{place}, s")
    sides = []
    for side, sign in (("left", 1), ("right", -1)):
        found = element.findall(f"{side}/lane")
        if len(found) > _MOST_LANES:
            refuse(place, f"{len(found)} lanes", f"at most {_MOST_LANES} lanes")
        lanes = [_lane(lane, place, sign, is_left_hand=is_left_hand) for lane in found]
        sides.append(tuple(sorted(lanes, key=lambda lane: abs(lane.number))))
    return _Section(start_m, *sides)


def _lane(element: ET.Element, place: str, sign: int, *, is_left_hand: bool) -> _Lane:
    text = element.get("id", "nothing")
    here = f"{place}, lane {text}"
    number = int(number_of(text, f"{here}, id", most=_MOST_LANES, unit="lanes"))
    if number * sign <= 0:
        refuse(f"{here}, id", text, f"a whole number {'above' if sign > 0 else 'below'} 0")
    borders, widths = element.findall("border"), element.findall("width")
    extent = cubics_of(widths or borders, "sOffset", here)
    directions: tuple[int, ...] = ()
    if element.get("type") in _DRIVING:
        usual = sign if is_left_hand else -sign
        said = element.get("direction", "both" if element.get("type") == "bidirectional" else "standard")
        directions = (-1, 1) if said == "both" else (-usual if said == "reversed" else usual,)
    return _Lane(number, directions, extent, not widths and bool(borders))
