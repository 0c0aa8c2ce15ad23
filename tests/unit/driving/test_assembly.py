import re

import pytest
import shapely
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.as_built.driven_ground import driven_garage
from garage2usd.driving import DesignCar
from garage2usd.driving.layout_garage import StandingThing, assembled, layout_garage
from garage2usd.garage import LaneGraph, LaneNode, Stall, StallUse
from garage2usd.garage_sources import read_built

DEAD_END = """
######
E====X
#..=..
#.==..
######
"""
"""A dead end below the junction, with a bend."""


def put_together(*, standing=(), edges=()):
    """Two stalls at an entrance, four lanes and an exit."""
    kinds = ["entrance", "straight", "t_junction", "crossroads", "straight", "exit"]
    nodes = [LaneNode(kind, (8.0 * number, 0.0), (8.0, 6.0), f"[0, {number}]") for number, kind in enumerate(kinds)]
    stalls = [
        Stall(name, ((x - 1.2, 7.5), (x + 1.2, 7.5), (x + 1.2, 2.5), (x - 1.2, 2.5)), use, 1)
        for name, x, use in (("A", 0.0, StallUse.STANDARD), ("B", 2.5, StallUse.EV), ("C", 5.0, StallUse.TURNING))
    ]
    return assembled(stalls, LaneGraph(tuple(nodes), tuple(edges)), standing)


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
    assert garage.unseen(one) == ("car of A",)
    assert garage.unseen(other) == ("stop of B", "cone of B", "a car in B")
    assert garage.absent_cars(DesignCar()).names == ("a car in B",)
    assert garage.standing.names[-2:] == ("car of A", "car on the lane")
    assert garage.standing.names[:3] == ("stop of B", "cone of B", "charger of A")


def by_square(path):
    """Name of an object as a layout has it, of its prim's path."""
    return re.sub(r".*/Tile_(r\d+_c\d+/.*)|.*/(.*)", r"\1\2", path)


@pytest.mark.parametrize("structure", [SETTINGS["site"]["structure"], DEAD_END])
def test_a_layout_its_report_and_its_stage_are_the_same_garage(structure, tmp_path):
    fittings = {"cone_rate": 1.0}
    settings = SETTINGS | {"site": {"structure": structure}, "parking": {"occupancy": 0.5}, "fittings": fittings}
    built = garage2usd.build(garage2usd.GarageConfig(**settings), tmp_path / "garage.usda")
    layout = built.garage.layout
    made = layout_garage(layout)
    owned = {(place.stall, place.kind) for place in layout.placements if place.stall}
    stall_fittings = {"stall", "car", "number_plate", "wheel_stop", "cone", "stall_number", "charger"}
    assert stall_fittings >= {kind for _, kind in owned}
    assert {"car", "wheel_stop", "cone"} <= {kind for _, kind in owned}
    for path in (built.stage, built.report):
        read = driven_garage(read_built(path).garage.levels[0])
        assert sorted(map(by_square, read.standing.names)) == sorted(made.standing.names)
        for one, other in zip(made.stalls, read.stalls, strict=True):
            assert (one.name, one.access) == (other.name, other.access)
            assert other.centre == pytest.approx(one.centre, abs=1e-4)
            assert other.yaw_rad == one.yaw_rad
            assert sorted(map(by_square, read.unseen(other))) == sorted(made.unseen(one))
        assert read.taken == made.taken
        widths_m = [{arc: edge.width_m for arc, edge in of.lanes.arcs.items()} for of in (read, made)]
        assert widths_m[0] == pytest.approx(widths_m[1], abs=1e-4)
        assert read.backing == made.backing
        assert [node.kind for node in read.lanes.nodes] == [node.kind for node in made.lanes.nodes]
    assert bool(made.backing) == (structure == DEAD_END)
