"""The user's texture sets: a folder with maps for each role, identified by their names, and the size of a repeat."""

import hashlib
import re
from collections.abc import Iterator, Mapping
from enum import StrEnum
from functools import lru_cache
from pathlib import Path
from typing import Annotated, NamedTuple

from pydantic import Field

from garage2usd.common.documents import read_bytes, read_toml
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings, validated
from garage2usd.common.spelling import nearest
from garage2usd.config.map_names import Channel, channels_of

__all__ = ["REPEAT_M", "MapFile", "Role", "TextureFolder", "TextureSet", "read_texture_sets"]

FIELD = "look.textures"
SIZES_FILE = "textures.toml"
_PICTURES = frozenset({".png", ".jpg", ".jpeg"})
_OTHER_PICTURES = frozenset({".exr", ".hdr", ".tif", ".tiff", ".tga", ".bmp", ".webp", ".dds", ".ktx", ".ktx2", ".gif"})
_MOST_BYTES = 128 * 1024 * 1024
_MOST_FILES = 2000


class Role(StrEnum):
    """Surface of a garage that a texture set covers."""

    FLOOR = "floor"
    STALL = "stall"
    WALL = "wall"
    DADO = "dado"
    CEILING = "ceiling"
    COLUMN = "column"
    PAINT = "paint"
    LANE_PAINT = "lane_paint"
    STEEL = "steel"


REPEAT_M = {
    Role.FLOOR: 2.5,
    Role.STALL: 2.5,
    Role.WALL: 2.5,
    Role.DADO: 2.5,
    Role.CEILING: 2.5,
    Role.COLUMN: 2.0,
    Role.PAINT: 1.0,
    Role.LANE_PAINT: 1.0,
    Role.STEEL: 1.5,
}
"""Size of a texture's repeat in metres, if none is given."""


class MapFile(NamedTuple):
    """A channel of an image file.

    Attributes
    ----------
    path, sha256
        The file, and the digest of its contents.
    band
        Index of red, green or blue; None for all of them, or for a grey image.
    is_turned
        Whether the values are inverted: gloss instead of roughness, or a normal map whose green points down.
    """

    path: str
    sha256: str
    band: int | None = None
    is_turned: bool = False


class TextureSet(NamedTuple):
    """Texture maps of a role.

    Attributes
    ----------
    maps
        (channel, file) pairs in the order of `Channel`.
    repeat_m
        Metres that a repeat covers along U and along V; None for V if the aspect ratio of the image decides.
    """

    maps: tuple[tuple[Channel, MapFile], ...]
    repeat_m: tuple[float, float | None]


class TextureFolder(Settings):
    """Folder of the user's textures."""

    folder: str = Field(min_length=1)
    """A folder with a subfolder for each role, or with files whose names begin with a role: 'floor', 'stall', 'wall',
    'dado', 'ceiling', 'column', 'paint', 'lane_paint' or 'steel'. A relative path starts at the configuration file."""
    sha256: str = Field("", pattern=r"^([0-9a-f]{64})?$")
    """Digest of all files used from the folder; computed when the folder is read."""


class _RoleSizes(Settings):
    """Facts on a role from ``textures.toml``."""

    repeat_m: (
        Annotated[float, Field(gt=0, le=1000)]
        | tuple[Annotated[float, Field(gt=0, le=1000)], Annotated[float, Field(gt=0, le=1000)]]
        | None
    ) = None
    """Metres that a repeat covers, or two numbers: horizontal and vertical."""
    normal: Annotated[str, Field(pattern="^(gl|dx)$")] | None = None
    """Direction of green in the normal map: 'gl' up, 'dx' down; overrides the file's name."""


def read_texture_sets(folder: TextureFolder) -> tuple[TextureFolder, dict[Role, TextureSet]]:
    """Read the texture sets of a folder by role, and add a digest of their files to the folder.

    Raises
    ------
    ConfigError
        If a file cannot be read, a role, a map or a size is unknown, or the files do not match the folder's digest.
    """
    sets = _sets(folder.folder)
    told = [(role, [(channel, *file[1:]) for channel, file in each.maps], each.repeat_m) for role, each in sets.items()]
    digest = hashlib.sha256(repr(told).encode()).hexdigest()
    if folder.sha256 not in {"", digest}:
        raise ConfigError(FIELD, folder.folder, f"the textures that it was given with, of SHA-256 {folder.sha256[:16]}")
    return TextureFolder(folder=folder.folder, sha256=digest), sets


def _sets(folder: str) -> dict[Role, TextureSet]:
    place = Path(folder)
    try:
        files = sorted(_files(place))
        stamps = tuple((str(path), path.stat().st_size, path.stat().st_mtime_ns) for path in files)
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise ConfigError(FIELD, folder, f"a folder that can be read ({reason})") from None
    return _read(folder, stamps)


@lru_cache(maxsize=64)
def _read(folder: str, stamps: tuple[tuple[str, int, int], ...]) -> dict[Role, TextureSet]:
    """Read the texture sets of a folder, cached until one of its files changes."""
    place = Path(folder)
    sizes = _sizes(place)
    found: dict[Role, list[Path]] = {}
    for path in (Path(name) for name, *_ in stamps):
        role = _role_of(path, place)
        if role is not None:
            found.setdefault(role, []).append(path)
    if not found:
        raise ConfigError(FIELD, folder, f"pictures in a folder of a role, or named by one: {', '.join(Role)}")
    if unused := sizes.keys() - found.keys():
        role = min(unused)
        raise ConfigError(f"{FIELD}.{role}", str(place / SIZES_FILE), "sizes of roles that have pictures")
    return {role: _set(role, found[role], sizes.get(role, _RoleSizes())) for role in Role if role in found}


def _files(folder: Path) -> Iterator[Path]:
    """Yield image files, and files that may be images, in the folder and its subfolders."""
    count = 0
    for path in folder.iterdir():
        for file in path.rglob("*") if path.is_dir() else (path,):
            count += 1
            if count > _MOST_FILES:
                raise ValueError(f"it holds more than {_MOST_FILES} files")
            hidden = any(part.startswith((".", "_")) for part in file.relative_to(folder).parts)
            if not hidden and file.is_file() and file.suffix.lower() in _PICTURES | _OTHER_PICTURES | {".toml"}:
                yield file


def _sizes(folder: Path) -> dict[Role, _RoleSizes]:
    path = folder / SIZES_FILE
    if not path.is_file():
        return {}
    sizes = {}
    for role, given in read_toml(path, field=FIELD).items():
        if role not in set(Role):
            raise ConfigError(
                f"{FIELD}.{role}", str(path), f"tables of the roles {', '.join(Role)}{nearest(role, Role)}"
            )
        if not isinstance(given, Mapping):
            raise ConfigError(f"{FIELD}.{role}", given, f"a table with {', '.join(_RoleSizes.model_fields)}")
        sizes[Role(role)] = validated(_RoleSizes, given, within=f"{FIELD}.{role}")
    return sizes


def _role_of(path: Path, folder: Path) -> Role | None:
    """Role of a file, by its folder or the beginning of its name; None if it has none."""
    first = path.relative_to(folder).parts[0].lower()
    if path.suffix.lower() == ".toml":
        return None
    if path.parent != folder:
        if first not in set(Role):
            raise ConfigError(FIELD, str(path.parent), f"folders of the roles {', '.join(Role)}")
        return Role(first)
    for role in sorted(Role, key=len, reverse=True):
        if re.match(rf"{role}(?![a-z0-9])", first):
            return role
    raise ConfigError(FIELD, str(path), f"names that begin with a role: {', '.join(Role)}")


class _Found(NamedTuple):
    """A candidate file for a channel; the least candidate is chosen: not packed, not inverted, PNG before JPEG."""

    is_packed: bool
    is_turned: bool
    is_jpeg: bool
    path: Path
    band: int | None


def _set(role: Role, files: list[Path], sizes: _RoleSizes) -> TextureSet:
    """Build the texture set of a role."""
    field = f"{FIELD}.{role}"
    chosen = _chosen(role, files)
    if Channel.COLOUR not in chosen:
        names = ", ".join(path.name for path in files[:4])
        raise ConfigError(field, names, "a map whose name says color, albedo, basecolor or diffuse, as PNG or JPEG")
    maps = []
    for channel, file in chosen.items():
        digest = hashlib.sha256(read_bytes(file.path, field=field, max_bytes=_MOST_BYTES)).hexdigest()
        is_told = channel is Channel.NORMAL and sizes.normal is not None
        maps.append(
            (channel, MapFile(str(file.path), digest, file.band, sizes.normal == "dx" if is_told else file.is_turned))
        )
    along, up = sizes.repeat_m if isinstance(sizes.repeat_m, tuple) else (sizes.repeat_m or REPEAT_M[role], None)
    return TextureSet(tuple(maps), (along, up))


def _chosen(role: Role, files: list[Path]) -> dict[Channel, _Found]:
    """Choose the file of each channel."""
    field = f"{FIELD}.{role}"
    found: dict[Channel, list[_Found]] = {}
    others: dict[Channel, Path] = {}
    for path in files:
        suffix = path.suffix.lower()
        for channel, band, is_turned in channels_of(re.sub(rf"(?i)^{role}(?![a-z0-9])", "", path.stem)):
            if suffix in _PICTURES:
                found.setdefault(channel, []).append(_Found(band is not None, is_turned, suffix != ".png", path, band))
            else:
                others[channel] = path
    for channel, path in others.items():
        if channel not in found:
            raise ConfigError(field, str(path), f"a PNG or a JPEG of {channel}")
    chosen = {channel: min(found[channel]) for channel in Channel if channel in found}
    for channel, file in chosen.items():
        alike = [other.path.name for other in found[channel] if other[:3] == file[:3]]
        if len(alike) > 1:
            raise ConfigError(field, " and ".join(sorted(alike)), f"one map of {channel}")
    return chosen
