"""The section of a garage of several levels against the stage's triangles, cut by trimesh."""

from itertools import pairwise

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from support.level_judge import LevelJudge
from support.places import MILLIMETRE
from support.sample_files import REPOSITORY
from support.small_levels import SMALL_LEVELS

import garage2usd
from garage2usd.cli import main
from garage2usd.view.drawing import Line, Region, Text
from garage2usd.view.section import draw_section

HELICES = garage2usd.load_config(REPOSITORY / "samples/three_levels.toml")
FINE_M, MOST_M = 0.01, 1.6
"""The latter is how high over the floor the lowest point of a cabin may lie."""


@pytest.fixture(scope="module", params=[SMALL_LEVELS, HELICES], ids=["straight", "helix"])
def drawn(request, tmp_path_factory):
    built = garage2usd.build_levels(request.param, tmp_path_factory.mktemp("section") / "garage.usdc")
    drawing = draw_section(built.garage.layouts, storey_m=built.garage.building.storey_m)
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


def test_slabs_lie_between_levels_and_cars_stand_on_their_floors(drawn):
    built, drawing, _ = drawn
    floors = [level.floor_m for level in built.garage.layouts]
    ceilings = [each for each in drawing.elements if isinstance(each, Region) and each.kind == "cut ceiling"]
    cars = [each for each in drawing.elements if isinstance(each, Region) and each.kind == "car"]
    assert ceilings
    assert cars
    for region in ceilings:
        heights = -np.array(region.points)[:, 1]
        above = [floor for floor in floors if floor > heights.max() - FINE_M]
        assert not above or heights.max() <= min(above) + 1e-6
    lowest = [-np.array(region.points)[:, 1].max() for region in cars]
    over_floor = [min(low - floor for floor in floors if low > floor - FINE_M) for low in lowest]
    assert min(over_floor) == pytest.approx(0.0, abs=FINE_M)
    assert max(over_floor) < MOST_M


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
    assert names == {"p_section.svg", *(f"p_{name}.svg" for name in built.garage.building.names())}
    assert "Section through the ramps" in (tmp_path / "p_section.svg").read_text()
