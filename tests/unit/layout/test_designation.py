import numpy as np
import pytest
import shapely
from support.footprints import footprint

from garage2usd.config import GarageConfig
from garage2usd.garage import StallUse
from garage2usd.layout import lay_out
from garage2usd.layout.floor.markings import zebra
from garage2usd.layout.parking.designation import use_symbol
from garage2usd.objects.stall_number import NumberSpec
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

CORE = """
.........
E=======X
.=#=...#.
.=======.
.=.....=.
"""


def laid_out(text=CORE, **settings):
    config = GarageConfig(**settings)
    structure = Structure.from_arrays(cells_from_text(text, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


def of_use(layout, use):
    return [stall for stall in layout.stalls if stall.use is use]


def test_accessible_and_charging_stalls_lie_nearest_to_the_core_doors():
    layout = laid_out(fittings={"stair_cores": False})
    count = len(layout.stalls)
    assert count >= 25
    accessible, charging = of_use(layout, StallUse.ACCESSIBLE), of_use(layout, StallUse.EV)
    assert len(accessible) == max(1, round(0.02 * count))
    assert len(charging) == round(0.08 * count)
    doors = [((2.5) * 8.1, 3 * 8.1), ((7.5) * 8.1, 3 * 8.1)]

    def reach(stall):
        return min(np.hypot(stall.centre_m[0] - x, stall.centre_m[1] - z) for x, z in doors)

    farthest = [max(reach(stall) for stall in stalls) for stalls in (accessible, charging)]
    assert farthest[0] <= min(reach(stall) for stall in charging) + 1e-6
    assert farthest[1] <= min(reach(stall) for stall in of_use(layout, StallUse.STANDARD)) + 1e-6


@pytest.mark.parametrize("share", [0.02, 0.06, 0.5, 1.0])
def test_every_accessible_stall_has_a_hatched_aisle_beside_it_that_two_share(share):
    layout = laid_out(parking={"accessible_share": share, "occupancy": 1.0, "ev_share": 0})
    plain = laid_out(parking={"accessible_share": 0})
    assert [stall.name for stall in layout.stalls] == [stall.name for stall in plain.stalls]
    accessible, aisles = of_use(layout, StallUse.ACCESSIBLE), of_use(layout, StallUse.ACCESS_AISLE)
    wanted = max(1, round(share * len(layout.stalls)))
    most = sum(len(row) // 3 * 2 + (len(row) % 3 == 2) for row in rows_of(layout))
    assert len(accessible) == wanted if share <= 0.5 else 0.5 * most < len(accessible) <= most
    assert len(accessible) / 2 <= len(aisles) <= len(accessible)
    ground = [shapely.Polygon(aisle.corners_m()) for aisle in aisles]
    assert min(stall.width_m for stall in aisles) >= 1.52
    for stall in accessible:
        # a whole side of the stall lies on the aisle
        reach = shapely.Polygon(stall.corners_m()).buffer(0.01, join_style="mitre")
        assert max(reach.intersection(aisle).length for aisle in ground) > 2 * stall.length_m
    kept_free = [*layout.of_kind("car"), *layout.of_kind("wheel_stop")]
    kept_free += [*layout.of_kind("cone"), *layout.of_kind("stall_number")]
    taken = shapely.union_all([footprint(place) for place in kept_free])
    assert taken.intersection(shapely.union_all(ground)).area < 1e-6


def rows_of(layout):
    rows = {}
    for stall in layout.stalls:
        rows.setdefault((stall.square, stall.edge), []).append(stall)
    return rows.values()


def test_shares_of_zero_leave_every_stall_standard():
    layout = laid_out(parking={"ev_share": 0, "accessible_share": 0})
    assert {stall.use for stall in layout.stalls} <= {StallUse.STANDARD, StallUse.TURNING}
    assert not layout.of_kind("charger")


def test_chargers_stand_in_their_stall_behind_the_cars():
    layout = laid_out(parking={"ev_share": 1, "occupancy": 1})
    panels = {place.stall: footprint(place) for place in layout.of_kind("stall")}
    cars = shapely.union_all([footprint(place) for place in layout.of_kind("car")])
    posts = layout.of_kind("charger")
    assert len(posts) == len(of_use(layout, StallUse.EV)) > 0
    for post in posts:
        assert footprint(post).within(panels[post.stall])
        assert footprint(post).intersection(cars).area < 1e-6


def test_numbers_are_painted_at_the_mouth_of_their_stall():
    layout = laid_out()
    panels = {place.stall: place for place in layout.of_kind("stall")}
    digits = layout.of_kind("stall_number")
    numbered = {stall.name: stall.number for stall in layout.stalls if stall.number}
    assert len(numbered) == sum(stall.use.takes_cars for stall in layout.stalls)
    painted = {place.stall: place.spec.digits for place in digits}
    assert painted == {name: number.split("-")[1] for name, number in numbered.items()}
    marked = {
        spec: shapely.union_all([shapely.Polygon(marking.polygon) for marking in spec.markings])
        for spec in {panel.spec for panel in panels.values()}
    }
    for place in digits:
        panel = panels[place.stall]
        x, _, z = panel.position_m
        paint = shapely.transform(marked[panel.spec], _turned(panel.yaw_rad, x, z))
        assert footprint(place).within(footprint(panel))
        assert footprint(place).intersection(paint).area < 1e-9


def _turned(yaw, x, z):
    cos, sin = np.cos(yaw), np.sin(yaw)
    return lambda points: points @ np.array([[cos, -sin], [sin, cos]]) + (x, z)


@pytest.mark.parametrize("use", [StallUse.EV, StallUse.ACCESSIBLE])
def test_symbols_are_clean_polygons_between_wheel_stop_and_number(use):
    shapes = [shapely.Polygon(marking.polygon) for marking in use_symbol(use)]
    assert all(shape.is_valid and shape.area > 0.02 for shape in shapes)
    whole = shapely.union_all(shapes)
    assert whole.area == pytest.approx(sum(shape.area for shape in shapes))
    x0, z0, x1, z1 = whole.bounds
    assert min(x0, -x1) > -0.7
    assert z0 > -5.3 / 2 + 0.8
    assert z1 < 5.3 / 2 - 0.8


def test_digits_differ_and_keep_their_size():
    areas = set()
    for digit in range(10):
        (part,) = NumberSpec(str(digit), 0.45).asset().parts
        low, high = part.points.min(axis=0), part.points.max(axis=0)
        assert (high - low)[2] == pytest.approx(0.45, abs=1e-3)
        assert (high - low)[0] <= 0.56 * 0.45 + 1e-3
        assert part.points[:, 1] == pytest.approx(0.003)
        areas.add(tuple(np.round(part.points.sum(axis=0), 4)))
    assert len(areas) == 10


def test_a_zebra_crossing_lies_before_a_core_s_door():
    bars = {marking.polygon for marking in zebra(4.05, 4.05, 0.35, along_x=True)}
    floors = {place.square: place.spec for place in laid_out().of_kind("floor")}
    crossed = {square for square, spec in floors.items() if bars <= {marking.polygon for marking in spec.markings}}
    assert crossed == {(3, 2)}  # the other core's door opens onto a junction


TOLD = {"source": "the client", "confidence": "high"}


def profile_of(**metres):
    counts = {"stalls_per_van_stall"}
    return {
        "name": "client" if metres else "none",
        **{
            name: {"value": value, "unit": "count" if name in counts else "m", **TOLD} for name, value in metres.items()
        },
    }


WIDTHS = {
    "wider stalls": (profile_of(accessible_stall_width=2.7, access_aisle_width=1.2), 2.4, 2.7, 1.2),
    "so wide that two share no aisle": (profile_of(accessible_stall_width=3.5, access_aisle_width=1.2), 2.4, 3.5, 1.2),
    "wider than two stalls have room for": (
        profile_of(accessible_stall_width=3.7, access_aisle_width=1.5),
        2.6,
        3.7,
        1.5,
    ),
    "stalls for vans": (
        profile_of(stalls_per_van_stall=1, van_stall_width=3.2, access_aisle_width=1.5),
        2.4,
        3.2,
        1.5,
    ),
    "an aisle for vans, which is narrower": (
        profile_of(stalls_per_van_stall=1, van_stall_width=3.6, van_access_aisle_width=2.1, access_aisle_width=1.5),
        2.4,
        2.4,
        2.1,
    ),
}


@pytest.mark.parametrize("share", [0.04, 0.3])
@pytest.mark.parametrize(("profile", "others", "accessible", "aisle"), WIDTHS.values(), ids=WIDTHS)
def test_accessible_stalls_and_their_aisles_are_as_wide_as_the_profile_asks(profile, others, accessible, aisle, share):
    parking = {"accessible_share": share, "occupancy": 1.0, "ev_share": 0}
    layout, plain = (laid_out(profile=profile, parking={**parking, "accessible_share": asked}) for asked in (share, 0))
    assert {round(stall.width_m, 6) for stall in plain.stalls} == {others}
    assert min(stall.width_m for stall in of_use(layout, StallUse.ACCESSIBLE)) >= accessible - 1e-6
    assert min(stall.width_m for stall in of_use(layout, StallUse.ACCESS_AISLE)) >= aisle - 1e-6
    for stall in layout.stalls:
        if stall.use not in {StallUse.ACCESSIBLE, StallUse.ACCESS_AISLE}:
            assert stall.width_m == pytest.approx(others)
    for row, same in zip(rows_of(layout), rows_of(plain), strict=True):
        # they share the ground that the stalls of the row had before, and leave none of it
        ground, before = (
            shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in line]) for line in (row, same)
        )
        assert ground.symmetric_difference(before.buffer(1e-5)).area < 1e-3
        assert sum(stall.width_m for stall in row) == pytest.approx(sum(stall.width_m for stall in same))
    panels = {place.stall: footprint(place) for place in layout.of_kind("stall")}
    for car in layout.of_kind("car"):
        # some stand over a line, and their mirrors hang over it
        assert footprint(car).within(panels[car.stall].buffer(0.22))


@pytest.mark.parametrize(
    ("kind", "clause", "usual"), [("wheel_stop", "wheel_stop_height", 0.1), ("speed_bump", "speed_bump_height", 0.05)]
)
def test_wheel_stops_and_bumps_are_as_low_as_the_profile_asks(kind, clause, usual):
    fittings = {"speed_bump_rate": 1.0}

    def highest(**clauses):
        shapes = {place.spec for place in laid_out(profile=profile_of(**clauses), fittings=fittings).of_kind(kind)}
        return max((part.points[:, 1].max() for shape in shapes for part in shape.asset().parts), default=None)

    assert highest() == highest(**{clause: 0.2}) == pytest.approx(usual)
    assert highest(**{clause: 0.8 * usual}) == pytest.approx(0.8 * usual)
    assert highest(**{clause: 0.01}) is None


def test_a_stall_with_a_gap_beside_it_has_no_access_aisle_beyond():
    parking, plan = {"accessible_share": 1.0}, {"unreachable_stalls": "drop"}
    config = GarageConfig(parking=parking, plan=plan, fittings={"stair_cores": False})
    structure = Structure.from_arrays(cells_from_text(CORE, field="S"), 8.1, 8.1)
    graph = build_lane_graph(structure, config.bay)
    middle = {stall.name for stall in lay_out(structure, graph, config).stalls if stall.ordinal % 3 == 2}
    layout = lay_out(structure, graph, config, unreachable=middle)
    assert len(layout.stalls) > 2 * len(middle) - 3
    assert not of_use(layout, StallUse.ACCESSIBLE)
    assert not of_use(layout, StallUse.ACCESS_AISLE)
