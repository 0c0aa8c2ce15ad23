"""Textures with content-based file names, so that equal textures of all stages have one name."""

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
"""Hexadecimal digits of SHA-256 in a name; the chance of a collision among a million files is 3e-8."""


class NamedFile(NamedTuple):
    """A file named by its content."""

    name: str
    data: bytes


def content_name(stem: str, data: bytes, suffix: str) -> str:
    """Name a file by its content: `stem`, the beginning of its SHA-256, and `suffix`."""
    return f"{stem}_{hashlib.sha256(data).hexdigest()[:_DIGITS]}{suffix}"


@lru_cache(maxsize=256)
def texture_file(texture: Texture, quality: TextureQuality) -> NamedFile:
    """Load a texture of the package or of the user in a quality, or derive it from one; cached per process.

    Raises
    ------
    ConfigError
        If a texture of the user is invalid.
    """
    if isinstance(texture, OwnTexture):
        data, suffix = own_file(texture, quality)
        return NamedFile(content_name(f"own_{texture.role}_{texture.use}", data, suffix), data)
    if isinstance(texture, StoredTexture):
        return NamedFile(content_name(texture.stem, texture.data, texture.suffix), texture.data)
    path = texture_folder(quality) / (texture.mask if isinstance(texture, PaintedTexture) else texture)
    data = path.read_bytes()
    if isinstance(texture, PaintedTexture):
        data = painted(data, texture.paint_rgb, texture.ground_rgb)
    return NamedFile(content_name(path.stem, data, path.suffix), data)


def textures_of(
    materials: Iterable[str], finishes: Mapping[str, Finish], quality: TextureQuality
) -> tuple[NamedFile, ...]:
    """List the textures of materials, by the materials' keys, with the given finishes; each once, sorted by name."""
    used = {texture for key in materials for texture in finished(key, finishes).material.textures()}
    return tuple(sorted({texture_file(texture, quality) for texture in used}))


def named_textures(material: Material, quality: TextureQuality, *, folder: str = "") -> Material:
    """Replace the textures of a material by their names from `texture_file`, or by paths if a folder is given."""

    def name(texture: Texture | None) -> str | None:
        return None if texture is None else posixpath.join(folder, texture_file(texture, quality).name)

    return replace(
        material,
        colour_texture=name(material.colour_texture),
        packed_texture=name(material.packed_texture),
        normal_texture=name(material.normal_texture),
    )
