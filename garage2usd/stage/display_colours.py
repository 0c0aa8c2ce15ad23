"""The colour of an asset for viewers that draw no materials."""

from functools import lru_cache

import numpy as np
from PIL import Image

from garage2usd.assets import MATERIALS, Asset, Material, Part
from garage2usd.assets.textures import texture_folder
from garage2usd.config.stage import TextureQuality

__all__ = ["display_colour", "material_colour"]

Rgb = tuple[float, float, float]

_OPAQUE = 255
_SRGB = np.arange(_OPAQUE + 1) / _OPAQUE
_LINEAR = np.where(_SRGB <= 0.04045, _SRGB / 12.92, ((_SRGB + 0.055) / 1.055) ** 2.4)  # noqa: PLR2004
"""Linear value of each step of sRGB, by IEC 61966-2-1."""
_PLACES = 3


def display_colour(asset: Asset) -> Rgb:
    """Linear colour of the material that most of an asset's surface has."""
    areas_m2 = dict.fromkeys((part.material for part in asset.parts), 0.0)
    if len(areas_m2) > 1:
        for part in asset.parts:
            areas_m2[part.material] += _area_m2(part)
    most = max(areas_m2, key=areas_m2.__getitem__)
    return material_colour(MATERIALS[most])


def material_colour(material: Material) -> Rgb:
    """Linear colour of a material, the mean where a texture has its colours."""
    return material.colour_rgb if material.colour_texture is None else _mean_colour(material.colour_texture)


@lru_cache(maxsize=64)
def _mean_colour(texture: str) -> Rgb:
    """Linear mean of a texture, weighted by its opacity where it has one."""
    with Image.open(texture_folder(TextureQuality.LOW) / texture) as picture:
        *channels, opacity = np.asarray(picture.convert("RGBA")).reshape(-1, 4).T
    weights = None if opacity.min() == _OPAQUE else opacity / _OPAQUE
    counts = (np.bincount(channel, weights, minlength=len(_LINEAR)) for channel in channels)
    red, green, blue = (round(float(count @ _LINEAR) / max(float(count.sum()), 1.0), _PLACES) for count in counts)
    return red, green, blue


def _area_m2(part: Part) -> float:
    """Of all faces, each as a fan of triangles around its first corner."""
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
