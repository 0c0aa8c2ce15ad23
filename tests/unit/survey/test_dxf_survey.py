"""DXF: drawings that ezdxf writes, against shapely's geometry of the same garage in metres."""

import math

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.enums import TextEntityAlignment
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.drawing_words import PartKind, kind_of
from garage2usd.survey.dxf_survey import read_dxf_survey
from garage2usd.survey.reader import read_building, read_survey
from garage2usd.survey.survey import PortalKind, Survey
from garage2usd.survey.surveyed_building import SurveyedBuilding

UNITS = {1: 0.0254, 2: 0.3048, 4: 0.001, 5: 0.01, 6: 1.0}
WIDTH, LENGTH = 2.5, 5.0


class Sheet:
    """A drawing under construction, in metres."""

    def __init__(self, units=6, scale=None, turn_deg=0.0, shift=(0.0, 0.0)):
        self.document = ezdxf.new("R2010")
        self.document.header["$INSUNITS"] = units
        self.space = self.document.modelspace()
        self.scale = scale or 1 / UNITS.get(units, 1.0)
        cos, sin = math.cos(math.radians(turn_deg)), math.sin(math.radians(turn_deg))
        self.matrix, self.shift = np.array([[cos, sin], [-sin, cos]]), np.array(shift)

    def at(self, *points):
        return ((np.array(points) @ self.matrix + self.shift) * self.scale).tolist()

    def line(self, start, end, layer, z=0.0):
        ends = [(*point, z * self.scale) for point in self.at(start, end)]
        return self.space.add_line(*ends, dxfattribs={"layer": layer})

    def ring(self, points, layer, space=None, z=0.0):
        attributes = {"layer": layer, "elevation": z * self.scale}
        return (self.space if space is None else space).add_lwpolyline(
            self.at(*points), close=True, dxfattribs=attributes
        )

    def box(self, x, y, width, height, layer, **options):
        return self.ring([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], layer, **options)

    def text(self, text, at, layer="TEXT"):
        entity = self.space.add_text(text, height=0.4 * self.scale, dxfattribs={"layer": layer})
        entity.set_placement(self.at(at)[0], align=TextEntityAlignment.MIDDLE_CENTER)

    def row(self, count, x=0.0, y=0.0, layer="STALLS", **options):
        for number in range(count):
            self.box(x + number * WIDTH, y, WIDTH, LENGTH, layer, **options)

    def comb(self, count, x=0.0, y=0.0, layer="STALLS", depth=LENGTH, lean=0.0):
        for number in range(count + 1):
            left = x + number * WIDTH
            self.line((left, y), (left + lean, y + depth), layer)

    def save(self, tmp_path):
        path = tmp_path / "plan.dxf"
        self.document.saveas(path)
        return path

    def read(self, tmp_path) -> Survey:
        return read_survey(self.save(tmp_path))

    def ground(self, *boxes):
        """The ground of boxes (x, y, width, height) as the survey has it, (x, z) in metres."""
        rings = [[(x, y), (x + w, y), (x + w, y + h), (x, y + h)] for x, y, w, h in boxes]
        return [shapely.Polygon(np.array(self.at(*ring)) / self.scale * (1, -1)) for ring in rings]


def row_of(count, x=0.0, y=0.0):
    return [(x + number * WIDTH, y, WIDTH, LENGTH) for number in range(count)]


def assert_stalls(survey, expected):
    """Each expected ground is that of one stall, to a centimetre."""
    found = survey.stall_polygons()
    assert len(found) == len(expected)
    for ground in expected:
        assert sum(ground.hausdorff_distance(stall) < 0.01 for stall in found) == 1


@pytest.mark.parametrize("units", UNITS)
@pytest.mark.parametrize("turn_deg", [0.0, 33.0])
def test_rings_are_stalls_in_any_unit(tmp_path, units, turn_deg):
    sheet = Sheet(units, turn_deg=turn_deg, shift=(70.0, -30.0))
    sheet.row(6)
    for number, word in enumerate(["12a", "A/3", "EV", "Behinderte", "", "Ä7"]):
        if word:
            sheet.text(word, (number * WIDTH + 1.25, 2.0))
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(6)))
    by_place = sorted(
        survey.stalls, key=lambda stall: sheet.ground((0, 0, 0.1, 0.1))[0].distance(shapely.Polygon(stall.corners))
    )
    assert [stall.number for stall in by_place] == ["12a", "A/3", "", "", "", "Ä7"]
    assert [stall.use for stall in by_place[2:4]] == [StallUse.EV, StallUse.ACCESSIBLE]
    assert survey.unread == ()


@pytest.mark.parametrize(("units", "scale"), [(0, 1000), (0, 1), (0, 100), (0, 1 / 0.3048), (1, 1), (4, 1), (6, 1000)])
def test_a_missing_or_wrong_unit_is_told_by_the_stalls(tmp_path, units, scale):
    sheet = Sheet(units, scale)
    sheet.row(5)
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(5)))
    assert [part.name for part in survey.unread] == ["$INSUNITS"]


@pytest.mark.parametrize("turn_deg", [0.0, 20.0])
@pytest.mark.parametrize("rear", ["line", "short line", "none", "wall", "double row"])
def test_combs_of_lines_are_stalls(tmp_path, turn_deg, rear):
    sheet = Sheet(turn_deg=turn_deg)
    expected = row_of(8)
    if rear == "double row":
        sheet.comb(8, y=-LENGTH, depth=2 * LENGTH)
        expected += row_of(8, y=-LENGTH)
    else:
        gap = 0.04 if rear == "short line" else 0.0
        sheet.comb(8, y=gap, depth=LENGTH - gap)
    if rear != "none":
        sheet.line((0, 0), (8 * WIDTH, 0), "WALLS" if rear == "wall" else "STALLS")
    assert_stalls(sheet.read(tmp_path), sheet.ground(*expected))


def test_the_last_stall_of_a_comb_ends_at_a_wall(tmp_path):
    sheet = Sheet()
    sheet.box(0, 0, 10 * WIDTH, 16, "WAND")
    for number in range(1, 10):  # no line beside the walls
        sheet.line((number * WIDTH, 0), (number * WIDTH, LENGTH), "Stellplätze")
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(10)))
    assert shapely.Polygon(survey.outline).area == pytest.approx(10 * WIDTH * 16, rel=0.01)


def test_angled_combs_are_parallelograms(tmp_path):
    sheet = Sheet()
    sheet.comb(6, lean=2.9)
    sheet.line((0, 0), (6 * WIDTH, 0), "STALLS")
    rings = [[(x, 0), (x + WIDTH, 0), (x + WIDTH + 2.9, 5), (x + 2.9, 5)] for x in np.arange(6) * WIDTH]
    assert_stalls(sheet.read(tmp_path), [shapely.Polygon(np.array(ring) * (1, -1)) for ring in rings])


def test_stalls_without_a_word_are_told_by_their_size_and_named(tmp_path):
    sheet = Sheet()
    sheet.row(7, layer="0")
    sheet.box(30, 0, 2.4, 4.9, "E-Verteiler")  # alone, so a cabinet
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(7)))
    assert [part.name for part in survey.unread] == ["layer 0"]


def test_blocks_are_scaled_turned_mirrored_nested_and_repeated(tmp_path):
    sheet = Sheet()
    block = sheet.document.blocks.new("STELLPLATZ")
    block.add_lwpolyline([(0, 0), (1, 0), (1, 2), (0, 2)], close=True)
    block.add_attdef("NR", (0.3, 0.8), height=0.1)
    row = sheet.document.blocks.new("ROW")
    for number in range(3):
        row.add_blockref("STELLPLATZ", (number * WIDTH, 0), {"xscale": WIDTH, "yscale": 2.5})
    space = sheet.space
    space.add_blockref("ROW", (0, 0))
    space.add_blockref("ROW", (0, 10), {"rotation": 90})
    space.add_blockref("STELLPLATZ", (20, 0), {"xscale": -WIDTH, "yscale": 2.5})
    many = {
        "xscale": WIDTH,
        "yscale": 2.5,
        "column_count": 4,
        "column_spacing": WIDTH,
        "row_count": 2,
        "row_spacing": 11,
    }
    space.add_blockref("STELLPLATZ", (30, 0), many)
    numbered = space.add_blockref("STELLPLATZ", (20, 0), {"xscale": WIDTH, "yscale": 2.5})
    numbered.add_attrib("NR", "B-17", (21.2, 2.4), {"height": 0.3})
    survey = sheet.read(tmp_path)
    turned = [(-LENGTH, 10 + number * WIDTH, LENGTH, WIDTH) for number in range(3)]
    assert_stalls(survey, sheet.ground(*row_of(3), *turned, *row_of(2, 17.5), *row_of(4, 30), *row_of(4, 30, 11)))
    (named,) = [stall for stall in survey.stalls if stall.number]
    assert (named.number, named.name) == ("B-17", "B-17")


def test_a_block_of_lines_is_the_rectangle_around_it(tmp_path):
    sheet = Sheet()
    block = sheet.document.blocks.new("parking bay")
    for start, end in [((0, 0), (0, 5)), ((2.5, 0), (2.5, 5)), ((0.2, 2), (2.3, 2))]:
        block.add_line(start, end)
    for number in range(4):
        sheet.space.add_blockref("parking bay", (number * 6, 3), {"rotation": 30 * number})
    survey = sheet.read(tmp_path)
    assert len(survey.stalls) == 4
    assert all(ground.area == pytest.approx(12.5, rel=0.01) for ground in survey.stall_polygons())


def test_columns_walls_doors_and_blocks(tmp_path):
    sheet = Sheet()
    sheet.row(10, x=1)
    sheet.row(10, x=1, y=11.5)
    for x, y, width, height in [
        (-0.3, -0.3, 28.6, 0.3),
        (-0.3, 0, 0.3, 16.5),
        (28, 0, 0.3, 6),
        (28, 12, 0.3, 4.5),
        (-0.3, 16.5, 28.6, 0.3),
    ]:
        sheet.box(x, y, width, height, "Wände")
    sheet.box(26.4, 6, 0.2, 3, "Wände")  # stands free
    sheet.line((28.1, 6), (28.1, 12), "Tor Einfahrt")
    sheet.line((0, 9.1), (0, 12.1), "Tor")
    sheet.text("Ausfahrt", (-0.8, 10.5))
    sheet.line((0, 8.2), (0, 9.0), "Tür")  # for people
    sheet.space.add_circle((6, 6), 0.25, dxfattribs={"layer": "Stütze"})
    sheet.box(13, 5.5, 0.4, 0.4, "Stütze")
    hatch = sheet.space.add_hatch(dxfattribs={"layer": "Stütze"})
    hatch.paths.add_polyline_path([(13, 5.5), (13.4, 5.5), (13.4, 5.9), (13, 5.9)], is_closed=True)
    for start, end in [((20, 5), (20.5, 5)), ((20.5, 5), (20.5, 5.5)), ((20.5, 5.5), (20, 5.5)), ((20, 5.5), (20, 5))]:
        sheet.line(start, end, "Stütze")
    sheet.box(1.5, 6.5, 2, 3, "Aufzug")
    survey = sheet.read(tmp_path)
    assert survey.unread == ()
    assert len(survey.stalls) == 20
    assert shapely.Polygon(survey.outline).symmetric_difference(shapely.box(0, -16.5, 28, 0)).area < 0.1
    assert sorted((round(x, 1), round(-z, 1), round(size, 2)) for (x, z), size in survey.columns) == [
        (6.0, 6.0, 0.44),
        (13.2, 5.7, 0.4),
        (20.2, 5.2, 0.5),
    ]
    doors = {portal.kind: portal.position for portal in survey.portals}
    assert doors[PortalKind.ENTRANCE] == pytest.approx((28.1, -9.0), abs=0.05)
    assert doors[PortalKind.EXIT] == pytest.approx((0, -10.6), abs=0.05)
    assert sorted(round(ground.area, 2) for ground in survey.solid_polygons()) == [0.6, 6.0]


def test_lanes_have_widths_and_directions_and_edges_are_named(tmp_path):
    sheet = Sheet()
    sheet.row(8)
    sheet.space.add_lwpolyline([(0, 8), (20, 8)], dxfattribs={"layer": "LANES", "const_width": 5.5})
    sheet.space.add_lwpolyline([(20, 8), (20, 30)], dxfattribs={"layer": "LANES_ONE_WAY"})
    sheet.line((0, 5.2), (20, 5.2), "Fahrgasse")  # along the stalls
    survey = sheet.read(tmp_path)
    assert [(lane.points, lane.width_m, lane.one_way) for lane in survey.lanes] == [
        (((0.0, -8.0), (20.0, -8.0)), 5.5, False),
        (((20.0, -8.0), (20.0, -30.0)), None, True),
    ]
    assert [part.reason for part in survey.unread] == [
        "lines along stalls, the edges of lanes, whose middle the drawing does not have"
    ]


def test_hidden_layers_paper_space_cars_and_notes_are_left_out(tmp_path):
    sheet = Sheet()
    sheet.row(4)
    for layer, hide in (("STALLS old", "off"), ("STALLS future", "freeze")):
        getattr(sheet.document.layers.add(layer), hide)()
        sheet.row(3, x=30, layer=layer)
    sheet.row(2, x=60, layer="Fahrzeuge")
    sheet.row(2, x=80, layer="A-ANNO-DIMS")
    sheet.row(5, x=0, y=40, space=sheet.document.layout("Layout1"))
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(4)))
    assert sorted(part.reason for part in survey.unread) == [
        "on the layer STALLS future, which is off or frozen",
        "on the layer STALLS old, which is off or frozen",
    ]


@pytest.mark.parametrize("outlined", [True, False])
def test_of_plans_beside_each_other_the_largest_is_read(tmp_path, outlined):
    sheet = Sheet()
    for x, count in ((0, 5), (60, 9), (120, 3)):
        sheet.row(count, x=x)
        if outlined:
            sheet.box(x - 1, -1, 30, 16, "OUTLINE")
    sheet.text("2. UG", (65, -4))
    sheet.text("Level B3", (121, -3))
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(9, 60)))
    told = {part.name: part.reason for part in survey.unread}
    assert told == {
        "plan 2": "a floor plan of 5 stalls beside 2. UG; --level 'plan 2' imports it",
        "Level B3": "a floor plan of 3 stalls beside 2. UG; --level 'Level B3' imports it",
    }
    building = read_building(tmp_path / "plan.dxf")
    (third,) = building.only("Level B3").levels
    assert_stalls(third.survey, sheet.ground(*row_of(3, 120)))
    with pytest.raises(ConfigError, match=r"2\. UG, plan 2, Level B3"):
        building.only("B4")


def test_stalls_at_several_heights_are_levels_with_ramps(tmp_path):
    sheet = Sheet(units=4)
    for name, z, count in (("EG", 0.0, 3), ("U1", -3.2, 6)):
        sheet.row(count, layer=f"STALLS_{name}", z=z)
        sheet.box(-1, -1, 30, 16, f"OUTLINE_{name}", z=z)
    ramp = [(*point, z * 1000) for point, z in zip(sheet.at((20, 8), (40, 8)), (0.0, -3.2), strict=True)]
    sheet.space.add_polyline3d(ramp, dxfattribs={"layer": "RAMPS"})
    building = read_dxf_survey(sheet.save(tmp_path))
    assert isinstance(building, SurveyedBuilding)
    assert [(level.name, level.height_m, len(level.survey.stalls)) for level in building.in_order] == [
        ("EG", 0.0, 3),
        ("U1", -3.2, 6),
    ]
    (joins,) = building.ramps
    assert (joins.points, joins.levels) == (((20.0, -8.0), (40.0, -8.0)), ("EG", "U1"))
    assert len(read_survey(tmp_path / "plan.dxf").stalls) == 6


def test_stalls_of_other_sizes_and_repeated_ones(tmp_path):
    sheet = Sheet()
    sheet.row(3)
    sheet.row(3)  # drawn twice
    sheet.box(12, 0, 1.2, 2.4, "STALLS")  # a motorcycle
    sheet.box(16, 0, 4.0, 14.0, "STALLS")  # a coach
    sheet.box(24, 0, 0.12, 5.0, "STALLS")  # paint
    survey = sheet.read(tmp_path)
    assert_stalls(survey, sheet.ground(*row_of(3), (12, 0, 1.2, 2.4), (16, 0, 4, 14)))


def test_texts_of_several_stalls_are_no_numbers(tmp_path):
    sheet = Sheet()
    sheet.row(4)
    for number in range(4):
        sheet.text("CAM_1", (number * WIDTH + 1.2, 1.0))
        sheet.text(f"{number + 1}", (number * WIDTH + 1.2, 3.0))
    sheet.text("경차", (1.2, 4.0))
    survey = sheet.read(tmp_path)
    assert sorted(stall.number for stall in survey.stalls) == ["1", "2", "3", "4"]
    assert [stall.size for stall in survey.stalls if stall.number == "1"] == [SizeClass.COMPACT]


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("A-COLS", "column"), ("Stützen", "column"), ("기둥", "column"), ("PILARES", "column"),
        ("B1$0$车位线", "stall"), ("PARKING", "stall"), ("C-PKNG-STRP", "stall"), ("주차구획", "stall"),
        ("Vagas", "stall"), ("ParkingSpace", "stall"), ("Stellplatz_EV", "stall"), ("parking aisle", "lane"),
        ("Fahrgasse", "lane"), ("车道", "lane"), ("A-WALL-EXTR", "wall"), ("Wände", "wall"), ("剪力墙", "wall"),
        ("C-PKNG-CARS", "vehicle"), ("Umriss", "outline"), ("A-FLOR-OTLN", "outline"), ("Rolltor", "door"),
        ("出入口", "door"), ("Treppenhaus", "solid"), ("Rampe 2", "ramp"), ("A-ANNO-DIMS", "note"), ("0", None),
        ("Möbel", None), ("Collage", None), ("Parkett", "note"),
    ],
)  # fmt: skip
def test_names_tell_parts_in_many_languages(name, kind):
    assert kind_of(name) == (None if kind is None else PartKind(kind))


def test_blocks_within_themselves_end(tmp_path):
    sheet = Sheet()
    for name, other in (("A", "B"), ("B", "A")):
        sheet.document.blocks.new(name).add_blockref(other, (0, 0))
    sheet.space.add_blockref("A", (0, 0))
    sheet.row(3)
    survey = sheet.read(tmp_path)
    assert len(survey.stalls) == 3


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"AC1032\0\0 a drawing",
        b"\x89PNG\r\n",
        b"0\nSECTION\n2\nENTITIES\n",
        b"0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1027\n9\n$DIMBL",
        "Stellplätze".encode("utf-16"),
    ],
)
def test_other_files_are_refused_in_one_line(tmp_path, data):
    path = tmp_path / "plan.dxf"
    path.write_bytes(data)
    with pytest.raises(ConfigError) as caught:
        read_survey(path)
    assert "\n" not in str(caught.value)


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    sheet = Sheet()
    sheet.comb(4)
    sheet.row(2, x=15)
    sheet.box(-1, -1, 30, 14, "WALLS")
    sheet.box(-1.2, -1.2, 30.4, 14.4, "WALLS")
    sheet.box(20, 5, 3, 3, "WALLS")
    sheet.line((29, 8), (29, 12), "DOORS")
    block = sheet.document.blocks.new("column")
    block.add_circle((0, 0), 0.2)
    sheet.space.add_blockref("column", (3, 7))
    sheet.text("12a", (16, 2))
    text = sheet.save(tmp_path_factory.mktemp("drawn")).read_text()
    return text, text.index("ENTITIES")


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_damaged_drawing_is_read_or_refused(tmp_path, drawn, data):
    text, entities = drawn
    for _ in range(data.draw(st.integers(1, 3))):
        start = data.draw(st.integers(entities if data.draw(st.booleans()) else 0, len(text)))
        end = start + data.draw(st.integers(0, 12))
        text = (
            text[:start]
            + data.draw(st.sampled_from(["", "0\n", "1e400", "nan", "INSERT\n", "\x00", "-1", "é", "\n"]))
            + text[end:]
        )
    path = tmp_path / "plan.dxf"
    path.write_text(text, encoding="utf-8")
    try:
        survey = read_survey(path)
    except Garage2UsdError:
        return
    assert np.isfinite([stall.corners for stall in survey.stalls]).all()
