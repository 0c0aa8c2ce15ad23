"""What the viewer reads of a stage agrees with the layout, the label table and pxr."""

import json
import struct
from collections import Counter

import numpy as np
import pytest
from pxr import Gf, Kind, Sdf, Usd, UsdGeom, UsdLux, UsdPhysics, UsdShade, Vt
from support.label_tables import labelled_objects

import garage2usd
from garage2usd.common.errors import StageError
from garage2usd.reading.files import open_stage
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.prototypes import asset_of
from garage2usd.view.viewer import read_scene
from garage2usd.view.viewer.reading import collider_lines
from garage2usd.view.viewer.scene import moved
from garage2usd.view.viewer.wire import encode_colliders, encode_scene

PLAN = """
.......
E=====.
.=...=.
.=====X
.......
"""
FORMS = ["instanced", "nested", "flat"]
MILLIMETRE = 1e-3


@pytest.fixture(scope="module")
def garages(tmp_path_factory):
    """A small garage in every form, each with its scene."""
    found = {}
    for form, extension in zip(FORMS, ["usdc", "usdz", "usda"], strict=True):
        config = garage2usd.GarageConfig(seed=5, site={"structure": PLAN}, stage={"form": form, "arrangements": 3})
        build = garage2usd.build(config, tmp_path_factory.mktemp(form) / f"g.{extension}")
        found[form] = build, read_scene(open_stage(build.stage), build.stage)
    return found


@pytest.fixture(params=FORMS)
def garage(garages, request):
    return garages[request.param]


def drawn_points(scene, placed):
    shape = scene.shapes[placed.shape]
    parts = [moved(piece.mesh.positions_m, piece.matrix) for piece in shape.pieces]
    return moved(np.concatenate(parts), placed.matrix)


def test_every_object_of_the_layout_is_there_once_with_its_class_id_and_place(garage):
    build, scene = garage
    layout = build.garage.layout
    table = labelled_objects(build.labels)
    pieces = table[len(layout.placements) :]
    classes = [*(OBJECT_LABELS[place.kind] for place in layout.placements), *(entry["class"] for entry in pieces)]
    assert scene.counts() == Counter(classes)
    objects = {placed.path: placed for placed in scene.objects}
    assert len(objects) == len(scene.objects) == len(table)
    for entry in table:
        assert objects[entry["path"]].label == entry["class"]
        assert scene.ids[entry["path"]] == entry["id"]
    for entry, placement in zip(table, layout.placements, strict=False):
        placed = objects[entry["path"]]
        assert np.allclose(placed.matrix[3, :3], placement.position_m, atol=MILLIMETRE)


def test_the_triangles_of_every_object_fill_its_bounds_in_the_label_table(garage):
    build, scene = garage
    drawn = {}
    for placed in scene.objects:
        lights = [(light.matrix @ placed.matrix)[3:, :3] for light in scene.shapes[placed.shape].lights]
        drawn[placed.path] = [np.concatenate([drawn_points(scene, placed), *lights])]
    for path, own in list(drawn.items()):  # an object's bounds are around its pieces too
        drawn.get(path.rpartition("/")[0], []).extend(own)
    for entry in labelled_objects(build.labels):
        points = np.concatenate(drawn[entry["path"]])
        assert np.allclose(points.min(axis=0), entry["min_m"], atol=MILLIMETRE), entry["path"]
        assert np.allclose(points.max(axis=0), entry["max_m"], atol=MILLIMETRE), entry["path"]


def test_nothing_is_lost_or_doubled_when_faces_become_triangles(garage):
    build, scene = garage
    shown = sum(len(piece.mesh.indices) for placed in scene.objects for piece in scene.shapes[placed.shape].pieces)
    parts = [part for place in build.garage.layout.placements for part in asset_of(place.spec).parts]
    assert shown == sum(int((part.face_counts - 2).sum()) for part in parts)
    for shape in scene.shapes:
        for part in (piece.mesh for piece in shape.pieces):
            assert np.allclose(np.linalg.norm(part.normals, axis=1), 1, atol=1e-4)
            corners = part.positions_m[part.indices].astype(float)
            areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
            outward = (areas * part.normals[part.indices].mean(axis=1)).sum(axis=1)
            assert (outward[np.linalg.norm(areas, axis=1) > 1e-7] > 0).mean() > 0.99


def test_cars_that_differ_in_paint_share_their_shape_but_not_their_palette(garages):
    build, scene = garages["instanced"]
    cars = [placed for placed in scene.objects if placed.label == "car"]
    specs = {place.spec for place in build.garage.layout.of_kind("car")}
    bodies = {spec.body for spec in specs}
    assert len({placed.shape for placed in cars}) == len(bodies)
    # bodies have parts of other materials: lips of arches, dark glass
    assert len({spec.paint for spec in specs}) <= len({placed.palette for placed in cars}) <= len(specs)
    colours = {scene.surfaces[number].colour_rgb for placed in cars for number in scene.palettes[placed.palette]}
    assert len(colours) > len({spec.paint for spec in specs})


def test_the_forms_of_one_garage_look_the_same(garages):
    """All but the draws of cars and stains, which the nested form repeats on purpose."""
    steady = {"floor", "wall", "column", "ceiling", "light", "parking_stall", "obstacle", "beam", "duct"}

    def places(form):
        _, scene = garages[form]
        return {
            (placed.label, tuple(np.round(drawn_points(scene, placed).mean(axis=0), 2).tolist()))
            for placed in scene.objects
            if placed.label in steady
        }

    assert places("instanced") == places("flat")
    assert len(places("nested") ^ places("flat")) == 0


def test_stalls_and_lanes_are_those_of_the_layout(garage):
    build, scene = garage
    stalls = build.garage.layout.stalls
    assert [stall.name for stall in scene.lanes.stalls] == [stall.name for stall in stalls]
    for shown, stall in zip(scene.lanes.stalls, stalls, strict=True):
        assert np.allclose(shown.corners, stall.corners_m(), atol=MILLIMETRE)
        facts = dict(shown.facts)
        assert facts["number"] == stall.number
        assert shown.use == stall.use
        assert facts["type"] == str(stall.stall_type)
        assert facts["entryEdge"] == stall.edge.name.lower()
    graph = build.garage.graph.graph
    kinds = dict(graph.nodes(data="kind"))
    assert [node.kind for node in scene.lanes.nodes] == [kinds[square].value for square in sorted(graph.nodes)]
    assert len(scene.lanes.edges) == graph.number_of_edges()


def test_every_tube_shines_where_it_hangs(garage):
    build, scene = garage
    tubes = {tuple(np.round(place.position_m, 2)) for place in build.garage.layout.of_kind("light")}
    shining = [(placed, light) for placed in scene.objects for light in scene.shapes[placed.shape].lights]
    assert len(shining) == len(tubes)
    for placed, light in shining:
        assert light.candela > 0
        way = (light.matrix @ placed.matrix)[2, :3]  # a rect light shines along -Z
        assert np.allclose(-way, [0, -1, 0], atol=1e-6)


def test_colliders_are_drawn_around_what_collides(garages):
    _, scene = garages["instanced"]
    for shape in scene.shapes:
        for collider in shape.colliders:
            lines = collider_lines(collider)
            points = moved(collider.mesh.positions_m, collider.matrix)
            # edges between faces that are all but in one plane are not drawn
            assert np.allclose(lines.min(axis=(0, 1)), points.min(axis=0), atol=0.005)
            assert np.allclose(lines.max(axis=(0, 1)), points.max(axis=0), atol=0.005)
            if collider.collider == "boundingCube":
                assert len(lines) == 12
    assert {piece.collider for shape in scene.shapes for piece in shape.colliders} == {
        "boundingCube",
        "convexHull",
        "none",
    }


def test_what_a_variant_hides_is_not_shown(garages):
    build, _ = garages["instanced"]
    stage = open_stage(build.stage)
    sets = stage.GetPrimAtPath("/Garage").GetVariantSets()
    stage.SetEditTarget(stage.GetSessionLayer())
    sets.SetSelection("occupancy", "empty")
    sets.SetSelection("ceiling", "hidden")
    counts = read_scene(stage, build.stage).counts()
    assert not counts.keys() & {"car", "ceiling", "beam", "duct", "exit_sign"}
    assert counts["column"] == len(build.garage.layout.of_kind("column"))


def test_the_page_gets_what_the_scene_holds(garages):
    _, scene = garages["flat"]
    data = encode_scene(scene)
    magic, size = struct.unpack_from("<4sI", data)
    header, body = json.loads(data[8 : 8 + size]), data[8 + size :]
    assert magic == b"G2UV"

    def array(number, kind):
        place = header["arrays"][number]
        return np.frombuffer(body, kind, place["count"], place["at"])

    objects, shapes = header["objects"], header["shapes"]
    assert objects["paths"] == [placed.path for placed in scene.objects]
    assert [header["labels"][label] for label in array(objects["label"], "<u4")] == [p.label for p in scene.objects]
    rows = array(objects["matrix"], "<f4").reshape(-1, 3, 4)
    positions, indices = array(shapes["positions"], "<f4").reshape(-1, 3), array(shapes["indices"], "<u4")
    for number in range(0, len(scene.objects), 17):
        placed = scene.objects[number]
        entry = shapes["entries"][array(objects["shape"], "<u4")[number]]
        first, count = entry["vertices"]
        local = np.pad(positions[first : first + count], ((0, 0), (0, 1)), constant_values=1)
        assert np.allclose(local @ rows[number].T, drawn_points(scene, placed), atol=MILLIMETRE)
        used = [indices[at : at + size] for at, size in (entry["opaque"], entry["blended"])]
        assert np.concatenate(used).max() == count - 1
    counts = np.frombuffer(encode_colliders(scene), "<u4", len(scene.shapes))
    assert len(encode_colliders(scene)) == 4 * len(counts) + 12 * counts.sum()


# Stages that are not ours


def foreign(tmp_path, *, up="Y", metres=1.0):
    stage = Usd.Stage.CreateNew(str(tmp_path / "foreign.usda"))
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/World").GetPrim())
    return stage


@pytest.fixture
def read(tmp_path):
    def read_back(stage):
        stage.Save()
        path = tmp_path / "foreign.usda"
        return read_scene(open_stage(path), path)

    return read_back


def test_centimetres_and_z_up_become_metres_and_y_up(tmp_path, read):
    stage = foreign(tmp_path, up="Z", metres=0.01)
    cube = UsdGeom.Cube.Define(stage, "/World/Box")
    cube.GetSizeAttr().Set(200)
    UsdGeom.XformCommonAPI(cube).SetTranslate(Gf.Vec3d(100, 500, 300))
    scene = read(stage)
    (placed,) = scene.objects
    assert placed.label == "unlabelled"
    points = drawn_points(scene, placed)
    assert np.allclose(points.min(axis=0), [0, 2, -6])
    assert np.allclose(points.max(axis=0), [2, 4, -4])


@pytest.mark.parametrize(
    ("define", "volume"),
    [
        (UsdGeom.Cube, 8.0),
        (UsdGeom.Sphere, 4 / 3 * np.pi),
        (UsdGeom.Cylinder, 2 * np.pi),
        (UsdGeom.Cone, 2 / 3 * np.pi),
        (UsdGeom.Capsule, np.pi + 4 / 3 * np.pi / 8),
    ],
)
def test_simple_shapes_are_closed_and_as_large_as_they_say(tmp_path, read, define, volume):
    stage = foreign(tmp_path)
    define.Define(stage, "/World/Shape")
    scene = read(stage)
    corners = drawn_points(scene, scene.objects[0])[scene.shapes[0].pieces[0].mesh.indices].astype(float)
    found = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6
    expected = volume if define is not UsdGeom.Capsule else np.pi / 4 + np.pi / 6
    assert found == pytest.approx(expected, rel=0.06)


def test_a_left_handed_mesh_faces_outwards_and_subsets_have_their_own_material(tmp_path, read):
    stage = foreign(tmp_path)
    mesh = UsdGeom.Mesh.Define(stage, "/World/Quads")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1), (2, 0, 0), (2, 0, 1)])
    mesh.CreateFaceVertexCountsAttr([4, 4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3, 1, 4, 5, 2])
    mesh.CreateOrientationAttr("leftHanded")
    mesh.CreateSubdivisionSchemeAttr("none")
    for name, faces, colour in (("Left", [0], (1, 0, 0)), ("Right", [1], (0, 1, 0))):
        material = UsdShade.Material.Define(stage, f"/World/{name}Look")
        shader = UsdShade.Shader.Define(stage, f"/World/{name}Look/Surface")
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*colour))
        material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", Sdf.ValueTypeNames.Token))
        subset = UsdGeom.Subset.CreateGeomSubset(mesh, name, "face", Vt.IntArray(faces), "materialBind")
        UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(material)
    scene = read(stage)
    (shape,) = scene.shapes
    colours = [scene.surfaces[scene.palettes[0][slot]].colour_rgb for slot in (piece.slot for piece in shape.pieces)]
    assert colours == [(1, 0, 0), (0, 1, 0)]
    for piece in shape.pieces:
        assert np.allclose(piece.mesh.normals, [0, 1, 0])  # clockwise seen from above is outside for left hands


def test_broken_and_unknown_things_are_left_out_and_named(tmp_path, read):
    stage = foreign(tmp_path)
    UsdGeom.Cube.Define(stage, "/World/Good")
    UsdGeom.Points.Define(stage, "/World/Cloud")
    hidden = UsdGeom.Cube.Define(stage, "/World/Hidden")
    hidden.MakeInvisible()
    proxy = UsdGeom.Cube.Define(stage, "/World/Proxy")
    proxy.CreatePurposeAttr("proxy")
    broken = UsdGeom.Mesh.Define(stage, "/World/Broken")
    broken.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0), (float("nan"), 0, 0)])
    broken.CreateFaceVertexCountsAttr([3, 3, 3])
    broken.CreateFaceVertexIndicesAttr([0, 1, 2, 0, 1, 7, 0, 1, 3])
    nothing = UsdGeom.Mesh.Define(stage, "/World/Nothing")
    nothing.CreateFaceVertexCountsAttr([3])
    scene = read(stage)
    assert [placed.path for placed in scene.objects] == ["/World/Good", "/World/Broken"]
    assert len(scene.shapes[1].pieces[0].mesh.indices) == 1
    assert scene.remarks == ["1 prims of type Points are not drawn"]


def test_a_component_is_one_object_with_its_lights_and_colliders(tmp_path, read):
    stage = foreign(tmp_path)
    lamp = UsdGeom.Xform.Define(stage, "/World/Lamp")
    Usd.ModelAPI(lamp).SetKind(Kind.Tokens.component)
    shade = UsdGeom.Cylinder.Define(stage, "/World/Lamp/Shade")
    UsdPhysics.CollisionAPI.Apply(shade.GetPrim())
    bulb = UsdLux.SphereLight.Define(stage, "/World/Lamp/Bulb")
    bulb.CreateIntensityAttr(3)
    bulb.CreateExposureAttr(2)
    UsdGeom.XformCommonAPI(lamp).SetTranslate(Gf.Vec3d(0, 4, 0))
    scene = read(stage)
    (placed,) = scene.objects
    (shape,) = scene.shapes
    assert placed.path == "/World/Lamp"
    assert [light.candela for light in shape.lights] == [pytest.approx(12 * np.pi * 0.5**2)]
    assert [collider.collider for collider in shape.colliders] == ["none"]


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("missing.usda", None, "No such file"),
        ("stage.obj", "o box", "not a stage"),
        ("broken.usda", "#usda 1.0\ndef {", "USD cannot read it"),
        ("broken.usdc", "PXR-USDC?", "USD cannot read it"),
        ("empty.usda", '#usda 1.0\ndef Xform "World" {}', "nothing in it can be drawn"),
    ],
)
def test_what_is_no_stage_is_refused_by_name(tmp_path, name, text, said):
    path = tmp_path / name
    if text is not None:
        path.write_text(text)
    with pytest.raises(StageError, match=said) as refused:
        read_scene(open_stage(path), path)
    assert str(path) in str(refused.value)


WORDS = Vt.TokenArray(["a", "b", "c"])


@pytest.mark.parametrize(
    "damaged",
    [
        "/Things/Cube.size",
        "/Things/Mesh.points",
        "/Things/Mesh.faceVertexCounts",
        "/Things/Mesh/Half.indices",
        "/Things/Light.inputs:width",
        "/Things/Light.inputs:color",
        "/Paint/Shader.inputs:roughness",
        "/Paint/Shader.inputs:diffuseColor",
    ],
)
def test_values_of_another_kind_than_they_should_be_are_named(tmp_path, damaged):
    stage = Usd.Stage.CreateNew(str(tmp_path / "values.usda"))
    UsdGeom.Cube.Define(stage, "/Things/Cube").CreateSizeAttr(1.0)
    mesh = UsdGeom.Mesh.Define(stage, "/Things/Mesh")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 0, 1), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([3, 3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 0, 2, 3])
    half = UsdGeom.Subset.Define(stage, "/Things/Mesh/Half")
    half.CreateIndicesAttr([0])
    light = UsdLux.RectLight.Define(stage, "/Things/Light")
    light.CreateWidthAttr(1.0)
    light.CreateColorAttr((1, 1, 1))
    material = UsdShade.Material.Define(stage, "/Paint")
    shader = UsdShade.Shader.Define(stage, "/Paint/Shader")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.5)
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set((1, 0, 0))
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    UsdShade.MaterialBindingAPI.Apply(half.GetPrim()).Bind(material)
    layer = stage.GetRootLayer()
    read_scene(stage, tmp_path / "values.usda")
    path = Sdf.Path(damaged)
    prim = layer.GetPrimAtPath(path.GetPrimPath())
    prim.RemoveProperty(layer.GetAttributeAtPath(path))
    Sdf.AttributeSpec(prim, path.name, Sdf.ValueTypeNames.TokenArray).default = WORDS
    with pytest.raises(StageError, match=f"{damaged} does not hold numbers"):
        read_scene(stage, tmp_path / "values.usda")
