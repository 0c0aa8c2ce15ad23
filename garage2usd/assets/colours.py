"""Colours of materials: conversion from sRGB to linear light, and mean colours of textures."""

import io
from functools import lru_cache

import numpy as np
from PIL import Image

from garage2usd.assets.materials import Material, OwnTexture, PaintedTexture, Rgb, StoredTexture, Texture
from garage2usd.assets.own_textures import own_pixels
from garage2usd.assets.textures import texture_folder
from garage2usd.config.outputs import TextureQuality

_OPAQUE = 255
_SRGB = np.arange(_OPAQUE + 1) / _OPAQUE
_LINEAR = np.where(_SRGB <= 0.04045, _SRGB / 12.92, ((_SRGB + 0.055) / 1.055) ** 2.4)  # noqa: PLR2004
"""Linear value of each 8-bit sRGB value, by IEC 61966-2-1."""
_PLACES = 3


def linear_rgb(colour: str) -> Rgb:
    """Linear red, green and blue of ``#rrggbb``, rounded to four decimals."""
    red, green, blue = (round(float(_LINEAR[int(colour[start : start + 2], 16)]), 4) for start in (1, 3, 5))
    return red, green, blue


def material_colour(material: Material) -> Rgb:
    """Linear colour of a material; the mean colour of its texture if it has one."""
    if material.colour_texture is None:
        return material.colour_rgb
    red, green, blue = (
        round(mean * tint, _PLACES)
        for mean, tint in zip(mean_colour(material.colour_texture), material.tint_rgb, strict=True)
    )
    return red, green, blue


@lru_cache(maxsize=256)
def mean_colour(texture: Texture) -> Rgb:
    """Linear mean colour of a texture, weighted by its opacity if it has one."""
    if isinstance(texture, PaintedTexture):
        worn = _mean_wear(texture.mask)
        red, green, blue = (
            round(paint * (1 - worn) + ground * worn, _PLACES)
            for paint, ground in zip(texture.paint_rgb, texture.ground_rgb, strict=True)
        )
        return red, green, blue
    if isinstance(texture, OwnTexture):
        pixels = own_pixels(texture, TextureQuality.LOW).convert("RGBA")
    else:
        file = (
            io.BytesIO(texture.data)
            if isinstance(texture, StoredTexture)
            else texture_folder(TextureQuality.LOW) / texture
        )
        with Image.open(file) as picture:
            pixels = picture.convert("RGBA")
    *channels, opacity = np.asarray(pixels).reshape(-1, 4).T
    weights = None if opacity.min() == _OPAQUE else opacity / _OPAQUE
    counts = (np.bincount(channel, weights, minlength=len(_LINEAR)) for channel in channels)
    red, green, blue = (round(float(count @ _LINEAR) / max(float(count.sum()), 1.0), _PLACES) for count in counts)
    return red, green, blue


@lru_cache(maxsize=16)
def _mean_wear(mask: str) -> float:
    """Mean worn share of the paint in a wear mask, 0 to 1."""
    with Image.open(texture_folder(TextureQuality.LOW) / mask) as picture:
        entries = len(picture.getpalette() or ()) // 3
        return float(np.asarray(picture).mean()) / max(entries - 1, 1)
