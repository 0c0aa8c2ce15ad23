"""Connecting roads of OpenDRIVE are laid from middle to middle of their roads; roads above one another are levels."""

import shapely

from garage2usd.imports import import_layout, unplaced_parts
from garage2usd.survey.reader import read_building, read_survey

LANE = '<lane id="{0}" type="driving"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>'
TWO_WAY = f"<left>{LANE.format(1)}</left><right>{LANE.format(-1)}</right>"
RIGHT = f"<right>{LANE.format(-1)}</right>"
STALLS = (
    '<object type="parkingSpace" id="{0}" s="4" t="{1}" hdg="1.5707963" width="2.5" length="5">'
    '<repeat s="4" length="{2}" distance="2.5" tStart="{1}" tEnd="{1}"/></object>'
)


def road(number, start, hdg, length, *, lanes=TWO_WAY, junction=-1, links=(), objects="", heights=(0.0, 0.0)):
    tied = "".join(f'<{side} elementType="road" elementId="{other}"/>' for side, other in links)
    slope = (heights[1] - heights[0]) / length
    return (
        f'<road id="{number}" length="{length}" junction="{junction}"><link>{tied}</link>'
        f'<planView><geometry s="0" x="{start[0]}" y="{start[1]}" hdg="{hdg}" length="{length}"><line/></geometry>'
        f'</planView><elevationProfile><elevation s="0" a="{heights[0]}" b="{slope}" c="0" d="0"/></elevationProfile>'
        f'<lanes><laneSection s="0">{lanes}</laneSection></lanes><objects>{objects}</objects></road>'
    )


def written(tmp_path, *roads, told=()):
    path = tmp_path / "lot.xodr"
    data = "".join(f'<userData code="{code}" value="{value}"/>' for code, value in told)
    path.write_text(f"<OpenDRIVE><header>{data}</header>{''.join(roads)}</OpenDRIVE>")
    return path


def crossing(first=1, height=0.0):
    """Two two-way roads of 40 m, ten metres apart in line, joined by a connecting road for each direction."""
    rows = STALLS.format(1, 6, 30) + STALLS.format(2, -6, 30)
    ids, heights = range(first, first + 4), (height, height)
    there, back = [("predecessor", ids[0]), ("successor", ids[1])], [("predecessor", ids[1]), ("successor", ids[0])]
    # single lanes, 1.5 m to the right of the middle of the roads
    through = {"lanes": RIGHT, "junction": first, "heights": heights}
    return (
        road(ids[0], (0, 0), 0, 40, objects=rows, heights=heights),
        road(ids[1], (50, 0), 0, 40, objects=rows, heights=heights),
        road(ids[2], (40, 0), 0, 10, links=there, **through),
        road(ids[3], (50, 0), 3.14159265358979, 10, links=back, **through),
    )


def test_connecting_roads_lead_from_middle_to_middle_in_both_directions(tmp_path):
    survey = read_survey(written(tmp_path, *crossing()))
    (between,) = [lane for lane in survey.lanes if shapely.LineString(lane.points).length < 11]
    assert not between.one_way
    assert shapely.LineString(between.points).hausdorff_distance(shapely.LineString([(40, 0), (50, 0)])) < 1e-3


def test_a_level_has_the_connecting_roads_that_lie_above_those_of_another(tmp_path):
    building = read_building(written(tmp_path, *crossing(), *crossing(first=11, height=-3.2)))
    for level in building.in_order:
        (between,) = [lane for lane in level.survey.lanes if shapely.LineString(lane.points).length < 11]
        assert not between.one_way
        assert between.width_m == 6.0


def test_levels_have_the_outlines_and_doors_that_the_header_tells_of_them(tmp_path):
    told = (("outline U1", "-9 -9 99 -9 99 9 -9 9"), ("entrance U1", "0 0"), ("outline U2", "-8 -8 98 -8 98 8 -8 8"))
    path = written(tmp_path, *crossing(), *crossing(first=11, height=-3.2), told=told)
    first, second = (level.survey for level in read_building(path).in_order)
    assert shapely.Polygon(first.outline).bounds == (-9, -9, 99, 9)
    assert [portal.position for portal in first.portals] == [(0, 0)]
    assert shapely.Polygon(second.outline).bounds == (-8, -8, 98, 8)
    assert not second.portals


def test_stalls_on_both_sides_of_a_junction_are_placed(tmp_path):
    made = import_layout(written(tmp_path, *crossing()), tmp_path / "lot.usdc", proves=False)
    assert made.garage.parking_stalls == 52
    assert not unplaced_parts(made.garage)


def test_roads_a_storey_apart_are_levels_and_roads_between_them_ramps(tmp_path):
    rows = STALLS.format(1, 6, 30) + STALLS.format(2, -6, 30)
    path = written(
        tmp_path,
        road(1, (0, 0), 0, 40, objects=rows),
        road(2, (0, 0), 0, 40, objects=rows, heights=(-3.2, -3.2)),
        road(3, (40, 0), 0, 25, heights=(0.0, -3.2)),
    )
    building = read_building(path)
    assert [(level.name, len(level.survey.stalls)) for level in building.in_order] == [("0 m", 26), ("-3.2 m", 26)]
    (ramp,) = building.ramps
    assert ramp.levels == ("0 m", "-3.2 m")
    assert ramp.points[0] == (40, 0)


def test_gentle_slopes_are_one_level(tmp_path):
    path = written(tmp_path, road(1, (0, 0), 0, 100, objects=STALLS.format(1, 6, 30), heights=(0.0, 4.0)))
    assert len(read_building(path).levels) == 1
