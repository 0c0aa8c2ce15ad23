"""Put the pictures of a rig's cameras at one place of a recording beside each other: the picture of docs/sensors.md.

Usage: python docs/pictures/surround.py RECORDING PICTURE [--pose 3] [--kind colour]
"""

import argparse
import json
from pathlib import Path

from PIL import Image

_COLUMNS = 2


def main() -> None:
    """Draw what the command line asks for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("recording", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--pose", type=int, default=3)
    parser.add_argument("--kind", default="colour")
    arguments = parser.parse_args()
    frames = json.loads((arguments.recording / "frames.json").read_text(encoding="utf-8"))["frames"]
    files = [arguments.recording / each["files"][arguments.kind] for each in frames if each["pose"] == arguments.pose]
    pictures = [Image.open(file).convert("RGB") for file in files]
    width, height = pictures[0].size
    rows = -(-len(pictures) // _COLUMNS)
    whole = Image.new("RGB", (width * _COLUMNS, height * rows))
    for number, picture in enumerate(pictures):
        whole.paste(picture, (number % _COLUMNS * width, number // _COLUMNS * height))
    whole.save(arguments.picture, quality=85)


if __name__ == "__main__":
    main()
