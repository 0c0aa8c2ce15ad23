"""Materials of a stage as the few values that surfaces take which know no networks of shaders."""

import math
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from pxr import Sdf, Usd, UsdShade

from garage2usd.reading.values import READ_AT, number_of, numbers_of

__all__ = ["PLAIN", "SurfaceLook", "stands_alone", "surface_of"]

Rgb = tuple[float, float, float]
_PREVIEW = "UsdPreviewSurface"
_BRIGHTEST = 1e4
_DEFAULT_ROUGHNESS = 0.5


@dataclass(frozen=True)
class SurfaceLook:
    """A surface.

    Attributes
    ----------
    colour_rgb, emissive_rgb
        Linear.
    roughness, metallic, opacity, clearcoat
        0 to 1.
    colour_texture, roughness_texture, metallic_texture, normal_texture, occlusion_texture
        Resolved asset paths, empty for none.
    roughness_channel, metallic_channel, occlusion_channel
        Which channel of its texture each is: 0 to 3.
    has_alpha
        Whether the colour texture's alpha is the opacity.
    opacity_threshold
        What is less opaque is not drawn, and all else is opaque; 0 where all is drawn as opaque as it is.
    coordinate_name
        Primvar of the texture coordinates.
    name
        Of the material, empty for none; two materials of other names that look alike are equal.
    """

    colour_rgb: Rgb = (0.5, 0.5, 0.5)
    emissive_rgb: Rgb = (0.0, 0.0, 0.0)
    roughness: float = _DEFAULT_ROUGHNESS
    metallic: float = 0.0
    opacity: float = 1.0
    clearcoat: float = 0.0
    colour_texture: str = ""
    roughness_texture: str = ""
    roughness_channel: int = 0
    metallic_texture: str = ""
    metallic_channel: int = 0
    normal_texture: str = ""
    occlusion_texture: str = ""
    occlusion_channel: int = 0
    has_alpha: bool = False
    opacity_threshold: float = 0.0
    coordinate_name: str = "st"
    name: str = field(default="", compare=False)

    @property
    def is_blended(self) -> bool:
        """Whether what lies behind it shows."""
        return self.has_alpha or self.opacity < 1


PLAIN = SurfaceLook()
"""What has no material."""


def surface_of(material: UsdShade.Material) -> SurfaceLook:
    """What a material's UsdPreviewSurface says; `PLAIN` where it has none."""
    found, _, _ = material.ComputeSurfaceSource()
    if not found or found.GetIdAttr().Get() != _PREVIEW:
        return PLAIN
    shader = _Shader(found, frozenset(found.GetPrim().GetAuthoredPropertyNames()))
    colour, colour_reader, _ = _colour(shader, "diffuseColor", (0.18, 0.18, 0.18))
    emissive, _, _ = _colour(shader, "emissiveColor", (0.0, 0.0, 0.0))
    roughness, roughness_reader, channel = _number(shader, "roughness", _DEFAULT_ROUGHNESS)
    metallic, metallic_reader, metallic_channel = _number(shader, "metallic", 0.0)
    opacity, opacity_reader, _ = _number(shader, "opacity", 1.0)
    threshold, _, _ = _number(shader, "opacityThreshold", 0.0)
    clearcoat, _, _ = _number(shader, "clearcoat", 0.0)
    _, normal_reader, _ = shader.input("normal")
    _, occlusion_reader, occlusion_channel = _number(shader, "occlusion", 1.0)
    return SurfaceLook(
        colour_rgb=colour,
        emissive_rgb=emissive,
        roughness=roughness,
        metallic=metallic,
        opacity=opacity,
        clearcoat=clearcoat,
        colour_texture=_file(colour_reader),
        roughness_texture=_file(roughness_reader),
        roughness_channel=channel,
        metallic_texture=_file(metallic_reader),
        metallic_channel=metallic_channel,
        normal_texture=_file(normal_reader),
        occlusion_texture=_file(occlusion_reader),
        occlusion_channel=occlusion_channel,
        has_alpha=opacity_reader is not None,
        opacity_threshold=threshold,
        coordinate_name=_coordinate_name(colour_reader or roughness_reader or normal_reader),
        name=material.GetPrim().GetName(),
    )


def stands_alone(material: UsdShade.Material) -> bool:
    """Whether what a material says depends on nothing but itself and what is below it."""
    prim = material.GetPrim()
    connected = (given for part in Usd.PrimRange(prim) for given in part.GetAuthoredAttributes())
    sources = (source for given in connected for source in given.GetConnections())
    return all(source.HasPrefix(prim.GetPath()) for source in sources)


class _Shader(NamedTuple):
    """A shader and the names of what it says."""

    shader: UsdShade.Shader
    said: frozenset[str]

    def input(self, name: str) -> tuple[Usd.Attribute | None, UsdShade.Shader | None, int]:
        """As `_input`; most inputs of most shaders are as they are by default."""
        return _input(self.shader, name) if f"inputs:{name}" in self.said else (None, None, 0)


def _colour(shader: _Shader, name: str, default: Rgb) -> tuple[Rgb, UsdShade.Shader | None, int]:
    given, reader, channel = shader.input(name)
    if reader is not None:
        return (1.0, 1.0, 1.0), reader, channel
    if given is None or not given.HasValue():
        return default, None, 0
    ((red, green, blue),) = numbers_of(given, np.float64, width=3).tolist()
    return (_within(red, _BRIGHTEST), _within(green, _BRIGHTEST), _within(blue, _BRIGHTEST)), None, 0


def _number(shader: _Shader, name: str, default: float) -> tuple[float, UsdShade.Shader | None, int]:
    given, reader, channel = shader.input(name)
    if reader is not None:
        return 1.0, reader, channel
    if given is None or not given.HasValue():
        return default, None, 0
    return _within(number_of(given), 1.0), None, 0


def _within(value: float, most: float) -> float:
    """A number of at least 0 and at most another; 0 for what is none."""
    return 0.0 if math.isnan(value) else min(max(value, 0.0), most)


def _input(shader: UsdShade.Shader, name: str) -> tuple[Usd.Attribute | None, UsdShade.Shader | None, int]:
    """What holds an input's value, or the texture reader that it comes from and which channel of it."""
    given = shader.GetInput(name)
    if not given:
        return None, None, 0
    if not given.GetAttr().HasAuthoredConnections():
        return given.GetAttr(), None, 0
    for attribute in given.GetValueProducingAttributes():
        if UsdShade.Utils.GetType(attribute.GetName()) == UsdShade.AttributeType.Input:
            return attribute, None, 0
        reader = UsdShade.Shader(attribute.GetPrim())
        if reader and reader.GetIdAttr().Get() == "UsdUVTexture":
            channel = {"r": 0, "g": 1, "b": 2, "a": 3}.get(UsdShade.Output(attribute).GetBaseName(), 0)
            return None, reader, channel
    return None, None, 0


def _file(reader: UsdShade.Shader | None) -> str:
    if reader is None:
        return ""
    given, _, _ = _input(reader, "file")
    value = None if given is None else given.Get(READ_AT)
    return value.resolvedPath if isinstance(value, Sdf.AssetPath) else ""


def _coordinate_name(reader: UsdShade.Shader | None) -> str:
    given = reader.GetInput("st") if reader is not None else None
    for attribute in given.GetValueProducingAttributes() if given else ():
        source = UsdShade.Shader(attribute.GetPrim())
        if source and source.GetIdAttr().Get() == "UsdPrimvarReader_float2":
            named, _, _ = _input(source, "varname")
            return str((named.Get(READ_AT) if named else None) or "st")
    return "st"
