"""Settings of a recipe: tables with distributions in place of values, and places of garages in its groups."""

import math
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TypeGuard

import numpy as np

from garage2usd.common.randomness import Step, derived_seed
from garage2usd.config.files import with_textures
from garage2usd.config.font_file import FontFile, read_font
from garage2usd.config.texture_sets import TextureFolder, read_texture_sets
from garage2usd.datasets.distribution import distribution_of

_PRIMES = (5, 2, 3, 7, 11, 13, 17, 19)
_PLACE_BITS = 64
MOST_EVEN = len(_PRIMES)
"""Greatest number of groups that are spread evenly."""


def merge_settings(settings: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    """Merge settings over others, table by table; a distribution replaces a table or value as a whole."""
    merged = dict(settings)
    for key, value in above.items():
        below = merged.get(key)
        merged[key] = merge_settings(below, value) if _is_table(below, key) and _is_table(value, key) else value
    return merged


def _is_table(value: object, key: str) -> TypeGuard[Mapping[str, Any]]:
    """Test if a value is a table of settings and not a distribution."""
    return isinstance(value, Mapping) and distribution_of(value, field=key) is None


def resolved(settings: Mapping[str, Any], within: str, resolve: Callable[[Any, str], Any]) -> dict[str, Any]:
    """Replace each distribution in settings by `resolve` of the distribution and its dotted name."""
    found = {}
    for key, value in settings.items():
        field = f"{within}.{key}"
        if _is_table(value, field):
            found[key] = resolved(value, field, resolve)
        else:
            found[key] = resolve(value, field)
    return found


def first_value(
    value: object, field: str, *, ends_of: dict[str, tuple[Any, ...]], given: Mapping[str, Any] | None = None
) -> object:
    """Return the given or else the first value of a distribution, and record its extreme values."""
    distribution = distribution_of(value, field=field)
    if distribution is None:
        return value
    if given and field in given:
        return given[field]
    ends_of[field] = distribution.ends()
    return ends_of[field][0]


def pin_textures(recipe: Mapping[str, Any], folder: Path) -> None:
    """Make paths of texture folders and of fonts in a recipe absolute, and add digests of their contents.

    Parameters
    ----------
    recipe
        Parsed recipe, valid or not; its tables of settings are changed in place.
    folder
        Folder of relative paths.

    Raises
    ------
    ConfigError
        If textures or a font are invalid.
    """
    groups = recipe.get("groups")
    of_groups = groups.values() if isinstance(groups, dict) else ()
    alternatives = [each for group in of_groups if isinstance(group, list) for each in group]
    for holder in (recipe, *alternatives):
        match holder:
            case {"garage": dict() as table}:
                match with_textures(table, folder):
                    case {"look": {"textures": str(named)} as look}:
                        textures, _ = read_texture_sets(TextureFolder(folder=named))
                        table["look"] = {**look, "textures": textures.model_dump()}
                match with_textures(table, folder):
                    case {"look": {"font": str(named)} as look}:
                        table["look"] = {**look, "font": read_font(FontFile(file=named)).model_dump()}


def setting_generator(seed: int, field: str) -> np.random.Generator:
    """Create the random generator of one distribution for one garage."""
    return np.random.Generator(
        np.random.PCG64(np.random.SeedSequence([seed, int(Step.SETTINGS), zlib.crc32(field.encode())]))
    )


def drawn_place(seed: int, group: str) -> float:
    """Draw the place of a garage among the alternatives of a group, from 0 to 1."""
    return float(setting_generator(seed, f"groups.{group}").random())


def even_place(seed: int, group: str, number: int, *, index: int) -> float:
    """Compute the place of a garage among the alternatives of a group from its number, from 0 to 1.

    Parameters
    ----------
    seed
        Seed of the recipe.
    group
        Name of the group.
    number
        Number of the garage.
    index
        Number of the group among those that are spread evenly, less than `MOST_EVEN`.

    Notes
    -----
    Kronecker sequences of the square roots of different primes are evenly spread, each and together (Niederreiter,
    Random Number Generation and Quasi-Monte Carlo Methods, 1992, chapter 3). They are computed in integers.
    """
    step = math.isqrt(_PRIMES[index] << 2 * _PLACE_BITS)
    start = derived_seed(seed, Step.SETTINGS, zlib.crc32(group.encode())) << 1
    bits = 53  # bits of a float, so that no place is rounded up to 1
    return ((start + number * step) % (1 << _PLACE_BITS) >> _PLACE_BITS - bits) / (1 << bits)
