"""Design principles and dead ends on plans small enough to count by eye."""

import numpy as np
import pytest
from support import inner_loops
from support.planning_reference import BAY, drawn, random_site

from garage2usd.config import PlanConfig
from garage2usd.planning import plan_lanes, principles
from garage2usd.planning.board import ground_of
from garage2usd.structure.lanes import dead_ends

COMB = "\n".join([".=..=..=."] * 5 + [".=======.", "..E...X.."])
AISLE = "\n".join([".........", ".=======."] + [".=..=..=."] * 3 + [".=======.", "..E...X.."])


def test_comb():
    figures = principles(drawn(COMB), bay=BAY)
    assert figures.loops == 0
    # the outer aisles go on round the bend to the square above the gate, the middle one to the connector
    assert [(end.tip, round(end.length_m, 1), end.needs_turning_stall) for end in figures.dead_ends] == [
        ((0, 1), 48.6, True),
        ((0, 4), 40.5, True),
        ((0, 7), 48.6, True),
    ]
    middle = figures.dead_ends[1]
    assert middle.squares == tuple((row, 4) for row in range(5))
    # 15 lanes along the aisles, 4 along the connector between its junctions and bends
    assert figures.parallel_share == pytest.approx(15 / 19)
    assert figures.rectangular_share == pytest.approx(35 / 37)  # two squares beside the gates stand alone


def test_loops():
    figures = principles(drawn(AISLE), bay=BAY)
    assert figures.loops == 2
    assert figures.dead_ends == ()


@pytest.mark.parametrize(
    ("text", "lengths"),
    [
        ("E===X\n.=...\n.=...\n.=...\n.=...", [32.4]),
        ("E===X\n.=...\n.=...\n.=...", [24.3]),
        ("E===X\n.=.=.\n.=.=.\n.===.", []),
        (".====\n.=...\n.=...\nE==X.", [48.6]),
    ],
)
def test_dead_ends(text, lengths):
    ends = dead_ends(drawn(text))
    assert [round(end.length_m, 1) for end in ends] == lengths
    assert [end.needs_turning_stall for end in ends] == [length > 26 for length in lengths]


def test_shares():
    figures = principles(drawn("......\n======\nE....X"), bay=BAY)
    assert figures.perimeter_share == pytest.approx(10 / 12)
    assert figures.double_loaded_share == 4 / 6
    assert figures.rectangular_share == 1.0
    assert figures.parallel_share == 1.0


def test_compiled_count_is_the_same():
    for seed in range(15):
        site = random_site(seed)
        if site is None:
            continue
        plan = plan_lanes(site, plan=PlanConfig(episodes=30, climb=False), bay=BAY, seed=seed)
        ground = ground_of(site, bay=BAY, plan=PlanConfig())
        for entry in plan.archive[:10]:
            flat = np.pad(entry.structure.cells, 4, constant_values=-1).ravel()
            expected = sum(end.needs_turning_stall for end in dead_ends(entry.structure))
            assert inner_loops.dead_ends(ground, flat) == expected
