"""Compiled facts about a board: how many stalls a square holds, whether lanes join the portals, what a plan is worth.

Squares are numbered ``(row + 1) * stride + col + 1`` on a matrix padded by one blocked square; ``kind`` is -1 blocked,
0 free, 1 lane. Imported on first use, so that nothing else pays for the compiler.
"""

import numba as nb
import numpy as np

__all__ = [
    "NO_VALUE",
    "capacity_of",
    "connect_portals",
    "lanes_connected",
    "next_random",
    "uniform",
    "untouched_portal",
    "value_of",
]

NO_VALUE = -1.0e9
"""Worth of a matrix without stalls, or with stalls that no entrance reaches."""


@nb.njit(cache=True, inline="always")
def next_random(state):
    """splitmix64: the same numbers on every machine."""
    state[0] += np.uint64(0x9E3779B97F4A7C15)
    z = state[0]
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return z ^ (z >> np.uint64(31))


@nb.njit(cache=True, inline="always")
def uniform(state):
    """A float64 in [0, 1) of 53 random bits."""
    return np.float64(next_random(state) >> np.uint64(11)) * (1.0 / 9007199254740992.0)


@nb.njit(cache=True, inline="always")
def capacity_of(q, kind, capacity, stride):
    """Stalls on square q: 0 unless it is free and a lane lies beside it."""
    if kind[q] != 0:
        return 0
    up, down = kind[q - stride] == 1, kind[q + stride] == 1
    left, right = kind[q - 1] == 1, kind[q + 1] == 1
    along_x = capacity[q, 1] if up and down else (capacity[q, 0] if up or down else 0)
    along_z = capacity[q, 3] if left and right else (capacity[q, 2] if left or right else 0)
    return max(along_x, along_z)


@nb.njit(cache=True)
def value_of(kind, capacity, stride, entrances, squares, weights, distance, queue):
    """Y' of a matrix whose lanes are connected and touch every portal; (value, N_S, T_S, U_S)."""
    for q in squares:
        distance[q] = -1
    head, tail = 0, 0
    steps = (-stride, stride, -1, 1)
    for e in entrances:
        for step in steps:
            q = e + step
            if kind[q] == 1 and distance[q] < 0:
                distance[q] = 1
                queue[tail] = q
                tail += 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in steps:
            p = q + step
            if kind[p] == 1 and distance[p] < 0:
                distance[p] = distance[q] + 1
                queue[tail] = p
                tail += 1
    stalls, time, unused = 0, 0, 0
    for q in squares:
        if kind[q] != 0:
            continue
        count = capacity_of(q, kind, capacity, stride)
        if count == 0:
            unused += 1
            continue
        nearest = 1 << 30
        for step in steps:
            if kind[q + step] == 1:
                if distance[q + step] < 0:
                    return NO_VALUE, 0, 0.0, 0
                nearest = min(nearest, distance[q + step])
        stalls += count
        time += count * (1 + nearest)
    if stalls == 0:
        return NO_VALUE, 0, 0.0, unused
    mean = time / stalls
    return weights[0] * stalls + weights[1] * mean + weights[2] * unused, stalls, mean, unused


@nb.njit(cache=True, inline="always")
def untouched_portal(kind, portals, stride):
    """Index of the first portal beside no lane, or -1."""
    for index in range(len(portals)):
        q = portals[index]
        if kind[q - stride] != 1 and kind[q + stride] != 1 and kind[q - 1] != 1 and kind[q + 1] != 1:
            return index
    return -1


@nb.njit(cache=True)
def connect_portals(kind, portals, stride, squares, distance, queue):
    """Join every untouched portal to the lanes by a shortest path over free squares; False if there is none."""
    steps = (-stride, stride, -1, 1)
    while True:
        index = untouched_portal(kind, portals, stride)
        if index < 0:
            return True
        target = portals[index]
        tail = 0
        for q in squares:
            distance[q] = -1
        for q in squares:
            if kind[q] == 1:
                distance[q] = 0
                queue[tail] = q
                tail += 1
        head, found = 0, -1
        while head < tail and found < 0:
            q = queue[head]
            head += 1
            for step in steps:
                p = q + step
                if p == target:
                    found = q
                    break
                if kind[p] == 0 and distance[p] < 0:
                    distance[p] = distance[q] + 1
                    queue[tail] = p
                    tail += 1
        if found < 0:
            return False
        while kind[found] != 1:
            kind[found] = 1
            for step in steps:
                if kind[found + step] >= 0 and distance[found + step] == distance[found] - 1:
                    found += step
                    break


@nb.njit(cache=True)
def lanes_connected(kind, squares, stride, distance, queue):
    """Whether the lanes form one 4-connected piece."""
    total, first = 0, np.int64(-1)
    for q in squares:
        distance[q] = 0
        if kind[q] == 1:
            total += 1
            first = q
    if total == 0:
        return False
    queue[0] = first
    distance[first] = 1
    head, tail = 0, 1
    while head < tail:
        q = queue[head]
        head += 1
        for step in (-stride, stride, -1, 1):
            p = q + step
            if kind[p] == 1 and distance[p] == 0:
                distance[p] = 1
                queue[tail] = p
                tail += 1
    return tail == total
