"""Source of a layout: a plan on squares, or the survey of an existing garage."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage import LaneGraph, Point
from garage2usd.layout.egress.exits import Egress
from garage2usd.layout.measures import FloorArea
from garage2usd.layout.placement import PlacedStall
from garage2usd.layout.shell.well import Well
from garage2usd.structure.grid import Structure, outside_squares
from garage2usd.structure.lane_graph import LaneSquares, Square

if TYPE_CHECKING:
    from garage2usd.layout import Layout


class FloorSource:
    """Source of a floor: a plan or a survey, and the names of its parts in files.

    Attributes
    ----------
    matrices
        S, R and C; None for a floor without squares.
    lanes
        The lane graph in metres.
    """

    matrices: Structure | None

    @property
    def lanes(self) -> LaneGraph:
        """The lane graph in metres."""
        raise NotImplementedError

    @property
    def landings(self) -> Mapping[Square, Point]:
        """Unit vector (x, z) towards the ramp from each landing of this level, by the (row, col) of its lane node."""
        return {}

    @property
    def again(self) -> "Callable[..., Layout]":
        """Lay out the same floor again, with settings and further arguments as for `garage2usd.layout.lay_out`."""
        raise NotImplementedError

    @property
    def area(self) -> FloorArea:
        """Area of the floor, and of all ground inside the outline."""
        raise NotImplementedError

    def access(self, stalls: Sequence[PlacedStall]) -> Sequence[int]:
        """Return the number of the lane node before the mouth of each stall."""
        raise NotImplementedError

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) that names each lane node in files; int32, shape (nodes, 2)."""
        raise NotImplementedError

    def kinds_of_squares(self) -> dict[str, int]:
        """Count the squares, or nodes, of each kind of lane and portal, and of each stall type."""
        raise NotImplementedError

    def label_of_square(self, row: int, col: int) -> str:
        """Return the semantic label of a tile: the kind of its lane, or the type of its stalls."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class PlannedFloor(FloorSource):
    """The floor of a plan.

    Attributes
    ----------
    matrices
        S, R and C.
    lane_squares
        The squares of its lanes.
    laid_out
        `garage2usd.layout.lay_out`.
    egress
        Its fire compartments and stair cores.
    well
        The ramps to other levels; None without any.
    """

    matrices: Structure
    lane_squares: LaneSquares
    laid_out: "Callable[..., Layout]"
    egress: Egress
    well: Well | None = None

    @property
    def lanes(self) -> LaneGraph:
        """The lane graph in metres."""
        return self.lane_squares.lanes

    @property
    def landings(self) -> Mapping[Square, Point]:
        """Unit vector (x, z) towards the ramp from each landing of this level, by (row, col)."""
        return self.well.landings if self.well else {}

    @property
    def again(self) -> "Callable[..., Layout]":
        """Lay out the same plan again."""
        return partial(self.laid_out, self.matrices, self.lane_squares, well=self.well, egress=self.egress)

    @property
    def area(self) -> FloorArea:
        """Area of the floor without obstacles, and with them."""
        ground = ~outside_squares(self.matrices.cells)
        for square in self.well.squares if self.well else ():
            ground[square] = True
        return FloorArea(self.matrices.floor_m2, self.matrices.area_m2(ground))

    def access(self, stalls: Sequence[PlacedStall]) -> list[int]:
        """Return the number of the lane node before the mouth of each stall."""
        return [self.lane_squares.number_of[stall.access_square] for stall in stalls]

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) of each lane node; int32, shape (nodes, 2)."""
        return np.array([*self.lane_squares.number_of], dtype=np.int32).reshape(-1, 2)

    def kinds_of_squares(self) -> dict[str, int]:
        """Count the squares of each kind of lane and portal, and of each stall type."""
        return self.lane_squares.kind_counts()

    def label_of_square(self, row: int, col: int) -> str:
        """Return the kind of a square's lane, or the type of its stalls."""
        return self.lane_squares.label_of((row, col))
