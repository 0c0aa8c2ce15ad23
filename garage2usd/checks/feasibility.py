"""Rules of feasibility and consistency: each stall has a route, and the file's lanes and stalls agree."""

import math
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence

from garage2usd.as_built.level import BuiltLevel
from garage2usd.checks.rule import Miss, RuleBook
from garage2usd.garage import LaneNode, Point, Stall
from garage2usd.profiles import Profile, Severity

BOOK = RuleBook()
_BESIDE_M = 0.75
"""Greatest distance in metres from a stall's mouth to the carriageway of its lane: half a column and a line."""


@BOOK.rule("entrance-missing", asks="there is an entrance")
def _entrance(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    if level.lanes.nodes and not level.lanes.portals("entrance"):
        yield Miss("", None, "no car can get in: there is no entrance")


@BOOK.rule("exit-missing", asks="there is an exit")
def _exit(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    if level.lanes.nodes and not level.lanes.portals("exit"):
        yield Miss("", None, "no car can get out: there is no exit")


@BOOK.rule("portal-cut-off", asks="every portal joins a lane")
def _cut_off(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for number in level.lanes.portals("entrance", "exit"):
        if level.has_whole_graph and not level.lanes.beside[number]:
            node = level.lanes.nodes[number]
            yield Miss(node.name, node.position, f"the {node.kind} joins no lane")


@BOOK.rule("stall-detached", asks="a stall's mouth opens onto the lane that serves it", in_surveys=Severity.INFO)
def _detached(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    for stall in level.stalls:
        node = level.lanes.nodes[stall.access]
        if node.is_portal:
            yield Miss(stall.name, stall.mouth, f"the stall opens onto the {node.kind} {node.name}")
        elif not _lies_at(stall.mouth, node) and not _lies_ahead_of_tip(stall.mouth, stall.access, level):
            yield Miss(stall.name, stall.mouth, f"the stall's mouth does not lie at its lane {node.name}")


def _lies_at(mouth: Point, node: LaneNode) -> bool:
    """Return True if a mouth lies on the ground of a lane node or beside it."""
    return all(
        abs(place - middle) <= width / 2 + _BESIDE_M
        for place, middle, width in zip(mouth, node.position, node.widths_m, strict=True)
    )


def _lies_ahead_of_tip(mouth: Point, access: int, level: BuiltLevel) -> bool:
    """Return True if a mouth lies straight on beyond the dead end of a lane, no farther than the lane is wide."""
    beside = level.lanes.beside[access]
    if len(beside) != 1:
        return False
    node, before = level.lanes.nodes[access], level.lanes.nodes[beside[0]]
    length_m = math.dist(node.position, before.position)
    ahead = [(tip - start) / length_m for tip, start in zip(node.position, before.position, strict=True)]
    away = [place - tip for place, tip in zip(mouth, node.position, strict=True)]
    along_m, aside_m = away[0] * ahead[0] + away[1] * ahead[1], away[0] * ahead[1] - away[1] * ahead[0]
    half_m = max(node.widths_m) / 2 + _BESIDE_M
    return 0.0 <= along_m <= max(node.widths_m) and abs(aside_m) <= half_m


@BOOK.rule("stall-route", asks="each stall has a route from an entrance and to an exit that keeps to lanes")
def _routes(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    entrances, exits = level.lanes.joined_portals("entrance"), level.lanes.joined_portals("exit")
    if not entrances or not exits or not level.has_whole_graph:
        return  # other rules report that
    reached = _reached(entrances, level.lanes.onward, level)
    left = _reached(exits, level.lanes.backward, level)
    for stall in level.stalls:
        missing = [
            words for nodes, words in ((reached, "from an entrance"), (left, "to an exit")) if stall.access not in nodes
        ]
        if missing:
            yield Miss(stall.name, stall.centre, f"no route leads {' or '.join(missing)}")


@BOOK.rule("portal-route", asks="each entrance leads to an exit, and each exit is reached from an entrance")
def _portal_routes(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
    entrances, exits = level.lanes.portals("entrance"), level.lanes.portals("exit")
    served = {stall.access for stall in level.stalls}
    for starts, goals, ways, words in (
        (entrances, exits, level.lanes.onward, "no exit is reached from the entrance"),
        (exits, entrances, level.lanes.backward, "no entrance leads to the exit"),
    ):
        for start in starts if goals and level.has_whole_graph else ():
            found = _reached([start], ways, level)
            # unreached stalls, and portals without a lane, are reported by other rules
            if found.isdisjoint(goals) and found.isdisjoint(served) and level.lanes.beside[start]:
                node = level.lanes.nodes[start]
                yield Miss(node.name, node.position, words)


def way_in(level: BuiltLevel, stall: Stall) -> list[int]:
    """Return the nodes of a shortest route from an entrance to a stall's lane; empty without one."""
    return _shortest(level.lanes.portals("entrance"), stall.access, level.lanes.onward, level)


def way_out(level: BuiltLevel, stall: Stall) -> list[int]:
    """Return the nodes of a shortest route from a stall's lane to an exit; empty without one."""
    return _shortest(level.lanes.portals("exit"), stall.access, level.lanes.backward, level)[::-1]


def _shortest(starts: Iterable[int], goal: int, ways: Sequence[Sequence[int]], level: BuiltLevel) -> list[int]:
    """Return the route with the fewest lane nodes from any start to a goal."""
    came_from = _search(starts, ways, level)
    if goal not in came_from:
        return []
    path = [goal]
    while came_from[path[-1]] != path[-1]:
        path.append(came_from[path[-1]])
    return path[::-1]


def _reached(starts: Iterable[int], ways: Sequence[Sequence[int]], level: BuiltLevel) -> set[int]:
    return set(_search(starts, ways, level))


def _search(starts: Iterable[int], ways: Sequence[Sequence[int]], level: BuiltLevel) -> dict[int, int]:
    """Search lane nodes breadth first; map each to its predecessor, and a start to itself. Routes end at portals."""
    came_from = {start: start for start in starts}
    queue = deque(came_from)
    first = set(came_from)
    while queue:
        node = queue.popleft()
        if level.lanes.nodes[node].is_portal and node not in first:
            continue
        for other in ways[node]:
            if other not in came_from:
                came_from[other] = node
                queue.append(other)
    return came_from


def _faults(name: str) -> Callable[[BuiltLevel, Profile], Iterator[Miss]]:
    def find(level: BuiltLevel, _: Profile) -> Iterator[Miss]:
        for fault in level.faults:
            if fault.rule == name:
                yield Miss(fault.place, fault.position, fault.message)

    return find


for _name, _asks in (
    ("lane-graph", "a stage has a lane graph whose nodes, edges and stalls fit together"),
    ("stall-outline", "a stall's prim lies where the lane graph has its outline"),
    ("plan-refused", "a garage can be built from a plan"),
    ("report-stalls", "a report lists the stalls that its configuration and matrices give"),
):
    BOOK.rule(_name, asks=_asks)(_faults(_name))
