"""GeoJSON, OpenStreetMap's XML and DXF of garages, as GDAL, ezdxf and shapely read them."""

import json

import ezdxf
import numpy as np
import pyogrio
import pytest
import shapely
from pyproj import Transformer
from support.small_levels import SMALL_LEVELS
from support.small_survey import SURVEY

import garage2usd
from garage2usd.garage_sources import read_built
from garage2usd.maps.frame import map_points, projection

FORMATS = ("geojson", "osm.xml", "dxf")
WITHIN_M = 1e-3
GDAL_M = 0.015
"""GDAL rounds the degrees of OSM's files to seven decimals."""


@pytest.fixture(scope="module")
def surveyed(tmp_path_factory):
    """Return the stage of a surveyed garage, and its file in each format."""
    folder = tmp_path_factory.mktemp("surveyed")
    (folder / "lot.toml").write_text(SURVEY)
    stage = garage2usd.import_layout(folder / "lot.toml", folder / "lot.usdc", proves=False).stage
    files = garage2usd.export(stage, [folder / f"lot.{suffix}" for suffix in FORMATS])
    return stage, dict(zip(FORMATS, files, strict=True))


@pytest.fixture(scope="module")
def two_levels(tmp_path_factory):
    """Return the stage of a garage of two levels, and its file in each format."""
    folder = tmp_path_factory.mktemp("two")
    stage = garage2usd.build(SMALL_LEVELS, folder / "two.usdc").stage
    files = garage2usd.export(stage, [folder / f"two.{suffix}" for suffix in FORMATS])
    return stage, dict(zip(FORMATS, files, strict=True))


@pytest.fixture(params=["surveyed", "two_levels"])
def exported(request):
    return request.getfixturevalue(request.param)


TO_METRES = Transformer.from_crs("EPSG:4326", projection(49.0, 9.0), always_xy=True)


def projected(points, transformer):
    """Return points by a projection, which takes one alone for a number."""
    return np.stack(transformer.transform(*np.concatenate([points, points]).T), -1)[: len(points)]


def metres(geometries):
    """Return geometries in degrees in the frame of all maps, as the settings place it where no survey does."""
    return [shapely.transform(shape, lambda points: projected(points, TO_METRES)) for shape in geometries]


def layers_of(path, layer=None):
    """Return the geometries of a file as GDAL reads it, with their fields by name."""
    meta, _, shapes, fields = pyogrio.raw.read(path, layer=layer)
    return shapely.from_wkb(shapes), dict(zip(meta["fields"].tolist(), fields, strict=True))


def assert_same_stalls(garage, found):
    """Check that grounds by level and id are those of the stalls of a garage."""
    expected = {
        (level.place.name, level.place.in_whole(stall.name)): shapely.Polygon(map_points(stall.corners))
        for level in garage.levels
        for stall in level.stalls
    }
    assert found.keys() == expected.keys()
    for key, shape in expected.items():
        assert shapely.hausdorff_distance(shape.exterior, found[key].exterior) < WITHIN_M, key


def test_gdal_reads_the_stalls_of_geojson(exported):
    stage, files = exported
    garage = read_built(stage).garage
    shapes, fields = layers_of(files["geojson"])
    stalls = fields["kind"] == "stall"
    names = {"": "", **{str(-number): f"U{number}" for number in (1, 2)}}
    levels = fields.get("level", np.full(len(shapes), ""))
    found = dict(
        zip(
            zip([names[level] for level in levels[stalls]], fields["id"][stalls], strict=True),
            metres(shapes[stalls]),
            strict=True,
        )
    )
    assert_same_stalls(garage, found)
    said = dict(
        zip(
            fields["id"][stalls],
            zip(*(fields[key][stalls] for key in ("number", "use", "orientation", "size")), strict=True),
            strict=True,
        )
    )
    for level in garage.levels:
        for stall in level.stalls:
            number, use, kind, size = said[level.place.in_whole(stall.name)]
            assert (number or "", use, kind, size) == (stall.number or "", stall.use, stall.kind, stall.size)


def test_geojson_keeps_to_rfc_7946(exported):
    document = json.loads(exported[1]["geojson"].read_text())
    assert "crs" not in document
    for feature in document["features"]:
        shape = shapely.geometry.shape(feature["geometry"])
        assert shape.is_valid
        if shape.geom_type == "Polygon":
            assert shape.exterior.is_ccw
            assert feature["geometry"]["coordinates"][0][0] == feature["geometry"]["coordinates"][0][-1]


def test_gdal_reads_the_stalls_of_openstreetmap(exported):
    stage, files = exported
    garage = read_built(stage).garage
    shapes, fields = layers_of(files["osm.xml"], "multipolygons")
    is_stall = np.array([amenity == "parking_space" for amenity in fields["amenity"]])
    found = shapely.STRtree(shapely.get_parts(metres(shapes[is_stall])))
    parked = [stall for level in garage.levels for stall in level.stalls if stall.is_parked_in]
    assert is_stall.sum() == len(parked)
    for stall in parked:
        shape = shapely.Polygon(map_points(stall.corners))
        near = found.geometries[found.query(shape.centroid, predicate="within")]
        assert min(shapely.hausdorff_distance(shape.exterior, other.exterior) for other in near) < GDAL_M
    _, lines = layers_of(files["osm.xml"], "lines")
    assert set(lines["highway"]) - {None} == {"service"}


def test_ezdxf_and_gdal_read_the_stalls_of_a_drawing(exported):
    stage, files = exported
    garage = read_built(stage).garage
    drawing = ezdxf.readfile(files["dxf"])
    audit = drawing.audit()
    assert not audit.errors
    assert not audit.fixes
    assert drawing.units == ezdxf.units.M
    shapes, fields = layers_of(files["dxf"])
    for level in garage.levels:
        suffix = f"_{level.place.name}" if level.place.name else ""
        rings = drawing.query(f'LWPOLYLINE[layer=="STALLS{suffix}"]')
        assert {ring.dxf.elevation for ring in rings} == {level.place.floor_m}
        assert all(ring.closed for ring in rings)
        for stall, ring in zip(level.stalls, rings, strict=True):
            assert np.abs(np.array([*ring.get_points("xy")]) - map_points(stall.corners)).max() < WITHIN_M
        numbers = {text.dxf.text: text for text in drawing.query(f'TEXT[layer=="NUMBERS{suffix}"]')}
        for stall in level.stalls:
            if stall.number:
                place = shapely.Point(numbers[stall.number].get_placement()[1].vec2)
                assert shapely.Polygon(map_points(stall.corners)).contains(place)
        of_layer = shapes[fields["Layer"] == f"STALLS{suffix}"]
        assert len(of_layer) == len(level.stalls)


def test_lanes_of_all_formats_are_those_of_the_garage(exported):
    stage, files = exported
    garage = read_built(stage).garage
    shapes, fields = layers_of(files["geojson"])
    drawing = ezdxf.readfile(files["dxf"])
    for number, level in enumerate(garage.levels, 1):
        on = fields["level"] == str(-number) if level.place.name else np.ones(len(shapes), dtype=bool)
        lanes = on & (fields["kind"] == "lane")
        drawn = shapely.union_all(metres(shapes[lanes]))
        edges = [
            shapely.LineString(
                map_points([level.lanes.nodes[edge.start].position, level.lanes.nodes[edge.end].position])
            )
            for edge in level.lanes.edges
        ]
        assert max(shapely.distance(drawn, shapely.points(shapely.get_coordinates(edges)))) < 0.01
        one_way = sum(shape.length for shape in metres(shapes[lanes & (fields["oneway"] == "yes")]))
        suffix = f"_{level.place.name}" if level.place.name else ""
        lines = [
            shapely.LineString(line.get_points("xy"))
            for line in drawing.query(f'LWPOLYLINE[layer=="LANES_ONE_WAY{suffix}"]')
        ]
        assert sum(line.length for line in lines) == pytest.approx(one_way, abs=0.01)


def test_the_outline_is_that_of_the_survey_and_holds_all_stalls(surveyed, two_levels):
    shapes, fields = layers_of(surveyed[1]["geojson"])
    (outline,) = metres(shapes[fields["kind"] == "outline"])
    assert outline.equals_exact(shapely.box(0, -18.2, 40, 0), 0.01, normalize=True)
    shapes, fields = layers_of(two_levels[1]["geojson"])
    assert (fields["kind"] == "outline").sum() == 2
    for level in ("-1", "-2"):
        on = fields["level"] == level
        (ground,) = metres(shapes[on & (fields["kind"] == "outline")])
        for kind in ("stall", "column", "block"):
            grounds = shapely.union_all(metres(shapes[on & (fields["kind"] == kind)]))
            assert ground.buffer(0.01).covers(grounds), kind


def test_doors_lie_on_the_outline_and_ramps_join_the_levels(two_levels):
    shapes, fields = layers_of(two_levels[1]["geojson"])
    places = np.array(metres(shapes), dtype=object)
    doors = places[np.isin(fields["kind"], ["entrance", "exit"])]
    (top,) = places[(fields["kind"] == "outline") & (fields["level"] == "-1")]
    assert len(doors) == 2
    assert max(shapely.distance(top.exterior, doors)) < WITHIN_M
    ramps = places[fields["kind"] == "lane"][[";" in level for level in fields["level"][fields["kind"] == "lane"]]]
    assert sorted(level for level in fields["level"] if ";" in level) == ["-1;-2", "-2;-1"]
    for level, end in (("-1", 0), ("-2", -1)):
        lanes = shapely.union_all(places[(fields["kind"] == "lane") & (fields["level"] == level)])
        ends = [shapely.Point(ramp.coords[place]) for ramp in ramps for place in (0, -1)]
        assert sum(lanes.distance(point) < 0.1 for point in ends) >= 2, (level, end)


def test_the_same_stage_gives_the_same_bytes(surveyed, tmp_path):
    stage, files = surveyed
    again = garage2usd.export(stage, [tmp_path / file.name for file in files.values()], workers=3)
    assert [file.read_bytes() for file in again] == [file.read_bytes() for file in files.values()]


def test_a_survey_in_degrees_lies_where_it_was(surveyed, tmp_path):
    """A lot that is turned and moved on the earth comes back to the same degrees."""
    document = json.loads(surveyed[1]["geojson"].read_text())
    to_degrees = Transformer.from_crs(projection(-33.86, 151.2), "EPSG:4326", always_xy=True)
    turn = np.array([[np.cos(0.4), np.sin(0.4)], [-np.sin(0.4), np.cos(0.4)]])

    def moved(points):
        return projected(projected(points, TO_METRES) @ turn, to_degrees)

    for feature in document["features"]:
        shape = shapely.transform(shapely.geometry.shape(feature["geometry"]), moved)
        feature["geometry"] = json.loads(shapely.to_geojson(shape))
    (tmp_path / "sydney.geojson").write_text(json.dumps(document))
    stage = garage2usd.import_layout(tmp_path / "sydney.geojson", tmp_path / "sydney.usdc", proves=False).stage
    (file,) = garage2usd.export(stage, [tmp_path / "again.geojson"])
    before, after = (
        {
            feature["properties"]["number"]: np.array(feature["geometry"]["coordinates"][0])
            for feature in features
            if feature["properties"]["kind"] == "stall"
        }
        for features in (document["features"], json.loads(file.read_text())["features"])
    )
    assert before.keys() == after.keys()
    degree_m = 111_000.0
    for number, ring in before.items():
        apart = np.abs(ring[:, None] - after[number][None]).sum(axis=2).min(axis=1)
        assert apart.max() * degree_m < 0.01, number
