"""Rules of circulation: deep dead ends, loops, stretches without a junction, and lanes side by side."""

from collections.abc import Iterator, Sequence
from itertools import combinations

import networkx as nx

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_structure_is_known
from garage2usd.garage import LaneNode, Point
from garage2usd.profiles import Profile

BOOK = RuleBook()
_BLOCK = 4


@BOOK.rule(
    "dead-end-depth",
    "dead_end_depth",
    asks="no dead end with its branches is too deep",
    hindrance=where_structure_is_known,
)
def _depth(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.dead_end_depth is None or level.circulation is None:
        return
    required = profile.dead_end_depth.amount
    for run in level.circulation.dead_ends:
        if run.length_m > required + ROUNDING_M:
            message = f"the dead end of {_lanes(len(run.lanes))} is too deep"
            yield Miss(run.lanes[0], _place(level, run.lanes[0]), message, run.length_m, required)


@BOOK.rule(
    "loop", "loops", asks="the lanes of a garage with many stalls form a loop", hindrance=where_structure_is_known
)
def _loops(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.loops is None or level.circulation is None:
        return
    stalls = len(level.parking_stalls)
    required, measured = profile.loops.required(stalls), level.circulation.loops
    if measured < required:
        message = f"who finds none of the {stalls} stalls free cannot drive round again"
        yield Miss("", None, message, measured, required)


@BOOK.rule(
    "stretch-length",
    "stretch_length",
    asks="no stretch of lanes between two junctions is too long",
    hindrance=where_structure_is_known,
)
def _stretches(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.stretch_length is None or level.circulation is None:
        return
    required = profile.stretch_length.amount
    for run in level.circulation.stretches:
        if run.length_m > required + ROUNDING_M:
            message = f"a stretch of {_lanes(len(run.lanes))} has no junction"
            yield Miss(run.lanes[0], _place(level, run.lanes[0]), message, run.length_m, required)


@BOOK.rule("lane-field", "lane_field_width", asks="lanes do not lie side by side", hindrance=where_structure_is_known)
def _fields(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.lane_field_width is None or level.circulation is None:
        return
    required = profile.lane_field_width.amount
    nodes = {node.name: node for node in level.lanes.nodes}
    for field in _joined(level.circulation.blocks):
        measured = max(_clear_m(block, nodes) for block in field)
        if measured > required + ROUNDING_M:
            message = f"lanes lie side by side, {len(field)} times four of them in a block"
            yield Miss(field[0][0], _place(level, field[0][0]), message, measured, required)


def _clear_m(block: Sequence[str], nodes: dict[str, LaneNode]) -> float:
    """Return the width between columns across the narrower side of 2 x 2 lanes; 0 where a lane is missing."""
    known = [nodes[name] for name in block if name in nodes]
    if len(known) < _BLOCK:
        return 0.0
    first, last = known[0], known[-1]
    return min(
        abs(last.position[axis] - first.position[axis]) + (first.widths_m[axis] + last.widths_m[axis]) / 2
        for axis in (0, 1)
    )


def _joined(blocks: Sequence[tuple[str, ...]]) -> list[list[tuple[str, ...]]]:
    """Group blocks of lanes that share a lane into fields; blocks and fields keep their order."""
    blocks_on: dict[str, list[int]] = {}
    for number, block in enumerate(blocks):
        for lane in block:
            blocks_on.setdefault(lane, []).append(number)
    sharing: nx.Graph[int] = nx.Graph(pair for numbers in blocks_on.values() for pair in combinations(numbers, 2))
    sharing.add_nodes_from(range(len(blocks)))
    fields = sorted(map(sorted, nx.connected_components(sharing)))
    return [[blocks[number] for number in field] for field in fields]


def _place(level: BuiltLevel, name: str) -> Point | None:
    """Return the middle of a lane in the lane graph by its name, to the millimetre."""
    x_z = next((node.position for node in level.lanes.nodes if node.name == name), None)
    return None if x_z is None else (round(x_z[0], 3), round(x_z[1], 3))


def _lanes(count: int) -> str:
    return "one lane square" if count == 1 else f"{count} lane squares"
