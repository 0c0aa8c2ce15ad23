"""Worn paint: other colours by another palette, as Pillow decodes them."""

import io
import struct
import zlib

import numpy as np
import pytest
from PIL import Image

from garage2usd.assets.textures import texture_folder
from garage2usd.assets.textures.paints import WEAR_STEPS, painted, wear_palette
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import TextureQuality

NAMES = ["wear_fresh.png", "wear_worn.png", "wear_gone.png", "wear_ghost.png"]
YELLOW, GREEN = (0.7, 0.4, 0.02), (0.05, 0.2, 0.1)


def shipped(name, quality=TextureQuality.MEDIUM):
    return (texture_folder(quality) / name).read_bytes()


def opened(png):
    picture = Image.open(io.BytesIO(png))
    picture.load()
    return picture


def linear(srgb):
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


@pytest.mark.parametrize("quality", TextureQuality)
@pytest.mark.parametrize("name", NAMES)
def test_each_pixel_is_a_mix_of_paint_and_ground_in_linear_light(name, quality):
    png = shipped(name, quality)
    index = np.asarray(opened(png))
    assert opened(png).mode == "P"
    assert index.max() < WEAR_STEPS
    bare = index[:, :, None] / (WEAR_STEPS - 1)
    mixed = np.array(YELLOW) * (1 - bare) + np.array(GREEN) * bare
    shown = np.asarray(opened(painted(png, YELLOW, GREEN)).convert("RGB")) / 255
    # half a step of eight bits
    assert (
        np.abs(shown - np.where(mixed <= 0.0031308, 12.92 * mixed, 1.055 * mixed ** (1 / 2.4) - 0.055)) < 0.00197
    ).all()
    assert np.abs(linear(shown) - mixed).max() < 0.005


@pytest.mark.parametrize("name", NAMES)
def test_only_the_palette_and_its_checksum_change(name):
    png, other = shipped(name), painted(shipped(name), YELLOW, GREEN)
    start = png.index(b"PLTE")
    end = start + 4 + 3 * WEAR_STEPS + 4
    assert png[:start] == other[:start]
    assert png[end:] == other[end:]
    assert other[start + 4 : end - 4] == wear_palette(YELLOW, GREEN)
    assert (np.asarray(opened(png)) == np.asarray(opened(other))).all()


def test_wear_goes_from_fresh_to_gone():
    bare = [np.asarray(opened(shipped(name))).mean() / (WEAR_STEPS - 1) for name in NAMES]
    for share, least, most in zip(bare, (0.0, 0.25, 0.75, 0.7), (0.1, 0.5, 0.95, 0.9), strict=True):
        assert least < share < most


def test_palettes_begin_with_the_paint_and_end_with_the_ground():
    assert wear_palette((1.0, 1.0, 1.0), (0.0, 0.0, 0.0))[:3] == b"\xff\xff\xff"
    assert wear_palette((1.0, 1.0, 1.0), (0.0, 0.0, 0.0))[-3:] == b"\0\0\0"
    assert wear_palette((7.0, 0.5, -1.0), (0.0, 0.0, 0.0))[:3] == bytes([255, 188, 0])


def test_colours_of_palettes_are_those_of_the_standard():
    values = np.linspace(0.0, 1.0, 4001)
    expected = np.rint(255 * np.where(values <= 0.0031308, 12.92 * values, 1.055 * values ** (1 / 2.4) - 0.055))
    assert [wear_palette((value,) * 3, (0.0,) * 3)[0] for value in values.tolist()] == expected.tolist()


def png_of(mode, colours=0):
    picture = Image.new(mode, (4, 4))
    if colours:
        picture.putpalette(bytes(3 * colours))
    file = io.BytesIO()
    picture.save(file, format="PNG")
    return file.getvalue()


@pytest.mark.parametrize(
    ("data", "what"),
    [
        (b"", "no PNG"),
        (b"\xff\xd8\xff", "no PNG"),
        (png_of("RGB"), "without a palette"),
        (png_of("P", 17), "17 colours"),
        (shipped("wear_worn.png")[:1000], "ends within a chunk"),
        (shipped("wear_worn.png")[:-3], "ends within a chunk"),
    ],
)
def test_other_files_are_refused(data, what):
    with pytest.raises(ConfigError, match=what):
        painted(data, YELLOW, GREEN)


def test_checksums_are_those_of_the_format():
    png = painted(shipped("wear_ghost.png"), YELLOW, GREEN)
    place = 8
    while place < len(png):
        (length,) = struct.unpack_from(">I", png, place)
        body = png[place + 4 : place + 8 + length]
        assert struct.unpack_from(">I", png, place + 8 + length)[0] == zlib.crc32(body)
        place += 12 + length
