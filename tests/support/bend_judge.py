"""Judge of a car that drives between walls: parts of meshes at the heights of its body, cut out exactly."""

import math

import numpy as np
import shapely

AHEAD_M, BEHIND_M, HALF_M = 3.6, 1.2, 0.9
LOW_M, HIGH_M = 0.15, 1.5
"""Heights over the floor between which a car's body is taken to be."""


def _cut(corners, height_m, sign):
    """Cut the part of a convex polygon that lies over (sign 1) or under (-1) a height."""
    found = []
    for one, other in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        over, next_over = sign * (one[1] - height_m), sign * (other[1] - height_m)
        if over >= 0:
            found.append(one)
        if over * next_over < 0:
            found.append(one + (other - one) * over / (over - next_over))
    return np.array(found)


def outlines(states, numbers, half_m=HALF_M):
    """Outline (x, z) of the design car at some states."""
    found = []
    for at in numbers:
        yaw = states.yaw_rad[at]
        along = np.array([-math.sin(yaw), -math.cos(yaw)])
        across = np.array([-along[1], along[0]])
        ends = ((AHEAD_M, 1), (AHEAD_M, -1), (-BEHIND_M, -1), (-BEHIND_M, 1))
        place = np.array([states.x_m[at], states.z_m[at]])
        found.append(shapely.Polygon([place + far * along + side * half_m * across for far, side in ends]))
    return found


def overlaps(states, triangles, every_m=0.4, wider_m=0.0):
    """Names of what a car, or a wider one, overlaps on a drive; `triangles` are names and corners, shape (n, 3, 3)."""
    arc = np.asarray(states.arc_m)
    numbers = np.unique(np.searchsorted(arc, np.arange(0.0, arc[-1], every_m)))
    corners = np.concatenate([part for _, part in triangles])
    names = [name for name, part in triangles for _ in part]
    tree = shapely.STRtree(shapely.box(*corners[:, :, [0, 2]].min(axis=1).T, *corners[:, :, [0, 2]].max(axis=1).T))
    found = set()
    for at, outline in zip(numbers, outlines(states, numbers, HALF_M + wider_m), strict=True):
        rear, pitch = states.y_m[at], states.pitch_rad[at]
        low, high = rear + LOW_M + AHEAD_M * abs(math.tan(pitch)), rear + HIGH_M
        for number in tree.query(outline).tolist():
            if names[number] in found or not low < corners[number, :, 1].max() or corners[number, :, 1].min() > high:
                continue
            part = _cut(corners[number], low, 1)
            part = _cut(part, high, -1) if len(part) else part
            if len(part) and shapely.MultiPoint(part[:, [0, 2]]).convex_hull.intersects(outline):
                found.add(names[number])
    return found
