"""IMDF: archives of venues written here, against the same boxes in metres, placed by pyproj."""

import json
import zipfile

import pytest
import shapely
from click.testing import CliRunner
from pyproj import Geod

from garage2usd.cli import main
from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.reader import read_building, read_survey
from garage2usd.survey.survey import PortalKind

EARTH = Geod(ellps="WGS84")
LONGITUDE, LATITUDE = -122.03, 37.33
W, L = 2.5, 5.0


def degrees(x, y):
    east, _, _ = EARTH.fwd(LONGITUDE, LATITUDE, 90, x)
    _, north, _ = EARTH.fwd(LONGITUDE, LATITUDE, 0, y)
    return [east, north]


def box(x, y, width, depth):
    ring = [(x, y), (x + width, y), (x + width, y + depth), (x, y + depth), (x, y)]
    return {"type": "Polygon", "coordinates": [[degrees(*point) for point in ring]]}


class Venue:
    """An archive under construction, by places (x, y) in metres."""

    def __init__(self):
        self.files = {"manifest": {"version": "1.0.0"}}

    def add(self, kind, name, geometry, /, **properties):
        feature = {"type": "Feature", "id": name, "feature_type": kind, "geometry": geometry, "properties": properties}
        self.files.setdefault(kind, {"type": "FeatureCollection", "features": []})["features"].append(feature)

    def level(self, name, ordinal, *, count=6):
        self.add("level", name, box(0, 0, 30, 20), ordinal=ordinal, short_name={"en": name.upper()}, category="parking")
        for number in range(count):
            labels = {"name": {"en": f"{ordinal}-{number}"}, "category": "parking", "level_id": name}
            self.add("unit", f"{name}.{number}", box(2 + W * number, 0, W, L), **labels)

    def folder(self, tmp_path):
        folder = tmp_path / "venue"
        folder.mkdir()
        for name, document in self.files.items():
            (folder / f"{name}.{'json' if name == 'manifest' else 'geojson'}").write_text(json.dumps(document))
        return folder

    def archive(self, tmp_path):
        path = tmp_path / "venue.zip"
        with zipfile.ZipFile(path, "w") as archive:
            for file in self.folder(tmp_path).iterdir():
                archive.write(file, f"venue/{file.name}")
            archive.writestr("__MACOSX/._unit.geojson", b"\0")
        return path


@pytest.fixture
def venue():
    venue = Venue()
    venue.level("p2", -2)
    venue.level("p1", -1, count=3)
    line = {"type": "LineString", "coordinates": [degrees(30, 8), degrees(30, 12)]}
    venue.add("opening", "in", line, category="automobile", level_id="p2", name={"en": "Entrance"})
    walk = {"type": "LineString", "coordinates": [degrees(0, 8), degrees(0, 9)]}
    venue.add("opening", "door", walk, category="pedestrian", level_id="p2")
    venue.add("unit", "c", box(10, 8, 0.4, 0.4), category="column", level_id="p2")
    venue.add("unit", "lift", box(2, 15, 3, 4), category="elevator", level_id="p2")
    venue.add("unit", "floor", box(0, 5, 30, 15), category="road", level_id="p2")
    venue.add("section", "zone", box(2, 0, 2 * W, L), category="parking.ev", level_id="p2")
    venue.add("section", "small", box(2 + 4 * W, 0, 2 * W, L), category="parking.compact", level_id="p2")
    ramp = {"type": "LineString", "coordinates": [degrees(15, 10), degrees(15, 30)]}
    ends = {"origin": {"id": "floor", "feature_type": "unit"}, "destination": {"id": "p1.0", "feature_type": "unit"}}
    venue.add("relationship", "ramp", ramp, category="ramp", direction="directed", **ends)
    return venue


@pytest.mark.parametrize("form", ["folder", "archive"])
def test_the_levels_of_a_venue(tmp_path, venue, form):
    building = read_building(getattr(venue, form)(tmp_path))
    assert [(level.name, level.ordinal, len(level.survey.stalls)) for level in building.in_order] == [
        ("P1", -1.0, 3),
        ("P2", -2.0, 6),
    ]
    survey = building.in_order[1].survey
    left, top, _, bottom = shapely.Polygon(survey.outline).bounds
    for number, stall in enumerate(survey.stalls):
        expected = shapely.box(left + 2 + W * number, bottom - L, left + 2 + W * (number + 1), bottom)
        assert shapely.Polygon(stall.corners).hausdorff_distance(expected) < 0.02
    assert (bottom - top) == pytest.approx(20, abs=0.02)
    assert [stall.number for stall in survey.stalls] == [f"-2-{number}" for number in range(6)]
    assert [stall.use is StallUse.EV for stall in survey.stalls] == [True, True, False, False, False, False]
    assert [stall.size is SizeClass.COMPACT for stall in survey.stalls] == [False] * 4 + [True] * 2
    ((position, kind),) = survey.portals
    assert (position[0] - left, bottom - position[1]) == pytest.approx((30, 10), abs=0.02)
    assert kind is PortalKind.BOTH
    assert [column.size_m for column in survey.columns] == [pytest.approx(0.4, abs=0.01)]
    assert [ground.area for ground in survey.solid_polygons()] == [pytest.approx(12, rel=0.01)]
    (joins,) = building.ramps
    assert (joins.levels, joins.one_way) == (("P2", "P1"), True)
    assert survey.origin_deg == pytest.approx((LATITUDE, LONGITUDE), abs=0.001)


def test_a_folder_becomes_a_garage(tmp_path, venue):
    folder, stage = venue.folder(tmp_path), tmp_path / "g.usda"
    run = CliRunner().invoke(main, ["import", str(folder), "--level", "P2", "--no-proofs", "-o", str(stage)])
    assert run.exit_code == 0, run.output
    assert "6 (6 perpendicular); 4 standard, 2 ev" in run.output


@pytest.mark.parametrize("data", [b"", b"PK\x03\x04", b"PK\x05\x06" + bytes(18), b"hello"])
def test_other_archives_are_refused_in_one_line(tmp_path, data):
    path = tmp_path / "venue.zip"
    path.write_bytes(data)
    with pytest.raises(ConfigError) as caught:
        read_survey(path)
    assert "\n" not in str(caught.value)


def polygon(*ring):
    geometry = {"type": "Polygon", "coordinates": [ring]}
    return json.dumps({"features": [{"properties": {"category": "parking"}, "geometry": geometry}]})


@pytest.mark.parametrize(
    "unit",
    [
        "[]",
        "null",
        '"text"',
        '{"features": 3}',
        '{"features": [3]}',
        '{"features": [{"properties": {}, "geometry": {"type": "Blob"}}]}',
        polygon([1e9, 2], [3, 4], [5, 6], [1, 2]),
        polygon(["a", 2]),
        polygon([1, 2]),
        "{" * 5000,
        "[" * 100_000,
    ],
    ids=range(11),
)
def test_damaged_files_of_a_venue_are_read_or_refused(tmp_path, venue, unit):
    folder = venue.folder(tmp_path)
    (folder / "unit.geojson").write_text(unit)
    with pytest.raises(Garage2UsdError) as caught:  # as there is no stall left
        read_survey(folder)
    assert "\n" not in str(caught.value)
