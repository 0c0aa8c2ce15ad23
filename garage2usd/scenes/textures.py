"""Textures read from the nodes UsdUVTexture, UsdTransform2d and UsdPrimvarReader_float2."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdShade

from garage2usd.scenes.pictures import Band, Pictures
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.values import READ_AT, numbers_of, vector_of

PRIMVAR_READER = "UsdPrimvarReader_"
UV_TEXTURE, _TRANSFORM = "UsdUVTexture", "UsdTransform2d"
_CHANNELS = {"rgb": -1, "r": 0, "g": 1, "b": 2, "a": 3}
_DEEPEST = 16
"""Greatest number of chained coordinate transforms: connections may be circular."""
_FIRST_TILE, _COLUMNS = 1001, 10
"""Number of the first UDIM tile, and of tiles in a row."""
_WHOLE = 1, 1
"""Columns and rows of a picture that is not of tiles."""
MISSING_PICTURE = "textures whose file is missing show their fallback"
LEFT_OUT = "are left out, and their fallback is shown"
_WRAPS = {"mirror": "mirror", "clamp": "clamp", "black": "clamp"}
_SQUARE = 1e-6
_Number = TypeVar("_Number", bound=np.floating[Any])
Four = tuple[float, float, float, float]


class Coordinates(NamedTuple):
    """Texture coordinates of a surface.

    Attributes
    ----------
    name
        Name of the primvar; empty for none.
    fallback
        Coordinates of a prim without the primvar.
    """

    name: str
    fallback: tuple[float, float] = (0.0, 0.0)


USUAL_COORDINATES = Coordinates("st")


class Layout(NamedTuple):
    """Layout of a texture on a surface.

    Attributes
    ----------
    coordinates
        Texture coordinates.
    scale, rotation_rad, translation
        Transforms of the coordinates, in this order; the rotation is counter-clockwise.
    wrap_s, wrap_t
        Wrap mode outside the unit square: ``repeat``, ``mirror`` or ``clamp``.
    """

    coordinates: Coordinates = USUAL_COORDINATES
    scale: tuple[float, float] = (1.0, 1.0)
    rotation_rad: float = 0.0
    translation: tuple[float, float] = (0.0, 0.0)
    wrap_s: str = "repeat"
    wrap_t: str = "repeat"

    @property
    def is_moved(self) -> bool:
        """True if the texture coordinates are transformed."""
        return (self.scale, self.rotation_rad, self.translation) != ((1.0, 1.0), 0.0, (0.0, 0.0))

    def placed(self, coordinates: NDArray[_Number]) -> NDArray[_Number]:
        """Transform texture coordinates, shape (..., 2)."""
        if not self.is_moved:
            return coordinates
        cos, sin = math.cos(self.rotation_rad), math.sin(self.rotation_rad)
        scaled = coordinates * np.array(self.scale)
        turned = scaled @ np.array([[cos, sin], [-sin, cos]]) + np.array(self.translation)
        placed: NDArray[_Number] = turned.astype(coordinates.dtype)
        return placed


class Texture(NamedTuple):
    """A picture as the value of an input: each pixel, linear, times `scale` plus `bias`.

    Attributes
    ----------
    file
        Resolved asset path of a picture that can be read.
    channel
        0 to 3 for red, green, blue and alpha; -1 for red, green and blue.
    layout
        Layout on the surface.
    scale, bias
        Factors and offsets of red, green, blue and alpha.
    colour_space
        ``sRGB``, ``raw`` or ``auto``.
    """

    file: str
    channel: int = -1
    layout: Layout = Layout()
    scale: Four = (1.0, 1.0, 1.0, 1.0)
    bias: Four = (0.0, 0.0, 0.0, 0.0)
    colour_space: str = "auto"

    def band(self, channel: int = 0) -> Band:
        """Return the texture's band of red, green, blue or alpha (0 to 3), or its single channel."""
        taken = channel if self.channel < 0 else self.channel
        return Band(self.file, taken, self.colour_space, self.scale[taken], self.bias[taken])


class Source(NamedTuple):
    """Source of an input's value: an attribute with the value, or the output of a shader.

    Attributes
    ----------
    attribute
        Attribute with the value, or the output.
    shader
        The shader; None for a value.
    """

    attribute: Usd.Attribute
    shader: UsdShade.Shader | None

    @property
    def node(self) -> str:
        """Identifier of the source's shader; empty for a value."""
        return str(self.shader.GetIdAttr().Get() or "") if self.shader else ""


def source_of(shader: UsdShade.ConnectableAPI, name: str) -> Source | None:
    """Find the source of an input's value, through interfaces of materials and node graphs; None without one."""
    given = shader.GetInput(name)
    # most inputs of most shaders are as they are by default
    if not given or not given.GetAttr().IsAuthored():
        return None
    for attribute in given.GetValueProducingAttributes():
        if UsdShade.Utils.GetType(attribute.GetName()) == UsdShade.AttributeType.Input:
            return Source(attribute, None) if attribute.HasValue() else None
        maker = UsdShade.Shader(attribute.GetPrim())
        if maker and maker.GetIdAttr().Get():
            return Source(attribute, maker)
        if attribute.HasAuthoredValue():
            return Source(attribute, None)
    return None


class TextureReader:
    """Reader of UsdUVTexture nodes.

    Parameters
    ----------
    pictures
        Pictures of the textures.
    remarks
        Collector of omitted properties.
    """

    def __init__(self, pictures: Pictures, remarks: Remarks) -> None:
        self._pictures, self._remarks = pictures, remarks
        self._whole: dict[Sdf.Path, Texture | Four] = {}

    def read(self, source: Source) -> Texture | Four:
        """Return the texture of a UsdUVTexture; red, green, blue and alpha if it shows its fallback everywhere."""
        reader = source.shader
        channel = _CHANNELS.get(UsdShade.Output(source.attribute).GetBaseName(), -1)
        # several inputs read channels of one texture
        path = source.attribute.GetPrimPath()
        if path not in self._whole:
            self._whole[path] = self._of(reader)
        whole = self._whole[path]
        if isinstance(whole, Texture):
            return whole._replace(channel=channel)
        return whole if channel < 0 else (whole[channel],) * 4

    def _of(self, reader: UsdShade.Shader) -> Texture | Four:
        """Return all channels of a texture."""
        file, tiles = self._file(reader)
        if not file:
            return _numbers(reader, "fallback", (0.0, 0.0, 0.0, 1.0))
        layout = self._layout(reader, Layout(scale=(1 / tiles[0], 1 / tiles[1])))
        layout = layout._replace(wrap_s=self._wrap(reader, "wrapS"), wrap_t=self._wrap(reader, "wrapT"))
        scale, bias = _numbers(reader, "scale", (1.0,) * 4), _numbers(reader, "bias", (0.0,) * 4)
        return Texture(file, -1, layout, scale, bias, _word(reader, "sourceColorSpace", "auto"))

    def _file(self, reader: UsdShade.Shader) -> tuple[str, tuple[int, int]]:
        """Return the resolved path of a texture's picture, empty if none can be read, and its columns and rows."""
        source = source_of(reader, "file")
        value = source.attribute.Get(READ_AT) if source is not None and source.shader is None else None
        if source is None or not isinstance(value, Sdf.AssetPath) or not value.path:
            return "", _WHOLE
        tiles = {(0, 0): value.resolvedPath}
        if UsdShade.UdimUtils.IsUdimIdentifier(value.path):
            tiles = _tiles(value.path, source.attribute)
        if not tiles or not all(tiles.values()):
            self._remarks.add(MISSING_PICTURE, value.path)
            return "", _WHOLE
        for path in tiles.values():
            if fault := self._pictures.fault(path):
                self._remarks.add(f"pictures that {fault} {LEFT_OUT}", value.path)
                return "", _WHOLE
        if len(tiles) == 1 and (0, 0) in tiles:
            return str(tiles[0, 0]), _WHOLE
        columns, rows = (1 + max(place[axis] for place in tiles) for axis in (0, 1))
        return self._pictures.mosaic(tiles), (columns, rows)

    def _wrap(self, reader: UsdShade.Shader, name: str) -> str:
        word = _word(reader, name, "useMetadata")
        if word == "black":
            self._remarks.add("textures are clamped where they should be black outside", reader.GetPath())
        return _WRAPS.get(word, "repeat")

    def _layout(self, reader: UsdShade.Shader, last: Layout) -> Layout:
        """Return the texture coordinates of a texture, and their transform; `last` is applied after all others."""
        steps: list[Layout] = [last] if last.is_moved else []
        node, name = reader, "st"
        for _ in range(_DEEPEST):
            source = source_of(node, name)
            if source is None and node is reader:
                self._remarks.add("textures without coordinates are read at those of the name st", reader.GetPath())
                return self._after(USUAL_COORDINATES, steps, reader)
            if source is None or source.shader is None:
                fixed = _pair(node, name, (0.0, 0.0))
                return self._after(Coordinates("", fixed), steps, reader)
            node, name = source.shader, "in"
            if source.node == f"{PRIMVAR_READER}float2":
                wanted = Coordinates(_word(node, "varname", ""), _pair(node, "fallback", (0.0, 0.0)))
                return self._after(wanted, steps, reader)
            if source.node != _TRANSFORM:
                break
            scale, translation = _pair(node, "scale", (1.0, 1.0)), _pair(node, "translation", (0.0, 0.0))
            rotation_rad = math.radians(_number(node, "rotation"))
            steps.append(Layout(scale=scale, rotation_rad=rotation_rad, translation=translation))
        self._remarks.add("texture coordinates that no primvar gives are left out", reader.GetPath())
        return Layout(Coordinates(""))

    def _after(self, coordinates: Coordinates, steps: Sequence[Layout], reader: UsdShade.Shader) -> Layout:
        """Combine several transforms of texture coordinates into one; the last is applied first."""
        if len(steps) <= 1:
            return (steps[0] if steps else Layout())._replace(coordinates=coordinates)
        corners = np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
        for step in reversed(steps):
            corners = step.placed(corners)
        first, second = corners[1:] - corners[0]
        sizes = float(np.linalg.norm(first)), float(np.linalg.norm(second))
        if abs(float(first @ second)) > _SQUARE * sizes[0] * sizes[1]:
            self._remarks.add("transforms of texture coordinates that shear are left out", reader.GetPath())
            return Layout(coordinates)
        rotation_rad = math.atan2(first[1], first[0]) if sizes[0] else math.atan2(-second[0], second[1])
        side = math.copysign(1.0, float(first[0] * second[1] - first[1] * second[0]))
        scale, origin = (sizes[0], side * sizes[1]), (float(corners[0, 0]), float(corners[0, 1]))
        return Layout(coordinates, scale, rotation_rad, origin)


def _tiles(path: str, attribute: Usd.Attribute) -> dict[tuple[int, int], str]:
    """Return the resolved paths of a texture's UDIM tiles, by column and row."""
    (opinion, *_) = attribute.GetPropertyStack(READ_AT)
    found = UsdShade.UdimUtils.ResolveUdimTilePaths(path, opinion.layer)
    return {divmod(int(tile) - _FIRST_TILE, _COLUMNS)[::-1]: str(file) for file, tile in found}


def _word(node: UsdShade.Shader, name: str, otherwise: str) -> str:
    source = source_of(node, name)
    value = source.attribute.Get(READ_AT) if source is not None and source.shader is None else None
    return str(value or otherwise)


def _number(node: UsdShade.Shader, name: str) -> float:
    (number,) = _vector(node, name, (0.0,))
    return number


def _pair(node: UsdShade.Shader, name: str, otherwise: tuple[float, float]) -> tuple[float, float]:
    first, second = _vector(node, name, otherwise)
    return first, second


def _numbers(node: UsdShade.Shader, name: str, otherwise: Four) -> Four:
    red, green, blue, alpha = _vector(node, name, otherwise)
    return red, green, blue, alpha


def _vector(node: UsdShade.Shader, name: str, otherwise: tuple[float, ...]) -> tuple[float, ...]:
    source = source_of(node, name)
    if source is None or source.shader is not None:
        return otherwise
    given = len(numbers_of(source.attribute, np.float64))  # some programs write fewer numbers than the schema requires
    return vector_of(source.attribute, max(1, min(given, len(otherwise)))) + otherwise[given:]
