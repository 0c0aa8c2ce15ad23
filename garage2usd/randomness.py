"""One generator a step, so that a change in one step cannot move another."""

from enum import IntEnum, unique

import numpy as np

__all__ = ["Step", "generator"]


@unique
class Step(IntEnum):
    """Every random step of the road with its fixed id; ids are never used again for another step."""

    CONTOUR = 1
    PORTALS = 2
    OBSTACLES = 3
    PLAN = 4
    CARS = 5
    SIGNS = 6
    SPEED_BUMPS = 7
    CONES = 8
    FLOOR_STAINS = 12
    ARRANGEMENTS = 20


def generator(seed: int, step: Step, attempt: int = 0) -> np.random.Generator:
    """The generator of one step.

    Parameters
    ----------
    seed
        The garage's seed, 0 or more.
    step
        Which step draws from it.
    attempt
        Number of the restart, so that a restarted step draws anew.
    """
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, int(step), attempt])))
