"""Materials of glTF 2.0 as surfaces."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from garage2usd.scenes.gltf_file import GltfFile, title_of
from garage2usd.scenes.gltf_meshes import set_named
from garage2usd.scenes.pictures import ALPHA, Pictures
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import Rgb, SurfaceLook, within
from garage2usd.scenes.textures import LEFT_OUT, Coordinates, Layout, Texture

_WRAPS = {33071: "clamp", 33648: "mirror", 10497: "repeat"}
_NEAREST = 9728
_MOST_IOR = 1e3
_COLOURS = "COLOR_0"
_SOURCES = ("EXT_texture_webp", "EXT_texture_avif")
_BASIS = "KHR_texture_basisu"
_TRANSFORM = "KHR_texture_transform"
_ONES, _WHITE = (1.0, 1.0, 1.0, 1.0), (1.0, 1.0, 1.0)
_LEAST_OPACITY = 0.1
"""Of a surface that lets all light through: its reflections stay visible."""


class GltfSurfaces:
    """Reader of the materials of a file.

    Parameters
    ----------
    file
        The file.
    pictures
        Receives the pictures of the textures.
    remarks
        Receives remarks on omitted properties.
    """

    def __init__(self, file: GltfFile, pictures: Pictures, remarks: Remarks) -> None:
        self._file, self._pictures, self._remarks = file, pictures, remarks
        self._of_material = cache(self._material)
        self._files: dict[int, str] = {}

    def surface(self, primitive: Mapping[str, Any]) -> tuple[SurfaceLook, bool]:
        """Return the surface of a primitive, and True if its back is visible."""
        colours = _COLOURS if _COLOURS in primitive["attributes"] else ""
        if "material" not in primitive:
            return SurfaceLook(colour_rgb=_WHITE, roughness=1.0, metallic=1.0, colour_name=colours), False
        look, double_sided = self._of_material(primitive["material"])
        return replace(look, colour_name=colours), double_sided

    def _material(self, number: int) -> tuple[SurfaceLook, bool]:
        material = self._file.entry("materials", number)
        title = title_of(material, "materials", number)
        values = self._reflection(material, title)
        values |= self._coat(material, title) | self._opacity(material, values, title)
        extensions = material.get("extensions", {})
        normal, occlusion = material.get("normalTexture", {}), material.get("occlusionTexture", {})
        across, strength = 2 * float(normal.get("scale", 1.0)), float(occlusion.get("strength", 1.0))
        values["normal_texture"] = self._texture(
            normal, title, scale=(across, across, 2.0, 1.0), bias=(-across / 2, -across / 2, -1.0, 0.0)
        )
        values["occlusion_texture"] = self._texture(
            occlusion, title, channel=0, scale=(strength,) * 4, bias=(1 - strength,) * 4
        )
        if any(material.get("emissiveFactor", ())):
            values["emissive_rgb"] = _rgb(material["emissiveFactor"])
        if "KHR_materials_ior" in extensions:
            values["ior"] = within(float(extensions["KHR_materials_ior"].get("ior", 1.5)), _MOST_IOR)
        return SurfaceLook(**values, name=str(material.get("name", ""))), bool(material.get("doubleSided"))

    def _reflection(self, material: Mapping[str, Any], title: str) -> dict[str, Any]:
        """Return colour, roughness, and metallic or, instead, the specular colour."""
        glossy = material.get("extensions", {}).get("KHR_materials_pbrSpecularGlossiness")
        if glossy is not None:
            return self._glossy(glossy, title)
        given = material.get("pbrMetallicRoughness", {})
        factors = [_share(part) for part in given.get("baseColorFactor", _ONES)]
        roughness, metallic = (_share(given.get(f"{name}Factor", 1.0)) for name in ("roughness", "metallic"))
        values = self._coloured(factors, given.get("baseColorTexture"), title)
        finish = given.get("metallicRoughnessTexture")
        for name, factor, channel in (("roughness", roughness, 1), ("metallic", metallic, 2)):
            texture = self._texture(finish, title, channel=channel, scale=(factor,) * 4)
            values |= {name: factor if texture is None else 1.0, f"{name}_texture": texture}
        return values

    def _glossy(self, given: Mapping[str, Any], title: str) -> dict[str, Any]:
        """Return the values of KHR_materials_pbrSpecularGlossiness."""
        factors = [_share(part) for part in given.get("diffuseFactor", _ONES)]
        values = self._coloured(factors, given.get("diffuseTexture"), title)
        specular, glossiness = _rgb(given.get("specularFactor", _ONES)), _share(given.get("glossinessFactor", 1.0))
        texture = self._texture(given.get("specularGlossinessTexture"), title, scale=(*specular, 1.0))
        if texture is None:
            return values | {"specular_rgb": specular, "roughness": 1 - glossiness}
        rough = texture._replace(channel=ALPHA, scale=(-glossiness,) * 4, bias=_ONES)
        coloured = texture._replace(colour_space="sRGB")
        return values | {"specular_rgb": _WHITE, "specular_texture": coloured, "roughness_texture": rough}

    def _coloured(self, factors: Sequence[float], info: Mapping[str, Any] | None, title: str) -> dict[str, Any]:
        red, green, blue, alpha = factors
        scale = red, green, blue, alpha
        texture = self._texture(info, title, scale=scale, colour_space="sRGB")
        colour = (red, green, blue) if texture is None else _WHITE
        return {"colour_rgb": colour, "opacity": alpha, "colour_texture": texture}

    def _opacity(self, material: Mapping[str, Any], values: Mapping[str, Any], title: str) -> dict[str, Any]:
        """Return the opacity of a material: that of its alpha mode, reduced by its transmission."""
        mode, found = material.get("alphaMode", "OPAQUE"), dict[str, Any]()
        colour, cutoff = values.get("colour_texture"), _share(material.get("alphaCutoff", 0.5))
        if mode == "MASK" and not cutoff:
            mode = "OPAQUE"
        if mode == "OPAQUE":
            found["opacity"] = 1.0
        elif colour is not None and self._pictures.has_alpha(colour.file):
            found |= {"opacity_texture": colour._replace(channel=ALPHA), "opacity": 1.0}
        if mode == "MASK":
            found["opacity_threshold"] = cutoff
        through = material.get("extensions", {}).get("KHR_materials_transmission", {})
        share = _share(through.get("transmissionFactor", 0.0))
        if share and mode == "MASK":
            self._remarks.add("KHR_materials_transmission of what is cut out is not used", title)
            return found
        texture = self._texture(through.get("transmissionTexture"), title, channel=0)
        if texture is not None:
            self._remarks.add("textures of transmission are carried as their mean", texture.file)
            share *= self._pictures.mean(texture.band())
        if share:
            tint = values["colour_rgb"]
            if colour is not None:
                tint = [self._pictures.mean(colour.band(channel)) for channel in range(3)]
            self._remarks.add("KHR_materials_transmission is carried as opacity", title)
            whole = found.get("opacity", values["opacity"])
            found["opacity"] = whole * max(1 - share * sum(tint) / 3, _LEAST_OPACITY)
        return found

    def _coat(self, material: Mapping[str, Any], title: str) -> dict[str, Any]:
        given = material.get("extensions", {}).get("KHR_materials_clearcoat")
        if given is None:
            return {}
        coat: dict[str, Any] = {
            "clearcoat": _share(given.get("clearcoatFactor", 0.0)),
            "clearcoat_roughness": _share(given.get("clearcoatRoughnessFactor", 0.0)),
        }
        for name, key, channel in (("clearcoat", "clearcoat", 0), ("clearcoatRoughness", "clearcoat_roughness", 1)):
            scale = (coat[key],) * 4
            coat[f"{key}_texture"] = self._texture(given.get(f"{name}Texture"), title, channel=channel, scale=scale)
        if "clearcoatNormalTexture" in given:
            self._remarks.add("normal maps of coats are not used", title)
        return coat

    def _texture(
        self,
        info: Mapping[str, Any] | None,
        title: str,
        *,
        channel: int = -1,
        scale: tuple[float, float, float, float] = (1.0, 1.0, 1.0, 1.0),
        bias: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0),
        colour_space: str = "raw",
    ) -> Texture | None:
        """Return the texture of a reference; None without one, or, with a remark, if its picture cannot be read."""
        if not info:
            return None
        texture = self._file.entry("textures", info["index"])
        extensions = texture.get("extensions", {})
        sources = [extensions[name]["source"] for name in _SOURCES if name in extensions]
        sources += [texture["source"]] if "source" in texture else []
        if not sources:
            which = f"of {_BASIS}" if _BASIS in extensions else "without a source"
            self._remarks.add(f"textures {which} are left out", title)
            return None
        file = self._picture(sources[0])
        if fault := self._pictures.fault(file):
            self._remarks.add(f"pictures that {fault} {LEFT_OUT}", file)
            return None
        sampler = self._file.entry("samplers", texture["sampler"]) if "sampler" in texture else {}
        if sampler.get("magFilter") == _NEAREST:
            self._remarks.add("samplers that take the nearest pixel are read as smooth ones", title)
        layout = _layout(info)._replace(
            wrap_s=_WRAPS.get(sampler.get("wrapS", 0), "repeat"), wrap_t=_WRAPS.get(sampler.get("wrapT", 0), "repeat")
        )
        return Texture(file, channel, layout, scale, bias, colour_space)

    def _picture(self, number: int) -> str:
        """Read a picture, and return its name."""
        entry = self._file.entry("images", number)
        uri = str(entry.get("uri", ""))
        title = str(entry.get("name") or ("" if uri.startswith("data:") else uri) or number)
        if number not in self._files:
            file = f"{self._file.path}, image {title}"
            while file in self._files.values():
                file = f"{file} ({number})"
            self._files[number] = file
            self._pictures.give(file, self._file.picture(number))
        return self._files[number]


def _rgb(values: Sequence[float]) -> Rgb:
    red, green, blue = (_share(value) for value in values[:3])
    return red, green, blue


def _share(value: float) -> float:
    return within(float(value), 1.0)


def _layout(info: Mapping[str, Any]) -> Layout:
    """Return the coordinates of a texture and their transform by KHR_texture_transform, whose V points down."""
    given = info.get("extensions", {}).get(_TRANSFORM, {})
    coordinates = Coordinates(set_named(given.get("texCoord", info.get("texCoord", 0))))
    (move_u, move_v), (scale_u, scale_v) = given.get("offset", (0.0, 0.0)), given.get("scale", (1.0, 1.0))
    turn_rad = float(given.get("rotation", 0.0))
    if not given:
        return Layout(coordinates)
    translation = move_u + scale_v * math.sin(turn_rad), 1 - move_v - scale_v * math.cos(turn_rad)
    return Layout(coordinates, (float(scale_u), float(scale_v)), turn_rad, translation)
