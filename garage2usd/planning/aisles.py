"""Sarsa over aisles: the agent sweeps the site and decides on whole aisles instead of squares. Compiled."""
# Over 300 lines: Numba caches by file, and an edited callee in another one leaves its callers stale.
# ruff: noqa: C901, PLR0912, PLR0915, PLR2004 - a decision is one loop over the squares of a run

from itertools import pairwise, product
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.compiled import compiled, compiled_inlined, compiled_inner
from garage2usd.config.plan import SarsaParameters
from garage2usd.planning.archive import Archive, below, keep, uniform
from garage2usd.planning.board import NO_VALUE, Board, clear, measure, stalls_at
from garage2usd.planning.ground import Ground
from garage2usd.planning.repair import connect

__all__ = ["OPTIONS", "Runs", "learn_aisles", "new_values", "runs_of"]

OPTIONS = 4
"""Skip the run, an aisle along all of it, one that stops a square short of its ends, one along its even part."""

_PROFILES, _SHARES, _AHEAD = 9, 2, 4
"""How many profiles, shares of the commonest one and numbers of free squares ahead tell the states of a run apart."""
_EVEN_SHARE = 0.8
"""Of the squares of a run that has one profile all along, but for an obstacle or two. Not measured."""
_LONGEST_PART = 8
"""Runs of an archived plan that one episode decides anew: some rows of stalls with their aisles. Not measured."""
_ANY_STRETCH = 1000
"""Squares, as many as `site.width_cells` and `height_cells` allow: a stretch of any length."""
_INSETS = 3
"""Places of the first and the last rail: at the ends, or one or two squares inside of them. With rails at the ends
alone learning finds 937 instead of 975 points on average of six sites of 20 x 30; polish ends at 1007, not 1014."""
_SIDE_RUNS, _APART = 3, 3
"""How many runs make a side of the contour, and how far rails are apart, as aisles with a row between them are."""
_SPREAD_SPINES = 12
"""Single spines beside those that lead away from portals, where loops are not asked for. Not measured."""
_STATES = _PROFILES * _SHARES * _AHEAD
_OPTIMISTIC = 40.0
"""More points than a run is likely to earn with all ahead of it. From zero learning finds 962 points on those six
sites, and polish ends at 1007."""


class Runs(NamedTuple):
    """The straight runs of free squares of a site in both directions.

    Attributes
    ----------
    first, length
        int64, shape (runs,): the first square and how many there are.
    ahead
        int64, shape (runs,): the run of the next line that lies beside most of it, or -1.
    turned
        int64, shape (2,): where the runs along rows end and those along columns end.
    spines
        int64, shape (2, K, M): for each direction sets of runs across it that may join its aisles, filled up with -1.
        Where loops are asked for a set is a ladder's rails and cross-aisles; else one run that leads straight away
        from a portal, or one of some spread over the site.
    """

    first: NDArray[np.int64]
    length: NDArray[np.int64]
    ahead: NDArray[np.int64]
    turned: NDArray[np.int64]
    spines: NDArray[np.int64]


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


def _ladders(ground: Ground, runs: Runs) -> NDArray[np.int64]:
    """Sets of spines that join the aisles at both ends and so often between that no stretch is too long.

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
    """Which runs lie along rows (0) or columns (1)."""
    return slice(0 if direction == 0 else int(runs.turned[0]), int(runs.turned[direction]))


def _places(ground: Ground, squares: NDArray[np.int64], direction: int) -> NDArray[np.int64]:
    """Columns of squares where aisles run along rows (0), their rows where they run along columns (1)."""
    return squares % ground.stride if direction == 0 else squares // ground.stride


def _sides(ground: Ground, runs: Runs, direction: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Lines at which several runs of a direction begin, and at which several end: the sides of the contour."""
    along = _of_direction(runs, direction)
    first = _places(ground, runs.first[along], direction)
    found = []
    for places in (first, first + runs.length[along] - 1):
        lines, counts = np.unique(places, return_counts=True)
        found.append(lines[counts >= _SIDE_RUNS])
    return found[0], found[1]


def _rails(knots: list[int], *, stretch: int, more: int) -> list[int]:
    """Lines for spines at the knots, first come first served where these are too close, and evenly between them.

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


def _single_spines(ground: Ground, runs: Runs) -> NDArray[np.int64]:
    """Each a run that leads straight away from a portal, or one of some spread over the site."""
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
        int64: what lies behind each square of a run.
    counts, ahead
        int64, shapes (9,) and (4,): how often a run has each profile, and each number of free squares ahead.
    laid
        int64: the lanes of a plan.
    """

    states: NDArray[np.int64]
    options: NDArray[np.int64]
    rewards: NDArray[np.float64]
    tape: NDArray[np.int8]
    profiles: NDArray[np.int64]
    counts: NDArray[np.int64]
    ahead: NDArray[np.int64]
    laid: NDArray[np.int64]


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


def new_values() -> NDArray[np.float64]:
    """Values of the options by state when nothing is learnt yet: hopes that make the agent try each."""
    return np.full((_STATES, OPTIONS), _OPTIMISTIC)


@compiled_inner
def _profile(board: Board, square: int, across: int) -> int:
    """What lies behind a square: 0 to 3 squares or more up to a wall, or 4 to 8 for 0 to 4 squares up to a lane.

    More than four free squares count as a lane behind four.
    """
    gap, q = 0, square - across
    while board.cells[q] == 0 and gap < 4:
        gap += 1
        q -= across
    if board.cells[q] == 1:
        return 4 + gap
    return min(gap, 3) if board.cells[q] != 0 else 8


@compiled_inner
def _commonest(counts: NDArray[np.int64]) -> int:
    """Where a row of numbers is greatest first."""
    most = 0
    for place in range(len(counts)):
        if counts[place] > counts[most]:
            most = place
    return most


@compiled_inlined
def _state(board: Board, first: int, length: int, along: int, across: int, room: Room) -> tuple[int, int]:
    """State of a run, the same on every site, and its most frequent profile."""
    profiles, counts, ahead = room.profiles, room.counts, room.ahead
    for profile in range(_PROFILES):
        counts[profile] = 0
    for far in range(_AHEAD):
        ahead[far] = 0
    for index in range(length):
        q = first + index * along
        profiles[index] = _profile(board, q, across)
        counts[profiles[index]] += 1
        far = 0
        while far < _AHEAD - 1 and board.cells[q + (far + 1) * across] == 0:
            far += 1
        ahead[far] += 1
    most = _commonest(counts)
    even = 1 if counts[most] > _EVEN_SHARE * length else 0
    return (most * _SHARES + even) * _AHEAD + _commonest(ahead), most


@compiled_inner
def _lay_run(ground: Ground, board: Board, first: int, last: int, along: int, across: int) -> float:
    """Make all free squares of a run lanes; what the stalls and unused squares beside it gain."""
    cells, weights = board.cells, ground.weights
    gain = 0.0
    for sign in (-1.0, 1.0):
        for q in range(first - along, last + 2 * along, along):
            for p in (q - across, q, q + across):
                if cells[p] == 0:
                    stalls, _ = stalls_at(ground, board, p)
                    gain += sign * (weights[0] * stalls + (weights[2] if stalls == 0 else 0.0))
        if sign < 0:
            for q in range(first, last + along, along):
                if cells[q] == 0:
                    cells[q] = 1
    return gain


@compiled
def learn_aisles(
    ground: Ground,
    board: Board,
    runs: Runs,
    parameters: SarsaParameters,
    values: NDArray[np.float64],
    archive: Archive,
    room: Room,
    random: NDArray[np.uint64],
    curve: NDArray[np.float64],
    schedule: NDArray[np.float64],
    first: int,
    last: int,
    enough: int,
) -> int:
    """Run the episodes from `first` to below `last`; returns how many decisions were taken.

    With `enough` plans in the archive none is valued any more, as where nothing but what is learnt is asked for.

    Notes
    -----
    `schedule` holds epsilon and alpha, each followed by its factor after an episode; both are moved on.
    ``q(S_t, A_t) += alpha (R_{t+1} + gamma q(S_{t+1}, A_{t+1}) - q(S_t, A_t))`` as over squares, with options for
    actions: what becomes of a run. Direction, and the run that joins the aisles across, take turns.
    The reward is the increment of ``k_1 N_S + k_3 U_S``, per square of the run. What stays apart is joined by
    repair.
    """
    gamma, epsilon, alpha = parameters.gamma, schedule[0], schedule[2]
    states, options, rewards, tape, profiles, _, _, laid = room
    taken = 0
    for episode in range(first, last):
        clear(ground, board)
        # most episodes decide part of an archived one anew
        entry, part_begin, part_end = -1, 0, len(runs.first)
        if archive.in_use[0] > 0 and uniform(random) < parameters.revisit_rate:
            entry, rival = below(random, archive.in_use[0]), below(random, archive.in_use[0])
            if archive.values[rival] > archive.values[entry]:
                entry = rival
        # only what is decided anew is explored; whole episodes follow what is learnt on other sites
        explored = epsilon if entry >= 0 or parameters.revisit_rate == 0 else 0.0
        # direction and the aisle across it
        choice = archive.starts[entry] if entry >= 0 else episode % (2 * runs.spines.shape[1])
        direction, place = choice % 2, choice // 2
        along, across = (1, ground.stride) if direction == 0 else (ground.stride, 1)
        earned = 0.0
        for number in range(runs.spines.shape[2]):
            spine = runs.spines[direction, place, number]
            if spine < 0:
                break
            earned += _lay_run(
                ground, board, runs.first[spine], runs.first[spine] + (runs.length[spine] - 1) * across, across, along
            )
        begin = 0 if direction == 0 else runs.turned[0]
        if entry >= 0:
            part_begin = begin + below(random, runs.turned[direction] - begin)
            part_end = part_begin + 1 + below(random, np.int64(_LONGEST_PART))
        for run in range(begin, runs.turned[direction]):
            head, length = runs.first[run], runs.length[run]
            state, most = _state(board, head, length, along, across, room)
            option = below(random, np.int64(OPTIONS))
            if run < part_begin or run >= part_end:
                option = archive.tapes[entry, run]
            elif uniform(random) >= explored:
                for other in range(OPTIONS):
                    if values[state, other] > values[state, option]:
                        option = other
            low, high = 0, length - 1
            if option == 2:
                low, high = 1, length - 2
            elif option == 3:
                best, since = 0, 0
                low, high = 0, -1
                for index in range(length + 1):
                    if index == length or profiles[index] != most:
                        if index - since > best:
                            best, low, high = index - since, since, index - 1
                        since = index + 1
            gain = 0.0
            if option > 0 and low <= high:
                gain = _lay_run(ground, board, head + low * along, head + high * along, along, across)
            earned += gain
            states[run], options[run], rewards[run] = state, option, gain / length
            tape[run] = option
            taken += 1
        # what became of a run is felt by the run ahead of it, not by the next to be decided
        for run in range(begin, runs.turned[direction]):
            target, state, option = rewards[run], states[run], options[run]
            ahead = runs.ahead[run]
            if ahead >= 0:
                target += gamma * values[states[ahead], options[ahead]]
            values[state, option] += alpha * (target - values[state, option])
        curve[episode] = earned
        if archive.in_use[0] < enough and connect(ground, board):
            value = measure(ground, board, -np.inf)
            if value > NO_VALUE:
                count = 0
                for q in ground.squares:
                    if board.cells[q] == 1:
                        laid[count] = q
                        count += 1
                keep(archive, laid, count, value, tape, len(tape), choice)
        epsilon, alpha = epsilon * schedule[1], alpha * schedule[3]
    schedule[0], schedule[2] = epsilon, alpha
    return taken
