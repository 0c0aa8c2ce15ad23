"""What a search says of its own limits; that its ways are right, other tests see."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from garage2usd.driving import way_search as searching
from garage2usd.driving.obstacles import Scene
from garage2usd.driving.way_search import Task, search

NOTHING = np.zeros((0, 4, 2))


def wall(left, top, right, bottom):
    return [(left, top), (right, top), (right, bottom), (left, bottom)]


BOX = np.array([wall(-2, -8, 2, -7), wall(-2, 2, 2, 3), wall(-2, -8, -1.2, 3), wall(1.2, -8, 2, 3)], float)


def task(*, shapes=NOTHING, goal=(0, -0.5, -5.5, 0.5, -4.5), max_nodes=10_000):
    boxes = np.concatenate([shapes.min(axis=1, initial=np.inf), shapes.max(axis=1, initial=-np.inf)], axis=1)
    scene = Scene(shapes, boxes, np.array([3.7, 1.0, 0.9]))
    return Task(scene, np.zeros(3), np.array([goal], float), 4.5, 0.05, 12.0, 0.36, 2, max_nodes)


def looked(asked):
    touched = np.zeros(len(asked.scene.shapes), np.int64)
    found, steps, _ = search(asked, touched)
    return found, steps.tolist(), touched.tolist()


def test_straight_on_where_nothing_stands():
    assert looked(task()) == (1, [[1.0, 0.0, 0.36]] * math.ceil(4.5 / 0.36), [])


def test_no_way_out_of_a_box_each_of_whose_walls_is_counted():
    found, steps, touched = looked(task(shapes=BOX, goal=(0, -0.5, -11.5, 0.5, -10.5)))
    assert (found, steps) == (0, [])
    assert min(touched) > 0


def test_too_few_places_are_another_answer_than_no_way():
    assert looked(task(max_nodes=5)) == (-1, [], [])


def test_places_for_which_there_is_no_memory_raise_an_error(monkeypatch):
    # Python has room for the steps, and C none for the places
    monkeypatch.setattr(
        searching, "np", SimpleNamespace(empty=lambda _: np.zeros((1, 3)), zeros=np.zeros, int64=np.int64)
    )
    with pytest.raises(MemoryError, match="places of a search"):
        looked(task(max_nodes=1 << 45))
