from itertools import pairwise

import pytest

from garage2usd.common.errors import ConfigError
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lanes import LaneDirections, given_directions, stretches_of

EIGHT = """
E=====X
.=.=.=.
.=====.
"""
RING = """
...
E==
.=="""


def structure_of(text):
    return Structure.from_arrays(cells_from_text(text, field="S"), 8.0, 8.0)


def test_stretches_lead_from_one_junction_or_tip_to_the_next_and_have_each_step_once():
    structure = structure_of(EIGHT)
    stretches = stretches_of(structure)
    steps = [frozenset(step) for stretch in stretches for step in pairwise(stretch)]
    assert len(steps) == len(set(steps)) == 14
    assert [(stretch[0], stretch[-1]) for stretch in stretches] == [((0, 3), (2, 3))] * 3


def test_a_ring_is_one_stretch_that_ends_where_it_begins():
    (stretch,) = stretches_of(structure_of(RING))
    assert stretch[0] == stretch[-1]
    assert len(stretch) == 5


def test_a_given_step_turns_its_whole_stretch():
    structure = structure_of(EIGHT)
    directions = given_directions(structure, [((0, 2), (0, 1))], field="one_way")
    (stretch,) = directions.stretches(structure)
    assert stretch == ((0, 3), (0, 2), (0, 1), (1, 1), (2, 1), (2, 2), (2, 3))
    assert directions.allows((0, 2), (0, 1))
    assert not directions.allows((0, 1), (0, 2))
    assert directions.is_one_way((0, 1), (0, 2))
    assert not directions.is_one_way((1, 3), (0, 3))
    assert directions == LaneDirections.of_stretches([stretch])


def test_a_ring_can_be_turned_both_ways_round():
    structure = structure_of(RING)
    one, other = (given_directions(structure, [step], field="one_way") for step in (((1, 1), (1, 2)), ((1, 2), (1, 1))))
    assert one.one_way == {(end, start) for start, end in other.one_way}
    assert len(one.one_way) == 4


@pytest.mark.parametrize(
    ("steps", "index", "allowed"),
    [
        ([((0, 1), (0, 3))], 0, "adjacent"),
        ([((0, 0), (0, 1))], 0, "lane square"),
        ([((9, 9), (9, 8))], 0, "lane square"),
        ([((0, 2), (0, 1)), ((2, 1), (1, 1))], 1, "direction of the step given before"),
    ],
)
def test_steps_that_are_none_are_refused_by_their_number(steps, index, allowed):
    with pytest.raises(ConfigError) as error:
        given_directions(structure_of(EIGHT), steps, field="plan.one_way")
    assert error.value.field == f"plan.one_way[{index}]"
    assert allowed in str(error.value)
