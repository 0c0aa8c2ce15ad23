"""The command ``garage2usd look``."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.cli.options import INPUT_FILE, Numbers, Size, count_option, device_option, echo_table
from garage2usd.common.errors import ConfigError

if TYPE_CHECKING:
    from garage2usd.contact_sheet import SheetGarage

_RECIPE_KEYS = {"garage", "groups", "make", "shards", "splits"}


@click.command(short_help="Tell how a garage looks, or draw many beside each other.")
@click.argument("config", metavar="[CONFIG|RECIPE]", required=False, type=INPUT_FILE)
@click.option(
    "--seeds",
    type=Numbers(),
    help="Seeds of a configuration, numbers of a recipe's garages: 7, 0:48 for 0 to 47, several with commas.  "
    "[default: the configuration's, or 0]",
)
@click.option(
    "--contact-sheet",
    "sheet",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Draw each of them from its entrance and from above, into one picture (.png or .jpg); of several levels each.",
)
@click.option(
    "--size",
    type=Size(),
    default="320x180",
    show_default=True,
    help="With --contact-sheet: width and height in pixels of each of the two pictures of a garage or level.",
)
@count_option("--samples", 65536, 4, "With --contact-sheet: samples of each pixel.")
@count_option("--columns", 100, 3, "With --contact-sheet: garages in a row, or levels.")
@device_option("With --contact-sheet: what draws them.")
def look(
    *,
    config: Path | None,
    seeds: tuple[int, ...] | None,
    sheet: Path | None,
    size: tuple[int, int],
    samples: int,
    columns: int,
    device: str,
) -> None:
    """Print the look of a garage, including the values drawn by its seed, as TOML for a configuration.

    Without CONFIG this is the default garage with all axes of the look drawn. A recipe selects one of its garages; the
    recipe.json of a data set selects one of its finished garages and needs the extra `dataset`.

    --contact-sheet, which needs the extra `blender`, renders many garages side by side, and each level of a garage of
    several. After an interruption finished garages remain in FILE.unfinished, and the same command resumes.

    \b
    Examples:
      garage2usd look --seeds 7
      garage2usd look samples/hand_drawn.toml
      garage2usd look samples/recipes/looks.toml --seeds 0:48 --contact-sheet looks.png
    """  # noqa: D301 - click's mark for a block that is not wrapped
    from garage2usd.config.look import look_text  # noqa: PLC0415 - keeps --help instant
    from garage2usd.look import drawn_look  # noqa: PLC0415

    if sheet is None:
        if seeds is not None and len(seeds) > 1:
            raise click.UsageError("Give one number to --seeds, or --contact-sheet FILE as well.")
        garage = next(_garages(config, seeds))
        click.echo(look_text(drawn_look(garage.config.look, garage.config.seed)), nl=False)
        return
    from garage2usd.contact_sheet import draw_contact_sheet  # noqa: PLC0415
    from garage2usd.render import Device  # noqa: PLC0415

    with Bars(sys.stderr, unit="garages") as progress:
        garages: list[SheetGarage] = []
        for garage in _garages(config, seeds):
            progress("plans", len(garages), len(seeds or (0,)))
            garages.append(garage)
        made = draw_contact_sheet(
            garages,
            sheet,
            size_px=size,
            samples=samples,
            columns=columns,
            device=Device(device),
            progress=progress,
            announce=progress.announce,
        )
    echo_table([("garages", str(len(garages))), ("picture", str(made))])


def _garages(path: Path | None, numbers: tuple[int, ...] | None) -> Iterator["SheetGarage"]:
    """Return the requested garages."""
    from garage2usd.config import GarageConfig, load_config  # noqa: PLC0415 - keeps --help instant

    if path is not None and _is_recipe(path):
        from garage2usd.datasets.garage_choice import chosen_garages  # noqa: PLC0415 - of an extra

        yield from chosen_garages(path, numbers or (0,))
        return
    from garage2usd.contact_sheet import SheetGarage  # noqa: PLC0415

    settings = GarageConfig(look={"drawn": True}) if path is None else load_config(path)
    for number in numbers or (settings.seed,):
        yield SheetGarage(f"seed {number}", settings.with_seed(number))


def _is_recipe(path: Path) -> bool:
    """Return True if a file is the recipe of a data set, False for a configuration."""
    from garage2usd.common.documents import read_toml  # noqa: PLC0415 - keeps --help instant

    if path.suffix.lower() == ".json":
        return True
    try:
        return not _RECIPE_KEYS.isdisjoint(read_toml(path, field="CONFIG"))
    except ConfigError:
        return False  # `load_config` will raise a better error
