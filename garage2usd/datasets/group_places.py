"""Places of garages among the alternatives of a recipe's groups: drawn, or spread evenly by number."""

import math
import zlib

import numpy as np

from garage2usd.common.randomness import Step, derived_seed

__all__ = ["MOST_EVEN", "drawn_place", "even_place", "setting_generator"]

_PRIMES = (5, 2, 3, 7, 11, 13, 17, 19)
_PLACE_BITS = 64
MOST_EVEN = len(_PRIMES)
"""Greatest number of groups that are spread evenly."""


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
    bits = 53  # of a float, so that no place is rounded up to 1
    return ((start + number * step) % (1 << _PLACE_BITS) >> _PLACE_BITS - bits) / (1 << bits)
