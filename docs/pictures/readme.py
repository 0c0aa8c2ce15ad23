"""Draw the rendered pictures of the README anew, with Blender: about a quarter of an hour on two cores.

Usage: python docs/pictures/readme.py [NAME ...] [--samples 8] [--width 1280]
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image

import garage2usd
from garage2usd.recordings import record
from garage2usd.render import Picture

_HERE = Path(__file__).parent
_SAMPLES = _HERE.parents[1] / "samples"
_ABOVE_STALLS = ("--at", "30", "11", "31", "0", "-42")
"""Place of a camera above the angled and parallel stalls, its yaw and its pitch."""
_VIEWS = {
    "paper_inside.png": ("paper_7x9", ("inside",)),
    "hand_drawn_inside.png": ("hand_drawn", ("inside",)),
    "dimensioned_inside.png": ("dimensioned", ("inside",)),
    "irregular_above.png": ("irregular", ("above",)),
    "mixed_stalls.jpg": ("mixed_stalls", ("above", *_ABOVE_STALLS)),
}
"""Sample of each picture, and how ``render.py`` draws it."""
_SURROUND = "surround.jpg"
_SURROUND_EVERY_M, _SURROUND_POSE = 45.0, 1


def main() -> None:
    """Draw what the command line asks for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    names = [*_VIEWS, _SURROUND]
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"some of {', '.join(names)}; without, all")
    parser.add_argument("--samples", type=int, default=8)
    parser.add_argument("--width", type=int, default=1280)
    options = parser.parse_args()
    if unknown := sorted({*options.names} - {*names}):
        parser.error(f"{', '.join(unknown)}: allowed: {', '.join(names)}")
    for name in options.names or names:
        with tempfile.TemporaryDirectory() as folder:
            draw = _draw_surround if name == _SURROUND else _draw
            picture = draw(name, Path(folder), options.samples, options.width).convert("RGB")
        picture.save(_HERE / name, optimize=True, quality=85)
        print(_HERE / name, flush=True)


def _draw(name: str, folder: Path, samples: int, width: int) -> Image.Image:
    """Draw a camera of a sample."""
    sample, view = _VIEWS[name]
    stage = garage2usd.build(garage2usd.load_config(_SAMPLES / f"{sample}.toml"), folder / f"{sample}.usdc").stage
    kind, *place = view
    output = folder / "drawn.png"
    how = [*place, "--samples", str(samples), "--width", str(width)]
    return _drawn("render.py", [str(stage), kind, str(output), *how], output)


def _draw_surround(_name: str, folder: Path, samples: int, width: int) -> Image.Image:
    """Draw what the four fisheyes of a rig see on a lane of the default garage."""
    stage = garage2usd.build(output=folder / "garage.usdc", seed=7).stage
    made = record(
        stage,
        folder / "drive",
        rig="avp_surround",
        along="1:A1-08",
        every_m=_SURROUND_EVERY_M,
        scale=width / 2 / 1280,
        samples=samples,
        pictures=[Picture.COLOUR],
    )
    output = folder / "drawn.png"
    at = ["--pose", str(_SURROUND_POSE)]
    return _drawn("surround.py", [str(made.folder), str(output), *at], output)


def _drawn(script: str, arguments: list[str], output: Path) -> Image.Image:
    subprocess.run([sys.executable, str(_HERE / script), *arguments], check=True)  # noqa: S603 - our own scripts
    with Image.open(output) as picture:
        picture.load()
        return picture


if __name__ == "__main__":
    main()
