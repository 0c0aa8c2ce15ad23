"""GLB of a stage: what pxr reads of the stage and a reader of JSON of the file agree; planted faults are found."""

import io
import json
import math
from collections import defaultdict

import numpy as np
import pytest
from PIL import Image
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSemantics, UsdShade
from scipy.spatial import KDTree
from scipy.spatial.transform import Rotation
from support.glb_reader import Glb, assert_like_the_stage, assert_stalls
from support.label_tables import labelled_objects
from support.map_faults import Fault, planted
from support.places import MILLIMETRE, assert_same_places
from support.sample_files import SMALL_SAMPLES, USUAL_SAMPLES
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.common.errors import StageError
from garage2usd.maps.glb import write_glb
from garage2usd.maps.glb_meshes import are_rigid, by_facets, rigid_inverses
from garage2usd.objects import PIECE_LABELS
from garage2usd.scenes.meshes import Triangles


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("glb") / "small.usdz")


def judge(write, built, folder):
    """Write a GLB of a build and compare it with the stage."""
    path = folder / "garage.glb"
    write(Usd.Stage.Open(str(built.stage)), path)
    labels = labelled_objects(built.stage.with_name(f"{built.stage.stem}_labels.json"))
    assert_like_the_stage(path.read_bytes(), built.stage, labels)
    assert_stalls(path.read_bytes(), json.loads(built.report.read_text()), labels)


def test_it_is_the_stage(made, tmp_path):
    judge(write_glb, made, tmp_path)


@pytest.mark.parametrize("sample", soak_but(USUAL_SAMPLES[:1], SMALL_SAMPLES), ids=lambda path: path.stem)
def test_it_is_the_stage_of_a_sample_and_little_larger(sample, builds, tmp_path):
    built = builds(sample, "usdz")
    judge(write_glb, built, tmp_path)
    assert (tmp_path / "garage.glb").stat().st_size <= 1.15 * built.stage.stat().st_size


def strip(width_m, tilt_deg):
    """Two triangles whose normals tilt from their own, as `reading.meshes` gives them."""
    tilt = math.radians(tilt_deg)
    positions = np.array([(0, 0, 0), (1, 0, 0), (1, width_m, 0), (0, width_m, 0)], dtype=np.float32)
    normals = np.tile(np.array([0, math.sin(tilt), math.cos(tilt)], dtype=np.float32), (4, 1))
    indices = np.array([(0, 1, 2), (0, 2, 3)], dtype=np.uint32)
    return Triangles(positions, normals, np.zeros((4, 0), np.float32), indices, np.zeros(2, np.int32), False, None)


@pytest.mark.parametrize(
    ("width_m", "tilt_deg", "is_faceted"),
    [
        (1.0, 0.0, True),
        (1.0, 0.2, False),
        (0.028, 1.9, True),
        (0.028, 2.2, False),
        (0.002, 9.0, True),
        (0.002, 11, False),
    ],
)
def test_narrow_matte_triangles_are_smooth_where_that_is_more_than_a_millimetre(width_m, tilt_deg, is_faceted):
    mesh = strip(width_m, tilt_deg)
    assert [found for found, _ in by_facets(mesh, is_matte=True)] == [is_faceted]
    assert [found for found, _ in by_facets(mesh)] == [tilt_deg == 0.0]


def test_faceted_and_smooth_triangles_of_a_material_share_their_places(made, tmp_path):
    write_glb(Usd.Stage.Open(str(made.stage)), tmp_path / "garage.glb")
    glb = Glb((tmp_path / "garage.glb").read_bytes())
    places = {number: (own["bufferView"], own.get("byteOffset", 0)) for number, own in enumerate(glb.json["accessors"])}
    shared = 0
    for mesh in glb.json["meshes"]:
        of_material = defaultdict(set)
        for primitive in mesh["primitives"]:
            of_material[primitive["material"]].add(places[primitive["attributes"]["POSITION"]])
        shared += sum(len(mesh["primitives"]) > len(of_material) and len(own) == 1 for own in of_material.values())
        assert all(len(own) == 1 for own in of_material.values())
    assert shared > 20


def test_its_bytes_are_always_the_same(made, tmp_path):
    for name in ("one", "other"):
        write_glb(Usd.Stage.Open(str(made.stage)), tmp_path / f"{name}.glb")
    assert (tmp_path / "one.glb").read_bytes() == (tmp_path / "other.glb").read_bytes()


@pytest.mark.parametrize("form", ["nested", "flat"])
def test_every_form_gives_the_same_garage(form, made, tmp_path):
    other = build(GarageConfig(**SETTINGS | {"stage": {"form": form}}), tmp_path / "other.usdc")
    write_glb(Usd.Stage.Open(str(other.stage)), tmp_path / "other.glb")
    write_glb(Usd.Stage.Open(str(made.stage)), tmp_path / "made.glb")
    glbs = [Glb((tmp_path / f"{name}.glb").read_bytes()) for name in ("other", "made")]
    objects = labelled_objects(tmp_path / "other_labels.json")
    said = {node["name"]: node["extras"] for node in glbs[0].nodes if "mesh" in node}
    assert {name: (own["class"], own["id"]) for name, own in said.items()} == {
        entry["path"]: (entry["class"], entry["id"]) for entry in objects
    }
    for label in (
        "column",
        "parking_stall",
        "stall_number",
        *(["car"] if form == "flat" else []),
    ):  # nested cars repeat
        places = [
            [glb.matrix(number)[:3, 3] for number, node in enumerate(glb.nodes) if _class(node) == label]
            for glb in glbs
        ]
        assert_same_places(*places)


def _class(node):
    return node.get("extras", {}).get("class")


def test_what_is_painted_on_a_floor_is_a_node_below_it(made, tmp_path):
    write_glb(Usd.Stage.Open(str(made.stage)), tmp_path / "garage.glb")
    glb = Glb((tmp_path / "garage.glb").read_bytes())
    above = {}
    for number, node in enumerate(glb.nodes):
        if _class(node) in PIECE_LABELS:
            holder = glb.nodes[glb.parents[number]]
            assert node["name"].rpartition("/")[0] == holder["name"]
            above.setdefault(_class(node), set()).add(_class(holder))
        else:
            assert number not in glb.parents or "mesh" not in node
    assert above["stall_line"] == {"parking_stall", "floor"}
    assert above["lane_line"] == above["lane_arrow"] == {"floor"}


FAULTS = (
    Fault("pieces of an object on their own", "glb", "if inverse_above is None else", "if True else"),
    Fault("mirrored z", "glb_meshes", "np.round(matrices[:, 3, :3],", "np.round(matrices[:, 3, :3] * (1, 1, -1),"),
    Fault("turned the other way", "glb_meshes", "from_matrix(axes.transpose(0, 2, 1))", "from_matrix(axes)"),
    Fault("a place off by 2 mm", "glb_meshes", "_PLACE_DIGITS, _DIGITS = 4, 6", "_PLACE_DIGITS, _DIGITS = 2, 6"),
    Fault(
        "place of another object",
        "glb",
        "place = placed.matrix if",
        "place = drawn[7][0].matrix if",
    ),
    Fault("label off by one", "glb", 'else {"id": number}', 'else {"id": number + 1}'),
    Fault(
        "first mesh for all",
        "glb_file",
        'tuple((own["material"], own["indices"], *own["attributes"].items()) for own in primitives)',
        "len(primitives)",
    ),
    Fault("texture upside down", "glb_meshes", "(1, -1) + (0, 1)", "(1, 1) + (0, 0)"),
    Fault("bump as dent", "glb_meshes", "np.where(side < 0, -1.0, 1.0)", "np.where(side < 0, 1.0, -1.0)"),
    Fault("inside out", "glb_meshes", "inverse[mesh.indices]", "inverse[mesh.indices[:, ::-1]]"),
    Fault("all faceted", "glb_meshes", "_FACET_RAD, _MOST_RAD = 1.4e-3,", "_FACET_RAD, _MOST_RAD = 3.0,"),
    Fault("wide triangles faceted", "glb_meshes", "_NARROW_M, _OFF_M = 0.03, 1e-3", "_NARROW_M, _OFF_M = 0.5, 0.1"),
    Fault("vertices of another triangle", "glb_meshes", "= len(here) + place", "= place"),
    Fault("vertices in another order", "glb_meshes", "faceted.positions[own]", "faceted.positions[own[::-1]]"),
    Fault("all seen from both sides", "glb_file", "double_sided=own.double_sided", "double_sided=True"),
    Fault(
        "an image for each texture",
        "glb_materials",
        "_number(self.images, self._pictures.composed(bands, is_srgb=is_srgb))",
        "(self.images.append(self._pictures.composed(bands, is_srgb=is_srgb)), len(self.images) - 1)[1]",
    ),
    Fault("no car in any stall", "facts", "self._car_of.setdefault(home, car)", "pass"),
    Fault("stalls the wrong way round", "glb", "(mouth_x, 0, mouth_z, 0)", "(-mouth_x, 0, -mouth_z, 0)"),
)


@pytest.mark.parametrize("fault", soak_but(3, FAULTS), ids=lambda fault: fault.name)
def test_a_planted_fault_is_found(fault, made, tmp_path):
    with planted(fault, "glb") as module, pytest.raises(AssertionError):
        judge(module.write_glb, made, tmp_path)


def in_memory():
    """A stage in centimetres with Z up."""
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 0.01)
    return stage


def labelled(prim, label):
    UsdSemantics.LabelsAPI.Apply(prim.GetPrim(), "class").CreateLabelsAttr([label])
    return prim


def written(stage, folder):
    write_glb(stage, folder / "other.glb")
    return Glb((folder / "other.glb").read_bytes())


def bound_material(stage, prim, **values):
    """A UsdPreviewSurface with these inputs; a pair of a file and an output is a texture."""
    material = UsdShade.Material.Define(stage, "/Looks/Own")
    shader = UsdShade.Shader.Define(stage, "/Looks/Own/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    for name, value in values.items():
        kind = Sdf.ValueTypeNames.Color3f if name in {"diffuseColor", "emissiveColor"} else Sdf.ValueTypeNames.Float
        given = shader.CreateInput(name, kind)
        if isinstance(value, tuple) and isinstance(value[0], str):
            reader = UsdShade.Shader.Define(stage, f"/Looks/Own/{name}")
            reader.CreateIdAttr("UsdUVTexture")
            reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(value[0])
            given.ConnectToSource(reader.ConnectableAPI(), value[1])
        else:
            given.Set(value)
    UsdShade.MaterialBindingAPI.Apply(prim.GetPrim()).Bind(material)


def test_units_axes_and_places_that_no_node_can_say(tmp_path):
    stage = in_memory()
    outer = UsdGeom.Xform.Define(stage, "/Lot")
    outer.AddScaleOp().Set((3, 1, 1))
    outer.AddRotateZOp().Set(45)
    labelled(UsdGeom.Cube.Define(stage, "/Lot/Sheared"), "static").AddTransformOp().Set(
        Gf.Matrix4d(1).SetRotate(Gf.Rotation((0, 0, 1), 20))
    )
    plain = labelled(UsdGeom.Cube.Define(stage, "/Plain"), "column")
    plain.AddTranslateOp().Set((100, 200, 300))
    plain.AddScaleOp().Set((-1, 2, 1))
    glb = written(stage, tmp_path)
    for number, node in enumerate(glb.nodes):
        prim = stage.GetPrimAtPath(node["name"])
        world = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim))
        cube = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
        x, y, z = ((cube @ world[:3, :3] + world[3, :3]) / 100).T
        expected = np.column_stack([x, z, -y])
        found = np.unique(np.round(glb.points(number), 6), axis=0)
        assert np.allclose(found, expected[np.lexsort(np.round(expected, 6).T[::-1])], atol=1e-6)
        triangles = glb.points(number)[glb.corners(number)]
        mirrored = -1 if "scale" in node and np.prod(node["scale"]) < 0 else 1
        outwards = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) * mirrored
        assert (((triangles.mean(axis=1) - found.mean(axis=0)) * outwards).sum(axis=1) > 0).all()
    classes = {node["name"]: node["extras"]["class"] for node in glb.nodes}
    assert classes == {"/Lot/Sheared": "static", "/Plain": "column"}


def test_inverses_of_scales_turns_and_moves_are_those_of_numpy():
    draw = np.random.default_rng(1)
    matrices = np.tile(np.eye(4), (100, 1, 1))
    turns = Rotation.random(100, random_state=1).as_matrix()
    matrices[:, :3, :3] = draw.uniform(0.2, 3.0, (100, 3, 1)) * turns
    matrices[::7, 0, :3] *= -1.0
    matrices[:, 3, :3] = draw.uniform(-50.0, 50.0, (100, 3))
    assert are_rigid(matrices).all()
    np.testing.assert_allclose(rigid_inverses(matrices), np.linalg.inv(matrices), atol=1e-9)


def test_points_of_instancers_and_subsets(tmp_path):
    stage = in_memory()
    instancer = labelled(UsdGeom.PointInstancer.Define(stage, "/Cones"), "cone")
    mesh = UsdGeom.Mesh.Define(stage, "/Cones/Sheet")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([3, 3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 0, 2, 3])
    mesh.CreateSubdivisionSchemeAttr("none")
    subset = UsdGeom.Subset.CreateGeomSubset(mesh, "Half", "face", [1], "materialBind")
    bound_material(stage, subset, diffuseColor=(1.0, 0.0, 0.0))
    instancer.CreatePrototypesRel().AddTarget(mesh.GetPath())
    instancer.CreateProtoIndicesAttr([0, 0])
    instancer.CreatePositionsAttr([(0, 0, 0), (500, 0, 0)])
    glb = written(stage, tmp_path)
    assert [node["name"] for node in glb.nodes] == ["/Cones[0]", "/Cones[1]"]
    assert [node["mesh"] for node in glb.nodes] == [0, 0]
    assert glb.nodes[1]["translation"] == [5, 0, 0]
    colours = [
        glb.json["materials"][own["material"]]["pbrMetallicRoughness"]["baseColorFactor"] for own in glb.primitives(0)
    ]
    assert [1.0, 0.0, 0.0, 1.0] in colours
    assert len(colours) == 2


def test_materials_of_other_programs(tmp_path):
    Image.new("RGB", (4, 4), (10, 20, 30)).save(tmp_path / "rough.png")
    Image.new("RGB", (2, 2), (40, 50, 60)).save(tmp_path / "metal.bmp")
    stage = in_memory()
    cube = UsdGeom.Cube.Define(stage, "/Cube")
    bound_material(
        stage,
        cube,
        diffuseColor=(str(tmp_path / "missing.png"), "rgb"),
        emissiveColor=(4.0, 2.0, 0.0),
        roughness=(str(tmp_path / "rough.png"), "r"),
        metallic=(str(tmp_path / "metal.bmp"), "b"),
        occlusion=(str(tmp_path / "metal.bmp"), "g"),
        opacity=0.5,
        clearcoat=0.25,
    )
    glb = written(stage, tmp_path)
    (material,) = glb.json["materials"]
    reflection = material["pbrMetallicRoughness"]
    assert "baseColorTexture" not in reflection
    assert reflection["baseColorFactor"] == [0.0, 0.0, 0.0, 0.5]  # UsdUVTexture's own fallback is black
    assert (material["alphaMode"], material["emissiveFactor"]) == ("BLEND", [1.0, 0.5, 0.0])
    assert material["extensions"] == {
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.25, "clearcoatRoughnessFactor": 0.01},
        "KHR_materials_emissive_strength": {"emissiveStrength": 4.0},
    }
    assert glb.json["extensionsUsed"] == sorted(material["extensions"])

    def pixel(texture):
        image = glb.json["images"][glb.json["textures"][texture["index"]]["source"]]
        assert image["mimeType"] == "image/png"
        return Image.open(io.BytesIO(glb.view(image["bufferView"]))).getpixel((0, 0))

    assert pixel(reflection["metallicRoughnessTexture"])[1:] == (10, 60)
    assert pixel(material["occlusionTexture"])[0] == 50


def test_many_vertices_are_numbered_by_four_bytes(tmp_path):
    stage = in_memory()
    mesh = UsdGeom.Mesh.Define(stage, "/Cloud")
    count = 22_000
    places = np.random.default_rng(1).uniform(0, 1000, (3 * count, 3)).astype(np.float32)
    mesh.CreatePointsAttr(places)
    mesh.CreateFaceVertexCountsAttr([3] * count)
    mesh.CreateFaceVertexIndicesAttr(list(range(3 * count)))
    glb = written(stage, tmp_path)
    assert {glb.json["accessors"][own["indices"]]["componentType"] for own in glb.primitives(0)} == {5125}
    x, y, z = (places / 100).T
    assert KDTree(np.column_stack([x, z, -y])).query(glb.points(0))[0].max() < MILLIMETRE


def test_a_stage_without_anything_to_draw_is_refused(tmp_path):
    stage = in_memory()
    UsdGeom.Xform.Define(stage, "/Nothing")
    with pytest.raises(StageError, match="nothing in it can be drawn"):
        write_glb(stage, tmp_path / "nothing.glb")
    assert not (tmp_path / "nothing.glb").exists()
