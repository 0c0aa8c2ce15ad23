"""UsdPreviewSurface as the lit shaders of the three pipelines, and the maps that each wants, pixel by pixel."""

import base64

import numpy as np
import pytest
from PIL import Image
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

PIPELINES = {"BuiltIn": "Standard", "Universal": "Universal Render Pipeline/Lit", "HighDefinition": "HDRP/Lit"}
BASE = {"BuiltIn": "_MainTex", "Universal": "_BaseMap", "HighDefinition": "_BaseColorMap"}
COLOR = {"BuiltIn": "_Color", "Universal": "_BaseColor", "HighDefinition": "_BaseColor"}
NORMAL = {"BuiltIn": "_BumpMap", "Universal": "_BumpMap", "HighDefinition": "_NormalMap"}
MASKS = {
    "BuiltIn": ("_MetallicGlossMap", "_OcclusionMap"),
    "Universal": ("_MetallicGlossMap", "_OcclusionMap"),
    "HighDefinition": ("_MaskMap",),
}
MASK_KEYWORDS = {
    "BuiltIn": {"_METALLICGLOSSMAP"},
    "Universal": {"_METALLICSPECGLOSSMAP", "_OCCLUSIONMAP"},
    "HighDefinition": {"_MASKMAP"},
}
SMOOTHNESS = {"BuiltIn": "_Glossiness", "Universal": "_Smoothness", "HighDefinition": "_Smoothness"}
EMISSION = {"BuiltIn": "_EmissionColor", "Universal": "_EmissionColor", "HighDefinition": "_EmissiveColor"}

VALUE_TYPES = {
    "color3f": Sdf.ValueTypeNames.Color3f,
    "token": Sdf.ValueTypeNames.Token,
    "float": Sdf.ValueTypeNames.Float,
}

each_pipeline = pytest.mark.parametrize("pipeline", PIPELINES)


class Look:
    """A stage with a textured square for each material."""

    def __init__(self, folder):
        self.path = folder / "stage.usda"
        self.stage = Usd.Stage.CreateNew(str(self.path))
        UsdGeom.SetStageUpAxis(self.stage, "Y")
        UsdGeom.SetStageMetersPerUnit(self.stage, 1)
        self.folder = folder

    def image(self, name: str, pixels: np.ndarray) -> str:
        Image.fromarray(pixels).save(self.folder / name)
        return f"./{name}"

    def material(self, name: str, *, primvars: tuple[str, ...] = ("st",), **inputs) -> UsdShade.Shader:
        material = UsdShade.Material.Define(self.stage, f"/{name}Look")
        surface = UsdShade.Shader.Define(self.stage, f"/{name}Look/Surface")
        surface.CreateIdAttr("UsdPreviewSurface")
        material.CreateSurfaceOutput().ConnectToSource(surface.ConnectableAPI(), "surface")
        for key, value in inputs.items():
            kind = "color3f" if isinstance(value, tuple) else "token" if isinstance(value, str) else "float"
            surface.CreateInput(key, VALUE_TYPES[kind]).Set(value)
        mesh = UsdGeom.Mesh.Define(self.stage, f"/{name}")
        mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
        mesh.CreateFaceVertexCountsAttr([4])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
        mesh.CreateSubdivisionSchemeAttr("none")
        for primvar in primvars:
            coordinates = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar(
                primvar, Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.vertex
            )
            offset = 0 if primvar == "st" else 5
            coordinates.Set(Vt.Vec2fArray([(offset, 0), (offset + 1, 0), (offset + 1, 2), (offset, 2)]))
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(material)
        return surface

    def texture(self, surface: UsdShade.Shader, inputs: dict[str, str], file: str, **options) -> UsdShade.Shader:
        """A reader of a file whose outputs feed inputs of a surface."""
        name = Sdf.Path(file.strip("./").replace(".", "_").replace("-", "_")).name
        path = surface.GetPath().GetParentPath().AppendChild(name)
        reader = UsdShade.Shader.Define(self.stage, path)
        reader.CreateIdAttr("UsdUVTexture")
        reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(file)
        reader.CreateInput("wrapS", Sdf.ValueTypeNames.Token).Set(options.get("wrap", "repeat"))
        reader.CreateInput("wrapT", Sdf.ValueTypeNames.Token).Set(options.get("wrap", "repeat"))
        reader.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set(options.get("space", "auto"))
        for key in ("scale", "bias", "fallback"):
            if key in options:
                reader.CreateInput(key, Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(*options[key]))
        for target, channel in inputs.items():
            many = channel == "rgb"
            output = reader.CreateOutput(channel, Sdf.ValueTypeNames.Float3 if many else Sdf.ValueTypeNames.Float)
            kind = Sdf.ValueTypeNames.Color3f if many else Sdf.ValueTypeNames.Float
            surface.CreateInput(target, kind).ConnectToSource(output)
        return reader


def noise(height: int, width: int, channels: int, seed: int = 1) -> np.ndarray:
    shape = (height, width, channels) if channels > 1 else (height, width)
    return np.random.default_rng(seed).integers(0, 256, shape, dtype=np.uint8)


def pixels_of(texture: dict) -> np.ndarray:
    """RGBA, the first row on top."""
    values = np.frombuffer(base64.b64decode(texture["pixels"]), dtype=np.uint8)
    return values.reshape(texture["height"], texture["width"], 4)[::-1]


def material_of(prefab, name: str) -> dict:
    (material,) = prefab.named(name)["materials"]
    return prefab.assets[material]


def gamma(linear) -> np.ndarray:
    linear = np.asarray(linear, dtype=float)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-9) ** (1 / 2.4) - 0.055)


@each_pipeline
def test_constants(prefabs, tmp_path, pipeline):
    look = Look(tmp_path)
    look.material("Paint", diffuseColor=(0.2, 0.4, 0.6), roughness=0.3, metallic=0.7, clearcoat=0.5)
    look.material("Same", diffuseColor=(0.2, 0.4, 0.6), roughness=0.3, metallic=0.7, clearcoat=0.5)
    look.material("Bare")
    look.stage.Save()
    prefab = prefabs(look.path, pipeline=pipeline)
    paint = material_of(prefab, "Paint")
    assert paint["shader"] == PIPELINES[pipeline]
    assert paint["instancing"]
    assert paint["queue"] == -1
    assert paint["colors"][COLOR[pipeline]] == pytest.approx([*gamma([0.2, 0.4, 0.6]), 1], abs=1e-6)
    assert paint["floats"]["_Metallic"] == pytest.approx(0.7)
    assert paint["floats"][SMOOTHNESS[pipeline]] == pytest.approx(0.7)
    assert not paint["textures"]
    assert prefab.named("Same")["materials"] == prefab.named("Paint")["materials"]
    bare = material_of(prefab, "Bare")
    assert bare["colors"][COLOR[pipeline]] == pytest.approx([*gamma([0.18] * 3), 1], abs=1e-6)
    assert bare["floats"][SMOOTHNESS[pipeline]] == pytest.approx(0.5)
    assert (paint["floats"].get("_CoatMask") == pytest.approx(0.5)) == (pipeline == "HighDefinition")
    assert any("clearcoat" in warning for warning in prefab.found["warnings"]) == (pipeline != "HighDefinition")
    assert not material_of(prefabs(look.path, pipeline=pipeline, gpuInstancing=False), "Paint")["instancing"]


@pytest.mark.parametrize(
    ("project", "shader"), [("URP", PIPELINES["Universal"]), ("HDRP", PIPELINES["HighDefinition"])]
)
def test_the_project_s_pipeline_decides_where_the_settings_do_not(prefabs, tmp_path, project, shader):
    look = Look(tmp_path)
    look.material("Paint")
    look.stage.Save()
    assert material_of(prefabs(look.path, project=project), "Paint")["shader"] == shader
    assert material_of(prefabs(look.path), "Paint")["shader"] == "Standard"


@each_pipeline
def test_maps(prefabs, tmp_path, pipeline):
    """Occlusion, roughness and metallic in red, green and blue become metallic, occlusion and smoothness in theirs."""
    look = Look(tmp_path)
    packed, colour, normal = noise(4, 8, 3), noise(8, 8, 3, 2), noise(8, 4, 3, 3)
    surface = look.material("Floor")
    look.texture(surface, {"diffuseColor": "rgb"}, look.image("colour.png", colour), space="sRGB", scale=(0.5, 1, 1, 1))
    channels = {"occlusion": "r", "roughness": "g", "metallic": "b"}
    # which a reader shows without its file alone
    fallback = (0.1, 0.2, 0.3, 1)
    look.texture(surface, channels, look.image("packed.png", packed), space="raw", wrap="mirror", fallback=fallback)
    usual = {"scale": (2, 2, 2, 1), "bias": (-1, -1, -1, 0), "space": "raw", "wrap": "clamp"}
    look.texture(surface, {"normal": "rgb"}, look.image("normal.png", normal), **usual)
    look.stage.Save()
    prefab = prefabs(look.path, pipeline=pipeline)
    floor = material_of(prefab, "Floor")
    assert prefab.found["warnings"] == []
    assert floor["colors"][COLOR[pipeline]] == pytest.approx([*gamma([0.5, 1, 1]), 1], abs=1e-6)
    masks = {floor["textures"][name] for name in MASKS[pipeline]}
    (mask,) = (prefab.assets[name] for name in masks)
    expected = np.stack([packed[..., 2], packed[..., 0], 0 * packed[..., 0], 255 - packed[..., 1]], axis=2)
    assert np.array_equal(pixels_of(mask), expected)
    assert mask["linear"]
    assert mask["wrap"] == "Mirror Mirror"
    base, bumps = (prefab.assets[floor["textures"][names[pipeline]]] for names in (BASE, NORMAL))
    assert np.array_equal(pixels_of(base)[..., :3], colour)
    assert (base["linear"], base["wrap"]) == (False, "Repeat Repeat")
    assert np.array_equal(pixels_of(bumps)[..., :3], normal)
    assert (bumps["linear"], bumps["wrap"]) == (True, "Clamp Clamp")
    assert set(floor["keywords"]) >= MASK_KEYWORDS[pipeline] | {"_NORMALMAP"}
    for texture in (mask, base, bumps):
        assert texture["compressed"]
        assert texture["mipmaps"]
        # without its pixels it could not be saved
        assert texture["readable"]
    (mesh,) = (prefab.assets[prefab.named("Floor")["mesh"]],)
    assert mesh["tangents"] == mesh["vertexCount"] == 4
    # the smoothness is that of the map alone
    scale = {"BuiltIn": "_GlossMapScale", "Universal": "_Smoothness"}.get(pipeline)
    assert scale is None or floor["floats"][scale] == 1


def test_masks_of_several_files_and_sizes_scales_and_curves(prefabs, tmp_path):
    look = Look(tmp_path)
    rough, metal = noise(4, 4, 1), noise(8, 16, 1, 2)
    surface = look.material("Mixed", occlusion=0.25)
    scaled = {"scale": (0.5, 1, 1, 1), "bias": (0.25, 0, 0, 0), "space": "raw"}
    look.texture(surface, {"roughness": "r"}, look.image("rough.png", rough), **scaled)
    look.texture(surface, {"metallic": "r"}, look.image("metal.png", metal), space="sRGB")
    look.stage.Save()
    prefab = prefabs(look.path)
    mask = pixels_of(prefab.assets[material_of(prefab, "Mixed")["textures"]["_MetallicGlossMap"]])
    assert mask.shape == (8, 16, 4)
    level = metal / 255
    linear = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
    assert np.abs(mask[..., 0] - 255 * linear).max() <= 0.5001
    assert (mask[..., 1] == 64).all()
    smooth = 1 - (np.repeat(np.repeat(rough, 2, axis=0), 4, axis=1) / 255 * 0.5 + 0.25)
    assert np.abs(mask[..., 3] - 255 * smooth).max() <= 0.5001


@each_pipeline
@pytest.mark.parametrize(
    ("inputs", "kind"),
    [
        ({"opacity": 0.4}, "glass"),
        ({"opacity": 0.4, "opacityMode": "presence"}, "fade"),
        ({"opacity": 0.4, "opacityThreshold": 0.3}, "cutout"),
        ({"opacity": 1.0, "opacityThreshold": 0.3}, "opaque"),
    ],
)
def test_opacity(prefabs, tmp_path, pipeline, inputs, kind):
    look = Look(tmp_path)
    look.material("Pane", diffuseColor=(1, 1, 1), **inputs)
    look.stage.Save()
    pane = material_of(prefabs(look.path, pipeline=pipeline), "Pane")
    assert pane["colors"][COLOR[pipeline]][3] == pytest.approx(inputs["opacity"])
    assert pane["queue"] == {"glass": 3000, "fade": 3000, "cutout": 2450, "opaque": -1}[kind]
    words = set(pane["keywords"]) - {"_NORMALMAP_TANGENT_SPACE"}
    keywords = {
        "BuiltIn": {"glass": {"_ALPHAPREMULTIPLY_ON"}, "fade": {"_ALPHABLEND_ON"}},
        "Universal": {
            "glass": {"_ALPHAPREMULTIPLY_ON", "_SURFACE_TYPE_TRANSPARENT"},
            "fade": {"_SURFACE_TYPE_TRANSPARENT"},
        },
        "HighDefinition": {
            "glass": {
                "_SURFACE_TYPE_TRANSPARENT",
                "_ENABLE_FOG_ON_TRANSPARENT",
                "_BLENDMODE_ALPHA",
                "_BLENDMODE_PRESERVE_SPECULAR_LIGHTING",
            },
            "fade": {"_SURFACE_TYPE_TRANSPARENT", "_ENABLE_FOG_ON_TRANSPARENT", "_BLENDMODE_ALPHA"},
        },
    }
    assert words == {"cutout": {"_ALPHATEST_ON"}, "opaque": set(), **keywords[pipeline]}[kind]
    if kind in {"glass", "fade"}:
        one_minus_source_alpha, source_alpha = 10, 5
        premultiplied = kind == "glass" or pipeline == "HighDefinition"
        assert pane["floats"]["_SrcBlend"] == (1 if premultiplied else source_alpha)
        assert pane["floats"]["_DstBlend"] == one_minus_source_alpha
        assert pane["floats"]["_ZWrite"] == 0
    if kind == "cutout":
        name = "_AlphaCutoff" if pipeline == "HighDefinition" else "_Cutoff"
        assert pane["floats"][name] == pytest.approx(0.3)


def test_alpha_of_the_color_s_own_file_and_of_another(prefabs, tmp_path):
    look = Look(tmp_path)
    own, mask = noise(8, 8, 4), noise(4, 4, 1, 5)
    stain = look.material("Stain", opacityMode="presence")
    look.texture(stain, {"diffuseColor": "rgb", "opacity": "a"}, look.image("own.png", own))
    leaf = look.material("Leaf", opacityThreshold=0.5)
    look.texture(leaf, {"diffuseColor": "rgb"}, look.image("leaf.png", own[..., :3].copy()))
    look.texture(leaf, {"opacity": "r"}, look.image("mask.png", mask), scale=(0.5, 1, 1, 1))
    veil = look.material("Veil", diffuseColor=(0, 0, 1))
    look.texture(veil, {"opacity": "r"}, look.image("veil.png", mask))
    look.stage.Save()
    prefab = prefabs(look.path)
    textures = {
        name: prefab.assets[material_of(prefab, name)["textures"]["_MainTex"]] for name in ("Stain", "Leaf", "Veil")
    }
    assert np.array_equal(pixels_of(textures["Stain"]), own)
    pixels = pixels_of(textures["Leaf"])
    assert np.array_equal(pixels[..., :3], own[..., :3])
    assert np.abs(pixels[..., 3] - np.repeat(np.repeat(mask, 2, axis=0), 2, axis=1) * 0.5).max() <= 0.5001
    assert np.array_equal(pixels_of(textures["Veil"])[..., 3], mask)
    assert (pixels_of(textures["Veil"])[..., :3] == 255).all()
    assert material_of(prefab, "Veil")["colors"]["_Color"] == pytest.approx([0, 0, 1, 1])


@pytest.mark.parametrize("bits", [1, 2, 4, 8])
def test_indexed_images_with_alpha(prefabs, tmp_path, bits):
    look = Look(tmp_path)
    image = Image.fromarray(noise(8, 7, 4)).quantize(2**bits if bits < 8 else 64)
    image.save(tmp_path / "few.png")
    surface = look.material("Few")
    look.texture(surface, {"diffuseColor": "rgb", "opacity": "a"}, "./few.png")
    look.stage.Save()
    prefab = prefabs(look.path)
    pixels = pixels_of(prefab.assets[material_of(prefab, "Few")["textures"]["_MainTex"]])
    assert np.array_equal(pixels, np.array(image.convert("RGBA")))


@each_pipeline
def test_emission(prefabs, tmp_path, pipeline):
    look = Look(tmp_path)
    surface = look.material("Lamp", diffuseColor=(0, 0, 0), emissiveColor=(14.0, 13.5, 12.0))
    panel = look.material("Screen")
    look.texture(panel, {"emissiveColor": "rgb"}, look.image("screen.png", noise(4, 4, 3)), scale=(3, 2, 1, 1))
    look.stage.Save()
    assert surface
    prefab = prefabs(look.path, pipeline=pipeline, exposureStops=1, nitsPerUnit=27)
    factor = 2 * 27 if pipeline == "HighDefinition" else 2
    lamp, screen = (material_of(prefab, name) for name in ("Lamp", "Screen"))
    # linear, as properties of a high dynamic range are
    assert lamp["colors"][EMISSION[pipeline]] == pytest.approx([14 * factor, 13.5 * factor, 12 * factor, 1])
    assert screen["colors"][EMISSION[pipeline]] == pytest.approx([3 * factor, 2 * factor, factor, 1])
    map_name = "_EmissiveColorMap" if pipeline == "HighDefinition" else "_EmissionMap"
    assert prefab.assets[screen["textures"][map_name]]["name"] == "screen.png"
    for material in (lamp, screen):
        assert material["illumination"] == "BakedEmissive"
    keyword = "_EMISSIVE_COLOR_MAP" if pipeline == "HighDefinition" else "_EMISSION"
    assert keyword in screen["keywords"]


def test_maps_of_normals_that_are_not_the_usual_ones(prefabs, tmp_path):
    look = Look(tmp_path)
    pixels = noise(4, 4, 3)
    flipped = look.material("Flipped")
    look.texture(flipped, {"normal": "rgb"}, look.image("a.png", pixels), scale=(2, -2, 2, 1), bias=(-1, 1, -1, 0))
    bare = look.material("Bare")
    look.texture(bare, {"normal": "rgb"}, look.image("b.png", pixels))
    look.stage.Save()
    prefab = prefabs(look.path)
    found = {
        name: pixels_of(prefab.assets[material_of(prefab, name)["textures"]["_BumpMap"]])
        for name in ("Flipped", "Bare")
    }
    assert np.array_equal(found["Flipped"][..., [0, 2]], pixels[..., [0, 2]])
    assert np.array_equal(found["Flipped"][..., 1], 255 - pixels[..., 1])
    assert np.array_equal(found["Bare"][..., :3], pixels)
    (warning,) = prefab.found["warnings"]
    assert "without scale and bias" in warning


def test_coordinates(prefabs, tmp_path):
    look = Look(tmp_path)
    surface = look.material("Tiled", primvars=("st", "other"))
    reader = look.texture(surface, {"diffuseColor": "rgb"}, look.image("tile.png", noise(4, 4, 3)))
    path = surface.GetPath().GetParentPath()
    primvar = UsdShade.Shader.Define(look.stage, path.AppendChild("Primvar"))
    primvar.CreateIdAttr("UsdPrimvarReader_float2")
    primvar.CreateInput("varname", Sdf.ValueTypeNames.String).Set("other")
    moved = UsdShade.Shader.Define(look.stage, path.AppendChild("Moved"))
    moved.CreateIdAttr("UsdTransform2d")
    moved.CreateInput("scale", Sdf.ValueTypeNames.Float2).Set((3, 4))
    moved.CreateInput("translation", Sdf.ValueTypeNames.Float2).Set((0.5, 0.25))
    moved.CreateInput("in", Sdf.ValueTypeNames.Float2).ConnectToSource(primvar.ConnectableAPI(), "result")
    reader.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(moved.ConnectableAPI(), "result")
    look.material("Plain", primvars=("st", "other"))
    look.stage.Save()
    prefab = prefabs(look.path)
    assert material_of(prefab, "Tiled")["coordinates"]["_MainTex"] == [3, 4, 0.5, 0.25]
    tiled, plain = (prefab.assets[prefab.named(name)["mesh"]] for name in ("Tiled", "Plain"))
    # the material's own primvar, and no V turned over
    assert sorted(map(tuple, np.reshape(tiled["uv"], (-1, 2)))) == [(5, 0), (5, 2), (6, 0), (6, 2)]
    assert sorted(map(tuple, np.reshape(plain["uv"], (-1, 2)))) == [(0, 0), (0, 2), (1, 0), (1, 2)]


def test_what_cannot_be_shown_is_reported(prefabs, tmp_path):
    look = Look(tmp_path)
    look.texture(look.material("Gone"), {"diffuseColor": "rgb"}, "./gone.png", fallback=(1, 0, 0, 1))
    (tmp_path / "deep.exr").write_bytes(b"\x76\x2f\x31\x01 no image that Unity reads from bytes")
    look.texture(look.material("Deep"), {"diffuseColor": "rgb"}, "./deep.exr")
    look.texture(look.material("Black"), {"diffuseColor": "rgb"}, look.image("b.png", noise(4, 4, 3)), wrap="black")
    look.material("Shiny", useSpecularWorkflow=1.0)
    look.stage.Save()
    prefab = prefabs(look.path)
    assert material_of(prefab, "Gone")["colors"]["_Color"] == pytest.approx([1, 0, 0, 1], abs=1e-6)
    text = "\n".join(prefab.found["warnings"])
    for words in ("gone.png", "deep.exr", "clamped", "specular workflow"):
        assert words in text
    assert [line for line in prefab.found["inspector"] if line.startswith("! ")] == [
        f"! {warning.partition(': ')[2]}" for warning in prefab.found["warnings"]
    ]


def test_meshes_without_materials_have_their_display_color(prefabs, tmp_path):
    look = Look(tmp_path)
    mesh = UsdGeom.Mesh.Define(look.stage, "/Plain")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 1, 0)])
    mesh.CreateFaceVertexCountsAttr([3])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    mesh.CreateDisplayColorAttr([(0.1, 0.2, 0.3)])
    mesh.CreateDoubleSidedAttr(True)
    look.stage.Save()
    prefab = prefabs(look.path)
    assert material_of(prefab, "Plain")["colors"]["_Color"] == pytest.approx([*gamma([0.1, 0.2, 0.3]), 1], abs=1e-6)
    both = prefab.assets[prefab.named("Plain")["mesh"]]
    # a back for the front, as no pipeline but HDRP has a material that shows both
    assert both["vertexCount"] == 6
    points, normals = (np.array(both[key]).reshape(-1, 3) for key in ("vertices", "normals"))
    a, b, c = np.array(both["parts"][0]).reshape(-1, 3).T
    facing = np.cross(points[b] - points[a], points[c] - points[a])
    assert (np.einsum("ij,ij->i", facing, normals[a]) > 0).all()
    assert sorted(facing[:, 2]) == pytest.approx([-1, 1])


def test_subsets_have_materials_of_their_own(prefabs, tmp_path):
    look = Look(tmp_path)
    look.material("Both", diffuseColor=(1, 0, 0))
    look.material("Second", diffuseColor=(0, 1, 0))
    mesh = UsdGeom.Mesh.Get(look.stage, "/Both")
    mesh.GetFaceVertexCountsAttr().Set([3, 3])
    mesh.GetFaceVertexIndicesAttr().Set([0, 1, 2, 0, 2, 3])
    subset = UsdGeom.Subset.CreateGeomSubset(mesh, "Part", "face", Vt.IntArray([1]), "materialBind")
    UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(UsdShade.Material.Get(look.stage, "/SecondLook"))
    look.stage.Save()
    prefab = prefabs(look.path)
    item = prefab.named("Both")
    assert [len(part) for part in prefab.assets[item["mesh"]]["parts"]] == [3, 3]
    colors = [prefab.assets[name]["colors"]["_Color"] for name in item["materials"]]
    assert np.allclose(colors, [[1, 0, 0, 1], [0, 1, 0, 1]])


def test_transforms_of_coordinates_in_a_row(prefabs, tmp_path):
    """The reader's coordinates go through the transform next to it first."""
    look = Look(tmp_path)
    surface = look.material("Tiled")
    texture = look.texture(surface, {"emissiveColor": "rgb"}, look.image("tile.png", noise(4, 4, 3)))
    path = surface.GetPath().GetParentPath()
    shader = UsdShade.Shader.Define(look.stage, path.AppendChild("Primvar"))
    shader.CreateIdAttr("UsdPrimvarReader_float2")
    shader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    for name, scale, translation in (("Inner", (3, 4), (0.5, 0.25)), ("Outer", (2, -1), (1, 7))):
        moved = UsdShade.Shader.Define(look.stage, path.AppendChild(name))
        moved.CreateIdAttr("UsdTransform2d")
        moved.CreateInput("scale", Sdf.ValueTypeNames.Float2).Set(scale)
        moved.CreateInput("translation", Sdf.ValueTypeNames.Float2).Set(translation)
        output = shader.CreateOutput("result", Sdf.ValueTypeNames.Float2)
        moved.CreateInput("in", Sdf.ValueTypeNames.Float2).ConnectToSource(output)
        shader = moved
    output = shader.CreateOutput("result", Sdf.ValueTypeNames.Float2)
    texture.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(output)
    look.stage.Save()
    for pipeline in PIPELINES:
        material = material_of(prefabs(look.path, pipeline=pipeline), "Tiled")
        # 2 (3 u + 0.5) + 1 and -(4 v + 0.25) + 7
        maps = {BASE[pipeline], "_EmissiveColorMap"} & material["coordinates"].keys()
        assert maps
        for name in maps:
            assert material["coordinates"][name] == pytest.approx([6, -4, 2, 6.75])


def test_what_a_material_cannot_say_is_named(prefabs, tmp_path):
    look = Look(tmp_path)
    for key, value in (("ior", 1.3), ("displacement", 0.1), ("clearcoat", 1.0)):
        look.material(key, **{key: value})
    look.material("rough", clearcoat=1.0, clearcoatRoughness=0.4)
    tilted = look.material("tilted")
    tilted.CreateInput("normal", Sdf.ValueTypeNames.Normal3f).Set((1, 0, 1))
    lacking = look.material("lacking", primvars=("other",))
    look.texture(lacking, {"diffuseColor": "r", "roughness": "rgb"}, look.image("a.png", noise(4, 4, 3)))
    colored = look.material("colored")
    reader = UsdShade.Shader.Define(look.stage, "/coloredLook/Reader")
    reader.CreateIdAttr("UsdPrimvarReader_float3")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("paint")
    reader.CreateInput("fallback", Sdf.ValueTypeNames.Float3).Set((0, 1, 0))
    output = reader.CreateOutput("result", Sdf.ValueTypeNames.Float3)
    colored.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).ConnectToSource(output)
    look.stage.Save()
    prefab = prefabs(look.path, pipeline="HighDefinition")
    text = "\n".join(prefab.found["warnings"])
    for words, place in (
        ("the index of refraction is taken for 1.5", "/iorLook"),
        ("displacement is left out", "/displacementLook"),
        ("the roughness of clearcoats is left out", "/roughLook"),
        ("constant normals are left out", "/tiltedLook"),
        ("meshes lack the texture coordinates", "/lacking"),
        ("a color reads all channels", "/lackingLook.diffuseColor"),
        ("a number reads red", "/lackingLook.roughness"),
        ("do not read primvars", "/coloredLook.diffuseColor"),
    ):
        (line,) = [line for line in text.splitlines() if words in line]
        assert place in line
    # a reader's own value stands for the primvar that is not read
    assert material_of(prefab, "colored")["colors"]["_BaseColor"] == pytest.approx([0, 1, 0, 1])
