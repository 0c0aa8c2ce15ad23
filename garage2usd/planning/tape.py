"""The canonical random process of a structure: the tape of an agent's actions, and its rank.

A seed is not a random process that a structure determines: many seeds give one structure. What corresponds one to one
are the structure's lanes and the actions of an agent that steps from the first entrance onto the lanes, visits them
depth first in the order up, down, left, right, steps back where nothing is left, and stays: its tape. The tape is a
number in base 5.
"""

from collections.abc import Iterator

import numpy as np

from garage2usd.common.errors import ConfigError
from garage2usd.structure.grid import NEIGHBOUR_STEPS, Cell, Structure

ACTIONS = "UDLRS"
"""One letter for each of up, down, left, right, stay: the digits 0 to 4."""

_STEPS = dict(zip(ACTIONS, NEIGHBOUR_STEPS, strict=False))
_BACK = {"U": "D", "D": "U", "L": "R", "R": "L"}
_STAY = ACTIONS[4]


def tape_of(structure: Structure) -> str:
    """Write the canonical tape of the lanes of a structure.

    Returns
    -------
    str
        Letters of `ACTIONS`; twice as many as there are lanes, as every lane but the first is entered and left.

    Raises
    ------
    ConfigError
        If the lanes are more than one piece, or none is beside the first entrance: no agent makes them.
    """
    lanes = structure.cells == Cell.LANE
    tape = "".join(_walk(structure, np.pad(lanes, 1)))
    if len(tape) != 2 * lanes.sum():
        raise ConfigError("S", f"{lanes.sum()} lanes", "lanes in one piece beside the first entrance")
    return tape


def play(site: Structure, tape: str) -> Structure:
    """Play a canonical tape on a site; the inverse of `tape_of`.

    Parameters
    ----------
    site
        Static objects without lanes.
    tape
        Letters of `ACTIONS`.

    Raises
    ------
    ConfigError
        If a letter is unknown, an action leaves the free squares, or the tape is not the canonical one of its lanes.
    """
    cells = site.cells.copy()
    row, col = site.where(Cell.ENTRANCE)[0]
    for place, action in enumerate(tape.removesuffix(_STAY)):
        if action not in _STEPS:
            raise ConfigError(f"tape[{place}]", action, "letters U, D, L, R and a final S")
        row, col = row + _STEPS[action][0], col + _STEPS[action][1]
        inside = 0 <= row < cells.shape[0] and 0 <= col < cells.shape[1]
        if not inside or cells[row, col] not in {Cell.FREE, Cell.LANE}:
            raise ConfigError(f"tape[{place}]", action, f"an action that stays on free squares, not to ({row}, {col})")
        cells[row, col] = Cell.LANE
    structure = site.with_cells(cells)
    if not (cells == Cell.LANE).any() or tape_of(structure) != tape:
        raise ConfigError("tape", tape, "the canonical tape of its lanes: depth first, U before D before L before R")
    return structure


def rank_of(tape: str) -> int:
    """Rank of a tape: its letters are base-5 digits behind a leading 1, which keeps leading Us."""
    rank = 1
    for action in tape:
        rank = 5 * rank + ACTIONS.index(action)
    return rank


def tape_at(rank: int) -> str:
    """Tape of a rank; the inverse of `rank_of`.

    Raises
    ------
    ConfigError
        If no tape has that rank.
    """
    digits: list[str] = []
    rest = rank
    while rest >= len(ACTIONS):
        rest, digit = divmod(rest, len(ACTIONS))
        digits.append(ACTIONS[digit])
    if rest != 1:
        raise ConfigError("rank", rank, "a number whose first base-5 digit is 1")
    return "".join(reversed(digits))


def _walk(structure: Structure, padded: np.typing.NDArray[np.bool_]) -> Iterator[str]:
    """Walk depth first from the first entrance over all lanes, then stay."""
    unvisited = padded.copy()
    row, col = structure.where(Cell.ENTRANCE)[0]
    path: list[str] = []
    row, col = row + 1, col + 1
    while True:
        for action, (dr, dc) in _STEPS.items():
            if unvisited[row + dr, col + dc]:
                row, col = row + dr, col + dc
                unvisited[row, col] = False
                path.append(action)
                yield action
                break
        else:
            if len(path) <= 1:  # back on the first lane: the entrance is not entered again
                break
            back = _BACK[path.pop()]
            row, col = row + _STEPS[back][0], col + _STEPS[back][1]
            yield back
    yield _STAY
