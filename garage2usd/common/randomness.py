"""One generator a step, so that a change in one step cannot move another."""

from enum import IntEnum, unique

import numpy as np

__all__ = ["Step", "derived_seed", "generator", "named_generator"]


@unique
class Step(IntEnum):
    """Every random step of the road and of its sensors with its fixed id; ids are never used again for another step."""

    CONTOUR = 1
    PORTALS = 2
    OBSTACLES = 3
    PLAN = 4
    CARS = 5
    SIGNS = 6
    SPEED_BUMPS = 7
    CONES = 8
    FLOOR_STAINS = 12
    NUMBER_PLATES = 13
    LOOK = 14
    FLOOR_MARKINGS = 17
    PUDDLES = 18
    PUDDLE_SHAPES = 19
    ARRANGEMENTS = 20
    CLUTTER = 21
    STALL_KINDS = 22
    DIRECTIONS = 23
    LINKS = 24
    LEVELS = 25
    LIDAR = 30
    CAMERA_EFFECTS = 31
    GARAGES = 40
    SETTINGS = 41
    SPLITS = 42
    DRIVES = 43


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


def named_generator(seed: int, step: Step, name: str) -> np.random.Generator:
    """The generator of a part of a step that has a name, so that what is drawn for one cannot move another."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, int(step), *name.encode()])))


def derived_seed(seed: int, step: Step, *numbers: int) -> int:
    """A seed of its own for a part of some work, such as a garage of a data set.

    Parameters
    ----------
    seed
        The seed of the whole, 0 or more.
    step
        Which step has parts.
    numbers
        Which part it is, each 0 or more.

    Returns
    -------
    int
        At least 0 and less than 2**63.
    """
    return int(np.random.SeedSequence([seed, int(step), *numbers]).generate_state(1, np.uint64)[0] >> np.uint64(1))
