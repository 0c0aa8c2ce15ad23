import math
from itertools import pairwise
from operator import itemgetter

import networkx as nx
import numpy as np
import pytest
import shapely
from scipy.spatial.distance import cdist
from support.sample_files import each_sample
from support.soak import soak_but

from garage2usd.config import GarageConfig
from garage2usd.config.site import SiteConfig
from garage2usd.garage import StallKind
from garage2usd.layout import lay_out
from garage2usd.layout.parking.zones import zone_names
from garage2usd.objects import MOUNTED
from garage2usd.objects.zone_plate import ZONE_PLATE_HEIGHT_M
from garage2usd.pipeline import generate
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph
from garage2usd.structure.lanes import lane_squares_graph

PLAN = """
.........
E=======X
.=.....=.
.=======.
.=.....=.
"""
ONE_AISLE = """
.....
E===X
.....
"""
RING = """
..............
E============X
.=..........=.
.=..........=.
.============.
..............
"""


def laid_out(plan=PLAN, profile="cn-jgj100", **fittings):
    config = GarageConfig(profile=profile, fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(plan, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


def numbers_of(layout):
    return {stall.name: stall.number for stall in layout.stalls if stall.number}


@pytest.mark.parametrize(("profile", "first"), [("cn-jgj100", 2), ("uk-istructe", 0)])
def test_numbers_go_up_the_side_of_traffic_and_back_down_the_other(profile, first):
    layout = laid_out(ONE_AISLE, profile, stair_cores=False)
    number_of = {stall.centre_m: stall.number for stall in layout.stalls}
    up, down = ([place for place in number_of if (place[1] > 12.15) == (row == 2)] for row in (first, 2 - first))
    on_way = sorted(up) + sorted(down, reverse=True)
    assert [number_of[place] for place in on_way] == [f"A1-{n:02d}" for n in range(1, len(number_of) + 1)]


def test_letters_follow_the_way_and_aisles_end_at_junctions():
    zones = {stall.square: stall.number[:2] for stall in laid_out().stalls if stall.number}
    assert {zones[0, 4], zones[2, 0], zones[2, 4]} == {"A1"}
    assert {zones[4, 2], zones[4, 4]} == {"B1"}


def test_a_long_stretch_without_junctions_is_divided_at_its_bends():
    sides = {}
    side = ".=..........=.\n"
    for stall in laid_out(RING.replace(side, 2 * side, 1)).stalls:
        sides.setdefault(stall.number[:2], []).append(stall.access_square)
    assert sorted(filter(None, sides)) == ["A1", "A2", "A3", "A4"]
    for zone in filter(None, sides):
        rows, columns = map(set, zip(*sides[zone], strict=True))
        assert 1 in {len(rows), len(columns)}


@pytest.mark.parametrize(("aisles", "parts"), [(3, 5), (24, 3), (25, 2), (700, 1), (3000, 1), (30, 400)])
def test_letters_and_numbers_suffice_for_any_garage(aisles, parts):
    names = zone_names([(aisle, part) for aisle in range(aisles) for part in range(parts)])
    assert all(name[0].isalpha() and name[0] not in "IO" and 1 <= int(name[1:]) <= 99 for name in names.values())
    if aisles * parts <= 24 * 29:
        assert len({*names.values()}) == aisles * parts
    if aisles <= 24:
        assert all((one[0] == other[0]) == (names[one][0] == names[other][0]) for one in names for other in names)


def test_without_zones_stalls_count_through_the_garage_and_columns_are_bare():
    layout = laid_out(zones=False)
    numbers = sorted(stall.number for stall in layout.stalls if stall.use.takes_cars)
    assert numbers == [f"{n:03d}" for n in range(1, len(numbers) + 1)]
    assert not layout.of_kind("zone_plate")


GARAGES = [
    {"width_cells": 5 + seed % 9, "height_cells": 4 + seed % 6, "rectangles": 1 + seed % 3, "obstacles": seed % 2}
    for seed in range(12)
]


@pytest.mark.parametrize("seed", soak_but([1, 6], range(12)))
def test_numbers_of_any_garage_are_found_along_its_aisles(seed):
    one_way = (
        {"plan": {"aisles": "one-way"}, "stalls": {"kinds": {"perpendicular": 0.5, "angled": 0.5}}} if seed % 2 else {}
    )
    site = {"width_cells": 9 + seed % 8, "height_cells": 8 + seed % 5, "obstacles": seed % 3}
    layout = generate(GarageConfig(seed=seed, site=site, **one_way)).layout
    by_zone = {}
    for stall in layout.stalls:
        assert bool(stall.number) == stall.use.is_parked_in
        if stall.number:
            zone, number = stall.number.split("-")
            by_zone.setdefault(zone, []).append((int(number), stall))
    beside = lane_squares_graph(layout.structure)
    zones_at, driven_m = {}, []
    for zone, numbered in by_zone.items():
        numbered.sort(key=itemgetter(0))
        assert [number for number, _ in numbered] == [*range(1, len(numbered) + 1)]
        for _, stall in numbered:
            zones_at.setdefault(stall.access_square, set()).add(zone)
        stalls = [stall for _, stall in numbered]
        turns = sum(not is_beside(one, other) for one, other in pairwise([*stalls, stalls[0]]))
        # of the stalls that stand side by side in a row, few more than one pair a zone have other numbers in between
        rows = [(one, other) for one in stalls for other in stalls if one.name < other.name and is_beside(one, other)]
        assert turns + len(rows) <= len(stalls) + 2
        driven_m += [
            nx.shortest_path_length(beside, one.access_square, other.access_square) for one, other in pairwise(stalls)
        ]
    # the stalls at a lane square have one zone, and a zone ends at a junction or a bend
    assert all(len(zones) == 1 for zones in zones_at.values())
    for one, other in beside.edges:
        if zones_at.get(one, zones_at.get(other)) != zones_at.get(other, zones_at.get(one)):
            assert is_end(one, beside) or is_end(other, beside)
    # squares driven from number to number; numbers in blocks of 4 x 4 squares jump over more than two in 5 to 10 %
    assert sum(squares > 2 for squares in driven_m) <= 0.05 * len(driven_m)


def is_beside(one, other):
    """True for stalls side by side in a row, with their mouths to the same side, and at most a column in between."""
    (left, right), (other_left, other_right) = (np.array(stall.corners_m()[:2]) for stall in (one, other))
    gap_m = min(np.linalg.norm(left - other_right), np.linalg.norm(right - other_left))
    return one.edge == other.edge and gap_m < 1.2


def is_end(square, beside):
    """True at a junction, a dead end or a bend."""
    others = [*beside[square]]
    return len(others) != 2 or all(one[axis] != other[axis] for axis in (0, 1) for one, other in [others])


@each_sample
def test_plates_of_the_samples_show_the_zones_of_the_stalls(sample, builds):
    assert_plates_show_the_zones_before_them(builds(sample, "usdc").garage.layout)


@pytest.mark.parametrize("seed", range(len(GARAGES)))
def test_plates_of_any_garage_show_the_zones_of_the_stalls(seed):
    site = SiteConfig(min_portal_distance_cells=2, **GARAGES[seed])
    assert_plates_show_the_zones_before_them(generate(GarageConfig(seed=seed, site=site)).layout)


def test_sides_of_a_column_show_the_zones_before_them_and_those_along_a_border_none():
    layout = laid_out(RING)
    zones = {stall.square: stall.number[:2] for stall in layout.stalls}
    plates = [plate for place in layout.of_kind("zone_plate") for plate in plates_of(place)]
    # the column between four squares of stalls, two of each side of the ring
    shown = {tuple(ahead.round().tolist()): zone for zone, at, ahead in plates if math.dist(at, (48.6, 24.3)) < 0.5}
    assert zones[2, 5] == zones[2, 6] != zones[3, 5] == zones[3, 6]
    assert shown == {(0.0, -1.0): zones[2, 6], (0.0, 1.0): zones[3, 6]}


def plates_of(placement):
    """(zone, middle, way that it looks) of each plate of an object; (x, z) in the garage."""
    for plate in placement.spec.plates():
        yaw = placement.yaw_rad + plate.yaw_rad
        yield plate.text, placement.to_world(plate.middle), np.array([np.sin(yaw), np.cos(yaw)])


def test_what_hangs_on_a_column_covers_no_plate():
    layout = laid_out()
    foot = min(plate.position_m[1] for plate in layout.of_kind("zone_plate"))
    assert all(part.points[:, 1].max() < foot for mounted in MOUNTED for part in mounted.spec.asset().parts)
    assert foot + ZONE_PLATE_HEIGHT_M < GarageConfig().fittings.clear_height_m


def assert_plates_show_the_zones_before_them(layout):
    """The stall nearest before a plate is of its zone, the plate nearest to a stall too, and each zone has one."""
    stalls = [stall for stall in layout.stalls if stall.number]
    zones = np.array([stall.number.split("-")[0] for stall in stalls])
    plates = [plate for placement in layout.of_kind("zone_plate") for plate in plates_of(placement)]
    assert {text for text, _, _ in plates} == {*zones.tolist()}
    middles = np.array([stall.centre_m for stall in stalls])
    grounds = np.array([shapely.Polygon(stall.corners_m()) for stall in stalls])
    for text, place, ahead in plates:
        before = np.flatnonzero((middles - place) @ ahead > 0)
        distances = shapely.distance(shapely.Point(place), grounds[before])
        # of stalls that are as near as each other, one at least
        nearest = before[distances < distances.min() + 1e-3]
        assert text in zones[nearest], place
    # of the plates that face it; to the mouth of angled stalls, which lean away from the plates of their row
    quads = {stall.name: stall for stall in layout.quads}
    at = [quads[stall.name].mouth if stall.stall_kind is StallKind.ANGLED else stall.centre_m for stall in stalls]
    places, ahead = (np.array([plate[part] for plate in plates]) for part in (1, 2))
    faces = ((np.array(at)[:, None] - places) * ahead).sum(axis=2) > 0
    nearest = np.where(faces, cdist(at, places), np.inf).argmin(axis=1)
    assert [plates[plate][0] for plate in nearest.tolist()] == zones.tolist()
