"""Figures of variety, held to computations by hand and brute force."""

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.drawn_plan import ContourShape, contour_shape
from garage2usd.datasets.variety import FIGURES, PlanFigures, Variety, nearest_shares
from garage2usd.structure.grid import cells_from_text
from garage2usd.structure.symmetry import canonical_cells, eight_symmetries


def plan(key, split, drawing, **figures):
    cells = cells_from_text(drawing, field="S")
    known = {"stalls": 4, "loops": 0, "longest_dead_end_m": 8.1, "area_per_stall_m2": 30.0}
    return PlanFigures(key, split, cells, contour=contour_shape(cells), **{**known, **figures})


def nearest_by_hand(plans):
    shares = []
    for number, cells in enumerate(plans):
        others = [
            np.mean(cells != image)
            for other, candidate in enumerate(plans)
            if other != number
            for image in eight_symmetries(candidate)
            if image.shape == cells.shape
        ]
        shares.append(min(others, default=np.nan))
    return shares


@st.composite
def sets_of_plans(draw):
    shapes = draw(st.lists(st.sampled_from([(2, 3), (3, 3), (2, 2)]), max_size=7))
    cells = st.sampled_from((-1, 0, 1, 2, 3))
    return [
        canonical_cells(
            np.array(draw(st.lists(cells, min_size=rows * cols, max_size=rows * cols)), np.int8).reshape(rows, cols)
        )
        for rows, cols in shapes
    ]


@settings(deadline=None)
@given(sets_of_plans())
def test_the_nearest_plan_is_that_of_brute_force(plans):
    plans = [cells for cells in plans if cells.size]
    assert nearest_shares(plans) == pytest.approx(nearest_by_hand(plans), nan_ok=True, abs=1e-12)


def test_more_plans_than_are_compared_at_once(monkeypatch):
    monkeypatch.setattr("garage2usd.datasets.variety._ROWS_AT_ONCE", 4)
    draw = np.random.default_rng(0)
    plans = [canonical_cells(draw.integers(0, 4, (3, 4)).astype(np.int8)) for _ in range(11)]
    assert nearest_shares(plans) == pytest.approx(nearest_by_hand(plans), abs=1e-12)


def test_the_same_plan_turned_is_at_no_distance():
    one = plan("a", "train", "E==\n...\nX==")
    turned = plan("b", "train", "E.X\n=.=\n=.=")
    alone = plan("c", "train", "E=X")
    assert Variety([one, turned, alone]).nearest_share.tolist() == pytest.approx([0, 0, np.nan], nan_ok=True)


def test_two_thousand_plans_take_seconds():
    draw = np.random.default_rng(0)
    plans = [canonical_cells(draw.integers(0, 2, (7, 9)).astype(np.int8)) for _ in range(2000)]
    start = time.perf_counter()
    shares = nearest_shares(plans)
    assert time.perf_counter() - start < 20
    assert (shares > 0).all()


@pytest.mark.parametrize(
    ("drawing", "shape"),
    [
        ("...\n...", ContourShape.RECTANGLE),
        ("..##\n..##\n....", ContourShape.L),
        ("...\n#.#\n#.#", ContourShape.T),
        ("....\n##.#", ContourShape.T),
        (".#.\n.#.\n...", ContourShape.U),
        ("..#\n...\n#..", ContourShape.OTHER),
        ("#..\n#..\n...\n..#", ContourShape.OTHER),
        ("..##\n...#\n....", ContourShape.OTHER),
        (".#.", ContourShape.OTHER),
        (".#\n#.", ContourShape.OTHER),
        ("...\n.#.\n...", ContourShape.RECTANGLE),
        ("#.#\n...\n#.#", ContourShape.OTHER),
        ("=E=\n.X.", ContourShape.RECTANGLE),
    ],
)
def test_contours_have_their_shape_however_they_are_turned(drawing, shape):
    cells = cells_from_text(drawing, field="S")
    for image in eight_symmetries(np.pad(cells, 1, constant_values=-1)):
        assert contour_shape(image) is shape


def test_ground_that_is_all_outside_has_no_shape():
    assert contour_shape(np.full((2, 2), -1, dtype=np.int8)) is ContourShape.OTHER


def test_figures_of_splits_are_those_of_their_plans():
    plans = [
        plan("a", "train", "E==\n...\nX==", stalls=4, loops=1, level=Level.NORMAL),
        plan("b", "val", "E==\n..#\nX==", stalls=6, loops=0, level=Level.EXTREME),
        plan("c", "train", "E=X\n#.#", stalls=2, loops=0, longest_dead_end_m=0.0),
        plan("d", "val", "E=X\n#.#", stalls=3),
    ]
    variety = Variety(plans)
    assert variety.splits == ("train", "val")
    assert variety.values("stalls").tolist() == [4, 6, 2, 3]
    assert variety.values("squares", split="val").tolist() == [8, 4]
    assert variety.values("nearest_share").tolist() == pytest.approx([100 / 9, 100 / 9, 0, 0])
    train = variety.spread("stalls", split="train")
    assert (train.count, train.least, train.mean, train.greatest) == (2, 2, 3, 4)
    assert variety.spread("longest_dead_end_m").mean == pytest.approx(6.075)
    assert variety.contours() == {
        ContourShape.RECTANGLE: 1,
        ContourShape.L: 0,
        ContourShape.T: 2,
        ContourShape.U: 1,
        ContourShape.OTHER: 0,
    }
    assert variety.levels(split="train") == {Level.NORMAL: 1, Level.COMPLEX: 0, Level.EXTREME: 0}
    assert (variety.distinct, variety.shared) == (3, 1)
    for figure in FIGURES:
        assert variety.spread(figure, split="none").count == 0


def test_a_plan_that_is_alone_in_its_shape_has_no_nearest_one():
    variety = Variety([plan("a", "train", "E=X\n...")])
    assert variety.spread("nearest_share").count == 0
    assert variety.spread("nearest_share").mean is None
    assert Variety([]).splits == ()
