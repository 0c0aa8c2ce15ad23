"""Channels of a texture map by its file name, in the conventions of ambientCG, Poly Haven, glTF and game engines."""

import re
from enum import StrEnum

__all__ = ["Channel", "channels_of"]


class Channel(StrEnum):
    """Quantity that a texture map, or one channel of it, stores."""

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
"""Red, green and blue of a packed map, in glTF's order."""
_BY_LETTER = {"o": Channel.OCCLUSION, "a": Channel.OCCLUSION, "r": Channel.ROUGHNESS, "m": Channel.METALLIC}
_LETTERS = re.compile(r"orm|arm|rma|mra")
_OF_FILE = re.compile(r"\d+k?|\d+px|jpe?g|png|exr|\d+bit|tex|texture|map|gl|ogl|opengl|dx|directx|d3d|srgb|linear")
"""Trailing words of a file name that do not name the quantity: resolution, format, bit depth."""


def channels_of(stem: str) -> list[tuple[Channel, int | None, bool]]:
    """Channels of a texture map by its file stem; empty if the name is not recognised.

    Each is (channel, band or None, whether it is inverted), for example gloss for roughness.
    """
    # split at punctuation and capitals: Concrete034_1K-JPG_NormalGL
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
