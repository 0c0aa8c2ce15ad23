"""Floor of a garage in square metres, of which each stall has its share."""

import math
from typing import NamedTuple

__all__ = ["FloorArea"]


class FloorArea(NamedTuple):
    """Floor of a level or of a garage.

    Attributes
    ----------
    net_m2
        Floor inside the outline, without ramps between levels and other obstacles.
    gross_m2
        Ground inside the outline, ramps and obstacles included.
    """

    net_m2: float
    gross_m2: float

    def per_stall(self, stalls: int) -> "FloorArea":
        """Return the shares of each of some stalls; infinite without any."""
        return FloorArea(*(area / stalls if stalls else math.inf for area in self))

    def in_words(self) -> str:
        """Tell both of a stall: ``27.4 m2 a stall net, 31.0 gross``."""
        return f"{self.net_m2:.1f} m2 a stall net, {self.gross_m2:.1f} gross"
