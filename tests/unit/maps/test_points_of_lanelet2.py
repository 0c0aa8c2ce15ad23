"""Points of Lanelet2 maps keep 5 cm apart, as Lanelet2 demands, and no line or polygon suffers from it."""

import math
import xml.etree.ElementTree as ET
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from scipy.spatial import cKDTree
from support.small_garage import SETTINGS
from support.small_levels import SMALL_HELICES, SMALL_LEVELS

import garage2usd
from garage2usd import GarageConfig
from garage2usd.imports import import_layout
from garage2usd.maps.lane_bounds import lane_bounds
from garage2usd.maps.network import Lanes, Network, Road
from garage2usd.maps.osm_file import OsmFile
from garage2usd.maps.road_nodes import straight, turn

APART_M = 0.05
SAG_M = 1e-3
CLEAR_M = 2.0
"""Least height between two levels where one passes below the other."""
WIDE = Lanes(0.0, 3.0, 3.0)

SURVEY = """
outline = [[0, 0], [22, 0], [22, 18.2], [0, 18.2]]
[[runs]]
first = [6, 5.8]
last = [16.0, 5.8]
side = "left"
count = 4
length_m = 5.3
[[runs]]
first = [6.02, 11.84]
last = [16.02, 11.84]
side = "right"
count = 4
length_m = 5.3
[[lanes]]
points = [[0, {lane_m}], [22, {lane_m}]]
width_m = 6
[[portals]]
at = [0, {lane_m}]
kind = "entrance"
[[portals]]
at = [22, {lane_m}]
kind = "exit"
"""
"""Two rows of stalls along a lane, with their mouths on it or a few centimetres off."""


def read(path):
    """Places by id, lines by id with their tags, and relations of a map."""
    root = ET.parse(path).getroot()
    of = {
        node.get("id"): [float(node.find(f"tag[@k='{key}']").get("v")) for key in ("local_x", "local_y", "ele")]
        for node in root.iter("node")
    }
    tags = {id(thing): {tag.get("k"): tag.get("v") for tag in thing.iter("tag")} for thing in root}
    ways = {way.get("id"): ([nd.get("ref") for nd in way.iter("nd")], tags[id(way)]) for way in root.iter("way")}
    relations = [
        ([ways[member.get("ref")][0] for member in one.iter("member") if member.get("type") == "way"], tags[id(one)])
        for one in root.iter("relation")
    ]
    return SimpleNamespace(places=of, ways=ways, relations=relations)


def polygons(found):
    """Each lanelet, area and polygon of a map as its name and the ids around it."""
    for number, (points, tags) in found.ways.items():
        if tags.get("area") == "yes":
            yield f"{tags['type']} {number}", points
    for number, (lines, tags) in enumerate(found.relations):
        if tags["type"] == "lanelet":
            left, right = lines
            ends = (math.dist(found.places[left[0]], found.places[right[end]]) for end in (0, -1))
            yield f"lanelet {number}", [*left, *(right[::-1] if next(ends) < next(ends) else right)]
        elif tags["type"] == "multipolygon":
            first, second, *_ = lines
            ring = list(first if first[-1] in (second[0], second[-1]) else first[::-1])
            for line in lines[1:]:
                ring += (line if line[0] == ring[-1] else line[::-1])[1:]
            assert ring[0] == ring[-1]
            yield f"{tags['subtype']} {number}", ring[:-1]


def complaints(path):
    found = read(path)
    tree = cKDTree(np.array(list(found.places.values())))
    if pairs := tree.query_pairs(APART_M):
        yield f"{len(pairs)} pairs of points within {APART_M} m"
    if unused := found.places.keys() - {point for points, _ in found.ways.values() for point in points}:
        yield f"{len(unused)} points in no line"
    for number, (points, tags) in found.ways.items():
        if len(points) < 2 or any(one == other for one, other in pairwise(points)):
            yield f"way {number}, {tags}, repeats a point"
    for name, points in polygons(found):
        ring = [found.places[point] for point in points]
        if not shapely.Polygon(np.array(ring)[:, :2]).is_valid and not passes_below_itself(ring):
            yield f"{name} crosses itself"


def passes_below_itself(ring):
    """Whether a ring crosses itself on different levels only, as the lane of a helix does seen from above."""
    sides = np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)
    lines = shapely.linestrings(sides[:, :, :2])
    one, other = shapely.STRtree(lines).query(lines, predicate="crosses")
    heights = sides[:, :, 2].mean(axis=1)
    return len(one) > 0 and np.abs(heights[one] - heights[other]).min() > CLEAR_M


@pytest.mark.parametrize(
    "config",
    [
        GarageConfig(**SETTINGS),
        pytest.param(SMALL_LEVELS, marks=pytest.mark.soak),
        pytest.param(SMALL_HELICES, marks=pytest.mark.soak),
    ],
    ids=["one level", "two levels", "helices"],
)
def test_no_two_points_are_nearer_than_lanelet2_allows(config, tmp_path):
    stage = garage2usd.build(config, tmp_path / "garage.usdc").stage
    (path,) = garage2usd.export(stage, [tmp_path / "garage.osm"])
    assert list(complaints(path)) == []


@pytest.mark.parametrize("lane_m", [8.8, 8.83])
def test_the_points_of_an_import_keep_apart_too(lane_m, tmp_path):
    (tmp_path / "lot.toml").write_text(SURVEY.format(lane_m=lane_m))
    stage = import_layout(tmp_path / "lot.toml", tmp_path / "lot.usdc").stage
    (path,) = garage2usd.export(stage, [tmp_path / "lot.osm"])
    assert list(complaints(path)) == []


def bounds_of(*roads):
    osm = OsmFile(49.0, 9.0)
    lanes = lane_bounds(Network(roads, (), ()), osm)
    return [bound for lane in lanes for bound in (lane.left, lane.right)]


def sag_m(bound):
    """How far a line lies off the bound that it stands for."""
    runs = np.linspace(0.0, bound.road.line.length_m, 2000)
    curve = shapely.points([bound.at(run)[:2] for run in runs])
    return shapely.distance(shapely.LineString([place[:2] for place in bound.places]), curve).max()


@pytest.mark.parametrize("radius_m", [0.02, 0.06, 0.17, 0.5, 2.0])
def test_bends_are_as_fine_as_their_points_allow(radius_m):
    """At a right angle around a corner; of the bound on its inner side only few points have 5 cm between them."""
    far = 3.0 + radius_m
    road = Road(1, turn((-far, 0.0), (0.0, 0.0), (0.0, -far)), WIDE, WIDE, ())
    for bound in bounds_of(road):
        steps = np.linalg.norm(np.diff(np.array(bound.places), axis=0), axis=1)
        assert len(bound.places) == 2 or steps.min() > APART_M
        most_m = SAG_M if bound.side < 2 or radius_m > 0.35 else 0.02
        assert sag_m(bound) < most_m


def test_lines_that_cross_keep_their_points_apart():
    """Three roads through the same ground, one of them twice: there and back on the same line."""
    roads = [
        Road(1, turn((-6.0, 0.0), (0.0, 0.0), (0.0, 6.0)), WIDE, WIDE, ()),
        Road(2, turn((-6.0, 0.1), (0.0, 0.1), (0.0, -5.9)), WIDE, WIDE, ()),
        Road(3, straight((-6.0, 0.0), (6.0, 1.0)), Lanes(0.0, 3.0, 3.0), Lanes(0.0, 2.5, 3.5), ()),
        Road(4, turn((0.0, 6.0), (0.0, 0.0), (-6.0, 0.0)), WIDE, WIDE, ()),
    ]
    bounds = bounds_of(*roads)
    places = {point: place for bound in bounds for point, place in zip(bound.points, bound.places, strict=True)}
    assert not cKDTree(np.array(list(places.values()))).query_pairs(APART_M)
    assert max(sag_m(bound) for bound in bounds) < 2.5 * SAG_M
    there, back = ({tuple(sorted(bound.points)) for bound in bounds if bound.road is roads[n]} for n in (0, 3))
    assert there == back


def test_a_bound_shorter_than_its_points_allow_keeps_both_ends():
    road = Road(1, straight((0.0, 0.0), (0.03, 0.0)), WIDE, WIDE, ())
    for bound in bounds_of(road):
        assert len(set(bound.points)) == 2
        assert math.dist(*bound.places) == pytest.approx(0.03)
