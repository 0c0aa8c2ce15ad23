"""Weighted A* over arcs at full lock and straights, from a parked pose to a lane: compiled.

The car's place is exact; only what counts as the same place is rounded, to two thirds of a straight step and a heading.
Headings are whole multiples of 3 degrees off the lanes' own, so that a lane's heading is met exactly; a car parked
askew comes onto one of them with its first arc.
"""
# ruff: noqa: C901, PLR0912, PLR0915 - the search is one loop that numba flattens

import heapq
import math

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import Whole, compiled, compiled_allocating, compiled_inner
from garage2usd.driving.sweep import Floats, box_around, bulge, clearance, corners_at

__all__ = ["HEADINGS", "first_touch", "least_clearance", "search"]

HEADINGS = 120
"""How many headings there are in a full turn."""
_TURN = math.tau / HEADINGS
_CELL_PER_STEP = 2 / 3
_GEAR_CHANGE_M = 3.0
"""What a change of gear costs, as metres of way."""
_STEERING_M = 0.3
"""What a turn of the steering wheel costs, as metres of way."""
_GREED = 2.0
"""Weight of the way that is left: the way found costs at most so many times the least."""
_NEAR = 1e-7
_FIRST, _SECOND = np.int64(0), np.int64(4)
"""Rows of the corners of the first and the second of two footprints."""


@compiled
def first_touch(corners: Floats, shapes: Floats, boxes: Floats, need: float) -> int:
    """Number of a shape that the hull of two footprints comes nearer to than `need`; -1 if there is none."""
    left, low, right, high = box_around(corners, need)
    for number in range(shapes.shape[0]):
        if boxes[number, 0] > right or boxes[number, 2] < left or boxes[number, 1] > high or boxes[number, 3] < low:
            continue
        if clearance(corners, shapes[number], need) < need:
            return number
    return -1


@compiled_allocating
def least_clearance(poses: Floats, bulges: Floats, shapes: Floats, boxes: Floats, body: Floats, most: float) -> float:
    """Least distance, or less, to any shape along poses (x, z, yaw), `bulges` a step; `most` where all is farther."""
    corners = np.empty((8, 2))
    least = most
    for step in range(len(poses) - 1):
        for end in range(2):
            corners_at(poses[step + end, 0], poses[step + end, 1], poses[step + end, 2], body, corners, 4 * end)
        reach = least + bulges[step]
        left, low, right, high = box_around(corners, reach)
        for number in range(shapes.shape[0]):
            if boxes[number, 0] > right or boxes[number, 2] < left or boxes[number, 1] > high or boxes[number, 3] < low:
                continue
            least = min(least, clearance(corners, shapes[number], reach) - bulges[step])
    return least


@compiled_inner
def _left_of_way(x: float, z: float, yaw: float, goals: Floats, radius: float) -> float:
    """A lower bound of the way to any goal, with no regard for what stands in it."""
    least = np.inf
    for goal in range(goals.shape[0]):
        turn = (goals[goal, 0] * _TURN - yaw) % math.tau
        turn = min(turn, math.tau - turn)
        beside = max(goals[goal, 1] - x, 0.0, x - goals[goal, 3])
        before = max(goals[goal, 2] - z, 0.0, z - goals[goal, 4])
        least = min(least, max(radius * turn, math.hypot(beside, before)))
    return least


@compiled_inner
def _reaches(x: float, z: float, yaw: float, goals: Floats) -> bool:
    for goal in range(goals.shape[0]):
        turn = (goals[goal, 0] * _TURN - yaw) % math.tau
        inside = goals[goal, 1] <= x <= goals[goal, 3] and goals[goal, 2] <= z <= goals[goal, 4]
        if inside and min(turn, math.tau - turn) < _NEAR:
            return True
    return False


@compiled_inner
def _cell(x: float, z: float, yaw: float, gear: Whole, cell_m: float) -> int:
    """A number for a place, a heading and a gear; places lie within 40 m of the origin."""
    column, row = math.floor(x / cell_m) + 1024, math.floor(z / cell_m) + 1024
    heading = round(yaw / _TURN) % HEADINGS
    return ((column * 2048 + row) * HEADINGS + heading) * 2 + (1 if gear > 0 else 0)


@compiled_inner
def _slot(keys: NDArray[np.int64], key: int) -> int:
    """Where a key is in a table of open addressing, or where it would be put."""
    mask = len(keys) - 1
    slot = ((key * 0x9E3779B97F4A7C1) >> 20) & mask
    while keys[slot] != -1 and keys[slot] != key:
        slot = (slot + 1) & mask
    return slot


@compiled_allocating
def search(
    start: Floats,
    goals: Floats,
    shapes: Floats,
    boxes: Floats,
    body: Floats,
    radius: float,
    margin: float,
    reach: float,
    straight_m: float,
    max_changes: int,
    max_nodes: int,
    touched: NDArray[np.int64],
) -> tuple[int, Floats]:
    """Look for a way of little cost from a pose to a goal.

    Parameters
    ----------
    start
        x, z, yaw.
    goals
        Heading number, and the least x and z and the most x and z of the rear axle's middle; shape (n, 5).
    shapes, boxes
        Convex shapes, and left, top, right and bottom of each; shapes (m, k, 2) and (m, 4).
    body
        From the rear axle to nose and tail, and half the width.
    radius
        Of the arcs.
    margin
        What is kept clear all the way.
    reach
        How far from the start the rear axle may come along either axis.
    straight_m
        Length of a straight step.
    max_changes, max_nodes
        Of gear, and of places looked at.
    touched
        Counts for each shape how often it stood in the way.

    Returns
    -------
    tuple
        1 where a way was found, 0 where there is none, -1 where `max_nodes` did not do; and its steps as gear (1 or
        -1), steering (1 to the left, -1 or 0) and metres of way, shape (steps, 3).
    """
    place = np.empty((max_nodes, 3))
    cost = np.empty(max_nodes)
    parent = np.full(max_nodes, -1, np.int32)
    step_m = np.empty(max_nodes)
    code = np.zeros((max_nodes, 3), np.int8)  # gear, steering, changes of gear
    size = 1024
    while size < 2 * max_nodes:
        size *= 2
    keys, best = np.full(size, -1, np.int64), np.empty(size)
    corners = np.empty((8, 2))
    place[0], cost[0], count = start, 0.0, 1
    open_ = [(0.0, 0)]
    cell_m = _CELL_PER_STEP * straight_m
    full = bulge(radius, _TURN, body)
    while open_:
        _, node = heapq.heappop(open_)
        x, z, yaw = place[node, 0], place[node, 1], place[node, 2]
        if node > 0:
            slot = _slot(keys, _cell(x, z, yaw, np.int64(code[node, 0]), cell_m))
            if cost[node] > best[slot]:
                continue
            if _reaches(x, z, yaw, goals):
                return 1, _steps(node, parent, code, step_m)
        corners_at(x, z, yaw, body, corners, _FIRST)
        for gear in (-1, 1):
            is_change = code[node, 0] == -gear
            changes = code[node, 2] + (1 if is_change else 0)
            if changes > max_changes:
                continue
            for steering in (0, 1, -1):
                if steering == 0:
                    length, to = straight_m, yaw
                    to_x, to_z = x - math.sin(yaw) * gear * length, z - math.cos(yaw) * gear * length
                    need = margin
                else:
                    side = gear * steering
                    if side > 0:
                        to = (math.floor(yaw / _TURN + _NEAR) + 1) * _TURN
                    else:
                        to = (math.ceil(yaw / _TURN - _NEAR) - 1) * _TURN
                    turn = abs(to - yaw)
                    length = radius * turn
                    to_x = x + steering * radius * (math.cos(to) - math.cos(yaw))
                    to_z = z - steering * radius * (math.sin(to) - math.sin(yaw))
                    need = margin + full
                if abs(to_x - start[0]) > reach or abs(to_z - start[1]) > reach:
                    continue
                paid = cost[node] + length
                if is_change:
                    paid += _GEAR_CHANGE_M
                if steering != code[node, 1]:
                    paid += _STEERING_M
                key = _cell(to_x, to_z, to, gear, cell_m)
                slot = _slot(keys, key)
                if keys[slot] == key and best[slot] <= paid:
                    continue
                corners_at(to_x, to_z, to, body, corners, _SECOND)
                hit = first_touch(corners, shapes, boxes, need)
                if hit >= 0:
                    touched[hit] += 1
                    continue
                if count == max_nodes:
                    return -1, np.empty((0, 3))
                keys[slot], best[slot] = key, paid
                place[count, 0], place[count, 1], place[count, 2] = to_x, to_z, to
                cost[count], parent[count], step_m[count] = paid, node, length
                code[count, 0], code[count, 1], code[count, 2] = gear, steering, changes
                heapq.heappush(open_, (paid + _GREED * _left_of_way(to_x, to_z, to, goals, radius), count))
                count += 1
    return 0, np.empty((0, 3))


@compiled_allocating
def _steps(node: int, parent: NDArray[np.int32], code: NDArray[np.int8], step_m: Floats) -> Floats:
    """The steps from the start to a node."""
    count, at = 0, node
    while parent[at] >= 0:
        count, at = count + 1, parent[at]
    steps, at = np.empty((count, 3)), node
    for row in range(count - 1, -1, -1):
        steps[row, 0], steps[row, 1], steps[row, 2] = code[at, 0], code[at, 1], step_m[at]
        at = parent[at]
    return steps
