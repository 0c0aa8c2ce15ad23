"""Quantities of a texture map by its file name, as Substance, ambientCG, Poly Haven, Megascans and engines write it."""

import re
from collections.abc import Collection
from enum import StrEnum
from typing import NamedTuple

from garage2usd.common.documents import shipped_toml


class Channel(StrEnum):
    """Quantity that a texture map, or one channel of it, stores."""

    COLOUR = "colour"
    ROUGHNESS = "roughness"
    METALLIC = "metallic"
    OCCLUSION = "occlusion"
    NORMAL = "normal"


_PACKED = (Channel.OCCLUSION, Channel.ROUGHNESS, Channel.METALLIC)
"""Red, green and blue of a packed map, in glTF's order."""
_GLOSS, _SPECULAR, _OPACITY, _HEIGHT, _MANY = "gloss", "specular", "opacity", "height", "a packed map"
_NO_PAIRS = ([Channel.METALLIC, Channel.OCCLUSION], [Channel.ROUGHNESS, Channel.OCCLUSION])
"""Quantities that no map has in this order, with a third one before: metal_ao is the occlusion of a metal."""
_ALPHA = 3
"""Band of transparency."""
_WORDS: dict[str, str] = shipped_toml("garage2usd.config", "map_words")
"""Words of file names by quantity. Those of one letter count in the last place only, behind others or a dash."""
_UP, _DOWN = ("gl", "ogl"), ("dx", "d3d")
_MEANING = {word: meaning for meaning, words in _WORDS.items() for word in words.split()}
_MEANING |= {word + way: Channel.NORMAL for word in _WORDS[Channel.NORMAL].split() for way in (*_UP, *_DOWN)}
_MEANING |= {
    f"{layer}{word}": meaning
    for meaning in ("coat", "sheen", "detail", "emission", "translucency", _SPECULAR)
    for layer in _WORDS[meaning].split()
    for word in ("color", "colour", "albedo", "normal", "opacity", "weight", "roughness", "occlusion")
    if meaning != _SPECULAR or word.startswith("col")
}
"""Colour, normals and roughness of a layer are not those of the material below it."""
_MEANING |= {f"{word}map": meaning for word, meaning in _MEANING.items() if len(word) > 1}
_ANYWHERE = re.compile(
    r"basecolou?r|albedo|colou?r|diffuse|normals?|normal(map|gl|dx)|roughness|glossiness|smoothness|metalness|(ambient)?occlusion"
    r"|displacement|height|opacity|emissive"
)
"""Words that also count before others, since no material is named so: 'rough' and 'metal' are not among them."""
_SECOND = frozenset({"diffuse", "diff", "dif", "diffusecolor", "diffusecolour", "ao", "occlusion", "ambientocclusion"})
"""Words that give way to others of their quantity: to base colour, and to Substance's occlusion of mesh and height."""
_LETTERS = {
    "o": Channel.OCCLUSION,
    "a": Channel.OCCLUSION,
    "ao": Channel.OCCLUSION,
    "r": Channel.ROUGHNESS,
    "m": Channel.METALLIC,
}
_OF_LETTERS = re.compile("a?orm|ormh|ord|ordp|orh|ar[mdh]|rma[oh]?|mrao?|mro|rmo|omr")
"""Packed maps named by a letter for each channel, of which D, Dp and H are height."""
_OF_UNITY = ((Channel.METALLIC, 0, False), (Channel.OCCLUSION, 1, False), (Channel.ROUGHNESS, _ALPHA, True))
_UNITY_MASKS = frozenset({"maskmap", "mads"})
_OF_FILE = re.compile(
    r"\d+k?|\d+x\d*|\d+(px|bits?)|bits?|jpe?g|png|tiff?|tga|exr|webp|bmp|tex(ture)?s?|maps?|o?gl|dx|d3d"
    r"|srgb|linear|raw|utility|seamless|tile(able|d)?|(hi|low?|high)(res)?|copy|final|(v|var|lod)\d+"
)
"""Words that do not name the quantity: resolution, format, bit depth, colour space, version, variant and LOD."""
_SIZES_PX = frozenset(2**power for power in range(7, 15))
_COUNTED = re.compile(r"(?i)(?<![a-z])(v|var|lod)(?:er|ersion|iant|iation)?[\W_]*(?=\d)")
_LONG = "|".join(sorted((word for word in _MEANING if len(word) > 4), key=len, reverse=True))  # noqa: PLR2004
_RUN_TOGETHER = re.compile(rf"(?:{_LONG}|ao|metal){{2,}}")
"""Words without anything between them: ``occlusionroughnessmetallic``."""
_TOKEN = re.compile(r"[A-Z]{2,}(?![a-z])\d*|[A-Z]?[a-z]+\d*|[A-Z]\d*|\d+x\d+|\d+(?:[kK]|px|bits?)?")
_MOST_JOINED = 4
_WEAK, _SHORT = ("metal", "rough"), 3
"""Words that do not name a map if a number follows them, as in metal032, and the characters of such words."""


class MapName(NamedTuple):
    """A texture map, as read from its file name.

    Attributes
    ----------
    channels
        Each as (channel, band or None, whether it is inverted); empty for maps that no surface uses.
    meaning
        The quantities in words; empty if the name is not recognised.
    others
        Quantities that no surface uses, such as height.
    of
        Words of the name before and after the map's, without resolution, format and version: the name of the material.
    order
        Sort key among maps of one channel and material, best first: usual words, the newest version, the first LOD, the
        first number.
    """

    channels: tuple[tuple[Channel, int | None, bool], ...]
    meaning: str
    others: tuple[str, ...]
    of: tuple[str, ...]
    order: tuple[int, int, int, int]


def channels_of(stem: str) -> list[tuple[Channel, int | None, bool]]:
    """Channels of a texture map by its file stem; empty if the name is not recognised.

    Each is (channel, band or None, whether it is inverted), for example gloss for roughness.
    """
    return list(read_map_name(stem).channels)


def read_map_name(stem: str, materials: Collection[tuple[str, ...]] = ()) -> MapName:
    """Read the name of a texture map, from its file stem.

    Words are divided by punctuation and capitals: ``Concrete034_1K-JPG_NormalGL``. `materials` has names of materials
    as in `MapName.of`: with the material ``("rusty", "metal")``, ``rusty_metal_rough`` names roughness only.
    """
    words = _words(stem)
    readings = _readings(words if len(stem) > 1 else [])
    wanted = [reading for reading in readings if materials and _material(reading.rest) in materials]
    kinds, rest, after, word = (wanted or readings[1:] or readings)[0]
    channels = _channels(kinds, word, is_down=not {*_DOWN}.isdisjoint(words) or word.endswith(_DOWN))
    counted = {sign: [int(w[len(sign) :]) for w in words if re.fullmatch(rf"{sign}\d+", w)] for sign in ("v", "lod")}
    numbers = [int(told[1]) for each in after if (told := re.fullmatch(r"(?:var)?(\d+)", each))]
    is_plain_normal = Channel.NORMAL in kinds and {*_UP}.isdisjoint(words) and not word.endswith(_UP)
    order = (
        int(word in _SECOND or is_plain_normal),
        -max(counted["v"], default=0),
        min(counted["lod"], default=0),
        min((number for number in numbers if number not in _SIZES_PX), default=0),
    )
    others = tuple(kind for kind in kinds if kind not in {*Channel, _GLOSS, _MANY})
    return MapName(channels, " and ".join(map(str, kinds)), others, _material(rest), order)


def _words(stem: str) -> list[str]:
    """Divide a name into words in lower case."""
    stem = re.sub(r"(?i:non[\W_]*colou?r)|sRGB|ACES(?:cg)?", "", stem)
    stem = re.sub(r"(?i)direct[\W_]*x", "_DX_", re.sub(r"(?i)open[\W_]*gl", "_GL_", stem))
    tokens = [token.lower() for token in _TOKEN.findall(_COUNTED.sub(lambda found: f"_{found[1].lower()}", stem))]
    return [
        word
        for token in tokens
        for word in (re.findall(f"{_LONG}|ao|metal", token) if _RUN_TOGETHER.fullmatch(token) else (token,))
    ]


class _Reading(NamedTuple):
    """A possible reading of a name: quantities, words for the material, words after the map, and the map's word."""

    kinds: tuple[str, ...]
    rest: tuple[str, ...]
    after: tuple[str, ...] = ()
    word: str = ""


def _readings(words: list[str]) -> list[_Reading]:
    """List the possible readings of a name: first as no map, then those with most words for quantities."""
    none = _Reading((), tuple(words))
    end = len(words)
    while end and not _last(words[:end]):
        dropped = next((n for n in (1, 2) if n <= end and _OF_FILE.fullmatch("".join(words[end - n : end]))), 0)
        if not dropped:
            break
        end -= dropped
    found = _last(words[:end])
    if not found:
        for end in range(len(words) - 1, 0, -1):
            found = _last(words[:end])
            if found and _ANYWHERE.fullmatch(found[1]):
                break
        else:
            return [none]
    meaning, word, count = found
    after = tuple(words[end:])
    behind = tuple(word for word in after if not word.isdecimal())
    readings = [_Reading((meaning,), (*words[: end - count], *behind), after, word)]
    kinds, start = [meaning], end - count
    while (left := _last(words[:start])) and len(left[1]) > 1 and _are_packed([left[0], *kinds]):
        kinds.insert(0, left[0])
        start -= left[2]
        if kinds not in _NO_PAIRS:
            readings.insert(0, _Reading(tuple(kinds), (*words[:start], *behind), after, word))
    return [none, *readings]


def _last(words: list[str]) -> tuple[str, str, int] | None:
    """Quantity that the last words name, the words joined, and their number; None if they name none."""
    if not words or words[-1][0].isdigit():
        return None
    for count in range(min(_MOST_JOINED, len(words)), 0, -1):
        joined = "".join(words[-count:])
        bare = re.sub(r"\d+$", "", joined)
        if bare in _WEAK or (len(bare) < _SHORT and bare != "ao"):
            bare = joined
        for word in (joined, bare):
            if _OF_LETTERS.fullmatch(word) or word in _UNITY_MASKS:
                return _MANY, word, count
            if meaning := _MEANING.get(word):
                return meaning, word, count
    return None


def _are_packed(kinds: list[str]) -> bool:
    """Return True for quantities that one map stores."""
    packed = [Channel.ROUGHNESS if kind == _GLOSS else kind for kind in kinds]
    pairs = ([Channel.COLOUR, _OPACITY], [Channel.COLOUR, _GLOSS], [_SPECULAR, _GLOSS], [Channel.NORMAL, _HEIGHT])
    return kinds in pairs or (len({*packed}) == len(packed) and {*packed} <= {*_PACKED})


def _channels(kinds: tuple[str, ...], word: str, *, is_down: bool) -> tuple[tuple[Channel, int | None, bool], ...]:
    """Channels of a map that stores some quantities, given its last word."""
    if word in _UNITY_MASKS:
        return _OF_UNITY
    if _OF_LETTERS.fullmatch(word):
        letters = re.findall(r"ao|dp|[a-z]", word)
        return tuple((_LETTERS[letter], band, False) for band, letter in enumerate(letters) if letter in _LETTERS)
    if kinds == (Channel.METALLIC, _GLOSS):
        return (_OF_UNITY[0], _OF_UNITY[-1])
    if kinds in {(_SPECULAR, _GLOSS), (Channel.COLOUR, _GLOSS)}:
        colour = [(Channel.COLOUR, None, False)] if kinds[0] == Channel.COLOUR else []
        return (*colour, _OF_UNITY[-1])
    if kinds in {(Channel.COLOUR, _OPACITY), (Channel.NORMAL, _HEIGHT)}:
        kinds = kinds[:1]
    told = [(Channel.ROUGHNESS, True) if kind == _GLOSS else (kind, False) for kind in kinds]
    if len(told) == 1:
        ((kind, is_turned),) = told
        return ((Channel(kind), None, is_down if kind == Channel.NORMAL else is_turned),) if kind in {*Channel} else ()
    order = [Channel(kind) for kind, _ in told] if len(told) == len(_PACKED) else list(_PACKED)
    return tuple((Channel(kind), order.index(Channel(kind)), is_turned) for kind, is_turned in told)


def _material(words: tuple[str, ...]) -> tuple[str, ...]:
    """Words that name a material: without resolution, format and the like, but with the numbers of materials."""
    return tuple(
        word for word in words if not _OF_FILE.fullmatch(word) or (word.isdecimal() and int(word) not in _SIZES_PX)
    )
