"""Models of glTF as other programs write them: each number where the specification puts it, each loss named."""

import io

import DracoPy
import numpy as np
import pytest
from PIL import Image
from support.gltf_models import SQUARE, SQUARE_ST, Gltf

from garage2usd.common.errors import ConfigError
from garage2usd.scenes.foreign_models import model_digest, read_model

QUADRANTS = np.array([[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]])
"""Red and green above, blue and white below."""


def read(gltf, tmp_path, suffix="glb"):
    return read_model(gltf.write(tmp_path / f"c.{suffix}"), field="models")


def only(model):
    (part,) = model.parts
    return part


def st_at(part):
    """Texture coordinates by the corner (x, y)."""
    corners = zip(np.round(part.triangles_m[..., :2].reshape(-1, 2), 4).tolist(), part.st.reshape(-1, 2), strict=True)
    return {tuple(corner): st for corner, st in corners}


def picture(found):
    return np.asarray(Image.open(io.BytesIO(found.data)))


def textured(info=None, **sampler):
    gltf = Gltf()
    reference = gltf.texture(QUADRANTS, sampler=sampler or None) | (info or {})
    material = gltf.material(pbrMetallicRoughness={"baseColorTexture": reference})
    sets = {f"TEXCOORD_{number}": gltf.numbers(SQUARE_ST * (number + 1)) for number in range(2)}
    gltf.primitive(material=material, attributes=sets)
    return gltf


@pytest.mark.parametrize("suffix", ["glb", "gltf"])
def test_coordinates_have_v_upwards(tmp_path, suffix):
    part = only(read(textured(), tmp_path, suffix))
    assert {corner: tuple(st) for corner, st in st_at(part).items()} == {
        (x, y): (x, y) for x in (0.0, 1.0) for y in (0.0, 1.0)
    }
    assert picture(part.surface.picture).tolist() == QUADRANTS.tolist()
    assert part.surface.colour_rgb == (1.0, 1.0, 1.0)


@pytest.mark.parametrize("turn_rad", [0.0, 0.3])
def test_texture_transforms_move_coordinates(tmp_path, turn_rad):
    given = {"offset": [0.5, 0.25], "rotation": turn_rad, "scale": [0.5, 0.75], "texCoord": 1}
    part = only(read(textured({"extensions": {"KHR_texture_transform": given}}), tmp_path))
    cos, sin = np.cos(turn_rad), np.sin(turn_rad)
    for (x, y), st in st_at(part).items():
        u, v = 2 * x * 0.5, 2 * (1 - y) * 0.75  # of the second set, which is twice as large
        assert st == pytest.approx([cos * u + sin * v + 0.5, 1 - (-sin * u + cos * v + 0.25)], abs=1e-6)


def test_wrap_modes_of_samplers_are_kept(tmp_path):
    model = read(textured(wrapS=33071, wrapT=33648, magFilter=9728), tmp_path)
    assert only(model).surface.wraps == ("clamp", "mirror")
    assert model.remarks == ("samplers that take the nearest pixel are read as smooth ones (1): paint",)


def test_dark_colours_are_not_rounded_to_bytes(tmp_path):
    gltf = Gltf()
    colour = [0.0015, 0.006, 0.8, 1.0]
    gltf.primitive(material=gltf.material(pbrMetallicRoughness={"baseColorFactor": colour, "metallicFactor": 0.25}))
    surface = only(read(gltf, tmp_path)).surface
    assert (*surface.colour_rgb, surface.metallic, surface.roughness) == (0.0015, 0.006, 0.8, 0.25, 1.0)


def test_finish_and_normals_are_packed(tmp_path):
    gltf = Gltf()
    finish = gltf.texture(np.full((2, 2, 3), (9, 200, 100)))
    hidden = gltf.texture(np.full((4, 4, 3), (180, 1, 1)))
    material = gltf.material(
        pbrMetallicRoughness={"metallicRoughnessTexture": finish, "roughnessFactor": 0.5},
        occlusionTexture=hidden | {"strength": 0.5},
        normalTexture=gltf.texture(np.full((2, 2, 3), (148, 108, 250))) | {"scale": 0.5},
    )
    gltf.primitive(material=material, attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)})
    surface = only(read(gltf, tmp_path)).surface
    assert picture(surface.packed)[0, 0].tolist() == pytest.approx([218, 100, 100], abs=1)
    assert picture(surface.normals)[0, 0].tolist() == pytest.approx([138, 118, 250], abs=1)


def test_textures_that_lie_otherwise_are_named(tmp_path):
    gltf = textured()
    hidden = gltf.texture(np.full((2, 2, 3), 51)) | {"texCoord": 1}
    gltf.json["materials"][0] |= {"occlusionTexture": hidden, "normalTexture": hidden}
    model = read(gltf, tmp_path)
    assert [line.split(" (")[0] for line in model.remarks] == [
        "textures of occlusion that lie unlike the colour's are carried as their mean",
        "normal maps that lie unlike the colour's are left out",
    ]


@pytest.mark.parametrize(
    ("mode", "alphas", "threshold"), [("BLEND", [64, 128], None), ("MASK", [0, 255], 0.4), ("OPAQUE", None, None)]
)
def test_alpha_is_opacity_by_its_mode(tmp_path, mode, alphas, threshold):
    gltf = Gltf()
    pixels = np.array([[(255, 0, 0, 64), (255, 0, 0, 128)]])
    material = gltf.material(
        pbrMetallicRoughness={"baseColorTexture": gltf.texture(pixels)},
        alphaMode=mode,
        **({"alphaCutoff": threshold} if threshold else {}),
    )
    gltf.primitive(material=material, attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)})
    surface = only(read(gltf, tmp_path)).surface
    assert (surface.has_alpha, surface.opacity) == (alphas is not None, 1.0)
    if alphas:
        assert picture(surface.picture)[0, :, 3].tolist() == alphas


def test_glass_that_transmits_is_seen_through(tmp_path):
    gltf = Gltf()
    tinted = {"baseColorFactor": [0.5, 0.5, 0.5, 1.0]}
    glass = gltf.material(
        "glass", pbrMetallicRoughness=tinted, extensions={"KHR_materials_transmission": {"transmissionFactor": 0.8}}
    )
    gltf.primitive(material=glass)
    model = read(gltf, tmp_path)
    assert only(model).surface.opacity == pytest.approx(0.6)
    assert model.remarks == ("KHR_materials_transmission is carried as opacity (1): glass",)


@pytest.mark.parametrize(
    ("diffuse", "specular", "colour", "metallic"),
    [((0.2, 0.4, 0.6), (0.04, 0.04, 0.04), (0.2, 0.4, 0.6), 0.0), ((0, 0, 0), (0.9, 0.6, 0.3), (0.9, 0.6, 0.3), 1.0)],
)
@pytest.mark.parametrize("is_picture", [False, True])
def test_glossiness_becomes_metallic_and_roughness(tmp_path, diffuse, specular, colour, metallic, is_picture):
    gltf = Gltf()
    given = {"diffuseFactor": [*diffuse, 1.0], "specularFactor": specular, "glossinessFactor": 0.75}
    if is_picture:
        given["diffuseTexture"] = gltf.texture(np.full((2, 2, 3), 255))
    gltf.primitive(
        material=gltf.material(extensions={"KHR_materials_pbrSpecularGlossiness": given}),
        attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)},
    )
    surface = only(read(gltf, tmp_path)).surface
    if not is_picture:
        assert (*surface.colour_rgb, surface.metallic) == pytest.approx((*colour, metallic), abs=0.01)
        assert surface.roughness == 0.25
        return
    shown = (picture(surface.picture)[0, 0] / 255) ** 2.2
    assert shown == pytest.approx(colour, abs=0.02)
    assert picture(surface.packed)[0, 0, 1:].tolist() == pytest.approx([64, 255 * metallic], abs=4)


def test_colours_by_point_divide_a_mesh(tmp_path):
    gltf = Gltf()
    colours = np.array([(255, 0, 0), (255, 0, 0), (255, 0, 0), (0, 0, 255), (0, 0, 255), (0, 0, 255)], np.uint8)
    points = SQUARE[[0, 1, 2, 0, 2, 3]]
    gltf.primitive(
        points,
        None,
        material=gltf.material(pbrMetallicRoughness={"baseColorFactor": [0.5, 1, 0.25, 1]}),
        attributes={"COLOR_0": gltf.numbers(colours, normalized=True)},
    )
    model = read(gltf, tmp_path)
    assert {part.surface.colour_rgb: len(part.st) for part in model.parts} == {(0.5, 0, 0): 1, (0, 0, 0.25): 1}
    assert model.remarks == ()


def test_colours_that_vary_over_faces_are_named(tmp_path):
    gltf = Gltf()
    gltf.primitive(attributes={"COLOR_0": gltf.numbers(np.eye(4, 3, dtype=np.float32))})
    (line,) = read(gltf, tmp_path).remarks
    assert line == "colours by point are carried as 2 colours by face (1): /node/square"


def test_numbers_may_be_quantized_interleaved_and_sparse(tmp_path):
    gltf = Gltf()
    whole = np.zeros(4, [("place", "<i2", 3), ("pad", "<i2"), ("st", "<u2", 2)])
    whole["place"], whole["st"] = SQUARE * 32767, SQUARE_ST * 65535
    view = gltf.view(whole.tobytes(), byteStride=whole.itemsize)
    for offset, kind, form in ((0, 5122, "VEC3"), (8, 5123, "VEC2")):
        gltf.json["accessors"].append(
            {"bufferView": view, "byteOffset": offset, "componentType": kind, "count": 4, "type": form}
            | {"normalized": True}
        )
    gltf.json["accessors"][0]["sparse"] = {
        "count": 1,
        "indices": {"bufferView": gltf.view(np.array([2], np.uint8).tobytes()), "componentType": 5121},
        "values": {"bufferView": gltf.view(np.array([32767, 32767, 32767], "<i2").tobytes())},
    }
    gltf.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    material = gltf.material(pbrMetallicRoughness={"baseColorTexture": gltf.texture(QUADRANTS)})
    gltf.json["meshes"][0]["primitives"].append(
        {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": material, "mode": 6}
    )
    part = only(read(gltf, tmp_path))
    assert np.unique(part.triangles_m.reshape(-1, 3), axis=0).tolist() == [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 1]]
    assert all(st == pytest.approx(corner, abs=1e-4) for corner, st in st_at(part).items())


@pytest.mark.parametrize(("mode", "row"), [(4, [0, 1, 2, 0, 2, 3]), (5, [0, 1, 3, 2]), (6, [0, 1, 2, 3])])
def test_modes_of_triangles_wind_alike(tmp_path, mode, row):
    gltf = Gltf()
    gltf.primitive(indices=row, mode=mode)
    part = only(read(gltf, tmp_path))
    across = np.cross(part.triangles_m[:, 1] - part.triangles_m[:, 0], part.triangles_m[:, 2] - part.triangles_m[:, 0])
    assert across.tolist() == [[0, 0, 1], [0, 0, 1]]


def test_mirrored_nodes_and_copies_are_seen_from_outside(tmp_path):
    gltf = Gltf()
    gltf.primitive(attributes={"NORMAL": gltf.numbers(np.tile([[0, 0, 1]], (4, 1)).astype(np.float32))})
    shifts = gltf.numbers(np.array([(0, 0, 0), (0, 0, 5)], np.float32))
    gltf.json["nodes"][0] |= {
        "scale": [-1, 1, 1],
        "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": shifts}}},
    }
    model = read(gltf, tmp_path)
    assert [part.triangles_m[..., 2].mean() for part in model.parts] == [0, 5]
    for part in model.parts:
        across = np.cross(*(part.triangles_m[0, side] - part.triangles_m[0, 0] for side in (1, 2)))
        assert across @ part.normals[0, 0] == pytest.approx(1)
        assert part.triangles_m[..., 0].min() == -1


def test_skins_are_posed_by_their_joints_and_morphs_by_their_weights(tmp_path):
    gltf = Gltf()
    first, second = (np.tile(np.array(row, np.uint8), (4, 1)) for row in ((0, 1, 0, 0), (255, 0, 0, 0)))
    second[2:] = (0, 255, 0, 0)
    gltf.primitive(
        attributes={"JOINTS_0": gltf.numbers(first), "WEIGHTS_0": gltf.numbers(second, normalized=True)},
        targets=[{"POSITION": gltf.numbers(np.tile([[0, 0, 4]], (4, 1)).astype(np.float32))}],
    )
    gltf.json["meshes"][0]["weights"] = [0.25]
    joints = [gltf.node(translation=[10, 0, 0]), gltf.node(translation=[0, 20, 0])]
    binds = np.tile(np.eye(4, dtype=np.float32), (2, 1, 1))
    binds[:, 3, 0] = -1  # of points in the skeleton's space to the joints'
    gltf.json["skins"] = [{"joints": joints, "inverseBindMatrices": gltf.numbers(binds)}]
    gltf.json["nodes"][0] |= {"skin": 0, "translation": [99, 99, 99]}
    gltf.json["scenes"][0]["nodes"] += joints
    points = np.unique(only(read(gltf, tmp_path)).triangles_m.reshape(-1, 3), axis=0)
    assert points.tolist() == [[-1, 21, 1], [0, 21, 1], [9, 0, 1], [10, 0, 1]]


def test_a_mesh_may_be_a_skin_at_one_node_and_none_at_another(tmp_path):
    gltf = Gltf()
    joints, weights = (np.tile(np.array(row, np.uint8), (4, 1)) for row in ((0, 0, 0, 0), (255, 0, 0, 0)))
    gltf.primitive(attributes={"JOINTS_0": gltf.numbers(joints), "WEIGHTS_0": gltf.numbers(weights, normalized=True)})
    joint = gltf.node(translation=[10, 0, 0])
    gltf.json["skins"] = [{"joints": [joint]}]
    gltf.json["scenes"][0]["nodes"] += [joint, gltf.node(mesh=0, skin=0)]
    plain, posed = read(gltf, tmp_path).parts
    assert (plain.triangles_m[..., 0].max(), posed.triangles_m[..., 0].max()) == (1, 11)


def test_draco_is_decompressed(tmp_path):
    gltf = Gltf()
    made = gltf.primitive(attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)})
    data = DracoPy.encode(
        SQUARE, np.array([[0, 1, 2], [0, 2, 3]], np.uint32), tex_coord=SQUARE_ST.astype(float), preserve_order=True
    )
    decoded = DracoPy.decode(data)
    ids = {
        name: decoded.get_attribute_by_type(kind)["unique_id"]
        for name, kind in (
            ("POSITION", DracoPy.AttributeType.POSITION),
            ("TEXCOORD_0", DracoPy.AttributeType.TEX_COORD),
        )
    }
    made["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": gltf.view(data), "attributes": ids}}
    made["material"] = gltf.material(pbrMetallicRoughness={"baseColorTexture": gltf.texture(QUADRANTS)})
    gltf.json["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    for accessor in gltf.json["accessors"]:
        del accessor["bufferView"]
    part = only(read(gltf, tmp_path))
    assert len(part.st) == 2
    assert all(st == pytest.approx(corner, abs=0.01) for corner, st in st_at(part).items())
    made["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = gltf.view(b"no Draco")
    with pytest.raises(ConfigError, match=r"c\.glb, compressed by KHR_draco_mesh_compression"):
        read(gltf, tmp_path)


def test_pictures_of_webp_are_read_and_those_of_basis_universal_named(tmp_path):
    gltf = Gltf()
    webp = gltf.texture(QUADRANTS, form="WEBP", extension="EXT_texture_webp")
    basis = gltf.texture(QUADRANTS, extension="KHR_texture_basisu")
    for name, info in (("webp", webp), ("basis", basis)):
        gltf.primitive(
            material=gltf.material(name, pbrMetallicRoughness={"baseColorTexture": info}),
            attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)},
        )
    model = read(gltf, tmp_path)
    surfaces = {part.surface.name: part.surface for part in model.parts}
    assert np.abs(picture(surfaces["webp"].picture)[..., :3].astype(int) - QUADRANTS).max() <= 1
    assert surfaces["basis"].picture is None
    assert "textures of KHR_texture_basisu are left out (1): basis" in model.remarks


def test_large_opaque_pictures_keep_colours_below_a_clear_alpha(tmp_path):
    gltf = Gltf()
    pixels = np.zeros((1100, 8, 4), np.uint8)
    pixels[..., 0] = 200
    gltf.primitive(
        material=gltf.material(pbrMetallicRoughness={"baseColorTexture": gltf.texture(pixels)}),
        attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)},
    )
    shown = picture(only(read(gltf, tmp_path)).surface.picture)
    assert shown.shape[0] == 1024
    assert shown[5, 0, :3].tolist() == [200, 0, 0]


def test_glossy_materials_that_share_a_picture_differ_by_their_factors(tmp_path):
    gltf = Gltf()
    shared = gltf.texture(np.full((2, 2, 3), 128))
    for name, specular in (("cloth", 0.04), ("steel", 0.9)):
        given = {"diffuseTexture": shared, "specularFactor": [specular] * 3}
        gltf.primitive(
            material=gltf.material(name, extensions={"KHR_materials_pbrSpecularGlossiness": given}),
            attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)},
        )
    cloth, steel = (picture(part.surface.packed)[0, 0, 2] for part in read(gltf, tmp_path).parts)
    assert cloth < 30
    assert steel > 200


def test_pictures_may_have_the_names_of_others_numbers(tmp_path):
    gltf = Gltf()
    for number, colour in enumerate([(200, 0, 0), (0, 200, 0)]):
        info = gltf.texture(np.full((2, 2, 3), colour))
        gltf.primitive(
            material=gltf.material(str(number), pbrMetallicRoughness={"baseColorTexture": info}),
            attributes={"TEXCOORD_0": gltf.numbers(SQUARE_ST)},
        )
    gltf.json["images"][0]["name"] = "1"
    red, green = (picture(part.surface.picture)[0, 0].tolist() for part in read(gltf, tmp_path).parts)
    assert (red, green) == ([200, 0, 0], [0, 200, 0])


def test_opacities_by_point_are_named_where_they_count(tmp_path):
    gltf = Gltf()
    colours = np.tile(np.array([1, 1, 1, 0.3], np.float32), (4, 1))
    gltf.primitive(material=gltf.material(alphaMode="BLEND"), attributes={"COLOR_0": gltf.numbers(colours)})
    assert read(gltf, tmp_path).remarks == ("opacities by point are not used (1): /node/square",)


@pytest.mark.parametrize("wrong", [float("nan"), float("inf"), -3.0, 7.0])
def test_factors_are_shares(tmp_path, wrong):
    gltf = Gltf()
    reflection = {"roughnessFactor": wrong, "metallicFactor": wrong, "baseColorFactor": [wrong, 0.5, 0.5, 1]}
    gltf.primitive(material=gltf.material(pbrMetallicRoughness=reflection))
    if not np.isfinite(wrong):
        with pytest.raises(ConfigError, match="a GLB whose first chunk is a JSON object"):
            read(gltf, tmp_path)
        return
    surface = only(read(gltf, tmp_path)).surface
    assert {surface.roughness, surface.metallic, surface.colour_rgb[0]} == {float(wrong > 0)}


@pytest.mark.parametrize(
    ("properties", "alpha"),
    [
        ({"alphaCutoff": 0}, 0.3),
        ({"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1.0}}}, 1.0),
    ],
)
def test_what_is_cut_out_stays(tmp_path, properties, alpha):
    gltf = Gltf()
    base = {"baseColorFactor": [1, 1, 1, alpha]}
    gltf.primitive(material=gltf.material(pbrMetallicRoughness=base, alphaMode="MASK", **properties))
    assert only(read(gltf, tmp_path)).surface.opacity == 1.0


HOSTILE = {
    "extensions that are no list": {"extensionsRequired": 5},
    "children that are no list": {"nodes": [{"mesh": 0, "children": None}]},
    "an address that is none": {"images": [{"uri": "//[x"}]},
}


@pytest.mark.parametrize("about", HOSTILE)
def test_hostile_tables_end_in_a_line(tmp_path, about):
    gltf = Gltf()
    gltf.primitive()
    gltf.json |= HOSTILE[about]
    path = gltf.write(tmp_path / "c.glb")
    for reader in (model_digest, read_model):
        with pytest.raises(ConfigError, match=r"c\.glb") as error:
            reader(path, field="models")
        assert "\n" not in str(error.value)


def test_a_root_that_is_named_several_times_is_drawn_once(tmp_path):
    gltf = Gltf()
    gltf.primitive()
    gltf.json["scenes"][0]["nodes"] = [0, 0, 0]
    assert len(only(read(gltf, tmp_path)).st) == 2
    above = gltf.node(children=[0])  # a scene may name a node below one that it does not name
    assert len(only(read(gltf, tmp_path)).st) == 2
    gltf.json["scenes"][0]["nodes"] = [0, above]
    assert len(only(read(gltf, tmp_path)).st) == 2


def test_copies_without_end_are_refused(tmp_path):
    gltf = Gltf()
    gltf.primitive()
    gltf.json["accessors"].append({"componentType": 5126, "count": 10**7, "type": "VEC3"})
    copies = {"attributes": {"TRANSLATION": len(gltf.json["accessors"]) - 1}}
    gltf.json["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": copies}
    with pytest.raises(ConfigError, match="with 10000000 copies of a mesh"):
        read(gltf, tmp_path)


def test_files_that_no_reading_needs_may_be_missing(tmp_path):
    gltf = textured()
    gltf.json["images"].append({"uri": "glow.png"})
    gltf.json["textures"].append({"source": 1})
    gltf.json["materials"][0]["emissiveTexture"] = {"index": 1}
    assert only(read(gltf, tmp_path)).surface.picture
    gltf.json["materials"][0]["normalTexture"] = {"index": 1}
    with pytest.raises(ConfigError, match=r"c\.glb without glow\.png"):
        read(gltf, tmp_path)


def test_what_is_not_used_is_named_once_for_each_kind(tmp_path):
    gltf = Gltf()
    for name in ("a", "b"):
        sheen = {"KHR_materials_sheen": {}, "KHR_materials_ior": {"ior": 1.3}}
        gltf.primitive(material=gltf.material(name, extensions=sheen, emissiveFactor=[1, 1, 1]))
    gltf.primitive(mode=1, indices=[0, 1])
    gltf.json["animations"] = [{"channels": [], "samplers": []}]
    hidden = gltf.node(mesh=0, extensions={"KHR_node_visibility": {"visible": False}})
    gltf.json["scenes"][0]["nodes"].append(hidden)
    gltf.json["extensionsUsed"] = ["KHR_materials_sheen", "KHR_materials_ior", "KHR_node_visibility"]
    model = read(gltf, tmp_path)
    assert [part.surface.ior for part in model.parts] == [1.3, 1.3]
    assert sorted(model.remarks) == [
        "KHR_materials_sheen is not used (2): a, b",
        "animations are not used (1): animation 0",
        "emission is not used (2): a, b",
        "points and lines are left out (1): /node/square",
    ]
