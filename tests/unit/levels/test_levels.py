"""Garages of several levels: settings, their random process, files, and what refuses them."""

import json
import re
from collections import Counter

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Usd
from support.edited_stages import (
    chosen,
    copied,
    edited,
    hidden,
    inactive,
    moved,
    referring,
    without_what_lanes_do_without,
)

import garage2usd
from garage2usd import ConfigError, GarageConfig, GenerationError
from garage2usd.as_built.garage import garage_as_made, garage_of_file, garage_of_stage
from garage2usd.as_built.proofs import floors_m_of_stalls, prove_built
from garage2usd.checks import findings_of, usd
from garage2usd.checks.levels import findings_of_whole
from garage2usd.cli import main
from garage2usd.common.errors import Garage2UsdError, StageError
from garage2usd.config.site import RampsPlace
from garage2usd.garage_sources import read_built
from garage2usd.maps.drives import DrivePlanner
from garage2usd.maps.level_networks import level_networks
from garage2usd.reading.files import open_stage
from garage2usd.reading.report import read_report
from garage2usd.site import make_site
from garage2usd.site.levels import draw_ramps, make_level_sites
from garage2usd.stage.curves import write_driving_layer
from garage2usd.structure.building import Building, Flight, level_cells
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.stalls import Edge, door_edges

SMALL = {
    "seed": 5,
    "site": {"width_cells": 9, "height_cells": 9},
    "bay": {"square_side_m": 8.1},
    "plan": {"episodes": 60, "starts": 1},
    "parking": {"occupancy": 0.1},
}


U2 = "/Garage/Levels/U2"


def config(levels=2, **changes):
    return GarageConfig(**{**SMALL, "building": {"levels": levels}, **changes})


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build(config(), tmp_path_factory.mktemp("levels") / "garage.usdz")


def test_one_level_is_what_it_was_before_there_were_several():
    plain = GarageConfig(**SMALL)
    assert "building" not in plain.model_dump(mode="json")
    assert GarageConfig(**SMALL, building={}).digest() == plain.digest() != config().digest()


@pytest.mark.parametrize("way", Edge)
def test_ramps_are_a_road_of_two_lanes_beside_one_another(way):
    right, left = Flight((5, 5), way, 3), Flight((5, 5), way, 3, keeps_left=True)
    down, up = right.links
    assert down.is_down
    assert not up.is_down
    assert up.squares == tuple(right.aside.beyond(square) for square in down.squares)
    step = np.subtract(down.foot, down.head) / 4
    aside = np.subtract(up.head, down.head)
    # facing down, with rows downwards, the oncoming lane is on the left
    assert step[0] * aside[1] - step[1] * aside[0] == 1
    assert left.aside is right.aside.opposite


def test_landings_are_portals_and_ramps_obstacles_of_the_levels_that_they_join():
    cells = np.zeros((9, 9), dtype=np.int8)
    cells[0, 0] = Cell.ENTRANCE
    flight = Flight((1, 3), Edge.DOWN, 4)
    down, up = flight.links
    top, middle, bottom = (level_cells(cells, flight, level, 3) for level in range(3))
    for level in (top, middle, bottom):
        assert all(level[square] == Cell.OBSTACLE for square in flight.squares)
    assert (top[down.head], top[up.head], top[down.foot], top[0, 0]) == (3, 2, 0, 2)
    assert (middle[down.head], middle[up.head], middle[down.foot], middle[up.foot], middle[0, 0]) == (3, 2, 2, 3, 0)
    assert (bottom[down.head], bottom[up.head], bottom[down.foot], bottom[up.foot]) == (0, 0, 2, 3)


def test_levels_that_do_not_stand_above_one_another_are_refused():
    flight = Flight((1, 3), Edge.DOWN, 4)
    cells = level_cells(np.zeros((9, 9), dtype=np.int8), flight, 0, 2)
    with pytest.raises(ConfigError, match=r"levels\[1\]\.R.*the sides of the top level"):
        Building((Structure.from_arrays(cells, 8.1, 8.1), Structure.from_arrays(cells, 8.2, 8.1)), flight, 3.6)
    with pytest.raises(ConfigError, match=r"levels\[0\]\.S.*on each square of a ramp"):
        Building((Structure.from_arrays(np.zeros((9, 9), dtype=int), 8.1, 8.1),), flight, 3.6)


def test_the_tape_makes_the_same_garage_and_seeds_other_ramps(built):
    again = garage2usd.generate(config(), tape=built.garage.tape)
    assert again.building.levels == built.garage.building.levels
    assert again.building.ramps == built.garage.building.ramps
    assert again.tape == built.garage.tape
    flights = {garage2usd.generate(config(), seed=seed).building.ramps for seed in (1, 2, 3)}
    assert len(flights) > 1
    with pytest.raises(ConfigError, match=r"tape: .*the tapes of 2 levels"):
        garage2usd.generate(config(), tape="S")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"building": {"levels": 2, "storey_m": 3.3}}, r"building.storey_m: got 3.3; allowed: at least 0.25 m over"),
        ({"plan": {"one_way": [[[0, 0], [0, 1]]]}}, r"plan.one_way: .* it names no level"),
        ({"site": {"structure": "....\nE==X\n...."}, "bay": {}}, r"no lanes with building.levels of 2 or more"),
        ({"building": {"levels": 7}}, r"building.levels: got 7"),
    ],
)
def test_settings_that_do_not_go_together_are_named(changes, said):
    with pytest.raises(ConfigError, match=said):
        garage2usd.generate(GarageConfig(**{**SMALL, "building": {"levels": 2}, **changes}))


@pytest.mark.parametrize(
    ("building", "squares"),
    [
        ({"place": {"square": [2, 4], "way": "down"}}, {(row, col) for row in range(3, 7) for col in (4, 5)}),
        ({"place": {"square": [7, 4], "way": "up", "count": 5}}, {(row, col) for row in range(2, 7) for col in (3, 4)}),
        (
            {"ramps": "helix", "place": {"square": [3, 2], "way": "down", "aside": "right"}},
            {(row, col) for row in range(3, 6) for col in range(2, 8)},
        ),
    ],
)
def test_ramps_lie_where_they_are_given(building, squares):
    site = {"width_cells": 10, "height_cells": 9, "entrance_cells": [[8, 0]], "exit_cells": [[8, 9]]}
    asked = GarageConfig(**{**SMALL, "site": site, "building": {"levels": 2, **building}})
    ramps = draw_ramps(make_site(asked.site, bay=asked.bay, seed=5), asked)
    assert set(ramps.squares) == squares
    assert ramps.links[0].is_down


@pytest.mark.parametrize("kind", ["straight", "helix"])
def test_landings_have_no_door_to_the_street(kind):
    """Where the contour is irregular, a landing could lie beside the outside, as street portals do."""
    drawn = 0
    for seed in range(24):
        site = {"width_cells": 12, "height_cells": 12, "rectangles": 3}
        asked = GarageConfig(**{**SMALL, "site": site, "building": {"levels": 2, "ramps": kind}})
        made = make_site(asked.site, bay=asked.bay, seed=seed)
        try:
            ramps = draw_ramps(made, asked.with_seed(seed))
        except GenerationError:
            continue
        drawn += 1
        below = level_cells(made.cells, ramps, 1, 2)
        assert (below >= Cell.ENTRANCE).sum() == 2
        assert door_edges(below) == {}
    assert drawn > 4


@pytest.mark.parametrize(
    ("building", "said"),
    [
        ({"place": {"square": [0, 4], "way": "up"}}, "building.place"),
        ({"place": {"square": [2, 4], "way": "down", "count": 3}}, "ramps of 28.2 m, two squares wide"),
        ({"ramps": "helix", "place": {"square": [3, 2], "way": "down", "aside": "right", "count": 6}}, "3 x 3 squares"),
    ],
)
def test_given_ramps_without_room_are_refused_by_name(building, said):
    with pytest.raises(ConfigError, match=said):
        garage2usd.generate(GarageConfig(**{**SMALL, "building": {"levels": 2, **building}}))


@pytest.mark.parametrize(
    ("building", "said"),
    [
        ({"place": {"square": [2, 4], "way": "down", "aside": "left"}}, "only with ramps = 'helix'"),
        ({"ramps": "helix", "place": {"square": [2, 4], "way": "down"}}, "left or right"),
        ({"ramps": "helix", "place": {"square": [2, 4], "way": "left", "aside": "right"}}, "down or up"),
    ],
)
def test_a_place_that_is_none_of_its_kind_is_refused(building, said):
    with pytest.raises(ConfigError, match=said):
        GarageConfig(building={"levels": 2, **building})


TIGHT = GarageConfig(
    seed=2399642001031412084,
    profile={"name": "none"},
    site={"width_cells": 9, "height_cells": 5},
    building={"levels": 2, "storey_m": 2.9, "ramp_slope_percent": 20, "ramp_transition_m": 2.0},
    plan={"episodes": 30, "starts": 1},
    fittings={"ceiling_height_m": 2.6},
)
"""A garage before whose first ramps cars would have to turn back from one row of squares into the next."""


@pytest.mark.soak
def test_ramps_are_drawn_elsewhere_where_cars_cannot_turn_into_them():
    first = make_level_sites(TIGHT).ramps
    garage = garage2usd.generate(TIGHT)
    assert garage.building.ramps != first
    assert garage.building.ramps in [make_level_sites(TIGHT, attempt).ramps for attempt in range(1, 4)]
    planner = DrivePlanner(garage_as_made(garage, source="a layout", kind="layout"))
    drive = planner.drive()
    assert drive.route.stall.startswith("U2/")
    assert (drive.route.entrance.name, drive.route.exit.name) == ("[4, 6]", "[1, 0]")
    # the tape makes that garage, and the first place is refused where it is given
    again = garage2usd.generate(TIGHT, tape=garage.tape).building
    assert (again.ramps, again.levels) == (garage.building.ramps, garage.building.levels)
    square, way, _, count = first.place
    place = {"square": square, "way": way.name.lower(), "count": count}
    given = TIGHT.model_copy(update={"building": TIGHT.building.model_copy(update={"place": RampsPlace(**place)})})
    with pytest.raises(ConfigError, match=r"building\.place.*room to turn before the ramps.*U2/"):
        garage2usd.generate(given)


def test_a_site_without_room_for_ramps_says_so():
    small = {"width_cells": 6, "height_cells": 6}
    with pytest.raises(GenerationError, match=r"ramps of 28.2 m, two squares wide.*find no place on 6 x 6"):
        garage2usd.generate(config(site=small))


@pytest.mark.parametrize(
    ("seed", "cells", "ramps", "told"),
    [
        (1, (6, 5), "straight", "room for 1 level, and one of 5 x 9 squares or a steeper"),
        (2, (9, 5), "helix", 'room for building.ramps = "straight", and one of 6 x 10 squares or a steeper'),
        (1, (9, 5), "straight", "one of 5 x 9 squares with its doors and obstacles elsewhere or"),
    ],
)
def test_a_site_without_room_for_ramps_says_what_has_room(seed, cells, ramps, told):
    site = dict(zip(("width_cells", "height_cells"), cells, strict=True))
    building = {"levels": 2, "ramps": ramps}
    with pytest.raises(GenerationError) as refused:
        garage2usd.generate(GarageConfig(seed=seed, site=site, building=building))
    assert told in str(refused.value)
    (rows, cols) = map(int, re.findall(r"one of (\d+) x (\d+) squares", str(refused.value))[0])
    larger = {"width_cells": cols, "height_cells": rows}
    made = garage2usd.generate(GarageConfig(seed=3, site=larger, building=building))
    assert len(made.levels) == 2


def test_files_are_the_same_every_time_but_for_seconds(built, tmp_path):
    again = garage2usd.build(config(), tmp_path / "garage.usdz")
    assert again.stage.read_bytes() == built.stage.read_bytes()
    assert again.labels.read_bytes() == built.labels.read_bytes()
    first, second = (json.loads(made.report.read_text()) for made in (built, again))
    assert first.pop("seconds").keys() == second.pop("seconds").keys()
    assert first == second


def test_the_report_and_labels_name_each_level(built):
    report = read_report(built.report)
    assert [(level.name, level.floor_m) for level in report.levels] == [("U1", 0.0), ("U2", -3.6)]
    assert report.parking_stalls == sum(level.parking_stalls for level in report.levels)
    assert [(link.upper, link.lower, link.direction) for link in report.links] == [
        ("U1", "U2", "down"),
        ("U1", "U2", "up"),
    ]
    assert all(link.steepest_percent <= 15 and link.rise_m == 3.6 for link in report.links)
    table = json.loads(built.labels.read_text())
    stage = Usd.Stage.Open(str(built.stage))
    paths = [f"{parent}/{row[0]}" for parent, rows in table["objects"].items() for row in rows]
    ids = [row[1] for rows in table["objects"].values() for row in rows]
    assert sorted(ids) == list(range(1, len(ids) + 1))
    assert {path.split("/")[3] for path in paths} == {"U1", "U2"}
    assert all(stage.GetPrimAtPath(path) for path in paths if "[" not in path)


def test_variants_reach_all_levels(built):
    stage = Usd.Stage.Open(str(built.stage))
    root = stage.GetDefaultPrim()
    cars = [prim.GetPath() for prim in stage.Traverse() if prim.GetName().startswith("Car_")]
    assert {str(path).split("/")[3] for path in cars} == {"U1", "U2"}
    root.GetVariantSet("occupancy").SetVariantSelection("empty")
    assert not any(stage.GetPrimAtPath(path).IsActive() for path in cars)
    root.GetVariantSet("level").SetVariantSelection("U2")
    shown = {
        name: stage.GetPrimAtPath(f"/Garage/Levels/{name}").GetAttribute("visibility").Get() for name in ("U1", "U2")
    }
    assert shown["U1"] == "invisible"
    assert shown["U2"] != "invisible"


def test_check_finds_nothing_and_a_lost_ramp_is_found(built):
    garage, profile, *_ = read_built(built.stage)
    assert [finding.rule for finding in findings_of(garage, profile) if finding.severity.value == "error"] == []
    stage = open_stage(built.stage)
    stage.SetEditTarget(stage.GetSessionLayer())
    edges = stage.GetPrimAtPath("/Garage/LaneGraph/Edges")
    levels = stage.GetPrimAtPath("/Garage/LaneGraph/Nodes").GetAttribute("garage:lane:level").Get()
    starts, ends = (list(edges.GetAttribute(f"garage:lane:{name}").Get()) for name in ("from", "to"))
    up = [number for number, (one, other) in enumerate(zip(starts, ends, strict=True)) if levels[one] > levels[other]]
    for number in up:
        ends[number] = starts[number]
    edges.GetAttribute("garage:lane:to").Set(ends)
    found = findings_of_whole(garage_of_stage(stage, source=str(built.stage)), profile)
    lost = {finding.place for finding in found if finding.rule == "level-route"}
    assert lost == {stall.name for stall in garage.stalls if stall.level == 1}


@pytest.fixture(scope="module")
def bare(built, tmp_path_factory):
    """The garage without what its lanes and ramps are not read from."""
    return edited(built.stage, tmp_path_factory.mktemp("bare") / "bare.usda", without_what_lanes_do_without)


@pytest.fixture(scope="module")
def unmoved(bare):
    return read_built(bare).garage


def test_a_building_that_is_moved_and_hidden_is_read_as_it_stands(bare, unmoved, tmp_path):
    away = edited(
        bare,
        tmp_path / "away.usda",
        moved(x=100, y=-0.5, z=7, yaw_deg=30),
        chosen(level="U1", ceiling="hidden"),
        hidden("/Garage", "/Garage/Levels/U1"),
    )
    tipped = edited(bare, tmp_path / "tipped.usda", moved(y=40, pitch_deg=90), hidden("/Garage/Levels", U2))
    z_up = referring(bare, tmp_path / "z_up.usda", up="Z", metres_per_unit=0.01, move=(5, 6, -300), yaw_deg=70)
    last = unmoved.stalls[-1].name
    drive = DrivePlanner(unmoved).drive(last).trajectory
    for file in (away, tipped, z_up):
        garage, profile, *_ = read_built(file)
        assert garage.faults == ()
        assert findings_of_whole(garage, profile) == []
        assert [stall.name for stall in garage.stalls] == [stall.name for stall in unmoved.stalls]
        places = [(*node.position, node.height_m) for node in garage.lanes.nodes]
        told = [(*node.position, node.height_m) for node in unmoved.lanes.nodes]
        assert np.abs(np.subtract(places, told)).max() < 1e-6
        driven = DrivePlanner(garage).drive(last).trajectory
        for name in ("time_s", "x_m", "y_m", "z_m", "pitch_rad"):
            assert np.abs(getattr(driven, name) - getattr(drive, name)).max() < 1e-6, name
        assert garage.lanes.edges == unmoved.lanes.edges
        assert [thing.name.rpartition("/")[2] for thing in garage.things] == [
            thing.name.rpartition("/")[2] for thing in unmoved.things
        ]


MISFITS = {
    "a level is inactive": (inactive(U2), {"level-missing", "level-ramp"}),
    "the top level is inactive": (inactive("/Garage/Levels/U1"), {"level-missing", "level-ramp", "level-route"}),
    "no ramp": (inactive(f"{U2}/Ramps"), {"level-ramp", "level-route"}),
    "one ramp is gone": (inactive(f"{U2}/Ramps/Ramp_Up"), {"level-ramp", "level-route"}),
    "a ramp is shifted": (moved(x=0.6, path=f"{U2}/Ramps/Ramp_Down"), {"level-ramp", "level-route"}),
    "a ramp is lifted": (moved(y=-0.4, path=f"{U2}/Ramps/Ramp_Down"), {"level-ramp", "level-route"}),
    "a level is shifted": (moved(x=5, path=U2), {"level-moved", "level-ramp", "level-route"}),
    "a level is lifted": (moved(y=1.6, path=U2), {"level-moved", "level-height", "level-ramp", "level-route"}),
    "a level is turned": (moved(yaw_deg=20, path=U2), {"level-moved", "level-ramp", "level-route"}),
    "a level is copied": (copied("U2", "U3", -7.2), {"level-ramp", "level-route"}),
    "no lanes": (inactive("/Garage/LaneGraph"), {"lane-graph", "level-ramp", "level-route"}),
}


@pytest.mark.parametrize(("edit", "rules"), MISFITS.values(), ids=MISFITS)
def test_levels_and_ramps_that_do_not_fit_are_found_and_not_driven_on(edit, rules, bare, tmp_path):
    garage, profile, *_ = read_built(edited(bare, tmp_path / "edited.usda", edit))
    found = {finding.rule for finding in findings_of_whole(garage, profile) if finding.severity.value == "error"}
    assert found - {"portal-count"} == rules
    planner = DrivePlanner(garage)
    lost = [stall.name for stall in garage.stalls if stall.takes_cars and stall.access not in garage.lanes.driven]
    assert bool(lost) == ("level-route" in rules)
    for name in lost[-1:]:
        with pytest.raises(ConfigError, match="that lanes and ramps join with the street"):
            planner.drive(name)
    level_networks(garage)


def test_a_building_without_an_active_level_is_one_line(bare, tmp_path):
    file = edited(bare, tmp_path / "edited.usda", inactive("/Garage/Levels"))
    with pytest.raises(StageError, match="/Garage/Levels has no active level"):
        read_built(file)


def test_a_drive_goes_down_the_ramp_into_a_stall_and_back_to_the_street(built):
    garage = garage_of_file(built.stage)
    planner = DrivePlanner(garage)
    for stall in (stall for stall in garage.stalls if stall.level == 1 and stall.takes_cars):
        try:
            states = planner.drive(str(stall.number)).trajectory
        except ConfigError:
            continue
        break
    assert states.y_m.min() == pytest.approx(-3.6, abs=1e-3)
    assert states.y_m[[0, -1]].min() > 3.0
    assert np.abs(np.degrees(states.pitch_rad)).max() == pytest.approx(np.degrees(np.arctan(0.15)), abs=1.6)
    moved = np.sqrt(np.diff(states.x_m) ** 2 + np.diff(states.y_m) ** 2 + np.diff(states.z_m) ** 2)
    assert np.abs(moved - np.diff(states.arc_m)).max() < 1e-3
    with pytest.raises(ConfigError, match=r"stalls: U1/A1-01 to "):
        planner.drive("B2-07")


def test_every_stall_of_all_levels_is_proven_and_its_way_lies_on_the_floor_of_its_level(built, tmp_path):
    files = {end: tmp_path / f"ways.{end}" for end in ("json", "usda")}
    whole = garage_of_file(built.stage)
    ran = CliRunner().invoke(main, ["drive", str(built.stage), "-o", str(files["json"])])
    assert ran.exit_code == 0, ran.output
    write_driving_layer(files["usda"], prove_built(whole), floors_m=floors_m_of_stalls(whole))
    floors = {stall.name: -3.6 * stall.level for stall in whole.stalls if stall.takes_cars}
    ways = {stall["name"]: stall for stall in json.loads(files["json"].read_text())["stalls"]}
    assert {name: way["floor_m"] for name, way in ways.items()} == pytest.approx(floors)
    assert all(way["proven"] for way in ways.values())
    # each way ends in its own stall
    for stall in (stall for stall in whole.stalls if stall.takes_cars):
        x, z = ways[stall.name]["in"]["poses"][-1][1:3]
        assert np.hypot(x - stall.centre[0], z - stall.centre[1]) < 3.0
    layer = Usd.Stage.Open(str(files["usda"]))
    curves = layer.GetPrimAtPath("/Garage/Ways/In")
    names, counts = (list(curves.GetAttribute(name).Get()) for name in ("garage:way:stall", "curveVertexCounts"))
    heights = np.split(np.array(curves.GetAttribute("points").Get())[:, 1], np.cumsum(counts)[:-1])
    for name, height in zip(names, heights, strict=True):
        assert height == pytest.approx(np.full(len(height), floors[name] + 0.06), abs=1e-5)


def test_below_a_ramp_that_leads_nowhere_no_stall_is_proven(built):
    stage = open_stage(built.stage)
    stage.SetEditTarget(stage.GetSessionLayer())
    edges, nodes = (stage.GetPrimAtPath(f"/Garage/LaneGraph/{name}") for name in ("Edges", "Nodes"))
    levels = nodes.GetAttribute("garage:lane:level").Get()
    starts, ends = (list(edges.GetAttribute(f"garage:lane:{name}").Get()) for name in ("from", "to"))
    for number, (one, other) in enumerate(zip(starts, ends, strict=True)):
        if levels[one] > levels[other]:
            ends[number] = one
    edges.GetAttribute("garage:lane:to").Set(ends)
    whole = garage_of_stage(stage, source=str(built.stage))
    shut = prove_built(whole)
    assert {proof.stall.partition("/")[0] for proof in shut if not proof.is_proven} == {"U2"}
    assert {proof.stall.partition("/")[0] for proof in shut if proof.is_proven} == {"U1"}


def test_one_road_makes_one_level_and_several(built):
    assert [level.name for level in built.garage.levels] == ["U1", "U2"]
    assert {stall.name.partition("/")[0] for stall in built.garage.stalls} == {"U1", "U2"}
    for field in ("site", "plan", "graph", "layout"):
        with pytest.raises(Garage2UsdError, match=rf"garage of 2 levels.*levels\[i\]\.{field}"):
            getattr(built.garage, field)
    one = garage2usd.generate(GarageConfig(seed=1, site={"structure": "....\nE==X\n...."}))
    (level,) = one.levels
    assert (level.layout, level.plan, level.site, level.graph) == (one.layout, one.plan, one.site, one.graph)
    assert one.building.ramps is None
    assert one.stalls == one.layout.quads


def test_plans_of_all_levels_make_their_garage_again(built):
    again = garage2usd.generate(config(), plan=built.garage.plans, jobs=2)
    assert again.building.ramps == built.garage.building.ramps
    assert again.building.levels == built.garage.building.levels
    assert again.stalls == built.garage.stalls
    with pytest.raises(ConfigError, match="2, one for each level"):
        garage2usd.generate(config(), plan=built.garage.plans[:1])
    with pytest.raises(ConfigError, match="plans made with these settings"):
        garage2usd.generate(config(), plan=built.garage.plans, seed=6)


def _ran(*arguments, code=0):
    ran = CliRunner().invoke(main, [str(argument) for argument in arguments])
    assert ran.exit_code == code, f"{ran.output} {ran.exception!r}"
    return ran


def test_a_report_of_levels_that_is_edited_has_findings_on_the_level(built, tmp_path):
    report = json.loads(built.report.read_text())
    gone = report["levels"][1]["stalls"].pop()
    (tmp_path / "a_report.json").write_text(json.dumps(report))
    (lost,) = (each for each in garage2usd.check(tmp_path / "a_report.json")[0] if each.severity == "error")
    assert (lost.rule, lost.place) == ("report-stalls", f"U2/{gone['name']}")
    _ran("plan", tmp_path / "a_report.json", "--findings", "-o", tmp_path / "a.svg")
    said = {name: (tmp_path / f"a_{name}.svg").read_text().count("report-stalls") for name in ("U1", "U2")}
    assert said == {"U1": 0, "U2": 1}
    del report["levels"][1]["floor_m"]
    (tmp_path / "a_report.json").write_text(json.dumps(report))
    ran = _ran("check", tmp_path / "a_report.json", code=1)
    assert "not a report of a build: levels.1.floor_m: Field required" in " ".join(ran.output.split())


def test_the_route_to_a_stall_is_drawn_on_each_level_that_it_leads_over(built, tmp_path):
    stall = next(stall for stall in built.garage.stalls if stall.level == 1 and stall.number)
    for name, number in (("a", stall.name), ("b", str(stall.number).lower())):
        _ran("plan", built.stage, "--stall", number, "-o", tmp_path / f"{name}.svg")
    for level, chosen_stalls in (("U1", 0), ("U2", 1)):
        drawn = (tmp_path / f"a_{level}.svg").read_text()
        assert drawn == (tmp_path / f"b_{level}.svg").read_text()
        assert drawn.count('class="chosen"') == chosen_stalls
        assert min(drawn.count('class="way in"'), drawn.count('class="way out"')) >= 1
    ran = _ran("plan", built.stage, "--stall", "A1-01", "-o", tmp_path / "c.svg", code=1)
    assert "numbers as U1/" in ran.output


def test_one_command_builds_levels_with_exports_and_pictures_of_learning_on_each(built, tmp_path):
    settings = tmp_path / "two.toml"
    sections = {name: value for name, value in SMALL.items() if isinstance(value, dict)} | {"building": {"levels": 2}}
    lines = ["seed = 5"]
    for section, values in sections.items():
        lines += [f"[{section}]", *(f"{key} = {value}" for key, value in values.items())]
    settings.write_text("\n".join(lines))
    asked = ("--with", "xodr", "--learning-curve", "--best-plans", 2, "--jobs", 2, "--verbose")
    ran = _ran("build", settings, "-o", tmp_path / "garage.usdz", *asked)
    assert (tmp_path / "garage.usdz").read_bytes() == built.stage.read_bytes()
    names = [f"garage_{level}_{what}.png" for level in ("U1", "U2") for what in ("plan", "learning", "best")]
    assert {*names, "garage.xodr"} <= {path.name for path in tmp_path.iterdir()}
    logged = [line.partition(":")[0] for line in ran.stderr.splitlines() if line.endswith(" s")]
    assert logged == ["site", "plan", "layout", "stage", "check"]
    _ran("export", tmp_path / "garage_report.json", "-o", tmp_path / "again.xodr")
    again = (tmp_path / "again.xodr").read_text()
    assert again == (tmp_path / "garage.xodr").read_text().replace('name="garage"', 'name="garage_report"')
    stall = built.garage.stalls[-1].name
    driven = _ran("drive", tmp_path / "garage_report.json", "--stall", stall, "--leg", "in").stdout
    assert "from the portal" in driven
    proven = _ran("drive", settings).stdout
    assert proven.startswith(f"{built.garage.parking_stalls} of {built.garage.parking_stalls} stalls")
    ran = _ran("build", settings, "-o", tmp_path / "b.usdc", "--tape", built.garage.tape, "--best-plans", 1, code=1)
    assert "best_plans: got 1; allowed: only where lanes are learnt" in ran.output


def test_a_garage_its_stage_and_its_report_are_checked_and_driven_alike(built):
    of_usd = {rule.name for rule in usd.BOOK.rules}
    found, driven = [], []
    for source in (built.garage, built.stage, built.report):
        findings, profile = garage2usd.check(source)
        assert profile.name == built.garage.config.standard.name
        found.append(Counter(finding.rule for finding in findings if finding.rule not in of_usd))
        driven.append(garage2usd.drive(source))
    assert found == found[:1] * 3
    assert len({drive.route.stall for drive in driven}) == 1
    assert driven[0].route.stall.startswith("U2/")
    ends_s = [drive.motion.ends_s for drive in driven]
    assert ends_s == pytest.approx(ends_s[:1] * 3, abs=0.01)


@pytest.mark.parametrize(("seed", "width", "height"), [(7, 9, 8), (8, 10, 10)])
def test_lanes_on_a_seam_of_their_ramp_have_its_floor(seed, width, height, tmp_path):
    # the middle lies on an edge between two triangles, beside both by the rounding of a stage
    site, plan = {"width_cells": width, "height_cells": height}, {"episodes": 60, "starts": 1}
    config = GarageConfig(seed=seed, building={"levels": 2}, site=site, plan=plan, parking={"occupancy": 0.0})
    assert garage2usd.check(garage2usd.build(config, tmp_path / "two.usdc").stage)[0] == []
