"""The maps of textures by their names, as ambientCG, Poly Haven, glTF and engines of games have them."""

import re
from enum import StrEnum

__all__ = ["Channel", "channels_of"]


class Channel(StrEnum):
    """What a map, or one channel of it, tells of a surface."""

    COLOUR = "colour"
    ROUGHNESS = "roughness"
    METALLIC = "metallic"
    OCCLUSION = "occlusion"
    NORMAL = "normal"


_WORDS: dict[Channel, frozenset[str]] = {
    Channel.COLOUR: frozenset(
        {"color", "colour", "col", "albedo", "alb", "basecolor", "basecolour", "diffuse", "diff", "dif", "bc"}
    ),
    Channel.ROUGHNESS: frozenset({"roughness", "rough", "rgh", "gloss", "glossiness", "smoothness"}),
    Channel.METALLIC: frozenset({"metalness", "metallic", "metal", "mtl", "metallness"}),
    Channel.OCCLUSION: frozenset({"ao", "occlusion", "ambientocclusion", "occ"}),
    Channel.NORMAL: frozenset({"normal", "normals", "nor", "nrm", "norm", "n", "normalgl", "normaldx", "normalmap"}),
}
_CHANNEL_OF = {word: channel for channel, words in _WORDS.items() for word in words}
_GLOSS = frozenset({"gloss", "glossiness", "smoothness"})
_DOWNWARDS = frozenset({"dx", "directx", "normaldx", "d3d"})
_PACKED = (Channel.OCCLUSION, Channel.ROUGHNESS, Channel.METALLIC)
"""Red, green and blue of a packed map, as glTF has them."""
_BY_LETTER = {"o": Channel.OCCLUSION, "a": Channel.OCCLUSION, "r": Channel.ROUGHNESS, "m": Channel.METALLIC}
_LETTERS = re.compile(r"orm|arm|rma|mra")
_OF_FILE = re.compile(r"\d+k?|\d+px|jpe?g|png|exr|\d+bit|tex|texture|map|gl|ogl|opengl|dx|directx|d3d|srgb|linear")
"""Words after the one that says what a map is."""


def channels_of(stem: str) -> list[tuple[Channel, int | None, bool]]:
    """What a map of some name holds: (channel, band, whether it is the opposite); nothing where it is not used."""
    # apart by signs and by capitals: Concrete034_1K-JPG_NormalGL
    found = re.findall(r"[A-Z]{2,}(?![a-z])\d*|[A-Z]?[a-z]+\d*|[A-Z]\d*|\d+[A-Za-z]*", stem)
    words = [word.lower() for word in found]
    looks_down = not _DOWNWARDS.isdisjoint(words)
    while len(words) > 1 and _OF_FILE.fullmatch(words[-1]):
        words.pop()
    last = words[-1] if words else ""
    if _LETTERS.fullmatch(last):
        return [(_BY_LETTER[letter], band, False) for band, letter in enumerate(last)]
    named: list[Channel] = []
    while words and words[-1] in _CHANNEL_OF and (not named or {named[0], _CHANNEL_OF[words[-1]]} <= set(_PACKED)):
        named.insert(0, _CHANNEL_OF[words.pop()])
        words = words[:-1] if words[-1:] == ["ambient"] else words
    if len(named) > 1:
        bands = named if len(named) == len(_PACKED) else _PACKED
        return [(channel, bands.index(channel), False) for channel in named]
    return [(channel, None, looks_down if channel is Channel.NORMAL else last in _GLOSS) for channel in named]
