import itertools
import math

import numpy as np
import pytest
import shapely
from support.footprints import footprint
from support.overlaps import Solids
from support.sample_files import each_sample

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.config.vehicles import CAR_BODIES, SEGMENTS
from garage2usd.garage import StallUse
from garage2usd.layout import lay_out
from garage2usd.objects import KINDS
from garage2usd.objects.panel import PanelSpec
from garage2usd.pipeline import generate
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Cell, Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph
from garage2usd.structure.lanes import dead_ends
from garage2usd.structure.stalls import square_capacity


def laid_out(text, config=None, R=8.1, C=8.1):
    config = config or GarageConfig()
    structure = Structure.from_arrays(cells_from_text(text, field="S"), R, C)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


IRREGULAR = """
##......##
##.====.##
E======...
.=.##.=...
.=.##.===X
.======...
..........
"""


@pytest.fixture(scope="module")
def layout():
    return laid_out(
        IRREGULAR, GarageConfig(parking={"occupancy": 1.0, "max_yaw_deg": 5.0, "accessible_share": 0, "over_line": 0})
    )


def union(placements):
    return shapely.union_all([footprint(place) for place in placements])


def assert_disjoint(placements):
    shapes = [footprint(place) for place in placements]
    tree = shapely.STRtree(shapes)
    for first, second in tree.query(shapes, predicate="intersects").T:
        if first < second:
            overlap = shapes[first].intersection(shapes[second]).area
            assert overlap < 1e-6, (placements[first], placements[second], overlap)


def test_floors_and_stalls_tile_the_inside_without_overlap(layout):
    ground = [*layout.of_kind("floor"), *layout.of_kind("stall")]
    assert_disjoint(ground)
    area = sum(footprint(place).area for place in ground)
    inside = (layout.structure.cells != Cell.OBSTACLE).sum()
    assert area == pytest.approx(inside * 8.1**2, abs=1e-4)


def test_markings_do_not_overlap_and_stay_on_their_panel(layout):
    for spec in {p.spec for p in layout.placements if isinstance(p.spec, PanelSpec)}:
        shapes = [shapely.Polygon(marking.polygon) for marking in spec.markings]
        assert all(shape.is_valid and shape.area > 0 for shape in shapes)
        panel = shapely.box(-spec.width_m / 2, -spec.depth_m / 2, spec.width_m / 2, spec.depth_m / 2)
        panel = panel.difference(shapely.union_all([shapely.Polygon(opening) for opening in spec.openings]))
        assert shapely.union_all(shapes).difference(panel).area < 1e-6
        assert shapely.union_all(shapes).area == pytest.approx(sum(shape.area for shape in shapes), abs=1e-6)


def test_walls_close_the_contour_once(layout):
    shell = [place for place in layout.placements if place.kind in {"wall", "portal"}]
    assert_disjoint(shell)
    x, z = layout.structure.column_edges_m, layout.structure.row_edges_m
    cells = layout.structure.cells
    squares = [
        shapely.box(x[col], z[row], x[col + 1], z[row + 1]) for row, col in np.argwhere(cells != Cell.OBSTACLE).tolist()
    ]
    core = footprint(layout.of_kind("obstacle")[0])
    assert core.area == pytest.approx(8.1**2)
    inside = shapely.union_all([*squares, *(footprint(place) for place in layout.of_kind("obstacle"))])
    walls = union(shell)
    assert walls.intersection(inside).area < 1e-6
    # the walls are exactly the band of their thickness around the inside
    band = inside.buffer(0.3, join_style="mitre").difference(inside)
    assert walls.symmetric_difference(band).area < 1e-6


def test_every_portal_has_one_door(layout):
    assert len(layout.of_kind("portal")) == (layout.structure.cells >= Cell.ENTRANCE).sum()
    entrances = [place for place in layout.of_kind("portal") if place.spec.is_entrance]
    assert len(entrances) == 1


def test_columns_stand_clear_of_stalls_cars_walls_and_carriageways(layout):
    columns = union(layout.of_kind("column"))
    assert len(layout.of_kind("column")) > 10
    solid = ("stall", "car", "wall", "portal", "obstacle")
    for place in layout.placements:
        if place.kind in (*solid, "speed_bump"):
            assert footprint(place).intersection(columns).area < 1e-6, place
    # half a column and a margin reach into a lane square; the carriageway lies inside that
    x, z = layout.structure.column_edges_m, layout.structure.row_edges_m
    others = shapely.union_all(
        [shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in layout.structure.where(Cell.FREE)]
    )
    for row, col in layout.structure.where(Cell.LANE):
        square = shapely.box(x[col], z[row], x[col + 1], z[row + 1])
        carriageway = square.difference(others.buffer(0.35, join_style="mitre"))
        assert carriageway.intersection(columns).area < 1e-6


def test_stalls_match_the_score_and_cars_stand_inside_their_lines(layout):
    assert len(layout.stalls) == square_capacity(layout.structure, GarageConfig().bay).sum()
    names = [stall.name for stall in layout.stalls]
    assert len(set(names)) == len(names)
    panels = {place.stall: footprint(place) for place in layout.of_kind("stall")}
    assert set(panels) == set(names)
    for stall in layout.stalls:
        assert shapely.Polygon(stall.corners_m()).symmetric_difference(panels[stall.name]).area < 1e-6
    cars = layout.of_kind("car")
    assert len(cars) == len(names)
    for car in cars:
        lines, body = panels[car.stall], next(body for body in CAR_BODIES if body.name == car.spec.body)
        # mirrors may hang over a line
        assert lines.buffer((body.overall_width_m - body.width_m) / 2).contains(footprint(car)), car


def test_the_mouth_of_a_stall_lies_on_its_lane(layout):
    for stall in layout.stalls:
        left, right, *_ = stall.corners_m()
        x, z = layout.structure.column_edges_m, layout.structure.row_edges_m
        row, col = stall.access_square
        lane = shapely.box(x[col], z[row], x[col + 1], z[row + 1])
        assert lane.distance(shapely.Point(left)) < 1e-6
        assert lane.distance(shapely.Point(right)) < 1e-6


def test_ducts_hang_under_the_ceiling_above_the_clear_height_and_never_meet(layout):
    ducts = layout.of_kind("duct")
    assert_disjoint(ducts)
    for place in ducts:
        top = place.position_m[1]
        assert top + place.spec.hanger_m == pytest.approx(layout.ceiling_height_m)
        assert top - place.spec.height_m >= GarageConfig().fittings.clear_height_m
    assert_disjoint([*ducts, *layout.of_kind("column")])
    assert_disjoint(list(layout.of_kind("light")))


def test_speed_bumps_keep_apart():
    config = GarageConfig(fittings={"speed_bump_rate": 1.0, "stair_cores": False})
    layout = laid_out("." * 12 + "\nE" + "=" * 10 + "X\n" + "." * 12, config)
    columns = sorted(place.square[1] for place in layout.of_kind("speed_bump"))
    assert columns == [1, 3, 5, 7, 9]


def test_settings_decide_what_is_there():
    bare = laid_out(
        IRREGULAR,
        GarageConfig(
            fittings={
                "beams": False,
                "ducts": False,
                "cable_trays": False,
                "cone_rate": 0,
                "wheel_stops": False,
                "speed_bump_rate": 0,
                "no_parking_sign_rate": 0,
                "floor_stain_rate": 0,
                "tubes_per_cell": 0,
                "ramps": False,
                "sprinklers": False,
                "exit_signs": False,
                "mirrors": False,
                "stall_numbers": False,
            },
            parking={"occupancy": 0, "ev_share": 0},
        ),
    ).counts()
    empty = {
        "beam",
        "cable_tray",
        "cone",
        "duct",
        "wheel_stop",
        "speed_bump",
        "no_parking_sign",
        "light",
        "car",
        "number_plate",
        "ramp",
        "sky",
        "barrier",
        "stall_number",
        "charger",
    }
    empty |= {"sprinkler", "exit_sign", "lane_sign", "fire_shutter", "mirror", "floor_stain", "drain"}
    empty |= {kind.name for kind in KINDS if kind.group == "Clutter"}
    assert {kind for kind, count in bare.items() if count == 0} == empty


def test_cones_close_stalls_without_cars_and_never_stand_on_lanes():
    layout = laid_out(IRREGULAR, GarageConfig(fittings={"cone_rate": 1.0}))
    cones = layout.of_kind("cone")
    occupied = {car.stall for car in layout.of_kind("car")}
    standard = {stall.name for stall in layout.stalls if stall.use is StallUse.STANDARD}
    panels = {place.stall: footprint(place) for place in layout.of_kind("stall")}
    closed = [panels[key] for key in standard - occupied]
    for panel in closed:
        assert sum(panel.contains(footprint(cone)) for cone in cones) == 3
    hatched = [
        place
        for place in layout.of_kind("floor")
        if layout.structure.cells[place.square] == Cell.FREE and not place.spec.openings
    ]
    assert len(cones) == 3 * len(closed) + 4 * len(hatched) > 20
    assert shapely.union_all([*closed, *map(footprint, hatched)]).buffer(1e-6).contains(union(cones))
    signs = [place for place in layout.placements if place.kind in {"no_parking_sign", "car"}]
    digits = layout.of_kind("stall_number")
    stops = layout.of_kind("wheel_stop")
    assert union(cones).intersection(union([*signs, *digits, *stops])).area < 1e-6


def test_cars_of_other_stalls_stay_the_same_with_the_occupancy():
    """They move aside at most, and only those with another car beside them."""
    few, many = (
        {car.stall: car for car in laid_out(IRREGULAR, GarageConfig(parking=parking)).of_kind("car")}
        for parking in ({"occupancy": share, "over_line": 0} for share in (0.3, 0.8))
    )
    assert set(few) < set(many)
    for stall, car in few.items():
        assert (car.spec, car.yaw_rad) == (many[stall].spec, many[stall].yaw_rad)
        assert math.dist(car.position_m, many[stall].position_m) < 0.3


@each_sample
def test_samples_have_no_overlap(sample, builds):
    layout = builds(sample, "usdc").garage.layout
    standing = ("column", "car", "wall", "portal", "obstacle")
    standing += ("speed_bump", "no_parking_sign", "ramp", "barrier")
    assert_disjoint([place for place in layout.placements if place.kind in standing])
    assert_disjoint([place for place in layout.placements if place.kind in {"floor", "stall"}])
    assert_disjoint([*layout.of_kind("duct"), *layout.of_kind("column")])


def test_names_are_unique_among_siblings(layout):
    for _, siblings in itertools.groupby(
        layout.placements, key=lambda place: (place.square, place.square or place.kind)
    ):
        names = [place.name for place in siblings]
        assert len(set(names)) == len(names)


def test_a_long_dead_end_keeps_a_turning_stall():
    text = ".......\n=======\n=.X....\nE......"
    parking = {"occupancy": 1.0, "accessible_share": 0}
    free = laid_out(text, GarageConfig(parking=parking))
    turning = [stall for stall in free.stalls if stall.use is StallUse.TURNING]
    assert [stall.access_square for stall in turning] == [(1, 6)]  # four squares of 8.1 m past the exit's junction
    assert len(free.of_kind("car")) == len(free.of_kind("wheel_stop")) == len(free.stalls) - 1
    allowed = laid_out(text, GarageConfig(parking=parking, plan={"dead_ends": "allow"}))
    assert len(allowed.stalls) == len(free.stalls) == len(allowed.of_kind("car"))

    def is_turning(place):
        return place.stall == turning[0].name

    hatched = {place.spec for place in free.of_kind("stall") if is_turning(place)}
    plain = {place.spec for place in free.of_kind("stall") if not is_turning(place)}
    assert hatched.isdisjoint(plain)


def test_a_turning_stall_opens_onto_its_own_dead_end():
    # the stall nearest to the tip (1, 7), behind a wall, opens onto the aisle below it
    layout = laid_out("..#######\n.=======#\n.=#######\n.=......#\n.=======X\nE=.......")
    (end,) = [end for end in dead_ends(layout.structure) if end.needs_turning_stall]
    assert (end.tip, end.squares[-1]) == ((1, 7), (3, 1))
    (turning,) = [stall for stall in layout.stalls if stall.use is StallUse.TURNING]
    assert turning.access_square in end.squares
    tip = layout.structure.column_edges_m[7] + 4.05, layout.structure.row_edges_m[1] + 4.05
    assert turning.name != min(layout.stalls, key=lambda stall: math.dist(stall.centre_m, tip)).name


@pytest.mark.parametrize(
    ("rows", "bay", "field"),
    [
        ("......\nE====X\n......", {"row_depths_m": [5.4, 1, 5.4]}, "bay.row_depths_m"),
        ("......\nE====X\n......", {"row_depths_m": [5.4, 3.1, 5.4]}, "bay.row_depths_m"),  # 2.4 m between columns
        ("......\nE====X\n......", {"row_depths_m": [5.4, 3.8, 5.4]}, "bay.row_depths_m"),  # the doors are narrower
        (".E.\n.=.\n.=.\n.X.", {"column_widths_m": [5.4, 3.8, 5.4]}, "bay.column_widths_m"),
        ("...\n.=X\n.=.\n.E.", {"column_widths_m": [5.4, 4, 5.4], "row_depths_m": [6, 3.1, 6, 6]}, "bay.row_depths_m"),
    ],
)
def test_lanes_and_doors_too_narrow_for_cars_are_refused(rows, bay, field):
    with pytest.raises(ConfigError, match=r"2\.5 m are clear") as caught:
        generate(GarageConfig(site={"structure": rows}, bay=bay))
    assert caught.value.field == field
    assert caught.value.value in {1, 3.1, 3.8}


def test_the_narrowest_garage_that_is_not_refused_leaves_cars_their_width():
    config = GarageConfig(
        site={"structure": "......\nE====X\n......"},
        bay={"row_depths_m": [5.4, 3.86, 5.4]},
        plan={"unreachable_stalls": "keep"},
    )
    layout = generate(config).layout
    for door in layout.of_kind("portal"):
        frame = next(part for part in asset_of(door.spec).parts if part.name == "Frame")
        inner = np.abs(frame.points[frame.points[:, 1] < 0.1, 0]).min()
        assert 2 * inner == pytest.approx(2.5, abs=1e-4)


def test_a_lane_that_no_car_reaches_is_not_worn():
    layout = generate(GarageConfig(site={"structure": "#=#.....\n##......\nE=======\n......=X"})).layout
    assert (0, 1) not in {place.square for place in layout.of_kind("floor_stain") if place.name == "Wear"}


def test_tyres_stand_before_the_wheel_stops():
    """Also those of short cars that are parked nose out."""
    parking = {"occupancy": 1.0, "accessible_share": 0, "max_yaw_deg": 5.0, "bodies": dict.fromkeys(SEGMENTS, 0.1)}
    for reversed_share in (0.0, 1.0):
        layout = laid_out(IRREGULAR, GarageConfig(parking={**parking, "reversed_share": reversed_share}))
        bodies = {body.name: body for body in CAR_BODIES}
        parked = [bodies[car.spec.body] for car in layout.of_kind("car")]
        assert len(set(parked)) > 6
        assert min(body.length_m for body in parked) < 3.6
        assert not list(Solids(layout, ("car", "wheel_stop")).clashes())


def test_occupancy_is_told_stall_by_stall():
    text = "....\n====\nE..X"
    names = [stall.name for stall in laid_out(text, GarageConfig()).stalls]
    wanted = names[1:6:2]
    only = laid_out(text, GarageConfig(parking={"occupied_stalls": wanted}))
    assert [car.stall for car in only.of_kind("car")] == wanted
    most = laid_out(text, GarageConfig(parking={"occupancy": 1.0, "empty_stalls": wanted}))
    assert [car.stall for car in most.of_kind("car")] == [n for n in names if n not in wanted]


@pytest.mark.parametrize(
    ("parking", "message"),
    [
        ({"occupied_stalls": ["Stall_r99_c00_1"]}, r"parking.occupied_stalls.*'Stall_r99_c00_1'.*Stall_r00_c00_1"),
        ({"empty_stalls": ["no such"]}, r"parking.empty_stalls.*'no such'"),
    ],
)
def test_unknown_stalls_are_named(parking, message):
    with pytest.raises(ConfigError, match=message):
        laid_out("....\n====\nE..X", GarageConfig(parking=parking))


def test_a_stall_is_not_both_occupied_and_empty():
    with pytest.raises(ConfigError, match="Stall_r00_c00_1"):
        GarageConfig(parking={"occupied_stalls": ["Stall_r00_c00_1"], "empty_stalls": ["Stall_r00_c00_1"]})


def test_a_turning_stall_takes_no_car():
    text = ".......\n=======\n=.X....\nE......"
    turning = next(s.name for s in laid_out(text, GarageConfig()).stalls if s.use is StallUse.TURNING)
    with pytest.raises(ConfigError, match=turning):
        laid_out(text, GarageConfig(parking={"occupied_stalls": [turning]}))


def test_wheel_stops_are_bars_pairs_or_none():
    def stops(asked):
        fittings = {} if asked is None else {"wheel_stops": asked}
        return laid_out(IRREGULAR, GarageConfig(fittings=fittings)).of_kind("wheel_stop")

    bars, pairs = stops(True), stops("pairs")
    assert bars == stops(None)
    assert not stops(False)
    assert [stop.position_m for stop in bars] == [stop.position_m for stop in pairs]
    for bar, pair in zip(bars, pairs, strict=True):
        left, right = (shapely.Polygon(outline).bounds for outline in pair.spec.outlines())
        (whole,) = (shapely.Polygon(outline).bounds for outline in bar.spec.outlines())
        assert (left[0], right[2]) == (whole[0], whole[2])
        assert right[0] - left[2] == pytest.approx(0.65)
        meshes = pair.spec.asset().parts
        assert not any(-0.32 < x < 0.32 for part in meshes for x in part.points[:, 0])
    with pytest.raises(ValueError, match=r"wheel_stops"):
        GarageConfig(fittings={"wheel_stops": "triple"})
