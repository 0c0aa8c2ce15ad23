"""Which occupied cells of a map a proven path covers, apart from what belongs to the stall that is parked in."""

import numpy as np
import shapely

from support.map_reader import OCCUPIED

STEP_M = 0.05


def covered(read, garage, proofs, car):
    """Middles (x, y) of occupied cells that a car covers on its proven paths, less those of the stall's own things.

    Parameters
    ----------
    read
        The map.
    garage, proofs, car
        What was driven in, the proofs, and the car.
    """
    x, y = read.middles()
    half = read.side / 2 - 1e-9
    row, start, end = _runs(read.cells == OCCUPIED)
    runs = shapely.STRtree(shapely.box(x[start] - half, y[row] - half, x[end - 1] + half, y[row] + half))
    found = []
    for stall, proof in zip(garage.stalls, proofs, strict=True):
        belongings = garage.standing.only(*garage.own.get(stall.name, ()))
        own = shapely.union_all(shapely.polygons(belongings.pieces * (1, -1)))
        around = own.buffer(read.side)
        shapely.prepare(around)
        for way in filter(None, (proof.way_in, proof.way_out)):
            corners = _corners(way, car) * (1, -1)
            near = runs.query(shapely.box(*corners.min(axis=(0, 1)), *corners.max(axis=(0, 1))))
            # what lies around the stall's own things, as most does that is hit, holds no cell of others
            near = near[~shapely.covers(around, runs.geometries[near])]
            grounds = shapely.polygons(corners)
            hit = near[np.unique(shapely.STRtree(runs.geometries[near]).query(grounds, predicate="intersects")[1])]
            if not len(hit):
                continue
            middles = np.array([(x[column], y[row[run]]) for run in hit for column in range(start[run], end[run])])
            squares = shapely.box(*(middles - half).T, *(middles + half).T)
            is_own = shapely.distance(squares, own) <= read.side
            touched = shapely.STRtree(squares[~is_own]).query(grounds, predicate="intersects")[1]
            found += list(middles[~is_own][np.unique(touched)])
    return np.array(found)


def _corners(way, car):
    """Corners (x, z) of a car's footprint along a way, shape (poses, 4, 2)."""
    x, z, yaw = way.poses(STEP_M)[0].T[:, :, None]
    ahead = np.array([car.ahead_m, car.ahead_m, -car.rear_overhang_m, -car.rear_overhang_m])
    left = np.array([1, -1, -1, 1]) * car.width_m / 2
    sin, cos = np.sin(yaw), np.cos(yaw)
    return np.stack([x - sin * ahead - cos * left, z - cos * ahead + sin * left], axis=-1)


def _runs(cells):
    """Runs of cells along rows: the row, the first column and the one after the last of each."""
    changes = np.diff(cells.astype(np.int8), axis=1, prepend=0, append=0)
    (rows, starts), (_, ends) = np.nonzero(changes == 1), np.nonzero(changes == -1)
    return rows, starts, ends
