import re

import pytest
import shapely
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.as_built.driven_ground import driven_garage
from garage2usd.checks import read_garage
from garage2usd.driving import SquareUse
from garage2usd.driving.assembly import StandingThing, assembled
from garage2usd.driving.layout_garage import layout_garage
from garage2usd.garage import LaneEdge

DEAD_END = """
######
E====X
#..=..
#.==..
######
"""
"""A dead end below the junction, with a bend."""


def put_together(*, standing=(), edges=(), dead_ends=()):
    """Two stalls at an entrance, four lanes and an exit."""
    stalls = [("A", (0.0, 5.0), 0.0, 1), ("B", (2.5, 5.0), 0.0, 1)]
    kinds = ["entrance", "straight", "t_junction", "crossroads", "straight", "exit"]
    squares = [((8.0 * number, 0.0), (8.0, 6.0), kind) for number, kind in enumerate(kinds)]
    return assembled(stalls, squares, edges, dead_ends, standing)


def thing(name, label, home=None):
    return StandingThing(name, label, shapely.box(0, 0, 1, 1), home)


def test_a_car_a_wheel_stop_and_cones_belong_to_the_stall_they_stand_in():
    garage = put_together(
        standing=[
            thing("car of A", "car", "A"),
            thing("stop of B", "wheel_stop", "B"),
            thing("cone of B", "traffic_cone", "B"),
            thing("charger of A", "charger", "A"),
            thing("column of A", "column", "A"),
            thing("car on the lane", "car"),
            thing("cone on the lane", "traffic_cone"),
        ]
    )
    one, other = garage.stalls
    assert (one.own, one.absent) == (("car of A",), None)
    assert (other.own, other.absent) == (("stop of B", "cone of B"), "a car in B")
    assert garage.standing.names[-2:] == ("car of A", "car on the lane")
    assert garage.standing.names[:3] == ("stop of B", "cone of B", "charger of A")
    assert [square.use for square in garage.directions.squares] == [
        SquareUse.ENTRANCE, SquareUse.LANE, SquareUse.LANE, SquareUse.LANE, SquareUse.LANE, SquareUse.EXIT,
    ]  # fmt: skip


def test_a_carriageway_is_driven_in_both_directions_unless_it_is_one_way():
    edges = [LaneEdge(0, 1, 5.0, one_way=True), LaneEdge(2, 1, 6.0, one_way=False)]
    assert put_together(edges=edges).directions.widths_m == {(0, 1): 5.0, (2, 1): 6.0, (1, 2): 6.0}


@pytest.mark.parametrize(("length_m", "is_backed_out_of"), [(12.0, True), (26.0, True), (26.001, False)])
def test_a_dead_end_of_26_m_is_backed_out_of(length_m, is_backed_out_of):
    edges = [LaneEdge(one, other, 6.0, one_way=False) for one, other in ((1, 2), (2, 3), (3, 4), (1, 0))]
    backing = put_together(edges=edges, dead_ends=[([4, 3], length_m)]).directions.backing
    assert backing == ({(2, 3), (3, 4)} if is_backed_out_of else frozenset())


def by_square(path):
    """Name of an object as a layout has it, of its prim's path."""
    return re.sub(r".*/Tile_(r\d+_c\d+/.*)|.*/(.*)", r"\1\2", path)


@pytest.mark.parametrize("structure", [SETTINGS["site"]["structure"], DEAD_END])
def test_a_layout_its_report_and_its_stage_are_the_same_garage(structure, tmp_path):
    fittings = {"cone_rate": 1.0}
    settings = SETTINGS | {"site": {"structure": structure}, "parking": {"occupancy": 0.5}, "fittings": fittings}
    built = garage2usd.build(garage2usd.GarageConfig(**settings), tmp_path / "garage.usda")
    layout, graph = built.garage.layout, built.garage.graph
    made = layout_garage(layout, graph)
    owned = {(place.stall, place.kind) for place in layout.placements if place.stall}
    stall_fittings = {"stall", "car", "number_plate", "wheel_stop", "cone", "stall_number", "charger"}
    assert stall_fittings >= {kind for _, kind in owned}
    assert {"car", "wheel_stop", "cone"} <= {kind for _, kind in owned}
    for path in (built.stage, built.report):
        read = driven_garage(read_garage(path)[0])
        assert sorted(map(by_square, read.standing.names)) == sorted(made.standing.names)
        for one, other in zip(made.stalls, read.stalls, strict=True):
            assert (one.name, one.access, one.absent) == (other.name, other.access, other.absent)
            assert other.centre_m == pytest.approx(one.centre_m, abs=1e-4)
            assert other.yaw_rad == pytest.approx(one.yaw_rad, abs=1e-4)
            assert sorted(map(by_square, other.own)) == sorted(one.own)
        assert read.directions.widths_m == pytest.approx(made.directions.widths_m, abs=1e-4)
        assert read.directions.backing == made.directions.backing
        assert [square.use for square in read.directions.squares] == [s.use for s in made.directions.squares]
    assert bool(made.directions.backing) == (structure == DEAD_END)
