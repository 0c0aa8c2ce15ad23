"""The commands ``garage2usd schema``, ``textures`` and ``meshes``, which write what the package itself determines."""

import json
import sys
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING

import click

from garage2usd.cli.bars import Bars
from garage2usd.common.progress import counted

if TYPE_CHECKING:
    from garage2usd.objects import Spec

_GARAGES: tuple[tuple[int, dict[str, int]], ...] = ((20, {}), (6, {"width_cells": 30, "height_cells": 20}))
"""Number of seeds, from 0, and settings of the site: the default garage, and a large one."""
_LEAST_GARAGES = 2
"""Least number of garages that have a shape; a shape of a single garage is unlikely to occur in another."""


@click.command()
def schema() -> None:
    """Print the JSON schema of the configuration."""
    from garage2usd.config import config_schema  # noqa: PLC0415

    click.echo(json.dumps(config_schema(), indent=2))


@click.command(short_help="Bake the texture set that the package ships.")
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
def textures(folder: Path) -> None:
    """Bake the texture set that the wheel ships into FOLDER, byte for byte, a folder for each quality."""
    from garage2usd.assets.textures import bake_textures  # noqa: PLC0415
    from garage2usd.common.output import check_writable, publish, staging_folder  # noqa: PLC0415

    check_writable(folder)
    with staging_folder(folder) as staging:
        with Bars(sys.stderr) as progress:
            bake_textures(staging, progress=progress)
        folders = publish(sorted(staging.iterdir()), folder)
    click.echo(f"{sum(len(list(place.iterdir())) for place in folders)} textures in {folder}")


@click.command(short_help="Bake the meshes that the package ships.")
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
@click.option("--choose", is_flag=True, help="Choose the shapes anew: those that usual garages have in common.")
def meshes(folder: Path, *, choose: bool) -> None:
    """Precompute meshes of common shapes into a file in FOLDER: the shipped selection, or a new one with --choose."""
    from garage2usd.common.output import check_file, publish, staging_folder  # noqa: PLC0415
    from garage2usd.stage.prototypes import MESH_FILE, bake_meshes, baked_shapes  # noqa: PLC0415

    check_file(folder / MESH_FILE.name)
    shapes = _usual_shapes() if choose else list(baked_shapes())
    with staging_folder(folder / MESH_FILE.name) as staging:
        made = staging / MESH_FILE.name
        with Bars(sys.stderr) as progress:
            bake_meshes(shapes, made, progress=progress)
        (place,) = publish([made], folder)
    click.echo(f"{len(shapes)} shapes in {place}")


def _usual_shapes() -> list["Spec"]:
    """Shapes without lights that several garages share, and all car bodies."""
    from garage2usd.config import GarageConfig  # noqa: PLC0415
    from garage2usd.config.vehicles import CAR_BODIES, PAINTS  # noqa: PLC0415
    from garage2usd.objects.car import CarSpec  # noqa: PLC0415
    from garage2usd.pipeline import generate  # noqa: PLC0415

    asked = [(site, seed) for seeds, site in _GARAGES for seed in range(seeds)]
    garages: Counter[Spec] = Counter()
    with Bars(sys.stderr) as progress:
        for site, seed in counted("garages", asked, len(asked), progress):
            config = GarageConfig.model_validate({"site": site, "seed": seed})
            specs = generate(config).layout.placements.specs
            garages.update({spec.shape for spec in specs})
    shapes: dict[Spec, None] = {shape: None for shape, count in garages.items() if count >= _LEAST_GARAGES}
    shapes |= dict.fromkeys(CarSpec(body.name, PAINTS[0]) for body in CAR_BODIES)
    return [shape for shape in shapes if shape.asset().light is None]
