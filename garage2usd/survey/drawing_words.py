"""Words of drawings and building models: the parts that names of layers and elements tell, in many languages."""

import re
import unicodedata
from enum import StrEnum
from functools import cache

from garage2usd.common.documents import shipped_toml
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.survey import PortalKind
from garage2usd.survey.text import size_of, use_of


class PartKind(StrEnum):
    """Parts of a garage that a name can tell."""

    NOTE = "note"
    VEHICLE = "vehicle"
    LANE = "lane"
    COLUMN = "column"
    DOOR = "door"
    RAMP = "ramp"
    SOLID = "solid"
    OUTLINE = "outline"
    WALL = "wall"
    MOUTH = "mouth"
    STALL = "stall"


_WORDS = {
    group: {key: tuple(dict.fromkeys(words.split())) for key, words in given.items()}
    for group, given in shipped_toml("garage2usd.survey", "drawing_words").items()
}
_NUMBERED = re.compile(r"[0-9]*$")
_NUMBER = re.compile(r"(?=.*\d)[\w\-./]{1,12}")


def _plain(text: str) -> str:
    """Return a text in small letters without accents, its separators as spaces."""
    bare = "".join(sign for sign in unicodedata.normalize("NFKD", text) if not unicodedata.combining(sign))
    whole = unicodedata.normalize("NFC", bare)  # syllables of Korean, which NFKD takes apart
    return re.sub(r"[\W_]+", " ", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", whole)).casefold().strip()


def _contains(plain: str, words: tuple[str, ...]) -> bool:
    tokens = {_NUMBERED.sub("", token) for token in plain.split()}
    return any(word[1:] in tokens if word[0] == "=" else word.replace("_", " ") in plain for word in words)


@cache
def kind_of(name: str) -> PartKind | None:
    """Return the part that the name of a layer, block, space or element tells; None if it tells none.

    For example ``A-COLS`` and ``Stützen`` are columns, ``B1$0$车位线`` and ``Stellplatz_EV`` stalls.
    """
    plain = _plain(name)
    return next((PartKind(kind) for kind, words in _WORDS["parts"].items() if _contains(plain, words)), None)


def use_told(*names: str) -> StallUse:
    """Return the use of a stall that names tell, in the words of several languages."""
    plain = [_plain(name) for name in names]
    told = next(
        (StallUse(use) for name in plain for use, words in _WORDS["uses"].items() if _contains(name, words)), None
    )
    return told or use_of([*names, *plain])


def size_told(*names: str) -> SizeClass:
    """Return the size class of a stall that names tell."""
    plain = [_plain(name) for name in names]
    return SizeClass.COMPACT if any(_contains(name, _WORDS["marks"]["compact"]) for name in plain) else size_of(plain)


def portal_told(*names: str) -> PortalKind:
    """Return the kind of portal that names tell: an entrance or an exit if one of the two is named, else both."""
    plain = " ".join(map(_plain, names))
    enters, leaves = (_contains(plain, _WORDS["marks"][way]) for way in ("entrance", "exit"))
    if enters == leaves:
        return PortalKind.BOTH
    return PortalKind.ENTRANCE if enters else PortalKind.EXIT


def is_one_way(*names: str) -> bool:
    """Return True if names tell a lane for one direction."""
    return any(_contains(_plain(name), _WORDS["marks"]["one_way"]) for name in names)


def number_told(*texts: str) -> str:
    """Return the number of a stall that texts tell, the first or its last word that does; empty if none does."""
    for text in texts:
        last = text.split()[-1] if text.split() else ""
        for word in (text.strip(), last):
            if _NUMBER.fullmatch(word):
                return word
    return ""
