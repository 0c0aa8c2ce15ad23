"""Random generators, one for each step, so that a change in one step does not affect another."""

from enum import IntEnum, unique

import numpy as np


@unique
class Step(IntEnum):
    """Random steps of the pipeline and the sensors with fixed ids; an id is never reused."""

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
    TRAFFIC = 44
    TRAFFIC_CARS = 45
    TRAFFIC_PEOPLE = 46


def generator(seed: int, step: Step, attempt: int = 0) -> np.random.Generator:
    """Create the random generator of a step.

    Parameters
    ----------
    seed
        Seed of the garage, 0 or more.
    step
        The step.
    attempt
        Number of the restart; each restart has different draws.
    """
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, int(step), attempt])))


def named_generator(seed: int, step: Step, name: str) -> np.random.Generator:
    """Create the random generator of a named part of a step, independent of its other parts."""
    return np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, int(step), *name.encode()])))


def derived_seed(seed: int, step: Step, *numbers: int) -> int:
    """Derive a seed for a part of some work, such as one garage of a data set.

    Parameters
    ----------
    seed
        Seed of the whole, 0 or more.
    step
        Step that has parts.
    numbers
        Indices of the part, each 0 or more.

    Returns
    -------
    int
        At least 0 and less than 2**63.
    """
    return int(np.random.SeedSequence([seed, int(step), *numbers]).generate_state(1, np.uint64)[0] >> np.uint64(1))
