"""OSM XML files of Lanelet2 maps: shared points, ways and relations with geographic coordinates."""

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from garage2usd.common.package import of_extra
from garage2usd.maps.frame import projection
from garage2usd.maps.xml_text import number_text, tag_text, write_lines

with of_extra("a Lanelet2 map"):
    from pyproj import Transformer

Place = tuple[float, float, float]
"""Point (x, y, z) in metres, in the frame of `garage2usd.maps.frame`."""
APART_M = 0.051
"""Least distance between two points; nearer ones are merged. Lanelet2's check `mapping.points_too_close` wants 5 cm."""
_CELL_M = 1.0
"""Side of the cubes by which points are looked up; floors, where most points are, lie in the middle of cubes."""
_DEGREE_DIGITS = 11
"""Decimals of degrees: a micrometre. Further digits of PROJ differ by processor; the last one may too."""


_Cell = tuple[int, int, int]


class Member(NamedTuple):
    """A member of an OSM relation: `way` or `relation`, its id and its role."""

    kind: str
    number: int
    role: str


class OsmFile:
    """An OSM file under construction: points, ways and relations, numbered from 1 in order of creation.

    Parameters
    ----------
    latitude_deg, longitude_deg
        Coordinates of the frame's origin, around which points are projected by a transverse Mercator of true scale on
        the WGS 84 ellipsoid.

    Attributes
    ----------
    floor_m
        Height of the floor over which the heights of further points are given.
    """

    def __init__(self, latitude_deg: float, longitude_deg: float) -> None:
        self._to_degrees = Transformer.from_crs(projection(latitude_deg, longitude_deg), "EPSG:4326", always_xy=True)
        self.floor_m = 0.0
        self._numbers = itertools.count(1)
        self._places: dict[int, Place] = {}
        self._cells: dict[_Cell, list[int]] = {}
        self._ways: dict[int, tuple[tuple[int, ...], dict[str, str]]] = {}
        self._way_of: dict[tuple[int, ...], int] = {}
        self._relations: dict[int, tuple[tuple[Member, ...], dict[str, str]]] = {}

    def point(self, place: Place, *, other_than: int | None = None) -> int:
        """Return the id of the OSM point within `APART_M` of a position, creating it if needed.

        The point is never `other_than`, even if that is near.
        """
        near = self.near(place)
        if near is not None and near != other_than:
            return near
        number = next(self._numbers)
        x, y, z = self._places[number] = place[0], place[1], place[2] + self.floor_m
        self._cells.setdefault(_cell(x, y, z), []).append(number)
        return number

    def near(self, place: Place) -> int | None:
        """Return the id of the nearest OSM point within `APART_M` of a position, if there is one."""
        at = place[0], place[1], place[2] + self.floor_m
        found = [
            (apart_m, number)
            for cell in _cells_around(at)
            for number in self._cells.get(cell, ())
            if (apart_m := math.dist(at, self._places[number])) < APART_M
        ]
        return min(found)[1] if found else None

    def move(self, point: int, place: Place) -> None:
        """Move a point to another position."""
        x, y, z = self._places[point]
        self._cells[_cell(x, y, z)].remove(point)
        x, y, z = self._places[point] = place[0], place[1], place[2] + self.floor_m
        self._cells.setdefault(_cell(x, y, z), []).append(point)

    def points(self, places: Iterable[Place]) -> tuple[int, ...]:
        """Return the ids of OSM points near a sequence of positions, without repeats."""
        numbers = [self.point(place) for place in places]
        return tuple(number for number, before in zip(numbers, [None, *numbers], strict=False) if number != before)

    def place(self, point: int) -> Place:
        """Return the position of an OSM point, with its height over the floor."""
        x, y, z = self._places[point]
        return x, y, z - self.floor_m

    def way(self, points: Sequence[int], tags: Mapping[str, str]) -> int:
        """Return the id of the OSM way along points, reusing one in either direction."""
        key = min(tuple(points), tuple(reversed(points)))
        if key not in self._way_of:
            self._way_of[key] = self.new_way(points, tags)
        return self._way_of[key]

    def new_way(self, points: Sequence[int], tags: Mapping[str, str]) -> int:
        """Create an OSM way along points, even if one exists."""
        number = next(self._numbers)
        self._ways[number] = tuple(points), dict(tags)
        return number

    def polygon(self, points: Sequence[int], tags: Mapping[str, str]) -> int:
        """Create a closed OSM way, whose first point is not repeated at its end, and return its id."""
        return self.new_way(points, {**tags, "area": "yes"})

    def number(self) -> int:
        """Reserve the id of a relation to which others refer before it is created."""
        return next(self._numbers)

    def relation(self, members: Iterable[Member], tags: Mapping[str, str], *, number: int | None = None) -> int:
        """Create an OSM relation, with a reserved id if there is one, and return its id."""
        number = self.number() if number is None else number
        self._relations[number] = tuple(members), dict(tags)
        return number

    def write(self, path: Path, *, generator: str, facts: Mapping[str, str]) -> None:
        """Write the OSM XML file.

        Parameters
        ----------
        path
            The file.
        generator
            Name of the generating program.
        facts
            Attributes of the element `MetaInfo`, which Autoware reads and other programs ignore.
        """
        used = sorted({point for points, _ in self._ways.values() for point in points})
        places = np.array([self._places[point] for point in used]).reshape(-1, 3)
        longitudes, latitudes = self._to_degrees.transform(places[:, 0], places[:, 1])
        lines = [f"{tag_text('osm', {'version': '0.6', 'generator': generator})}>"]
        lines.append(f"  {tag_text('MetaInfo', facts)} />")
        columns = *places.T.tolist(), longitudes.tolist(), latitudes.tolist()
        for number, x, y, z, longitude, latitude in zip(used, *columns, strict=True):
            lat, lon = f"{latitude:.{_DEGREE_DIGITS}f}", f"{longitude:.{_DEGREE_DIGITS}f}"
            lines += [
                f'  <node id="{number}" version="1" lat="{lat}" lon="{lon}">',
                f'    <tag k="ele" v="{number_text(z)}" />',
                f'    <tag k="local_x" v="{number_text(x)}" />',
                f'    <tag k="local_y" v="{number_text(y)}" />',
                "  </node>",
            ]
        for number, (points, tags) in self._ways.items():
            lines.append(f'  <way id="{number}" version="1">')
            lines += [f'    <nd ref="{point}" />' for point in points]
            lines += [*_tag_lines(tags), "  </way>"]
        for number, (members, tags) in self._relations.items():
            lines.append(f'  <relation id="{number}" version="1">')
            lines += [f'    <member type="{kind}" ref="{ref}" role="{role}" />' for kind, ref, role in members]
            lines += [*_tag_lines(tags), "  </relation>"]
        write_lines([*lines, "</osm>"], path)


def _tag_lines(tags: Mapping[str, str]) -> list[str]:
    return [f"    {tag_text('tag', {'k': name, 'v': value})} />" for name, value in tags.items()]


def _cell(x: float, y: float, z: float) -> _Cell:
    return math.floor(x / _CELL_M), math.floor(y / _CELL_M), math.floor(z / _CELL_M + 0.5)


def _cells_around(place: Place) -> Iterable[_Cell]:
    """Return the cells of all points that can be within `APART_M`: one, or several at a border."""
    x, y, z = place
    low, high = _cell(x - APART_M, y - APART_M, z - APART_M), _cell(x + APART_M, y + APART_M, z + APART_M)
    if low == high:
        return (low,)
    spans = [range(first, last + 1) for first, last in zip(low, high, strict=True)]
    return [(column, row, layer) for column, row, layer in itertools.product(*spans)]
