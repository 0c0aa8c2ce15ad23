"""Forms that programs and people write surveys in: numbers, levels, encodings, separators, lengths; and bad parts."""

import json

import pytest
from pxr import Usd

from garage2usd.common.errors import ConfigError
from garage2usd.imports import import_layout
from garage2usd.survey.reader import read_building, read_survey
from garage2usd.survey.text import length_of


def box(x, y=0.0, width=2.5, length=5.0):
    return [[x, y], [x + width, y], [x + width, y + length], [x, y + length], [x, y]]


def feature(kind, form, coordinates, **properties):
    return {
        "type": "Feature",
        "properties": {"kind": kind, **properties},
        "geometry": {"type": form, "coordinates": coordinates},
    }


def write_geojson(path, features, **members):
    lane = feature("lane", "LineString", [[-5, 8], [2.5 * len(features) + 5, 8]])
    document = {"type": "FeatureCollection", "coordinates": "metres", "features": [*features, lane], **members}
    path.write_text(json.dumps(document))
    return path


NUMBERS = ["12a", "1/2", "Ä2", 'a"b\\', "车1", "🚗", "½", "-", "x" * 60, "1\u202e2\n"]


def test_numbers_are_placed_as_given_and_painted_where_the_lettering_has_them(tmp_path):
    stalls = [feature("stall", "Polygon", [box(2.5 * at)], number=text) for at, text in enumerate(NUMBERS)]
    made = import_layout(write_geojson(tmp_path / "a.geojson", stalls), tmp_path / "a.usda", proves=False)
    given = [*NUMBERS[:-2], "x" * 40, "12"]
    stage = Usd.Stage.Open(str(tmp_path / "a.usda"))
    found = {
        prim.GetAttribute("garage:stall:number").Get()
        for prim in stage.Traverse()
        if prim.GetName().startswith("Stall_")
    }
    assert found == set(given)
    assert [stall.number for stall in made.garage.layout.quads] == given
    unpainted = {stall.source.number for stall in made.garage.layout.source.fitted if "not painted" in stall.note}
    assert unpainted == {'a"b\\', "车1", "🚗", "½"}
    digits = {place.spec.digits for place in made.garage.layout.of_kind("stall_number")}
    assert {"2A", "/2", "Ä2"} <= digits


OSM_STALL = '<way id="{n}">{refs}<tag k="amenity" v="parking_space"/>{tags}</way>'


def write_osm(path, tags_of_stalls, others="", header='<?xml version="1.0"?>', encoding="utf-8"):
    nodes, ways = [], []
    for number, tags in enumerate(tags_of_stalls):
        refs = []
        for x, y in box(2.5 * number)[:4]:
            nodes.append((x, y))
            refs.append(len(nodes))
        named = "".join(f'<tag k="{key}" v="{value}"/>' for key, value in tags.items())
        nds = "".join(f'<nd ref="{ref}"/>' for ref in [*refs, refs[0]])
        ways.append(OSM_STALL.format(n=number + 1, refs=nds, tags=named))
    nodes += [(-5, 8), (2.5 * len(tags_of_stalls) + 5, 8)]
    text = "".join(
        f'<node id="{at}" lat="0" lon="0"><tag k="local_x" v="{x}"/><tag k="local_y" v="{y}"/></node>'
        for at, (x, y) in enumerate(nodes, 1)
    )
    ends = f'<nd ref="{len(nodes) - 1}"/><nd ref="{len(nodes)}"/>'
    text = f'{header}<osm version="0.6">{text}{"".join(ways)}{others.format(ends=ends)}</osm>'
    path.write_bytes(text.encode(encoding))
    return path


AISLE = '<way id="90">{{ends}}<tag k="highway" v="service"/><tag k="service" v="parking_aisle"/>{}</way>'


def test_levels_are_numbers_lists_and_runs(tmp_path):
    levels = ["-1", "-1.0", "-2;-1", "-3--1", "-2", "P1"]
    lanes = [("90", "-2.00"), ("91", "-1"), ("92", "5")]
    read = read_building(
        write_osm(
            tmp_path / "a.osm",
            [{"level": level} for level in levels],
            "".join(AISLE.replace("90", way).format(f'<tag k="level" v="{level}"/>') for way, level in lanes),
        )
    )
    assert [(level.name, len(level.survey.stalls), len(level.survey.lanes)) for level in read.in_order] == [
        ("-1", 4, 1),
        ("-2", 3, 1),
        ("-3", 1, 0),
        ("P1", 1, 0),
    ]
    assert {part for level in read.levels for part in level.survey.unread} == {
        ("way 92", "a lane on level 5, which has no stall"),
    }


def test_a_service_area_is_no_lane(tmp_path):
    read = read_survey(write_osm(tmp_path / "a.osm", [{}], AISLE.format('<tag k="area" v="yes"/>')))
    assert read.lanes == ()
    assert [part.name for part in read.unread] == ["way 90"]


@pytest.mark.parametrize(
    ("text", "metres"),
    [
        *(("5.5", 5.5), ("5,5 m", 5.5), ("250 cm", 2.5), ("12 ft", 3.6576), ("8'6\"", 2.5908), (3, 3.0), ("1e1", 10.0)),
        *((text, None) for text in ("", "-3", "0", "wide", "nan", "inf", "1e99", "3..5", "5 miles", True, None, [])),
    ],
)
def test_lengths_as_people_write_them(text, metres):
    assert length_of(text) == (metres if metres is None else pytest.approx(metres))


def test_one_bad_width_refuses_no_file(tmp_path):
    space = '<way id="{}">{{ends}}<tag k="type" v="parking_space"/>{}</way>'
    others = (
        space.format(80, "") + space.format(81, '<tag k="width" v="wide"/>') + AISLE.format('<tag k="width" v="-3"/>')
    )
    read = read_survey(write_osm(tmp_path / "a.osm", [{}], others))
    assert (len(read.stalls), len(read.lanes), read.lanes[0].width_m) == (2, 1, None)
    assert "2.5 m are taken" in read.unread[0].reason
    assert [part.name for part in read.unread] == ["way 80", "way 81", "way 90"]
    lane = feature("lane", "LineString", [[0, 8], [9, 8]], width="narrow")
    stall = feature("stall", "Polygon", [box(0)])
    read = read_survey(write_geojson(tmp_path / "a.geojson", [stall, lane]))
    assert [part.reason for part in read.unread] == ["the width 'narrow', which is no length above 0 m, up to 1000 m"]


@pytest.mark.parametrize(
    ("declared", "encoding"),
    [("ISO-8859-1", "latin-1"), ("windows-1252", "cp1252"), ("UTF-16", "utf-16"), ("utf-8", "utf-8-sig")],
)
def test_xml_is_read_as_it_declares(tmp_path, declared, encoding):
    header = f'<?xml version="1.0" encoding="{declared}"?>'
    read = read_survey(write_osm(tmp_path / "a.osm", [{"ref": "Ä1"}], header=header, encoding=encoding))
    assert read.stalls[0].number == "Ä1"


@pytest.mark.parametrize("declared", ["klingon", "hex"])
def test_unknown_encodings_are_named(tmp_path, declared):
    path = write_osm(tmp_path / "a.osm", [{}], header=f'<?xml version="1.0" encoding="{declared}"?>')
    with pytest.raises(ConfigError, match=f"a.osm: encoding: got '{declared}'; allowed: a known one"):
        read_survey(path)


ROWS = "id;x;y;width_m;length_m;heading_deg\nSüd;1.25;2.5;2.5;5;270\nb;3.75;2.5;2.5;5;270\n"


@pytest.mark.parametrize(
    "data",
    [
        ROWS.encode(),
        ROWS.replace(";", "\t").encode("utf-16"),
        ROWS.replace(";", "|").encode(),
        f"sep=;\r\n{ROWS}".encode(),
        ROWS.replace(".", ",").encode("cp1252"),
        ROWS.replace("\n", ";;\r\n").encode("utf-8-sig"),
    ],
)
def test_tables_as_spreadsheets_save_them(tmp_path, data):
    path = tmp_path / "a.csv"
    path.write_bytes(data)
    read = read_survey(path)
    middles = [tuple(sum(axis) / 4 for axis in zip(*stall.corners, strict=True)) for stall in read.stalls]
    assert [stall.name for stall in read.stalls] == ["Süd", "b"]
    assert middles == [(1.25, -2.5), (3.75, -2.5)]


def test_a_misspelt_column_gets_the_nearest(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text(ROWS.replace("heading_deg", "headng_deg"))
    with pytest.raises(ConfigError, match="the nearest is heading_deg"):
        read_survey(path)


@pytest.mark.parametrize(
    ("ring", "corners", "is_said"),
    [
        ([[-1, -1], [20, -1], [20, 12], [20, 40], [20, 12], [-1, 12]], 4, True),  # a spike
        ([[-1, -1], [20, -1], [20, -1], [20, 12], [-1, 12]], 4, False),  # a doubled point
        ([[-1, -1], [20, 12], [20, -1], [-1, 12]], None, True),  # a crossing through the middle
    ],
)
def test_outlines_with_spikes_are_mended_and_said(tmp_path, ring, corners, is_said):
    stall = feature("stall", "Polygon", [box(0)])
    read = read_survey(write_geojson(tmp_path / "a.geojson", [stall, feature("outline", "Polygon", [ring])]))
    assert (None if read.outline is None else len(set(read.outline))) == corners
    assert bool(read.unread) == is_said


@pytest.mark.parametrize("value", [[], {}, 5, None, "feet"])
def test_members_of_geojson_of_any_type_are_refused(tmp_path, value):
    path = write_geojson(tmp_path / "a.geojson", [feature("stall", "Polygon", [box(0)])], coordinates=value)
    with pytest.raises(ConfigError, match=r"a\.geojson: coordinates"):
        read_survey(path)
    path = write_geojson(tmp_path / "b.geojson", [{"type": value}])
    with pytest.raises(ConfigError, match=r"b\.geojson: features\.0"):
        read_survey(path)


def test_objects_beyond_their_road_are_told_so(tmp_path):
    path = tmp_path / "a.xodr"
    stalls = "".join(
        f'<object id="{number}" type="parkingSpace" s="{s}" t="8" width="5" length="2.5"/>'
        for number, s in enumerate((10, 500))
    )
    path.write_text(
        '<OpenDRIVE><road id="1" length="60"><planView><geometry s="0" x="0" y="0" hdg="0" length="60"><line/>'
        f"</geometry></planView><objects>{stalls}</objects></road></OpenDRIVE>"
    )
    read = read_survey(path)
    assert len(read.stalls) == 1
    assert [part.reason for part in read.unread] == ["s = 500 is beyond the ends of its road of 60 m"]


def test_lines_over_joints_that_differ_by_micrometres_leave_no_empty_mesh(tmp_path):
    stalls = [feature("stall", "Polygon", [box(2.5 * at + 2e-6 * (at % 2))]) for at in range(4)]
    crossing = feature("lane", "LineString", [[5.000001, -3], [5.000001, 12]], width=6)
    made = import_layout(write_geojson(tmp_path / "a.geojson", [*stalls, crossing]), tmp_path / "a.usda", proves=False)
    assert made.garage.layout.parking_stalls + len(made.garage.layout.source.unplaced) == 4
