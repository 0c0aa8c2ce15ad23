"""The user's texture sets: a folder with maps for each role, told by their names, and the size of a repeat."""

import hashlib
import re
from collections.abc import Iterator, Mapping
from enum import StrEnum
from functools import lru_cache
from pathlib import Path
from typing import Annotated, NamedTuple

from pydantic import Field

from garage2usd.common.documents import read_bytes, read_toml
from garage2usd.common.errors import ConfigError, printable
from garage2usd.common.settings import Settings, validated
from garage2usd.common.spelling import nearest
from garage2usd.config.map_choice import PICTURES, MapChoice, NamedPicture, choose_maps, unused_in_words
from garage2usd.config.map_names import Channel, channels_of

FIELD = "look.textures"
SIZES_FILE = "textures.toml"
_OTHER_PICTURES = frozenset({".exr", ".hdr", ".tif", ".tiff", ".tga", ".bmp", ".webp", ".dds", ".ktx", ".ktx2", ".gif"})
_UNSEEN = frozenset({"thumbs.db", "ehthumbs.db", "desktop.ini", "icon\r", "__macosx", "@eadir"})
"""Files and folders that systems leave in folders, beside those that begin with a point."""
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
        Index of red, green, blue or transparency; None for red to blue, or for a grey image.
    is_turned
        True if the values are inverted: gloss instead of roughness, or a normal map whose green points down.
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
    sets = _contents(folder.folder).sets
    told = [(role, [(channel, *file[1:]) for channel, file in each.maps], each.repeat_m) for role, each in sets.items()]
    digest = hashlib.sha256(repr(told).encode()).hexdigest()
    if folder.sha256 not in {"", digest}:
        raise ConfigError(FIELD, folder.folder, f"the textures that it was given with, of SHA-256 {folder.sha256[:16]}")
    return TextureFolder(folder=folder.folder, sha256=digest), sets


def texture_remarks(folder: TextureFolder) -> tuple[str, ...]:
    """Describe the use of the files of a texture folder, and list unused ones; raises as `read_texture_sets`."""
    return _contents(folder.folder).remarks


class _Contents(NamedTuple):
    """Texture sets of a folder, and a remark on the files of each role and on the other files."""

    sets: dict[Role, TextureSet]
    remarks: tuple[str, ...]


def _contents(folder: str) -> _Contents:
    place = Path(folder)
    try:
        files = sorted(_files(place))
        stamps = tuple((str(path), path.stat().st_size, path.stat().st_mtime_ns) for path in files)
    except (OSError, ValueError) as error:
        reason = (error.strerror if isinstance(error, OSError) else None) or error
        raise ConfigError(FIELD, folder, f"a folder that can be read ({reason})") from None
    return _read(folder, stamps)


@lru_cache(maxsize=64)
def _read(folder: str, stamps: tuple[tuple[str, int, int], ...]) -> _Contents:
    """Read the texture sets of a folder, cached until one of its files changes."""
    place = Path(folder)
    sizes = _sizes(place)
    found: dict[Role, list[Path]] = {}
    others: dict[Role | None, list[tuple[Path, str]]] = {None: []}
    for path in (Path(name) for name, *_ in stamps):
        role, reason = _role_of(path, place)
        if path.suffix.lower() in PICTURES | _OTHER_PICTURES and role is not None and not reason:
            found.setdefault(role, []).append(path)
        elif path != place / SIZES_FILE:
            others.setdefault(role, []).append((path, reason))
    if not found:
        raise ConfigError(FIELD, folder, f"pictures in a folder of a role, or named by one: {', '.join(Role)}")
    if unused := sizes.keys() - found.keys():
        role = min(unused)
        raise ConfigError(f"{FIELD}.{role}", str(place / SIZES_FILE), "sizes of roles that have pictures")
    sets, remarks = {}, []
    for role in Role:
        if role in found:
            above = _above([*found[role], *(path for path, _ in others.get(role, ()))], place)
            pictures = [
                NamedPicture(path, path.relative_to(above).as_posix(), _divided(path.stem)[1]) for path in found[role]
            ]
            of_role = sizes.get(role, _RoleSizes())
            choice = choose_maps(pictures, field=f"{FIELD}.{role}", normals=of_role.normal)
            choice.unused.extend((path.relative_to(above).as_posix(), why) for path, why in others.pop(role, ()))
            sets[role] = _set(role, choice, of_role)
            remarks.append(f"{_shown(above, place, role)}: {choice.in_words()}")
    rest = [(path.relative_to(place).as_posix(), why) for each in others.values() for path, why in each]
    if rest:
        remarks.append(f"{_shown(place, place)}: {unused_in_words(rest)}")
    return _Contents(sets, tuple(remarks))


def _files(folder: Path) -> Iterator[Path]:
    """Yield the files in the folder and its subfolders, without hidden ones."""
    count = 0
    for path in folder.iterdir():
        for file in path.rglob("*") if path.is_dir() else (path,):
            count += 1
            if count > _MOST_FILES:
                raise ValueError(f"it holds more than {_MOST_FILES} files")
            parts = file.relative_to(folder).parts
            if not any(part.startswith(".") or part.lower() in _UNSEEN for part in parts) and file.is_file():
                yield file


def _above(files: list[Path], folder: Path) -> Path:
    """Folder to which paths in remarks are relative: that of the role if it holds all files, else the whole folder."""
    firsts = {path.relative_to(folder).parts[0] for path in files}
    only = folder / min(firsts)
    return only if len(firsts) == 1 and only.is_dir() else folder


def _shown(above: Path, folder: Path, role: Role | None = None) -> str:
    name = printable(folder.absolute().name)
    if above != folder:
        return f"{name}/{printable(above.name)}"
    return f"{name}, {role}" if role else name


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


def _role_of(path: Path, folder: Path) -> tuple[Role | None, str]:
    """Role of a file, by its folder or the beginning of its name; without a role, the reason if the file is a picture.

    Raises
    ------
    ConfigError
        For a picture whose name tells a map, but no role.
    """
    first, *below = path.relative_to(folder).parts
    is_below = bool(below)
    role, rest = _divided(first)
    is_picture = path.suffix.lower() in PICTURES | _OTHER_PICTURES
    if any(part.startswith("_") for part in (first, *below[:-1])):
        return (role if is_below else None), "set aside by _"
    if role is not None and (not is_below or not rest):
        return (role, "") if is_below or is_picture else (None, "")
    if is_picture and channels_of(path.stem):
        if is_below:
            raise ConfigError(FIELD, str(path.parent), f"folders of the roles {', '.join(Role)}")
        raise ConfigError(FIELD, str(path), f"names that begin with a role: {', '.join(Role)}")
    return None, "its name tells no role" if is_picture else ""


def _divided(name: str) -> tuple[Role | None, str]:
    """Divide a name into the role at its beginning and the rest: ``FloorBaseColor``, ``T_lane-paint_D``."""
    for role in sorted(Role, key=len, reverse=True):
        words = r"[\W_]*".join(role.split("_"))
        if found := re.match(rf"(?:[Tt]_)?((?i:{words}))(?![a-z0-9])", name):
            rest = name[found.end() :]
            if not (found[1].isupper() and rest[:1].isalpha()):
                return role, rest
    return None, name


def _set(role: Role, choice: MapChoice, sizes: _RoleSizes) -> TextureSet:
    """Build the texture set of a role."""
    maps = []
    for channel, chosen in choice.maps.items():
        path = chosen.file.path
        digest = hashlib.sha256(read_bytes(path, field=f"{FIELD}.{role}", max_bytes=_MOST_BYTES)).hexdigest()
        maps.append((channel, MapFile(str(path), digest, chosen.band, chosen.is_turned)))
    along, up = sizes.repeat_m if isinstance(sizes.repeat_m, tuple) else (sizes.repeat_m or REPEAT_M[role], None)
    return TextureSet(tuple(maps), (along, up))
