"""The local coordinates of the well of the ramps between levels."""

from dataclasses import dataclass

from garage2usd.layout.placement import Placement, edge_yaw_rad, placed, rounded, to_world
from garage2usd.objects.kind import Spec
from garage2usd.objects.outline import Point
from garage2usd.structure.building import Flight
from garage2usd.structure.grid import Structure
from garage2usd.structure.stalls import Edge

__all__ = ["WellFrame"]


@dataclass(frozen=True)
class WellFrame:
    """The local coordinates of a well in the garage.

    Attributes
    ----------
    way
        The way down.
    origin_m
        (x, z) of the middle of the border at the feet.
    run_m, half_m
        Length of the ramps' squares, and half their width together.
    """

    way: Edge
    origin_m: Point
    run_m: float
    half_m: float

    @classmethod
    def of(cls, flight: Flight, structure: Structure) -> "WellFrame":
        """Return the frame of a flight."""
        rows, cols = zip(*flight.squares, strict=True)
        x, z = structure.column_edges_m, structure.row_edges_m
        left, right = float(x[min(cols)]), float(x[max(cols) + 1])
        top, bottom = float(z[min(rows)]), float(z[max(rows) + 1])
        run = round(flight.run_m(structure), 6)
        half = sum(flight.side_m(structure, link.head) for link in flight.links) / 2
        middle = (left + right) / 2, (top + bottom) / 2
        return cls(flight.way, to_world((0.0, run / 2), middle, edge_yaw_rad(flight.way)), run, half)

    def to_world(self, point: Point) -> Point:
        """Return the (x, z) in the garage of a local point, to the micrometre."""
        return rounded(to_world(point, self.origin_m, edge_yaw_rad(self.way)))

    def placed(
        self, name: str, spec: Spec, point: Point, *, faces: Edge | None = None, height_m: float = 0.0
    ) -> Placement:
        """Place an object at a local point, turned so that its +Z looks down the ramps or over an edge of a square."""
        yaw = edge_yaw_rad(self.way if faces is None else faces)
        return placed(name, spec, self.to_world(point), height_m=height_m, yaw_rad=yaw)
