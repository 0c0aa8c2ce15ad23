"""Textures of one's own: any shape that packs come in is in the stage as it is meant, and other files are refused."""

import shutil

import numpy as np
import pytest
from PIL import Image
from pxr import Usd, UsdShade

import garage2usd
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, load_config
from garage2usd.config.map_names import Channel, channels_of
from garage2usd.config.texture_sets import TextureFolder, read_texture_sets

GREY, RED, GREEN, BLUE = (
    np.full((32, 64), 90, np.uint8),
    np.full((32, 64), 200, np.uint8),
    np.full((32, 64), 40, np.uint8),
    np.full((32, 64), 10, np.uint8),
)
COLOUR = np.dstack([RED, GREEN, BLUE])
EMPTY = {"site": {"width_cells": 4, "height_cells": 4}, "plan": {"episodes": 50}, "parking": {"occupancy": 0.0}}


def save(path, pixels, **options):
    path.parent.mkdir(parents=True, exist_ok=True)
    picture = pixels if isinstance(pixels, Image.Image) else Image.fromarray(pixels)
    picture.save(path, **options)


def surface_of(folder, tmp_path, material="FloorConcrete", **settings):
    """What the stage says of a material whose role has textures in a folder: by input, (file, channel) or a value."""
    config = GarageConfig(**EMPTY, look={"textures": str(folder)}, **settings)
    built = garage2usd.build(config, tmp_path / "out" / "garage.usdc")
    stage = Usd.Stage.Open(str(built.stage))
    prims = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    surface = next(UsdShade.Shader(prim) for prim in prims if prim.GetPath().pathString.endswith(f"{material}/Surface"))
    said = {}
    for given in surface.GetInputs():
        if given.HasConnectedSource():
            source = given.GetConnectedSources()[0][0]
            reader = UsdShade.Shader(source.source)
            file = reader.GetInput("file").Get().resolvedPath
            said[given.GetBaseName()] = file, str(source.sourceName)
        else:
            said[given.GetBaseName()] = given.Get()
    return said


def middle(path, band=None):
    with Image.open(path) as picture:
        pixel = picture.convert("RGB").getpixel((picture.width // 2, picture.height // 2))
    return pixel if band is None else pixel["rgb".index(band)]


@pytest.mark.parametrize(
    ("names", "values"),
    [
        pytest.param(
            {
                "Concrete034_1K-JPG_Color.png": COLOUR,
                "Concrete034_1K-JPG_Roughness.png": GREY,
                "Concrete034_1K-JPG_Metalness.png": BLUE,
                "Concrete034_1K-JPG_AmbientOcclusion.png": RED,
                "Concrete034_1K-JPG_Displacement.png": GREEN,
                "Concrete034_1K-JPG.png": GREEN,
            },
            {"roughness": 90, "metallic": 10, "occlusion": 200},
            id="ambientCG",
        ),
        pytest.param(
            {"floor_06_diff_1k.jpg": COLOUR, "floor_06_arm_1k.png": np.dstack([RED, GREY, BLUE])},
            {"roughness": 90, "metallic": 10, "occlusion": 200},
            id="Poly Haven",
        ),
        pytest.param(
            {"Default_baseColor.png": COLOUR, "Default_metallicRoughness.png": np.dstack([BLUE, GREY, RED])},
            {"roughness": 90, "metallic": 200, "occlusion": 255},
            id="glTF",
        ),
        pytest.param(
            {"T_Floor_BC.png": COLOUR, "T_Floor_ORM.png": np.dstack([RED, GREY, BLUE])},
            {"roughness": 90, "metallic": 10, "occlusion": 200},
            id="Unreal",
        ),
        pytest.param(
            {"albedo.png": COLOUR, "gloss.png": GREY}, {"roughness": 165, "metallic": 0, "occlusion": 255}, id="gloss"
        ),
    ],
)
def test_maps_of_all_packs_are_what_the_stage_reads(tmp_path, names, values):
    for name, pixels in names.items():
        save(tmp_path / "set" / "floor" / name, pixels)
    said = surface_of(tmp_path / "set", tmp_path)
    assert np.abs(np.subtract(middle(said["diffuseColor"][0]), (200, 40, 10))).max() <= 3
    for channel, value in values.items():
        file, band = said[channel]
        assert middle(file, band) == value
    assert len({said[channel][0] for channel in values}) == 1


def test_normals_look_up_and_names_or_the_file_of_sizes_tell_where_green_does(tmp_path):
    normal = np.dstack([np.full((32, 64), 128, np.uint8), RED, np.full((32, 64), 220, np.uint8)])
    save(tmp_path / "set" / "wall_color.png", COLOUR)
    for name, sizes, green in (
        ("wall_normal.png", "", 200),
        ("wall_NormalGL.png", "", 200),
        ("wall_NormalDX.png", "", 55),
        ("wall_normal.png", '[wall]\nnormal = "dx"\n', 55),
    ):
        save(tmp_path / "set" / name, normal)
        (tmp_path / "set" / "textures.toml").write_text(sizes)
        file, output = surface_of(tmp_path / "set", tmp_path, "WallConcrete")["normal"]
        assert (middle(file, "g"), output) == (green, "rgb")
        (tmp_path / "set" / name).unlink()
    (tmp_path / "set" / "textures.toml").unlink()
    save(tmp_path / "set" / "wall_NormalDX.png", normal)
    save(tmp_path / "set" / "wall_NormalGL.png", normal)  # packs have both
    assert middle(surface_of(tmp_path / "set", tmp_path, "WallConcrete")["normal"][0], "g") == 200


@pytest.mark.parametrize(
    ("picture", "expected"),
    [
        (Image.fromarray(np.full((32, 64), 40000, np.uint16)), (156,) * 3),
        (Image.fromarray(np.dstack([GREY, RED])), (90,) * 3),
        (Image.fromarray(np.dstack([COLOUR, GREY])), (200, 40, 10)),
        (Image.fromarray(COLOUR).quantize(16), (200, 40, 10)),
        (Image.fromarray(GREY > 1), (255,) * 3),
    ],
    ids=["16 bits", "grey with alpha", "alpha", "palette", "1 bit"],
)
def test_shapes_that_not_all_readers_take_become_red_green_and_blue(tmp_path, picture, expected):
    save(tmp_path / "set" / "floor_color.png", picture)
    file, _ = surface_of(tmp_path / "set", tmp_path)["diffuseColor"]
    with Image.open(file) as written:
        assert (written.format, written.mode) == ("PNG", "RGB")
    assert middle(file) == expected


def test_a_picture_that_all_readers_take_keeps_its_bytes_unless_it_is_too_large(tmp_path):
    save(tmp_path / "set" / "floor_color.jpg", COLOUR, progressive=True)
    given = (tmp_path / "set" / "floor_color.jpg").read_bytes()
    file, _ = surface_of(tmp_path / "set", tmp_path)["diffuseColor"]
    with open(file, "rb") as kept:
        assert kept.read() == given
    save(tmp_path / "set" / "floor_color.jpg", np.tile(COLOUR, (20, 20, 1)))
    file, _ = surface_of(tmp_path / "set", tmp_path, stage={"texture_quality": "low"})["diffuseColor"]
    with Image.open(file) as smaller:
        assert (smaller.size, smaller.format) == ((512, 256), "JPEG")


def test_a_repeat_covers_the_metres_that_are_asked_for_and_is_as_long_as_the_picture(tmp_path):
    save(tmp_path / "set" / "floor_color.png", COLOUR)
    (tmp_path / "set" / "textures.toml").write_text("[floor]\nrepeat_m = 4.0\n")
    config = GarageConfig(**EMPTY, look={"textures": str(tmp_path / "set")})
    stage = Usd.Stage.Open(str(garage2usd.build(config, tmp_path / "out" / "garage.usdc").stage))
    spans = []
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.GetName() == "FloorConcrete" and prim.GetTypeName() == "Mesh":
            points = np.array(prim.GetAttribute("points").Get())
            st = np.array(prim.GetAttribute("primvars:st").Get())
            spans.append(np.ptp(points[:, [0, 2]], axis=0) / np.ptp(st, axis=0))
    assert len(spans) > 2
    np.testing.assert_allclose(spans, [(4.0, 2.0)] * len(spans), rtol=1e-4)


def test_bays_as_the_aisle_have_the_floor_and_other_roles_keep_theirs(tmp_path):
    save(tmp_path / "set" / "floor_color.png", COLOUR)
    said = surface_of(tmp_path / "set", tmp_path, "StallEpoxy")
    assert "stall_colour" in said["diffuseColor"][0]
    config = GarageConfig(look={"textures": str(tmp_path / "set"), "floor": {"bays": "aisle"}})
    names = {path.name for path in built_textures(config, tmp_path)}
    assert not any(name.startswith("stall_colour") for name in names)


def built_textures(config, tmp_path):
    built = garage2usd.build(config, tmp_path / "other" / "garage.usdc")
    return sorted((built.asset_folder / "textures").iterdir())


def test_the_same_digest_is_the_same_bytes_wherever_the_folder_is(tmp_path):
    for place in ("here", "there"):
        save(tmp_path / place / "mine" / "floor" / "color.png", COLOUR)
        (tmp_path / place / "garage.toml").write_text('[look]\ntextures = "mine"\n')
    one, other = (load_config(tmp_path / place / "garage.toml") for place in ("here", "there"))
    assert one.digest() == other.digest() != GarageConfig().digest()
    assert [path.read_bytes() for path in built_textures(one, tmp_path)] == [
        path.read_bytes() for path in built_textures(other, tmp_path)
    ]
    save(tmp_path / "there" / "mine" / "floor" / "color.png", np.dstack([BLUE, GREEN, RED]))
    assert load_config(tmp_path / "there" / "garage.toml").digest() != one.digest()
    with pytest.raises(ConfigError, match="that it was given with"):
        garage2usd.build(other, tmp_path / "out" / "garage.usdc")
    shutil.rmtree(tmp_path / "here")
    with pytest.raises(ConfigError, match=r"look\.textures.*a folder that can be read"):
        garage2usd.build(one, tmp_path / "out" / "garage.usdc")


def test_plan_and_placements_stay_what_they_are_with_textures(tmp_path):
    save(tmp_path / "set" / "floor_color.png", COLOUR)
    usual = garage2usd.generate(GarageConfig())
    own = garage2usd.generate(GarageConfig(look={"textures": str(tmp_path / "set")}))
    assert own.plan.structure == usual.plan.structure
    assert own.layout.placements.specs == usual.layout.placements.specs


@pytest.mark.parametrize(
    ("files", "field", "said"),
    [
        ({"floor/x_color.exr": b"exr"}, "look.textures.floor", "x_color.exr'; allowed: a PNG or a JPEG of colour"),
        ({"floor/x_color.png": b"no picture"}, "look.textures.floor", "a PNG, or a JPEG in grey"),
        ({"floor/x_color.png": b"\x89PNG\r\n\x1a\n" + bytes(30)}, "look.textures.floor", "a PNG, or a JPEG in grey"),
        ({"floor/x_roughness.png": GREY}, "look.textures.floor", "a map whose name says color"),
        ({"floor/a_color.png": COLOUR, "floor/b_color.png": COLOUR}, "look.textures.floor", "one map of colour"),
        ({"roof/color.png": COLOUR}, "look.textures", "folders of the roles floor, stall"),
        ({"roof_color.png": COLOUR}, "look.textures", "names that begin with a role: floor, stall"),
        ({"readme.txt": b"none"}, "look.textures", "pictures in a folder of a role"),
        ({"floor_color.png": COLOUR, "textures.toml": b"[roof]"}, "look.textures.roof", "tables of the roles"),
        ({"floor_color.png": COLOUR, "textures.toml": b"[wall]"}, "look.textures.wall", "roles that have pictures"),
        (
            {"floor_color.png": COLOUR, "textures.toml": b"[floor]\nrepeat_m = 0"},
            "look.textures.floor.repeat_m",
            "greater than 0",
        ),
    ],
)
def test_what_cannot_be_used_is_named_with_its_role_and_file(tmp_path, files, field, said):
    for name, content in files.items():
        path = tmp_path / "set" / name
        if isinstance(content, bytes):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        else:
            save(path, content)
    with pytest.raises(ConfigError) as refused:
        garage2usd.build(GarageConfig(look={"textures": str(tmp_path / "set")}), tmp_path / "out" / "garage.usdc")
    assert refused.value.field == field
    assert said in str(refused.value)
    assert not (tmp_path / "out").exists()


def test_a_jpeg_in_cmyk_is_refused_by_its_name(tmp_path):
    save(tmp_path / "set" / "floor_color.jpg", Image.fromarray(COLOUR).convert("CMYK"))
    with pytest.raises(ConfigError, match=r"floor_color\.jpg in CMYK"):
        garage2usd.build(GarageConfig(look={"textures": str(tmp_path / "set")}), tmp_path / "out" / "garage.usdc")


@pytest.mark.parametrize(
    ("stem", "channels"),
    [
        ("Metal032_1K-PNG", []),
        ("rough_plaster_01", []),
        ("hardwood2_bump", []),
        ("Metal032_1K-PNG_Metalness", [Channel.METALLIC]),
        ("brick_wall_006_nor_gl_1k", [Channel.NORMAL]),
        ("FloorsCheckerboard_S_Diffuse", [Channel.COLOUR]),
        ("Default_metalRoughness", [Channel.METALLIC, Channel.ROUGHNESS]),
    ],
)
def test_names_of_sets_are_no_names_of_maps(stem, channels):
    assert [channel for channel, _, _ in channels_of(stem)] == channels


def test_other_files_of_a_pack_decide_nothing(tmp_path):
    save(tmp_path / "set" / "floor" / "x_color.png", COLOUR)
    one, _ = read_texture_sets(TextureFolder(folder=str(tmp_path / "set")))
    (tmp_path / "set" / "LICENSE.txt").write_text("CC0")
    save(tmp_path / "set" / "floor" / "x_height.png", GREY)
    assert read_texture_sets(TextureFolder(folder=str(tmp_path / "set")))[0].sha256 == one.sha256
