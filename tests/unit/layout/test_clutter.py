"""People and things that stand about: where they stand, how many, and that no car is in need of their ground."""

import json
import math
from collections import Counter
from dataclasses import astuple, replace
from functools import cache

import numpy as np
import pytest
import shapely
from shapely import affinity
from support import clutter_judge
from support.soak import soak_but

from garage2usd.checks import check_layout
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.config.fittings import ClutterConfig
from garage2usd.driving.layout_garage import prove_stalls
from garage2usd.layout import ObjectTable
from garage2usd.layout.placement import placed
from garage2usd.layout.tiles import ground_inside
from garage2usd.objects.car import OpenCarSpec
from garage2usd.objects.person import PersonSpec
from garage2usd.pipeline import generate
from garage2usd.structure.grid import Cell

MANY = dict.fromkeys(set(ClutterConfig.model_fields) - {"amount"}, 12.0)
SORTS = set(MANY) - {"open_boots"}
MANY_SEEDS = range(8)


def garage(seed, clutter):
    return _garage(seed, json.dumps(clutter, sort_keys=True))


@cache
def _garage(seed, clutter):
    site = {"height_cells": 5 + seed % 4, "width_cells": 5 + seed // 4 % 5}
    return generate(GarageConfig(seed=seed, site=site, clutter=json.loads(clutter)))


def clutter_of(layout):
    return [place for place in layout.placements if place.spec.kind.group == "Clutter"]


def hull(place):
    """All that it covers of the floor, by its mesh and shapely's own turns."""
    points = np.concatenate([part.points[:, [0, 2]] for part in place.spec.asset().parts])
    x, _, z = place.position_m
    turned = affinity.rotate(shapely.MultiPoint(points).convex_hull, -math.degrees(place.yaw_rad), origin=(0, 0))
    return affinity.translate(turned, x, z)


def test_nothing_stands_about_where_nothing_is_asked_for_and_what_is_moves_nothing_else():
    bare, full = garage(3, {}), garage(3, MANY)
    assert not clutter_of(bare.layout)
    added = clutter_of(full.layout)
    assert added
    kept = [place for place in full.layout.placements if place not in set(added)]
    opened = [place for place in kept if isinstance(place.spec, OpenCarSpec)]
    assert opened
    cars = {(place.square, place.ordinal) for place in opened}
    changed = [(old, new) for old, new in zip(bare.layout.placements, kept, strict=True) if old != new]
    assert {(new.square, new.ordinal) for _, new in changed} == cars
    assert Counter(new.kind for _, new in changed) == {"car": len(cars), "number_plate": len(cars)}
    for old, new in changed:
        assert (old.position_m, old.yaw_rad) == (new.position_m, new.yaw_rad)
        assert astuple(old.spec) == astuple(new.spec)


def test_sorts_are_drawn_by_themselves_and_names_differ():
    alone, among = (clutter_of(garage(5, clutter).layout) for clutter in ({"pallets": 12.0}, MANY))
    assert alone
    assert [place for place in among if place.kind == "pallet"] == alone
    assert max(Counter((place.kind, place.name) for place in among).values()) == 1


def test_usual_amounts_fill_in_what_is_not_given():
    assert ClutterConfig(amount="usual", bins=0).per_hundred("bins") == 0
    assert ClutterConfig(amount="usual").per_hundred("people") == 6
    assert ClutterConfig().per_hundred("people") == 0
    assert ClutterConfig(amount="crowded", people=7).per_hundred("people") == 7
    assert ClutterConfig(amount="crowded").per_hundred("bins") == 10
    with pytest.raises(ConfigError, match=r"clutter.people"):
        GarageConfig(clutter={"people": -1})


@pytest.mark.soak
def test_over_many_garages_clutter_stands_on_ground_that_is_nobodys():
    found = Counter()
    for seed in MANY_SEEDS:
        layout = garage(seed, MANY).layout
        clutter = clutter_of(layout)
        found.update(place.kind for place in clutter)
        inside = ground_inside(layout.structure)
        others = [
            shapely.Polygon(outline)
            for place in layout.placements
            if place.spec.kind.group != "Clutter"
            for outline in place.outlines()
        ]
        stalls = [shapely.Polygon(stall.corners_m()) for stall in layout.stalls]
        doors = [shapely.Point(core.door_m) for core in layout.cores]
        shapes = [hull(place) for place in clutter]
        taken = shapely.STRtree([*others, *stalls])
        assert not len(taken.query(shapes, predicate="intersects")[0]), seed
        assert all(shapely.distance(shape, door) > 0.9 for shape in shapes for door in doors), seed
        assert shapely.contains_properly(inside, shapes).all(), seed
        touching = shapely.STRtree(shapes).query(shapes, predicate="intersects")
        assert (touching[0] == touching[1]).all(), seed
        assert all(place.position_m[1] == 0 for place in clutter), seed
        assert not any(shape.intersects(lane) for shape in shapes for lane in carriageways(layout)), seed
    assert len(found) == len(SORTS), found
    assert min(found.values()) > 3, found


ROOM_M, SIGHT_M = 0.4, 1.5
STREWN = MANY | {"people": 40.0}


def cramped(layout):
    """People who have too little room, or have a wall or a thing before them and no car or door behind which it is."""
    inside = ground_inside(layout.structure)
    # wheel stops are as low as kerbs, and zone plates a centimetre thick on their columns
    objects = ((shape, name) for shape, name, _ in clutter_judge.objects(layout))
    solid = [(shape, name) for shape, name in objects if not name.startswith(("WheelStop", "ZonePlates"))]
    clutter = [(hull(place), place.name) for place in clutter_of(layout)]
    # people who talk to each other, and things that were put down before them, are no walls
    looked_at = {place.name for kind in ("car", "person", "bag", "cardboard_box") for place in layout.of_kind(kind)}
    for place in layout.of_kind("person"):
        x, _, z = place.position_m
        middle = shapely.Point(x, z)
        things = [(shape, name) for shape, name in [*solid, *clutter] if name != place.name]
        near = [name for shape, name in things if shape.distance(middle) < ROOM_M - 1e-6]
        if near or inside.exterior.distance(middle) < ROOM_M - 1e-6:
            yield place.name, near
        nose = np.array((math.sin(place.yaw_rad), math.cos(place.yaw_rad)))
        sight = shapely.LineString([(x, z), (x, z) + SIGHT_M * nose])
        seen = [(shape.intersection(sight).distance(middle), name) for shape, name in things if shape.intersects(sight)]
        doors = [shapely.Point(core.door_m) for core in layout.cores if core.has_door]
        at_door = any(door.distance(sight) < 0.1 for door in doors)
        if seen and min(seen)[1] not in looked_at and not at_door:
            yield place.name, min(seen)


@pytest.mark.parametrize("seed", soak_but([3], range(6)))
def test_people_have_room_around_them_and_look_at_an_aisle_a_door_or_a_car(seed):
    layout = garage(seed, STREWN).layout
    assert sum(1 for _ in layout.of_kind("person")) > 3
    assert not list(cramped(layout))


def test_the_measure_of_room_sees_who_faces_a_wall_or_stands_in_a_gap():
    layout = garage(3, STREWN).layout
    person = next(iter(layout.of_kind("person")))
    (x, _, z), wall = person.position_m, next(iter(layout.of_kind("column")))
    (wx, _, wz), others = wall.position_m, [place for place in layout.placements if place != person]
    away = np.array((x - wx, z - wz)) / math.dist((x, z), (wx, wz))
    for gap in (0.3, 0.9):
        at = np.array((wx, wz)) + away * (wall.spec.asset().parts[0].points[:, 0].max() + gap)
        yaw = math.atan2(*-away)
        moved = placed(person.name, person.spec, (float(at[0]), float(at[1])), yaw_rad=yaw)
        faults = dict(cramped(replace(layout, placements=ObjectTable([[*others, moved]]))))
        assert person.name in faults, gap


@pytest.mark.parametrize("seed", soak_but([0, 7], [0, 5, 7, 14, 23, 62]))
def test_a_judge_that_shares_no_code_finds_nothing_in_the_way(seed):
    _, stalls, found, faults = clutter_judge.judged(seed)
    assert stalls > 5
    assert found
    assert not faults


def test_the_judge_sees_what_stands_in_the_way():
    made = generate(GarageConfig(**clutter_judge.settings_of(7)))
    layout = made.layout
    person = PersonSpec(0)
    stall, lane = layout.stalls[0], made.graph.lanes.positions_m[1]
    car = next(iter(layout.of_kind("car")))
    for point, height, met in (
        (stall.centre_m, 0.0, stall.name),
        (tuple(lane), 0.0, "lane"),
        ((car.position_m[0], car.position_m[2]), 0.0, car.name),
        ((car.position_m[0], car.position_m[2]), 0.0, f"a way of {car.stall}"),
        ((-3.0, -3.0), 0.0, "edge of the floor"),
        ((-3.0, -3.0), 0.2, "the floor, 0.2 m"),
    ):
        wrong = placed("Person_99", person, point, height_m=height)
        crowded = replace(layout, placements=ObjectTable([[*layout.placements, wrong]]))
        faults, _ = clutter_judge.faults_of(replace(made, levels=(replace(made.levels[0], layout=crowded),)))
        assert any(name == "Person_99" and met in what for _, name, what in faults), met


def carriageways(layout):
    """The middle of every lane square, which is driven however narrow its margins are."""
    structure = layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    for row, col in structure.where(Cell.LANE):
        yield shapely.box(x[col] + 0.8, z[row] + 0.8, x[col + 1] - 0.8, z[row + 1] - 0.8)


@pytest.mark.parametrize("seed", soak_but([3, 5], range(6)))
def test_every_stall_that_was_proven_stays_so_and_checks_find_no_more(seed):
    bare, full = garage(seed, {}), garage(seed, MANY)
    assert clutter_of(full.layout)
    proven = [{proof.stall for proof in prove_stalls(g.layout) if proof.is_proven} for g in (bare, full)]
    assert proven[0] == proven[1]
    findings = [Counter(finding.rule for finding in check_layout(g.layout, g.config)) for g in (bare, full)]
    assert findings[0] == findings[1]
