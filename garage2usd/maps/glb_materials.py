"""Surfaces of a stage as materials, textures and images of glTF 2.0."""

import io
from collections.abc import Iterable, Mapping
from pathlib import PurePosixPath
from typing import Any, NamedTuple

import numpy as np
from PIL import Image
from pxr import Ar

from garage2usd.reading.surfaces import SurfaceLook

__all__ = ["Materials", "Picture", "shortest"]

_Band = tuple[str, int]
"""A file and one of its channels."""
_WHITE: _Band = ("", 0)
_GREEN, _BLUE = 1, 2
_KINDS = {b"\x89PNG": "image/png", b"\xff\xd8\xff": "image/jpeg"}
"""The two kinds of pictures that glTF knows, by their first bytes."""


class Picture(NamedTuple):
    """A file of an image: its name, its media type, and its bytes."""

    name: str
    kind: str
    data: bytes


class Materials:
    """Collects the materials of a file: each that differs once, and so each image.

    Attributes
    ----------
    materials, textures
        As the arrays of glTF's JSON have them.
    images
        What the textures show.
    extensions
        Those that the materials use.
    """

    def __init__(self) -> None:
        self.materials: list[dict[str, Any]] = []
        self.textures: list[dict[str, Any]] = []
        self.images: list[Picture] = []
        self.extensions: set[str] = set()
        self._number_of: dict[tuple[SurfaceLook, bool], int] = {}
        self._texture_of: dict[tuple[_Band, ...], int | None] = {}

    def number(self, surface: SurfaceLook, *, double_sided: bool) -> int:
        """Number of the material of a surface."""
        key = surface, double_sided
        if key not in self._number_of:
            self._number_of[key] = len(self.materials)
            self.materials.append(self._material(surface, double_sided=double_sided))
        return self._number_of[key]

    def textures_of(self, number: int) -> frozenset[str]:
        """Names of the textures that a material reads."""
        material = self.materials[number]
        return frozenset(name for name in {**material, **material["pbrMetallicRoughness"]} if name.endswith("Texture"))

    def _material(self, surface: SurfaceLook, *, double_sided: bool) -> dict[str, Any]:
        material: dict[str, Any] = {"name": surface.name} if surface.name else {}
        material["pbrMetallicRoughness"] = self._reflection(surface)
        self._add_texture(material, "normalTexture", _whole(surface.normal_texture))
        occlusion = surface.occlusion_texture, surface.occlusion_channel
        # glTF takes the occlusion from red
        bands = (occlusion,) * 3 if surface.occlusion_channel else _whole(surface.occlusion_texture)
        self._add_texture(material, "occlusionTexture", bands)
        if any(surface.emissive_rgb):
            strength = max(1.0, *surface.emissive_rgb)
            material["emissiveFactor"] = shortest([part / strength for part in surface.emissive_rgb])
            if strength > 1:
                self._extend(material, "KHR_materials_emissive_strength", {"emissiveStrength": strength})
        if surface.clearcoat:
            self._extend(material, "KHR_materials_clearcoat", {"clearcoatFactor": surface.clearcoat})
        if surface.is_blended:
            material["alphaMode"] = "MASK" if surface.opacity_threshold else "BLEND"
            if surface.opacity_threshold:
                material["alphaCutoff"] = surface.opacity_threshold
        if double_sided:
            material["doubleSided"] = True
        return material

    def _reflection(self, surface: SurfaceLook) -> dict[str, Any]:
        metallic, roughness = shortest([surface.metallic, surface.roughness])
        reflection: dict[str, Any] = {
            "baseColorFactor": shortest([*surface.colour_rgb, surface.opacity]),
            "metallicFactor": metallic,
            "roughnessFactor": roughness,
        }
        # 1 is what glTF takes where nothing is said
        reflection = {name: value for name, value in reflection.items() if value not in (1.0, [1.0] * 4)}
        self._add_texture(reflection, "baseColorTexture", _whole(surface.colour_texture))
        self._add_texture(reflection, "metallicRoughnessTexture", _finish(surface))
        return reflection

    def _extend(self, material: dict[str, Any], name: str, values: Mapping[str, float]) -> None:
        material.setdefault("extensions", {})[name] = dict(values)
        self.extensions.add(name)

    def _add_texture(self, holder: dict[str, Any], name: str, bands: tuple[_Band, ...]) -> None:
        """Refer to the texture that consists of these channels; to none where there are none or a file is missing."""
        if bands and bands not in self._texture_of:
            image = _image(bands)
            self._texture_of[bands] = None if image is None else len(self.textures)
            if image is not None:
                self.textures.append({"source": len(self.images)})
                self.images.append(image)
        texture = self._texture_of.get(bands)
        if texture is not None:
            holder[name] = {"index": texture}


def shortest(values: Iterable[float]) -> list[float]:
    """Numbers of single precision in the fewest digits that mean the same."""
    return [float(np.format_float_positional(np.float32(value), unique=True, trim="0")) for value in values]


def _whole(path: str) -> tuple[_Band, ...]:
    """A file as it is."""
    return ((path, -1),) if path else ()


def _finish(surface: SurfaceLook) -> tuple[_Band, ...]:
    """Channels of the texture that has roughness in green and metallic in blue."""
    rough = (surface.roughness_texture, surface.roughness_channel) if surface.roughness_texture else _WHITE
    metal = (surface.metallic_texture, surface.metallic_channel) if surface.metallic_texture else _WHITE
    files = {band[0] for band in (rough, metal) if band is not _WHITE}
    # a factor of 0 makes a channel say nothing
    fits_green = rough[1] == _GREEN if rough is not _WHITE else not surface.roughness
    fits_blue = metal[1] == _BLUE if metal is not _WHITE else not surface.metallic
    if len(files) == 1 and fits_green and fits_blue:
        return _whole(files.pop())
    return (_WHITE, rough, metal) if files else ()


def _image(bands: tuple[_Band, ...]) -> Picture | None:
    """An image of glTF: the very bytes of a file where it is a PNG or JPEG, else a PNG; None where nothing is there."""
    files = {path: _bytes(path) for path, _ in bands if path}
    if not all(files.values()):
        return None
    first, _ = max(bands)
    name = PurePosixPath(first.rpartition("[")[2].removesuffix("]")).stem
    if len(bands) == 1:
        data = files[first]
        kind = next((kind for magic, kind in _KINDS.items() if data.startswith(magic)), None)
        return Picture(name, kind, data) if kind else _png(name, _opened(data))
    pictures = {path: _opened(data) for path, data in files.items()}
    size = pictures[first].size
    parts = [
        pictures[path].convert("RGBA").getchannel(channel).resize(size) if path else Image.new("L", size, 255)
        for path, channel in bands
    ]
    return _png(name, Image.merge("RGB", parts))


def _bytes(path: str) -> bytes:
    asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
    return bytes(asset.GetBuffer()) if asset else b""


def _opened(data: bytes) -> Image.Image:
    return Image.open(io.BytesIO(data))


def _png(name: str, picture: Image.Image) -> Picture:
    buffer = io.BytesIO()
    picture.save(buffer, format="PNG", optimize=True)
    return Picture(name, "image/png", buffer.getvalue())
