"""The section of a garage of several levels against the stage's triangles, cut by trimesh, and the plans beside it."""

import json
from collections import Counter
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from support.level_judge import LevelJudge
from support.places import MILLIMETRE
from support.sample_files import REPOSITORY
from support.small_levels import SMALL_LEVELS
from support.soak import soak_but

import garage2usd
from garage2usd.cli import main
from garage2usd.datasets.drawn_plan import DrawnPlan
from garage2usd.datasets.plans import landings_of
from garage2usd.structure.grid import Cell
from garage2usd.view.drawing import Line, Region, Text
from garage2usd.view.plan_lanes import LANDING, LANE_COLOUR
from garage2usd.view.plan_picture import draw_plan
from garage2usd.view.section import draw_section
from garage2usd.view.thumbnails import draw_thumbnail

HELICES = garage2usd.load_config(REPOSITORY / "samples/three_levels.toml")
FINE_M, MOST_M = 0.01, 1.6
"""The latter is how high over the floor the lowest point of a cabin may lie."""


@pytest.fixture(scope="module", params=soak_but([SMALL_LEVELS], [SMALL_LEVELS, HELICES]), ids=["straight", "helix"])
def drawn(request, tmp_path_factory):
    built = garage2usd.build(request.param, tmp_path_factory.mktemp("section") / "garage.usdc")
    drawing = draw_section(built.garage.levels, storey_m=built.garage.building.storey_m)
    return built, drawing, LevelJudge(built.stage)


def lines_of(drawing, kind):
    """All strokes of what is cut of a kind, as one geometry."""
    strokes = [element for element in drawing.elements if isinstance(element, Line) and element.kind == kind]
    return shapely.union_all([shapely.LineString(pair) for stroke in strokes for pair in pairwise(stroke.points)])


def plane_of(layout):
    """Axis and place of the plane: along the straight way down, or through the middles of both helices."""
    ways = [np.array(lane.points)[:, [0, 2]] for lane in layout.well.lanes(layout.structure)]
    middles = [(way.min(axis=0) + way.max(axis=0)) / 2 for way in ways]
    spread = np.abs(np.ptp(ways[0], axis=0) if np.ptp(ways[0], axis=0).min() < FINE_M else middles[1] - middles[0])
    axis = 0 if spread[0] < spread[1] else 1
    return 2 * axis, middles[0][axis]


@pytest.mark.parametrize("label", ["ramp", "wall"])
def test_what_is_cut_is_what_trimesh_cuts_of_the_stage(drawn, label):
    built, drawing, judge = drawn
    axis, place = plane_of(built.garage.levels[0].layout)
    origin, normal = np.zeros(3), np.zeros(3)
    # beside the middle, where meshes have edges
    origin[axis], normal[axis] = place + (0.013 if axis == 0 else -0.013), 1.0
    cut = judge.mesh(label).section(plane_origin=origin, plane_normal=normal)
    ways = np.concatenate([np.stack([entity.points[:-1], entity.points[1:]], axis=1) for entity in cut.entities])
    ends = np.stack([cut.vertices[ways][..., 2 - axis], -cut.vertices[ways][..., 1]], axis=-1)
    found, expected = lines_of(drawing, f"cut {label}"), shapely.union_all(shapely.linestrings(ends))
    shift = np.array([expected.bounds[0] - found.bounds[0], 0.0])
    moved = shapely.transform(found, lambda points: points + shift)
    assert shapely.hausdorff_distance(moved, expected) < MILLIMETRE


def test_slabs_bear_the_floors_above_them_and_cars_stand_on_their_floors(drawn):
    built, drawing, judge = drawn
    floors = [level.floor_m for level in built.garage.levels]
    ceilings = [each for each in drawing.elements if isinstance(each, Region) and each.kind == "cut ceiling"]
    cars = [each for each in drawing.elements if isinstance(each, Region) and each.kind == "car"]
    assert ceilings
    assert cars
    # up to the floor's triangles in the stage, and no gap is drawn below it
    tops = {round(float(-np.array(region.points)[:, 1].min()), 3) for region in ceilings}
    lowest, highest = min(floors), max(tops)
    assert tops - {highest} == {round(floor, 3) for floor in floors if floor > lowest}
    laid = np.round(judge.mesh("floor").vertices[:, 1], 3)
    assert tops - {highest} <= {*laid.tolist()}
    slabs = judge.mesh("ceiling")
    assert {round(float(height), 3) for height in slabs.vertices[:, 1]} > tops
    # the floor is the upper face of the slab, so that no two faces lie in each other
    looking_up = slabs.face_normals[:, 1] > 1 - FINE_M
    assert np.allclose(slabs.triangles[looking_up][..., 1], highest, atol=MILLIMETRE)
    lowest = [-np.array(region.points)[:, 1].max() for region in cars]
    over_floor = [min(low - floor for floor in floors if low > floor - FINE_M) for low in lowest]
    assert min(over_floor) == pytest.approx(0.0, abs=FINE_M)
    assert max(over_floor) < MOST_M


def test_plans_show_landings_as_such_and_only_doors_to_the_street_as_portals(drawn):
    built, _, _ = drawn
    for level in built.garage.levels:
        layout = level.layout
        landings = set(layout.well.landings)
        portals = {tuple(square) for square in np.argwhere(layout.structure.cells >= Cell.ENTRANCE).tolist()}
        assert landings < portals if level.layout.well.is_top else landings == portals
        elements = draw_plan(layout).elements
        regions = Counter((each.kind, each.fill) for each in elements if isinstance(each, Region))
        words = Counter((each.kind, each.text) for each in elements if isinstance(each, Text))
        assert regions["landing", LANDING] == words["landing", "landing"] == len(landings)
        assert words["legend", "landing of a ramp"] == 1
        street = sum(regions[f"{kind} through", LANE_COLOUR[kind]] for kind in ("entrance", "exit"))
        assert street == len(portals - landings)
        assert (words["legend", "entrance"] > 0) is (words["legend", "exit"] > 0) is (street > 0)


def test_the_page_of_a_data_set_shows_landings_as_such(drawn):
    built, _, _ = drawn
    top = built.garage.levels[0]
    made = DrawnPlan(number=0, attempt=0, seed=0, tape=built.garage.tape)
    landings = landings_of(made, SimpleNamespace(drawn=lambda _seed, _number: (built.garage.config, {})))
    assert {*landings} == {*top.layout.well.landings}
    elements = draw_thumbnail(top.plan.structure.cells, "U1", landings).elements
    squares = {
        tuple(np.min(each.points, axis=0).astype(int)[::-1].tolist())
        for each in elements
        if isinstance(each, Region) and each.kind == "landing"
    }
    rows = {row for row, _ in landings}
    assert squares <= {*landings}
    assert {row for row, _ in squares} == rows
    letters = [each.text for each in elements if isinstance(each, Text)]
    assert sorted(letters) == ["E", "X"]


def test_the_floor_a_stall_is_told_without_and_with_ramps(drawn):
    built, _, _ = drawn
    told, stalls, areas_m2 = json.loads(built.report.read_text()), built.garage.parking_stalls, np.zeros(2)
    for level, own in zip(built.garage.levels, told["levels"], strict=True):
        layout, structure = level.layout, level.layout.structure
        x, z = structure.column_edges_m, structure.row_edges_m
        floor = [tuple(square) for square in np.argwhere(structure.cells != Cell.OBSTACLE).tolist()]
        ground = shapely.union_all(
            [shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in (*floor, *layout.well.squares)]
        )
        net_m2 = sum((x[c + 1] - x[c]) * (z[r + 1] - z[r]) for r, c in floor)
        gross_m2 = shapely.Polygon(ground.exterior).area
        assert gross_m2 > net_m2 + 200
        areas_m2 += net_m2, gross_m2
        each = own["area_per_stall_m2"], own["gross_area_per_stall_m2"]
        assert np.allclose(each, np.array([net_m2, gross_m2]) / layout.parking_stalls, atol=1e-3)
        title = next(one.text for one in draw_plan(layout).elements if isinstance(one, Text) and one.kind == "title")
        assert f", {each[0]:.1f} m2 a stall net, {each[1]:.1f} gross, " in title
    assert np.allclose([told["area_per_stall_m2"], told["gross_area_per_stall_m2"]], areas_m2 / stalls, atol=1e-3)


def test_floors_are_named_with_their_heights(drawn):
    built, drawing, _ = drawn
    words = [each.text for each in drawing.elements if isinstance(each, Text) and each.kind == "level"]
    storey_m = built.garage.building.storey_m
    expected = [f"U{number + 1}  {-number * storey_m:+.2f}" for number in range(len(built.garage.levels))]
    assert words == ["U1  0.00", *expected[1:]]


def test_the_command_draws_it_beside_the_plans(drawn, tmp_path):
    built, _, _ = drawn
    run = CliRunner().invoke(main, ["plan", str(built.stage), "-o", str(tmp_path / "p.svg")])
    assert run.exit_code == 0, run.output
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"p_section.svg", *(f"p_{name}.svg" for name in ("U1", "U2", "U3")[: len(built.garage.levels)])}
    assert "Section through the ramps" in (tmp_path / "p_section.svg").read_text()
