"""Plan and drive with the loops of a given library: ``python -m support.sanitized_loops LIBRARY``.

Run with the sanitizers' runtimes preloaded, as Python itself is compiled without them.
"""

import sys
from pathlib import Path

import numpy as np

from garage2usd.config import BayConfig, PlanConfig, SiteConfig
from garage2usd.driving import path as paths
from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.obstacles import Scene
from garage2usd.driving.turns import Steering, joining_pieces
from garage2usd.driving.way_search import Task, reeds_shepp_words, search
from garage2usd.native import elementary, using
from garage2usd.planning import find_optimum, plan_lanes
from garage2usd.site import make_site

NUMBERS = np.array(
    [0.0, -0.0, 5e-324, -1e-310, 1e-9, 0.5, -0.97, 1.0, 3.3, -710.0, 1e6, -1e17, 1e300, np.inf, -np.inf, np.nan]
)
"""Corners of the elementary functions: conversions to integers, shifts and exponents that could overflow."""
RIGHT_ANGLED = {"dimensioned": False}
CASES = (
    (7, 6, {}, {}),  # over squares, climb, annealing with sides
    (6, 6, {"preset": "paper"}, RIGHT_ANGLED),
    (14, 13, {"circulation": "allow"}, RIGHT_ANGLED),  # over aisles, drift
    (14, 12, {}, {}),  # annealing by labels
)


def plan_and_drive():
    """Go through each optimiser once, and through a search past a wall."""
    for seed, (cols, rows, changed, sides) in enumerate(CASES):
        bay, plan = BayConfig(**sides), PlanConfig(episodes=50, **changed)
        plan_lanes(
            make_site(SiteConfig(width_cells=cols, height_cells=rows), bay=bay, seed=seed),
            plan=plan,
            bay=bay,
            seed=seed,
        )
    bay = BayConfig(**RIGHT_ANGLED)
    find_optimum(make_site(SiteConfig(width_cells=6, height_cells=5), bay=bay, seed=1), bay=bay)
    wall = np.array([[(-2, -8), (2, -8), (2, -7), (-2, -7)]], float)
    scene = Scene(wall, np.concatenate([wall.min(axis=1), wall.max(axis=1)], axis=1), np.array([3.7, 1.0, 0.9]))
    goal = np.array([[0, -0.5, -11.5, 0.5, -10.5]])
    task = Task(scene, np.zeros(3), goal, 4.5, 0.05, 12.0, 0.36, 2, 3000)
    for is_guided in (False, True):
        search(task._replace(is_guided=is_guided), np.zeros(1, np.int64))
    reeds_shepp_words(np.zeros(3), np.array([3.0, -8.0, 1.0]), 4.5)
    for name in ("sin", "cos", "tan", "arcsin", "arccos", "arctan", "exp", "log"):
        getattr(elementary, name)(NUMBERS)
    elementary.power(np.abs(NUMBERS), NUMBERS)
    elementary.arctan2(NUMBERS[:, None], NUMBERS)
    elementary.turned(NUMBERS)
    start = Pose(0.0, 0.0, 0.3)
    for pieces in joining_pieces(start, Pose(4.0, -19.0, 0.2), Steering(0.2, 0.1)):
        path = paths.Path(start, pieces)
        path.at([0.0, 5.0, path.length_m])
        path.over_middle_m(DesignCar(), np.array([[0.0, -1.0, 0.0, 0.0, -9.0, 9.0, -9.0, 9.0, 1.5]]), far_cost=2.0)


if __name__ == "__main__":
    with using(Path(sys.argv[1])):
        plan_and_drive()
    print("clean")  # noqa: T201
