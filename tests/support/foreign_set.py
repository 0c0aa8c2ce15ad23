"""Textures of one's own in the shapes that packs come in, and what a program must show of each role."""

import io
from typing import NamedTuple

import numpy as np
from PIL import Image

from garage2usd.config import GarageConfig

SIZE = 48, 64
"""Rows and columns."""
JPEG_NOISE = 6


class Halves(NamedTuple):
    """A picture that is one colour in its upper half and another below: what is turned over shows."""

    top: tuple[int, ...]
    bottom: tuple[int, ...]

    def pixels(self, kind=np.uint8):
        rows, columns = SIZE
        picture = np.empty((rows, columns, len(self.top)), kind)
        picture[: rows // 2], picture[rows // 2 :] = self.top, self.bottom
        return picture.squeeze(-1) if len(self.top) == 1 else picture

    def save(self, path, *, kind=np.uint8, colours=0, **options):
        picture = Image.fromarray(self.pixels(kind))
        path.parent.mkdir(parents=True, exist_ok=True)
        (picture.quantize(colours) if colours else picture).save(path, **options)


SHOWN = {
    "FloorConcrete": {
        "colour": Halves((200, 40, 10), (10, 60, 220)),
        "packed": Halves((255, 156, 20), (255, 39, 90)),  # 40000 and 10000 of 65535
        "normal": Halves((150, 55, 230), (100, 190, 230)),
    },
    "WallConcrete": {
        "colour": Halves((90, 160, 90), (200, 190, 120)),
        "packed": Halves((220, 65, 0), (130, 215, 0)),
        "normal": Halves((128, 170, 240), (128, 80, 240)),
    },
    "CeilingConcrete": {
        "colour": Halves((210, 205, 190), (60, 66, 70)),
        "packed": Halves((240, 200, 5), (180, 120, 10)),
    },
}
"""By material and texture: red, green and blue; of a packed one occlusion, roughness and metallic; normals look up."""


def write_set(folder):
    """Floor, wall and ceiling as three packs name and store them."""
    floor, wall, ceiling = SHOWN.values()
    stem = folder / "floor" / "Concrete034_1K-PNG"
    floor["colour"].save(stem.with_name(f"{stem.name}_Color.png"), colours=4)
    Halves((40000,), (10000,)).save(stem.with_name(f"{stem.name}_Roughness.png"), kind=np.uint16)
    Halves((20,), (90,)).save(stem.with_name(f"{stem.name}_Metalness.png"))
    _green_down(floor["normal"]).save(stem.with_name(f"{stem.name}_NormalDX.png"))
    wall["colour"].save(folder / "wall" / "plaster_diff_1k.jpg", quality=95, subsampling=0, progressive=True)
    Halves((190,), (40,)).save(folder / "wall" / "plaster_gloss_1k.png")
    Halves((220,), (130,)).save(folder / "wall" / "plaster_ao_1k.png")
    _green_down(wall["normal"]).save(folder / "wall" / "plaster_nor_dx_1k.png")
    opaque = Halves((*ceiling["colour"].top, 255), (*ceiling["colour"].bottom, 80))
    opaque.save(folder / "ceiling_T_Slab_BC.png")
    ceiling["packed"].save(folder / "ceiling_T_Slab_ORM.png")


def _green_down(normal):
    return Halves(*((red, 255 - green, blue) for red, green, blue in normal))


def foreign_config(folder):
    """A small garage with such textures."""
    write_set(folder)
    return GarageConfig(seed=3, site={"width_cells": 4, "height_cells": 4}, look={"textures": str(folder)})


def halves_of(data):
    """Red, green and blue in the middle of either half of a picture, by Pillow."""
    with Image.open(io.BytesIO(data)) as picture:
        pixels = np.asarray(picture.convert("RGB"))
    rows, columns = pixels.shape[:2]
    return pixels[rows // 4, columns // 2], pixels[rows * 3 // 4, columns // 2]


def assert_foreign_set(surfaces, halves, *, packed=lambda rgb: rgb):
    """A program shows the set.

    Parameters
    ----------
    surfaces
        By the name of the material, what `support.finishes` has read.
    halves
        By the name of a file, what the program reads in its upper and its lower half; None for what it cannot tell.
    packed
        What the program makes of the three channels of a packed texture.
    """
    for name, textures in SHOWN.items():
        (surface,) = surfaces[name]
        assert np.allclose(surface.colour_rgb, 1)
        assert bool(surface.normal) == ("normal" in textures)
        for use, wanted in textures.items():
            found = halves(getattr(surface, use))
            if found is None:
                continue
            for half, expected in zip(found, wanted, strict=True):
                values = packed(expected) if use == "packed" else expected
                assert np.abs(np.subtract(values, half[: len(values)], dtype=int)).max() <= JPEG_NOISE, (name, use)
