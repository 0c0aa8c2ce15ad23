"""The stalls of a layout as those of the neutral garage."""

from collections.abc import Iterable, Iterator, Mapping

from garage2usd.garage import Stall
from garage2usd.layout.placement import PlacedStall, cos_sin
from garage2usd.structure.lane_graph import LaneSquares

__all__ = ["clear_aisle_m", "garage_stalls"]


def garage_stalls(
    stalls: Iterable[PlacedStall], lanes: LaneSquares, blocked: Mapping[str, str] | None = None
) -> Iterator[Stall]:
    """Yield each stall as a quad that opens onto a lane node.

    Parameters
    ----------
    stalls
        Those of the layout.
    lanes
        The lane squares that they open onto.
    blocked
        For the name of a blocked stall, that of the stall of the misparked car that blocks it.
    """
    for stall in stalls:
        left, right, rear_right, rear_left = stall.corners_m()
        said = {"number": stall.number, "size": stall.size, "blocked_by": (blocked or {}).get(stall.name, "")}
        facts = tuple((fact, value) for fact, value in said.items() if value)
        corners = (left, right, rear_right, rear_left)
        yield Stall(stall.name, corners, stall.use, lanes.number_of[stall.access_square], facts)


def clear_aisle_m(stall: PlacedStall, lanes: LaneSquares) -> float:
    """Metres between the columns on both sides of the aisle that a stall opens onto."""
    cos, sin = cos_sin(stall.yaw_rad)
    return lanes.lanes.clear_aisle_m(lanes.number_of[stall.access_square], (sin, cos))
