"""Weighted A* over arcs at full lock and straights, from a parked pose to a lane; implemented in C in `search.c`."""

from typing import NamedTuple

import numpy as np

from garage2usd.driving.sweep import Floats, Scene
from garage2usd.native import Float64Table, Int64s, in_c

__all__ = ["HEADINGS", "Found", "Task", "reeds_shepp_words", "search"]

HEADINGS = 120
"""Number of discrete headings in a full turn."""
_NO_MEMORY = -2
_MOST_PIECES, _MOST_WORDS = 5, 64


class Task(NamedTuple):
    """Input of the A* search for a parking manoeuvre.

    Attributes
    ----------
    scene
        The car and its obstacles.
    start
        x, z, yaw.
    goals
        Heading number, and the least x and z and the greatest x and z of the rear axle's middle; shape (n, 5).
    radius
        Radius of the arcs.
    margin
        Clearance kept around the car.
    reach
        Greatest distance of the rear axle from the start along either axis.
    straight_m
        Length of a straight step.
    max_changes, max_nodes
        Greatest number of gear changes, and of expanded nodes, at least one.
    headings
        Number of headings in a full turn: a multiple of 4.
    is_guided
        True to try Reeds-Shepp words, and to account for obstacles in the remaining cost.
    """

    scene: Scene
    start: Floats
    goals: Float64Table
    radius: float
    margin: float
    reach: float
    straight_m: float
    max_changes: int
    max_nodes: int
    headings: int = HEADINGS
    is_guided: bool = False


class Found(NamedTuple):
    """Result of the A* search for a parking manoeuvre.

    Attributes
    ----------
    outcome
        1 if a manoeuvre was found, 0 if there is none, -1 if `max_nodes` was reached.
    steps
        Steps as gear (1 or -1), steering (1 to the left, -1 or 0) and length in metres; shape (steps, 3).
    places
        Number of nodes reached.
    """

    outcome: int
    steps: Floats
    places: int


def search(task: Task, touched: Int64s) -> Found:
    """Search a low-cost manoeuvre from a parked pose to a goal by weighted A*.

    Parameters
    ----------
    task
        Input of the search.
    touched
        Counter of collisions for each shape.

    Raises
    ------
    MemoryError
        If there is no memory for `max_nodes` nodes.
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
    """Enumerate all Reeds-Shepp words between two poses (x, z, yaw), without obstacles.

    Returns
    -------
    array
        Steering (1 to the left, -1, 0) and metres (negative in reverse) of up to five pieces, padded with zeros;
        shape (words, 5, 2).
    """
    rows = np.empty((_MOST_WORDS, _MOST_PIECES, 2))
    return rows[: _write_words(start, end, radius, rows)].copy()


@in_c
def _write_words(start: Floats, end: Floats, radius: float, rows: Floats) -> int:
    raise NotImplementedError
