"""Textures beside a stage, in the quality that the user's budget allows."""

import shutil
from pathlib import Path

from PIL import Image

from garage2usd.config.stage import TextureQuality

__all__ = ["write_texture"]

_DIVISORS = {TextureQuality.LOW: 4, TextureQuality.MEDIUM: 2}


def write_texture(source: Path, target: Path, quality: TextureQuality) -> None:
    """Copy a texture, or write it smaller: each pixel the mean of those that it covers, so that it still repeats."""
    if quality is TextureQuality.HIGH:
        shutil.copyfile(source, target)
        return
    with Image.open(source) as picture:
        picture.reduce(_DIVISORS[quality]).save(target, format="PNG", optimize=True)
