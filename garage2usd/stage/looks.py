"""Materials as UsdPreviewSurface networks."""

from pxr import Gf, Sdf, Usd, UsdShade

from garage2usd.assets import Material

__all__ = ["PACKED_CHANNELS", "TEXTURE_FOLDER", "define_material", "set_varying"]

TEXTURE_FOLDER = "textures"
"""Folder of the textures beside the assets that use them."""
PACKED_CHANNELS = {"r": "occlusion", "g": "roughness", "b": "metallic"}
"""What each channel of a packed texture is to the surface."""


def define_material(
    stage: Usd.Stage, path: Sdf.Path, material: Material, *, varying: bool = False
) -> UsdShade.Material:
    """Author one material at `path` with its surface, its texture readers and their shared coordinate reader.

    A varying one takes what `set_varying` sets from the variants of its asset.
    """
    look = UsdShade.Material.Define(stage, path)
    surface = UsdShade.Shader.Define(stage, path.AppendChild("Surface"))
    surface.CreateIdAttr("UsdPreviewSurface")
    surface_output = surface.CreateOutput("surface", Sdf.ValueTypeNames.Token)
    look.CreateSurfaceOutput().ConnectToSource(surface_output)

    if not varying:
        _bind_colour(stage, path, surface, material)
        _bind_finish(stage, path, surface, material)
    if material.normal_texture is not None:
        reader = _texture(stage, path, "NormalTexture", material.normal_texture, "raw")
        # an 8-bit normal map holds (n + 1) / 2
        reader.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(2, 2, 2, 1))
        reader.CreateInput("bias", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(-1, -1, -1, 0))
        output = reader.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)
        surface.CreateInput("normal", Sdf.ValueTypeNames.Normal3f).ConnectToSource(output)
    if not material.has_alpha:
        surface.CreateInput("opacity", Sdf.ValueTypeNames.Float).Set(material.opacity)
    surface.CreateInput("clearcoat", Sdf.ValueTypeNames.Float).Set(material.clearcoat)
    if material.ior is not None:
        surface.CreateInput("ior", Sdf.ValueTypeNames.Float).Set(material.ior)
    if any(material.emissive_rgb):
        surface.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*material.emissive_rgb))
    return look


def set_varying(stage: Usd.Stage, path: Sdf.Path, material: Material) -> None:
    """Author what a variant decides of the material at `path`, at the stage's edit target."""
    surface = UsdShade.Shader(stage.OverridePrim(path.AppendChild("Surface")))
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*material.colour_rgb))
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(material.roughness)
    surface.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(material.metallic)


def _bind_colour(stage: Usd.Stage, path: Sdf.Path, surface: UsdShade.Shader, material: Material) -> None:
    colour = surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    if material.colour_texture is None:
        colour.Set(Gf.Vec3f(*material.colour_rgb))
        return
    reader = _texture(stage, path, "ColourTexture", material.colour_texture, "sRGB")
    colour.ConnectToSource(reader.CreateOutput("rgb", Sdf.ValueTypeNames.Float3))
    if material.has_alpha:
        alpha = reader.CreateOutput("a", Sdf.ValueTypeNames.Float)
        surface.CreateInput("opacity", Sdf.ValueTypeNames.Float).ConnectToSource(alpha)
        # where there is nothing, nothing shines either
        surface.CreateInput("opacityMode", Sdf.ValueTypeNames.Token).Set("presence")


def _bind_finish(stage: Usd.Stage, path: Sdf.Path, surface: UsdShade.Shader, material: Material) -> None:
    if material.packed_texture is None:
        surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(material.roughness)
        surface.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(material.metallic)
        return
    reader = _texture(stage, path, "PackedTexture", material.packed_texture, "raw")
    for channel, name in PACKED_CHANNELS.items():
        output = reader.CreateOutput(channel, Sdf.ValueTypeNames.Float)
        surface.CreateInput(name, Sdf.ValueTypeNames.Float).ConnectToSource(output)


def _texture(stage: Usd.Stage, path: Sdf.Path, name: str, file: str, colour_space: str) -> UsdShade.Shader:
    reader = UsdShade.Shader.Define(stage, path.AppendChild(name))
    reader.CreateIdAttr("UsdUVTexture")
    reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(Sdf.AssetPath(f"./{TEXTURE_FOLDER}/{file}"))
    reader.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set(colour_space)
    for axis in ("wrapS", "wrapT"):
        reader.CreateInput(axis, Sdf.ValueTypeNames.Token).Set("repeat")
    reader.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(_coordinates(stage, path))
    return reader


def _coordinates(stage: Usd.Stage, path: Sdf.Path) -> UsdShade.Output:
    reader = UsdShade.Shader.Define(stage, path.AppendChild("Coordinates"))
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    return reader.CreateOutput("result", Sdf.ValueTypeNames.Float2)
