"""The edge of each portal's square that has its vehicle door."""

import numpy as np

from garage2usd.structure.border import bordered
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, CellArray, outside_squares
from garage2usd.structure.stalls import Edge

__all__ = ["door_edges"]


def door_edges(cells: CellArray) -> dict[tuple[int, int], Edge]:
    """Return the edge with the door of each portal (row, col) that has an edge on the outside.

    Of several such edges, the one opposite a lane is used, so that cars drive straight in; else the first.
    """
    outside = bordered(outside_squares(cells), value=True)
    lane = bordered(cells == Cell.LANE)

    def beyond(row: int, col: int, edge: Edge) -> tuple[int, int]:
        dr, dc = NEIGHBOUR_STEPS[edge]
        return row + 1 + dr, col + 1 + dc

    doors = {}
    for row, col in np.argwhere(cells >= Cell.ENTRANCE).tolist():
        outer = [edge for edge in Edge if outside[beyond(row, col, edge)]]
        opposite = [edge for edge in outer if lane[beyond(row, col, edge.opposite)]]
        if outer:
            doors[row, col] = (opposite or outer)[0]
    return doors
