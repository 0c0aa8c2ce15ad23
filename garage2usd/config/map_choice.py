"""Choice among the files of a texture set: one map for each channel, and the reason for each file that is not used."""

import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from garage2usd.common.errors import ConfigError, printable
from garage2usd.config.map_names import Channel, MapName, read_map_name

PICTURES = frozenset({".png", ".jpg", ".jpeg"})
"""Extensions of pictures that are read."""
_ALPHA = 3
_IN_WORDS = {Channel.NORMAL: "normals"}


class NamedPicture(NamedTuple):
    """A picture, its path in remarks, and the part of its name that identifies its map."""

    path: Path
    shown: str
    stem: str


class ChosenMap(NamedTuple):
    """A file for a channel, with its band and its direction as in `garage2usd.config.texture_sets.MapFile`."""

    file: NamedPicture
    band: int | None
    is_turned: bool
    order: tuple[int, ...]
    of: tuple[str, ...]

    @property
    def kind(self) -> tuple[int, ...]:
        """Sort key by the name, best first."""
        return (self.band is not None, self.is_turned, *self.order)


class MapChoice(NamedTuple):
    """The maps of a texture set.

    Attributes
    ----------
    maps
        The file of each channel.
    unused
        (file, reason) pairs.
    """

    maps: dict[Channel, ChosenMap]
    unused: list[tuple[str, str]]

    def in_words(self) -> str:
        """Describe the use of each file, and list the files that are not used."""
        uses: dict[str, list[str]] = {}
        for channel, chosen in self.maps.items():
            turned = {Channel.NORMAL: " (green down)", Channel.ROUGHNESS: " (inverted)"}.get(channel, "")
            use = f"{_IN_WORDS.get(channel, channel)}{turned if chosen.is_turned else ''}"
            uses.setdefault(chosen.file.shown, []).append(use)
        used = ", ".join(f"{printable(name)} as {' and '.join(each)}" for name, each in uses.items())
        return f"{used}; {unused_in_words(self.unused)}" if self.unused else used


def unused_in_words(unused: Sequence[tuple[str, str]]) -> str:
    """List files that are not used, with the reasons in brackets."""
    return "not used: " + ", ".join(printable(name) + (f" ({reason})" if reason else "") for name, reason in unused)


def choose_maps(files: Sequence[NamedPicture], *, field: str, normals: str | None = None) -> MapChoice:
    """Choose the map of each channel.

    A map of the same material as the colour is preferred to others, then a map of its own to a packed one, roughness to
    gloss, green upwards to downwards, base colour to diffuse; then the newest version, the first LOD and number, the
    largest in pixels, PNG. `normals` is the direction of green in the chosen normals, 'gl' up or 'dx' down, instead
    of that of their name.

    Raises
    ------
    ConfigError
        If no file is a colour, several materials are given, or a channel is given in a format that is not read only.
    """
    alone = [read_map_name(file.stem) for file in files]
    colours = {name.of for name in alone if Channel.COLOUR in {channel for channel, *_ in name.channels}}
    named = [(file, read_map_name(file.stem, colours)) for file in files]
    found, lacking = _found(named, field=field)
    if not found[Channel.COLOUR]:
        given = ", ".join(file.path.name for file in files[:4])
        raise ConfigError(field, given, "a map whose name says color, albedo, basecolor or diffuse, as PNG or JPEG")
    colour = _best(found[Channel.COLOUR], Channel.COLOUR, field=field)
    maps = {channel: _best(found[channel], channel, field=field, of=colour.of) for channel in Channel if found[channel]}
    if normals and Channel.NORMAL in maps:
        maps[Channel.NORMAL] = maps[Channel.NORMAL]._replace(is_turned=normals == "dx")
    used = {chosen.file.shown for chosen in maps.values()}
    unused = []
    for file, name in named:
        reasons = [] if file.shown in used else _reasons(name, maps)
        reasons += ["without the transparency that holds roughness"] * (file.shown in lacking)
        reasons += name.others
        if reasons or file.shown not in used:
            unused.append((file.shown, "; ".join(reasons)))
    return MapChoice(maps, unused)


def _found(
    named: Sequence[tuple[NamedPicture, MapName]], *, field: str
) -> tuple[dict[Channel, list[ChosenMap]], set[str]]:
    """Find the files of each channel, and the files without the transparency that their name announces."""
    found: dict[Channel, list[ChosenMap]] = {channel: [] for channel in Channel}
    others: dict[Channel, NamedPicture] = {}
    lacking = set[str]()
    for file, name in named:
        for channel, band, is_turned in name.channels:
            if file.path.suffix.lower() not in PICTURES:
                others.setdefault(channel, file)
            elif band == _ALPHA and not _facts(file.path)[1]:
                lacking.add(file.shown)
            else:
                found[channel].append(ChosenMap(file, band, is_turned, name.order, name.of))
    if not found[Channel.COLOUR] and Channel.COLOUR not in others:
        found[Channel.COLOUR] = _plain_colour(named)
    for channel, file in others.items():
        if not found[channel]:
            raise ConfigError(field, str(file.path), f"a PNG or a JPEG of {channel}")
    return found, lacking


def _plain_colour(named: Sequence[tuple[NamedPicture, MapName]]) -> list[ChosenMap]:
    """Picture whose name does not tell its map: the only one, or the only one named as the material of the maps."""
    unnamed = [
        ChosenMap(file, None, False, (), name.of)
        for file, name in named
        if not name.meaning and file.path.suffix.lower() in PICTURES
    ]
    of_maps = {name.of for _, name in named if name.meaning}
    plain = unnamed if len(unnamed) == 1 else [each for each in unnamed if each.of in of_maps]
    return plain if len(plain) == 1 else []


def _best(found: Sequence[ChosenMap], channel: Channel, *, field: str, of: tuple[str, ...] | None = None) -> ChosenMap:
    """Choose among the files of a channel; `of` is the colour's material."""
    same = [each for each in found if each.of == of] or found
    if of is not None:
        best = min(each.kind[:2] for each in same)
        same = [each for each in same if each.kind[:2] == best]
    if len({each.of for each in same}) > 1:
        names = " and ".join(sorted(each.file.path.name for each in same))
        raise ConfigError(field, names, f"one map of {channel}, or several of one material")
    first = min(each.kind for each in same)
    alike = [each for each in same if each.kind == first]
    if len(alike) == 1:
        return alike[0]

    def by_contents(each: ChosenMap) -> tuple[int, bool, int, str]:
        file = each.file
        return -_facts(file.path)[0], file.path.suffix.lower() != ".png", len(file.shown), file.shown

    return min(alike, key=by_contents)


def _reasons(name: MapName, maps: dict[Channel, ChosenMap]) -> list[str]:
    """Explain why a picture is not used."""
    if not name.meaning:
        return ["its name tells no map"]
    return [
        f"{_IN_WORDS.get(channel, channel)}: {printable(maps[channel].file.shown)} is taken"
        for channel, *_ in name.channels
        if channel in maps
    ]


def _facts(path: Path) -> tuple[int, bool]:
    """Number of pixels of a picture, and True if it has transparency; (0, True) for an unreadable picture."""
    # imported on use: few garages have own textures
    from PIL import Image  # noqa: PLC0415

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            with Image.open(path, formats=("PNG", "JPEG")) as picture:
                return picture.width * picture.height, picture.has_transparency_data
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError):
        return 0, True
