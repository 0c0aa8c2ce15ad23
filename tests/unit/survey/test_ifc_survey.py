"""IFC: building models that IfcOpenShell writes, against the boxes in metres of which they consist."""

import math

import ifcopenshell
import ifcopenshell.guid
import pytest
import shapely

from garage2usd.common.errors import ConfigError, Garage2UsdError
from garage2usd.garage import StallUse
from garage2usd.survey.ifc_survey import read_ifc_survey
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import PortalKind
from garage2usd.survey.surveyed_building import SurveyedBuilding

W, L = 2.5, 5.0


class Model:
    """A building model under construction, in metres."""

    def __init__(
        self, *, milli=False, schema="IFC4", degrees=None, storeys=(("UG1", -3.2),), north=None, at=(0.0, 0.0)
    ):
        self.file = file = ifcopenshell.file(schema=schema)
        self.scale = 1000.0 if milli else 1.0
        unit = file.createIfcSIUnit(None, "LENGTHUNIT", "MILLI" if milli else None, "METRE")
        true_north = None if north is None else file.createIfcDirection(list(north))
        self.context = file.createIfcGeometricRepresentationContext(None, "Model", 3, 1e-5, self.axes(), true_north)
        units = file.createIfcUnitAssignment([unit])
        project = self.root("IfcProject", "P", RepresentationContexts=[self.context], UnitsInContext=units)
        self.origin = file.createIfcLocalPlacement(None, self.axes(*at))
        site = self.root("IfcSite", "S", ObjectPlacement=self.origin, CompositionType="ELEMENT")
        if degrees:
            site.RefLatitude, site.RefLongitude = degrees
        building = self.root("IfcBuilding", "B", ObjectPlacement=self.origin, CompositionType="ELEMENT")
        self.storeys = {}
        for name, height in storeys:
            place = file.createIfcLocalPlacement(self.origin, self.axes(z=height))
            storey = self.root("IfcBuildingStorey", name, ObjectPlacement=place, Elevation=height * self.scale)
            self.storeys[name] = storey
        for whole, members in ((project, [site]), (site, [building]), (building, list(self.storeys.values()))):
            self.root("IfcRelAggregates", None, RelatingObject=whole, RelatedObjects=members)

    def root(self, kind, name, **values):
        return self.file.create_entity(kind, GlobalId=ifcopenshell.guid.new(), Name=name, **values)

    def axes(self, x=0.0, y=0.0, z=0.0):
        point = self.file.createIfcCartesianPoint([value * self.scale for value in (x, y, z)])
        return self.file.createIfcAxis2Placement3D(point, None, None)

    def box(self, kind, name, x, y, width, depth, height, *, z=0.0, storey="UG1", **values):
        """An element of a storey that is a box above the corner (x, y)."""
        file, scale = self.file, self.scale
        middle = file.createIfcAxis2Placement2D(file.createIfcCartesianPoint([0.0, 0.0]), None)
        profile = file.createIfcRectangleProfileDef("AREA", None, middle, width * scale, depth * scale)
        up = file.createIfcDirection([0.0, 0.0, 1.0])
        solid = file.createIfcExtrudedAreaSolid(profile, self.axes(), up, height * scale)
        return self.element(
            kind, name, [solid], "SweptSolid", self.axes(x + width / 2, y + depth / 2, z), storey, **values
        )

    def element(self, kind, name, items, form, axes, storey, **values):
        floor = self.storeys[storey]
        body = self.file.createIfcShapeRepresentation(self.context, "Body", form, items)
        shape = self.file.createIfcProductDefinitionShape(None, None, [body])
        place = self.file.createIfcLocalPlacement(floor.ObjectPlacement, axes)
        element = self.root(kind, name, ObjectPlacement=place, Representation=shape, **values)
        if kind == "IfcSpace":
            self.root("IfcRelAggregates", None, RelatingObject=floor, RelatedObjects=[element])
        else:
            contained = {"RelatingStructure": floor, "RelatedElements": [element]}
            self.root("IfcRelContainedInSpatialStructure", None, **contained)
        return element

    def properties(self, element, group, **values):
        kinds = {bool: "IfcBoolean", int: "IfcCountMeasure", str: "IfcLabel"}
        members = [
            self.file.createIfcPropertySingleValue(key, None, self.file.create_entity(kinds[type(value)], value), None)
            for key, value in values.items()
        ]
        definition = self.root("IfcPropertySet", group, HasProperties=members)
        related = {"RelatedObjects": [element], "RelatingPropertyDefinition": definition}
        self.root("IfcRelDefinesByProperties", None, **related)

    def row(self, count, x=0.0, y=0.0, **values):
        return [
            self.box("IfcSpace", f"{number + 1:03d}", x + number * W, y, W, L, 2.2, LongName="Stellplatz", **values)
            for number in range(count)
        ]

    def walls(self, width, depth, gap=None, **values):
        """Walls 0.3 m thick around a floor, with a gap (from, to) in the one at the far side."""
        far = [(-0.3, width + 0.6)] if gap is None else [(-0.3, gap[0] + 0.3), (gap[1], width + 0.3 - gap[1])]
        boxes = [(-0.3, -0.3, width + 0.6, 0.3), (-0.3, 0, 0.3, depth), (width, 0, 0.3, depth)]
        for x, y, w, d in boxes + [(start, depth, length, 0.3) for start, length in far]:
            self.box("IfcWall", "Wand", x, y, w, d, 2.8, **values)

    def save(self, tmp_path):
        path = tmp_path / "model.ifc"
        self.file.write(str(path))
        return path


def grounds(*boxes):
    return [shapely.box(x, -y - depth, x + width, -y) for x, y, width, depth in boxes]


def assert_grounds(found, expected, off_m=0.01):
    assert len(found) == len(expected)
    for ground in expected:
        assert sum(ground.hausdorff_distance(other) < off_m for other in found) == 1


@pytest.mark.parametrize("milli", [False, True])
@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4", "IFC4X3_ADD2"])
def test_a_storey_with_all_parts(tmp_path, milli, schema):
    model = Model(milli=milli, schema=schema)
    model.row(6, x=1)
    for number in range(3):
        name = f"Parking Space: 5000 x 2500 mm - 90 deg:{18520 + number}"
        model.box("IfcBuildingElementProxy", name, 1 + W * number, 11, W, L, 0.01)
    model.walls(18, 16, gap=(10, 16))
    model.box("IfcDoor", "Rolltor", 10, 16, 6, 0.3, 2.4)
    model.box("IfcDoor", "Tür", 18, 6, 0.3, 0.9, 2.1)
    model.box("IfcColumn", "STB 40x40", 8.3, 5.1, 0.4, 0.4, 2.8)
    model.box("IfcColumn", "Scheibe", 12, 8, 0.3, 2.4, 2.8)
    model.box("IfcSlab", "Decke", -0.3, -0.3, 18.6, 16.6, 0.3, z=2.8)
    model.box("IfcStair", "Treppe", 15, 12.5, 2.5, 3, 1.5)
    survey = read_survey(model.save(tmp_path))
    expected = [(1 + W * number, 0, W, L) for number in range(6)] + [(1 + W * number, 11, W, L) for number in range(3)]
    assert_grounds(survey.stall_polygons(), grounds(*expected))
    assert sorted(stall.number for stall in survey.stalls) == ["", "", "", *(f"{number:03d}" for number in range(1, 7))]
    assert shapely.Polygon(survey.outline).symmetric_difference(shapely.box(0, -16, 18, 0)).area < 0.1
    assert [(column.centre, column.size_m) for column in survey.columns] == [((8.5, -5.3), pytest.approx(0.4))]
    assert_grounds(survey.solid_polygons(), grounds((12, 8, 0.3, 2.4), (15, 12.5, 2.5, 3)))
    ((position, kind),) = survey.portals
    assert position == pytest.approx((13, -16.15))
    assert kind is PortalKind.BOTH
    assert survey.unread == ()
    assert survey.origin_deg is None
    assert survey.ceiling_height_m == pytest.approx(2.8)  # under the slab


def test_spaces_by_type_and_properties(tmp_path):
    model = Model()
    parking = model.box("IfcSpace", "17", 0, 0, W, L, 2, PredefinedType="PARKING")
    aisle = model.box("IfcSpace", "Allee", 0, 5, 20, 6, 2, PredefinedType="PARKING")
    model.properties(aisle, "Pset_SpaceParking", IsAisle=True)
    row = model.box("IfcSpace", "Parkplätze", 5, 0, 4 * W, L, 2)
    model.properties(row, "Pset_SpaceParking", ParkingUnits=4)
    wide = model.box("IfcSpace", "车位", 16, 0, 3.5, L, 2)
    model.properties(wide, "Pset_SpaceCommon", HandicapAccessible=True)
    model.properties(wide, "Pset_Revit", Mark="B/12a")
    model.box("IfcSpace", "Ladestation", 22, 0, W, L, 2, LongName="parking bay EV")
    model.box("IfcSpace", "Büro", 30, 0, W, L, 2)
    model.box("IfcSpace", "Parking level", 0, 20, 30, 30, 2)
    model.properties(parking, "Pset_SpaceParking", ParkingUnits=1)
    survey = read_survey(model.save(tmp_path))
    by_name = {stall.name: stall for stall in survey.stalls}
    assert [name for name in by_name if "Parkplätze" in name] == [
        f"IfcSpace Parkplätze, stall {n}" for n in (1, 2, 3, 4)
    ]
    assert by_name["B/12a"].use is StallUse.ACCESSIBLE
    assert by_name["17"].number == "17"
    assert [stall.use for stall in survey.stalls].count(StallUse.EV) == 1
    assert len(survey.stalls) == 7
    assert survey.unread == (("IfcSpace Parking level", "30.0 by 30.0 m, which is no stall; its ground stays free"),)


def test_without_walls_the_slab_is_the_outline(tmp_path):
    model = Model()
    model.row(5, x=2, y=2)
    model.box("IfcSlab", "Bodenplatte", 0, 0, 20, 15, 0.3, z=-0.3)
    survey = read_survey(model.save(tmp_path))
    assert_grounds([shapely.Polygon(survey.outline)], grounds((0, 0, 20, 15)))


def test_storeys_are_levels_and_ramps_join_them(tmp_path):
    model = Model(storeys=(("UG2", -6.4), ("UG1", -3.2), ("EG", 0.0)))
    model.row(4, storey="UG1")
    model.row(6, storey="UG2")
    model.box("IfcColumn", "c", 3, 8, 0.4, 0.4, 2.8, storey="UG2")
    points = [(20, 8, 0), (24, 8, 0), (24, 30, 3.2), (20, 30, 3.2), (20, 30, 0), (24, 30, 0)]
    file = model.file
    corners = [file.createIfcCartesianPoint([float(value) for value in point]) for point in points]
    faces = [
        file.createIfcFace([file.createIfcFaceOuterBound(file.createIfcPolyLoop([corners[n] for n in ring]), True)])
        for ring in ([0, 1, 2, 3], [0, 4, 5, 1], [3, 2, 5, 4], [0, 3, 4], [1, 5, 2])
    ]
    ramp = file.createIfcFacetedBrep(file.createIfcClosedShell(faces))
    model.element("IfcRamp", "Rampe", [ramp], "Brep", model.axes(), "UG2")
    building = read_ifc_survey(model.save(tmp_path))
    assert isinstance(building, SurveyedBuilding)
    told = [(level.name, level.height_m, len(level.survey.stalls)) for level in building.in_order]
    assert told == [("UG1", -3.2, 4), ("UG2", -6.4, 6)]
    assert [len(level.survey.columns) for level in building.in_order] == [0, 1]
    (joins,) = building.ramps
    ends = dict(zip(joins.levels, joins.points, strict=True))
    assert ends == {"UG2": (22.0, -8.0), "UG1": (22.0, -30.0)}
    assert joins.width_m == 4.0
    assert len(read_survey(tmp_path / "model.ifc").stalls) == 6


def test_a_site_with_degrees_is_the_origin_and_true_north_is_up(tmp_path):
    turn = math.radians(30)  # true north lies 30 degrees clockwise of y
    place = {
        "degrees": ((48, 8, 15, 0), (11, 34, 30, 0)),
        "north": (math.sin(turn), math.cos(turn)),
        "at": (500.0, 80.0),
    }
    model = Model(milli=True, **place)
    model.row(3)
    survey = read_survey(model.save(tmp_path))
    assert survey.origin_deg == (48.1375, 11.575)
    turned = [
        shapely.affinity.rotate(ground, -30, origin=(0, 0)) for ground in grounds(*[(W * n, 0, W, L) for n in range(3)])
    ]
    assert_grounds(survey.stall_polygons(), turned)


@pytest.mark.parametrize("data", [b"", b"ISO-10303-21;\nHEADER;", b"PK\x03\x04", b"<ifcXML/>"])
def test_other_files_are_refused_in_one_line(tmp_path, data):
    path = tmp_path / "model.ifc"
    path.write_bytes(data)
    with pytest.raises(ConfigError) as caught:
        read_survey(path)
    assert "\n" not in str(caught.value)


def test_a_damaged_model_is_read_or_refused(tmp_path):
    model = Model()
    model.row(2)
    text = model.save(tmp_path).read_text()
    path = tmp_path / "damaged.ifc"
    for start in range(text.index("DATA;"), len(text), 211):
        for piece in ("", "$", "*", "1.E400", "#1", "'"):
            path.write_text(text[:start] + piece + text[start + 3 :])
            try:
                survey = read_survey(path)
            except Garage2UsdError:
                continue
            assert len(survey.stalls) <= 2


def test_shapes_that_are_written_many_times_are_read_once(tmp_path):
    model = Model()
    model.row(2)
    text = model.save(tmp_path).read_text()
    lines = "".join(line for line in text.splitlines(keepends=True) if "IFCPRODUCTDEFINITIONSHAPE" in line)
    path = tmp_path / "repeated.ifc"
    path.write_text(text.replace(lines[:40], lines * 50 + lines[:40], 1))
    assert len(read_survey(path).stalls) == 2


def test_models_without_stalls_are_refused(tmp_path):
    model = Model()
    model.walls(10, 10)
    with pytest.raises(ConfigError, match="a file with a stall"):
        read_survey(model.save(tmp_path))
