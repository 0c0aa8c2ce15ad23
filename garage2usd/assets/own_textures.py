"""The user's textures, converted to formats that all readers of USD support: 8-bit PNG, or unchanged JPEG."""

import hashlib
import io
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import TypeVar

import numpy as np
from PIL import Image, UnidentifiedImageError

from garage2usd.assets.materials import OwnTexture
from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError
from garage2usd.config.map_names import Channel
from garage2usd.config.outputs import TextureQuality
from garage2usd.config.texture_sets import MapFile

Given = TypeVar("Given")
_LARGEST_PX = {TextureQuality.LOW: 512, TextureQuality.MEDIUM: 1024, TextureQuality.HIGH: 2048}
"""Greatest length of the longer side by quality; larger images are downscaled."""
_MOST_PX, _MOST_BYTES = 16384, 128 * 1024 * 1024
_BANDS = (Channel.OCCLUSION, Channel.ROUGHNESS, Channel.METALLIC)
_WIDE = frozenset({"I;16", "I;16B", "I;16L", "I;16N", "I"})
"""Pillow's modes of 16-bit grey images."""
_ALPHA = 3
"""Band of transparency, in which Unity keeps smoothness."""
_JPEG_QUALITY, _COMPRESSION = 90, 6
_BYTE, _HIGH_BYTE = 255, 8
_ORIENTATION, _UPRIGHT = 0x0112, 1
"""Orientation tag of Exif, and its value for an upright image."""


def own_shape(file: MapFile, role: str) -> tuple[int, int]:
    """Width and height of an image in pixels; raises as `own_file`."""
    return _opened(file, role, lambda picture: picture.size)


def own_file(texture: OwnTexture, quality: TextureQuality) -> tuple[bytes, str]:
    """Encode a texture: its bytes and its extension, ``.png`` or ``.jpg``.

    An image that all readers support, and that is not too large for the quality, is kept unchanged. Colour from other
    JPEGs is encoded as JPEG, everything else as PNG: 16 bits are reduced to 8, palettes are expanded, normals have
    green upwards, and occlusion, roughness and metallic are packed into red, green and blue.

    Raises
    ------
    ConfigError
        If a file is not such an image, cannot be read, or has changed since the settings were read.
    """
    if (kept := _kept(texture, quality)) is not None:
        return kept
    stream, pixels = io.BytesIO(), own_pixels(texture, quality)
    channel, file = texture.maps[0]
    if channel is Channel.COLOUR and _opened(file, texture.role, _facts)[0] == "JPEG":
        pixels.save(stream, format="JPEG", quality=_JPEG_QUALITY, subsampling="4:2:0", optimize=True)
        return stream.getvalue(), ".jpg"
    # level 9 takes ten times as long for a photograph that is 1 % smaller
    pixels.save(stream, format="PNG", compress_level=_COMPRESSION)
    return stream.getvalue(), ".png"


@lru_cache(maxsize=64)
def own_pixels(texture: OwnTexture, quality: TextureQuality) -> Image.Image:
    """Decode a texture as an RGB image; raises as `own_file`."""
    maps = dict(texture.maps)
    if Channel.COLOUR in maps:
        return _smaller(_loaded(maps[Channel.COLOUR], texture.role), quality)
    if Channel.NORMAL in maps:
        normal = _smaller(_loaded(maps[Channel.NORMAL], texture.role), quality)
        if not maps[Channel.NORMAL].is_turned:
            return normal
        red, green, blue = normal.split()
        return Image.merge("RGB", (red, green.point([_BYTE - value for value in range(_BYTE + 1)]), blue))
    usual = (_BYTE, round(texture.roughness * _BYTE), round(texture.metallic * _BYTE))
    bands = {channel: _smaller(_band(maps[channel], texture.role), quality) for channel in _BANDS if channel in maps}
    size = max((band.size for band in bands.values()), key=lambda sides: sides[0] * sides[1])
    return Image.merge(
        "RGB",
        [
            bands[channel].resize(size, Image.Resampling.BOX) if channel in bands else Image.new("L", size, value)
            for channel, value in zip(_BANDS, usual, strict=True)
        ],
    )


def _kept(texture: OwnTexture, quality: TextureQuality) -> tuple[bytes, str] | None:
    """Contents of a file that every reader supports unchanged; else None."""
    files = {file._replace(band=None) for _, file in texture.maps}
    bands = {channel: file.band for channel, file in texture.maps if file.band is not None}
    file = next(iter(files))
    is_packed = bands == {channel: number for number, channel in enumerate(_BANDS)}
    if len(files) > 1 or file.is_turned or not (is_packed or texture.maps[0][0] in {Channel.COLOUR, Channel.NORMAL}):
        return None
    data = _data(file, texture.role)
    kind, mode, size, turn = _opened(file, texture.role, _facts)
    if mode != "RGB" or turn != _UPRIGHT or max(size) > _LARGEST_PX[quality]:
        return None
    if kind == "PNG":
        # images with 16 bits per channel have the mode RGB too
        return (data, ".png") if data[24] == _HIGH_BYTE else None
    return data, ".jpg"


def _facts(picture: Image.Image) -> tuple[str | None, str, tuple[int, int], int]:
    """Format, mode, size and Exif orientation of an image; readers differ in their support of the latter."""
    return picture.format, picture.mode, picture.size, picture.getexif().get(_ORIENTATION, _UPRIGHT)


def _loaded(file: MapFile, role: str) -> Image.Image:
    """Load an image as RGB; grey is repeated, transparency is dropped."""
    return _opened(file, role, _rgb)


def _band(file: MapFile, role: str) -> Image.Image:
    """Load one channel of an image: that of the file's band, or red of a separate image."""
    if file.band == _ALPHA:
        band = _opened(file, role, lambda picture: picture.convert("RGBA").getchannel(_ALPHA))
    else:
        band = _loaded(file, role).getchannel(file.band or 0)
    return band.point([_BYTE - value for value in range(_BYTE + 1)]) if file.is_turned else band


def _rgb(picture: Image.Image) -> Image.Image:
    if picture.mode in _WIDE:
        values = np.asarray(picture).astype(np.uint32)
        return Image.fromarray((values >> _HIGH_BYTE).astype(np.uint8)).convert("RGB")
    if picture.mode in {"P", "PA"}:
        picture = picture.convert("RGBA")
    if picture.mode in {"RGBA", "LA"}:
        bands = picture.split()[:-1]
        return Image.merge("RGB", bands * (3 // len(bands)))
    return picture.convert("RGB")


def _smaller(picture: Image.Image, quality: TextureQuality) -> Image.Image:
    """Downscale an image to the quality's limit; a pixel is the mean of those that it covers."""
    largest = _LARGEST_PX[quality]
    if max(picture.size) <= largest:
        return picture
    scale = largest / max(picture.size)
    return picture.resize([max(1, round(side * scale)) for side in picture.size], Image.Resampling.BOX)


def _opened(file: MapFile, role: str, use: Callable[[Image.Image], Given]) -> Given:
    """Open an image and apply a function to it; raises as `own_file`."""
    field, allowed = f"look.textures.{role}", "a PNG, or a JPEG in grey or in red, green and blue"
    data = _data(file, role)
    try:
        with Image.open(io.BytesIO(data), formats=("PNG", "JPEG")) as picture:
            if picture.mode == "CMYK":
                raise ConfigError(field, f"{file.path} in CMYK", allowed)
            if max(picture.size) > _MOST_PX:
                raise ConfigError(field, f"{file.path} of {picture.size}", f"sides of at most {_MOST_PX} pixels")
            return use(picture)
    except (UnidentifiedImageError, OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        if isinstance(error, ConfigError):
            raise
        reason = "" if isinstance(error, UnidentifiedImageError) else f" ({error})"
        raise ConfigError(field, file.path, f"{allowed}{reason}") from None


@lru_cache(maxsize=32)
def _data(file: MapFile, role: str) -> bytes:
    """Read a file and verify its digest."""
    field = f"look.textures.{role}"
    data = read_bytes(Path(file.path), field=field, max_bytes=_MOST_BYTES)
    if hashlib.sha256(data).hexdigest() != file.sha256:
        raise ConfigError(field, file.path, "a file that stays as it was when the settings were read")
    return data
