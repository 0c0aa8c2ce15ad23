"""The board: laying square by square gives the score of the whole, and repair repairs."""

import numpy as np
import pytest
from support.inner_loops import clear, dead_ends, lay, trim
from support.planning_reference import BAY, drawn, feasible, random_site, score, sown
from support.soak import soak_but

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning.board import NO_VALUE, cells_of, connect, ground_of, lanes_of, measure, new_board, value_now

ALLOW = PlanConfig(circulation="allow", dead_ends="allow")
FORBID = PlanConfig(circulation="allow", dead_ends="forbid")


def lanes_now(ground, board):
    return cells_of(ground, board.cells[ground.squares] == 1)


@pytest.mark.parametrize("bay", [BAY, BayConfig(column_widths_m=11.0, row_depths_m=5.6), BayConfig(row_depths_m=16.0)])
def test_laying_keeps_the_score(bay):
    for seed in range(12):
        site = random_site(seed, bay)
        if site is None:
            continue
        ground = ground_of(site, bay=bay, plan=ALLOW)
        board, whole = new_board(ground), new_board(ground)
        clear(ground, board)
        rng = np.random.default_rng(seed)
        # a random growth from the first entrance
        front = [int(ground.entrances[0])]
        for _ in range(len(ground.squares) // 2):
            beside = [q + s for q in front for s in (-ground.stride, ground.stride, -1, 1) if board.cells[q + s] == 0]
            if not beside:
                break
            square = beside[rng.integers(len(beside))]
            lay(ground, board, square)
            front = [square, *front] if front[0] not in ground.entrances else [square]
            structure = site.with_cells(lanes_now(ground, board))
            expected = score(structure, bay)
            if board.tally[0]:
                assert value_now(ground, board) == pytest.approx(expected[0])
            assert (board.tally[0], board.tally[2]) == (expected[1], expected[3])
            whole.cells[:] = board.cells
            measured = measure(ground, whole, -np.inf)
            if feasible(structure.cells) and expected[1]:
                assert measured == pytest.approx(expected[0])
            else:
                assert measured == NO_VALUE


def test_lanes_and_cells_are_inverse():
    structure = drawn("E==X\n.#..")
    ground = ground_of(structure, bay=BAY, plan=ALLOW)
    assert (cells_of(ground, lanes_of(structure, ground)) == structure.cells).all()


@pytest.mark.parametrize("seed", soak_but(8, range(30)))
def test_connect_joins_any_lanes(seed):
    _, ground, board, laid = sown(seed, ALLOW, share=None)
    assert connect(ground, board)
    assert feasible(lanes_now(ground, board))
    assert (board.cells[laid] == 1).all()  # on connected ground nothing is taken off


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("E===X\n.=...\n.=...\n.=...\n.=...", 1),  # four squares of 8.1 m beyond the junction
        ("E===X\n.=...\n.=...\n.=...", 0),  # three: 24.3 m
        ("E===X\n.=.=.\n.=.=.\n.=.=.\n.===.", 0),  # a loop
        ("E===X\n.=.=.\n.=.=.\n.=.=.\n.=.=.", 2),
        (".====\n.=...\n.=...\n.=...\nE==X.", 1),  # round a bend
        ("E====", 1),
    ],
)
def test_long_dead_ends(text, count):
    structure = drawn(text)
    ground = ground_of(structure, bay=BAY, plan=PlanConfig())
    assert dead_ends(ground, np.pad(structure.cells, 4, constant_values=-1).ravel()) == count


@pytest.mark.parametrize("seed", soak_but(8, range(30)))
def test_trimming_leaves_no_dead_end(seed):
    _, ground, board, _ = sown(seed, FORBID)
    assert connect(ground, board)
    trim(ground, board)
    cells = lanes_now(ground, board)
    assert feasible(cells)
    drivable = np.pad(cells >= 1, 1)
    beside = sum(np.roll(drivable, shift, axis).astype(int) for axis in (0, 1) for shift in (-1, 1))[1:-1, 1:-1]
    assert (beside[cells == 1] >= 2).all() or (cells == 1).sum() == 1
