"""The command ``garage2usd textures``."""

from pathlib import Path

import click

__all__ = ["textures"]


@click.command(short_help="Bake the texture set that the package ships.")
@click.argument("folder", type=click.Path(file_okay=False, path_type=Path))
def textures(folder: Path) -> None:
    """Bake the texture set that the wheel ships into FOLDER, byte for byte, a folder for each quality."""
    from garage2usd.assets.textures import bake_textures  # noqa: PLC0415
    from garage2usd.common.output import check_writable, publish, staging_folder  # noqa: PLC0415

    check_writable(folder)
    with staging_folder(folder) as staging:
        bake_textures(staging)
        folders = publish(sorted(staging.iterdir()), folder)
    click.echo(f"{sum(len(list(place.iterdir())) for place in folders)} textures in {folder}")
