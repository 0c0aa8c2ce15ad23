"""Lines, strips, older lines, hatching and numbers: that a garage has what is asked for, and nothing else moves."""

from itertools import pairwise

import pytest
import shapely
from support.looks import beside_its_look, garage
from support.soak import soak_but

from garage2usd.assets import PaintedTexture
from garage2usd.assets.colours import linear_rgb, material_colour
from garage2usd.assets.glyphs import GLYPH_PITCH, GLYPH_WIDTH
from garage2usd.config import GarageConfig
from garage2usd.config.look import LookConfig, StallPattern
from garage2usd.look import drawn_look, finishes_of
from garage2usd.look.draws import _GROUPS
from garage2usd.objects.panel import Paint, Surface
from garage2usd.objects.stall_number import NumberFrameSpec, NumberSpec, WallNumberSpec
from garage2usd.structure.grid import Cell
from garage2usd.structure.stalls import Edge

MARKED = [
    *({"pattern": pattern.value} for pattern in StallPattern),
    {"band": "line", "hatching": True, "wear": "worn"},
    {"pattern": "closed", "line_ends": "round", "closed_behind": False},
    {"band": "band", "band_both_sides": False, "pictogram": "car", "ghosts": 1.0, "zebra": 1.0},
]


def without(kind, made):
    """What no look changes, but for the objects of a kind."""
    kept = beside_its_look(made)
    is_other = [own != kind for own in kept["kinds"]]
    lists = ("names", "kinds", "places", "outlines")
    return kept | {key: [one for one, other in zip(kept[key], is_other, strict=True) if other] for key in lists}


def markings(made, kind):
    return [marking for place in made.layout.of_kind(kind) for marking in place.spec.markings]


def area(made, kind, surface):
    """Painted ground of a surface on all objects of a kind, in the garage, in m2."""
    shapes = [
        shapely.Polygon([place.to_world(point) for point in marking.polygon])
        for place in made.layout.of_kind(kind)
        for marking in place.spec.markings
        if marking.surface is surface
    ]
    return shapely.union_all(shapes, grid_size=1e-6)


@pytest.fixture(scope="module")
def usual():
    return garage()


@pytest.mark.parametrize(
    "axes", soak_but([MARKED[0], *MARKED[-2:]], MARKED), ids=lambda axes: "-".join(map(str, axes.values()))
)
def test_plan_stalls_places_and_proofs_stay_as_they_are(usual, axes):
    # patches of the floor keep off paint
    assert without("floor_stain", garage(markings=axes)) == without("floor_stain", usual)


NUMBERED = [
    {"place": "lane", "form": "full"},
    {"place": "wall"},
    {"place": "rear", "form": "boxed"},
    {"place": "middle", "height_m": 1.0},
    {"place": "none"},
]


@pytest.mark.parametrize("axes", soak_but(2, NUMBERED), ids=lambda axes: "-".join(map(str, axes.values())))
def test_numbers_move_nothing_else(usual, axes):
    assert without("stall_number", garage(numbers=axes)) == without("stall_number", usual)


@pytest.mark.parametrize("pattern", StallPattern)
def test_patterns_mark_the_mouth_or_leave_it_open(pattern):
    made = garage(markings={"pattern": pattern, "line_width_m": 0.1})
    stall = next(place for place in made.layout.of_kind("stall") if place.spec.markings or pattern == "none")
    half_x, half_z = stall.spec.width_m / 2, stall.spec.depth_m / 2
    lines = shapely.union_all(
        [shapely.Polygon(mark.polygon) for mark in stall.spec.markings if mark.paint is Paint.STALL_LINE]
    )
    # of the mouth, the share that is painted between the side lines
    mouth = shapely.LineString([(0.2 - half_x, half_z - 0.05), (half_x - 0.2, half_z - 0.05)])
    share = lines.intersection(mouth).length / mouth.length
    low, high = {
        "closed": (1.0, 1.0),
        "dashed": (0.3, 0.8),
        "double": (0.0, 0.1),
        "hairpin": (0.0, 0.1),
        "t_marks": (0.2, 0.5),
        "l_marks": (0.2, 0.5),
        "corners": (0.2, 0.5),
        "sides": (0.0, 0.0),
        "none": (0.0, 0.0),
    }[pattern]
    assert low - 1e-6 <= share <= high + 1e-6
    assert (lines.area > 0) is (pattern != "none")


def test_lines_have_the_colour_and_width():
    made = garage(markings={"colour": "yellow", "line_width_m": 0.2, "wear": "fresh"})
    finish = finishes_of(made.layout.look)["paint_stall"]
    assert material_colour(finish.material) == pytest.approx(linear_rgb("#dda72a"))
    stall = made.layout.of_kind("stall")[0]
    widths = {round(min(box[2] - box[0], box[3] - box[1]), 6) for box in map(bounds, stall.spec.markings)}
    assert {0.1, 0.2} <= widths


def bounds(marking):
    return shapely.Polygon(marking.polygon).bounds


def test_wear_takes_paint_and_more_where_wheels_cross():
    marks = {"pattern": "closed", "wear": "worn"}
    look = garage(markings=marks, floor={"finish": "asphalt", "bays": "aisle"}).layout.look
    finishes = finishes_of(look)
    ground = material_colour(finishes["floor_concrete"].material)

    def distance(role):
        return sum(abs(a - b) for a, b in zip(material_colour(finishes[role].material), ground, strict=True))

    assert isinstance(finishes["paint_stall"].material.colour_texture, PaintedTexture)
    assert distance("paint_stall") > distance("paint_stall_worn") > 0
    assert distance("paint_stall_worn") > distance("paint_ghost") * 0.5
    made = garage(markings=marks)
    worn = [bounds(mark) for mark in markings(made, "stall") if mark.surface is Surface.PAINT_STALL_WORN]
    assert worn
    assert all(left * right > 0 for left, _, right, _ in worn)
    assert any(mark.surface is Surface.PAINT_WHITE_WORN for mark in markings(made, "floor"))


def test_grades_of_wear_differ():
    shares = []
    for wear in ("fresh", "light", "worn", "faded"):
        look = GarageConfig(look={"markings": {"wear": wear}, "floor": {"finish": "asphalt", "bays": "aisle"}}).look
        shares.append(sum(material_colour(finishes_of(look)["paint_stall"].material)))
    assert all(brighter > darker for brighter, darker in pairwise(shares))


@pytest.mark.parametrize("form", ["line", "band"])
def test_strips_run_on_from_square_to_square(form):
    made = garage(markings={"band": form, "band_gap_m": 0.3, "band_width_m": 0.6})
    edges = area(made, "floor", Surface.PAINT_EDGE)
    cells = made.layout.structure.cells
    driven = [
        place for place in made.layout.of_kind("floor") if cells[place.square] in (Cell.LANE, Cell.ENTRANCE, Cell.EXIT)
    ]
    lanes = shapely.union_all([shapely.box(*square(place)) for place in driven], grid_size=1e-4)
    border = lanes.buffer(-0.36, join_style="mitre").boundary
    # the first line follows the border of the lanes all the way, but for the two doors
    away = border.difference(edges.buffer(0.6 if form == "band" else 0.01)).length
    assert (
        away <= 2 * max(made.layout.structure.column_widths_mm.max(), made.layout.structure.row_depths_mm.max()) / 1000
    )
    assert area(made, "floor", Surface.PAINT_BAND).area > 0 if form == "band" else True
    strips = [mark for mark in markings(made, "floor") if mark.surface is Surface.PAINT_BAND]
    assert all(mark.paint is None for mark in strips)


def square(place):
    x, _, z = place.position_m
    half_x, half_z = place.spec.width_m / 2, place.spec.depth_m / 2
    return x - half_x, z - half_z, x + half_x, z + half_z


def test_strips_on_one_side_are_about_half():
    both, one = (
        area(garage(markings={"band": "band", "band_both_sides": sides}), "floor", Surface.PAINT_BAND).area
        for sides in (True, False)
    )
    assert 0.3 * both < one < 0.7 * both


@pytest.mark.parametrize("kind", ["walker", "car", "lift", "none"])
def test_strips_have_pictograms(kind):
    made = garage(markings={"band": "band", "band_width_m": 1.0, "pictogram": kind})
    bands = area(made, "floor", Surface.PAINT_BAND)
    ring = shapely.union_all([shapely.Polygon(part.exterior) for part in shapely.get_parts(bands)])
    signs = [
        mark for mark in markings(made, "floor") if mark.paint is Paint.LANE_ARROW and len(mark.polygon) not in (6, 7)
    ]
    assert bool(signs) is (kind != "none")
    assert ring.area > 0


@pytest.mark.parametrize("bays", ["aisle", "coated"])
def test_ghosts_show_on_the_floor_and_are_no_lines(bays):
    made = garage(markings={"ghosts": 1.0}, floor={"bays": bays})
    on_lanes, on_stalls = (
        [mark for mark in markings(made, kind) if mark.surface is Surface.PAINT_GHOST] for kind in ("floor", "stall")
    )
    assert on_lanes
    assert bool(on_stalls) is (bays == "aisle")
    assert all(mark.paint is None for mark in [*on_lanes, *on_stalls])
    asset = made.layout.of_kind("stall")[0].spec.asset()
    assert not [part for part in asset.parts if part.material == "paint_ghost" and part.piece]


def test_more_ghosts_keep_those_that_were_there():
    few, many = (
        {
            place.square
            for place in garage(markings={"ghosts": share}, floor={"bays": "aisle"}).layout.of_kind("stall")
            if any(mark.surface is Surface.PAINT_GHOST for mark in place.spec.markings)
        }
        for share in (0.3, 0.7)
    )
    assert few < many


def test_crossings_come_by_their_share():
    counts = [
        sum(any(mark.paint is Paint.CROSSING for mark in place.spec.markings) for place in made.layout.of_kind("floor"))
        for made in (garage(markings={"zebra": share}) for share in (0.0, 0.4, 1.0))
    ]
    assert counts[0] < counts[1] < counts[2]


def test_row_ends_are_hatched_beside_stalls_only():
    made = garage(markings={"hatching": True})
    hatched = area(made, "floor", Surface.PAINT_EDGE)
    stalls = shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in made.layout.stalls])
    assert hatched.area > 1
    assert hatched.intersection(stalls).area < 1e-3


def test_numbers_stand_where_they_are_asked_for():
    offsets = {}
    for place in ("lane", "mouth", "middle", "rear"):
        made = garage(numbers={"place": place})
        stalls = {stall.name: stall for stall in made.layout.stalls}
        along = set()
        for number in made.layout.of_kind("stall_number"):
            stall = stalls[number.stall]
            x, _, z = number.position_m
            depth = {Edge.DOWN: z - stall.centre_m[1], Edge.UP: stall.centre_m[1] - z}
            depth |= {Edge.RIGHT: x - stall.centre_m[0], Edge.LEFT: stall.centre_m[0] - x}
            along.add(round(depth[stall.edge] - stall.length_m / 2, 3))
        (offsets[place],) = along
    assert offsets["lane"] > 0 > offsets["mouth"] > offsets["middle"] > offsets["rear"]


def test_numbers_on_walls_are_upright_and_elsewhere_on_the_floor():
    placed = garage(numbers={"place": "wall"}).layout.of_kind("stall_number")
    heights = {type(place.spec): set() for place in placed}
    for place in placed:
        heights[type(place.spec)].add(place.position_m[1])
    assert heights[NumberSpec] == {0.0}
    (height,) = heights[WallNumberSpec]
    assert height > 1


def test_full_numbers_are_read_with_their_zone_and_fit_their_stalls():
    made = garage(numbers={"form": "full", "height_m": 1.0})
    placed = {}
    for place in made.layout.of_kind("stall_number"):
        placed.setdefault(place.stall, []).append(place)
    assert {len(place.spec.digits) for places in placed.values() for place in places} <= {1, 2}
    for stall in made.layout.stalls:
        if stall.number:
            pieces = sorted(placed[stall.name], key=lambda place: -int(place.name.rsplit("_", 1)[1]))
            assert "".join(place.spec.digits for place in pieces) == stall.number
            width = (GLYPH_WIDTH + GLYPH_PITCH * (len(stall.number) - 1)) * pieces[0].spec.height_m
            assert width < stall.width_m - 0.2


def test_frames_hold_their_numbers():
    made = garage(numbers={"form": "boxed", "height_m": 0.3})
    kinds = [type(place.spec) for place in made.layout.of_kind("stall_number")]
    numbered = sum(bool(stall.number) for stall in made.layout.stalls)
    assert kinds.count(NumberFrameSpec) == numbered


def test_no_numbers_where_fittings_have_none():
    config = GarageConfig(fittings={"stall_numbers": False}, look={"numbers": {"place": "wall"}})
    assert not config.fittings.stall_numbers
    assert not garage(numbers={"place": "none"}).layout.of_kind("stall_number")


def test_the_shares_name_every_axis_of_a_look():
    shares = {f"{group}.{axis}" for group, axes in _GROUPS.items() for axis in axes}
    assert shares == set(LookConfig(drawn=True).axes)


def test_most_drawn_lines_close_the_entry():
    drawn = [drawn_look(GarageConfig(look={"drawn": True}).look, seed).markings for seed in range(400)]
    closed = sum(one.pattern in {StallPattern.CLOSED, StallPattern.DASHED} for one in drawn) / len(drawn)
    assert 0.62 <= closed <= 0.8
    assert {one.wear for one in drawn} == set(type(drawn[0].wear))
    assert {one.pattern for one in drawn} == set(StallPattern)
    assert 0.1 < sum(one.line_ends == "round" for one in drawn) / len(drawn) < 0.2
    assert 0.2 < sum(not one.closed_behind for one in drawn) / len(drawn) < 0.3
    assert 0.35 < sum(one.band != "none" for one in drawn) / len(drawn) < 0.65
