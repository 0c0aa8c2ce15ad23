"""Shipped textures: the baked set, procedural and tileable, in three qualities, the same bytes on every machine."""

from pathlib import Path

import numpy as np
from PIL import Image

from garage2usd.assets.number_plates import bake_plate_ink, bake_plates
from garage2usd.assets.stain_texture import bake_dirt, bake_repairs, bake_road_dust, bake_stains
from garage2usd.assets.textures.ceilings import CEILING_FINISHES, CEILINGS, STEELS
from garage2usd.assets.textures.floors import FLOOR_FINISHES, FLOORS, GLOSSES
from garage2usd.assets.textures.paints import GUARDS, PAINTS, WEAR, WEAR_STEPS, Bakers, Pixels, wear_palette
from garage2usd.assets.textures.walls import WALL_FINISHES, WALLS
from garage2usd.common.progress import Progress, counted, silent
from garage2usd.config.outputs import TextureQuality

__all__ = ["bake_textures", "texture_folder"]

_FINISHES: Bakers = {**WEAR, **GUARDS, **GLOSSES, **FLOOR_FINISHES, **WALL_FINISHES, **CEILING_FINISHES}
_BAKERS: Bakers = {
    **FLOORS,
    **PAINTS,
    **WALLS,
    **CEILINGS,
    **STEELS,
    **_FINISHES,
    "stains.png": bake_stains,
    "asphalt_repairs.png": bake_repairs,
    "dirt.png": bake_dirt,
    "road_dust.png": bake_road_dust,
    "plate_characters.png": bake_plates,
    "plate_ink.png": bake_plate_ink,
}
_COLOUR_STEPS = {"plate_characters.png": 12, **dict.fromkeys(GLOSSES, 3), "gloss_matt.png": 5}
"""Textures with few colours, saved with a palette in half the bytes, and the distance between their colours."""
_SEED = 20_260_101
_DIVISORS = {TextureQuality.LOW: 4, TextureQuality.MEDIUM: 2, TextureQuality.HIGH: 1}
_JPEG_QUALITY, _FINISH_QUALITY = 90, 76
"""JPEG quality of the textures of every garage, and of those that a look selects."""
_RGBA, _LEVELS_ALONE = 4, 2
_WEAR_PAINT_RGB, _WEAR_GROUND_RGB = (0.75, 0.75, 0.72), (0.16, 0.16, 0.15)
"""Linear colours of the shipped wear textures: white on concrete."""
_ALPHA_STEPS = 28
_PALETTE_BYTES = 768


def texture_folder(quality: TextureQuality) -> Path:
    """Folder of the texture set in a quality: in the installed package, else at the top of the repository."""
    package = Path(__file__).parents[2]
    shipped = package / "textures"
    return (shipped if shipped.is_dir() else package.parent / "textures") / quality


def bake_textures(folder: Path, *, progress: Progress = silent) -> None:
    """Write the texture set into an existing folder, with a subfolder for each quality; `progress` counts textures.

    A pixel of a lower quality is the mean of those that it covers, which keeps the texture tileable.
    """
    for quality in _DIVISORS:
        (folder / quality).mkdir()
    for name, bake in counted("textures", _BAKERS.items(), len(_BAKERS), progress):
        rng = np.random.Generator(np.random.PCG64(np.random.SeedSequence([_SEED, *name.encode()])))
        pixels = bake(rng)
        for quality, divisor in _DIVISORS.items():
            _save(pixels, divisor, folder / quality / name)


def _save(pixels: Pixels, divisor: int, path: Path) -> None:
    picture = Image.fromarray(pixels).reduce(divisor)
    if pixels.ndim == _LEVELS_ALONE:
        picture = Image.fromarray(np.rint(np.asarray(picture) * ((WEAR_STEPS - 1) / 255)).astype(np.uint8))
        picture.putpalette(wear_palette(_WEAR_PAINT_RGB, _WEAR_GROUND_RGB))
        picture.save(path, format="PNG", optimize=True)
    elif pixels.shape[2] == _RGBA:
        # palette with opacity: few colours, one for each cell, but fine steps of low opacity
        alpha = np.rint(np.sqrt(np.asarray(picture.getchannel("A")) / 255.0) * _ALPHA_STEPS)
        opaque = np.rint((alpha / _ALPHA_STEPS) ** 2 * 255).astype(np.uint8)
        entries, picture = _palette(np.dstack([pixels[::divisor, ::divisor, :3], opaque]))
        picture.putpalette(entries[:, :3].tobytes())
        picture.save(path, format="PNG", optimize=True, transparency=entries[:, 3].tobytes())
    elif path.name in _COLOUR_STEPS:
        step = np.uint8(_COLOUR_STEPS[path.name])
        entries, picture = _palette(np.rint(np.asarray(picture) / step).astype(np.uint8) * step)
        rest = 0 if path.name in _FINISHES else _PALETTE_BYTES - entries.size
        picture.putpalette(entries.tobytes() + bytes(rest))
        picture.save(path, format="PNG", optimize=True)
    elif path.suffix == ".jpg":
        # no chroma subsampling for colours with sharp edges
        subsampling = "4:4:4" if path.stem == "hazard" or path.name in GUARDS else "4:2:0"
        quality = _FINISH_QUALITY if path.name in _FINISHES else _JPEG_QUALITY
        picture.save(path, format="JPEG", quality=quality, subsampling=subsampling, optimize=True)
    else:
        picture.save(path, format="PNG", optimize=True)


def _palette(colours: Pixels) -> tuple[Pixels, Image.Image]:
    """Distinct colours in order, one per row, and an image of their indices."""
    # sorted as integers, which is much faster than as rows
    places = 256 ** np.arange(colours.shape[2], dtype=np.uint32)[::-1]
    numbers, index = np.unique((colours * places).sum(axis=2, dtype=np.uint32), return_inverse=True)
    entries = (numbers[:, None] // places % 256).astype(np.uint8)
    return entries, Image.fromarray(index.reshape(colours.shape[:2]).astype(np.uint8))
