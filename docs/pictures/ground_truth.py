"""Put the kinds of pictures of a frame beside each other: colour, instances, classes, normals.

Usage: python docs/pictures/ground_truth.py FOLDER PICTURE [--frame Inside]
"""

import argparse
from pathlib import Path

import numpy as np
import OpenEXR
from numpy.typing import NDArray
from PIL import Image

_SCRAMBLE = np.array([[73, 151, 211], [199, 37, 113], [89, 167, 61]])


def main() -> None:
    """Colour instances and normals, and join the four pictures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--frame", default="Inside")
    options = parser.parse_args()
    colour, instance, classes = (
        np.asarray(Image.open(options.folder / kind / f"{options.frame}.png").convert("RGB"))
        for kind in ("colour", "instance", "semantic_preview")
    )
    parts = [colour, _coloured(instance), classes, _normals(options.folder / "normals" / f"{options.frame}.exr")]
    Image.fromarray(np.vstack([np.hstack(parts[:2]), np.hstack(parts[2:])])).save(options.picture)


def _coloured(ids: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Give each number of an instance a colour of its own."""
    return np.asarray(40 + (ids.astype(np.int64) @ _SCRAMBLE + 97) % 200, dtype=np.uint8)


def _normals(path: Path) -> NDArray[np.uint8]:
    """Show directions as colours: grey is 0, and 1 is bright."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        normals = np.stack([np.asarray(channels[axis].pixels) for axis in "XYZ"], axis=-1)
    return np.asarray(np.clip(127.5 * (normals + 1), 0, 255), dtype=np.uint8)


if __name__ == "__main__":
    main()
