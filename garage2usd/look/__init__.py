"""Look of a garage: axes drawn by its seed, and the finishes that replace standard materials."""

from garage2usd.assets import Finish
from garage2usd.config.look import LookConfig
from garage2usd.look.finishes import Axes, own_finishes
from garage2usd.look.markings import drawn_markings, drawn_numbers, drawn_signs, paint_finishes
from garage2usd.look.surfaces import (
    ceiling_finishes,
    column_finishes,
    drawn_ceiling,
    drawn_columns,
    drawn_floor,
    drawn_lights,
    drawn_walls,
    floor_finishes,
    light_finishes,
    wall_finishes,
)

__all__ = ["drawn_look", "finishes_of"]


def drawn_look(look: LookConfig, seed: int) -> LookConfig:
    """Complete a look: draw the axes in `drawn` by the seed, and keep the given ones.

    Each axis has its own random generator, so that a given axis does not change the draws of the others.
    """
    axes = Axes(look, seed)
    return LookConfig(
        floor=drawn_floor(axes.of("floor")),
        markings=drawn_markings(axes.of("markings")),
        numbers=drawn_numbers(axes.of("numbers")),
        columns=drawn_columns(axes.of("columns")),
        walls=drawn_walls(axes.of("walls")),
        ceiling=drawn_ceiling(axes.of("ceiling")),
        lights=drawn_lights(axes.of("lights")),
        signs=drawn_signs(axes.of("signs")),
        textures=look.textures,
        font=look.font,
    )


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
