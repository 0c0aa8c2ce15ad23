"""Columns that stand back from the mouths of stalls."""

import json

import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from support.soak import soak_but

from garage2usd import ConfigError, GarageConfig, generate
from garage2usd.checks import judged_layout
from garage2usd.cli import main
from garage2usd.driving import prove_stalls
from garage2usd.structure.grid import Cell

SITE = {"width_cells": 9, "height_cells": 7}
PLAN = {"episodes": 100, "starts": 1}


def garage_with(setback_m, *, seed=5, **settings):
    bay = {"column_setback_m": setback_m, **settings.pop("bay", {})}
    return generate(GarageConfig(seed=seed, site=SITE, plan=PLAN, bay=bay, **settings))


def lane_sides(structure, row, col):
    """Which of the four squares around a corner are no stalls' squares: up left, up right, down left, down right."""
    cells = np.pad(structure.cells, 1, constant_values=Cell.OBSTACLE)
    return tuple((cells[row : row + 2, col : col + 2] != Cell.FREE).ravel().tolist())


def feet_of(garage):
    """Name, corner (row, col), offset (x, z) from it and outlines of each column."""
    structure = garage.layout.structure
    for place in garage.layout.of_kind("column"):
        row, col = int(place.name[8:10]), int(place.name[12:14])
        corner = structure.column_edges_m[col], structure.row_edges_m[row]
        offset = round(place.position_m[0] - corner[0], 6), round(place.position_m[2] - corner[1], 6)
        yield place.name, (row, col), offset, [shapely.Polygon(outline) for outline in place.outlines()]


SETBACKS_M = (0.5, 1.0, 1.8)


@pytest.mark.parametrize(
    ("seed", "setback_m"),
    soak_but([*enumerate(SETBACKS_M)], [(seed, setback_m) for seed in range(3) for setback_m in SETBACKS_M]),
)
def test_columns_beside_one_lane_stand_back_and_others_stay(seed, setback_m):
    made = garage_with(setback_m, seed=seed)
    away = {(True, True, False, False): (0, 1), (False, False, True, True): (0, -1)}
    away |= {(True, False, True, False): (1, 0), (False, True, False, True): (-1, 0)}
    moved = 0
    for name, corner, offset, _ in feet_of(made):
        side = away.get(lane_sides(made.layout.structure, *corner))
        if offset != (0, 0):
            assert side is not None, name
            assert offset == tuple(setback_m * step for step in side), name
            assert name not in made.layout.columns_at_mouths()
            moved += 1
        elif any(lane_sides(made.layout.structure, *corner)):
            assert name in made.layout.columns_at_mouths()
    assert moved > 8


@pytest.mark.parametrize("kinds", [{"perpendicular": 1}, {"perpendicular": 0.5, "angled": 0.3, "parallel": 0.2}])
@pytest.mark.parametrize("seeds", soak_but(1, [range(1), range(1, 3)]))
def test_no_column_stands_in_a_stall_and_check_finds_nothing_more(kinds, seeds):
    for seed in seeds:
        usual, made = (garage_with(setback_m, seed=seed, stalls={"kinds": kinds}) for setback_m in (0, 1.0))
        stalls = shapely.STRtree([stall.rectangle.buffer(-0.01) for stall in made.stalls])
        for name, _, _, outlines in feet_of(made):
            assert not any(len(stalls.query(outline, predicate="intersects")) for outline in outlines), name
        assert [stall.name for stall in made.layout.stalls] == [stall.name for stall in usual.layout.stalls]
        rules, usual_rules = ({f.rule for f in judged_layout(g.layout, g.config)[0]} for g in (made, usual))
        assert rules <= usual_rules
        assert all(proof.is_full for proof in prove_stalls(made.layout, most_explained=0))


@pytest.mark.soak
def test_cars_get_into_as_many_stalls_with_fewer_moves():
    """Of narrow stalls beside a narrow aisle, as of a profile that asks for nothing."""
    figures = []
    for setback_m in (0, 1.0):
        made = generate(
            GarageConfig(
                seed=2,
                site=SITE,
                plan={**PLAN, "unreachable_stalls": "keep"},
                bay={"column_setback_m": setback_m, "aisle_width_m": 5.0, "stall_width_m": 2.2},
                profile={"name": "none"},
            )
        )
        proofs = prove_stalls(made.layout, most_explained=0)
        ways = [proof.way_in for proof in proofs if proof.way_in]
        figures.append((sum(proof.is_full for proof in proofs), -sum(len(way.moves) for way in ways)))
    assert figures[1] > figures[0]


def test_the_grid_of_columns_is_judged_as_before():
    made = garage_with(1.0)
    widths_m = made.layout.structure.column_widths_mm / 1000
    spacing = {"least": 7.0, "most": float(widths_m.max()) - 0.5, "unit": "m", "source": "x", "confidence": "low"}
    for setback_m in (0, 1.0):
        found = generate(
            GarageConfig(
                seed=5,
                site=SITE,
                plan=PLAN,
                bay={"column_setback_m": setback_m, "dimensioned": False, "square_side_m": 8.1},
                profile={"name": "own", "column_spacing": spacing},
            )
        )
        rules = [
            finding for finding in judged_layout(found.layout, found.config)[0] if finding.rule == "column-spacing"
        ]
        assert [finding.measured for finding in rules] == [pytest.approx(8.1)]


def test_without_a_setback_a_garage_is_what_it_was():
    made, usual = garage_with(0), generate(GarageConfig(seed=5, site=SITE, plan=PLAN))
    assert made.config.digest() == usual.config.digest() != garage_with(1.0).config.digest()
    assert list(made.layout.placements.names) == list(usual.layout.placements.names)
    assert (made.layout.placements.position_m == usual.layout.placements.position_m).all()


def test_build_and_report_name_the_columns_that_stay(tmp_path):
    (tmp_path / "g.toml").write_text(
        "seed = 5\n[site]\nwidth_cells = 9\nheight_cells = 7\n[plan]\nepisodes = 100\n[bay]\ncolumn_setback_m = 1.0\n"
    )
    run = CliRunner().invoke(main, ["build", str(tmp_path / "g.toml"), "-o", str(tmp_path / "g.usda")])
    assert run.exit_code == 0, run.output
    stay = json.loads((tmp_path / "g_report.json").read_text())["levels"][0]["columns_at_mouths"]
    assert f"at the corner stay {len(stay)}: {', '.join(stay[:3])}" in run.output


def test_a_setback_that_cannot_be_is_refused():
    with pytest.raises(ConfigError, match=r"bay\.column_setback_m"):
        GarageConfig(bay={"column_setback_m": -0.5})
