"""An independent search for a way out of a stall: a flood over sampled poses, gear by gear, with no margin.

It is optimistic: it looks only at sampled poses, 0.1 m apart at most. What it cannot reach is out of reach.
"""

import math

import numpy as np
import shapely

from support.driving_simulation import TRACK_M, TURNING_RADIUS_M, WHEELBASE_M, outlines

_RADIUS_M = math.sqrt(TURNING_RADIUS_M**2 - WHEELBASE_M**2) - TRACK_M / 2
_HEADINGS = 144
_CELL_M = 0.1
_STEP_M = 0.2
_REACH_M = 13.0


def has_way_out(start, obstacles, is_goal, *, gear_changes=4):
    """Whether a car gets from a pose (x, z, yaw) to one for which `is_goal` holds, an array of poses at a time."""
    shapely.prepare(obstacles)
    cells = round(2 * _REACH_M / _CELL_M)
    seen = np.zeros((2, cells, cells, _HEADINGS), dtype=bool)
    origin = np.array(start[:2])
    start = np.array([start], dtype=float)
    if shapely.intersects(obstacles, outlines(start)).any():
        return False
    layer = {0: start, 1: start}
    for _ in range(gear_changes + 1):
        reached = {}
        for gear, frontier in layer.items():
            found = [frontier]
            while len(found[-1]):
                fresh = _unseen(_stepped(found[-1], (1.0, -1.0)[gear]), origin, seen[gear])
                clear = fresh[~shapely.intersects(obstacles, outlines(fresh))] if len(fresh) else fresh
                if len(clear) and is_goal(clear).any():
                    return True
                found.append(clear)
            reached[gear] = np.concatenate(found)
        layer = {0: reached[1], 1: reached[0]}
    return False


def _unseen(poses, origin, seen):
    """One pose for each cell within reach that none was in before; the cells are marked."""
    cells = len(seen)
    place = np.floor((poses[:, :2] - origin + _REACH_M) / _CELL_M).astype(int)
    heading = np.rint(poses[:, 2] / math.tau * _HEADINGS).astype(int) % _HEADINGS
    inside = ((place >= 0) & (place < cells)).all(axis=1)
    poses, key = poses[inside], (place[inside, 0] * cells + place[inside, 1]) * _HEADINGS + heading[inside]
    key, first = np.unique(key, return_index=True)
    is_fresh = ~seen.reshape(-1)[key]
    seen.reshape(-1)[key] = True
    return poses[first[is_fresh]]


def _stepped(poses, sign):
    """The poses after a step straight on, and after steps at full and half lock to both sides."""
    x, z, yaw = poses.T
    after = []
    for curvature in (0.0, 1 / _RADIUS_M, -1 / _RADIUS_M, 0.5 / _RADIUS_M, -0.5 / _RADIUS_M):
        middle = yaw + sign * curvature * _STEP_M / 2
        chord = _STEP_M if curvature == 0 else 2 / abs(curvature) * math.sin(abs(curvature) * _STEP_M / 2)
        after.append(
            np.stack(
                [
                    x - np.sin(middle) * sign * chord,
                    z - np.cos(middle) * sign * chord,
                    yaw + sign * curvature * _STEP_M,
                ],
                axis=1,
            )
        )
    return np.concatenate(after)
