"""The stalls of a layout as those of the neutral garage."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

from garage2usd.config import BayConfig
from garage2usd.config.stalls import SizeClass
from garage2usd.garage import LaneGraph, Stall
from garage2usd.layout.parking.stalls import stalls_of
from garage2usd.layout.placement import PlacedStall
from garage2usd.layout.tiles import TileGrid
from garage2usd.structure.lane_graph import LaneSquares

__all__ = ["garage_stalls", "planned_stalls", "stall_quads"]


def garage_stalls(
    stalls: Sequence[PlacedStall],
    lanes: LaneSquares,
    blocked: Mapping[str, str] | None = None,
    occupied: Iterable[bool] | None = None,
) -> Iterator[Stall]:
    """Return each stall as a quad that opens onto a lane node.

    Parameters
    ----------
    stalls
        Those of the layout.
    lanes
        The lane squares that they open onto.
    blocked
        For the name of a blocked stall, that of the stall of the misparked car that blocks it.
    occupied
        True for each stall with a car; None if unknown. The facts are those of a stage's stalls.
    """
    access = [lanes.number_of[stall.access_square] for stall in stalls]
    return stall_quads(stalls, access, lanes.lanes, blocked, occupied)


def stall_quads(
    stalls: Sequence[PlacedStall],
    access: Iterable[int],
    lanes: LaneGraph,
    blocked: Mapping[str, str] | None = None,
    occupied: Iterable[bool] | None = None,
) -> Iterator[Stall]:
    """Yield each stall as a quad that opens onto a given lane node; parameters as for `garage_stalls`."""
    told = [()] * len(stalls) if occupied is None else [(("occupied", int(is_taken)),) for is_taken in occupied]
    for stall, node, occupancy in zip(stalls, access, told, strict=True):
        left, right, rear_right, rear_left = stall.corners_m()
        by = (blocked or {}).get(stall.name)
        facts: tuple[tuple[str, str | int], ...] = (
            *([("number", stall.number)] if stall.number else []),
            ("type", stall.stall_type.value),
            *([("size", stall.size)] if stall.size != SizeClass.STANDARD else []),
            ("row", stall.square[0]),
            ("column", stall.square[1]),
            ("entryEdge", stall.edge.name.lower()),
            *([("blocked_by", by)] if by else []),
            *occupancy,
        )
        corners = (left, right, rear_right, rear_left)
        yield Stall(stall.name, corners, stall.use, node, facts, lanes.nodes[node].level)


def planned_stalls(lanes: LaneSquares, bay: BayConfig) -> tuple[Stall, ...]:
    """Return the stalls of a plan that cannot be laid out."""
    return tuple(garage_stalls(stalls_of(TileGrid(lanes.structure, lanes, bay), lanes), lanes))
