"""Stall numbers as they are written: the own lettering, the font beside it, and the user's, against FreeType."""

import io

import numpy as np
import pytest
import shapely
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from PIL import Image, ImageDraw, ImageFont
from support.lettering import outline

from garage2usd.assets.glyphs import GLYPH_PITCH, text_shape
from garage2usd.assets.lettering import OWN_FONT, cells_of, number_shape, overhang_of, unpainted
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, load_config
from garage2usd.config.font_file import FontFile, read_font
from garage2usd.config.look import LookConfig, look_text
from garage2usd.look import drawn_look
from garage2usd.objects.stall_number import FontNumberSpec, NumberSpec
from garage2usd.stage.prototypes import asset_of


def font_of(path, glyphs):
    """A font whose glyphs are lists of contours in an em of 1000."""
    names = [".notdef", *(f"u{ord(sign):04X}" for sign in glyphs)]
    builder = FontBuilder(1000, isTTF=True)
    builder.setupGlyphOrder(names)
    builder.setupCharacterMap({ord(sign): f"u{ord(sign):04X}" for sign in glyphs})
    drawn = {".notdef": TTGlyphPen(None).glyph()}
    for sign, contours in glyphs.items():
        pen = TTGlyphPen(None)
        for contour in contours:
            pen.moveTo(contour[0])
            for point in contour[1:]:
                pen.lineTo(point)
            pen.closePath()
        drawn[f"u{ord(sign):04X}"] = pen.glyph()
    builder.setupGlyf(drawn)
    builder.setupHorizontalMetrics(dict.fromkeys(names, (1000, 0)))
    builder.setupHorizontalHeader(ascent=880, descent=-120)
    builder.setupNameTable({"familyName": "Test", "styleName": "Regular"})
    builder.setupOS2()
    builder.setupPost()
    builder.save(path)
    return read_font(FontFile(file=str(path)))


def square(low, high):
    return [(low, low), (low, high), (high, high), (high, low)]


HAN = {"車": [square(0, 800), square(200, 600)[::-1], square(300, 500)]}
PIXELS = 1000


def drawn_by_freetype(sign):
    """The character as FreeType fills it, cut to its ink, in 64 x 64 shares."""
    font = ImageFont.truetype(OWN_FONT.file, PIXELS)
    image = Image.new("L", (2 * PIXELS, 2 * PIXELS))
    ImageDraw.Draw(image).text((PIXELS // 4, PIXELS // 4), sign, fill=255, font=font)
    return np.asarray(image.crop(image.getbbox()).resize((64, 64), Image.Resampling.BOX)) / 255


def drawn_as_polygons(shape):
    low_x, low_y, high_x, high_y = shape.bounds
    x, y = np.meshgrid((np.arange(256) + 0.5) / 256, (np.arange(256) + 0.5) / 256)
    inside = shapely.contains_xy(shape, low_x + x * (high_x - low_x), low_y + y * (high_y - low_y))
    return inside.reshape(64, 4, 64, 4).mean(axis=(1, 3))


@pytest.mark.parametrize("sign", [*"agmßœ", "Ж", "Ω", "½", "%", "&", "@", "Ǻ", "Ø", "①", "i"])
def test_a_character_has_the_shape_that_freetype_draws(sign):
    given = number_shape(sign, 1.0, read_font(OWN_FONT))  # as a user's font
    off = np.abs(drawn_as_polygons(given) - drawn_by_freetype(sign)).mean()
    assert off < 0.03
    own = number_shape(sign, 1.0, None)
    assert own.buffer(0.001).contains(given)
    assert own.hausdorff_distance(given) < 0.08  # strokes a little wider


@pytest.mark.parametrize("text", ["07", "88", "A1", "-", "ÄÖ", "A 2", "(#"])
@pytest.mark.parametrize("height_m", [0.45, 0.31])
def test_plain_numbers_are_painted_as_ever(text, height_m):
    assert number_shape(text, height_m, None).wkb == text_shape(text, height_m).wkb


def test_letters_stand_side_by_side_on_one_line():
    one, other = (number_shape(sign, 1.0, None) for sign in "1m")
    both = number_shape("1m", 1.0, None)
    assert both.area == pytest.approx(one.area + other.area)
    assert both.bounds[2] - both.bounds[0] <= cells_of("1m", None) * GLYPH_PITCH
    assert shapely.MultiPolygon([*one.geoms] if one.geom_type == "MultiPolygon" else [one]).bounds[3] == 0.5
    assert other.bounds[3] == pytest.approx(0.5, abs=0.021)
    assert overhang_of("12", None) == pytest.approx(0)
    assert 0.2 < overhang_of("g", None) < 0.4


def test_what_has_no_shape_of_its_own_is_not_painted():
    assert unpainted("車-12", None) == "車"
    assert unpainted("🚗x\u0302\u0661א\u202e", None) == "🚗\u0302\u0661א\u202e"
    assert unpainted(" 12a Ä/3 ", None) == ""


def test_the_users_font_paints_what_it_has_and_holes_stay_open(tmp_path):
    font = font_of(tmp_path / "han.ttf", HAN)
    assert unpainted("車-12", font) == ""
    shape = number_shape("車", 0.5, font)
    assert shape.area == pytest.approx((0.8**2 - 0.4**2 + 0.2**2) * 0.25)
    (part,) = FontNumberSpec("車", 0.5, font).asset().parts
    turned = part.points[:, [0, 2]] * (1, -1)
    drawn = outline(turned, part.face_counts, part.face_indices)
    assert drawn.area == pytest.approx(shape.area, rel=1e-3)
    assert number_shape("12", 0.5, font).wkb == number_shape("12", 0.5, None).wkb


def test_specs_of_a_font_have_prototypes_of_their_own(tmp_path):
    font = font_of(tmp_path / "own.ttf", {"1": [square(0, 700)]})
    own, usual = asset_of(FontNumberSpec("1", 0.45, font)), asset_of(NumberSpec("1", 0.45))
    assert len(own.parts[0].face_counts) == 2
    assert not np.array_equal(own.parts[0].points, usual.parts[0].points)


def test_the_font_of_a_configuration_is_known_by_its_contents(tmp_path):
    font = font_of(tmp_path / "own.ttf", HAN)
    (tmp_path / "a.toml").write_text('[look]\nfont = "own.ttf"\ndrawn = true\n')
    config = load_config(tmp_path / "a.toml")
    assert config.look.font == font
    assert drawn_look(config.look, 3).font == font
    assert f'font = "{font.file}"' in look_text(config.look)
    (tmp_path / "b").mkdir()
    (tmp_path / "own.ttf").rename(tmp_path / "b" / "other.ttf")
    moved = GarageConfig(look=LookConfig(font=str(tmp_path / "b" / "other.ttf"), drawn=True))
    assert moved.digest() == config.digest() != GarageConfig(look=LookConfig(drawn=True)).digest()
    assert "font" not in GarageConfig().model_dump()["look"]
    font_of(tmp_path / "b" / "other.ttf", {"1": HAN["車"]})
    with pytest.raises(ConfigError, match=r"look\.font: got .*the font that it was given with"):
        read_font(moved.look.font)


def damaged(data):
    half = data[: len(data) // 2]
    noise = bytes(byte ^ (0xFF if at % 97 == 5 else 0) for at, byte in enumerate(data))
    return [b"", b"no font", half, noise, b"true" + data[4:], b"OTTO" + data[4:40]]


def test_what_is_no_font_is_one_error(tmp_path):
    font_of(tmp_path / "own.ttf", HAN)
    for data in damaged((tmp_path / "own.ttf").read_bytes()):
        path = tmp_path / "bad.ttf"
        path.write_bytes(data)
        said = "look.font: got "
        try:  # a glyph may be whole, or is one that the font lacks
            assert unpainted("車", read_font(FontFile(file=str(path)))) in {"", "車"}
        except ConfigError as error:
            said = str(error)
        assert said.startswith("look.font: got ")
        assert "\n" not in said
    with pytest.raises(ConfigError, match="a readable file"):
        read_font(FontFile(file=str(tmp_path / "none.ttf")))
    picture = io.BytesIO()
    Image.new("L", (2, 2)).save(picture, "PNG")
    (tmp_path / "bad.ttf").write_bytes(picture.getvalue())
    with pytest.raises(ConfigError, match="a TrueType or OpenType font"):
        read_font(FontFile(file=str(tmp_path / "bad.ttf")))
