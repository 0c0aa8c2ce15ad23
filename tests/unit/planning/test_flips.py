"""Flips judged by what is around them: never worth more in the whole, and exact where they say so."""

from collections import Counter

import numpy as np
import pytest
from support.inner_loops import FLIPPED, REFUSED, TALLIED, flip_within
from support.planning_reference import BAY, random_site
from support.soak import soak_but

from garage2usd.config import PlanConfig
from garage2usd.planning.board import NO_VALUE, connect, ground_of, measure, new_board


@pytest.mark.parametrize("circulation", soak_but(1, ["allow", "loops"]))
def test_flips_are_refused_only_where_the_whole_is_worth_less(circulation):
    fates = Counter()
    for seed in range(12):
        site = random_site(seed, BAY)
        if site is not None:
            fates += _walk(ground_of(site, bay=BAY, plan=PlanConfig(circulation=circulation)), seed)
    assert min(fates[fate] for fate in (REFUSED, FLIPPED, TALLIED)) > 1000


def _walk(ground, seed):
    """Flip at random on one site, each held to the measured whole; how often each answer came."""
    fates = Counter()
    board, whole = new_board(ground), new_board(ground)
    rng = np.random.default_rng(seed)
    board.cells[ground.squares] = rng.random(len(ground.squares)) < 0.3
    assert connect(ground, board)
    value = measure(ground, board, -np.inf)
    known, hops = board.tally[:3].copy(), board.hops.copy()
    for _ in range(3000):
        q = int(rng.choice(ground.squares))
        p = q + int(rng.choice([0, 1, ground.stride]))
        if board.cells[p] not in (0, 1):
            continue
        least = value - float(rng.exponential(4.0))
        before = board.cells.copy()
        fate = flip_within(ground, board, known, hops, q, p, least)
        flipped = before.copy()
        flipped[[q, p]] = 1 - before[[q, p]]
        whole.cells[:] = flipped
        exact = measure(ground, whole, -np.inf)
        fates[fate] += 1
        assert (board.cells == (before if fate == REFUSED else flipped)).all()
        if fate == REFUSED:
            assert exact < least
        if fate == TALLIED:
            assert exact > NO_VALUE
            lanes = flipped == 1
            assert board.tally[:3].tolist() == whole.tally[:3].tolist()
            assert (hops[lanes] == whole.hops[lanes]).all()
        if fate != REFUSED and exact >= least:
            value, known, hops = exact, whole.tally[:3].copy(), whole.hops.copy()
        else:
            board.cells[:] = before
    return fates
