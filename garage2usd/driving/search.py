"""Weighted A* over arcs at full lock and straights, from a parked pose to a lane. In C, `search.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.driving.sweep import Floats, Scene
from garage2usd.native import Int64s, in_c

__all__ = ["HEADINGS", "Found", "Task", "reeds_shepp_words", "search"]

HEADINGS = 120
"""How many headings there are in a full turn."""
_NO_MEMORY = -2
_MOST_PIECES, _MOST_WORDS = 5, 64


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
    headings
        In a full turn: a multiple of 4.
    is_guided
        Whether words of Reeds and Shepp are tried, and what stands in the way counts in what is left of it.
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
    headings: int = HEADINGS
    is_guided: bool = False


class Found(NamedTuple):
    """What a search came to.

    Attributes
    ----------
    outcome
        1 where a way was found, 0 where there is none, -1 where `max_nodes` did not do.
    steps
        Of the way, as gear (1 or -1), steering (1 to the left, -1 or 0) and metres of way; shape (steps, 3).
    places
        How many were reached.
    """

    outcome: int
    steps: Floats
    places: int


def search(task: Task, touched: Int64s) -> Found:
    """Look for a way of little cost from a pose to a goal.

    Parameters
    ----------
    task
        What is asked.
    touched
        Counts for each shape how often it stood in the way.

    Raises
    ------
    MemoryError
        If there is no memory for `max_nodes` places.
    """
    steps = np.empty((task.max_nodes + _MOST_PIECES, 3))
    places = np.zeros(1, np.int64)
    found = _find_steps(task, touched, places, steps)
    if found == _NO_MEMORY:
        raise MemoryError(f"{task.max_nodes} places of a search")
    return Found(min(found, 1), steps[: max(found, 0)].copy(), int(places[0]))


@in_c
def _find_steps(task: Task, touched: Int64s, places: Int64s, steps: Floats) -> int:
    raise NotImplementedError


def reeds_shepp_words(start: Floats, end: Floats, radius: float) -> Floats:
    """All ways of Reeds and Shepp between two poses (x, z, yaw), where nothing stands in the way.

    Returns
    -------
    array
        Steering (1 to the left, -1, 0) and metres (negative in reverse) of up to five pieces, zeros where there are
        fewer; shape (words, 5, 2).
    """
    rows = np.empty((_MOST_WORDS, _MOST_PIECES, 2))
    return rows[: _write_words(start, end, radius, rows)].copy()


@in_c
def _write_words(start: Floats, end: Floats, radius: float, rows: Floats) -> int:
    raise NotImplementedError
