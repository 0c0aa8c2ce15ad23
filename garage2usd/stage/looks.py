"""Looks of assets: materials as UsdPreviewSurface networks, display colours, and texture files named by content."""

import hashlib
import posixpath
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from pxr import Gf, Sdf

from garage2usd.assets import (
    Asset,
    Finish,
    Material,
    NonVisual,
    OwnTexture,
    PaintedTexture,
    Part,
    Rgb,
    StoredTexture,
    Texture,
    finished,
    pascal_case,
)
from garage2usd.assets.colours import material_colour
from garage2usd.assets.own_textures import own_file
from garage2usd.assets.textures import texture_folder
from garage2usd.assets.textures.paints import painted
from garage2usd.config.outputs import TextureQuality
from garage2usd.scenes.prims import FINISH, LABELS_SCHEMA, labels_name
from garage2usd.stage.authoring import apply_schemas, attribute, connect, define, words

TEXTURE_FOLDER = "textures"
"""Folder of the textures beside the assets that use them."""
PACKED_CHANNELS = {"r": "occlusion", "g": "roughness", "b": "metallic"}
"""Surface property in each channel of a packed texture."""
_MATERIAL_TAXONOMY = "material"
"""Taxonomy of the substances of materials, in addition to the classes of objects."""
_NON_VISUAL = "omni:simready:nonvisual"
"""Namespace of SimReady's attributes for LiDAR, radar and ultrasonic sensors."""
_UNTINTED = (1.0, 1.0, 1.0)
_TYPES = Sdf.ValueTypeNames
_DIGITS = 16
"""Hexadecimal digits of SHA-256 in a name; the chance of a collision among a million files is 3e-8."""


def define_material(
    layer: Sdf.Layer,
    path: Sdf.Path,
    material: Material,
    *,
    non_visual: NonVisual,
    finish: str = "",
    varies: bool = False,
    is_switched: bool = False,
) -> None:
    """Author a material at `path` with its surface, its texture readers and their shared coordinate reader.

    Parameters
    ----------
    layer, path
        Layer and path of the material.
    material
        The material; its textures are paths relative to the layer.
    non_visual
        Its properties for LiDAR, radar and ultrasonic sensors.
    finish
        Key of the material that defines its substance, if this differs from its name.
    varies
        True if variants set its colour and finish, by `set_varying`.
    is_switched
        True if variants set its emission, by `set_glow`.
    """
    look = define(layer, path, "Material")
    label_material(look, non_visual.base)
    if finish:
        attribute(look, FINISH, _TYPES.Token, pascal_case(finish), uniform=True)
    attribute(look, f"{_NON_VISUAL}:base", _TYPES.Token, non_visual.base)
    attribute(look, f"{_NON_VISUAL}:coating", _TYPES.Token, non_visual.coating)
    words(look, f"{_NON_VISUAL}:attributes", non_visual.attributes)
    surface = _shader(layer, path.AppendChild("Surface"), "UsdPreviewSurface")
    connect(look, "outputs:surface", _TYPES.Token, attribute(surface, "outputs:surface", _TYPES.Token))
    if not varies:
        _author_colour(surface, path, material)
        _author_finish(surface, path, material)
    if material.normal_texture is not None:
        reader = _reader(layer, path, "NormalTexture", material.normal_texture, "raw", material.wraps)
        # an 8-bit normal map stores (n + 1) / 2
        attribute(reader, "inputs:scale", _TYPES.Float4, Gf.Vec4f(2, 2, 2, 1))
        attribute(reader, "inputs:bias", _TYPES.Float4, Gf.Vec4f(-1, -1, -1, 0))
        connect(surface, "inputs:normal", _TYPES.Normal3f, attribute(reader, "outputs:rgb", _TYPES.Float3))
    if not material.has_alpha:
        attribute(surface, "inputs:opacity", _TYPES.Float, material.opacity)
    attribute(surface, "inputs:clearcoat", _TYPES.Float, material.clearcoat)
    if material.ior is not None:
        attribute(surface, "inputs:ior", _TYPES.Float, material.ior)
    if any(material.emissive_rgb):
        # local opinions are stronger than variants
        set_glow(surface, None if is_switched else material.emissive_rgb)


def label_material(material: Sdf.PrimSpec, base: str, *schemas: str) -> None:
    """Label a material with its substance, in addition to its other schemas."""
    apply_schemas(material, *schemas, f"{LABELS_SCHEMA}:{_MATERIAL_TAXONOMY}")
    words(material, labels_name(_MATERIAL_TAXONOMY), [base])


def set_varying(surface: Sdf.PrimSpec, material: Material) -> None:
    """Author the inputs of a surface that depend on a variant."""
    attribute(surface, "inputs:diffuseColor", _TYPES.Color3f, Gf.Vec3f(*material.colour_rgb))
    _author_plain_finish(surface, material)


def set_glow(surface: Sdf.PrimSpec, radiance_rgb: tuple[float, float, float] | None) -> None:
    """Author the emission of a surface; None leaves it to variants."""
    value = None if radiance_rgb is None else Gf.Vec3f(*radiance_rgb)
    attribute(surface, "inputs:emissiveColor", _TYPES.Color3f, value)


def _author_colour(surface: Sdf.PrimSpec, path: Sdf.Path, material: Material) -> None:
    if material.colour_texture is None:
        attribute(surface, "inputs:diffuseColor", _TYPES.Color3f, Gf.Vec3f(*material.colour_rgb))
        return
    colour = attribute(surface, "inputs:diffuseColor", _TYPES.Color3f)
    reader = _reader(surface.layer, path, "ColourTexture", material.colour_texture, "sRGB", material.wraps)
    if material.tint_rgb != _UNTINTED:
        attribute(reader, "inputs:scale", _TYPES.Float4, Gf.Vec4f(*material.tint_rgb, 1))
    colour.connectionPathList.explicitItems = [attribute(reader, "outputs:rgb", _TYPES.Float3).path]
    if material.has_alpha:
        connect(surface, "inputs:opacity", _TYPES.Float, attribute(reader, "outputs:a", _TYPES.Float))
        # no specular reflection where the surface is cut out
        attribute(surface, "inputs:opacityMode", _TYPES.Token, "presence")


def _author_finish(surface: Sdf.PrimSpec, path: Sdf.Path, material: Material) -> None:
    if material.packed_texture is None:
        _author_plain_finish(surface, material)
        return
    reader = _reader(surface.layer, path, "PackedTexture", material.packed_texture, "raw", material.wraps)
    for channel, name in PACKED_CHANNELS.items():
        output = attribute(reader, f"outputs:{channel}", _TYPES.Float)
        connect(surface, f"inputs:{name}", _TYPES.Float, output)


def _author_plain_finish(surface: Sdf.PrimSpec, material: Material) -> None:
    attribute(surface, "inputs:roughness", _TYPES.Float, material.roughness)
    attribute(surface, "inputs:metallic", _TYPES.Float, material.metallic)


def _reader(
    layer: Sdf.Layer, path: Sdf.Path, name: str, file: Texture, colour_space: str, wraps: tuple[str, str]
) -> Sdf.PrimSpec:
    """Author a reader of a texture file."""
    reader = _shader(layer, path.AppendChild(name), "UsdUVTexture")
    attribute(reader, "inputs:file", _TYPES.Asset, Sdf.AssetPath(str(file)))
    attribute(reader, "inputs:sourceColorSpace", _TYPES.Token, colour_space)
    for axis, mode in zip(("wrapS", "wrapT"), wraps, strict=True):
        attribute(reader, f"inputs:{axis}", _TYPES.Token, mode)
    connect(reader, "inputs:st", _TYPES.Float2, _coordinates(layer, path.AppendChild("Coordinates")))
    return reader


def _coordinates(layer: Sdf.Layer, path: Sdf.Path) -> Sdf.AttributeSpec:
    """Output of the material's coordinate reader, which all texture readers share."""
    result = layer.GetAttributeAtPath(path.AppendProperty("outputs:result"))
    if result:
        return result
    reader = _shader(layer, path, "UsdPrimvarReader_float2")
    attribute(reader, "inputs:varname", _TYPES.String, "st")
    return attribute(reader, "outputs:result", _TYPES.Float2)


def _shader(layer: Sdf.Layer, path: Sdf.Path, identifier: str) -> Sdf.PrimSpec:
    shader = define(layer, path, "Shader")
    attribute(shader, "info:id", _TYPES.Token, identifier, uniform=True)
    return shader


def display_colour(asset: Asset, finishes: Mapping[str, Finish]) -> Rgb:
    """Linear colour of the material that covers most of an asset's surface."""
    areas_m2 = dict.fromkeys((part.material for part in asset.parts), 0.0)
    if len(areas_m2) > 1:
        for part in asset.parts:
            areas_m2[part.material] += _area_m2(part)
    most = max(areas_m2, key=areas_m2.__getitem__)
    return material_colour(finished(most, finishes).material)


def _area_m2(part: Part) -> float:
    """Total area in square metres of a part's faces, each a fan of triangles around its first corner."""
    counts = part.face_counts
    corners = part.points[part.face_indices].astype(np.float64)
    starts = np.cumsum(counts) - counts
    first = np.repeat(corners[starts], counts, axis=0)
    crosses = np.cross(corners[:-1] - first[:-1], corners[1:] - first[1:])
    follows = np.repeat(np.arange(len(counts)), counts)
    inner = follows[:-1] == follows[1:]
    sums = np.zeros((len(counts), 3))
    np.add.at(sums, follows[:-1][inner], crosses[inner])
    return float(np.linalg.norm(sums, axis=1).sum() / 2)


class NamedFile(NamedTuple):
    """A file named by its content."""

    name: str
    data: bytes


def content_name(stem: str, data: bytes, suffix: str) -> str:
    """Name a file by its content: `stem`, the beginning of its SHA-256, and `suffix`."""
    return f"{stem}_{hashlib.sha256(data).hexdigest()[:_DIGITS]}{suffix}"


@lru_cache(maxsize=256)
def texture_file(texture: Texture, quality: TextureQuality) -> NamedFile:
    """Load a texture of the package or of the user in a quality, or derive it from one; cached per process.

    Raises
    ------
    ConfigError
        If a texture of the user is invalid.
    """
    if isinstance(texture, OwnTexture):
        data, suffix = own_file(texture, quality)
        return NamedFile(content_name(f"own_{texture.role}_{texture.use}", data, suffix), data)
    if isinstance(texture, StoredTexture):
        return NamedFile(content_name(texture.stem, texture.data, texture.suffix), texture.data)
    path = texture_folder(quality) / (texture.mask if isinstance(texture, PaintedTexture) else texture)
    data = path.read_bytes()
    if isinstance(texture, PaintedTexture):
        data = painted(data, texture.paint_rgb, texture.ground_rgb)
    return NamedFile(content_name(path.stem, data, path.suffix), data)


def textures_of(
    materials: Iterable[str], finishes: Mapping[str, Finish], quality: TextureQuality
) -> tuple[NamedFile, ...]:
    """List the textures of materials, by the materials' keys, with the given finishes; each once, sorted by name."""
    used = {texture for key in materials for texture in finished(key, finishes).material.textures()}
    return tuple(sorted({texture_file(texture, quality) for texture in used}))


def named_textures(material: Material, quality: TextureQuality, *, folder: str = "") -> Material:
    """Replace the textures of a material by their names from `texture_file`, or by paths if a folder is given."""

    def name(texture: Texture | None) -> str | None:
        return None if texture is None else posixpath.join(folder, texture_file(texture, quality).name)

    return replace(
        material,
        colour_texture=name(material.colour_texture),
        packed_texture=name(material.packed_texture),
        normal_texture=name(material.normal_texture),
    )
