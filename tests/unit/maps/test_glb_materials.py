"""Materials of others in a GLB say what UsdPreviewSurface's specification says, pixel by pixel, or are named."""

import io

import numpy as np
import pytest
from PIL import Image
from pxr import Usd, UsdShade
from support.foreign_materials import (
    BROKEN_PICTURES,
    COLOUR,
    MATERIALS,
    RGB,
    STAGE,
    case,
    material_stage,
    odd_pictures,
    primvar,
    texture,
)
from support.glb_reader import Glb
from support.preview_surface import GltfMaterial, value_at

from garage2usd.maps.glb import write_glb
from garage2usd.scenes.remarks import Remarks

BYTE = 1.5 / 255


def exported(stage, folder):
    """A stage as a GLB, and what was named."""
    remarks = Remarks()
    write_glb(stage, folder / "stage.glb", remarks=remarks)
    return Glb((folder / "stage.glb").read_bytes()), remarks.lines()


def places(stage):
    """Places (x, y) on the square whose texture coordinates are not at the edge of a pixel, with its primvars there."""
    rng = np.random.default_rng(1)
    mesh = stage.GetPrimAtPath("/W/Square")
    corners = {name: np.array(mesh.GetAttribute(f"primvars:{name}").Get()) for name in ("st", "UVMap", "wide")}
    for x, y in rng.uniform(0.02, 0.98, (60, 2)):
        shares = np.array([(1 - x) * (1 - y), x * (1 - y), x * y, (1 - x) * y])
        yield (x, y), {name: shares @ own for name, own in corners.items()} | {"shine": 0.25}


@pytest.mark.parametrize("about", MATERIALS)
def test_a_material_says_what_its_specification_says(about, tmp_path):
    stage = material_stage(tmp_path, MATERIALS[about])
    glb, remarks = exported(stage, tmp_path)
    assert len(remarks) == about.startswith("missing")
    written, material = GltfMaterial(glb), UsdShade.Material(stage.GetPrimAtPath("/W/M"))
    is_mirror, off = "specularColor" in MATERIALS[about]["inputs"], 0
    compared = 0
    for place, primvars in places(stage):
        found = written.values(place)
        for name, value in found.items():
            if name == "metallic" and is_mirror:
                assert value == 0
                continue
            wanted = value_at(material, name, primvars)
            # what glTF stores as sRGB is as exact as a byte of sRGB
            slack = BYTE * (3.0 if name in {"diffuseColor", "emissiveColor", "specularColor"} else 1.0)
            slack *= max(1.0, float(np.abs(wanted).max()))
            off += bool(np.abs(np.clip(wanted, -1, 1e4) - value).max() > slack)
            compared += 1
    # a place within rounding of another pixel
    assert off <= 0.02 * compared


def test_what_is_opaque_is_not_blended_and_what_is_cut_out_is_a_mask(tmp_path):
    modes = {}
    for about in ("an alpha that nobody reads", "opacity of the same file", "cut out"):
        glb, _ = exported(material_stage(tmp_path, MATERIALS[about]), tmp_path)
        (material,) = glb.json["materials"]
        modes[about] = material.get("alphaMode"), material.get("alphaCutoff")
    assert modes == {
        "an alpha that nobody reads": (None, None),
        "opacity of the same file": ("BLEND", None),
        "cut out": ("MASK", pytest.approx(0.4)),
    }


def test_files_go_as_they_are_where_they_can(tmp_path):
    for about in ("tint", "moved", "roughness times a factor", "flat normals", "weak occlusion", "glow of a texture"):
        stage = material_stage(tmp_path, MATERIALS[about])
        glb, _ = exported(stage, tmp_path)
        (image,) = glb.json["images"]
        is_moved_to_red = about == "weak occlusion"
        assert is_moved_to_red or bytes(glb.view(image["bufferView"])) == (tmp_path / "noise.png").read_bytes()


@pytest.mark.parametrize(
    ("about", "said", "named"),
    [
        (
            "black outside",
            case(texture("T", "noise.png", wrapS='"black"'), primvar(varname="wide"), diffuseColor=RGB),
            "textures are clamped where they should be black outside (1): /W/M/T",
        ),
        (
            "displacement",
            case(texture("T", "grey.png"), primvar(), displacement="T.outputs:r"),
            "displacement is left out (1): /W/M",
        ),
        (
            "opacity that lies elsewhere",
            case(
                texture("T", "noise.png"),
                texture("O", "grey.png", "Q"),
                primvar(),
                primvar("Q", "UVMap"),
                diffuseColor=RGB,
                opacity="O.outputs:r",
            ),
            "opacity textures that lie unlike the colour's are carried as their mean (1)",
        ),
        (
            "a texture of what has none",
            case(texture("T", "noise.png", sourceColorSpace='"raw"'), primvar(), ior="T.outputs:g"),
            "textures of ior are carried as their mean (1)",
        ),
        ("a normal", case(normal=(0.6, 0.0, 0.8)), "normals that are the same all over are left out (1): /W/M"),
        (
            "another node",
            case(
                'def Shader "N" {\n uniform token info:id = "ND_noise2d"\n float outputs:r\n}',
                roughness="N.outputs:r",
            ),
            "inputs from other nodes than those of UsdPreviewSurface are left out (1): /W/M/N",
        ),
        (
            "numbers that are colours by themselves",
            case(texture("T", "noise.png"), primvar(), roughness="T.outputs:g"),
            "numbers in coloured pictures of the colour space auto are read as raw (1)",
        ),
        (
            "too bright",
            case(texture("T", "noise.png", scale=(3, 3, 3, 1)), primvar(), diffuseColor=RGB),
            "values of textures outside of 0 to 1 are cut off (1)",
        ),
    ],
)
def test_what_gltf_cannot_say_is_named(about, said, named, tmp_path):
    _, remarks = exported(material_stage(tmp_path, said), tmp_path)
    (line,) = remarks
    assert line.startswith(named)


INDEXED = """
color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] (interpolation = "constant")
int[] primvars:displayColor:indices = [1]
"""


@pytest.mark.parametrize(
    ("said", "colour"),
    [(INDEXED, (0, 1, 0)), ("color3f[] primvars:displayColor", (0.5, 0.5, 0.5))],
    ids=["by its index", "without a value"],
)
def test_a_prim_without_a_material_has_its_own_colour(said, colour, tmp_path):
    path = tmp_path / "cube.usda"
    path.write_text(f'#usda 1.0\n(\nmetersPerUnit = 1\nupAxis = "Y"\n)\ndef Cube "C" {{\n{said}\n}}\n')
    glb, remarks = exported(Usd.Stage.Open(str(path)), tmp_path)
    assert remarks == []
    (material,) = glb.json["materials"]
    assert material["pbrMetallicRoughness"]["baseColorFactor"][:3] == pytest.approx(colour, abs=1e-6)


def test_another_surface_is_named(tmp_path):
    said = case()
    path = tmp_path / "square.usda"
    path.write_text(STAGE.format(**said).replace('"UsdPreviewSurface"', '"ND_open_pbr_surface"'))
    _, remarks = exported(Usd.Stage.Open(str(path)), tmp_path)
    assert remarks == ["materials without a UsdPreviewSurface are plain (1): /W/M"]


def test_odd_pictures_are_converted(tmp_path):
    for name, off in odd_pictures(tmp_path).items():
        glb, remarks = exported(
            material_stage(tmp_path, case(texture("T", name), primvar(), diffuseColor=RGB)), tmp_path
        )
        assert remarks == [], name
        (image,) = glb.json["images"]
        with Image.open(io.BytesIO(bytes(glb.view(image["bufferView"])))) as picture:
            assert picture.get_format_mimetype() == image["mimeType"], name
            assert picture.mode in {"RGB", "RGBA", "P"}, name
            assert np.abs(np.array(picture.convert("RGB"), dtype=int) - COLOUR).max() <= off, name


def test_sixteen_bits_keep_their_scale(tmp_path):
    grey = np.array([[0, 9000], [30000, 63000]], dtype=np.uint16)
    Image.fromarray(grey).save(tmp_path / "deep.png")
    said = case(texture("T", "deep.png"), primvar(), roughness="T.outputs:r", metallic=0.5)
    glb, remarks = exported(material_stage(tmp_path, said), tmp_path)
    assert remarks == []
    (picture,) = GltfMaterial(glb).pictures
    assert np.abs(picture[..., 1] - grey / 65535).max() <= 1 / 255


def test_openexr_is_converted(tmp_path):
    exr = pytest.importorskip("OpenEXR")
    values = np.random.default_rng(2).uniform(0, 1, (4, 4, 3)).astype(np.float32)
    header = {"compression": exr.ZIP_COMPRESSION, "type": exr.scanlineimage}
    exr.File(header, {"RGB": values}).write(str(tmp_path / "light.exr"))
    said = case(texture("T", "light.exr"), primvar(), diffuseColor=RGB)
    glb, remarks = exported(material_stage(tmp_path, said), tmp_path)
    assert remarks == []
    (picture,) = GltfMaterial(glb).pictures
    stored = np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055)
    assert np.abs(picture[..., :3] - stored).max() <= 1 / 255


@pytest.mark.parametrize("name", BROKEN_PICTURES)
@pytest.mark.parametrize("read", [{"diffuseColor": RGB}, {"roughness": "T.outputs:r"}, {"opacity": "T.outputs:a"}])
def test_what_is_no_picture_is_named_and_shows_its_fallback(name, read, tmp_path):
    (tmp_path / name).write_bytes(BROKEN_PICTURES[name])
    said = case(texture("T", name, fallback=(0.25, 0.5, 0.75, 0.5)), primvar(), **read)
    glb, remarks = exported(material_stage(tmp_path, said), tmp_path)
    (line,) = remarks
    assert line.endswith(f"(1): {name}")
    assert "images" not in glb.json
    wanted = {"diffuseColor": (0.25, 0.5, 0.75), "roughness": 0.25, "opacity": 0.5}[next(iter(read))]
    assert GltfMaterial(glb).values((0.5, 0.5))[next(iter(read))] == pytest.approx(wanted)


def test_tiles_become_one_picture(tmp_path):
    """By columns rightwards and rows of ten upwards from 1001; places without a tile are black."""
    greys = {1001: 0, 1002: 51, 1011: 102, 1012: 204}
    for tile, grey in greys.items():
        Image.new("RGB", (8, 8), (grey,) * 3).save(tmp_path / f"tile.{tile}.png")
    reader = texture("T", "tile.<UDIM>.png", sourceColorSpace='"raw"')
    stage = material_stage(tmp_path, case(reader, primvar(varname="wide"), diffuseColor=RGB))
    glb, remarks = exported(stage, tmp_path)
    assert remarks == []
    assert len(glb.json["images"]) == 1
    material, seen = GltfMaterial(glb), set()
    for place, primvars in places(stage):
        column, row = np.floor(primvars["wide"]).astype(int)
        is_inside = np.abs(primvars["wide"] - np.rint(primvars["wide"])).min() > 0.1  # where pixels of two tiles mix
        if (tile := 1001 + column + 10 * row) in greys and {column, row} <= {0, 1} and is_inside:
            seen.add(tile)
            assert material.values(place)["diffuseColor"] == pytest.approx([greys[tile] / 255] * 3, abs=2 * BYTE)
    assert len(seen) > 1
