"""Cars that drive at once, each in its own scene: motion, contact, LiDAR and occupancy; in C, `parking.c`."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.driving.obstacles import Floats
from garage2usd.environment.task import STEP_S, TICKS, ParkingTask
from garage2usd.native import Bools, Float64Cube, Float64s, Float64Table, Int8s, Int64s, in_c

RAYS, RANGE_M = 64, 20.0
"""Number of rays of the LiDAR, and its range in metres."""
CELLS, CELL_M = 64, 0.3125
"""Cells along a side of the occupancy grid, and the side of a cell in metres."""
FASTEST_M_S = 3.0


class Lot(NamedTuple):
    """Cars and their scenes.

    Attributes
    ----------
    poses
        x, z and yaw of the rear axle, and speed; shape (n, 4).
    bodies
        Distances from the rear axle to nose and tail, and half the width; shape (n, 3).
    pieces, boxes, counts
        Corners of convex pieces, shape (n, most, 8), their bounds, shape (n, most, 4), and how many there are.
    goals
        Corners of the car on its goal; shape (n, 8).
    moving, sizes
        x, z and yaw of agents at each tick, shape (n, ticks, 3 * agents), and their lengths and widths,
        shape (n, 2 * agents).
    ticks
        Number of ticks since the start; shape (n,).
    """

    poses: Float64Table
    bodies: Float64Table
    pieces: Float64Cube
    boxes: Float64Cube
    counts: Int64s
    goals: Float64Table
    moving: Float64Cube
    sizes: Float64Table
    ticks: Int64s


@in_c
def _mark_touching(lot: Lot, is_crashed: Bools) -> None:
    raise NotImplementedError


@in_c
def _drive_cars(
    lot: Lot, orders: Float64s, is_driven: Bools, tick_s: float, ticks: int, most: float, is_crashed: Bools
) -> None:
    raise NotImplementedError


@in_c
def _scan_around(lot: Lot, rays: int, reach: float, ranges: Float64s) -> None:
    raise NotImplementedError


@in_c
def _fill_around(lot: Lot, side: int, cell: float, cells: Int8s) -> None:
    raise NotImplementedError


class Simulation:
    """Simulation of some cars.

    Parameters
    ----------
    count
        Number of cars.

    Attributes
    ----------
    lot
        The cars and their scenes.
    """

    def __init__(self, count: int) -> None:
        def zeros(*shape: int) -> Floats:
            return np.zeros((count, *shape))

        counts, ticks = np.zeros((2, count), np.int64)
        self.lot = Lot(zeros(4), zeros(3), zeros(0, 8), zeros(0, 4), counts, zeros(8), zeros(1, 0), zeros(0), ticks)

    def place(self, number: int, task: ParkingTask) -> None:
        """Put a car at the start of a task, at a standstill."""
        lot, car, start, (middle, half_m) = self.lot, task.car, task.start, task.arena
        near = task.obstacles.near(middle, half_m + RANGE_M)
        agents = len(task.sizes_m)
        self.lot = lot = lot._replace(
            pieces=_grown(lot.pieces, (len(near.pieces), 8)),
            boxes=_grown(lot.boxes, (len(near.pieces), 4)),
            moving=_grown(lot.moving, (len(task.moving), 3 * agents)),
            sizes=_grown(lot.sizes, (2 * agents,)),
        )
        lot.poses[number] = start.x_m, start.z_m, start.yaw_rad, 0.0
        lot.bodies[number] = near.met_by(car).body
        lot.pieces[number, : len(near.pieces)] = near.pieces.reshape(-1, 8)
        lot.boxes[number, : len(near.pieces)] = near.boxes
        lot.counts[number], lot.ticks[number] = len(near.pieces), 0
        lot.goals[number] = np.ravel(car.corners(task.goal))
        lot.moving[number] = np.nan
        lot.moving[number, : len(task.moving), : 3 * agents] = task.moving.reshape(len(task.moving), -1)
        lot.sizes[number, : 2 * agents] = task.sizes_m.ravel()

    def drive(self, orders: Floats, is_driven: NDArray[np.bool_]) -> NDArray[np.bool_]:
        """Drive some cars for a step.

        Parameters
        ----------
        orders
            Acceleration and curvature of each car, constant for the step; shape (n, 2).
        is_driven
            True for cars that drive; others stay as they are; shape (n,).

        Returns
        -------
        ndarray
            True for cars that touch something; they stay where they do; shape (n,).
        """
        is_crashed = np.zeros(len(is_driven), np.bool_)
        _drive_cars(self.lot, orders, is_driven, STEP_S / TICKS, TICKS, FASTEST_M_S, is_crashed)
        return is_crashed

    def touching(self) -> NDArray[np.bool_]:
        """Return True for each car whose outline touches a piece or an agent where it is; shape (n,)."""
        is_crashed = np.zeros(len(self.lot.poses), np.bool_)
        _mark_touching(self.lot, is_crashed)
        return is_crashed

    def ranges_m(self, rays: int = RAYS, reach_m: float = RANGE_M) -> Floats:
        """Return the distance from each car's middle to the nearest edge along rays, at most `reach_m`.

        The first ray points ahead, the others follow counterclockwise at equal angles; shape (n, rays).
        """
        ranges = np.zeros((len(self.lot.poses), rays))
        _scan_around(self.lot, rays, reach_m, ranges)
        return ranges

    def occupancy(self, cells: int = CELLS, cell_m: float = CELL_M) -> NDArray[np.uint8]:
        """Return square grids around each car's middle, its nose up: 255 in each cell that meets an obstacle or agent.

        Returns
        -------
        ndarray
            Of obstacles, and of the car on its goal; shape (n, 2, cells, cells).
        """
        grid = np.zeros((len(self.lot.poses), 2, cells, cells), np.int8)
        _fill_around(self.lot, cells, cell_m, grid)
        return grid.view(np.uint8)


def _grown(array: Floats, shape: tuple[int, ...]) -> Floats:
    """Return an array whose axes after the first have at least some lengths, padded by NaN."""
    beyond = [(0, 0), *((0, max(0, least - own)) for least, own in zip(shape, array.shape[1:], strict=True))]
    return np.pad(array, beyond, constant_values=np.nan) if np.any(beyond) else array
