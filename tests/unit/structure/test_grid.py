import numpy as np
import pytest

from garage2usd.common.errors import ConfigError
from garage2usd.structure.grid import Cell, Structure, cells_from_text, cells_to_text, edge_neighbour_count

PLAN = "#..\nE=X\n..."


def test_text_round_trip():
    cells = cells_from_text(PLAN, field="S")
    assert cells.tolist() == [[-1, 0, 0], [2, 1, 3], [0, 0, 0]]
    assert cells_to_text(cells) == PLAN


def test_numbers_read_like_symbols():
    numbers = "-1 0 0\n2, 1, 3\n0 0 0"
    assert (cells_from_text(numbers, field="S") == cells_from_text(PLAN, field="S")).all()


@pytest.mark.parametrize(("text", "named"), [("..\n.", "[2, 1]"), ("..\n.?", "?"), ("0 1\n2 7", "7"), ("  \n", "S")])
def test_bad_text_names_what_is_wrong(text, named):
    with pytest.raises(ConfigError) as caught:
        cells_from_text(text, field="S")
    assert named in str(caught.value)


def test_from_arrays_takes_matrices_constant_along_their_line():
    S = [[0, 1], [2, 3]]
    structure = Structure.from_arrays(S, [[5.5, 8.1], [5.5, 8.1]], [[6.0, 6.0], [8.1, 8.1]])
    assert structure.column_widths_mm.tolist() == [5500, 8100]
    assert structure.row_depths_mm.tolist() == [6000, 8100]
    assert structure.R.tolist() == [[5.5, 8.1], [5.5, 8.1]]
    assert structure.C.tolist() == [[6.0, 6.0], [8.1, 8.1]]


@pytest.mark.parametrize(
    ("R", "C", "field"),
    [
        ([[5.5, 8.1], [5.5, 8.0]], 8.1, "R[1, 1]"),
        (8.1, [[6.0, 6.1], [8.1, 8.1]], "C[0, 1]"),
        ([8.1, 8.1, 8.1], 8.1, "R"),
        (-8.1, 8.1, "R"),
        (float("nan"), 8.1, "R"),
        (8.1, float("inf"), "C"),
        (8.1, [[1.0], [2.0, 3.0]], "C"),
        (1e300, 8.1, "R"),
        (8.1, {"C": 8.1}, "C"),
        (8.1, [8.1, 10**400], "C"),
    ],
)
def test_sides_that_do_not_meet_are_refused(R, C, field):
    with pytest.raises(ConfigError) as caught:
        Structure.from_arrays([[0, 1], [2, 3]], R, C)
    assert caught.value.field == field


@pytest.mark.parametrize("S", [[[0, 4]], [[0.5, 1]], [0, 1], [[]], [[300, 0]], [[0, 1], [2]]])
def test_bad_matrices_are_refused(S):
    with pytest.raises(ConfigError):
        Structure.from_arrays(S, 8.1, 8.1)


def test_structures_are_read_only_and_copied():
    S = np.zeros((2, 2), dtype=np.int8)
    structure = Structure.from_arrays(S, 8.1, 8.1)
    S[0, 0] = 1
    assert structure.cells[0, 0] == Cell.FREE
    with pytest.raises(ValueError, match="read-only"):
        structure.cells[0, 0] = 1


def test_equal_digests_iff_equal_structures():
    first = Structure.from_arrays([[0, 1], [2, 3]], 8.1, 8.1)
    same = Structure.from_arrays(np.array([[0, 1], [2, 3]], dtype=np.int64), [8.1, 8.1], 8.1)
    assert first == same
    assert len({first, same}) == 1
    others = [
        Structure.from_arrays([[0, 1], [2, 0]], 8.1, 8.1),
        Structure.from_arrays([[0, 1, 2, 3]], 8.1, 8.1),
        Structure.from_arrays([[0, 1], [2, 3]], [8.1, 8.101], 8.1),
        Structure.from_arrays([[0, 1], [2, 3]], 8.1, [8.101, 8.1]),
    ]
    assert len({structure.digest() for structure in (first, *others)}) == 5


def test_edge_neighbour_count_ignores_diagonals_and_the_outside():
    mask = np.array([[1, 0, 1], [0, 0, 0], [1, 0, 1]], dtype=bool)
    assert edge_neighbour_count(mask).tolist() == [[0, 2, 0], [2, 0, 2], [0, 2, 0]]
