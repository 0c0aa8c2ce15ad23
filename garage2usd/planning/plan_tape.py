"""The tape of a whole plan: its lanes, then the directions of its aisles and the kinds of its stalls.

The tape of the lanes (`garage2usd.planning.tape`) ends where the agent stays. A plan of two-way aisles and
perpendicular stalls of the standard size needs no more. The tape of any other plan goes on with whole numbers in the
same five letters: the digits 1 to 4 of bijective base 4 are U, D, L and R, and S ends a number. Each number has one
such form, so that plans and tapes correspond one to one. The numbers are:

- 1, the version of this form;
- 0 if all aisles are two-way, else 1 and a number for each stretch in reading order: 0 both ways, 1 as read, 2 against;
- the number of different stalls, and for each its kind, its size class and, if it is angled, the decimals of its angle
  and the angle without its point;
- for each line of free squares along a lane, its runs from the first square to the last: 0 for squares without stalls,
  else one more than twice the number of the stall, and one more if it leans against the traffic, and then how many
  squares of the line are left behind it.
"""
# Over 300 lines: the writer and the reader of one form, which change together.

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from itertools import groupby
from typing import NamedTuple

import numpy as np

from garage2usd.common.errors import ConfigError, GenerationError
from garage2usd.config import GarageConfig
from garage2usd.config.stalls import GivenRun, SizeClass
from garage2usd.garage import StallKind
from garage2usd.planning.orientation import driven_lengths
from garage2usd.planning.planner import Plan, given_plan
from garage2usd.planning.stall_kinds import runs_of_settings, settings_of_runs, with_runs
from garage2usd.planning.tape import ACTIONS, play, tape_of
from garage2usd.structure.grid import Cell, Structure
from garage2usd.structure.lanes import BOTH_WAYS, LaneDirections, stretches_of
from garage2usd.structure.stall_runs import StallRun
from garage2usd.structure.stalls import Edge

_VERSION = 1
_END, _DIGITS = ACTIONS[4], ACTIONS[:4]
_KINDS = (StallKind.PERPENDICULAR, StallKind.ANGLED, StallKind.PARALLEL)
_SIZES = tuple(SizeClass)
_MOST_LETTERS = 40
"""Greatest number of letters of a number; counts of squares and angles need fewer."""
_WITH, _AGAINST = "with traffic", "against traffic"

_ANGLES_DEG = (30.0, 85.0)

Square = tuple[int, int]


class _Line(NamedTuple):
    """Consecutive free squares with a lane beyond one edge."""

    edge: Edge
    squares: tuple[Square, ...]


class _Stall(NamedTuple):
    """Kind, size class and angle of the stalls of a run."""

    kind: StallKind
    size: SizeClass
    angle_deg: float | None


def plan_tape_of(plan: Plan) -> str:
    """Write the canonical tape of a plan: of its lanes, its directions and its stalls.

    Returns
    -------
    str
        Letters of `ACTIONS`; the tape of the lanes alone if aisles are two-way and stalls of the usual kind.

    Raises
    ------
    ConfigError
        If no agent makes the lanes, or two runs of stalls have a square and an edge in common.
    """
    return tape_of(plan.structure) + tail_of(plan)


def tail_of(plan: Plan) -> str:
    """Write the part after the tape of the lanes: directions and stalls; empty if all are the usual ones."""
    if not plan.runs and not plan.directions.one_way:
        return ""
    return "".join(_letters(number) for number in _numbers(plan))


def is_of_lanes_alone(tape: str) -> bool:
    """Test whether a tape says nothing of directions and stalls."""
    return _END not in tape or tape.index(_END) == len(tape) - 1


def play_plan(site: Structure, tape: str, config: GarageConfig) -> Plan:
    """Play the tape of a plan on a site; the inverse of `plan_tape_of`.

    Parameters
    ----------
    site
        Static objects without lanes.
    tape
        Letters of `ACTIONS`. The tape of lanes alone gives a plan with two-way aisles and the usual stalls.
    config
        Sizes of stalls and squares.

    Raises
    ------
    ConfigError
        If the tape is not the canonical one of a plan on this site; names the letter where that is one.
    GenerationError
        If a stall is not reached along the directions.
    """
    end = len(tape) if is_of_lanes_alone(tape) else tape.index(_END) + 1
    plan = given_plan(play(site, tape[:end]), bay=config.bay, plan=config.plan)
    if end == len(tape):
        return plan
    tail = tape[end:]
    directions, runs = read_tail(plan.structure, tail, config, before=end)
    turned = replace(plan, directions=directions)
    if not np.isfinite(driven_lengths(turned, config, directions).directed_m):
        reason = "not every stall is reached from an entrance and reaches an exit along the directions of the tape"
        raise GenerationError("plan", reason, seed=config.seed, attempts=1)
    complete = with_runs(turned, config, runs) if runs else turned
    if tail_of(complete) != tail:
        raise ConfigError("tape", tail, "the canonical form of its directions and stalls behind the tape of the lanes")
    return complete


def read_tail(
    structure: Structure, tail: str, config: GarageConfig, *, before: int = 0
) -> tuple[LaneDirections, tuple[StallRun, ...]]:
    """Read directions and stalls behind the tape of the lanes; the inverse of `tail_of`.

    Parameters
    ----------
    structure
        Structure with the lanes.
    tail
        The part of the tape after the lanes.
    config
        Sizes of stalls.
    before
        Number of letters before the tail, for errors.

    Raises
    ------
    ConfigError
        If a letter or a number is not one of these lanes.
    """
    if not tail:
        return BOTH_WAYS, ()
    reader = _Reader(tail, before)
    directions, runs = _played(structure, reader)
    reader.close()
    found = runs_of_settings(runs, config, directions)
    return directions, tuple(sorted(found, key=lambda run: (run.first, run.edge)))


def _letters(number: int) -> str:
    """Write a whole number in bijective base 4, and its end."""
    digits = ""
    while number:
        number, digit = divmod(number - 1, len(_DIGITS))
        digits = _DIGITS[digit] + digits
    return digits + _END


def _numbers(plan: Plan) -> Iterator[int]:
    """Yield the numbers of the directions and the stalls of a plan."""
    structure, one_way = plan.structure, plan.directions.one_way
    yield _VERSION
    yield int(bool(one_way))
    if one_way:
        for path in stretches_of(structure):
            yield 1 if (path[0], path[1]) in one_way else 2 if (path[1], path[0]) in one_way else 0
    runs = {(Edge[run.edge.upper()], run.first): run for run in settings_of_runs(plan.runs, plan.directions)}
    lines = [(line, list(_runs_of_line(line, runs))) for line in (_lines_of(structure) if runs else ())]
    told = [run for _, found in lines for run, _ in found if run]
    if len(told) != len(plan.runs):
        raise ConfigError("stalls.runs", f"{len(plan.runs)} runs", "runs that have no square and edge in common")
    stalls = list(dict.fromkeys(map(_stall_of, told)))
    yield len(stalls)
    for stall in stalls:
        yield _KINDS.index(stall.kind)
        yield _SIZES.index(stall.size)
        if stall.angle_deg is not None:
            yield from _decimal(stall.angle_deg)
    for _, found in lines:
        for run, left in found:
            yield 0 if run is None else 1 + 2 * stalls.index(_stall_of(run)) + (run.leans == _AGAINST)
            yield left


def _runs_of_line(line: _Line, runs: Mapping[tuple[Edge, Square], GivenRun]) -> Iterator[tuple[GivenRun | None, int]]:
    """Yield the runs of a line, None for squares without any, with the number of squares after each."""
    place, count = 0, len(line.squares)
    while place < count:
        run = runs.get((line.edge, line.squares[place]))
        start = place
        if run is not None:
            while place < count and line.squares[place] <= run.last:
                place += 1
        else:
            while place < count and (line.edge, line.squares[place]) not in runs:
                place += 1
        if run is not None and line.squares[place - 1] != run.last:
            raise ConfigError("stalls.runs", [list(line.squares[start]), list(run.last)], "runs along a lane")
        yield run, count - place


def _stall_of(run: GivenRun) -> _Stall:
    return _Stall(run.kind, run.size, run.angle_deg)


def _decimal(value: float) -> tuple[int, int]:
    """Return the decimals of a number in its shortest form, and the number without its point."""
    decimals = max(0, -int(Decimal(repr(value)).normalize().as_tuple().exponent))
    return decimals, int(Decimal(repr(value)).scaleb(decimals))


def _lines_of(structure: Structure) -> list[_Line]:
    """Return the lines of free squares along lanes, in reading order of their first squares."""
    found = []
    for edge in Edge:
        squares = [
            square for square in structure.where(Cell.FREE) if structure.cell_at(edge.beyond(square)) is Cell.LANE
        ]
        # squares of one line are adjacent while the difference between position and index is constant
        along = int(edge.along_x)
        squares.sort(key=lambda square: (square[1 - along], square[along]))
        keyed = enumerate(squares)
        for _, group in groupby(keyed, key=lambda one: (one[1][1 - along], one[1][along] - one[0])):
            found.append(_Line(edge, tuple(square for _, square in group)))
    return sorted(found, key=lambda line: (line.squares[0], line.edge))


class _Reader:
    """The numbers of a tape, one after the other."""

    def __init__(self, tail: str, before: int) -> None:
        self._tail, self._before, self._place = tail, before, 0

    def number(self, allowed: str, most: int | None = None) -> int:
        """Read the next number; `allowed` tells which, for the error."""
        start, value = self._place, 0
        for letter in self._tail[start : start + _MOST_LETTERS + 1]:
            self._place += 1
            if letter == _END:
                break
            if letter not in _DIGITS:
                raise ConfigError(f"tape[{self._before + self._place - 1}]", letter, "letters U, D, L, R and S")
            value = len(_DIGITS) * value + _DIGITS.index(letter) + 1
        else:
            written = self._tail[start : start + _MOST_LETTERS]
            is_cut = len(self._tail) - start <= _MOST_LETTERS
            what = f"{allowed}; the tape ends here" if is_cut else allowed
            raise ConfigError(f"tape[{self._before + start}]", written, what)
        if most is not None and value > most:
            raise ConfigError(f"tape[{self._before + start}]", value, allowed)
        return value

    def close(self) -> None:
        """Raise an error if letters are left."""
        if rest := self._tail[self._place :]:
            raise ConfigError(f"tape[{self._before + self._place}]", rest, "the end of the tape")


def _played(structure: Structure, reader: _Reader) -> tuple[LaneDirections, list[GivenRun]]:
    """Read directions and runs."""
    version = reader.number("the version of the form of directions and stalls, 1")
    if version != _VERSION:
        raise ConfigError("tape", f"version {version}", f"version {_VERSION} of directions and stalls")
    turned: list[tuple[Square, ...]] = []
    if reader.number("0 for two-way aisles or 1 for directions", 1):
        for path in stretches_of(structure):
            way = reader.number("0, 1 or 2 for the direction of a stretch of lane", 2)
            turned += [(), (path,), (path[::-1],)][way]
    count = reader.number("the number of different stalls", len(_KINDS) * len(_SIZES) * 10_000)
    stalls = [_read_stall(reader) for _ in range(count)]
    runs = [run for line in (_lines_of(structure) if stalls else ()) for run in _read_line(line, stalls, reader)]
    return LaneDirections.of_stretches(turned), runs


def _read_stall(reader: _Reader) -> _Stall:
    kind = _KINDS[reader.number(f"0 to {len(_KINDS) - 1} for the kind of stalls", len(_KINDS) - 1)]
    size = _SIZES[reader.number(f"0 to {len(_SIZES) - 1} for the size class of stalls", len(_SIZES) - 1)]
    if kind is not StallKind.PERPENDICULAR and not size.takes_cars:
        raise ConfigError("tape", f"{kind} stalls for motorcycles", "perpendicular stalls for motorcycles")
    if kind is not StallKind.ANGLED:
        return _Stall(kind, size, None)
    decimals = reader.number("the decimals of an angle, at most 16", 16)
    angle_deg = float(Decimal(reader.number("an angle without its point")).scaleb(-decimals))
    least, most = _ANGLES_DEG
    if not least <= angle_deg <= most:
        raise ConfigError("tape", f"stalls at {angle_deg:g} degrees", f"angles of {least:g} to {most:g} degrees")
    return _Stall(kind, size, angle_deg)


def _read_line(line: _Line, stalls: Sequence[_Stall], reader: _Reader) -> Iterator[GivenRun]:
    """Read the runs of a line of squares."""
    count = len(line.squares)
    left = count
    while left:
        code = reader.number(f"0 for squares without stalls, or 1 to {2 * len(stalls)} for a run", 2 * len(stalls))
        start = count - left
        left = reader.number(f"at most {left - 1} squares behind a run on {count} squares", left - 1)
        if code:
            number, is_against = divmod(code - 1, 2)
            yield GivenRun(
                first=line.squares[start],
                last=line.squares[count - left - 1],
                edge=line.edge.name.lower(),
                kind=stalls[number].kind,
                size=stalls[number].size,
                angle_deg=stalls[number].angle_deg,
                leans=_AGAINST if is_against else _WITH,
            )
