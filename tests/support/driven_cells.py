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
    rows, columns = np.nonzero(read.cells == OCCUPIED)
    x, y = read.middles()
    half = read.side / 2 - 1e-9
    middles = np.column_stack([x[columns], y[rows]])
    squares = shapely.box(*(middles - half).T, *(middles + half).T)
    tree = shapely.STRtree(squares)
    found = []
    for stall, proof in zip(garage.stalls, proofs, strict=True):
        pieces = garage.standing.only(*stall.own).pieces * (1, -1)
        own = shapely.MultiPolygon([shapely.Polygon(piece) for piece in pieces])
        for way in filter(None, (proof.way_in, proof.way_out)):
            corners = np.array([car.corners(waypoint.pose) for waypoint in way.waypoints(STEP_M)])
            grounds = shapely.polygons(corners * (1, -1))
            hit = np.unique(tree.query(grounds, predicate="intersects")[1])
            found += [middles[index] for index in hit if squares[index].distance(own) > read.side]
    return np.array(found)
