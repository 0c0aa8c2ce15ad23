"""Levels of an OSM XML file: by the tags ``level``, ``repeat_on`` and ``layer``, or by the heights of its nodes."""

from collections import defaultdict
from collections.abc import Collection, Iterable, Mapping
from functools import cached_property
from itertools import chain, pairwise
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.survey.lanelets import CentreLine
from garage2usd.survey.osm_elements import OsmElements, OsmWay
from garage2usd.survey.surveyed_building import ordinals_of
from garage2usd.survey.text import levels_of

LEAST_STOREY_M = 2.0
"""Least distance in metres between the floors of two levels."""
_STACKED = 0.2
"""Share of the smaller of two grounds from which one lies above the other."""
_GROUND = "0"
_ONE_WAY = {"yes": 1, "true": 1, "1": 1, "-1": -1, "reverse": -1}


class OsmArea(NamedTuple):
    """A stall's area or line: its tags and the numbers of its nodes."""

    tags: Mapping[str, str]
    nodes: tuple[int, ...]


class OsmLevels:
    """The levels of a file on which there are stalls.

    Parameters
    ----------
    osm
        The file.
    stalls
        Its stalls.

    Attributes
    ----------
    names
        Names of the levels in the order of the file; empty if it has none.
    floors_m
        Height of the floor of each level by its name; empty unless heights tell the levels.

    Notes
    -----
    Levels are told by ``level`` and ``repeat_on``; where no stall has these, by ``layer`` if the stalls lie on several
    layers, or else by the tags ``ele`` or ``local_z`` of nodes, if stalls lie one above the other at least 2 m apart.
    """

    def __init__(self, osm: OsmElements, stalls: Collection[OsmArea]) -> None:
        self._osm, self._by_layer = osm, False
        self.floors_m: dict[str, float] = {}
        self.names = self._told(stalls)
        if not self.names:
            self._by_layer = True
            layers = self._told(stalls)
            self._by_layer = len(layers) > 1
            self.names = layers if self._by_layer else ()
        if not self.names:
            self.floors_m = _floors_m(osm, stalls)
            self.names = tuple(self.floors_m)

    def _told(self, stalls: Iterable[OsmArea]) -> tuple[str, ...]:
        return tuple(dict.fromkeys(name for stall in stalls for name in sorted(self.told(stall.tags))))

    @cached_property
    def ordinals(self) -> dict[str, float]:
        """Number of each level by which they are ordered; those that are not numbers follow below, in their order."""
        return ordinals_of(self.names)

    @cached_property
    def ground(self) -> str:
        """The level of parts without a tag: 0, or else the top one."""
        return _GROUND if _GROUND in self.names else max(self.names, key=self.ordinals.__getitem__)

    @cached_property
    def of_bare_lanes(self) -> set[str]:
        """The levels of lanes without a tag: the ground, or all levels where no lane has one."""
        roads = (way.tags for way in self._osm.ways.values() if "highway" in way.tags)
        lanelets = (each.tags for each in self._osm.relations.values() if each.tags.get("type") == "lanelet")
        return {self.ground} if any(map(self.told, chain(roads, lanelets))) else set(self.names)

    def told(self, tags: Mapping[str, str]) -> set[str]:
        """Return the levels that tags tell."""
        found = levels_of(tags)
        return levels_of({"level": tags.get("layer", "")}) if self._by_layer and not found else found

    def of_nodes(self, nodes: Iterable[int]) -> str | None:
        """Return the level that is nearest to the mean height of nodes; None where heights do not tell levels."""
        heights = [height for node in nodes if (height := self._osm.nodes[node].height_m) is not None]
        return self._nearest(float(np.mean(heights))) if heights and self.floors_m else None

    def at_height(self, height_m: float) -> str | None:
        """Return the level whose floor is at a height; None between levels."""
        name = self._nearest(height_m)
        return name if abs(self.floors_m[name] - height_m) < LEAST_STOREY_M / 4 else None

    def _nearest(self, height_m: float) -> str:
        return min(self.floors_m, key=lambda each: abs(self.floors_m[each] - height_m))

    def of_stall(self, stall: OsmArea) -> set[str]:
        """Return the levels of a stall."""
        return self.told(stall.tags) or {name for name in [self.of_nodes(stall.nodes)] if name}

    def of_lanelet(self, lane: CentreLine) -> set[str]:
        """Return the levels of a lanelet that is not a part of a ramp."""
        height_m = lane.heights_m[0]
        told = self.told(lane.tags)
        if told or not self.names:
            return told
        return self.of_bare_lanes if height_m is None or not self.floors_m else {self._nearest(height_m)}

    @cached_property
    def _roads_at(self) -> dict[int, list[tuple[str, set[str]]]]:
        """Name and levels of each service road at a node that is no ramp by its tags, by the number of the node."""
        found: defaultdict[int, list[tuple[str, set[str]]]] = defaultdict(list)
        for way in self._osm.ways.values():
            told = self.told(way.tags)
            if way.tags.get("highway") == "service" and (len(told) == 1 or is_repeated(way.tags)):
                for node in way.nodes:
                    found[node].append((way.name, told))
        return found

    def met_at(self, node: int, *, beside: str = "") -> set[str]:
        """Return the levels of the service roads at a node, without that of one name."""
        roads = self._roads_at.get(node, [])
        return set().union(*(told for name, told in roads if name != beside)).intersection(self.names)

    def of_way(self, way: OsmWay) -> set[str]:
        """Return the levels of a service road; without tags that of the roads that it meets, or else the ground."""
        told = self.told(way.tags)
        if told or not self.names:
            return told
        met = set[str]().union(*map(self.met_at, way.nodes))
        return met if len(met) == 1 else self.of_bare_lanes


class OsmLevel(NamedTuple):
    """One level of a file, or the whole file without levels.

    Attributes
    ----------
    osm, levels
        The file and its levels.
    name
        The level; None of a file without levels.
    on_ramps
        Names of ways and relations that are parts of ramps, and so on no level.
    to_street
        Level of each lanelet that climbs to no other level, by its name.
    """

    osm: OsmElements
    levels: OsmLevels
    name: str | None
    on_ramps: frozenset[str] = frozenset()
    to_street: Mapping[str, str] = MappingProxyType({})

    @property
    def is_only(self) -> bool:
        """True if the file has no other level with stalls."""
        return len(self.levels.names) < 2  # noqa: PLR2004 - one above another

    def holds(self, tags: Mapping[str, str], nodes: Iterable[int]) -> bool:
        """Return True for a column, outline or portal on the level; those without level and height are on all."""
        if self.name is None:
            return True
        told = self.levels.told(tags)
        at = None if told else self.levels.of_nodes(nodes)
        return self.name in told if told else at in {None, self.name}

    def holds_portal(self, number: int) -> bool:
        """Return True for an entrance by the number of its node; one without level is that of the road there."""
        node, levels = self.osm.nodes[number], self.levels
        if self.is_only or levels.told(node.tags) or levels.floors_m:
            return self.holds(node.tags, (number,))
        return self.name in (levels.met_at(number) or {levels.ground})

    def levels_of(self, lane: CentreLine) -> set[str]:
        """Return the levels of a lanelet that is not a part of a ramp."""
        return {self.to_street[lane.name]} if lane.name in self.to_street else self.levels.of_lanelet(lane)

    def reason_against(self, what: str, tags: Mapping[str, str], found: set[str]) -> str | None:
        """Explain why a stall or lane is not read here; None if it is, and empty if it is read on another level.

        Parameters
        ----------
        what
            Words for it.
        tags
            Its tags.
        found
            Its levels; if there are none, it is on the ground level.
        """
        if self.name is None or (self.is_only and not found):
            return None
        found = found or {self.levels.ground}
        if self.name in found:
            return None
        if found.intersection(self.levels.names):
            return ""
        told = tags.get("level") or tags.get("repeat_on") or tags.get("layer", "")
        return f"{what} on level {told}{f' instead of {self.name}' if self.is_only else ', which has no stall'}"


def one_way_of(tags: Mapping[str, str]) -> int:
    """Return 1 for a road that cars drive along the points of its way only, -1 for one against them, else 0."""
    return _ONE_WAY.get(tags.get("oneway", "no").lower(), 0)


def is_repeated(tags: Mapping[str, str]) -> bool:
    """Return True if a road is on each of its levels alike, as a ramp is not."""
    return "repeat_on" in tags or (tags.get("service") == "parking_aisle" and "incline" not in tags)


def _floors_m(osm: OsmElements, stalls: Iterable[OsmArea]) -> dict[str, float]:
    """Return the height of each level by its number from 0 at the top, told by the heights of stalls; empty for one."""
    at: list[tuple[float, shapely.Geometry]] = []
    for stall in stalls:
        heights = [height for node in stall.nodes if (height := osm.nodes[node].height_m) is not None]
        if heights and len(heights) == len(stall.nodes):
            at.append((float(np.mean(heights)), shapely.MultiPoint(osm.line(stall.nodes)).convex_hull))
    at.sort(key=lambda each: -each[0])
    groups: list[list[tuple[float, shapely.Geometry]]] = []
    for place in at:
        if groups and groups[-1][-1][0] - place[0] < LEAST_STOREY_M:
            groups[-1].append(place)
        else:
            groups.append([place])
    grounds = [shapely.union_all([shape for _, shape in group]).convex_hull for group in groups]
    for upper, lower in pairwise(grounds):
        if upper.intersection(lower).area < _STACKED * min(upper.area, lower.area):
            return {}  # terraces of one lot
    if len(groups) < 2:  # noqa: PLR2004 - one above another
        return {}
    return {str(-number): float(np.median([height for height, _ in group])) for number, group in enumerate(groups)}
