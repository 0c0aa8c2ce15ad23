"""A folder of drawn garages: a folder of strips for each, and which of them were drawn together."""

import json
from collections.abc import Sequence
from pathlib import Path

from strip_labels import LABELS_FILE, StripLabels, read_strip_labels
from strips import Strip, read_strips

from garage2usd.common.errors import ConfigError

__all__ = ["ABOUT_FILE", "drawn_garages", "read_drawn", "read_labelled", "write_drawn"]

ABOUT_FILE = "about.json"
"""In the folder of each garage: its seed, and where its car stands in each picture."""
_DRAWN_FILE = "drawn.json"


def write_drawn(folder: Path, garages: Sequence[Path]) -> None:
    """Write which garages a recipe made last, in its order."""
    (folder / _DRAWN_FILE).write_text(
        json.dumps([garage.name for garage in garages], indent=1) + "\n", encoding="utf-8"
    )


def drawn_garages(folder: Path) -> list[Path]:
    """The folder of strips of each garage that a recipe made last, in its order.

    Raises
    ------
    ConfigError
        If nothing was drawn there.
    """
    try:
        names = json.loads((folder / _DRAWN_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise ConfigError("drawn", str(folder), f"a folder with {_DRAWN_FILE}, which `real.py draw` writes") from None
    return [folder / name for name in names]


def read_drawn(folder: Path) -> list[list[Strip]]:
    """The strips of each garage that a recipe made last, in its order.

    Raises
    ------
    ConfigError
        If nothing was drawn there, or not all of it is there.
    """
    return [read_strips(garage) for garage in drawn_garages(folder)]


def read_labelled(folder: Path) -> list[list[tuple[Strip, StripLabels]]]:
    """The strips of each garage that a recipe made last, with the labels of their slots and of free ground.

    Raises
    ------
    ConfigError
        If nothing was drawn there, or not all of it is there.
    """
    garages = []
    for garage in drawn_garages(folder):
        labels = read_strip_labels(garage)
        strips = read_strips(garage)
        missing = [strip.name for strip in strips if strip.name not in labels]
        if missing:
            raise ConfigError("drawn", str(garage / missing[0]), f"pictures that {LABELS_FILE} has as well")
        garages.append([(strip, labels[strip.name]) for strip in strips])
    return garages
