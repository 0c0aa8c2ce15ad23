"""Nodes, ways and relations of OSM XML files, in metres."""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from garage2usd.common.errors import ConfigError
from garage2usd.garage import Point
from garage2usd.survey.text import number_of, read_xml, refuse


class OsmNode(NamedTuple):
    """A node: its place in messages, (x, z) and tags."""

    name: str
    position: Point
    tags: Mapping[str, str]

    @property
    def height_m(self) -> float | None:
        """Its height by ``ele`` or ``local_z``; None without one that is a number of metres."""
        for key in ("ele", "local_z"):
            if key in self.tags:
                with suppress(ConfigError):
                    return number_of(self.tags[key].removesuffix("m").strip(), key)
        return None


class OsmWay(NamedTuple):
    """A way: its place in messages, the numbers of its nodes, and tags."""

    name: str
    nodes: tuple[int, ...]
    tags: Mapping[str, str]

    @property
    def is_closed(self) -> bool:
        """True if the last node is the first."""
        return len(self.nodes) > 2 and self.nodes[0] == self.nodes[-1]  # noqa: PLR2004 - a triangle


class OsmMember(NamedTuple):
    """A member of a relation: `node`, `way` or `relation`, its number and role."""

    kind: str
    number: int
    role: str


class OsmRelation(NamedTuple):
    """A relation: its place in messages, members and tags."""

    name: str
    members: tuple[OsmMember, ...]
    tags: Mapping[str, str]

    def ways(self, *roles: str) -> list[int]:
        """Return the numbers of the member ways with one of some roles."""
        return [member.number for member in self.members if member.kind == "way" and member.role in roles]


class OsmElements(NamedTuple):
    """An OSM file in metres.

    Attributes
    ----------
    nodes, ways, relations
        By number.
    origin_deg
        Latitude and longitude of (0, 0); None if the nodes have coordinates of their own in metres.
    """

    nodes: Mapping[int, OsmNode]
    ways: Mapping[int, OsmWay]
    relations: Mapping[int, OsmRelation]
    origin_deg: tuple[float, float] | None

    def line(self, nodes: Iterable[int]) -> tuple[Point, ...]:
        """Return the positions (x, z) of nodes, given by number."""
        return tuple(self.nodes[node].position for node in nodes)


def read_osm(path: Path) -> OsmElements:
    """Read an OSM XML file.

    The coordinates are the tags ``local_x`` and ``local_y`` if all nodes have them, or else a transverse Mercator
    around the middle of all nodes that ways use. Deleted elements are left out. Ways keep the nodes that the file has.

    Raises
    ------
    ConfigError
        If the file is not OSM XML; names the element.
    MissingExtraError
        For longitudes and latitudes, without the extra ``maps``.
    """
    root = read_xml(path, "osm", "an OSM file")
    places, tags = _places_of(root, path)
    ways = {}
    for number, element in _each(root, "way", path):
        refs = (_reference(child, f"{path.name}: way {number}, nd") for child in element.iter("nd"))
        nodes = tuple(ref for ref in refs if ref in places)
        ways[number] = OsmWay(f"way {number}", nodes, _tags(element))
    relations = {}
    for number, element in _each(root, "relation", path):
        place = f"{path.name}: relation {number}, member"
        members = tuple(
            OsmMember(child.get("type", ""), _reference(child, place), child.get("role", ""))
            for child in element.iter("member")
        )
        relations[number] = OsmRelation(f"relation {number}", members, _tags(element))
    used = {node for way in ways.values() for node in way.nodes} or set(places)
    positions, origin_deg = _ground(places, tags, used, path)
    nodes_by_number = {
        number: OsmNode(f"node {number}", position, tags[number]) for number, position in positions.items()
    }
    return OsmElements(nodes_by_number, ways, relations, origin_deg)


def ring_of(lines: Sequence[tuple[int, ...]]) -> tuple[int, ...] | None:
    """Chain ways to a ring of nodes.

    Parameters
    ----------
    lines
        Numbers of the nodes of each way, in any order and direction.

    Returns
    -------
    tuple of int or None
        The nodes without a repeated first one; None if the ways do not close one ring.
    """
    left = [line for line in lines if len(line) > 1]
    if not left:
        return None
    ring = list(left.pop(0))
    while left and ring[0] != ring[-1]:
        for index, line in enumerate(left):
            if ring[-1] in {line[0], line[-1]}:
                ring += line[1:] if line[0] == ring[-1] else line[-2::-1]
                del left[index]
                break
        else:
            return None
    is_whole = not left and ring[0] == ring[-1] and len(ring) > 3  # noqa: PLR2004 - a triangle
    return tuple(ring[:-1]) if is_whole else None


def _each(root: ET.Element, tag: str, path: Path) -> Iterator[tuple[int, ET.Element]]:
    """Yield the elements of a kind with their numbers, in the order of the file."""
    seen: set[int] = set()
    for element in root.iter(tag):
        if element.get("action") == "delete" or element.get("visible") == "false":
            continue
        number = _whole(element.get("id"), f"{path.name}: {tag}, id")
        if number in seen:
            refuse(f"{path.name}: {tag}, id", number, f"each number of a {tag} once")
        seen.add(number)
        yield number, element


def _places_of(root: ET.Element, path: Path) -> tuple[dict[int, ET.Element], dict[int, Mapping[str, str]]]:
    places: dict[int, ET.Element] = {}
    tags: dict[int, Mapping[str, str]] = {}
    for number, element in _each(root, "node", path):
        places[number] = element
        tags[number] = _tags(element)
    return places, tags


def _ground(
    places: Mapping[int, ET.Element], tags: Mapping[int, Mapping[str, str]], used: set[int], path: Path
) -> tuple[dict[int, Point], tuple[float, float] | None]:
    """Return (x, z) of all nodes, and latitude and longitude of (0, 0) unless the file has metres of its own."""
    if not places:
        return {}, None
    if all("local_x" in tags[number] and "local_y" in tags[number] for number in places):
        return {
            number: (
                number_of(tags[number]["local_x"], f"{path.name}: node {number}, local_x"),
                -number_of(tags[number]["local_y"], f"{path.name}: node {number}, local_y"),
            )
            for number in places
        }, None
    degrees = []
    for number, element in places.items():
        place = f"{path.name}: node {number}"
        latitude = number_of(element.get("lat"), f"{place}, lat", most=90.0, unit="degrees")
        longitude = number_of(element.get("lon"), f"{place}, lon", most=180.0, unit="degrees")
        degrees.append((longitude, latitude))
    from garage2usd.survey.earth import ground_of  # noqa: PLC0415 - files in metres do without its extra

    around = [position for number, position in zip(places, degrees, strict=True) if number in used]
    ground, origin_deg = ground_of(degrees, path.name, around=around)
    return dict(zip(places, ((x, z) for x, z in ground.tolist()), strict=True)), origin_deg


def _tags(element: ET.Element) -> dict[str, str]:
    return {child.get("k", ""): child.get("v", "") for child in element.iter("tag")}


def _reference(element: ET.Element, place: str) -> int:
    return _whole(element.get("ref"), f"{place}, ref")


def _whole(text: str | None, place: str) -> int:
    try:
        return int(text or "")
    except ValueError:
        raise ConfigError(place, text or "nothing", "a whole number") from None
