"""The score against figures worked out by hand."""

import pytest
from support.planning_reference import BAY, drawn, feasible, score

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.planning import evaluate, is_feasible

COMB = "\n".join([".=..=..=."] * 5 + [".=======.", "..E...X.."])
RING = "\n".join([".........", ".=======."] + [".=.....=."] * 3 + [".=======.", "..E...X.."])
AISLE = "\n".join([".........", ".=======."] + [".=..=..=."] * 3 + [".=======.", "..E...X.."])
CROSS = ".........\n.=======.\n.=..=..=.\n.=======.\n.=..=..=.\n.=======.\n..E...X.."


@pytest.mark.parametrize(
    ("text", "value", "stalls", "time", "unused"),
    [
        (COMB, 74.41, 111, 6.92, 2),
        (RING, 59.71, 102, 7.06, 7),
        (AISLE, 64.76, 102, 6.65, 4),
        (CROSS, 53.00, 90, 6.60, 4),
    ],
    ids=["comb", "ring", "ring and centre aisle", "ring and cross"],
)
def test_known_structures(text, value, stalls, time, unused):
    structure = drawn(text)
    result = evaluate(structure, bay=BAY)
    assert round(result.value, 2) == value
    assert result.stalls == stalls
    assert round(result.parking_time_squares, 2) == time
    assert result.unused_squares == unused
    assert is_feasible(structure)
    assert feasible(structure.cells)
    assert score(structure) == pytest.approx((result.value, stalls, result.parking_time_squares, unused))


def test_hand_worked_bay():
    # one lane: squares beside it hold 3 each; hops 1, so every stall is 2 squares away
    result = evaluate(drawn("E=.\n.X."), bay=BAY)
    assert (result.stalls, result.parking_time_squares, result.unused_squares) == (3, 2.0, 2)
    assert result.value == 3 - 10 - 2


def test_nearest_of_two_entrances_counts():
    one = evaluate(drawn("E====X\n......"), bay=BAY)
    two = evaluate(drawn("E====E\n.....X"), bay=BAY)
    assert (one.stalls, two.stalls) == (12, 12)
    assert one.parking_time_squares == (2 + 3 + 4 + 5) / 4
    assert two.parking_time_squares == (2 + 3 + 3 + 2) / 4


def test_capacity_follows_the_bay():
    wide = drawn(COMB, side_m=5.5)
    assert evaluate(wide, bay=BAY).stalls == 37 * 2
    assert evaluate(wide, bay=BayConfig(stall_width_m=2.6)).stalls == 37


def test_weights_of_the_plan():
    result = evaluate(drawn(COMB), bay=BAY, plan=PlanConfig(stall_weight=2, parking_time_weight=0, unused_weight=-10))
    assert result.value == 2 * 111 - 10 * 2


def test_seconds():
    result = evaluate(drawn("E=.\n.X."), bay=BAY)
    assert result.parking_time_s(square_side_m=8.1, speed_m_s=2.7) == pytest.approx(6.0)


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("E=X\n...", True),
        ("E.X\n.=.", False),
        ("E=.\n..X", False),
        ("=E=\n=X=", False),  # joined only through a portal
        ("=E=\n=X=\n.=.", False),
        ("=E=\n=X=\n===", True),
        ("E..\n..X", False),
    ],
)
def test_feasible(text, expected):
    assert is_feasible(drawn(text)) is expected
    assert feasible(drawn(text).cells) is expected
