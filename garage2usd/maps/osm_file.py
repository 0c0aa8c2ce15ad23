"""OSM XML files of Lanelet2 maps: shared points, ways and relations with geographic coordinates."""

import itertools
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from garage2usd.common.extras import of_extra
from garage2usd.maps.frame import projection
from garage2usd.maps.xml_text import number_text, tag_text, write_lines

with of_extra("a Lanelet2 map"):
    from pyproj import Transformer

__all__ = ["Member", "OsmFile", "Place"]

Place = tuple[float, float, float]
"""Point (x, y, z) in metres, in the frame of `garage2usd.maps.frame`."""
_SAME_M = 5e-4
"""Distance along each axis up to which points are merged."""
_GROUP_BITS = 7
"""Cells of the side `_SAME_M` are grouped for lookup, by two to the power of this number along each axis."""
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
        self._near: dict[_Cell, list[tuple[_Cell, int, Place]]] = {}
        self._ways: dict[int, tuple[tuple[int, ...], dict[str, str]]] = {}
        self._way_of: dict[tuple[int, ...], int] = {}
        self._relations: dict[int, tuple[tuple[Member, ...], dict[str, str]]] = {}

    def point(self, place: Place) -> int:
        """Return the id of the OSM point at a position, creating it if needed."""
        x, y, z = place = (place[0], place[1], place[2] + self.floor_m)
        cell = _cell(place)
        found = [
            (other, number)
            for group in _groups_around(cell)
            for other, number, (other_x, other_y, other_z) in self._near.get(group, ())
            if abs(other_x - x) <= _SAME_M and abs(other_y - y) <= _SAME_M and abs(other_z - z) <= _SAME_M
        ]
        if found:
            return min(found)[1]
        number = next(self._numbers)
        self._places[number] = place
        self._near.setdefault(_group(*cell), []).append((cell, number, place))
        return number

    def points(self, places: Iterable[Place]) -> tuple[int, ...]:
        """Return the ids of OSM points at a sequence of positions, without repeats."""
        numbers = [self.point(place) for place in places]
        return tuple(number for number, before in zip(numbers, [None, *numbers], strict=False) if number != before)

    def place(self, point: int) -> Place:
        """Return the position of an OSM point."""
        return self._places[point]

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

    def relation(self, members: Iterable[Member], tags: Mapping[str, str]) -> int:
        """Create an OSM relation and return its id."""
        number = next(self._numbers)
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
        places = np.array(list(self._places.values())).reshape(-1, 3)
        longitudes, latitudes = self._to_degrees.transform(places[:, 0], places[:, 1])
        lines = [f"{tag_text('osm', {'version': '0.6', 'generator': generator})}>"]
        lines.append(f"  {tag_text('MetaInfo', facts)} />")
        columns = *places.T.tolist(), longitudes.tolist(), latitudes.tolist()
        for number, x, y, z, longitude, latitude in zip(self._places, *columns, strict=True):
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


def _cell(place: Place) -> _Cell:
    x, y, z = place
    return round(x / _SAME_M), round(y / _SAME_M), round(z / _SAME_M)


def _group(x: int, y: int, z: int) -> _Cell:
    half = 1 << (_GROUP_BITS - 1)  # what lies at 0 is in the middle of a group
    return (x + half) >> _GROUP_BITS, (y + half) >> _GROUP_BITS, (z + half) >> _GROUP_BITS


def _groups_around(cell: _Cell) -> Iterable[_Cell]:
    """Return the lookup groups of a cell and its neighbours: one, or several at a border."""
    x, y, z = cell
    low, high = _group(x - 1, y - 1, z - 1), _group(x + 1, y + 1, z + 1)
    if low == high:
        return (low,)
    (left, front, under), (right, back, over) = low, high
    return {(i, j, k) for i in (left, right) for j in (front, back) for k in (under, over)}
