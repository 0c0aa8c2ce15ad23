"""Weighted A* over arcs at full lock and straights, from a parked pose to a lane. In C, `search.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.driving.sweep import Floats, Scene
from garage2usd.native import Int64s, in_c

__all__ = ["HEADINGS", "Task", "search"]

HEADINGS = 120
"""How many headings there are in a full turn."""
_NO_MEMORY = -2


class Task(NamedTuple):
    """What is asked of a search.

    Attributes
    ----------
    scene
        The car, and what it must not touch.
    start
        x, z, yaw.
    goals
        Heading number, and the least x and z and the most x and z of the rear axle's middle; shape (n, 5).
    radius
        Of the arcs.
    margin
        What is kept clear all the way.
    reach
        How far from the start the rear axle may come along either axis.
    straight_m
        Length of a straight step.
    max_changes, max_nodes
        Of gear, and of places looked at, at least one.
    """

    scene: Scene
    start: Floats
    goals: Floats
    radius: float
    margin: float
    reach: float
    straight_m: float
    max_changes: int
    max_nodes: int


def search(task: Task, touched: Int64s) -> tuple[int, Floats]:
    """Look for a way of little cost from a pose to a goal.

    Parameters
    ----------
    task
        What is asked.
    touched
        Counts for each shape how often it stood in the way.

    Returns
    -------
    tuple
        1 where a way was found, 0 where there is none, -1 where `max_nodes` did not do; and its steps as gear (1 or
        -1), steering (1 to the left, -1 or 0) and metres of way, shape (steps, 3).

    Raises
    ------
    MemoryError
        If there is no memory for `max_nodes` places.
    """
    steps = np.empty((task.max_nodes, 3))
    found = _find_steps(task, touched, steps)
    if found == _NO_MEMORY:
        raise MemoryError(f"{task.max_nodes} places of a search")
    return min(found, 1), steps[: max(found, 0)].copy()


@in_c
def _find_steps(task: Task, touched: Int64s, steps: Floats) -> int:
    raise NotImplementedError
