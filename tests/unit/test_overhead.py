import numpy as np
import pytest
import shapely
from footprints import footprint
from overlaps import HANGING, assert_nothing_overhead_meets
from sample_files import each_sample

from garage2usd.config import GarageConfig, load_config
from garage2usd.grid import Cell, Structure, cells_from_text
from garage2usd.lanes import build_lane_graph
from garage2usd.layout import ObjectKind, lay_out
from garage2usd.layout.specs import Turn
from garage2usd.pipeline import generate


@each_sample
def test_nothing_overhead_meets_anything_or_hangs_into_the_way(sample):
    config = load_config(sample)
    assert_nothing_overhead_meets(generate(config).layout, config)


def laid_out(text, **fittings):
    config = GarageConfig(fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config), config


CROSS = """
..=..=..
E======X
..=..=..
.=====..
"""


@pytest.mark.parametrize("ceiling_m", [2.4, 3.2, 4.0])
def test_any_ceiling_leaves_the_clear_height(ceiling_m):
    layout, config = laid_out(CROSS, ceiling_height_m=ceiling_m)
    assert_nothing_overhead_meets(layout, config)
    assert bool(layout.of_kind(ObjectKind.EXIT_SIGN)) == (ceiling_m > 3)


def test_exit_signs_point_to_the_exit():
    layout, _ = laid_out(CROSS)
    turns = {(place.square, place.name): place.spec.turn for place in layout.of_kind(ObjectKind.EXIT_SIGN)}
    assert turns[(1, 2), "ExitSign_Left"] is Turn.AHEAD
    assert turns[(1, 2), "ExitSign_Down"] is Turn.RIGHT  # driving up, the exit lies on the right
    assert turns[(1, 5), "ExitSign_Up"] is Turn.LEFT


def test_every_junction_with_a_column_has_a_mirror_on_it():
    layout, _ = laid_out(CROSS)
    columns = [place.position_m for place in layout.of_kind(ObjectKind.COLUMN)]
    placed = layout.of_kind(ObjectKind.MIRROR)
    assert {place.square for place in placed} >= {(1, 2), (1, 5)}
    for place in placed:
        x, _, z = place.position_m
        assert min(np.hypot(x - cx, z - cz) for cx, _, cz in columns) < 0.7


def test_beams_and_columns_cover_every_border_between_squares_once():
    layout, _ = laid_out(
        """
##..=...
E======X
..#.=...
.=====..
"""
    )
    beams = [footprint(place) for place in layout.of_kind(ObjectKind.BEAM)]
    columns = [footprint(place) for place in layout.of_kind(ObjectKind.COLUMN)]
    concrete = shapely.union_all([*beams, *columns])
    assert concrete.area == pytest.approx(sum(shape.area for shape in [*beams, *columns]), abs=1e-6)
    structure = layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    inside = structure.cells != Cell.OBSTACLE
    lines = [
        shapely.LineString([(x[col + 1], z[row]), (x[col + 1], z[row + 1])])
        for row, col in np.argwhere(inside[:, :-1] & inside[:, 1:]).tolist()
    ]
    lines += [
        shapely.LineString([(x[col], z[row + 1]), (x[col + 1], z[row + 1])])
        for row, col in np.argwhere(inside[:-1] & inside[1:]).tolist()
    ]
    assert shapely.union_all(lines).difference(concrete.buffer(1e-6)).length < 1e-6
    ground = shapely.union_all([footprint(place) for place in layout.of_kind(ObjectKind.CEILING)])
    assert concrete.difference(ground.buffer(1e-6)).area < 1e-6


@pytest.mark.parametrize(
    ("ceiling_m", "switches", "depth_m", "absent"),
    [
        (3.2, {}, 0.4, set()),
        (3.2, {"cable_trays": False}, 0.5, {ObjectKind.CABLE_TRAY}),
        (3.2, {"ducts": False}, 0.6, {ObjectKind.DUCT}),
        (3.2, {"beams": False}, 0.0, {ObjectKind.BEAM}),
        (2.75, {}, 0.0, {ObjectKind.BEAM, ObjectKind.CABLE_TRAY, ObjectKind.EXIT_SIGN}),
        (2.4, {}, 0.0, {ObjectKind.BEAM, ObjectKind.DUCT, ObjectKind.CABLE_TRAY, ObjectKind.EXIT_SIGN}),
    ],
)
def test_what_finds_no_room_over_the_clear_height_is_left_out(ceiling_m, switches, depth_m, absent):
    layout, config = laid_out(CROSS, ceiling_height_m=ceiling_m, **switches)
    assert_nothing_overhead_meets(layout, config)
    assert {kind for kind in HANGING if not layout.of_kind(kind)} == absent
    assert {place.spec.depth_m for place in layout.of_kind(ObjectKind.BEAM)} == ({depth_m} if depth_m else set())
