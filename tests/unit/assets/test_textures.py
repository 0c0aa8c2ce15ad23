"""The baked texture set: what is there, how large it is, and that it repeats without a seam."""

import numpy as np
import pytest
from PIL import Image

from garage2usd.assets import GLOSSES, MATERIALS, PaintedTexture
from garage2usd.assets.stain_texture import CELLS, CELLS_ACROSS, DIRT_CELLS
from garage2usd.assets.textures import texture_folder
from garage2usd.config.look import Dirt
from garage2usd.config.outputs import TextureQuality

_USED = {texture for material in MATERIALS.values() for texture in material.textures()}
NAMES = sorted(
    {texture.mask if isinstance(texture, PaintedTexture) else texture for texture in _USED} | {*GLOSSES.values()}
)
# bands of walls and columns and dust on cars are as high as one repeat
SPAN_ONE_HEIGHT = {
    "band_colour.jpg",
    "band_packed.png",
    "dado_colour.jpg",
    "column_painted_colour.jpg",
    "road_dust.png",
}
HUNG_FROM_THE_TOP = {"wall_colour.jpg", "wall_packed.png"}  # a wall is lower than one repeat
BUDGET_BYTES = {TextureQuality.LOW: 260_000, TextureQuality.MEDIUM: 850_000, TextureQuality.HIGH: 3_200_000}
TO_BE_TINTED = sorted(
    {
        material.colour_texture
        for key, material in MATERIALS.items()
        if key.startswith(("floor_", "wall_", "ceiling_", "column_"))
    }
    - {"floor_colour.jpg", "wall_colour.jpg", "band_colour.jpg", "ceiling_colour.jpg"}
)


def pixels(name, quality=TextureQuality.HIGH):
    with Image.open(texture_folder(quality) / name) as picture:
        return np.asarray(picture.convert("RGBA"), dtype=float)


@pytest.mark.parametrize("quality", TextureQuality)
def test_every_texture_is_there_and_used(quality):
    files = list(texture_folder(quality).iterdir())
    assert sorted(path.name for path in files) == NAMES
    assert sum(path.stat().st_size for path in files) < BUDGET_BYTES[quality]


@pytest.mark.parametrize("quality", TextureQuality)
@pytest.mark.parametrize("name", NAMES)
def test_textures_repeat_without_a_seam(name, quality):
    picture = pixels(name, quality)
    for axis in (0, 1):
        if name in {"stains.png", "dirt.png"} or (axis == 0 and name in SPAN_ONE_HEIGHT | HUNG_FROM_THE_TOP):
            continue
        steps = np.abs(picture - np.roll(picture, 1, axis=axis)).mean(axis=1 - axis)
        # the step over the border is as large as over a joint at most
        assert steps[0].max() <= 1.1 * steps[1:].max() + 1.0


def test_packed_textures_hold_three_channels_of_a_surface():
    for name in (name for name in NAMES if "packed" in name):
        occlusion, roughness, metallic, _ = pixels(name).transpose(2, 0, 1) / 255
        assert occlusion.max() == 1.0
        assert 0.15 < roughness.min() < roughness.max() <= 1.0
        assert (metallic.max() > 0.5) == (name == "steel_packed.png")


@pytest.mark.parametrize("name", TO_BE_TINTED)
def test_finishes_are_neutral_and_light_enough_for_a_tint(name):
    values = pixels(name)[:, :, :3] / 255
    red, green, blue = np.where(values <= 0.04045, values / 12.92, ((values + 0.055) / 1.055) ** 2.4).mean(axis=(0, 1))
    assert 0.94 * red < blue <= green + 0.002 <= red + 0.004
    # asphalt is black where it is new
    assert green > (0.15 if name.startswith("asphalt") else 0.4)


def test_glosses_go_from_mirror_to_matt_without_a_gap_in_their_order():
    ends = []
    for name in GLOSSES.values():
        occlusion, roughness, metallic, _ = pixels(name).transpose(2, 0, 1) / 255
        assert occlusion.min() == 1.0
        assert metallic.max() == 0.0
        ends += [roughness.min(), roughness.max()]
    assert ends == sorted(ends)
    assert ends == pytest.approx([0.06, 0.12, 0.15, 0.25, 0.30, 0.40, 0.60, 0.80], abs=0.015)


@pytest.mark.parametrize("quality", TextureQuality)
def test_stains_are_seen_through_and_end_within_their_cells(quality):
    picture = pixels("stains.png", quality)
    alpha = picture[:, :, 3]
    assert (alpha == 0).mean() > 0.3
    assert alpha.max() > 150
    cell = len(alpha) // CELLS_ACROSS
    for mark, cells in CELLS.items():
        for left, top, width, height in cells:
            x, y, across, down = (int(value * cell) for value in (left, top, width, height))
            window = alpha[y : y + down, x : x + across]
            assert window.max() > 20
            border = np.concatenate([window[0], window[-1], window[:, 0], window[:, -1]])
            assert border.max() < (120 if mark.startswith("wear") else 40)
            # one ink in a cell, so that nothing else shines through at the border of a stain
            assert len(np.unique(picture[y : y + down, x : x + across, :3].reshape(-1, 3), axis=0)) == 1


@pytest.mark.parametrize("quality", TextureQuality)
@pytest.mark.parametrize("dirt", [Dirt.FAINT, Dirt.USUAL, Dirt.FILTHY])
def test_wear_goes_on_over_the_border_of_squares(quality, dirt):
    alpha = pixels("stains.png" if dirt is Dirt.USUAL else "dirt.png", quality)[:, :, 3]
    marks = DIRT_CELLS.get(dirt, CELLS)
    cell = len(alpha) // CELLS_ACROSS

    def window(mark, variant=0):
        x, y, width, height = (int(value * cell) for value in marks[mark][variant])
        return alpha[y : y + height, x : x + width]

    straight = window("wear_straight")[0]
    assert straight == pytest.approx(straight[::-1], abs=12)
    for border in (
        window("wear_straight", 1)[-1],
        window("wear_bend")[-1],
        window("wear_bend")[:, -1],
        window("wear_t")[-1],
        window("wear_t")[:, 0],
        window("wear_cross")[0],
        window("wear_cross")[:, -1],
    ):
        assert np.abs(border - straight).mean() < 8
