"""Textures, samplers and images of glTF 2.0."""

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from garage2usd.reading.pictures import Band, Bands, Picture, Pictures
from garage2usd.reading.remarks import Remarks
from garage2usd.reading.textures import Layout

__all__ = ["Textures", "shortest"]

_TRANSFORM = "KHR_texture_transform"
_WRAPS = {"clamp": 33071, "mirror": 33648, "repeat": 10497}
_BYTE = 1 / 255


class Textures:
    """Collects the textures of a file: each that differs once, and so each image.

    Parameters
    ----------
    pictures
        What textures show.
    remarks
        Told of what no texture can say.

    Attributes
    ----------
    textures, samplers
        As the arrays of glTF's JSON have them.
    images
        What the textures show.
    extensions
        Those that they use.
    """

    def __init__(self, pictures: Pictures, remarks: Remarks) -> None:
        self.textures: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []
        self.images: list[Picture] = []
        self.extensions: set[str] = set()
        self._pictures, self._remarks = pictures, remarks
        self._image_of: dict[tuple[Bands, bool], int] = {}

    def info(self, bands: Bands, layout: Layout, *, is_srgb: bool = False) -> dict[str, Any]:
        """What refers to the texture that consists of some bands, without its set of coordinates.

        Parameters
        ----------
        bands
            What it shows, one of them of a picture.
        layout
            How it lies on the surface.
        is_srgb
            Whether red, green and blue are read as sRGB.
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
    """Numbers of single precision in the fewest digits that mean the same."""
    return [float(np.format_float_positional(np.float32(value), unique=True, trim="0")) for value in values]


def _transform(layout: Layout) -> dict[str, Any]:
    """A layout as KHR_texture_transform, whose v runs down: from v to 1 - v, the layout, and back."""
    (_, scale_v), (move_u, move_v), turn = layout.scale, layout.translation, layout.rotation_rad
    offset = move_u - scale_v * math.sin(turn), 1 - move_v - scale_v * math.cos(turn)
    found = {"offset": shortest(offset), "rotation": shortest([turn])[0], "scale": shortest(layout.scale)}
    usual = {"offset": [0.0, 0.0], "rotation": 0.0, "scale": [1.0, 1.0]}
    return {name: value for name, value in found.items() if value != usual[name]}


def _number(values: list[Any], value: object) -> int:
    """Number of a value among others, to which it is added if it is new."""
    if value not in values:
        values.append(value)
    return values.index(value)
