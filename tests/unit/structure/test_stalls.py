import pytest

from garage2usd.config import BayConfig
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.stalls import Edge, square_capacity, stall_rows

BAY = BayConfig()


def structure(text, R=8.1, C=8.1):
    return Structure.from_arrays(cells_from_text(text, field="S"), R, C)


@pytest.mark.parametrize(
    ("text", "R", "C", "expected"),
    [
        ("=\n.", 8.1, 8.1, 3),  # one square bay holds three
        ("=\n.\n=", 8.1, 8.1, 3),  # open on both sides, but too shallow for two rows
        ("=\n.\n=", 8.1, 10.6, 6),  # deep enough for two rows
        ("=\n.\n=", 8.1, 10.599, 3),
        ("=\n.", 5.5, 8.1, 2),
        ("=\n.", 5.399, 8.1, 1),
        ("=\n.", 8.1, 5.299, 0),  # the depth does not take a stall
        ("=.", 8.1, 5.4, 2),  # served from the side: stalls along the depth of the row
        ("=.", 5.3, 8.1, 3),
        ("E.", 8.1, 8.1, 0),  # portals serve no stall
        ("=#", 8.1, 8.1, 0),
        ("=\n.\n=", 3.0, 3.0, 0),
    ],
)
def test_capacity(text, R, C, expected):
    plan = structure(text, R, C)
    assert square_capacity(plan, BAY).sum() == expected
    assert sum(row.count for row in stall_rows(plan, BAY)) == expected


def test_the_better_edge_wins_and_a_tie_goes_to_up_and_down():
    plan = structure("==\n=.", [8.1, 8.1], [8.1, 5.4])
    (row,) = stall_rows(plan, BAY)
    assert (row.row, row.col, row.edge, row.count) == (1, 1, Edge.UP, 3)
    (tie,) = stall_rows(structure("==\n=."), BAY)
    assert tie.edge is Edge.UP


def test_two_rows_have_both_edges():
    rows = stall_rows(structure("=.=", 10.6, 8.1), BAY)
    assert [(row.edge, row.count) for row in rows] == [(Edge.LEFT, 3), (Edge.RIGHT, 3)]
