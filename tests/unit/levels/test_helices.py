"""Helices between levels: where their squares and landings lie, what they refuse, and what readers make of them."""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from support.edited_stages import edited, inactive, moved, without_what_lanes_do_without

import garage2usd
from garage2usd import ConfigError, GarageConfig, GenerationError
from garage2usd.as_built.garage import garage_of_file
from garage2usd.checks.levels import findings_of_whole
from garage2usd.exports import export
from garage2usd.garage_sources import read_built
from garage2usd.maps.drives import DrivePlanner
from garage2usd.profiles import load_profile, read_profile
from garage2usd.reading.report import read_report
from garage2usd.site.levels import with_ramps_room
from garage2usd.structure.building import level_cells
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.helix import Helix
from garage2usd.structure.stalls import Edge

RAMPS = "/Garage/Levels/U2/Ramps"
SMALL = {
    "seed": 3,
    "site": {"width_cells": 10, "height_cells": 9},
    "bay": {"square_side_m": 8.1},
    "plan": {"episodes": 40, "starts": 1},
    "parking": {"occupancy": 0.0},
}


def config(levels=2, **changes):
    building = {"levels": levels, "ramps": "helix", **changes.pop("building", {})}
    return GarageConfig(**{**SMALL, "building": building, **changes})


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return garage2usd.build(config(), tmp_path_factory.mktemp("helices") / "garage.usdc")


@pytest.fixture(scope="module")
def bare(made, tmp_path_factory):
    """The garage without what its lanes and ramps are not read from."""
    return edited(made.stage, tmp_path_factory.mktemp("bare") / "bare.usda", without_what_lanes_do_without)


def ends(link):
    """Landing that cars leave, square of the corner, and landing that they reach; rows down, columns to the right."""
    corner = link.head_way.beyond(link.head)
    assert corner == link.foot_way.beyond(link.foot)
    return [
        np.array(each) for each in ((link.head, corner, link.foot) if link.is_down else (link.foot, corner, link.head))
    ]


@pytest.mark.parametrize("keeps_left", [False, True])
@pytest.mark.parametrize(("way", "aside"), [(way, aside) for way in Edge for aside in way.ends])
def test_cars_turn_with_the_driver_inside_and_leave_through_the_square_they_came_in_by(way, aside, keeps_left):
    helix = Helix((20, 20), way, aside, 3, keeps_left)
    down, up = helix.links
    assert (down.is_down, up.is_down) == (True, False)
    assert not {*down.squares} & {*up.squares}
    for link in (down, up):
        squares = np.array(link.squares)
        assert len({*link.squares}) == 9
        assert (np.ptp(squares, axis=0) == 2).all()
        start, corner, end = ends(link)
        entering, leaving = corner - start, end - corner
        # three quarters to the left end where a quarter to the right does; rows grow downwards
        to_the_right = np.array([entering[1], -entering[0]])
        assert (leaving == (-to_the_right if keeps_left else to_the_right)).all()
        # the block lies ahead of both landings
        assert any((square == corner + 2 * entering).all() for square in squares)
        assert any((square == corner - 2 * leaving).all() for square in squares)
        assert not {tuple(start), tuple(end)} & {*link.squares}


def test_landings_are_portals_and_blocks_obstacles_of_the_levels_that_they_join():
    helix = Helix((3, 3), Edge.DOWN, Edge.RIGHT, 3)
    down, up = helix.links
    cells = np.zeros((10, 12), dtype=np.int8)
    top, middle, bottom = (level_cells(cells, helix, level, 3) for level in range(3))
    assert all((level == Cell.OBSTACLE).sum() == 18 for level in (top, middle, bottom))
    assert (top[down.head], top[up.head], top[down.foot]) == (3, 2, 0)
    assert (middle[down.head], middle[up.head], middle[down.foot], middle[up.foot]) == (3, 2, 2, 3)
    assert (bottom[down.head], bottom[down.foot], bottom[up.foot]) == (0, 2, 3)


def test_the_tape_makes_the_same_helices_and_straight_ramps_are_another_tape(made):
    again = garage2usd.generate(config(), tape=made.garage.tape)
    assert again.building.ramps == made.garage.building.ramps
    assert again.tape == made.garage.tape
    with pytest.raises(ConfigError, match=r"tape: .*the tape of helix ramps"):
        garage2usd.generate(config(), tape="3,7,DOWN,4/S/S")


def test_helices_that_are_too_steep_or_have_no_place_are_refused_by_name():
    with pytest.raises(GenerationError, match=r"two helices side by side.*inner radius of 6 m.*find no place on 6 x 6"):
        garage2usd.generate(config(site={"width_cells": 6, "height_cells": 6}))
    with pytest.raises(GenerationError, match="at most 10 %"):
        garage2usd.generate(config(profile="uk-istructe", building={"storey_m": 5.0}))
    with pytest.raises(ConfigError, match=r"building.ramps: .*'straight'.*'helix'"):
        config(building={"ramps": "spiral"})


def test_chosen_sides_are_lengthened_until_the_circle_is_round_and_gentle():
    settings = config(bay={"dimensioned": True})
    site = Structure.from_arrays(np.zeros((12, 12), dtype=np.int8), 6.0, 6.0)
    helix = Helix((5, 3), Edge.DOWN, Edge.RIGHT, 3)
    wide = with_ramps_room(site, helix, settings)
    rows, cols = [5, 6, 7], [3, 4, 5, 6, 7, 8]
    assert (wide.row_depths_mm[rows] > site.row_depths_mm[rows]).all()
    assert (np.delete(wide.row_depths_mm, rows) == np.delete(site.row_depths_mm, rows)).all()
    assert (np.delete(wide.column_widths_mm, cols) == np.delete(site.column_widths_mm, cols)).all()
    for block in helix.blocks:
        line = block.line(wide, settings.fittings.wall_thickness_m)
        assert line.inner_radius_m >= 6.0
        assert 100 * line.inner_slope(3.6, 3.6) <= 12.0


def test_the_line_and_its_inverse_agree(made):
    (block, _) = made.garage.building.ramps.blocks
    line = block.line(made.garage.building.levels[0], 0.3)
    runs = np.linspace(0.0, line.length_m, 200)
    found, inwards = line.foot(*line.at(runs).beside(0.7).T)
    beside = np.hypot(*np.diff(line.at(runs).beside(0.0), axis=0).T)
    assert beside == pytest.approx(np.full(199, line.length_m / 199), rel=1e-3)
    # in the corner, where the line crosses itself, either pass is the nearest
    is_apart = (runs > line.corner[0] + 1) & (runs < line.length_m - line.corner[1] - 1)
    assert found[is_apart] == pytest.approx(runs[is_apart], abs=1e-6)
    assert inwards[is_apart] == pytest.approx(0.7, abs=1e-6)


def test_check_finds_nothing_and_a_stricter_clause_finds_both_helices(made):
    garage = garage_of_file(made.stage)
    profile = load_profile("cn-jgj100")
    assert [each.rule for each in findings_of_whole(garage, profile)] in ([], ["portal-count"])
    clause = {"value": 6, "unit": "%", "source": "a test", "confidence": "high", "text": "Gentle."}
    strict = read_profile({"name": "strict", "curved_ramp_slope": clause})
    found = [each for each in findings_of_whole(garage, strict) if each.rule == "ramp-bend"]
    assert len(found) == 2
    # 7.1 % on the middle line of 8.8 m, whose inner wall has 6.7 m
    assert [each.measured for each in found] == pytest.approx([7.105 * 8.8 / 6.7] * 2, abs=0.05)


@pytest.mark.parametrize(
    "edit", [inactive(f"{RAMPS}/Ramp_Up"), moved(x=0.6, path=f"{RAMPS}/Ramp_Down"), moved(yaw_deg=180, path=RAMPS)]
)
def test_a_helix_that_is_gone_or_moved_is_found_and_not_driven_on(edit, bare, tmp_path):
    garage, profile, *_ = read_built(edited(bare, tmp_path / "edited.usda", edit))
    found = {finding.rule for finding in findings_of_whole(garage, profile)}
    assert {"level-ramp", "level-route"} <= found
    with pytest.raises(ConfigError, match="that lanes and ramps join with the street"):
        DrivePlanner(garage).drive(garage.stalls[-1].name)


def test_the_report_tells_helices(made):
    report = read_report(made.report)
    assert [link.kind for link in report.links] == ["helix", "helix"]
    assert all(len(link.squares) == 9 and link.rise_m == 3.6 and link.clear_width_m == 4.2 for link in report.links)
    assert all(60 < link.run_m < 75 and 8 < link.steepest_percent < 12 for link in report.links)


def test_a_drive_turns_down_the_helix_and_back_to_the_street(made):
    garage = garage_of_file(made.stage)
    planner = DrivePlanner(garage)
    stall = next(stall for stall in garage.stalls if stall.level == 1 and stall.takes_cars)
    states = planner.drive(str(stall.number)).trajectory
    assert states.y_m.min() == pytest.approx(-3.6, abs=1e-3)
    assert states.y_m[[0, -1]].min() > 3.0
    moved = np.sqrt(np.diff(states.x_m) ** 2 + np.diff(states.y_m) ** 2 + np.diff(states.z_m) ** 2)
    assert np.abs(moved - np.diff(states.arc_m)).max() < 1e-3
    between = (states.y_m < -0.2) & (states.y_m > -3.4)
    # 7.1 % on the middle line of 8.8 m, inside which the rear axle runs
    assert np.abs(np.tan(states.pitch_rad[between])).max() == pytest.approx(0.07105 * 8.8 / 8.5, abs=0.002)
    turned = np.where(between[1:], np.diff(states.yaw_rad), 0.0)
    assert np.degrees(turned.sum()) > 2 * 200
    assert np.abs(states.speed_m_s[between]).min() > 0.5


def test_opendrive_has_a_road_with_an_arc_for_each_helix(made, tmp_path):
    file = Path(tmp_path / "garage.xodr")
    export(made.stage, [file])
    arcs = []
    for road in ET.parse(file).getroot().iter("road"):
        turns = [
            float(geometry.find("arc").get("curvature")) * float(geometry.get("length"))
            for geometry in road.iter("geometry")
            if geometry.find("arc") is not None
        ]
        if any(abs(turn) > 4 for turn in turns):
            heights = [float(each.get("a")) for each in road.iter("elevation")]
            neighbours = [road.find(f"link/{name}") for name in ("predecessor", "successor")]
            arcs.append((turns, max(heights) - min(heights), neighbours))
    assert len(arcs) == 2
    for turns, rise, neighbours in arcs:
        assert turns == [pytest.approx(1.5 * np.pi, abs=1e-4)]
        assert rise == pytest.approx(3.6, abs=1e-3)
        assert None not in neighbours
