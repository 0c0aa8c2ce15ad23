import json
import math
from collections import Counter
from dataclasses import replace

import numpy as np
import pytest
import shapely
from pxr import Usd, UsdShade
from support.benchmarks import benchmark
from support.footprints import footprint
from support.overlaps import Solids
from support.soak import soak_but

from garage2usd.assets import MATERIALS
from garage2usd.checks import check_layout
from garage2usd.common.errors import ConfigError
from garage2usd.common.randomness import Step, named_generator
from garage2usd.config import GarageConfig, ParkingConfig, config_from_mapping
from garage2usd.config.markets import MARKET_NAMES, load_market, market_of
from garage2usd.config.vehicles import CAR_BODIES, PAINTS, SEGMENTS, body_named
from garage2usd.driving import prove_stalls
from garage2usd.layout import lay_out
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.parking.fleet import Fleet
from garage2usd.layout.parking.parked_cars import fitting, park_cars
from garage2usd.layout.parking.stalls import stalls_of
from garage2usd.layout.tiles import TileGrid
from garage2usd.maps.facts import StallFacts
from garage2usd.objects.car import CarSpec
from garage2usd.pipeline import build, generate
from garage2usd.reading.lanes import read_lanes
from garage2usd.sensors.slots import read_slots
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

PLAN = """
..........
.========.
E=..==..=X
.========.
..........
"""
GARAGES = 500
fleet = benchmark("fleet")
posture, body_ground = fleet.posture, fleet.body_ground


def plan(config):
    structure = Structure.from_arrays(cells_from_text(PLAN, field="S"), *[3 * config.bay.stall_width_m + 0.9] * 2)
    graph = build_lane_graph(structure, config.bay)
    grid = TileGrid(structure, graph, config.bay)
    return grid, stalls_of(grid, graph)


def parked(config, garages=GARAGES):
    """The cars of many garages with one plan, and their stalls by name."""
    grid, stalls = plan(config)
    found = [park_cars(stalls, config, SquareDraws(grid.tiles, seed=seed)) for seed in range(garages)]
    return found, {stall.name: stall for stall in stalls}


@pytest.mark.soak
@pytest.mark.parametrize(
    ("profile", "market", "stall"),
    [("de-garvo", "germany", (2.5, 5.5)), ("us-ada", "usa", (2.75, 5.6)), ("cn-jgj100", "china", (2.5, 5.5))],
)
def test_five_hundred_garages_have_the_shares_of_their_market(profile, market, stall):
    """Bodies, paints, cars nose out and over a line, each to a point of the table."""
    bay = {"stall_width_m": stall[0], "stall_length_m": stall[1], "square_side_m": 8.6}
    garages, stalls = parked(GarageConfig(profile=profile, bay=bay))
    cars = [car for each in garages for car in each.cars]
    table = load_market(market)
    segments = Counter(body_named(car.spec.body).segment for car in cars)
    there = {body.segment for body in CAR_BODIES}
    total = sum(share for segment, share in table.segments.shares.items() if segment in there)
    for segment in SEGMENTS:
        wanted = table.segments.shares.get(segment, 0) / total if segment in there else 0
        assert segments[segment] / len(cars) == pytest.approx(wanted, abs=0.01), segment
    paints = Counter(car.spec.paint for car in cars)
    for paint in PAINTS:
        assert paints[paint] / len(cars) == pytest.approx(table.paints.shares.get(paint, 0), abs=0.01), paint
    noses_out = sum(posture(car, stalls[car.stall])[2] for car in cars)
    assert noses_out / len(cars) == pytest.approx(table.reversed.share, abs=0.01)
    over = sum(not shapely.Polygon(stalls[car.stall].corners_m()).covers(body_ground(car)) for car in cars)
    assert over / len(cars) == pytest.approx(0.02, abs=0.01)
    assert over == sum(len(each.reaching) for each in garages)


@pytest.mark.soak
def test_whole_garages_of_all_profiles_have_the_shares_of_the_world():
    """Each share to four standard deviations of its binomial distribution; benchmarks/fleet.py takes 500 garages."""
    layouts = [generate(fleet.garage_config(number, "world")).layout for number in range(24)]
    assert len({(stall.width_m, stall.length_m) for layout in layouts for stall in layout.stalls}) >= 4
    cars = [car for layout in layouts for car in fleet.parked_in(layout)]
    assert len(cars) > 1000
    for name, wanted, found in fleet.shares_of(cars, "world"):
        assert abs(found - wanted) < 4 * math.sqrt(wanted * (1 - wanted) / len(cars)), name


@pytest.mark.parametrize("stall", [(2.3, 4.8), (2.4, 4.8), (2.4, 5.0), (2.4, 5.3), (2.5, 5.5), (2.75, 5.6)])
@pytest.mark.parametrize("is_reversed", [False, True])
def test_a_body_of_each_class_fits_into_every_usual_stall(stall, is_reversed):
    """So no class gives its share to others."""
    bodies = fitting(*stall, is_reversed=is_reversed)
    assert {body.segment for body in bodies} == set(SEGMENTS)
    assert len({body.length_m for body in bodies}) > 12


def test_cars_stand_beside_and_aslant_as_people_leave_them():
    """In wide stalls by the asked spreads; in narrow ones lines and neighbours cut the normal distribution."""
    wide = GarageConfig(bay={"stall_width_m": 3.0, "square_side_m": 9.9}, parking={"over_line": 0})
    narrow = GarageConfig(parking={"over_line": 0})
    for config, least_m in ((wide, 0.14), (narrow, 0.08)):
        garages, stalls = parked(config)
        sides, yaws, _ = np.array([posture(car, stalls[car.stall]) for each in garages for car in each.cars]).T
        assert least_m < sides.std() < 0.152
        assert 1.0 < yaws.std() < 1.25
        # a row of few cars is not the same to both sides: 500 garages of one plan
        assert abs(sides.mean()) < 0.015
        assert abs(yaws.mean()) < 0.03
        assert np.abs(yaws).max() <= 4.0


def test_no_spread_stands_cars_in_the_middle():
    garages, stalls = parked(GarageConfig(parking={"lateral_spread_m": 0, "yaw_spread_deg": 0, "over_line": 0}), 5)
    for car in (car for each in garages for car in each.cars):
        side_m, yaw_deg, _ = posture(car, stalls[car.stall])
        assert (side_m, yaw_deg) == pytest.approx((0, 0), abs=1e-4)


@pytest.mark.parametrize("stall_width_m", soak_but([2.3], [2.3, 2.4, 2.75]))
def test_no_car_touches_another_or_leaves_the_length_of_its_stall(stall_width_m):
    """Not even in full garages with many over their lines; to the lane and the rear each keeps inside."""
    bay = {"stall_width_m": stall_width_m, "square_side_m": 8.6}
    parking = {"occupancy": 0.8, "over_line": 0.2, "misparked": 0.3, "yaw_spread_deg": 3, "max_yaw_deg": 5}
    garages, stalls = parked(GarageConfig(bay=bay, parking=parking), 60)
    far = 0
    for each in garages:
        grounds = [footprint(car) for car in each.cars]
        one, other = shapely.STRtree(grounds).query(grounds, predicate="dwithin", distance=0.098)
        assert (one == other).all()
        for car, ground in zip(each.cars, grounds, strict=True):
            stall = stalls[car.stall]
            beside = stalls[each.reaching.get(car.stall, car.stall)]
            own = shapely.Polygon(stall.corners_m())
            row = shapely.union_all([own, shapely.Polygon(beside.corners_m())]).convex_hull.buffer(0.11)
            assert row.covers(ground)
            assert own.intersection(body_ground(car)).area > 0.5 * body_ground(car).area
            mouth = shapely.LineString(stall.corners_m()[:2])
            rear = shapely.LineString(stall.corners_m()[2:])
            assert min(mouth.distance(ground), rear.distance(ground)) > 0.09
        far += len(each.misparked)
    assert far > 60


def test_the_next_garage_is_the_same_but_for_what_was_asked():
    """Shares, spreads and markets change neither which stalls are occupied nor one another."""
    usual = parked(GarageConfig(), 3)[0]
    taken = [[car.stall for car in each.cars] for each in usual]
    for parking in ({"market": "usa"}, {"over_line": 0.2}, {"misparked": 0.4}, {"lateral_spread_m": 0.05}):
        other = parked(GarageConfig(parking=parking), 3)[0]
        assert [[car.stall for car in each.cars] for each in other] == taken
    paints = [[car.spec.paint for car in each.cars] for each in usual]
    bodies = parked(GarageConfig(parking={"bodies": {"suv": 1}}), 3)[0]
    assert [[car.spec.paint for car in each.cars] for each in bodies] == paints
    assert {body_named(car.spec.body).segment for each in bodies for car in each.cars} == {"suv"}


def test_given_shares_take_the_place_of_the_markets():
    parking = {"bodies": {"suv": 0.6, "city": 0.2}, "paints": {"red": 1}, "reversed_share": 1.0}
    garages, stalls = parked(GarageConfig(parking=parking), 100)
    cars = [car for each in garages for car in each.cars]
    segments = Counter(body_named(car.spec.body).segment for car in cars)
    assert segments["suv"] / len(cars) == pytest.approx(0.75, abs=0.02)
    assert {car.spec.paint for car in cars} == {"red"}
    assert all(posture(car, stalls[car.stall])[2] for car in cars)


@pytest.mark.parametrize(
    ("parking", "message"),
    [
        ({"bodies": {"tank": 0.5}}, r"parking.bodies.*city, hatchback.*not of tank"),
        ({"paints": {"white": 0}}, r"parking.paints.*more than 0"),
        ({"market": "mars"}, r"parking.market.*'china'"),
        ({"over_line": 0.9}, r"parking.over_line"),
        ({"misparked": -1}, r"parking.misparked"),
    ],
)
def test_wrong_shares_are_named(parking, message):
    with pytest.raises(ConfigError, match=message):
        config_from_mapping({"parking": parking})


@pytest.mark.parametrize("name", MARKET_NAMES)
def test_the_tables_of_a_market_add_up(name):
    market = load_market(name)
    for shares in (market.segments.shares, market.paints.shares):
        assert sum(shares.values()) == pytest.approx(1)
    grey = sum(market.paints.shares[paint] for paint in ("white", "black", "grey", "silver"))
    assert 0.68 < grey < 0.85
    assert all(market_of(country) is market_of(country) == market for country in market.countries)


@pytest.mark.parametrize("seeds", soak_but(1, [range(2), range(2, 6)]))
def test_cars_over_a_line_leave_every_stall_proven(seeds):
    """Also with ten times as many as usual: who would be in the way stands between the lines instead."""
    leaning = 0
    for seed in seeds:
        garage = generate(GarageConfig(seed=seed, parking={"over_line": 0.2, "occupancy": 0.8}))
        leaning += len(garage.layout.reaching)
        assert not garage.layout.blocked
        assert all(proof.is_full for proof in prove_stalls(garage.layout))
        assert not list(Solids(garage.layout, ("car", "wheel_stop", "column", "wall", "cone")).clashes())
    assert leaning > 7 * len(seeds)


def test_a_car_that_would_be_in_the_way_of_a_proof_is_held_back():
    config = GarageConfig(seed=1, parking={"over_line": 0.2})
    garage = generate(config)
    name = next(iter(garage.layout.reaching))
    held = lay_out(garage.layout.structure, garage.graph, config, held_back={name})
    assert name not in held.reaching
    car = next(car for car in held.of_kind("car") if car.stall == name)
    stall = next(stall for stall in held.stalls if stall.name == name)
    assert shapely.Polygon(stall.corners_m()).covers(body_ground(car))


@pytest.mark.parametrize("seeds", soak_but(1, [range(2), range(2, 5)]))
def test_stalls_that_misparked_cars_block_are_told(seeds):
    """Exactly those are blocked that the design car does not get into, each by the car that reaches there."""
    told = 0
    for seed in seeds:
        garage = generate(GarageConfig(seed=seed, parking={"misparked": 0.15, "occupancy": 0.6}))
        layout = garage.layout
        proofs = {proof.stall: proof for proof in prove_stalls(layout)}
        assert {name for name, proof in proofs.items() if not proof.is_proven} == set(layout.blocked)
        occupied = dict(zip(layout.stalls.names(), layout.are_occupied().tolist(), strict=True))
        cars = {car.stall: car for car in layout.of_kind("car")}
        for stall, by in layout.blocked.items():
            assert occupied[stall]
            assert stall not in cars
            assert by in layout.misparked
            assert any(cars[by].name in name for name in proofs[stall].touched)
        told += len(layout.blocked)
    assert told > 2 * len(seeds)


def test_the_check_allows_cars_over_a_line_and_names_misparked_ones():
    for parking, rules in (({"over_line": 0.2}, set()), ({"misparked": 0.2}, {"car-outside-stall"})):
        garage = generate(GarageConfig(seed=2, parking=parking))
        findings = check_layout(garage.layout, garage.config)
        assert {finding.rule for finding in findings if finding.severity == "error"} == rules
        assert len(findings) >= len(garage.layout.misparked)


def test_files_tell_blocked_stalls(tmp_path):
    """Report, slots and lane graph tell the same; without cars no stall is blocked."""
    config = GarageConfig(
        seed=3, site={"width_cells": 7, "height_cells": 6}, parking={"misparked": 0.25, "market": "germany"}
    )
    built = build(config, tmp_path / "garage.usda")
    blocked = dict(built.garage.layout.blocked)
    assert blocked
    report = {
        stall["name"]: stall for stall in json.loads(built.report.read_text(encoding="utf-8"))["levels"][0]["stalls"]
    }
    assert {name: stall["blocked_by"] for name, stall in report.items() if "blocked_by" in stall} == blocked
    assert all(report[name]["occupied"] for name in blocked)
    stage = Usd.Stage.Open(str(built.stage))
    stalls = [slot.stall for slot in read_slots(stage).slots]
    assert {stall.name: stall.blocked_by for stall in stalls if stall.blocked_by} == blocked
    assert {stall.name: stall.is_occupied for stall in stalls} == {
        name: stall["occupied"] for name, stall in report.items()
    }
    facts = StallFacts(read_lanes(stage).stalls)
    assert not any(facts.facts(stall)["occupied"] for stall in facts.stalls)  # no cars are parked in them yet
    stage.GetDefaultPrim().GetVariantSet("occupancy").SetVariantSelection("empty")
    assert not any(slot.stall.is_occupied or slot.stall.blocked_by for slot in read_slots(stage).slots)


def test_lamps_glow_as_often_as_asked():
    asked = config_from_mapping({"parking": {"lit": 0.2, "occupancy": 0.9}})
    cars = [car.spec for found in parked(asked, 60)[0] for car in found.cars]
    assert sum(spec.is_lit for spec in cars) / len(cars) == pytest.approx(0.2, abs=0.02)
    usual = [car.spec for found in parked(GarageConfig(parking={"occupancy": 0.9}), 60)[0] for car in found.cars]
    assert [replace(spec, is_lit=False) for spec in cars] == usual
    lit, dark = (
        {part.name: part.material for part in CarSpec("saloon", "white", is_lit=glows).asset().parts}
        for glows in (True, False)
    )
    changed = {name: material for name, material in lit.items() if material != dark[name]}
    assert changed == {"HeadLamps": "lamp_front_lit", "TailLamps": "lamp_rear_lit"}
    assert all(any(MATERIALS[material].emissive_rgb) for material in changed.values())


def test_tail_lamps_of_the_lit_cars_of_a_stage_glow_and_no_others(tmp_path):
    config = GarageConfig(
        seed=3, site={"width_cells": 9, "height_cells": 8}, parking={"lit": 0.4, "dusty": 0.3, "occupancy": 0.95}
    )
    built = build(config, tmp_path / "garage.usda")
    lit = [car.spec.is_lit for car in built.garage.layout.of_kind("car")]
    stage = Usd.Stage.Open(str(built.stage))
    cars = [prim for prim in stage.Traverse() if prim.IsInstance() and prim.GetName().startswith("Car_")]
    glow = []
    for car in cars:
        lamps = next(
            prim for prim in Usd.PrimRange(car, Usd.TraverseInstanceProxies()) if prim.GetName() == "TailLamps"
        )
        material, _ = UsdShade.MaterialBindingAPI(lamps).ComputeBoundMaterial()
        colour = material.ComputeSurfaceSource()[0].GetInput("emissiveColor")
        glow.append(bool(colour) and max(colour.Get()) > 1)
    assert len(glow) == len(lit) > 20
    assert sum(glow) == sum(lit)
    assert 0.2 < sum(glow) / len(glow) < 0.6


def test_wheels_are_turned_and_flanks_dusty_as_often_as_asked():
    asked = config_from_mapping({"parking": {"turned_wheels": 0.3, "dusty": 0.2, "occupancy": 0.9}})
    cars = [car.spec for found in parked(asked, 60)[0] for car in found.cars]
    assert sum(bool(spec.steer_deg) for spec in cars) / len(cars) == pytest.approx(0.3, abs=0.02)
    assert sum(spec.is_dusty for spec in cars) / len(cars) == pytest.approx(0.2, abs=0.02)
    assert {spec.steer_deg for spec in cars} == {-20.0, -10.0, 0.0, 10.0, 20.0}
    usual = [car.spec for found in parked(GarageConfig(parking={"occupancy": 0.9}), 60)[0] for car in found.cars]
    assert [(spec.body, spec.paint) for spec in usual] == [(spec.body, spec.paint) for spec in cars]
    assert not any(spec.steer_deg or spec.is_dusty for spec in usual)


def test_a_garage_has_a_few_models_of_each_segment_and_garages_differ_in_them():
    shares = {"suv": 0.5, "saloon": 0.3, "city": 0.2}
    models = []
    for seed in range(4):
        ranks = named_generator(seed, Step.CARS, "models").random(len(CAR_BODIES)).tolist()
        fleet = Fleet(ParkingConfig(bodies=shares), "", ranks)
        drawn = [fleet.body_of(CAR_BODIES, share) for share in np.linspace(0, 0.9999, 1000)]
        counts = Counter(body.segment for body in drawn)
        assert {segment: counts[segment] / 1000 for segment in counts} == pytest.approx(shares, abs=0.01)
        assert Counter(body.segment for body in set(drawn)) == {"suv": 3, "saloon": 2, "city": 2}
        models.append(frozenset(drawn))
        every = Fleet(ParkingConfig(bodies=shares, more_models=100), "", ranks)
        drawn = {every.body_of(CAR_BODIES, share) for share in np.linspace(0, 0.9999, 1000)}
        assert drawn == {body for body in CAR_BODIES if body.segment in shares}
    assert len(set(models)) == len(models)
