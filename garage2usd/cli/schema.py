"""The command ``garage2usd schema``."""

import json

import click

__all__ = ["schema"]


@click.command()
def schema() -> None:
    """Print the JSON schema of the configuration."""
    from garage2usd.config import config_schema  # noqa: PLC0415

    click.echo(json.dumps(config_schema(), indent=2))
