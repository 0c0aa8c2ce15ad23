"""Lines of stalls: round ends, rounded corners, hairpins and open rears, by their areas and where they lie."""

import math

import pytest
import shapely
from support.soak import soak_but

from garage2usd.common.errors import ConfigError
from garage2usd.config import config_from_mapping
from garage2usd.config.look import MarkingsLook, StallPattern
from garage2usd.garage import StallKind
from garage2usd.imports import import_layout
from garage2usd.layout.floor.stall_lines import outer_round_lines, stall_lines
from garage2usd.objects.panel import Surface
from garage2usd.pipeline import generate

WIDTH, LENGTH, LINE = 2.4, 5.3, 0.12
STALL = shapely.box(-WIDTH / 2, -LENGTH / 2, WIDTH / 2, LENGTH / 2)
CLOSED = {"pattern": "closed", "line_ends": "round", "corner_radius_m": 0.3}
FREE = {"sides": 4, "t_marks": 12, "l_marks": 20, "corners": 10}
"""Convex corners of the lines on one stall, or their halves, that round ends take off."""


def look(**axes):
    return MarkingsLook(line_width_m=LINE, **axes)


def ground(markings):
    return shapely.union_all([shapely.Polygon(mark.polygon) for mark in markings], grid_size=1e-6)


def lines(**axes):
    return stall_lines(WIDTH, LENGTH, look(**axes))


def quarter(radius):
    return math.pi / 4 * radius**2


@pytest.mark.parametrize("wear", ["fresh", "worn"])
@pytest.mark.parametrize("behind", [True, False])
@pytest.mark.parametrize("ends", ["square", "round"])
@pytest.mark.parametrize("pattern", StallPattern)
def test_lines_lie_on_their_stall_and_never_on_each_other(pattern, ends, behind, wear):
    for width, length in ((WIDTH, LENGTH), (1.0, 2.2), (6.0, 2.3)):
        axes = {"pattern": pattern, "line_ends": ends, "closed_behind": behind, "wear": wear, "corner_radius_m": 0.4}
        markings = stall_lines(width, length, MarkingsLook(**axes))
        painted = ground(markings)
        assert all(shapely.Polygon(mark.polygon).is_valid for mark in markings)
        assert painted.difference(shapely.box(-width / 2, -length / 2, width / 2, length / 2)).area < 1e-6
        assert painted.symmetric_difference(shapely.affinity.scale(painted, -1, origin=(0, 0))).area < 1e-4
        if ends == "round":
            assert sum(shapely.Polygon(mark.polygon).area for mark in markings) == pytest.approx(painted.area, abs=1e-5)


def test_a_hairpin_is_two_lines_and_half_a_circle():
    outer, inner = 0.15 + LINE, 0.15
    legs = 2 * LINE * (LENGTH - outer)
    rear = (WIDTH - 2 * outer) * LINE
    bends = 2 * (quarter(outer) - quarter(inner))
    painted = ground(lines(pattern="hairpin"))
    assert painted.area == pytest.approx(legs + rear + bends, rel=1e-3)
    assert ground(lines(pattern="hairpin", closed_behind=False)).area == pytest.approx(legs + bends, rel=1e-3)
    mouth = LENGTH / 2
    centre = shapely.Point(WIDTH / 2, mouth - outer)
    bend = painted.intersection(shapely.box(0, mouth - outer, WIDTH / 2, mouth))
    distances = [centre.distance(shapely.Point(point)) for point in shapely.get_coordinates(bend)]
    assert min(distances) == pytest.approx(inner, abs=1e-5)
    assert max(distances) == pytest.approx(outer, abs=1e-5)
    # the bends of two neighbours meet, and there is floor between their lines
    assert painted.intersection(shapely.LineString([(WIDTH / 2, mouth), (WIDTH / 2, -mouth)])).length == pytest.approx(
        LINE
    )
    assert not painted.intersects(shapely.box(WIDTH / 2 - inner + 1e-3, -mouth, WIDTH / 2, mouth - outer))


@pytest.mark.parametrize("slope", [-1.0, 0.5])
def test_hairpins_of_angled_stalls_end_in_half_circles_at_the_mouth(slope):
    sheared = stall_lines(WIDTH, LENGTH, look(pattern="hairpin", closed_behind=False), slope)
    paint = shapely.affinity.affine_transform(ground(sheared), [1, 0, slope, 1, 0, 0])
    radius = 0.15 + LINE
    for side, sign in ((-WIDTH / 2, 1), (WIDTH / 2, -1)):
        # the centre of a circle that touches the slanted mouth
        centre = shapely.Point(side, LENGTH / 2 + slope * side - radius * math.hypot(1, slope))
        left, right = sorted((side, side + sign))
        around = shapely.box(left, centre.y, right, centre.y + 1)
        bend = paint.intersection(around)
        ring = centre.buffer(radius, quad_segs=64).difference(centre.buffer(0.15, quad_segs=64)).intersection(around)
        assert bend.symmetric_difference(ring).area < 0.03 * ring.area
        mouth = shapely.LineString([(x, LENGTH / 2 + slope * x) for x in (-WIDTH, WIDTH)])
        assert mouth.distance(centre) == pytest.approx(radius)


@pytest.mark.parametrize("radius", [0.15, 0.3, 0.4])
@pytest.mark.parametrize("behind", [True, False])
def test_closed_stalls_have_corners_of_the_radius(radius, behind):
    axes = CLOSED | {"corner_radius_m": radius, "closed_behind": behind}
    beside = outer_round_lines(WIDTH, LENGTH, look(**axes))
    outer = shapely.transform(ground(beside), lambda at: at * (1, -1) + (WIDTH / 2, LENGTH / 2))
    whole = shapely.union_all([ground(lines(**axes)), outer], grid_size=1e-6)
    mouth = shapely.Point(WIDTH / 2 + LINE / 2, LENGTH / 2)
    rear = shapely.Point(WIDTH / 2 + LINE / 2, -LENGTH / 2)
    gap = (math.sqrt(2) - 1) * radius
    assert mouth.distance(whole) == pytest.approx(gap, abs=3e-3)
    assert rear.distance(whole) == pytest.approx(gap if behind else 0.0, abs=3e-3)
    # as wide as the line all the way, and square inside only where the radius is less than the line
    side = shapely.LineString([(WIDTH / 2 - 0.5, 0), (WIDTH / 2 + 0.5, 0)])
    assert whole.intersection(side).length == pytest.approx(LINE, abs=1e-5)
    cut = shapely.LineString([(WIDTH / 2 + LINE / 2 - radius, LENGTH / 2 - radius), mouth.coords[0]])
    assert whole.intersection(cut).length == pytest.approx(LINE, abs=2e-3)


@pytest.mark.parametrize("pattern", FREE)
def test_round_ends_take_off_corners_and_add_nothing(pattern):
    axes = {"pattern": pattern, "closed_behind": pattern != "sides"}
    square, rounded = ground(lines(**axes)), ground(lines(line_ends="round", **axes))
    assert rounded.difference(square).area < 1e-6
    radius = LINE / 2
    taken = FREE[pattern] * (radius**2 - quarter(radius))
    assert square.area - rounded.area == pytest.approx(taken, rel=0.02, abs=1e-6)


@pytest.mark.parametrize("ends", ["square", "round"])
@pytest.mark.parametrize(
    "pattern", [one for one in StallPattern if one not in {StallPattern.CORNERS, StallPattern.NONE}]
)
def test_rears_are_closed_or_open(pattern, ends):
    shut, left_open = (ground(lines(pattern=pattern, line_ends=ends, closed_behind=behind)) for behind in (True, False))
    across = shapely.LineString([(0.5 - WIDTH / 2, 0.05 - LENGTH / 2), (WIDTH / 2 - 0.5, 0.05 - LENGTH / 2)])
    rear = shapely.box(-WIDTH / 2, -LENGTH / 2, WIDTH / 2, 0.5 - LENGTH / 2)
    assert shut.intersection(rear).area > left_open.intersection(rear).area + 1e-3
    assert not left_open.intersects(across)
    mouth = shapely.box(-WIDTH / 2, 0, WIDTH / 2, LENGTH / 2)
    if pattern is not StallPattern.DASHED:
        assert shut.intersection(mouth).area == pytest.approx(left_open.intersection(mouth).area, abs=1e-6)


def test_round_corners_wear_where_wheels_cross():
    worn = [mark for mark in lines(**CLOSED, wear="worn") if mark.surface is Surface.PAINT_STALL_WORN]
    boxes = [shapely.Polygon(mark.polygon).bounds for mark in worn]
    assert sorted((left, right) for left, _, right, _ in boxes) == [(-1.0, -0.5), (0.5, 1.0)]
    assert all(low >= LENGTH / 2 - LINE - 1e-6 for _, low, _, _ in boxes)
    uneven, even = (ground(lines(**CLOSED, wear=wear)) for wear in ("worn", "fresh"))
    assert uneven.symmetric_difference(even).area < 1e-5


@pytest.fixture(scope="module")
def mixed():
    """Build a garage with stalls of all kinds."""
    stalls = {"kinds": {"perpendicular": 0.4, "angled": 0.3, "parallel": 0.3}, "angles_deg": [60]}
    return generate(
        config_from_mapping(
            {
                "seed": 5,
                "site": {"width_cells": 8, "height_cells": 8},
                "plan": {"aisles": "one-way", "episodes": 100},
                "stalls": stalls,
                "look": {"markings": CLOSED | {"line_width_m": LINE, "wear": "fresh"}},
            }
        )
    ).layout


def painted(layout):
    """The ground of all stall lines, and of floor that stalls cover."""
    taken = shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in layout.stalls])
    shapes = []
    for kind in ("floor", "stall"):
        for place in layout.of_kind(kind):
            for mark in place.spec.markings:
                if mark.surface is Surface.PAINT_STALL:
                    shape = shapely.Polygon([place.to_world(point) for point in mark.polygon])
                    shapes.append(shape if kind == "stall" else shape.difference(taken))
    return shapely.union_all(shapes, grid_size=1e-6)


def test_side_lines_are_whole_at_the_ends_of_rows_of_all_kinds(mixed):
    kinds = {stall.stall_kind for stall in mixed.stalls}
    assert kinds == set(StallKind)
    paint = painted(mixed)
    grounds = {stall.name: shapely.Polygon(stall.corners_m()) for stall in mixed.stalls}
    checked = 0
    for stall in mixed.stalls:
        left, right, rear_right, rear_left = stall.corners_m()
        for (x, z), (rear_x, rear_z) in ((left, rear_left), (right, rear_right)):
            middle = shapely.Point((x + rear_x) / 2, (z + rear_z) / 2)
            # lines of rows a little apart run into each other
            if any(1e-4 < other.distance(middle) < LINE for name, other in grounds.items() if name != stall.name):
                continue
            checked += 1
            along = math.atan2(rear_z - z, rear_x - x) + math.pi / 2
            reach = shapely.LineString(
                [(middle.x + sign * 0.1 * math.cos(along), middle.y + sign * 0.1 * math.sin(along)) for sign in (-1, 1)]
            )
            assert paint.intersection(reach).length == pytest.approx(LINE, abs=1e-4), (stall.name, stall.stall_kind)
    assert checked > 1.5 * len(mixed.stalls)


@pytest.mark.parametrize("axes", soak_but(1, [{"pattern": "hairpin"}, CLOSED]), ids=["hairpin", "closed"])
def test_imported_stalls_have_the_same_lines(axes, tmp_path):
    drawing = tmp_path / "drawing.toml"
    drawing.write_text(
        "outline = [[0, 0], [40, 0], [36, 18.2], [0, 18.2]]\n"
        "lanes = [{points = [[0, 8.8], [40, 8.8]], width_m = 6}]\n"
        'portals = [{at = [0, 8.8], kind = "entrance"}, {at = [40, 8.8], kind = "exit"}]\n'
        '[[runs]]\nfirst = [6, 5.8]\nlast = [33.5, 5.8]\nside = "left"\ncount = 11\nlength_m = 5.3\n'
    )
    config = config_from_mapping({"look": {"markings": axes}, "stage": {"texture_quality": "low"}})
    layout = import_layout(drawing, tmp_path / "garage.usdc", config=config).garage.layout
    shapes = {place.spec for place in layout.of_kind("stall")}
    markings = layout.look.markings
    assert {spec.markings for spec in shapes} == {stall_lines(2.5, 5.3, markings)}


@pytest.mark.parametrize(
    ("axes", "told"),
    [
        ({"line_ends": "oval"}, "square' or 'round"),
        ({"corner_radius_m": 0.6}, "0.4"),
        ({"closed_behind": "sometimes"}, "closed_behind"),
        ({"pattern": "hairpins"}, "hairpin"),
    ],
)
def test_other_values_are_told_with_what_is_allowed(axes, told):
    with pytest.raises(ConfigError, match=next(iter(axes))) as refused:
        config_from_mapping({"look": {"markings": axes}})
    assert told in str(refused.value)
    assert "\n" not in str(refused.value)
