"""Surfaces of a stage as materials of glTF 2.0, with their textures, samplers and images."""
# Over 300 lines: a material, its textures and their images are written by one pass over a surface.

import math
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from garage2usd.scenes.pictures import Band, Bands, Picture, Pictures, factored
from garage2usd.scenes.plain_surfaces import base_colour_of, normal_bands_of
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.textures import Layout, Texture

_TRANSFORM = "KHR_texture_transform"
_WRAPS = {"clamp": 33071, "mirror": 33648, "repeat": 10497}
_BYTE = 1 / 255
_REFLECTED = 0.04
"""Reflectance of glTF's default index of refraction at normal incidence."""
_USUAL_IOR = 1.5
_SAME = 1e-6


class Textures:
    """Builder of a GLB file's textures, which stores equal textures and images once.

    Parameters
    ----------
    pictures
        Pictures of the textures.
    remarks
        Receives remarks on features that glTF textures lack.

    Attributes
    ----------
    textures, samplers
        Textures and samplers as glTF's JSON arrays.
    images
        Images of the textures.
    extensions
        glTF extensions used by the textures.
    """

    def __init__(self, pictures: Pictures, remarks: Remarks) -> None:
        self.textures: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []
        self.images: list[Picture] = []
        self.extensions: set[str] = set()
        self._pictures, self._remarks = pictures, remarks
        self._image_of: dict[tuple[Bands, bool], int] = {}

    def info(self, bands: Bands, layout: Layout, *, is_srgb: bool = False) -> dict[str, Any]:
        """Return the JSON reference to the texture of some bands, without its texture coordinate set.

        Parameters
        ----------
        bands
            Bands of the texture, at least one from a picture.
        layout
            Placement of the texture on the surface.
        is_srgb
            True if red, green and blue are read as sRGB.
        """
        texture: dict[str, Any] = {"source": self._image(bands, is_srgb=is_srgb)}
        wraps = layout.wrap_s, layout.wrap_t
        if wraps != ("repeat", "repeat"):
            texture["sampler"] = _number(self.samplers, {"wrapS": _WRAPS[wraps[0]], "wrapT": _WRAPS[wraps[1]]})
        info: dict[str, Any] = {"index": _number(self.textures, texture)}
        if layout.is_moved:
            self.extensions.add(_TRANSFORM)
            info["extensions"] = {_TRANSFORM: _transform(layout)}
        return info

    def _image(self, bands: Bands, *, is_srgb: bool) -> int:
        key = bands, is_srgb
        if key not in self._image_of:
            for band in bands:
                if isinstance(band, Band) and (band.scale, band.bias) != (1.0, 0.0):
                    values = self._pictures.plane(band)
                    if values.min() < -_BYTE or values.max() > 1 + _BYTE:
                        self._remarks.add("values of textures outside of 0 to 1 are cut off", band.file)
            self._image_of[key] = _number(self.images, self._pictures.composed(bands, is_srgb=is_srgb))
        return self._image_of[key]


def shortest(values: Iterable[float]) -> list[float]:
    """Round numbers to the fewest digits of equal single-precision value."""
    return [float(np.format_float_positional(np.float32(value), unique=True, trim="0")) for value in values]


def _transform(layout: Layout) -> dict[str, Any]:
    """Convert a texture layout to KHR_texture_transform, whose v points down."""
    (_, scale_v), (move_u, move_v), turn = layout.scale, layout.translation, layout.rotation_rad
    offset = move_u - scale_v * math.sin(turn), 1 - move_v - scale_v * math.cos(turn)
    found = {"offset": shortest(offset), "rotation": shortest([turn])[0], "scale": shortest(layout.scale)}
    usual = {"offset": [0.0, 0.0], "rotation": 0.0, "scale": [1.0, 1.0]}
    return {name: value for name, value in found.items() if value != usual[name]}


def _number(values: list[Any], value: object) -> int:
    """Return the index of a value in a list, appending it if new."""
    if value not in values:
        values.append(value)
    return values.index(value)


class Materials:
    """Builder of a GLB file's materials, which stores equal materials once.

    Parameters
    ----------
    pictures
        Pictures of the surfaces' textures.
    remarks
        Receives remarks on features that glTF materials lack.

    Attributes
    ----------
    materials
        Materials as glTF's JSON array.
    textures
        Textures of the materials.
    """

    def __init__(self, pictures: Pictures, remarks: Remarks) -> None:
        self.materials: list[dict[str, Any]] = []
        self.textures = Textures(pictures, remarks)
        self._extensions: set[str] = set()
        self._pictures, self._remarks = pictures, remarks
        self._number_of: dict[tuple[SurfaceLook, bool, bool], int] = {}
        self._sets: list[tuple[int, ...]] = []

    @property
    def extensions(self) -> set[str]:
        """Extensions of glTF used by the materials."""
        return self._extensions | self.textures.extensions

    def number(self, surface: SurfaceLook, *, double_sided: bool, has_colours: bool = False) -> int:
        """Return the index of a surface's material; `has_colours` is True for surfaces with vertex colours."""
        key = surface, double_sided, has_colours
        if key not in self._number_of:
            self._number_of[key] = len(self.materials)
            shown = replace(surface, colour_rgb=(1.0, 1.0, 1.0)) if has_colours else surface
            made = _Material(shown, self._pictures, self._remarks, self.textures)
            self.materials.append(made.properties(double_sided=double_sided))
            self._sets.append(tuple(made.sets))
            self._extensions |= made.extensions
        return self._number_of[key]

    def sets_of(self, number: int) -> tuple[int, ...]:
        """Return the indices of the surface's texture coordinates that a material reads, in order of sets."""
        return self._sets[number]

    def normals_of(self, number: int) -> int | None:
        """Return the texture coordinate set of a material's normal map; None without a normal map."""
        texture = self.materials[number].get("normalTexture")
        return None if texture is None else int(texture.get("texCoord", 0))


class _Material:
    """A glTF material under construction.

    Attributes
    ----------
    sets
        Indices of the surface's texture coordinates that the material reads.
    extensions
        glTF extensions used by the material.
    """

    def __init__(self, surface: SurfaceLook, pictures: Pictures, remarks: Remarks, textures: Textures) -> None:
        self.sets: list[int] = []
        self.extensions: set[str] = set()
        self._surface, self._pictures, self._remarks, self._textures = surface, pictures, remarks, textures
        self._made: dict[str, Any] = {"name": surface.name} if surface.name else {}

    def properties(self, *, double_sided: bool) -> dict[str, Any]:
        """Return the material as glTF's JSON."""
        surface, made = self._surface, self._made
        made["pbrMetallicRoughness"] = self._reflection()
        self._add_normals()
        self._add_occlusion()
        self._add_glow()
        self._add_coat()
        self._add_mirror()
        if surface.is_blended:
            made["alphaMode"] = "MASK" if surface.opacity_threshold else "BLEND"
            if surface.opacity_threshold:
                made["alphaCutoff"] = surface.opacity_threshold
        if double_sided:
            made["doubleSided"] = True
        return made

    def _reflection(self) -> dict[str, Any]:
        base = base_colour_of(self._surface, self._pictures, self._remarks)
        (roughness, metallic), finish, finish_layout = self._finish()
        reflection: dict[str, Any] = {
            "baseColorFactor": shortest([*base.colour_rgb, base.opacity]),
            "metallicFactor": shortest([metallic])[0],
            "roughnessFactor": shortest([roughness])[0],
        }
        # 1 is the default of glTF
        reflection = {name: value for name, value in reflection.items() if value not in (1.0, [1.0] * 4)}
        if base.texture:
            reflection["baseColorTexture"] = self._info(base.bands, base.texture, is_srgb=True)
        if finish_layout:
            reflection["metallicRoughnessTexture"] = self._info(finish, finish_layout)
        return reflection

    def _finish(self) -> tuple[tuple[float, float], Bands, Texture | None]:
        """Return the factors of roughness and metallic, and the texture with both in its green and blue band."""
        surface = self._surface
        rough, metal = surface.roughness_texture, surface.metallic_texture
        roughness, metallic = surface.roughness, surface.metallic
        if rough and metal and rough.layout != metal.layout:
            metallic, metal = self._mean(metal, "metallic textures that lie unlike the roughness's"), None
        # a factor of 0 makes a channel irrelevant
        green: Band | float | None = 1.0 if roughness else None
        blue: Band | float | None = 1.0 if metallic else None
        if rough:
            (roughness,), (green,) = factored([rough.band()])
        if metal:
            (metallic,), (blue,) = factored([metal.band()])
        return (roughness, metallic), (None, green, blue), rough or metal

    def _add_normals(self) -> None:
        texture = self._surface.normal_texture
        if texture is None:
            return
        scale, bias = texture.scale[:3], texture.bias[:3]
        strength = scale[0] / 2
        is_flattened = scale == (scale[0], scale[0], 2.0) and bias == (-strength, -strength, -1.0) and strength > 0
        if is_flattened:
            texture = texture._replace(scale=(2.0, 2.0, 2.0, 1.0), bias=(-1.0, -1.0, -1.0, 0.0))
        self._made["normalTexture"] = self._info(normal_bands_of(texture, self._remarks), texture)
        if is_flattened and strength != 1:
            self._made["normalTexture"]["scale"] = shortest([strength])[0]

    def _add_occlusion(self) -> None:
        texture = self._surface.occlusion_texture
        if texture is None:
            if self._surface.occlusion < 1:
                self._remarks.add("occlusion that is the same all over is left out", self._surface.name)
            return
        band, strength = texture.band(), 1.0
        if 0 <= band.scale <= 1 and abs(band.scale + band.bias - 1) < _SAME:
            band, strength = band._replace(scale=1.0, bias=0.0), band.scale
        self._made["occlusionTexture"] = self._info((band, None, None), texture)  # glTF reads occlusion from red
        if strength != 1:
            self._made["occlusionTexture"]["strength"] = shortest([strength])[0]

    def _add_glow(self) -> None:
        texture, factors = self._surface.emissive_texture, list(self._surface.emissive_rgb)
        if texture:
            bands = [texture.band(channel) for channel in range(3)]
            if all(band.bias == 0 and band.scale >= 0 for band in bands):
                factors, bands = [band.scale for band in bands], [band._replace(scale=1.0) for band in bands]
            else:
                most = max(1.0, *(float(self._pictures.plane(band).max()) for band in bands))
                factors = [most] * 3
                bands = [band._replace(scale=band.scale / most, bias=band.bias / most) for band in bands]
        if not any(factors):
            return
        if texture:
            self._made["emissiveTexture"] = self._info(tuple(bands), texture, is_srgb=True)
        strength = max(1.0, *factors)
        self._made["emissiveFactor"] = shortest([part / strength for part in factors])
        if strength > 1:
            self._extend("KHR_materials_emissive_strength", {"emissiveStrength": strength})

    def _add_coat(self) -> None:
        surface = self._surface
        if not surface.clearcoat:
            return
        coat: dict[str, Any] = {"clearcoatFactor": surface.clearcoat}
        if surface.clearcoat_texture:
            (coat["clearcoatFactor"],), bands = factored([surface.clearcoat_texture.band()])
            coat["clearcoatTexture"] = self._info((*bands, None, None), surface.clearcoat_texture)
        coat["clearcoatRoughnessFactor"] = shortest([surface.clearcoat_roughness])[0]
        if surface.clearcoat_roughness_texture:
            texture = surface.clearcoat_roughness_texture
            (coat["clearcoatRoughnessFactor"],), bands = factored([texture.band()])
            coat["clearcoatRoughnessTexture"] = self._info((None, *bands, None), texture)
        self._extend("KHR_materials_clearcoat", coat)

    def _add_mirror(self) -> None:
        """Add the specular reflectance at normal incidence."""
        surface = self._surface
        if surface.specular_rgb is None:
            if surface.ior != _USUAL_IOR:
                self._extend("KHR_materials_ior", {"ior": shortest([max(surface.ior, 1.0)])[0]})
            return
        factors, mirror = list(surface.specular_rgb), dict[str, Any]()
        if surface.specular_texture:
            factors, bands = factored([surface.specular_texture.band(channel) for channel in range(3)])
            mirror["specularColorTexture"] = self._info(bands, surface.specular_texture, is_srgb=True)
        mirror["specularColorFactor"] = shortest([factor / _REFLECTED for factor in factors])
        self._extend("KHR_materials_specular", mirror)

    def _info(self, bands: Bands, texture: Texture, *, is_srgb: bool = False) -> dict[str, Any]:
        """Return the JSON reference to a texture of some bands, in the layout of another texture."""
        info = self._textures.info(bands, texture.layout, is_srgb=is_srgb)
        number = self._surface.sets.index(texture.layout.coordinates)
        if number not in self.sets:
            self.sets.append(number)
        number = self.sets.index(number)
        return info | ({"texCoord": number} if number else {})

    def _mean(self, texture: Texture, which: str) -> float:
        """Compute the mean value of a texture's band."""
        self._remarks.add(f"{which} are carried as their mean", texture.file)
        return min(max(self._pictures.mean(texture.band()), 0.0), 1.0)

    def _extend(self, name: str, values: Mapping[str, Any]) -> None:
        self._made.setdefault("extensions", {})[name] = dict(values)
        self.extensions.add(name)
