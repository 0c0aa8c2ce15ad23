"""GeoJSON: shapely's geometries in metres, pyproj's distances on the ellipsoid, and features that are wrong."""

import json
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod

from garage2usd.common.errors import ConfigError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import PortalKind

WGS84 = Geod(ellps="WGS84")
STALL = shapely.box(0, 0, 2.5, 5)


def feature(shape, **properties):
    geometry = shape if shape is None or isinstance(shape, dict) else shapely.geometry.mapping(shape)
    return {"type": "Feature", "geometry": geometry, "properties": properties}


def read(tmp_path, features, *, suffix="geojson", coordinates="metres", **members):
    path = tmp_path / f"lot.{suffix}"
    members = {"type": "FeatureCollection", "features": features, **members}
    if coordinates is not None:
        members["coordinates"] = coordinates
    path.write_text(json.dumps(members))
    return read_survey(path)


def test_every_kind_of_feature_is_read(tmp_path):
    survey = read(
        tmp_path,
        [
            feature(STALL, kind="stall", name="A", use="ev", size="van", number=7),
            feature(shapely.MultiPolygon([shapely.box(5, 0, 7, 5), shapely.box(7, 0, 9, 5)]), amenity="parking_space"),
            feature(shapely.box(10, 0, 13, 5), type="stall", parking_space="disabled"),
            feature(shapely.LineString([(0, 8), (20, 8)]), highway="service", width="5.5"),
            feature(shapely.LineString([(0, 20), (20, 20)]), kind="lane", oneway="-1"),
            feature(shapely.Point(3, 12), kind="column", size_m=0.5),
            feature(shapely.box(7, 11.8, 7.6, 12.4), kind="column"),
            feature(shapely.Point(0, 8), kind="entrance"),
            feature(shapely.Point(20, 20), kind="exit"),
            feature(shapely.Point(20, 8), amenity="parking_entrance"),
            feature(shapely.box(0, 0, 20, 30), amenity="parking"),
            feature(shapely.box(50, 0, 60, 30), kind="outline", name="elsewhere"),
            feature(shapely.Point(5, 5), natural="tree"),
        ],
        suffix="json",
    )
    assert [stall.name for stall in survey.stalls] == ["A", "feature 1, part 1", "feature 1, part 2", "feature 2"]
    first, *_, last = survey.stalls
    assert (first.use, first.size, first.number) == (StallUse.EV, SizeClass.VAN, "7")
    assert last.use is StallUse.ACCESSIBLE
    assert shapely.Polygon(first.corners).equals(shapely.box(0, -5, 2.5, 0))
    one, other = survey.lanes
    assert (one.points, one.width_m, one.one_way) == (((0, -8), (20, -8)), 5.5, False)
    assert (other.points, other.width_m, other.one_way) == (((20, -20), (0, -20)), None, True)
    assert [column.size_m for column in survey.columns] == [0.5, pytest.approx(0.6)]
    assert survey.columns[1].centre == (7.3, -12.1)
    assert survey.portals == (
        ((0, -8), PortalKind.ENTRANCE),
        ((20, -20), PortalKind.EXIT),
        ((20, -8), PortalKind.BOTH),
    )
    assert shapely.Polygon(survey.outline).equals(shapely.box(0, -30, 20, 0))
    assert survey.unread == (("elsewhere", "an outline that contains no stall"),)


@given(st.floats(-75, 75), st.floats(-179, 179), st.floats(0, 360), st.floats(2, 4), st.floats(4, 7))
def test_degrees_keep_the_lengths_of_the_ellipsoid(tmp_path_factory, latitude, longitude, azimuth, width_m, length_m):
    corners = [(longitude, latitude)]
    for turn, side_m in ((0, length_m), (90, width_m), (180, length_m)):
        corners.append(WGS84.fwd(*corners[-1], azimuth + turn, side_m)[:2])
    corners = [((lon + 180) % 360 - 180, lat) for lon, lat in corners]
    polygon = {"type": "Polygon", "coordinates": [[*corners, corners[0]]]}
    survey = read(tmp_path_factory.mktemp("geojson"), [feature(polygon, kind="stall")], coordinates=None)
    (stall,) = survey.stalls
    sides = np.diff([*stall.corners, stall.corners[0]], axis=0)
    assert np.hypot(*sides.T) == pytest.approx([length_m, width_m, length_m, width_m], abs=1e-3)
    assert math.degrees(math.atan2(sides[0, 0], -sides[0, 1])) % 360 == pytest.approx(azimuth % 360, abs=0.1) or (
        azimuth % 360 > 359.8 or azimuth % 360 < 0.2
    )
    assert survey.origin_deg == pytest.approx((latitude, longitude), abs=2e-4)


def test_points_on_straight_sides_are_no_corners(tmp_path):
    ring = [(0, 0), (1.2, 0.05), (2.5, 0), (2.5, 2), (2.52, 3), (2.5, 5), (0, 5), (0, 5)]
    (stall,) = read(tmp_path, [feature(shapely.Polygon(ring), kind="stall")]).stalls
    assert shapely.Polygon(stall.corners).equals(shapely.box(0, -5, 2.5, 0))


def test_what_is_left_out_is_named(tmp_path):
    survey = read(
        tmp_path,
        [
            feature(STALL, kind="stall"),
            feature(shapely.Point(0, 0), kind="stall", name="dot"),
            feature(None, kind="lane", name="nowhere"),
            feature(shapely.Polygon([(0, 0), (3, 0), (5, 2), (3, 4), (0, 4)]), kind="stall", name="pentagon"),
            feature(shapely.box(0, 0, 9, 9).difference(shapely.box(7, 7, 8, 8)), kind="outline", name="ring"),
        ],
    )
    assert survey.unread == (
        ("dot", "a stall as a Point; it may be a Polygon or MultiPolygon"),
        ("nowhere", "a lane without geometry"),
        ("ring", "the 1 holes in this outline; they become floor"),
        ("pentagon", "a stall of 5 corners instead of 4"),
    )


def polygon(*ring):
    return {"type": "Polygon", "coordinates": [list(ring)]}


@pytest.mark.parametrize(
    ("features", "members", "message"),
    [
        (3, {}, "lot.geojson: features: got 3; allowed: a list of features"),
        ([], {"type": "Topology"}, "lot.geojson: type: got 'Topology'; allowed: a GeoJSON object of the type"),
        ([4], {}, "lot.geojson: features.0: got 4; allowed: an object of the type Feature"),
        (
            [feature(STALL, kind="stall")],
            {"coordinates": "feet"},
            "lot.geojson: coordinates: got 'feet'; allowed: 'metres',",
        ),
        (
            [feature({"type": "Circle"}, kind="stall")],
            {},
            "lot.geojson: features.0.geometry.type: got 'Circle'; allowed: one of",
        ),
        (
            [feature(polygon([0, 0], [1, "2"]), kind="stall")],
            {},
            "lot.geojson: features.0.geometry.coordinates: got '2'; allowed: a number of degrees or metres",
        ),
        ([feature(polygon([0]), kind="stall")], {}, "got [0]; allowed: positions of two numbers or three"),
        (
            [feature(shapely.box(400, 0, 402, 5), kind="stall")],
            {"coordinates": "degrees"},
            "features.0.geometry.coordinates: got (402.0, 0.0); allowed: longitude from -180 to 180",
        ),
        (
            [feature(STALL, kind="stall"), feature(shapely.Point(8, 48), kind="entrance")],
            {"coordinates": "degrees"},
            "lot.geojson: latitude and longitude: got (0.0, 2.5); allowed: points within 100 km of the others",
        ),
    ],
)
def test_malformed_files_are_refused_by_feature(tmp_path, features, members, message):
    with pytest.raises(ConfigError) as raised:
        read(tmp_path, features, **members)
    assert message in str(raised.value)


def test_nothing_else_than_json_is_read(tmp_path):
    path = tmp_path / "lot.geojson"
    path.write_text("{")
    with pytest.raises(ConfigError, match="allowed: JSON"):
        read_survey(path)


def test_areas_of_the_size_of_stalls_are_stalls_where_no_feature_tells_its_kind(tmp_path):
    def area(name, x, z, width, length):
        ring = [[x, z], [x + width, z], [x + width, z + length], [x, z + length], [x, z]]
        return {
            "type": "Feature",
            "properties": {"name": name, "road_id": "B4"},
            "geometry": {"type": "Polygon", "coordinates": [ring]},
        }

    row = [area(str(277 + number), 2.5 * number, 0, 2.5, 5) for number in range(8)]
    rooms = [area("plant room", 0, 20, 12, 9)]
    path = tmp_path / "garage.geojson"
    features = [*row, *rooms]
    path.write_text(json.dumps({"type": "FeatureCollection", "coordinates": "metres", "features": features}))
    survey = read_survey(path)
    assert [(stall.name, stall.number) for stall in survey.stalls] == [(str(n), str(n)) for n in range(277, 285)]
    assert survey.remarks == ("8 areas that tell no kind are read as stalls, by their size",)
    features.append({**area("A", 40, 0, 2.5, 5), "properties": {"kind": "stall"}})
    path.write_text(json.dumps({"type": "FeatureCollection", "coordinates": "metres", "features": features}))
    assert len(read_survey(path).stalls) == 1
