"""Textures as files whose names say what they hold, so that equal ones of all stages have one name."""

import hashlib
import posixpath
from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import NamedTuple

from garage2usd.assets import Finish, Material, OwnTexture, PaintedTexture, StoredTexture, Texture, finished
from garage2usd.assets.own_textures import own_file
from garage2usd.assets.textures import texture_folder
from garage2usd.assets.worn_paint import painted
from garage2usd.config.stage import TextureQuality

__all__ = ["NamedFile", "content_name", "named_textures", "texture_file", "textures_of"]

_DIGITS = 16
"""Hexadecimal digits of SHA-256 in a name: among a million files two share a name with a chance of 3e-8."""


class NamedFile(NamedTuple):
    """A file that is named by what it holds."""

    name: str
    data: bytes


def content_name(stem: str, data: bytes, suffix: str) -> str:
    """The name of a file by what it holds: `stem`, the beginning of its SHA-256, and `suffix`."""
    return f"{stem}_{hashlib.sha256(data).hexdigest()[:_DIGITS]}{suffix}"


@lru_cache(maxsize=256)
def texture_file(texture: Texture, quality: TextureQuality) -> NamedFile:
    """A texture of the shipped set or the user's own in a quality, or what is made from one; read once a process.

    Raises
    ------
    ConfigError
        If one of the user's own cannot be used.
    """
    if isinstance(texture, OwnTexture):
        data, suffix = own_file(texture, quality)
        return NamedFile(content_name(f"own_{texture.role}_{texture.use}", data, suffix), data)
    if isinstance(texture, StoredTexture):
        return NamedFile(content_name(texture.stem, texture.data, ".png"), texture.data)
    path = texture_folder(quality) / (texture.mask if isinstance(texture, PaintedTexture) else texture)
    data = path.read_bytes()
    if isinstance(texture, PaintedTexture):
        data = painted(data, texture.paint_rgb, texture.ground_rgb)
    return NamedFile(content_name(path.stem, data, path.suffix), data)


def textures_of(
    materials: Iterable[str], finishes: Mapping[str, Finish], quality: TextureQuality
) -> tuple[NamedFile, ...]:
    """The textures of some materials, by their keys, of a garage with some finishes; each once, by name."""
    used = {texture for key in materials for texture in finished(key, finishes).material.textures()}
    return tuple(sorted({texture_file(texture, quality) for texture in used}))


def named_textures(material: Material, quality: TextureQuality, *, folder: str = "") -> Material:
    """A material whose textures have the names that `texture_file` gives them, as paths where a folder is given."""

    def name(texture: Texture | None) -> str | None:
        return None if texture is None else posixpath.join(folder, texture_file(texture, quality).name)

    return replace(
        material,
        colour_texture=name(material.colour_texture),
        packed_texture=name(material.packed_texture),
        normal_texture=name(material.normal_texture),
    )
