"""Look of a garage: axes drawn by its seed, and the finishes that replace standard materials."""

from garage2usd.assets import Finish
from garage2usd.config.look import LookConfig
from garage2usd.look.draws import drawn_look
from garage2usd.look.finishes import own_finishes
from garage2usd.look.markings import paint_finishes
from garage2usd.look.surfaces import (
    ceiling_finishes,
    column_finishes,
    floor_finishes,
    light_finishes,
    wall_finishes,
)

__all__ = ["drawn_look", "finishes_of"]


def finishes_of(look: LookConfig) -> dict[str, Finish]:
    """Collect the finishes of a look by the keys of the materials that they replace; standard materials are left out.

    Raises
    ------
    ConfigError
        If the user's textures are invalid.
    """
    floor = floor_finishes(look.floor)
    drawn = {
        **floor,
        **paint_finishes(look.markings, look.numbers, floor),
        **column_finishes(look.columns),
        **wall_finishes(look.walls),
        **ceiling_finishes(look.ceiling),
        **light_finishes(look.lights),
    }
    return drawn if look.textures is None else {**drawn, **own_finishes(look.textures, look.floor, drawn)}
