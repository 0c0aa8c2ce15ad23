"""Small lots of many shapes: every stall is placed, doors are where roads cross the outline, and nothing is made up."""

import math

import pytest
import shapely

from garage2usd.config import GarageConfig
from garage2usd.driving import prove_stalls
from garage2usd.garage import LaneKind
from garage2usd.layout.surveyed import lay_out_survey
from garage2usd.survey.lots import in_lots
from garage2usd.survey.survey import (
    PortalKind,
    Survey,
    SurveyedColumn,
    SurveyedLane,
    SurveyedPortal,
    SurveyedStall,
    aligned,
)

UP, DOWN, LEFT, RIGHT = (0, -1), (0, 1), (-1, 0), (1, 0)


def box(left, top, right, bottom):
    return ((left, top), (right, top), (right, bottom), (left, bottom))


def row(x, z, count, *, along=RIGHT, into=UP, width=2.5, length=5.0):
    """Stalls with their mouths on a line from (x, z)."""
    found = []
    for number in range(count):
        (x0, z0), (x1, z1) = ((x + along[0] * width * at, z + along[1] * width * at) for at in (number, number + 1))
        found.append(
            ((x0, z0), (x1, z1), *((at[0] + into[0] * length, at[1] + into[1] * length) for at in ((x1, z1), (x0, z0))))
        )
    return found


def slanted(x, z, count, deg, *, width=2.5, length=5.0, up=-1):
    """Stalls at an angle whose rectangles for a car have a width and a length."""
    angle = math.radians(deg)
    step, side = width / math.sin(angle), length + width / math.tan(angle)
    off_x, off_z = math.cos(angle) * side, up * math.sin(angle) * side
    starts = [x + number * step for number in range(count)]
    return [((at, z), (at + step, z), (at + step + off_x, z + off_z), (at + off_x, z + off_z)) for at in starts]


def survey(stalls, lanes=(), outline=None, portals=(), **parts):
    named = tuple(SurveyedStall(f"s{number}", corners) for number, corners in enumerate(stalls))
    ways = tuple(lane if isinstance(lane, SurveyedLane) else SurveyedLane(tuple(lane), 6.0) for lane in lanes)
    return Survey(named, ways, outline=outline, portals=tuple(SurveyedPortal(*portal) for portal in portals), **parts)


def one_way(points, width_m=5.0):
    return SurveyedLane(tuple(points), width_m, one_way=True)


def laid_out(found):
    return lay_out_survey(aligned(in_lots(found))[0], GarageConfig())


def doors(layout):
    """Entrances, exits, and doors in the walls."""
    kinds = [node.kind for node in layout.source.network.nodes if node.is_portal]
    return kinds.count("entrance"), kinds.count("exit"), len(list(layout.of_kind("portal")))


def two_rows(count, x=0, z=0, aisle=6.0):
    return row(x, z + 5, count) + row(x, z + 5 + aisle, count, into=DOWN)


L_OUTLINE = ((0, 0), (60, 0), (60, 16), (16, 16), (16, 50), (0, 50))
L_STALLS = row(2.5, 5, 23) + row(17, 11, 17, into=DOWN) + row(5, 47, 7, along=UP, into=LEFT)
L_LANE = [(8, 50), (8, 8), (60, 8)]
T_STALLS = [
    *row(0, 5, 16),
    *row(0, 11, 6, into=DOWN),
    *row(25, 11, 6, into=DOWN),
    *row(17, 31, 6, along=UP, into=LEFT),
    *row(23, 31, 6, along=UP, into=RIGHT),
]
T_OUTLINE = ((0, 0), (40, 0), (40, 16), (28, 16), (28, 31), (12, 31), (12, 16), (0, 16))
RING = [(8, 8), (33, 8), (33, 22), (8, 22), (8, 8)]
RING_STALLS = [
    *row(8, 5, 10),
    *row(8, 25, 10, into=DOWN),
    *row(5, 23, 6, along=UP, into=LEFT),
    *row(36, 8, 6, along=DOWN, into=RIGHT),
    *row(11, 11, 7, into=DOWN, length=4),
    *row(11, 19, 7, length=4),
]
DOUBLE = row(3, 5, 10) + row(3, 11, 10, into=DOWN) + row(3, 21, 10) + row(3, 27, 10, into=DOWN)
BOTH, ENTRANCE, EXIT = PortalKind.BOTH, PortalKind.ENTRANCE, PortalKind.EXIT
LOTS = {
    "L with two doors": (survey(L_STALLS, [L_LANE], L_OUTLINE, [((60, 8), BOTH), ((8, 50), BOTH)]), (2, 2, 2)),
    "L without doors": (survey(L_STALLS, [L_LANE], L_OUTLINE), (1, 1, 1)),
    "L with roads beyond": (survey(L_STALLS, [[(8, 56), (8, 8), (68, 8)]], L_OUTLINE), (2, 2, 2)),
    "one-way L": (survey(L_STALLS, [one_way([(8, 49), (8, 8), (59, 8)])], L_OUTLINE), (1, 1, 2)),
    "T": (survey(T_STALLS, [[(2, 8), (38, 8)], [(20, 8), (20, 45)]], T_OUTLINE), (1, 1, 1)),
    "T as a table": (survey(T_STALLS), (1, 1, 1)),
    "one-way ring": (survey(RING_STALLS, [one_way(RING)], box(0, 0, 41, 30)), (1, 1, 1)),
    "one-way ring, other way round": (survey(RING_STALLS, [one_way(RING[::-1])]), (1, 1, 1)),
    "ring with an entrance and an exit": (
        survey(RING_STALLS[:10] + RING_STALLS[23:], [RING], box(0, 0, 41, 30), [((0, 6), ENTRANCE), ((0, 27), EXIT)]),
        (1, 1, 2),
    ),
    "stalls up to a door's wall": (
        survey(two_rows(8), [[(0, 8), (20, 8)]], box(0, 0, 20, 16), [((0, 8), BOTH)]),
        (1, 1, 1),
    ),
    "stalls between two doors": (
        survey(two_rows(8), [[(0, 8), (20, 8)]], box(0, 0, 20, 16), [((0, 8), ENTRANCE), ((20, 8), EXIT)]),
        (1, 1, 2),
    ),
    "a road and its gates": (
        survey(
            two_rows(8), [[(-12, 8), (32, 8)]], box(0, 0, 20, 16), [((0, 8), BOTH), ((-0.5, 8), BOTH), ((20, 8), BOTH)]
        ),
        (2, 2, 2),
    ),
    "a one-way road through": (survey(two_rows(8), [one_way([(-15, 8), (30, 8)])], box(0, 0, 20, 16)), (1, 1, 2)),
    "a table of two rows": (survey(two_rows(8)), (1, 1, 1)),
    "a table of four rows": (survey(two_rows(6) + two_rows(6, z=16)), (2, 2, 2)),
    "a table of one row": (survey(row(0, 5, 5)), (1, 1, 1)),
    "a table of two stalls": (survey(two_rows(1)), None),
    "a table in an L": (
        survey(row(0, 5, 10) + row(8, 11, 7, into=DOWN) + row(2, 24, 5, along=UP, into=LEFT)),
        (1, 1, 1),
    ),
    "double rows, one aisle unknown": (survey(DOUBLE, [[(0, 8), (32, 8)]], box(0, 0, 34, 32)), (1, 1, 1)),
    "double rows, aisles apart": (
        survey(DOUBLE, [[(1, 8), (27, 8)], [(1, 24), (27, 24)]], box(0, 0, 28.2, 32)),
        (2, 2, 2),
    ),
    "angled, one way": (
        survey(slanted(3, 6, 6, 45) + slanted(3, 11, 6, 45, up=1), [one_way([(0, 8.5), (33, 8.5)])]),
        (1, 1, 2),
    ),
    "angled at 75 degrees, a table": (survey(slanted(0, 6, 6, 75) + slanted(1, 12, 6, 75, up=1)), (1, 1, 1)),
    "a lane that ends at a stall": (
        survey([*two_rows(6), box(20, 6.75, 25, 9.25)], [[(0, 8), (19, 8)]], box(0, 0, 25, 16)),
        (1, 1, 1),
    ),
    "a stall in the corner by the door": (
        survey(
            [*row(6, 5, 6), *row(6, 11, 6, into=DOWN), box(0, 0, 2.5, 5)],
            [[(0, 8), (24, 8)]],
            box(0, 0, 24, 16),
            [((0, 8), BOTH)],
        ),
        (1, 1, 1),
    ),
    "a door over against a row": (
        survey(row(0, 11, 8, into=DOWN), [[(10, 0), (10, 8)], [(1, 8), (19, 8)]], box(0, 0, 20, 16), [((10, 0), BOTH)]),
        (1, 1, 1),
    ),
    "six stalls beside the lane": (survey(row(0, 5, 6), [[(0, 8), (15, 8)]]), (1, 1, 1)),
    "four stalls in a cell": (survey(two_rows(2), [[(0, 8), (5, 8)]], box(0, 0, 5, 16)), (1, 1, 1)),
    "a block beside the lane": (
        survey(two_rows(8), [[(0, 8), (26, 8)]], box(0, 0, 26, 16), [((0, 8), BOTH)], solids=(box(20, 0, 23, 5),)),
        (1, 1, 1),
    ),
    "columns between stalls": (
        survey(
            [part for x in (0.4, 8.3) for part in row(x, 5, 3) + row(x, 11, 3, into=DOWN)],
            [[(-3, 8), (18, 8)]],
            box(-3, 0, 18, 16),
            columns=tuple(SurveyedColumn((x, z), 0.4) for x in (0.1, 8.1, 16.1) for z in (4, 12)),
        ),
        (1, 1, 1),
    ),
    "an outline through the stalls": (survey(two_rows(11), [[(0, 8), (28, 8)]], box(0, 0.3, 28, 16)), (1, 1, 1)),
    "an outline around the stalls only": (survey(row(0, 5, 8), [[(-5, 8), (30, 8)]], box(0, 0, 20, 5)), (1, 1, 1)),
    "parallel stalls": (
        survey([box(2 + 6 * number, 0, 8 + 6 * number, 2.2) for number in range(5)], [one_way([(0, 4.7), (34, 4.7)])]),
        (1, 1, 2),
    ),
}


@pytest.mark.parametrize(("lot", "expected"), LOTS.values(), ids=LOTS)
def test_no_stall_of_a_small_lot_is_lost(lot, expected):
    layout = laid_out(lot)
    source = layout.source
    assert source.unplaced == ()
    assert len(layout.quads) == len(lot.stalls)
    if expected is not None:
        assert doors(layout) == expected
    # each stall is entered from a lane that cars get to, over no other stall
    assert {quad.access for quad in layout.quads} <= source.network.driven
    ground = shapely.Polygon(source.survey.outline).buffer(1e-3)
    edges = [[source.network.nodes[node].position for node in (edge.start, edge.end)] for edge in source.network.edges]
    assert all(ground.covers(shapely.LineString(ends)) for ends in edges)
    openings = shapely.union_all([shapely.LineString(ends) for ends in edges])
    inner = shapely.union_all([shapely.Polygon(quad.corners).buffer(-0.3) for quad in layout.quads])
    assert not openings.intersects(inner)


@pytest.mark.parametrize(
    "name",
    [
        "stalls up to a door's wall",
        "a table of two stalls",
        "one-way ring",
        "six stalls beside the lane",
        "a table in an L",
    ],
)
def test_cars_drive_into_every_stall_of_a_small_lot(name):
    layout = laid_out(LOTS[name][0])
    assert [proof.stall for proof in prove_stalls(layout) if not proof.is_proven] == []


def test_one_way_lanes_are_entered_where_they_begin_and_left_where_they_end():
    layout = laid_out(LOTS["one-way L"][0])
    at = {node.kind: node.position for node in layout.source.network.nodes if node.is_portal}
    assert math.dist(at[LaneKind.ENTRANCE.value], (8, 50)) < 3
    assert math.dist(at[LaneKind.EXIT.value], (60, 8)) < 3


def test_a_road_and_its_gates_are_one_door_where_it_crosses():
    layout = laid_out(LOTS["a road and its gates"][0])
    middles = sorted((place.position_m[0], place.position_m[2]) for place in layout.of_kind("portal"))
    assert [(round(x, 1), round(z, 2)) for x, z in middles] == [(0.0, 8.0), (20.0, 8.0)]
    assert "lanes lie beyond the outline" in layout.source.survey.remarks[0]


def test_what_was_added_or_mended_is_said():
    assert "1 lane to stalls" not in " ".join(laid_out(LOTS["L with two doors"][0]).source.survey.remarks)
    for name, words in (
        ("double rows, one aisle unknown", "laid over free ground"),
        ("L without doors", "doors are added"),
        ("an outline through the stalls", "the outline leaves out ground of s0"),
        ("an outline around the stalls only", "the outline has no lanes inside"),
    ):
        assert words in " ".join(laid_out(LOTS[name][0]).source.survey.remarks), name


def test_lanes_and_stalls_on_both_sides_of_a_wall_stay_apart():
    # a court in the shape of a U: each arm is entered by itself, as the way over the wall is none
    outline = ((0, 0), (30, 0), (30, 20), (16, 20), (16, 5.5), (14, 5.5), (14, 20), (0, 20))
    stalls = row(5, 18, 5, along=UP, into=LEFT) + row(25, 18, 5, along=UP, into=RIGHT)
    layout = laid_out(survey(stalls, [[(10, 20), (10, 7)], [(20, 20), (20, 7)]], outline))
    assert layout.source.unplaced == ()
    wall = shapely.box(14, 5.5, 16, 20)
    nodes = layout.source.network.nodes
    for edge in layout.source.network.edges:
        assert not wall.intersects(shapely.LineString([nodes[edge.start].position, nodes[edge.end].position]))


def test_stalls_with_a_true_hindrance_are_named_by_it():
    far = box(600, 0, 602.5, 5)
    behind = box(0, -5.2, 2.5, -0.2)
    found = laid_out(survey([*two_rows(8), far, behind], [[(0, 8), (20, 8)]], box(0, -5.3, 20, 16)))
    reasons = {part.name: part.reason for part in found.source.unplaced}
    assert reasons["s16"] == "a stall 580 m outside the outline, more than 500"
    assert reasons["s17"].startswith("stall s0 lies between it and its lane") or "free sides" in reasons["s17"]


@pytest.mark.parametrize("is_outlined", [True, False])
def test_lots_apart_have_walls_and_doors_of_their_own(is_outlined):
    """The second lot is 60 m away, at another angle, and a road of the file leads from one to the other."""

    def turned(points):
        return tuple(shapely.affinity.rotate(shapely.LineString(points), 30, (90, 28)).coords)

    stalls = [*two_rows(8), *map(turned, two_rows(8, 80, 20))]
    road = [(0, 8), (20, 8), *turned([(80, 28), (100, 28)])]
    others = (turned(box(80, 20, 100, 36)),) if is_outlined else ()
    between = box(40, 0, 50, 10)
    found = laid_out(survey(stalls, [road], box(0, 0, 20, 16), other_outlines=others, solids=(between,)))
    assert found.source.unplaced == ()
    assert len(found.source.fitted) == 32
    lots = shapely.get_parts(found.source.survey.ground)
    assert len(lots) == 2
    graph = found.source.network
    of = [[lot.dwithin(shapely.Point(node.position), 1.5) for lot in lots].index(True) for node in graph.nodes]
    assert all(of[edge.start] == of[edge.end] for edge in graph.edges)
    kinds = {(place, node.kind) for node, place in zip(graph.nodes, of, strict=True) if node.is_portal}
    assert kinds == {(lot, kind) for lot in (0, 1) for kind in ("entrance", "exit")}
    standing = [ring for kind in ("wall", "portal") for wall in found.of_kind(kind) for ring in wall.outlines()]
    walls = shapely.union_all([shapely.Polygon(ring).buffer(0.05) for ring in standing])
    doors_m = sum(portal.spec.length_m for portal in found.of_kind("portal"))
    edge = shapely.union_all([lot.exterior for lot in lots])
    assert edge.difference(walls).length < doors_m
    assert not any(True for _ in found.of_kind("obstacle"))
    assert any("2 lots lie apart" in remark for remark in found.source.survey.remarks)
    assert [proof.stall for proof in prove_stalls(found) if not proof.is_proven] == []
