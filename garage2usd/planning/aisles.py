"""Sarsa over aisles: the agent sweeps the site and decides on whole aisles instead of squares; in C (`aisles.c`)."""

from itertools import pairwise, product
from typing import NamedTuple

import numpy as np

from garage2usd.config.plan import SarsaParameters
from garage2usd.native import Float64s, Int8s, Int64Cube, Int64s, UInt64s, in_c
from garage2usd.planning.board import Archive, Board, Ground

OPTIONS = 4
"""Skip the run, an aisle along all of it, one that stops a square short of its ends, one along its even part."""

_PROFILES, _SHARES, _AHEAD = 9, 2, 4
"""Numbers of profiles, of shares of the most frequent one, and of free squares ahead in the state of a run."""
_ANY_STRETCH = 1000
"""Squares, as many as `site.width_cells` and `height_cells` allow: a stretch of any length."""
_INSETS = 3
"""Places of the first and the last rail: at the ends, or one or two squares inside of them. With rails at the ends
alone learning finds 937 instead of 975 points on average of six sites of 20 x 30; polish ends at 1007, not 1014."""
_SIDE_RUNS, _APART = 3, 3
"""Number of runs per side of the contour, and least distance of rails, as for aisles with a row between them."""
_SPREAD_SPINES = 12
"""Number of additional single spines, besides those at portals, if loops are not required. Not measured."""
_STATES = _PROFILES * _SHARES * _AHEAD
_OPTIMISTIC = 40.0
"""More points than a run is likely to earn with all ahead of it. From zero learning finds 962 points on those six
sites, and polish ends at 1007."""


class Runs(NamedTuple):
    """The straight runs of free squares of a site in both directions.

    Attributes
    ----------
    first, length
        int64, shape (runs,): the first square, and the number of squares.
    ahead
        int64, shape (runs,): the run of the next line that lies beside most of it, or -1.
    turned
        int64, shape (2,): where the runs along rows end and those along columns end.
    spines
        int64, shape (2, K, M): for each direction sets of runs across it that may join its aisles, filled up with -1.
        If loops are required, a set has the rails and cross-aisles of a ladder; else it is one run, which leads
        straight away from a portal or is one of several spread over the site.
    """

    first: Int64s
    length: Int64s
    ahead: Int64s
    turned: Int64s
    spines: Int64Cube


def runs_of(ground: Ground) -> Runs:
    """Find all runs of two squares or more, in sweeping order."""
    first: list[int] = []
    length: list[int] = []
    turned: list[int] = []
    for direction, step in enumerate((1, ground.stride)):
        heads = ground.squares[ground.cells[ground.squares - step] != 0]
        if direction == 1:
            heads = heads[np.lexsort((heads // ground.stride, heads % ground.stride))]
        for head in heads.tolist():
            end = head
            while ground.cells[end] == 0:
                end += step
            count = (end - head) // step
            if count > 1:
                first.append(head)
                length.append(count)
        turned.append(len(first))
    ahead = np.full(len(first), -1)
    for begin, end, step, line in ((0, turned[0], 1, ground.stride), (turned[0], turned[1], ground.stride, 1)):
        owner = np.full(len(ground.cells), -1)
        for run in range(begin, end):
            owner[first[run] : first[run] + length[run] * step : step] = run
        for run in range(begin, end):
            past = owner[first[run] + line : first[run] + line + length[run] * step : step]
            if (past >= 0).any():
                ahead[run] = np.bincount(past[past >= 0]).argmax()
    runs = Runs(
        np.array(first, np.int64),
        np.array(length, np.int64),
        ahead,
        np.array(turned, np.int64),
        np.zeros((2, 0, 0), np.int64),
    )
    return runs._replace(spines=_ladders(ground, runs) if ground.rules.asks_loop else _single_spines(ground, runs))


def _ladders(ground: Ground, runs: Runs) -> Int64s:
    """Sets of spines that join the aisles at both ends, and in between so that no stretch is too long.

    Beside rails at the ends of the whole site there are sets with one at each side of the contour.
    """
    sets: list[list[list[int]]] = [[], []]
    for direction in range(2):
        across = _of_direction(runs, 1 - direction)
        lines = _places(ground, runs.first[across], direction)
        if not len(lines):
            continue
        starts, ends = _sides(ground, runs, direction)
        met = set()
        for near, far, more in product(range(_INSETS), range(_INSETS), range(2)):
            outer = [int(lines.min()) + near, int(lines.max()) - far]
            for knots in (outer, [*outer, *(starts + near), *(ends - far)]):
                rails = _rails(knots, stretch=ground.rules.stretch_squares or _ANY_STRETCH, more=more)
                if len(rails) > 1 and tuple(rails) not in met:
                    met.add(tuple(rails))
                    sets[direction].append((across.start + np.flatnonzero(np.isin(lines, rails))).tolist())
    count = max(len(found) for found in sets)
    most = max((len(spines) for found in sets for spines in found), default=1)
    ladders = np.full((2, max(count, 1), most), -1)
    for direction, found in enumerate(sets):
        for index, spines in enumerate(found):
            ladders[direction, index, : len(spines)] = spines
    return ladders


def _of_direction(runs: Runs, direction: int) -> slice:
    """Slice of the runs along rows (0) or columns (1)."""
    return slice(0 if direction == 0 else int(runs.turned[0]), int(runs.turned[direction]))


def _places(ground: Ground, squares: Int64s, direction: int) -> Int64s:
    """Columns of squares for aisles along rows (0), rows of squares for aisles along columns (1)."""
    return squares % ground.stride if direction == 0 else squares // ground.stride


def _sides(ground: Ground, runs: Runs, direction: int) -> tuple[Int64s, Int64s]:
    """Lines at which several runs of a direction begin, and at which several end: the sides of the contour."""
    along = _of_direction(runs, direction)
    first = _places(ground, runs.first[along], direction)
    found = []
    for places in (first, first + runs.length[along] - 1):
        lines, counts = np.unique(places, return_counts=True)
        found.append(lines[counts >= _SIDE_RUNS])
    return found[0], found[1]


def _rails(knots: list[int], *, stretch: int, more: int) -> list[int]:
    """Lines for spines at the knots, without those too close to an earlier one, and evenly spaced between them.

    As many lie between two knots as keep the stretches short enough, and `more`, where there is room for that many.
    """
    kept: list[int] = []
    for knot in knots:
        if all(abs(knot - other) >= _APART for other in kept):
            kept.append(knot)
    kept.sort()
    rails = set(kept)
    for low, high in pairwise(kept):
        parts = max(1, -(-(high - low) // (stretch + 1))) + more
        if (high - low) // parts >= _APART:
            rails.update(np.linspace(low, high, parts + 1).round().astype(int).tolist())
    return sorted(rails)


def _single_spines(ground: Ground, runs: Runs) -> Int64s:
    """Single spines: runs that lead straight away from a portal, and some spread over the site."""
    first, length, turned = runs.first.tolist(), runs.length.tolist(), runs.turned.tolist()
    spines = np.full((2, len(ground.portals) + _SPREAD_SPINES), -1)
    for index, portal in enumerate(ground.portals.tolist()):
        for direction, (step, begin, end) in enumerate(((1, 0, turned[0]), (ground.stride, turned[0], turned[1]))):
            for run in range(begin, end):
                squares = range(first[run], first[run] + length[run] * step, step)
                # a run across the aisles of the other direction
                beside = {portal - ground.stride, portal + ground.stride, portal - 1, portal + 1}
                if beside.intersection(squares):
                    longest = spines[1 - direction, index]
                    if longest < 0 or length[run] > length[longest]:
                        spines[1 - direction, index] = run
    for direction, (begin, end) in enumerate(((0, turned[0]), (turned[0], turned[1]))):
        longest_first = sorted(range(begin, end), key=lambda run: (-length[run], run))
        longish = sorted(longest_first[: 1 + (end - begin) // 2])
        places = np.linspace(0, len(longish) - 1, _SPREAD_SPINES + 2)[1:-1].round().astype(int)
        for index, place in enumerate(places[: len(longish)].tolist()):
            spines[1 - direction, len(ground.portals) + index] = longish[place]
    return spines[:, :, None]


class Room(NamedTuple):
    """Room for an episode over aisles.

    Attributes
    ----------
    states, options
        int64, shape (runs,): the state and the option of each run.
    rewards
        float64, shape (runs,).
    tape
        int8, shape (runs,): the options again, as an archive keeps them.
    profiles
        int64: profile of the squares behind each square of a run.
    counts, ahead
        int64, shapes (9,) and (4,): how often a run has each profile, and each number of free squares ahead.
    laid
        int64: the lanes of a plan.
    """

    states: Int64s
    options: Int64s
    rewards: Float64s
    tape: Int8s
    profiles: Int64s
    counts: Int64s
    ahead: Int64s
    laid: Int64s


def new_room(ground: Ground, runs: Runs) -> Room:
    """Room for episodes on a ground with these runs."""
    count = len(runs.first)
    return Room(
        np.zeros(count, np.int64),
        np.zeros(count, np.int64),
        np.zeros(count),
        np.zeros(count, np.int8),
        np.zeros(runs.length.max(initial=0), np.int64),
        np.zeros(_PROFILES, np.int64),
        np.zeros(_AHEAD, np.int64),
        np.zeros(len(ground.squares), np.int64),
    )


def new_values() -> Float64s:
    """Initial values of the options by state, optimistic so that the agent tries each."""
    return np.full((_STATES, OPTIONS), _OPTIMISTIC)


@in_c
def learn_aisles(
    ground: Ground,
    board: Board,
    runs: Runs,
    parameters: SarsaParameters,
    values: Float64s,
    archive: Archive,
    room: Room,
    random: UInt64s,
    curve: Float64s,
    schedule: Float64s,
    first: int,
    last: int,
    enough: int,
) -> int:
    """Run the episodes from `first` to below `last`; return the number of decisions.

    Once the archive has `enough` plans, no further plans are valued, for runs that need the learnt values only.

    Notes
    -----
    `schedule` holds epsilon and alpha, each followed by its factor after an episode; both are moved on.
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))`` as over squares, with options for
    actions: the use of a run. The direction and the run that joins the aisles across alternate. The reward is the
    increment of ``k_1 N_S + k_3 U_S`` per square of the run. Lanes that stay separate are joined by repair.
    """
    raise NotImplementedError
