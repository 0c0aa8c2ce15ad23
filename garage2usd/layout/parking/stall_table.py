"""Column table of all stalls of a garage."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from garage2usd.config.stalls import SizeClass
from garage2usd.layout.placement import PlacedStall, StallUse, stall_name
from garage2usd.layout.table import Table
from garage2usd.structure.grid import NEIGHBOUR_STEPS
from garage2usd.structure.lane_graph import StallType
from garage2usd.structure.stalls import Edge

__all__ = ["STALL_USES", "StallTable"]

EDGES, STALL_TYPES, STALL_USES = tuple(Edge), tuple(StallType), tuple(StallUse)
STALL_SIZES = tuple(size.value for size in SizeClass)
"""Size classes in the order of their numbers in the table."""
_TYPE_NUMBERS = {stall_type: number for number, stall_type in enumerate(STALL_TYPES)}
_SIZE_NUMBERS = {size: number for number, size in enumerate(STALL_SIZES)}
_USE_NUMBERS = {use: number for number, use in enumerate(STALL_USES)}


class StallTable(Table[PlacedStall]):
    """The stalls of a garage as a sequence, stored as one array per column.

    Attributes
    ----------
    square
        (row, col) of each stall's square; int32, shape (n, 2).
    ordinal
        Number of each stall on its square, from 1; uint16, shape (n,).
    edge, stall_type, use
        Index of each in `EDGES`, `STALL_TYPES` and `STALL_USES`; uint8, shape (n,).
    centre_m, size_m
        (x, z) of the centre, and width and length; float64, shape (n, 2).
    yaw_rad
        Rotation of each stall about +Y; float64, shape (n,).
    angle_deg
        Angle of each stall's long sides to its lane; float64, shape (n,).
    turn
        1 for a stall entered by a right turn, else -1; int8, shape (n,).
    size
        Index of the size class in `STALL_SIZES`; uint8, shape (n,).
    number
        Painted number as text; shape (n,).
    """

    def __init__(self, stalls: Iterable[PlacedStall]) -> None:
        stalls = tuple(stalls)
        self.square = np.array([stall.square for stall in stalls], dtype=np.int32).reshape(-1, 2)
        self.ordinal = np.array([stall.ordinal for stall in stalls], dtype=np.uint16)
        self.edge = np.array([stall.edge for stall in stalls], dtype=np.uint8)
        self.stall_type = np.array([_TYPE_NUMBERS[stall.stall_type] for stall in stalls], dtype=np.uint8)
        self.use = np.array([_USE_NUMBERS[stall.use] for stall in stalls], dtype=np.uint8)
        self.centre_m = np.array([stall.centre_m for stall in stalls], dtype=np.float64).reshape(-1, 2)
        self.size_m = np.array([(stall.width_m, stall.length_m) for stall in stalls]).reshape(-1, 2)
        self.yaw_rad = np.array([stall.yaw_rad for stall in stalls], dtype=np.float64)
        self.angle_deg = np.array([stall.angle_deg for stall in stalls], dtype=np.float64)
        self.turn = np.array([stall.turn for stall in stalls], dtype=np.int8)
        self.size = np.array([_SIZE_NUMBERS[stall.size] for stall in stalls], dtype=np.uint8)
        self.number = np.array([stall.number for stall in stalls], dtype=np.str_)

    def __len__(self) -> int:
        """Number of stalls."""
        return len(self.edge)

    @property
    def takes_cars(self) -> NDArray[np.bool_]:
        """True if cars park in each stall; bool, shape (n,)."""
        return np.array([use.takes_cars for use in STALL_USES])[self.use]

    @property
    def access_square(self) -> NDArray[np.int32]:
        """(row, col) of the lane square at each stall's entry; int32, shape (n, 2)."""
        beyond: NDArray[np.int32] = self.square + np.array(NEIGHBOUR_STEPS, dtype=np.int32)[self.edge]
        return beyond

    def names(self) -> list[str]:
        """Ids of all stalls."""
        rows, cols = self.square.T.tolist()
        return list(map(stall_name, zip(rows, cols, strict=True), self.ordinal.tolist()))

    def at(self, rows: NDArray[np.intp]) -> list[PlacedStall]:
        """Return the stalls at some rows of the table."""
        columns = (
            self.square,
            self.ordinal,
            self.edge,
            self.stall_type,
            self.centre_m,
            self.size_m,
            self.yaw_rad,
            self.use,
            self.number,
            self.angle_deg,
            self.turn,
            self.size,
        )
        return [
            PlacedStall(
                square=(row, col),
                ordinal=ordinal,
                edge=EDGES[edge],
                stall_type=STALL_TYPES[stall_type],
                centre_m=(x, z),
                width_m=width,
                length_m=length,
                yaw_rad=yaw,
                use=STALL_USES[use],
                number=str(number),
                angle_deg=angle_deg,
                turn=turn,
                size=STALL_SIZES[size],
            )
            for (
                (row, col),
                ordinal,
                edge,
                stall_type,
                (x, z),
                (width, length),
                yaw,
                use,
                number,
                angle_deg,
                turn,
                size,
            ) in zip(*(column[rows].tolist() for column in columns), strict=True)
        ]
