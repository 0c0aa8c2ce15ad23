"""Driving lanes of OpenDRIVE roads as centre lines."""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
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
    """A driving lane: points (x, y) of its centre line, mean width, and if cars drive along it only."""

    points: Floats
    width_m: float
    one_way: bool


class _Lane(NamedTuple):
    """A lane of a section: number, directions of driving along the road (1, -1), width or border, and its use."""

    number: int
    directions: tuple[int, ...]
    extent: Cubics
    is_border: bool
    is_parking: bool = False


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
    offsets, sections = _sections(road, place)
    ends = _section_ends(sections, line)  # none of a road that only carries objects
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


class _Strip(NamedTuple):
    """A parking lane in one section, with the lanes between it and the middle; its extent along the road."""

    section: _Section
    lanes: tuple[_Lane, ...]
    end_m: float

    @property
    def number(self) -> int:
        """The number of the lane."""
        return self.lanes[-1].number

    def borders_at(self, s_m: Floats) -> tuple[Floats, Floats]:
        """Return the offsets from the middle lane of its border on the carriageway and of the other one."""
        inner = outer = np.zeros(len(s_m))
        for lane in self.lanes:
            inner, outer = outer, _outer_border(lane, outer, s_m - self.section.start_m)
        return inner, outer


class ParkingLane:
    """A parking lane over the sections of a road that it runs through.

    Attributes
    ----------
    number
        Number of the lane.
    start_m, end_m
        Where it begins and ends along the road.
    """

    def __init__(self, strips: Sequence[_Strip], offsets: Cubics) -> None:
        self._strips, self._offsets = strips, offsets
        self.number = strips[0].number
        self.start_m, self.end_m = strips[0].section.start_m, strips[-1].end_m

    def wide_run(self, least_m: float) -> tuple[float, float, float]:
        """Return begin, end and mean width of the longest stretch that is at least some metres wide; else zeros."""
        s_m = np.linspace(self.start_m, self.end_m, max(2, math.ceil((self.end_m - self.start_m) / _STEP_M) + 1))
        inner, outer = self.borders_at(s_m)
        width_m = np.abs(outer - inner)
        runs = np.split(np.arange(len(s_m)), np.flatnonzero(np.diff(width_m >= least_m)) + 1)
        run = max(runs, key=lambda run: len(run) if width_m[run[0]] >= least_m else 0)
        if width_m[run[0]] < least_m:
            return 0.0, 0.0, 0.0
        return float(s_m[run[0]]), float(s_m[run[-1]]), float(width_m[run].mean())

    def borders_at(self, s_m: Floats) -> tuple[Floats, Floats]:
        """Return the offsets of its border on the carriageway, and of the other one, from the reference line."""
        ends = np.array([strip.end_m for strip in self._strips[:-1]])
        of_strip = np.searchsorted(ends, s_m)
        inner, outer = np.empty(len(s_m)), np.empty(len(s_m))
        for index, strip in enumerate(self._strips):
            here = of_strip == index
            inner[here], outer[here] = strip.borders_at(s_m[here])
        middle = self._offsets.at(s_m)
        return middle + inner, middle + outer


def parking_lanes(road: ET.Element, line: RoadLine, place: str) -> Iterator[ParkingLane]:
    """Yield the parking lanes of a road; raises as `lanes_of_road`."""
    offsets, sections = _sections(road, place)
    runs: dict[int, list[_Strip]] = {}
    for section, end_m in zip(sections, _section_ends(sections, line), strict=True):
        strips = {
            lane.number: _Strip(section, lanes[: index + 1], end_m)
            for lanes in (section.left, section.right)
            for index, lane in enumerate(lanes)
            if lane.is_parking and end_m > section.start_m
        }
        for number in [number for number in runs if number not in strips]:
            yield ParkingLane(runs.pop(number), offsets)
        for number, strip in strips.items():
            runs.setdefault(number, []).append(strip)
    yield from (ParkingLane(run, offsets) for run in runs.values())


def _outer_border(lane: _Lane, inner: Floats, run_m: Floats) -> Floats:
    extent = math.copysign(1.0, lane.number) * lane.extent.at(run_m)
    return extent if lane.is_border else inner + extent


def _sections(road: ET.Element, place: str) -> tuple[Cubics, list[_Section]]:
    """Return the offset of the middle lane of a road, and its sections in order."""
    offsets = cubics_of(road.findall("lanes/laneOffset"), "s", f"{place}, laneOffset")
    is_left_hand = road.get("rule") == "LHT"
    found = enumerate(road.findall("lanes/laneSection"))
    sections = [_section(each, f"{place}, laneSection {index}", is_left_hand=is_left_hand) for index, each in found]
    return offsets, sorted(sections, key=lambda section: section.start_m)


def _section_ends(sections: Sequence[_Section], line: RoadLine) -> list[float]:
    return [*(section.start_m for section in sections[1:]), line.length_m] if sections else []


def _samples(start_m: float, end_m: float, line: RoadLine) -> Floats:
    count = min(math.ceil((end_m - start_m) / _STEP_M) + 1, _MOST_STEPS)
    inner = [joint for joint in line.joints_m if start_m < joint < end_m]
    return np.union1d(np.linspace(start_m, end_m, max(count, 2)), inner)


def _borders(section: _Section, s_m: Floats) -> tuple[Floats, Floats, Floats]:
    """Return the lowest and highest offset from the middle lane, to the left, of driving lanes, and their width."""
    edges: list[Floats] = []
    width = np.zeros(len(s_m))
    for lanes in (section.left, section.right):
        inner = np.zeros(len(s_m))
        for lane in lanes:
            outer = _outer_border(lane, inner, s_m - section.start_m)
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
    return _Lane(number, directions, extent, not widths and bool(borders), element.get("type") == "parking")
