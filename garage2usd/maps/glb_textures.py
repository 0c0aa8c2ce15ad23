"""Textures, samplers and images of glTF 2.0."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from garage2usd.scenes.pictures import Band, Bands, Picture, Pictures
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.textures import Layout

__all__ = ["Textures", "shortest"]

_TRANSFORM = "KHR_texture_transform"
_WRAPS = {"clamp": 33071, "mirror": 33648, "repeat": 10497}
_BYTE = 1 / 255


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
