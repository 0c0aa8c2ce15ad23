"""How much of a drive a car is on its own half of the aisles; computed from outlines and the lanes alone."""

import math
from itertools import chain, pairwise
from typing import NamedTuple

import numpy as np
import shapely

from garage2usd.driving.path import Path
from support.driving_simulation import outlines

STEP_M = 0.25
LEAST_AISLE_M = 5.5
CAR_M = 4.8
BESIDE_PARKING_M = 8.0
SAME_M = 0.01
_TURNS_RAD, _ALONG = math.radians(45.0), math.cos(math.radians(30.0))


class Share(NamedTuple):
    """Metres driven on two-way aisles outside of turning, those with the whole car on its own half, and all metres.

    `strays` has (level, x, z) of each place where it was not.
    """

    judged_m: float
    own_m: float
    driven_m: float
    strays: list[tuple[int, float, float]]

    @property
    def share(self):
        return self.own_m / self.judged_m


def parts_with_paths(planned):
    """Each part of a route with its path, apart by arrival and departure."""
    for whole, parts in ((planned.route.arrival, planned.arrival), (planned.route.departure, planned.departure)):
        leg, start = [], whole.start
        for part in parts:
            leg.append((part, Path(start, part.pieces)))
            start = leg[-1][1].end
        yield leg


def grounds(lanes):
    """The ground of each junction, bend and portal, where no lane has a middle to keep to."""
    found = {}
    for number, node in enumerate(lanes.nodes):
        (x, z), (wide, deep) = node.position, node.sides_m or node.widths_m
        ways = [np.subtract(lanes.nodes[other].position, node.position) for other in lanes.beside[number]]
        ways = [way / np.linalg.norm(way) for way in ways]
        if node.is_portal or any(abs(one @ other) < 0.99 for one, other in pairwise([*ways, *ways[:1]])):
            found[number] = shapely.box(x - wide / 2, z - deep / 2, x + wide / 2, z + deep / 2)
    return found


def aisles(lanes, least_m=LEAST_AISLE_M):
    """Ends, direction and width of each two-way aisle that is wide enough."""
    for edge in lanes.edges:
        one, other = (np.array(lanes.nodes[end].position) for end in (edge.start, edge.end))
        length_m = float(np.linalg.norm(other - one))
        if not edge.one_way and edge.width_m >= least_m and length_m > 0:
            yield one, (other - one) / length_m, length_m, edge.width_m


def shares(planned, garage, *, keeps_left):
    """Judge a route on its aisles.

    A car turns within its length of the ground of a junction, bend or portal where its heading changes by more than 45
    degrees, and within 8 m of its manoeuvre. That ground itself has no middle. All else on two-way aisles of at least
    5.5 m counts.
    """
    judged = own = driven = 0
    strays = []
    for leg in parts_with_paths(planned):
        for part, path in leg:
            driven += path.length_m
            if part.is_ramp or not path.pieces:
                continue
            lanes = garage.levels[part.level].lanes
            arcs = np.arange(0.0, path.length_m, STEP_M)
            at = path.at(arcs)
            poses = np.stack([at.x_m, at.z_m, at.yaw_rad], axis=1)
            bodies = outlines(poses)
            middles = shapely.get_coordinates(shapely.centroid(bodies))
            points = shapely.points(middles)
            counts = np.ones(len(arcs), bool)
            ends = np.cumsum([0.0, *(piece.length_m for piece in path.pieces)])
            parked = [number for number, piece in enumerate(path.pieces) if piece.is_parking]
            if parked:
                low, high = ends[parked[0]] - BESIDE_PARKING_M, ends[parked[-1] + 1] + BESIDE_PARKING_M
                counts &= (arcs < low) | (arcs > high)
            for ground in grounds(lanes).values():
                near_m = shapely.distance(points, ground)
                inside = near_m < 0.5
                counts &= near_m > 0
                for first, last in runs(inside):
                    low, high = first, last
                    while low > 0 and near_m[low - 1] <= CAR_M:
                        low -= 1
                    while high < len(arcs) - 1 and near_m[high + 1] <= CAR_M:
                        high += 1
                    if np.ptp(at.yaw_rad[low : high + 1]) > _TURNS_RAD:
                        counts[low : high + 1] = False
            heading = np.stack([-np.sin(at.yaw_rad), -np.cos(at.yaw_rad)], axis=1)
            corners = np.array([shapely.get_coordinates(body)[:4] for body in bodies])
            on = np.zeros(len(arcs), bool)
            kept = np.zeros(len(arcs), bool)
            for start, along, length_m, width_m in aisles(lanes):
                run = (middles - start) @ along
                aside = (middles - start) @ (-along[1], along[0])
                cos = heading @ along
                here = (run >= 0) & (run <= length_m) & (np.abs(aside) <= width_m / 2) & (np.abs(cos) > _ALONG)
                right = (corners - start) @ (-along[1], along[0]) * np.sign(cos)[:, None]
                least = (-right if keeps_left else right).min(axis=1)
                on |= here
                kept |= here & (least >= -SAME_M)
            counts &= on
            judged += np.count_nonzero(counts) * STEP_M
            own += np.count_nonzero(counts & kept) * STEP_M
            strays += [(part.level, *middles[number]) for number in np.flatnonzero(counts & ~kept)]
    return Share(judged, own, driven, strays)


def runs(inside):
    """First and last number of each run of true values."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]])))
    return [(first, last - 1) for first, last in zip(edges[::2], edges[1::2], strict=True)]


def total(found):
    """The share over several drives."""
    found = list(found)
    sums = (sum(each[number] for each in found) for number in range(3))
    return Share(*sums, list(chain.from_iterable(each.strays for each in found)))
