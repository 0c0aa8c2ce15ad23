"""Stains on the floor: different from square to square, inside their square, apart from what they would fight with."""

import itertools
from collections import defaultdict

import numpy as np
import pytest
import shapely
from support.footprints import footprint
from support.sample_files import each_sample

from garage2usd.config import GarageConfig, load_config
from garage2usd.garage import StallUse
from garage2usd.objects.floor_stain import StainMark, StainSpec, TyreMarkSpec
from garage2usd.objects.stall_number import PAINT_LIFT_M
from garage2usd.pipeline import generate
from garage2usd.stage.arrangement import arrange
from garage2usd.stage.labels import world_bounds_m
from garage2usd.structure.grid import Cell

SITE = {"width_cells": 14, "height_cells": 10, "obstacles": 2, "min_portal_distance_cells": 4}
DRAWN = """
..............
E============.
.=.#..=.....=.
.=....=.....=.
.============.
.=....=.....=.
.=....=..#..=.
.============X
..............
"""
"""Straights, bends, T-junctions and a crossroads: every kind of wear has a square."""
CONFIG = GarageConfig(seed=8, site={"structure": DRAWN}, fittings={"floor_stain_rate": 1.0}, parking={"occupancy": 0.3})
WEAR = {mark for mark in StainMark if mark.name.startswith("WEAR")}


def is_wear(place):
    return isinstance(place.spec, StainSpec) and place.spec.mark in WEAR


@pytest.fixture(scope="module")
def layout():
    return generate(CONFIG).layout


@pytest.fixture(scope="module")
def stains(layout):
    return layout.of_kind("floor_stain")


def boxes(layout):
    """The ground that each stain covers as its mesh says, by an axis-aligned box."""
    rows = layout.placements.rows_of("floor_stain")
    low, high = world_bounds_m(layout.placements, rows)
    return [shapely.box(x0, z0, x1, z1) for (x0, _, z0), (x1, _, z1) in zip(low, high, strict=True)]


def square_box(layout, square):
    x, z = layout.structure.column_edges_m, layout.structure.row_edges_m
    row, col = square
    return shapely.box(x[col], z[row], x[col + 1], z[row + 1])


def test_every_mark_is_there(stains):
    marks = {place.spec.mark for place in stains if isinstance(place.spec, StainSpec)}
    assert marks == set(StainMark) - {StainMark.SEAM, StainMark.REPAIR}  # of patched asphalt
    tyres = {np.sign(place.spec.turn_rad) for place in stains if isinstance(place.spec, TyreMarkSpec)}
    assert tyres == {-1, 0, 1}


def test_stains_keep_to_their_square_off_walls_and_columns(layout, stains):
    standing = shapely.union_all(
        [footprint(place) for place in layout.placements if place.kind in {"column", "wall", "obstacle", "portal"}]
    )
    for place, box in zip(stains, boxes(layout), strict=True):
        assert square_box(layout, place.square).buffer(1e-4).covers(box), place
        if not is_wear(place):
            assert box.intersection(standing).area < 1e-6, place


def test_wear_covers_every_lane_once_and_leads_where_cars_drive(layout, stains):
    worn = [place for place in stains if is_wear(place)]
    driven = (layout.structure.cells != Cell.OBSTACLE) & (layout.structure.cells != Cell.FREE)
    assert sorted(place.square for place in worn) == [tuple(square) for square in np.argwhere(driven).tolist()]
    steps = {(0, 1): (1, 0), (1, 0): (0, 1), (0, -1): (-1, 0), (-1, 0): (0, -1)}  # (x, z): (row, column)
    base = {
        StainMark.WEAR_STRAIGHT: [(0, 1), (0, -1)],
        StainMark.WEAR_BEND: [(0, 1), (1, 0)],
        StainMark.WEAR_T: [(0, 1), (1, 0), (-1, 0)],
        StainMark.WEAR_CROSS: list(steps),
    }
    for place in worn:
        cos, sin = round(np.cos(place.yaw_rad)), round(np.sin(place.yaw_rad))
        open_to = {steps[x * cos + z * sin, -x * sin + z * cos] for x, z in base[place.spec.mark]}
        row, col = place.square
        cells = np.pad(layout.structure.cells, 1, constant_values=Cell.OBSTACLE)
        lanes = {
            (dr, dc) for dr, dc in steps.values() if cells[row + 1 + dr, col + 1 + dc] not in {Cell.OBSTACLE, Cell.FREE}
        }
        if layout.structure.cells[row, col] == Cell.LANE and len(lanes) > 1:
            assert open_to == lanes, place


def test_what_overlaps_lies_at_another_height(layout, stains):
    on_square = defaultdict(list)
    for place, box in zip(stains, boxes(layout), strict=True):
        assert 0.0005 < place.position_m[1] < PAINT_LIFT_M - 0.0005
        on_square[place.square].append((place, box))
    for items in on_square.values():
        for (one, box), (other, other_box) in itertools.combinations(items, 2):
            if box.intersection(other_box).area > 1e-6:
                assert abs(one.position_m[1] - other.position_m[1]) > 0.0003, (one, other)


def test_oil_lies_under_the_engine_between_the_lines(layout, stains):
    by_name = {(stall.square, f"Oil_{stall.ordinal}"): stall for stall in layout.stalls}
    oil = [place for place in stains if (place.square, place.name) in by_name]
    assert len(oil) > 20
    for place in oil:
        stall = by_name[place.square, place.name]
        assert stall.use not in {StallUse.EV, StallUse.TURNING}
        assert shapely.Polygon(stall.corners_m()).buffer(-0.1).covers(footprint(place))
        *_, rear_right, rear_left = stall.corners_m()
        x, _, z = place.position_m
        assert 0.9 < shapely.LineString([rear_right, rear_left]).distance(shapely.Point(x, z)) < 1.7


def test_patches_keep_off_paint(layout, stains):
    patches = [place for place in stains if getattr(place.spec, "mark", None) is StainMark.PATCH]
    assert patches
    floors = {place.square: place for place in layout.of_kind("floor")}
    for place in patches:
        panel = floors[place.square]
        x, _, z = panel.position_m
        for marking in panel.spec.markings:
            paint = shapely.Polygon([(x + px, z + pz) for px, pz in marking.polygon])
            assert paint.distance(footprint(place)) > 0.01


def shown(layout):
    """What stains each square shows, by square."""
    sets = defaultdict(set)
    for place in layout.of_kind("floor_stain"):
        if not is_wear(place):
            row, col = place.square
            x, z = layout.structure.column_edges_m[col], layout.structure.row_edges_m[row]
            at = round(place.position_m[0] - x, 4), round(place.position_m[2] - z, 4)
            sets[row, col].add((place.spec, at, place.yaw_rad))
    return sets


@each_sample
def test_no_neighbours_show_the_same(sample):
    config = load_config(sample)
    sets = shown(generate(config.model_copy(update={"plan": config.plan.model_copy(update={"episodes": 50})})).layout)
    assert len(sets) > 10
    for (row, col), there in sets.items():
        for other in ((row, col + 1), (row + 1, col), (row + 1, col + 1), (row + 1, col - 1)):
            assert there != sets.get(other)


def test_the_rate_thins_them_out_without_moving_them():
    plan = {"episodes": 200}
    few, many = (
        set(
            generate(GarageConfig(seed=5, site=SITE, plan=plan, fittings={"floor_stain_rate": rate})).layout.of_kind(
                "floor_stain"
            )
        )
        for rate in (0.2, 0.8)
    )
    assert 0 < len(few) < len(many)
    assert len(few - many) <= len(few) // 20  # a few lie where there is a larger one now
    none = generate(GarageConfig(seed=5, site=SITE, plan=plan, fittings={"floor_stain_rate": 0})).layout
    assert none.of_kind("floor_stain") == ()


def test_squares_that_share_draws_share_their_stains():
    """Or else a large garage has as many prototypes as squares."""
    config = {**CONFIG.model_dump(), "stage": {"form": "nested", "arrangements": 4}}
    layout = generate(GarageConfig(**config)).layout
    assert arrange(layout, nested=True).nested
    sets = shown(layout)
    assert len({frozenset(there) for there in sets.values()}) < len(sets) / 2
