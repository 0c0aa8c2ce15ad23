"""Texture pictures: their bytes, their pixels, and pictures composed of channels of others."""
# Over 300 lines: pictures are read, composed and stored by one set of pixels that each file is decoded to once.

import io
import math
from collections.abc import Iterable, Mapping
from pathlib import Path, PurePosixPath
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image
from pxr import Ar

from garage2usd.common.package import installation_of

_PLAIN_KINDS = {b"\x89PNG\r\n\x1a\n": "image/png", b"\xff\xd8\xff": "image/jpeg"}
"""Picture formats of browsers and glTF, by their first bytes."""
_OPENEXR = b"\x76\x2f\x31\x01"
_BITS_AT = 24
"""Offset of the bits per channel in a PNG."""
_SIXTEEN = 16
_COLOURED = 3
"""Least number of channels of an 8-bit picture that is read as sRGB colours."""
_WHOLE = {"I;16": 65535.0, "I;16B": 65535.0, "I;16L": 65535.0, "I": 65535.0, "F": 1.0}
_OPAQUE_BYTE = 255
_MOST_PX = 8192
ALPHA = 3
"""Number of the alpha channel."""
_KNEE, _SLOPE, _SHIFT, _POWER = 0.0031308, 12.92, 0.055, 2.4
"""Constants of the sRGB curve (IEC 61966-2-1): linear up to the knee, a power above."""


class Picture(NamedTuple):
    """An image file: its name, its media type, and its bytes."""

    name: str
    kind: str
    data: bytes


class Band(NamedTuple):
    """A linear channel of a picture, times `scale` plus `bias`.

    Attributes
    ----------
    file, channel
        Resolved path of the picture, and 0 to 3 for red, green, blue and alpha.
    colour_space
        ``sRGB``, ``raw`` or ``auto``.
    """

    file: str
    channel: int
    colour_space: str = "raw"
    scale: float = 1.0
    bias: float = 0.0


class _Pixels(NamedTuple):
    """Pixels as stored in a file; float32, shape (rows, columns, 4), the first row on top."""

    values: NDArray[np.float32]
    channels: int
    are_bytes: bool


Bands = tuple[Band | float | None, ...]
"""Red, green, blue and optionally alpha: each a band of a picture, a constant, or unused."""


def factored(bands: Iterable[Band]) -> tuple[list[float], tuple[Band, ...]]:
    """Split bands into factors from 0 to 1 and the bands to multiply with them."""
    factors, rest = [], []
    for band in bands:
        is_factor = band.bias == 0 and 0 <= band.scale <= 1
        factors.append(band.scale if is_factor else 1.0)
        rest.append(band._replace(scale=1.0) if is_factor else band)
    return factors, tuple(rest)


class Pictures:
    """Reader of texture pictures that reads each file once."""

    def __init__(self) -> None:
        self._data: dict[str, bytes] = {}
        self._faults: dict[str, str] = {}
        self._pixels: dict[str, _Pixels] = {}

    def give(self, file: str, data: bytes) -> None:
        """Add a picture by its bytes under a given name."""
        self._data[file] = data
        for known in (self._faults, self._pixels):
            known.pop(file, None)

    def give_values(self, file: str, values: NDArray[np.float64], *, is_srgb: bool = False) -> None:
        """Add a picture of bytes by its linear values, shape (rows, columns) or (rows, columns, 3)."""
        buffer = io.BytesIO()
        Image.fromarray(stored(values, is_srgb=is_srgb)).save(buffer, format="PNG")
        self.give(file, buffer.getvalue())

    def mosaic(self, tiles: Mapping[tuple[int, int], str]) -> str:
        """Compose pictures by their columns and rows, counted rightwards and upwards, into one; return its name.

        All get the size of the largest, or less where the whole would have over 8192 pixels a side, and places without
        a picture are black.
        """
        names = [f"{column},{row}={tile}" for (column, row), tile in sorted(tiles.items())]
        file = f"mosaic of {' '.join(names)}"
        if file not in self._data:
            read = {}
            for place, tile in tiles.items():
                read[place] = Image.fromarray(np.rint(self._pixels_of(tile).values.clip(0, 1) * 255).astype(np.uint8))
            width, height = (max(sides) for sides in zip(*(picture.size for picture in read.values()), strict=True))
            columns, rows = (1 + max(place[axis] for place in tiles) for axis in (0, 1))
            width, height = min(width, _MOST_PX // columns), min(height, _MOST_PX // rows)
            whole = Image.new("RGBA", (columns * width, rows * height))
            for (column, row), picture in read.items():
                whole.paste(picture.resize((width, height)), (column * width, (rows - 1 - row) * height))
            stream = io.BytesIO()
            has_alpha = any(np.asarray(picture)[..., ALPHA].min() < _OPAQUE_BYTE for picture in read.values())
            whole.convert("RGBA" if has_alpha else "RGB").save(stream, format="PNG")
            self._data[file] = stream.getvalue()
        return file

    def data(self, file: str) -> bytes:
        """Return the bytes of a picture's file; empty if it cannot be opened."""
        if file not in self._data:
            asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(file))
            self._data[file] = bytes(asset.GetBuffer()) if asset and asset.GetSize() else b""
        return self._data[file]

    def fault(self, file: str) -> str:
        """Explain why a picture cannot be read; empty if it can be."""
        if file not in self._faults:
            try:
                self._read(file)
            except ModuleNotFoundError:
                self._faults[file] = f"need OpenEXR ({installation_of('blender')})"
            except Exception:  # noqa: BLE001 - decoders of damaged files fail in every way
                self._faults[file] = "cannot be decoded" if self.data(file) else "are empty"
            else:
                self._faults[file] = ""
        return self._faults[file]

    def _read(self, file: str) -> None:
        """Decode a picture to validate it completely, and discard the pixels."""
        data = self.data(file)
        if data.startswith(_OPENEXR):
            _of_openexr(data)
            return
        with Image.open(io.BytesIO(data)) as picture:
            picture.load()

    def plain_kind(self, file: str) -> str:
        """Return the media type of a picture that browsers and glTF support directly; empty for any other."""
        data = self.data(file)
        kind = next((kind for magic, kind in _PLAIN_KINDS.items() if data.startswith(magic)), "")
        if kind == "image/jpeg":
            with Image.open(io.BytesIO(data)) as picture:  # reads the header alone
                return kind if picture.mode in {"L", "RGB"} else ""
        return kind

    def is_srgb(self, file: str, colour_space: str) -> bool:
        """Return True if red, green and blue are stored as sRGB; ``auto`` means 8-bit colours."""
        if colour_space in {"sRGB", "raw"}:
            return colour_space == "sRGB"
        channels, are_bytes = self._form(file)
        return are_bytes and channels >= _COLOURED

    def has_alpha(self, file: str) -> bool:
        """Return True if a picture has an alpha channel that is not opaque everywhere."""
        return bool((self._pixels_of(file).values[..., ALPHA] < 1).any())

    def _form(self, file: str) -> tuple[int, bool]:
        """Return a picture's number of channels, and True if they have 8 bits."""
        data = self.data(file)
        if data.startswith(_OPENEXR):
            return _COLOURED, False
        with Image.open(io.BytesIO(data)) as picture:  # reads the header alone
            has_palette = picture.mode == "P"
            channels = _COLOURED if has_palette else len(picture.getbands())
            return channels, picture.mode not in _WHOLE and not has_sixteen_bits(data)

    def plane(self, band: Band) -> NDArray[np.float64]:
        """Return the values of a band; float64, shape (rows, columns), the first row on top."""
        values = self._pixels_of(band.file).values[..., band.channel].astype(np.float64)
        if band.channel != ALPHA and self.is_srgb(band.file, band.colour_space):
            values = _linear(values)
        return values * band.scale + band.bias

    def mean(self, band: Band) -> float:
        """Compute the mean of a band."""
        return float(self.plane(band).mean())

    def _pixels_of(self, file: str) -> _Pixels:
        if file not in self._pixels:
            data = self.data(file)
            self._pixels[file] = _of_openexr(data) if data.startswith(_OPENEXR) else _of_pillow(data)
        return self._pixels[file]

    def composed(self, bands: Bands, *, is_srgb: bool, largest_px: int | None = None) -> Picture:
        """Compose a picture of some bands: the original file if it has them unchanged, else an 8-bit PNG.

        Parameters
        ----------
        bands
            Red, green, blue and, if there are four, alpha; a number for a constant, None for an unused channel. One of
            them is a band.
        is_srgb
            True to store red, green and blue as sRGB.
        largest_px
            Greatest length of the longer side of a composed picture in pixels; original files are not reduced.
        """
        given = [band for band in bands if isinstance(band, Band)]
        package, packed = Ar.SplitPackageRelativePathInner(given[0].file)
        name = PurePosixPath(packed or package).stem
        if self._are_stored(bands, is_srgb=is_srgb):
            file = given[0].file
            return Picture(name, self.plain_kind(file), self.data(file))
        planes = [band if isinstance(band, float) else self.plane(band) if band else 1.0 for band in bands]
        rows, columns = max((plane.shape for plane in planes if not isinstance(plane, float)), key=math.prod)
        share = min(1.0, (largest_px or columns) / max(columns, rows)) if largest_px else 1.0
        size = max(1, round(share * columns)), max(1, round(share * rows))
        parts = [
            stored(resized(plane, size), is_srgb=is_srgb and number != ALPHA) for number, plane in enumerate(planes)
        ]
        buffer = io.BytesIO()
        Image.fromarray(np.stack(parts, axis=2)).save(buffer, format="PNG", optimize=True)
        return Picture(name, "image/png", buffer.getvalue())

    def _are_stored(self, bands: Bands, *, is_srgb: bool) -> bool:
        """Return True if a file has these bands unchanged."""
        files = {band.file if isinstance(band, Band) else "" for band in bands if band is not None}
        if len(files) > 1 or not self.plain_kind(file := files.pop()):
            return False
        is_grey = self._form(file)[0] < _COLOURED
        return all(
            (band.scale, band.bias) == (1.0, 0.0)
            and (band.channel == number or (is_grey and number != ALPHA != band.channel))
            and (number == ALPHA or self.is_srgb(file, band.colour_space) == is_srgb)
            for number, band in enumerate(bands)
            if isinstance(band, Band)
        )


def sampled(plane: NDArray[np.float64], coordinates: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Sample a repeated picture by linear interpolation between the centres of its pixels."""
    upwards = plane[::-1]  # the last row of pixels is v = 0
    rows, columns = plane.shape
    across = coordinates[:, 0] * columns - 0.5
    up = coordinates[:, 1] * rows - 0.5
    left, low = np.floor(across).astype(int), np.floor(up).astype(int)
    right_share, high_share = across - left, up - low
    low_row, high_row = low % rows, (low + 1) % rows
    left_column, right_column = left % columns, (left + 1) % columns
    lower = upwards[low_row, left_column] * (1 - right_share) + upwards[low_row, right_column] * right_share
    upper = upwards[high_row, left_column] * (1 - right_share) + upwards[high_row, right_column] * right_share
    found: NDArray[np.float64] = lower * (1 - high_share) + upper * high_share
    return found


def _linear(stored: NDArray[np.float64]) -> NDArray[np.float64]:
    """Convert sRGB values to linear light."""
    straight = stored / _SLOPE
    curved = ((np.maximum(stored, _SLOPE * _KNEE) + _SHIFT) / (1 + _SHIFT)) ** _POWER
    return np.where(stored <= _SLOPE * _KNEE, straight, curved)


def stored(values: NDArray[np.floating[Any]], *, is_srgb: bool) -> NDArray[np.uint8]:
    """Convert values to bytes."""
    kept = np.clip(np.nan_to_num(values), 0.0, 1.0)
    if is_srgb:
        curved = (1 + _SHIFT) * np.maximum(kept, _KNEE) ** (1 / _POWER) - _SHIFT
        kept = np.where(kept <= _KNEE, _SLOPE * kept, curved)
    stored: NDArray[np.uint8] = np.rint(kept * 255).astype(np.uint8)
    return stored


def resized(plane: NDArray[np.float64] | float, size: tuple[int, int]) -> NDArray[np.float64]:
    """Return a plane of values in another size, as columns and rows."""
    if isinstance(plane, float):
        return np.full(size[::-1], plane)
    if plane.shape[::-1] == size:
        return plane
    resized = Image.fromarray(plane.astype(np.float32)).resize(size, Image.Resampling.BILINEAR)
    return np.asarray(resized, dtype=np.float64)


def has_sixteen_bits(data: bytes) -> bool:
    """Return True for a PNG of 16 bits a channel."""
    return data.startswith(b"\x89PNG") and data[_BITS_AT] == _SIXTEEN


def _of_pillow(data: bytes) -> _Pixels:
    with Image.open(io.BytesIO(data)) as picture:
        picture.load()
        if picture.mode in _WHOLE:
            grey = np.asarray(picture, dtype=np.float32) / np.float32(_WHOLE[picture.mode])
            return _Pixels(_four([np.asarray(grey, dtype=np.float32)]), 1, are_bytes=False)
        channels = _COLOURED if picture.mode in {"P", "CMYK"} else len(picture.getbands())
        values = np.asarray(picture.convert("RGBA"), dtype=np.float32) / np.float32(255)
        return _Pixels(values, channels, are_bytes=not has_sixteen_bits(data))


def _of_openexr(data: bytes) -> _Pixels:
    from tempfile import TemporaryDirectory  # noqa: PLC0415 - of a format that few stages have

    import OpenEXR  # noqa: PLC0415 - of an extra

    with TemporaryDirectory() as folder:  # OpenEXR reads files only, and on Windows none that is open
        file = Path(folder, "picture.exr")
        file.write_bytes(data)
        with OpenEXR.File(str(file), separate_channels=True) as picture:
            planes = {name: np.array(channel.pixels, dtype=np.float32) for name, channel in picture.channels().items()}
    red = planes.get("R", next(iter(planes.values())))
    colours = [red, planes.get("G", red), planes.get("B", red)]
    return _Pixels(_four(colours, planes.get("A")), _COLOURED, are_bytes=False)


def _four(colours: list[NDArray[np.float32]], alpha: NDArray[np.float32] | None = None) -> NDArray[np.float32]:
    """Expand one channel or three to red, green, blue and alpha."""
    three = colours * 3 if len(colours) == 1 else colours
    return np.stack([*three, np.ones_like(three[0]) if alpha is None else alpha], axis=2)
