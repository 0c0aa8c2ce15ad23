"""The user's font for stall numbers: a TrueType or OpenType file, with the digest of its contents."""

import hashlib
import io
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from pydantic import Field

from garage2usd.common.documents import read_bytes
from garage2usd.common.errors import ConfigError
from garage2usd.common.settings import Settings

if TYPE_CHECKING:
    from fontTools.ttLib import TTFont

FIELD = "look.font"
_MOST_BYTES = 128 * 1024 * 1024
_OUTLINES = ("glyf", "CFF ", "CFF2")
"""Tables of outlines; fonts of pictures have none of them."""


class FontFile(Settings):
    """A font file."""

    file: str = Field(min_length=1)
    """A TrueType or OpenType font (.ttf, .otf; of a collection, .ttc, the first one). A relative path starts at the
    configuration file."""
    sha256: str = Field("", pattern=r"^([0-9a-f]{64})?$")
    """Digest of the file; computed when it is read."""


def read_font(font: FontFile) -> FontFile:
    """Read a font, and return it with the digest of its file.

    Raises
    ------
    ConfigError
        If the file cannot be read, is no font with outlines, or does not match the digest.
    """
    data = read_bytes(Path(font.file), field=FIELD, max_bytes=_MOST_BYTES)
    digest = hashlib.sha256(data).hexdigest()
    if font.sha256 not in {"", digest}:
        raise ConfigError(FIELD, font.file, f"the font that it was given with, of SHA-256 {font.sha256[:16]}")
    read = FontFile(file=font.file, sha256=digest)
    opened_font(read)
    return read


@lru_cache(maxsize=8)
def opened_font(font: FontFile) -> "TTFont":
    """Parse a font that has its digest; raises `ConfigError` as `read_font`."""
    from fontTools.ttLib import TTFont  # noqa: PLC0415 - few garages need it

    data = read_bytes(Path(font.file), field=FIELD, max_bytes=_MOST_BYTES)
    if font.sha256 != hashlib.sha256(data).hexdigest():
        return opened_font(read_font(font))
    try:
        opened = TTFont(io.BytesIO(data), fontNumber=0, lazy=True)
        has_outlines = any(table in opened for table in _OUTLINES) and bool(opened.getBestCmap())
    except Exception as error:  # noqa: BLE001 - a damaged font raises a dozen kinds
        reason = " ".join(str(error).split()) or type(error).__name__
        raise ConfigError(FIELD, font.file, f"a TrueType or OpenType font ({reason})") from None
    if not has_outlines:
        raise ConfigError(FIELD, font.file, "a font with outlines, and with characters of Unicode")
    return opened
