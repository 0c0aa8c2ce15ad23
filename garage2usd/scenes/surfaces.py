"""Materials of a stage as values of simple surface models without shader networks."""

# Over 300 lines: every input of UsdPreviewSurface is read here, as what one says depends on others.

import math
from dataclasses import dataclass, field, fields, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom, UsdShade

from garage2usd.scenes.pictures import ALPHA, Pictures
from garage2usd.scenes.prims import finish_of
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.textures import (
    PRIMVAR_READER,
    USUAL_COORDINATES,
    UV_TEXTURE,
    Coordinates,
    Source,
    Texture,
    TextureReader,
    source_of,
)
from garage2usd.scenes.values import READ_AT, vector_of

Rgb = tuple[float, float, float]
_PREVIEW = "UsdPreviewSurface"
_BRIGHTEST = 1e4
_DEFAULT_ROUGHNESS = 0.5
_DEFAULT_IOR = 1.5
_STRAIGHT = (0.0, 0.0, 1.0)
"""Normal of a surface without a normal map."""
_MOST_IOR = 1e3
_COLOUR_READERS = frozenset({f"{PRIMVAR_READER}float3", f"{PRIMVAR_READER}float4"})


@dataclass(frozen=True)
class SurfaceLook:
    """Appearance of a surface. A value with a texture is 1.

    Attributes
    ----------
    colour_rgb, emissive_rgb
        Linear.
    roughness, metallic, opacity, clearcoat, clearcoat_roughness, occlusion
        0 to 1.
    ior
        Index of refraction.
    specular_rgb
        Reflectance at normal incidence, in the specular workflow; None in the metallic one.
    colour_texture, emissive_texture, roughness_texture, metallic_texture, opacity_texture, clearcoat_texture,
    clearcoat_roughness_texture, occlusion_texture, specular_texture, normal_texture
        None for none.
    colour_name
        Primvar with a colour for each point, in place of `colour_rgb`; empty for none.
    opacity_threshold
        Points of less opacity are not drawn, and all others are opaque; 0 to draw all with their opacity.
    name
        Name of the material, empty for none; materials of different names that look alike are equal.
    """

    colour_rgb: Rgb = (0.5, 0.5, 0.5)
    emissive_rgb: Rgb = (0.0, 0.0, 0.0)
    roughness: float = _DEFAULT_ROUGHNESS
    metallic: float = 0.0
    opacity: float = 1.0
    clearcoat: float = 0.0
    clearcoat_roughness: float = 0.01
    occlusion: float = 1.0
    ior: float = _DEFAULT_IOR
    specular_rgb: Rgb | None = None
    colour_texture: Texture | None = None
    opacity_texture: Texture | None = None
    roughness_texture: Texture | None = None
    metallic_texture: Texture | None = None
    normal_texture: Texture | None = None
    occlusion_texture: Texture | None = None
    emissive_texture: Texture | None = None
    clearcoat_texture: Texture | None = None
    clearcoat_roughness_texture: Texture | None = None
    specular_texture: Texture | None = None
    colour_name: str = ""
    opacity_threshold: float = 0.0
    name: str = field(default="", compare=False)

    @property
    def has_alpha(self) -> bool:
        """True if a texture gives the surface's opacity."""
        return self.opacity_texture is not None

    @property
    def is_blended(self) -> bool:
        """True if the background shows through the surface."""
        return self.has_alpha or self.opacity < 1

    @property
    def has_textures(self) -> bool:
        """True if a texture gives a value of the surface."""
        return any(getattr(self, name) for name in _TEXTURES)

    @property
    def sets(self) -> tuple[Coordinates, ...]:
        """Distinct texture coordinates of the surface's textures; at least one."""
        textures = [getattr(self, name) for name in _TEXTURES]
        return tuple(dict.fromkeys(own.layout.coordinates for own in textures if own)) or (USUAL_COORDINATES,)

    def placed_on(self, texture: Texture, coordinates: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return coordinates on one of its textures, shape (n, 2), from those of its `sets`, shape (n, sets, 2)."""
        layout = texture.layout
        return layout.placed(coordinates[:, self.sets.index(layout.coordinates)])


_TEXTURES = tuple(own.name for own in fields(SurfaceLook) if own.name.endswith("_texture"))


class _Given(NamedTuple):
    """Value of a surface input: numbers, a texture, or a primvar with a value at each point."""

    values: tuple[float, ...]
    texture: Texture | None = None
    primvar: str = ""


class SurfaceReader:
    """Reader of the surfaces of a stage's materials.

    Parameters
    ----------
    remarks
        Collector of omitted properties.
    pictures
        Receives the pictures of the textures.

    Attributes
    ----------
    pictures
        Pictures of the textures.
    read_a_primvar
        True if the last surface read depends on its prim.
    """

    def __init__(self, remarks: Remarks, pictures: Pictures) -> None:
        self.pictures, self.read_a_primvar = pictures, False
        self._remarks = remarks
        self._textures = TextureReader(self.pictures, remarks)

    def unbound(self, prim: Usd.Prim) -> SurfaceLook:
        """Return the surface of a prim without a material, from the prim's own colour and opacity."""
        primvars = UsdGeom.PrimvarsAPI(prim)
        opacity = primvars.FindPrimvarWithInheritance("displayOpacity")
        shares = _rows(opacity, 1) if opacity and opacity.HasValue() else None
        share = 1.0 if shares is None or not len(shares) else within(float(shares.mean()), 1.0)
        if shares is not None and len(np.unique(shares)) > 1:
            self._remarks.add("numbers by point are carried as their mean", prim.GetPath())
        colour = primvars.FindPrimvarWithInheritance("displayColor")
        if not colour or not colour.HasValue() or colour.GetTypeName() != Sdf.ValueTypeNames.Color3fArray:
            return SurfaceLook(opacity=share)
        values = _rows(colour, 3)
        if values is None or not len(values):
            return SurfaceLook(opacity=share)
        red, green, blue = np.clip(np.nan_to_num(values), 0, 1).mean(axis=0).tolist()
        varies = colour.GetInterpolation() != UsdGeom.Tokens.constant and len(values) > 1
        return SurfaceLook(colour_rgb=(red, green, blue), opacity=share, colour_name="displayColor" if varies else "")

    def surface_of(self, material: UsdShade.Material, prim: Usd.Prim) -> SurfaceLook:
        """Return the surface of a prim from its material's UsdPreviewSurface, or that of `unbound` without one."""
        self.read_a_primvar = False
        found, _, _ = material.ComputeSurfaceSource()
        if not found or found.GetIdAttr().Get() != _PREVIEW:
            self._remarks.add("materials without a UsdPreviewSurface are plain", material.GetPath())
            self.read_a_primvar = True
            return replace(self.unbound(prim), name=finish_of(material.GetPrim()))
        shader = _Inputs(self, found, prim, frozenset(found.GetPrim().GetAuthoredPropertyNames()))
        if any(shader.given("displacement", (0.0,)).values):
            self._remarks.add("displacement is left out", material.GetPath())
        colour, emissive = shader.colour("diffuseColor", (0.18,) * 3), shader.colour("emissiveColor", (0.0,) * 3)
        roughness, metallic = shader.number("roughness", _DEFAULT_ROUGHNESS), shader.number("metallic", 0.0)
        opacity, occlusion = shader.number("opacity", 1.0), shader.number("occlusion", 1.0)
        clearcoat, coat_roughness = shader.number("clearcoat", 0.0), shader.number("clearcoatRoughness", 0.01)
        is_specular = shader.number("useSpecularWorkflow", 0.0).values[0] > 0
        specular = shader.colour("specularColor", (0.0,) * 3) if is_specular else None
        if emissive.primvar or (specular and specular.primvar):
            self._remarks.add(
                "colours by point of what glows or reflects are carried as their mean", material.GetPath()
            )
        normal = shader.given("normal", _STRAIGHT)
        if normal.texture is None and normal.values != _STRAIGHT:
            self._remarks.add("normals that are the same all over are left out", material.GetPath())
        return SurfaceLook(
            colour_rgb=_rgb(colour),
            emissive_rgb=_rgb(emissive),
            roughness=roughness.values[0],
            metallic=0.0 if is_specular else metallic.values[0],
            opacity=opacity.values[0],
            clearcoat=clearcoat.values[0],
            clearcoat_roughness=coat_roughness.values[0],
            occlusion=occlusion.values[0],
            ior=self._mean(shader.number("ior", _DEFAULT_IOR, most=_MOST_IOR), "ior"),
            specular_rgb=_rgb(specular) if specular else None,
            colour_texture=colour.texture,
            opacity_texture=opacity.texture,
            roughness_texture=roughness.texture,
            metallic_texture=None if is_specular else metallic.texture,
            normal_texture=normal.texture,
            occlusion_texture=occlusion.texture,
            emissive_texture=emissive.texture,
            clearcoat_texture=clearcoat.texture,
            clearcoat_roughness_texture=coat_roughness.texture,
            specular_texture=specular.texture if specular else None,
            colour_name=colour.primvar,
            opacity_threshold=self._mean(shader.number("opacityThreshold", 0.0), "opacityThreshold"),
            name=finish_of(material.GetPrim()),
        )

    def _mean(self, given: _Given, name: str) -> float:
        """Return the number of an input that supports no texture: the mean of a texture."""
        if given.texture is None:
            return given.values[0]
        self._remarks.add(f"textures of {name} are carried as their mean", given.texture.file)
        return self.pictures.mean(given.texture.band())

    def given(self, source: Source, default: tuple[float, ...], prim: Usd.Prim, *, is_colour: bool) -> _Given:
        """Return the value that a source gives to a surface input."""
        if source.shader is None:
            return _Given(vector_of(source.attribute, len(default)))
        if source.node == UV_TEXTURE:
            read = self._textures.read(source)
            if not isinstance(read, Texture):
                return _Given(read[: len(default)])
            return _Given((1.0,) * len(default), read if is_colour else self._as_numbers(read))
        if source.node.startswith(PRIMVAR_READER):
            return self._primvar(source, default, prim)
        self._remarks.add(
            "inputs from other nodes than those of UsdPreviewSurface are left out", source.attribute.GetPrimPath()
        )
        return _Given(default)

    def _as_numbers(self, texture: Texture) -> Texture:
        """Return a texture of a non-colour input: its pixels are numbers unless it declares sRGB."""
        if texture.colour_space != "auto" or texture.band().channel == ALPHA:
            return texture
        if self.pictures.is_srgb(texture.file, "auto"):
            self._remarks.add("numbers in coloured pictures of the colour space auto are read as raw", texture.file)
        return texture._replace(colour_space="raw")

    def _primvar(self, source: Source, default: tuple[float, ...], prim: Usd.Prim) -> _Given:
        """Return the value of a prim's primvar; the reader node's fallback without one."""
        named, fallback = source_of(source.shader, "varname"), source_of(source.shader, "fallback")
        name = str((named.attribute.Get(READ_AT) if named else "") or "")
        self.read_a_primvar = True
        primvar = UsdGeom.PrimvarsAPI(prim).FindPrimvarWithInheritance(name) if name else UsdGeom.Primvar()
        values = _rows(primvar, len(default)) if primvar and primvar.HasValue() else None
        if values is None:
            return _Given(vector_of(fallback.attribute, len(default)) if fallback else (0.0,) * len(default))
        mean = tuple(np.nan_to_num(values).mean(axis=0).tolist())
        if len(values) == 1 or primvar.GetInterpolation() == UsdGeom.Tokens.constant:
            return _Given(mean)
        if source.node in _COLOUR_READERS and len(default) > 1:
            return _Given(mean, None, name)
        self._remarks.add("numbers by point are carried as their mean", source.attribute.GetPrimPath())
        return _Given(mean)


class _Inputs(NamedTuple):
    """Inputs of a surface shader; most keep their defaults."""

    reader: SurfaceReader
    shader: UsdShade.Shader
    prim: Usd.Prim
    said: frozenset[str]

    def given(self, name: str, default: tuple[float, ...], *, is_colour: bool = False) -> _Given:
        """Return the value of a shader input."""
        source = source_of(self.shader, name) if f"inputs:{name}" in self.said else None
        return _Given(default) if source is None else self.reader.given(source, default, self.prim, is_colour=is_colour)

    def colour(self, name: str, default: Rgb) -> _Given:
        """Return a colour input, clamped between 0 and the greatest brightness."""
        return self._clipped(self.given(name, default, is_colour=True), _BRIGHTEST)

    def number(self, name: str, default: float, *, most: float = 1.0) -> _Given:
        """Return a number input between 0 and a maximum."""
        return self._clipped(self.given(name, (default,)), most)

    @staticmethod
    def _clipped(given: _Given, most: float) -> _Given:
        return given._replace(values=tuple(within(value, most) for value in given.values))


def stands_alone(material: UsdShade.Material) -> bool:
    """Return True if a material is self-contained: its connections lead to itself and the prims below it."""
    prim = material.GetPrim()
    parts = Usd.PrimRange(prim, Usd.TraverseInstanceProxies())
    connected = (given for part in parts for given in part.GetAuthoredAttributes())
    sources = (source for given in connected for source in given.GetConnections())
    return all(source.HasPrefix(prim.GetPath()) for source in sources)


def _rgb(given: _Given) -> Rgb:
    red, green, blue = given.values
    return red, green, blue


def _rows(primvar: UsdGeom.Primvar, width: int) -> NDArray[np.float64] | None:
    """Return the values of a primvar, shape (n, width); None if it has no values of that width."""
    try:
        values = np.asarray(primvar.ComputeFlattened(READ_AT), dtype=np.float64)
    except (TypeError, ValueError):
        return None
    if not primvar.GetTypeName().isArray:
        values = values[None]
    if not values.ndim:
        return None
    rows = values.reshape(len(values), -1) if len(values) else values.reshape(0, 1)
    return rows[:, :width] if len(rows) and rows.shape[1] >= width else None


def within(value: float, most: float) -> float:
    """Clamp a number between 0 and a maximum; 0 for NaN."""
    return 0.0 if math.isnan(value) else min(max(value, 0.0), most)
