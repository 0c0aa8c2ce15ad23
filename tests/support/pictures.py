"""Coarse comparison of rendered pictures with those in ``tests/clients/pictures``.

A picture tells what counts and places cannot: that a stage is lit, textured and seen from the right side. It is shrunk
to 32 x 18 greys before it is compared, so that neither noise nor another renderer's version matters.
"""

import io
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).parents[1] / "clients" / "pictures"
_STORED_SIZE = 320, 180
_COARSE_SIZE = 32, 18


def read_png(data):
    """The picture in the bytes of a PNG file."""
    return Image.open(io.BytesIO(data)).convert("RGB")


def coarse(picture):
    """32 x 18 greys from 0 to 255; float64, shape (18, 32)."""
    return np.asarray(_shrunk(picture).convert("L").resize(_COARSE_SIZE, Image.Resampling.BOX), dtype=float)


def difference(one, other):
    """Mean absolute difference of two pictures in greys of 255, seen coarsely."""
    return float(np.abs(coarse(one) - coarse(other)).mean())


def stored(name):
    """A picture that was looked at and found good."""
    with Image.open(FOLDER / f"{name}.png") as picture:
        return picture.convert("RGB")


def store(name, picture):
    """Replace a stored picture."""
    FOLDER.mkdir(exist_ok=True)
    _shrunk(picture).save(FOLDER / f"{name}.png", optimize=True)


def _shrunk(picture):
    return picture.convert("RGB").resize(_STORED_SIZE, Image.Resampling.BOX)
