"""What hangs on walls and columns: where nobody drives or parks, and within reach of every place."""

from dataclasses import dataclass

import numpy as np
import pytest
import shapely
from scipy.spatial.distance import cdist
from support.footprints import footprint
from support.overlaps import assert_solid_objects_keep_apart, carriageways
from support.sample_files import SAMPLES, USUAL_SAMPLES
from support.small_garage import PLAN as SMALL
from support.soak import soak_but

from garage2usd.config import GarageConfig
from garage2usd.config.site import SiteConfig
from garage2usd.layout import lay_out
from garage2usd.layout.shell import mounts
from garage2usd.objects import MOUNTED, Mounted
from garage2usd.objects.kind import Spec, rectangle
from garage2usd.objects.mirror import KIND
from garage2usd.pipeline import generate
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

PLAN = """
..........
E========X
.#=.##.=..
..=....=..
..======..
..........
"""
SIZES = [(8.1, 8.1), ([7.8, 7.8, 6.7, 7.8, 7.8, 7.8, 7.8, 6.7, 7.8, 7.8], [5.3, 6.7, 5.4, 5.4, 6.7, 5.3])]
REACH = {"small": 12.0, "usual": 20.0, "far": 40.0}


@dataclass(frozen=True)
class PlateSpec(Spec, kind=KIND):
    """A plate of any width and depth."""

    width_m: float
    depth_m: float

    def asset(self):
        raise NotImplementedError

    def outlines(self):
        return (rectangle(-self.width_m / 2, 0.0, self.width_m / 2, self.depth_m),)


def laid_out(text=PLAN, sides=SIZES[0], **settings):
    config = GarageConfig(**settings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), *sides)
    return lay_out(structure, build_lane_graph(structure, config.bay), config), config


def places(layout):
    return np.array([stall.centre_m for stall in layout.stalls])


@pytest.mark.parametrize("sides", SIZES, ids=["equal", "dimensioned"])
@pytest.mark.parametrize("width_m", [0.2, 0.4, 0.65])
def test_nothing_hangs_where_cars_drive_or_park_or_people_leave(width_m, sides, monkeypatch):
    plate = Mounted(PlateSpec(width_m, 0.2), "hydrant_cabinets", "hydrant_reach", 7.0)
    monkeypatch.setattr(mounts, "MOUNTED", (plate,))
    layout, config = laid_out(sides=sides, profile="uk-istructe")
    hung = [place for place in layout.placements if isinstance(place.spec, PlateSpec)]
    assert len(hung) > 5
    ways = shapely.union_all(shapely.box(*carriageways(layout.structure, config.bay.carriageway_setback_m).T))
    stalls = shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in layout.stalls])
    solid = [place for kind in ("column", "wall", "obstacle", "no_parking_sign", "cone", "portal", "barrier")
             for place in layout.of_kind(kind)]  # fmt: skip
    others = shapely.union_all([footprint(place) for place in solid])
    inside = shapely.union_all([footprint(place) for place in layout.of_kind("ceiling")])
    bearing = [place for place in solid if place.kind in {"column", "wall", "obstacle"}]
    faces = shapely.union_all([footprint(place).boundary for place in bearing])
    grounds = [shapely.Polygon(place.outlines()[0]) for place in hung]
    for ground in grounds:
        assert ground.intersection(ways).area < 1e-6
        assert ground.intersection(stalls).area < 1e-6
        assert ground.intersection(others).area < 1e-6
        assert ground.within(inside.buffer(1e-6))
        assert ground.distance(faces) < 1e-6
    doors = [shapely.Point(core.door_m) for core in layout.cores]
    assert all(ground.distance(door) > 0.5 for ground in grounds for door in doors)
    tree = shapely.STRtree(grounds)
    assert len(tree.query(grounds, predicate="intersects").T) == len(grounds)


@pytest.mark.parametrize("count", [1, 2])
@pytest.mark.parametrize("walked", [False, True])
@pytest.mark.parametrize("reach_m", REACH.values(), ids=REACH)
def test_every_stall_is_served_wherever_a_face_is_free(reach_m, walked, count, monkeypatch):
    plate = Mounted(PlateSpec(0.3, 0.1), "hydrant_cabinets", "hydrant_reach", reach_m + 1.0, count, is_walked=walked)
    monkeypatch.setattr(mounts, "MOUNTED", (plate,))
    layout, _ = laid_out(profile="uk-istructe")
    at = np.array([place.position_m for place in layout.placements if isinstance(place.spec, PlateSpec)])[:, [0, 2]]
    distances = np.sort(cdist(places(layout), at, "cityblock" if walked else "euclidean"), axis=1)
    assert (distances[:, count - 1] <= reach_m + 1e-6).all()
    # as few as there can be, within what a greedy choice loses, of an area that each serves
    served = (2.0 if walked else np.pi) * reach_m**2
    floor = np.prod(layout.structure.shape) * 8.1**2
    assert len(at) <= count * max(4, 6 * floor / served)


def test_the_clause_of_the_profile_decides_how_far():
    near, _ = laid_out()
    far, _ = laid_out(profile="uk-istructe")
    assert len(far.of_kind("fire_extinguisher")) < len(near.of_kind("fire_extinguisher"))


@pytest.mark.parametrize(("spacing", "is_kept"), [(None, False), ("extinguisher_distance", True)])
def test_the_next_one_is_no_farther_than_the_clause_on_spacing(spacing, is_kept, monkeypatch):
    plate = Mounted(PlateSpec(0.3, 0.1), "hydrant_cabinets", "hydrant_reach", 27.1, spacing=spacing, is_walked=False)
    monkeypatch.setattr(mounts, "MOUNTED", (plate,))
    layout, config = laid_out()
    at = np.array([place.position_m for place in layout.placements if isinstance(place.spec, PlateSpec)])[:, [0, 2]]
    assert len(at) > 1
    to_next = np.sort(cdist(at, at), axis=1)[:, 1]
    assert (to_next.max() <= config.standard.extinguisher_distance.amount) == is_kept


def test_each_kind_has_a_switch_and_moves_nothing_else():
    everything, _ = laid_out()
    names = {mounted.kind.name for mounted in MOUNTED}
    others = [place for place in everything.placements if place.kind not in names]
    for mounted in MOUNTED:
        without, _ = laid_out(fittings={mounted.setting: False})
        assert everything.of_kind(mounted.kind.name)
        assert not without.of_kind(mounted.kind.name)
        assert [place for place in without.placements if place.kind not in names] == others


@pytest.mark.parametrize("sample", soak_but(USUAL_SAMPLES, SAMPLES), ids=lambda path: path.stem)
def test_nothing_that_hangs_reaches_into_a_stall_and_two_of_a_kind_hang_apart(sample, builds):
    layout = builds(sample, "usdc").garage.layout
    assert_hung_beside_stalls(layout)


@pytest.mark.parametrize("seed", soak_but([2, 5], range(6)))
def test_the_same_in_any_garage_and_each_stall_is_served(seed):
    side = {"width_cells": 7 + seed % 6, "height_cells": 6 + seed % 5, "obstacles": seed % 3}
    garage = generate(GarageConfig(seed=seed, site=SiteConfig(rectangles=1 + seed % 3, **side)))
    assert_hung_beside_stalls(garage.layout)
    for mounted in MOUNTED:
        at = np.array([place.position_m for place in garage.layout.of_kind(mounted.kind.name)])[:, [0, 2]]
        distances = cdist(places(garage.layout), at, "cityblock" if mounted.is_walked else "euclidean")
        assert (np.sort(distances, axis=1)[:, mounted.count - 1] <= mounted.reach_m).all()


def assert_hung_beside_stalls(layout):
    """No triangle of what hangs is over the ground for a car below its roof, and none of a kind hang side by side."""
    stalls = shapely.STRtree([shapely.Polygon(stall.rectangle_m()).buffer(-1e-4) for stall in layout.stalls])
    for mounted in MOUNTED:
        hung = layout.of_kind(mounted.kind.name)
        assert hung
        points = np.concatenate([part.points for part in mounted.spec.asset().parts])
        for place in hung:
            over = [place.to_world((x, z)) for x, y, z in points.tolist() if y < 2.0]
            assert not len(stalls.query(shapely.convex_hull(shapely.MultiPoint(over)), predicate="intersects")), place
        at = np.array([place.position_m for place in hung])
        apart = cdist(at, at) + np.where(np.eye(len(at)), np.inf, 0.0)
        assert apart.min() > 2.9, hung[int(apart.min(axis=0).argmin())]


@pytest.mark.parametrize("text", [PLAN, SMALL], ids=["loop", "small"])
def test_nothing_solid_meets_what_hangs_on_walls_and_columns(text):
    layout, config = laid_out(text)
    assert_solid_objects_keep_apart(layout, config)
