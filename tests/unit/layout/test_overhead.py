import numpy as np
import pytest
import shapely
from scipy.spatial.distance import pdist
from support.footprints import footprint
from support.overlaps import HANGING, assert_solid_objects_keep_apart
from support.sample_files import each_sample

from garage2usd.config import GarageConfig
from garage2usd.layout import lay_out
from garage2usd.objects.exit_sign import Turn
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph
from garage2usd.structure.stalls import Edge


@each_sample
def test_nothing_overhead_meets_anything_or_hangs_into_the_way(sample, builds):
    garage = builds(sample, "usdc").garage
    assert_solid_objects_keep_apart(garage.layout, garage.config)


def laid_out(text, sides_m=8.1, *, bay=None, **fittings):
    config = GarageConfig(bay=bay or {}, fittings=fittings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), sides_m, sides_m)
    return lay_out(structure, build_lane_graph(structure, config.bay), config), config


CROSS = """
..=..=..
E======X
..=..=..
.=====..
"""


@pytest.mark.parametrize("ceiling_m", [2.4, 2.6, 2.8, 2.9, 2.95, 3.2, 4.0])
def test_any_ceiling_leaves_the_clear_height(ceiling_m):
    layout, config = laid_out(CROSS, ceiling_height_m=ceiling_m)
    assert_solid_objects_keep_apart(layout, config)
    assert bool(layout.of_kind("mirror")) == (ceiling_m >= 2.95)
    assert bool(layout.of_kind("exit_sign")) == (ceiling_m > 3)


def test_exit_signs_point_to_the_exit():
    layout, _ = laid_out(CROSS)
    turns = {(place.square, place.name): place.spec.turn for place in layout.of_kind("exit_sign")}
    assert turns[(1, 2), "ExitSign_Left"] is Turn.AHEAD
    assert turns[(1, 2), "ExitSign_Down"] is Turn.RIGHT  # driving up, the exit lies on the right
    assert turns[(1, 5), "ExitSign_Up"] is Turn.LEFT


def ways_seen(place):
    """The edges from which a driver has a mirror before him."""
    x, z = np.sin(place.yaw_rad), np.cos(place.yaw_rad)
    return {Edge.DOWN if z > 0 else Edge.UP, Edge.RIGHT if x > 0 else Edge.LEFT}


def test_mirrors_serve_every_way_into_a_blind_junction_or_bend():
    layout, config = laid_out(CROSS)
    assert_solid_objects_keep_apart(layout, config)
    seen = {}
    for place in layout.of_kind("mirror"):
        seen.setdefault(place.square, set()).update(ways_seen(place))
    assert seen[1, 2] == seen[1, 5] == set(Edge)
    assert seen[3, 2] >= {Edge.LEFT, Edge.UP, Edge.RIGHT}
    bend, _ = laid_out("""
....
.==X
.=..
.E..
""")
    (mirror,) = bend.of_kind("mirror")
    assert (mirror.square, ways_seen(mirror)) == ((1, 1), {Edge.DOWN, Edge.RIGHT})


def test_mirrors_hang_on_columns_and_walls():
    layout, _ = laid_out(
        """
E====X
.=.=..
.=#=..
.====.
"""
    )
    solid = ("column", "wall", "portal", "obstacle")
    holding = shapely.union_all([footprint(place) for place in layout.placements if place.kind in solid])
    placed = layout.of_kind("mirror")
    assert {place.spec.arm_m for place in placed} >= {0.12, 0.29}
    for place in placed:
        x, _, z = place.position_m
        tip = shapely.Point(x - place.spec.arm_m * np.sin(place.yaw_rad), z - place.spec.arm_m * np.cos(place.yaw_rad))
        assert tip.distance(holding) < 0.025


@pytest.mark.parametrize("column_m", [0.2, 0.3, 0.4, 1.2])
def test_mirrors_around_one_column_hang_beside_each_other(column_m):
    text = "E=====X\n=.=.=.=\n=======\n.=.=.=.\n======="
    layout, config = laid_out(text, bay={"column_size_m": column_m})
    assert_solid_objects_keep_apart(layout, config)
    placed = layout.of_kind("mirror")
    nearest = pdist(np.array([place.position_m for place in placed])).min()
    assert nearest >= 2 * placed[0].spec.radius_m - 1e-6
    assert nearest < 2  # there are some around one column
    columns = shapely.union_all([footprint(place) for place in layout.of_kind("column")])
    for place in placed:
        x, _, z = place.position_m
        tip = shapely.Point(x - place.spec.arm_m * np.sin(place.yaw_rad), z - place.spec.arm_m * np.cos(place.yaw_rad))
        assert tip.distance(columns) < 0.025 or place.spec.arm_m == 0.29


@pytest.mark.parametrize(("sides_m", "column_m", "ceiling_m"), [(5.6, 0.9, 2.73), (6.3, 0.25, 2.76), (6.4, 1.1, 2.9)])
def test_tubes_over_small_junctions_keep_off_lines_that_hang_as_high(sides_m, column_m, ceiling_m):
    layout, config = laid_out(CROSS, sides_m, bay={"column_size_m": column_m}, ceiling_height_m=ceiling_m)
    assert layout.of_kind("duct")
    assert_solid_objects_keep_apart(layout, config)


def test_ramps_are_lit_under_their_cover():
    layout, config = laid_out(CROSS)
    tubes = [place for place in layout.of_kind("light") if place.square is None]
    ramps = layout.of_kind("ramp")
    assert len(tubes) == 2 * len(ramps) > 0
    assert {place.spec for place in tubes} == {place.spec for place in layout.of_kind("light")}
    for place in tubes:
        (ramp,) = [ramp for ramp in ramps if footprint(ramp).contains(footprint(place))]
        run = np.hypot(place.position_m[0] - ramp.position_m[0], place.position_m[2] - ramp.position_m[2])
        assert run < ramp.spec.cover_end_m
        floor = np.interp(run, *zip(*ramp.spec.profile, strict=True))
        assert place.position_m[1] - place.spec.drop_m - floor >= config.fittings.clear_height_m


def test_beams_and_columns_cover_every_border_between_squares_once():
    layout, _ = laid_out(
        """
##..=...
E======X
..#.=...
.=====..
"""
    )
    beams = [footprint(place) for place in layout.of_kind("beam")]
    columns = [footprint(place) for place in layout.of_kind("column")]
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
    ground = shapely.union_all([footprint(place) for place in layout.of_kind("ceiling")])
    assert concrete.difference(ground.buffer(1e-6)).area < 1e-6


@pytest.mark.parametrize(
    ("ceiling_m", "switches", "depth_m", "absent"),
    [
        (3.2, {}, 0.4, set()),
        (3.2, {"cable_trays": False}, 0.5, {"cable_tray", "mirror"}),
        (3.2, {"ducts": False}, 0.6, {"duct", "mirror"}),
        (3.2, {"beams": False}, 0.0, {"beam"}),
        (2.75, {}, 0.0, {"beam", "cable_tray", "exit_sign", "mirror"}),
        (2.4, {}, 0.0, {kind for kind in HANGING if kind not in {"light", "sprinkler"}}),
    ],
)
def test_what_finds_no_room_over_the_clear_height_is_left_out(ceiling_m, switches, depth_m, absent):
    layout, config = laid_out(CROSS, ceiling_height_m=ceiling_m, **switches)
    assert_solid_objects_keep_apart(layout, config)
    # its lanes are two-way
    assert {kind for kind in HANGING if not layout.of_kind(kind)} == absent | {"lane_sign", "fire_shutter"}
    assert {place.spec.depth_m for place in layout.of_kind("beam")} == ({depth_m} if depth_m else set())
