"""``garage2usd render``."""

import re
import sys
from pathlib import Path

import click
from click.shell_completion import CompletionItem

from garage2usd.cli.bars import Bars
from garage2usd.cli.parameters import INPUT_FILE, echo_table

__all__ = ["render"]

_SIZE = re.compile(r"(\d{1,5})x(\d{1,5})")
_PICTURES = ("colour", "depth", "normals", "instance", "semantic", "semantic_preview")


class _Size(click.ParamType[tuple[int, int]]):
    """Width and height in pixels, as ``1280x720``."""

    name = "WIDTHxHEIGHT"

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """Read the two numbers."""
        if isinstance(value, tuple):
            return value
        found = _SIZE.fullmatch(str(value))
        if found is None:
            self.fail(f"{value!r} is not a size such as 1280x720", param, ctx)
        return int(found[1]), int(found[2])


class _Pictures(click.ParamType[tuple[str, ...]]):
    """Kinds of pictures, with commas."""

    name = "KIND,..."

    def convert(self, value: object, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, ...]:
        """Split at commas."""
        if isinstance(value, tuple):
            return value
        kinds = tuple(part.strip() for part in str(value).split(","))
        unknown = [kind for kind in kinds if kind not in _PICTURES]
        if unknown:
            self.fail(f"{unknown[0]!r} is not one of {', '.join(_PICTURES)}", param, ctx)
        return kinds

    def shell_complete(self, _ctx: click.Context, _param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """The kinds that the last word may become."""
        begun, comma, last = incomplete.rpartition(",")
        return [CompletionItem(f"{begun}{comma}{kind}") for kind in _PICTURES if kind.startswith(last)]


@click.command(short_help="Render a stage's cameras with ground truth, by Blender.")
@click.argument("stage", metavar="PATH", type=INPUT_FILE)
@click.option(
    "--camera", "cameras", metavar="NAME|PRIM", multiple=True, help="A camera; may be repeated.  [default: all]"
)
@click.option(
    "--frames",
    metavar="FRAMES",
    help="Frames of cameras that move: 0, 0:96, 0:960x24, several with commas.  [default: every 48th]",
)
@click.option("--size", type=_Size(), default="1280x720", show_default=True, help="Width and height in pixels.")
@click.option(
    "--samples",
    metavar="N",
    type=click.IntRange(1, 65536),
    default=64,
    show_default=True,
    help="Samples of each pixel of the colour.",
)
@click.option(
    "--seed",
    metavar="N",
    type=click.IntRange(0, 2**31 - 1),
    default=0,
    show_default=True,
    help="Seed of the samples, not of the garage.",
)
@click.option(
    "--only", "pictures", type=_Pictures(), default=_PICTURES, help=f"Some of {', '.join(_PICTURES)}.  [default: all]"
)
@click.option(
    "--output",
    "-o",
    metavar="FOLDER",
    type=click.Path(file_okay=False, path_type=Path),
    default="dataset",
    show_default=True,
    help="Folder of the data set.",
)
def render(
    *,
    stage: Path,
    cameras: tuple[str, ...],
    frames: str | None,
    size: tuple[int, int],
    samples: int,
    seed: int,
    pictures: tuple[str, ...],
    output: Path,
) -> None:
    """Draw what the cameras of the stage PATH see: colour, depth, normals, instances and classes.

    Needs the extra `blender`, which is for Python 3.11. frames.json in the folder says where each camera
    stood and what can be seen.

    \b
    Examples:
      garage2usd render garage.usdz --camera Inside --samples 32
      garage2usd render garage.usdz --camera Drive --frames 0:480x24 --only colour,depth -o drive
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.render import Picture, render_stage  # noqa: PLC0415 - keeps --help instant

    with Bars(sys.stderr) as progress:
        made = render_stage(
            stage,
            output,
            cameras=cameras,
            frames=frames,
            size_px=size,
            samples=samples,
            seed=seed,
            pictures=[Picture(kind) for kind in pictures],
            progress=progress,
        )
    names = made.names
    drawn = f"{len(names)} ({names[0]} to {names[-1]})" if len(names) > 1 else names[0]
    kinds, folder = ", ".join(made.pictures), f"{made.folder}/"
    echo_table([("frames", drawn), ("pictures", kinds), ("folder", folder), ("table", str(made.frames))])
