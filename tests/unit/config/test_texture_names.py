"""Folders of textures as tools and sites write them: each map is taken by its name, or named as not used."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from PIL import Image
from pxr import Usd, UsdShade
from support.small_survey import SURVEY

from garage2usd import GarageConfig
from garage2usd.assets.materials import OwnTexture
from garage2usd.assets.own_textures import own_pixels
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.config.map_names import Channel, channels_of
from garage2usd.config.outputs import TextureQuality
from garage2usd.config.texture_sets import Role, TextureFolder, read_texture_sets, texture_remarks
from garage2usd.datasets.recipe import Recipe, folder_remarks
from garage2usd.imports import import_layout

COLOUR, ROUGHNESS, METALLIC, OCCLUSION, NORMAL = Channel
C, R, M, A, N = ([(channel, None, False)] for channel in (COLOUR, ROUGHNESS, METALLIC, OCCLUSION, NORMAL))
DX, GLOSS, NONE = [(NORMAL, None, True)], [(ROUGHNESS, None, True)], []
ORM = [(OCCLUSION, 0, False), (ROUGHNESS, 1, False), (METALLIC, 2, False)]
RMA = [(ROUGHNESS, 0, False), (METALLIC, 1, False), (OCCLUSION, 2, False)]
GLTF = [(METALLIC, 2, False), (ROUGHNESS, 1, False)]
MASK = [(METALLIC, 0, False), (OCCLUSION, 1, False), (ROUGHNESS, 3, True)]
PACKS = {
    "Substance": [
        ("Concrete_%", "Base_Color|BaseColor|Diffuse|basecolor_v003|BaseColor.1001|BaseColor_ACES - ACEScg", C),
        ("Concrete_%", "AlbedoTransparency", C),
        ("Concrete_%", "Normal|Normal_OpenGL|NormalOpenGL|Normal_Base", N),
        ("Concrete_%", "Normal_DirectX|NormalDX|DirectX_Normal", DX),
        ("Concrete_%", "AO|Mixed_AO|Ambient_Occlusion", A),
        ("Concrete_%", "Roughness|Roughness_Utility - Raw", R),
        ("Concrete_%", "Glossiness", GLOSS),
        ("Concrete_%", "Metallic", M),
        ("Concrete_%", "OcclusionRoughnessMetallic|occlusionroughnessmetallic|AO_Roughness_Metallic", ORM),
        ("Concrete_%", "MetallicSmoothness", MASK[::2]),
        ("Concrete_%", "SpecularSmoothness", MASK[2:]),
        ("Concrete_%", "Height|Opacity|Emissive|Specular|SpecularLevel|Scattering|Curvature|ID", NONE),
        ("Concrete_%", "Sheen_Color|Coat_Normal|World_Space_Normals|Emissive_Color", NONE),
    ],
    "ambientCG": [
        ("Asphalt012_2K-JPG_%", "Color", C),
        ("Asphalt012_2K-JPG_%", "NormalGL", N),
        ("Asphalt012_2K-JPG_%", "NormalDX", DX),
        ("Asphalt012_2K-JPG_%", "Roughness", R),
        ("Asphalt012_2K-JPG_%", "AmbientOcclusion", A),
        ("Asphalt012_2K-JPG_%", "Metalness", M),
        ("Asphalt012_2K-JPG_%", "Displacement|Opacity|Emission|PREVIEW", NONE),
        ("Metal032_1K-PNG%", "|_Displacement", NONE),
    ],
    "Poly Haven": [
        ("asphalt_02_%_2k", "diff|col_01|coll1", C),
        ("asphalt_02_%_2k", "nor_gl|nor", N),
        ("asphalt_02_%_2k", "nor_dx", DX),
        ("asphalt_02_%_2k", "rough", R),
        ("asphalt_02_%_2k", "arm", ORM),
        ("asphalt_02_%_2k", "ao", A),
        ("asphalt_02_%_2k", "metal", M),
        ("asphalt_02_%_2k", "disp|spec|bump|translucent", NONE),
    ],
    "Megascans": [
        ("tgzkbfxs_2K_%", "Albedo|Diffuse|BaseColor", C),
        ("tgzkbfxs_2K_%", "Normal|Normal_LOD0|NormalBump", N),
        ("tgzkbfxs_2K_%", "Roughness", R),
        ("tgzkbfxs_2K_%", "Gloss", GLOSS),
        ("tgzkbfxs_2K_%", "AO", A),
        ("tgzkbfxs_2K_%", "Metalness", M),
        ("tgzkbfxs_2K_%", "Cavity|Displacement|Bump|Specular|Fuzz|Translucency|Mask", NONE),
        ("T_name_tgzkbfxs_2K_%", "B", C),
        ("T_name_tgzkbfxs_2K_%", "N", N),
        ("T_name_tgzkbfxs_2K_%", "ORM", ORM),
        ("T_name_tgzkbfxs_2K_%", "ORDp", ORM[:2]),
    ],
    "Unreal": [("T_x_%", "D|BC", C), ("T_x_%", "N", N), ("T_x_%", "ORM|AORM|ARM", ORM), ("T_x_%", "RMA", RMA)],
    "Unity": [
        ("Floor%", "Albedo|_MainTex|BaseMap", C),
        ("Floor%", "_MaskMap|MaskMap|_maskmap", MASK),
        ("Floor%", "Occlusion", A),
        ("Floor%", "_DetailAlbedoMap|_EmissionMap", NONE),
    ],
    "others": [
        ("worn-asphalt1-%", "albedo|albedo3", C),
        ("worn-asphalt1-%", "normal-ogl", N),
        ("worn-asphalt1-%", "normal-dx", DX),
        ("worn-asphalt1-%", "ao|ao2", A),
        ("worn-asphalt1-%", "height4|preview", NONE),
        ("TexturesCom Floor 1K %", "albedo", C),
        ("Tiles_%_3K", "COL_VAR1", C),
        ("Tiles_%_3K", "NRM16", N),
        ("Tiles_%_3K", "REFL|DISP16", NONE),
        ("%", "Base Color|ALBEDO|diffuse (1)|albedo concrete", C),
        ("%", "normal map.2048x2048|openglnormal|Concrete Normal final", N),
        ("%", "metallic-roughness|metallicRoughness", GLTF),
        ("%", "16-bit.AO.tile|x.ao.16bit", A),
        ("%", "roughness_non-color", R),
        ("%", "clear-coat-roughness|x.4k|rough_plaster_01", NONE),
    ],
}


@pytest.mark.parametrize("pack", PACKS)
def test_maps_are_told_by_the_names_of_each_pack(pack):
    for stem, names, wanted in PACKS[pack]:
        for name in names.split("|"):
            assert channels_of(stem.replace("%", name)) == wanted, (stem, name)


def save(path, value=90, size=(4, 4), mode="RGB"):
    path.parent.mkdir(parents=True, exist_ok=True)
    Image.new(mode, size, value if mode in {"L", "I;16"} else (value,) * len(mode)).save(path)


def remarks_of(folder, files):
    """Save files, pictures by their sizes and others by their text, and read the folder."""
    for name, content in files.items():
        path = folder / name
        if isinstance(content, str):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content)
        else:
            save(path, size=content)
    return texture_remarks(TextureFolder(folder=str(folder)))


SMALL, LARGE = (4, 4), (8, 8)


@pytest.mark.parametrize(
    ("files", "said"),
    [
        pytest.param(
            ["floor_Base_Color.png", "floor_Normal.png", "floor_Height.png", "readme.txt"],
            "floor_Base_Color.png as colour, floor_Normal.png as normals; not used: floor_Height.png (height), "
            "readme.txt",
            id="of the issue",
        ),
        pytest.param(
            ["a_Color.png", "a_NormalDX.png", "a_NormalGL.png", "a_Normal.png"],
            "a_Color.png as colour, a_NormalGL.png as normals; not used: a_Normal.png (normals: "
            "a_NormalGL.png is taken), "
            "a_NormalDX.png (normals: a_NormalGL.png is taken)",
            id="green up",
        ),
        pytest.param(
            ["a_Color.png", "a_NormalDX.png", "a_Gloss.png"],
            "a_Color.png as colour, a_Gloss.png as roughness (inverted), a_NormalDX.png as normals (green down)",
            id="inverted",
        ),
        pytest.param(
            {"a_2K_Color.png": SMALL, "4K/a_4K_Color.jpg": LARGE, "4K/a_4K-PNG_Color.png": LARGE},
            "4K/a_4K-PNG_Color.png as colour; not used: 4K/a_4K_Color.jpg (colour: 4K/a_4K-PNG_Color.png is taken), "
            "a_2K_Color.png (colour: 4K/a_4K-PNG_Color.png is taken)",
            id="most pixels, then PNG",
        ),
        pytest.param(
            {
                "a_v1_Albedo.png": LARGE,
                "a_v2_Albedo.png": SMALL,
                "a_Normal_LOD1.png": LARGE,
                "a_Normal_LOD0.png": SMALL,
            },
            "a_v2_Albedo.png as colour, a_Normal_LOD0.png as normals; not used: a_Normal_LOD1.png (normals: "
            "a_Normal_LOD0.png is taken), a_v1_Albedo.png (colour: a_v2_Albedo.png is taken)",
            id="newest version, first LOD",
        ),
        pytest.param(
            ["a_basecolor.png", "a_ORM.png", "a_roughness.png", "a_gloss.png"],
            "a_basecolor.png as colour, a_roughness.png as roughness, a_ORM.png as metallic and occlusion; "
            "not used: a_gloss.png (roughness: a_roughness.png is taken)",
            id="own map before packed, roughness before gloss",
        ),
        pytest.param(
            ["rusty_metal_diff_2k.png", "rusty_metal_rough_2k.png", "rusty_metal_ao_2k.png", "rusty_metal.png"],
            "rusty_metal_diff_2k.png as colour, rusty_metal_rough_2k.png as roughness, rusty_metal_ao_2k.png as "
            "occlusion; not used: rusty_metal.png (its name tells no map)",
            id="a material called metal",
        ),
        pytest.param(
            ["a_color.png", "a_rough.png", "b_rough.png"],
            "a_color.png as colour, a_rough.png as roughness; not used: b_rough.png (roughness: a_rough.png is taken)",
            id="of the colour's material",
        ),
        pytest.param(["Concrete 03.jpg"], "Concrete 03.jpg as colour", id="one picture"),
        pytest.param(
            ["tiles.jpg", "tiles_n.jpg", "tiles_s.jpg", "tiles_AO copy.jpg", "tiles_AO.jpg"],
            "tiles.jpg as colour, tiles_AO.jpg as occlusion, tiles_n.jpg as normals; not used: tiles_AO copy.jpg "
            "(occlusion: tiles_AO.jpg is taken), tiles_s.jpg (its name tells no map)",
            id="the picture of the maps",
        ),
        pytest.param(
            ["x_AlbedoTransparency.png", "x_MetallicSmoothness.png"],
            "x_AlbedoTransparency.png as colour, x_MetallicSmoothness.png as metallic; not used: "
            "x_AlbedoTransparency.png (opacity), x_MetallicSmoothness.png (without the transparency that holds "
            "roughness)",
            id="files used in part",
        ),
        pytest.param(
            ["a_color.png", "._a_color.png", ".DS_Store", "Thumbs.db", "desktop.ini", "__MACOSX/._b_color.png"],
            "a_color.png as colour",
            id="hidden",
        ),
        pytest.param(
            ["a_color.png", "a_MaskMap.jpg", "a_normal.exr", "a_normal.png", "_old/a_color.png", "a.json"],
            "a_color.png as colour, a_MaskMap.jpg as metallic and occlusion, a_normal.png as normals; not used: "
            "a_MaskMap.jpg (without the transparency that holds roughness), "
            "a_normal.exr (normals: a_normal.png is taken), _old/a_color.png (set aside by _), a.json",
            id="partly",
        ),
    ],
)
def test_a_line_says_which_files_of_a_role_are_taken_as_what(tmp_path, files, said):
    sizes = files if isinstance(files, dict) else dict.fromkeys(files, SMALL)
    sizes = {n: size if n.endswith((".png", ".jpg")) and "._" not in n else "" for n, size in sizes.items()}
    (line,) = remarks_of(tmp_path / "mine", {f"floor/{name}": size for name, size in sizes.items()})
    place, told = line.split(": ", 1)
    assert place == "mine/floor"
    assert told == said


def test_files_beside_one_another_and_those_of_no_role_are_named_too(tmp_path):
    names = ("FloorBaseColor.png", "T_lane-paint_D.png", "Wall/x_albedo.png", "wall_normal.png", "preview.png")
    texts = {"license.txt": "", "doc/a.md": "", "textures.toml": "[wall]\nnormal = 'dx'"}
    assert remarks_of(tmp_path / "mine", dict.fromkeys(names, SMALL) | texts) == (
        "mine, floor: FloorBaseColor.png as colour",
        "mine, wall: Wall/x_albedo.png as colour, wall_normal.png as normals (green down)",
        "mine, lane_paint: T_lane-paint_D.png as colour",
        "mine: not used: doc/a.md, license.txt, preview.png (its name tells no role)",
    )


@pytest.mark.parametrize(
    ("names", "said"),
    [
        (["floor/a_color.png", "floor/b_color.jpg"], "one map of colour, or several of one material"),
        (["floor/a_color.png", "floor/b_rough.png", "floor/c_rough.png"], "one map of roughness"),
        (["floor/a.png", "floor/b.png"], "a map whose name says color"),
        (["roof/color.png"], "folders of the roles"),
    ],
)
def test_what_two_materials_tell_is_refused(tmp_path, names, said):
    with pytest.raises(ConfigError, match=said):
        remarks_of(tmp_path, dict.fromkeys(names, SMALL))


@pytest.mark.parametrize(("mode", "smoothness"), [("RGBA", 155), ("LA", 155)])
def test_smoothness_of_unity_is_read_from_transparency(tmp_path, mode, smoothness):
    save(tmp_path / "floor" / "x_Albedo.png")
    Image.new(mode, (4, 4), (10, 20, 30, smoothness)[-len(mode) :]).save(
        tmp_path / "floor" / "x_MetallicSmoothness.png"
    )
    _, sets = read_texture_sets(TextureFolder(folder=str(tmp_path)))
    packed = tuple((channel, file) for channel, file in sets[Role.FLOOR].maps if channel is not Channel.COLOUR)
    red, green, blue = own_pixels(OwnTexture(Role.FLOOR, packed, 0.7, 0.0), TextureQuality.LOW).getpixel((0, 0))
    assert (red, green, blue) == (255, 255 - smoothness, 10 if mode == "RGBA" else 30)


SETTINGS = """
[site]
structure = "....\\nE==X\\n...."
[bay]
dimensioned = false
[parking]
occupancy = 0
[stage]
texture_quality = "low"
[look]
textures = "mine"
"""
LINE = (
    "mine/wall: Concrete_Base_Color.png as colour, Concrete_Mixed_AO.png as occlusion, Concrete_Normal_OpenGL.png as "
    "normals; not used: Concrete_Height.png (height)"
)


@pytest.fixture
def config_file(tmp_path):
    for name in ("Base_Color", "Mixed_AO", "Height"):
        save(tmp_path / "mine" / "wall" / f"Concrete_{name}.png")
    normal = np.full((4, 4, 3), (128, 200, 220), np.uint8)
    Image.fromarray(normal).save(tmp_path / "mine" / "wall" / "Concrete_Normal_OpenGL.png")
    (tmp_path / "c.toml").write_text(SETTINGS)
    return tmp_path / "c.toml"


def test_a_build_says_it_in_its_output_and_in_its_report_and_shows_the_normals(tmp_path, config_file):
    ran = CliRunner().invoke(main, ["build", str(config_file), "-o", str(tmp_path / "out" / "a.usdc")])
    assert ran.exit_code == 0
    assert ran.stderr.splitlines()[0] == LINE
    report = json.loads((tmp_path / "out" / "a_report.json").read_text())
    assert report["remarks"] == [LINE]
    stage = Usd.Stage.Open(str(tmp_path / "out" / "a.usdc"))
    prims = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    surface = next(UsdShade.Shader(p) for p in prims if p.GetPath().pathString.endswith("WallConcrete/Surface"))
    reader = UsdShade.Shader(surface.GetInput("normal").GetConnectedSources()[0][0].source)
    with Image.open(reader.GetInput("file").Get().resolvedPath) as picture:
        assert picture.getpixel((0, 0)) == (128, 200, 220)


def test_reports_of_imports_and_recipes_have_it_too(tmp_path, config_file):
    look = {"textures": str(config_file.parent / "mine")}
    config = GarageConfig(look=look, stage={"texture_quality": "low"}, parking={"occupancy": 0.0})
    assert config.remarks() == (LINE,)
    (tmp_path / "lot.toml").write_text(SURVEY)
    made = import_layout(tmp_path / "lot.toml", tmp_path / "l.usdc", config=config, proves=False)
    assert json.loads(made.report.read_text())["remarks"] == [LINE]
    ran = CliRunner().invoke(main, ["import", str(config_file), "-c", str(config_file), "-o", str(tmp_path / "b.usda")])
    assert (ran.exit_code, ran.stderr.splitlines()[0]) == (1, LINE)
    alternative = {"name": "own", "garage": {"look": look}}
    recipe = Recipe(name="a", garage={"look": look}, groups={"looks": [alternative, {"name": "usual"}]})
    assert folder_remarks(recipe) == (LINE,)
