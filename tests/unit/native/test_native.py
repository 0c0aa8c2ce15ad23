"""Python and C agree about what they hand to each other, which nothing else would notice but a crash."""

import shutil

import numpy as np
import pytest
from numpy.typing import NDArray
from support.c_declarations import c_functions, c_structs, python_functions, same_type, size_of

from garage2usd.config import BayConfig, PlanConfig
from garage2usd.driving.obstacles import Scene, least_clearance, touched_shapes
from garage2usd.driving.way_search import Task
from garage2usd.native import LIBRARY, in_c, load, packed
from garage2usd.planning import aisles, annealing, sarsa
from garage2usd.planning.board import ground_of, new_archive, new_board, next_random
from garage2usd.planning.dimensions import sizes_of
from garage2usd.structure.grid import Structure


def test_python_declares_each_function_as_c_has_it():
    in_python, of_c, structs = python_functions(), c_functions(), c_structs()
    assert in_python.keys() == of_c.keys()
    assert len(of_c) > 10
    for name, hints in in_python.items():
        *takes, returns = hints.values()
        assert same_type(returns, of_c[name].returns, structs), name
        assert len(takes) == len(of_c[name].takes), name
        for (argument, hint), c_type in zip(hints.items(), of_c[name].takes, strict=False):
            assert same_type(hint, c_type, structs), f"{name}: {argument} is {hint} in Python, {c_type} in C"


def examples():
    """A named tuple of each class that C takes, as planning and driving make them."""
    cells = np.zeros((7, 9), np.int8)
    cells[6, 2], cells[6, 6] = 2, 3
    ground = ground_of(Structure.from_arrays(cells, 8.1, 8.1), bay=BayConfig(), plan=PlanConfig())
    parameters, archive = PlanConfig().resolved(), new_archive(3, padded=len(ground.cells), steps=5)
    sizes, runs = sizes_of(ground, BayConfig()), aisles.runs_of(ground)
    scene = Scene(np.zeros((2, 4, 2)), np.zeros((2, 4)), np.zeros(3))
    made = (
        ground, new_board(ground), parameters, archive, sizes, runs, scene, annealing.new_trial_move(ground),
        sarsa.new_memory(parameters, bits=4), sarsa.new_room(ground, archive), annealing.new_workspace(ground, sizes),
        aisles.new_room(ground, runs), Task(scene, np.zeros(3), np.zeros((1, 5)), 6.0, 0.1, 9.0, 0.5, 3, 10),
    )  # fmt: skip
    return {type(value): value for value in made}


def test_named_tuples_are_as_long_as_their_structs():
    made, structs, met = examples(), c_structs(), set()
    functions = c_functions()
    for name, hints in python_functions().items():
        for hint, c_type in zip(hints.values(), functions[name].takes, strict=False):
            if hint in made:
                met.add(hint)
                assert len(packed(hint, made[hint])) == size_of(c_type[:-1], structs), c_type
    assert met == made.keys()


def test_arrays_of_other_numbers_or_with_gaps_are_refused():
    for array in (np.zeros(1, np.int64), np.zeros((2, 2), np.uint64).T):
        with pytest.raises(TypeError, match="uint64"):
            next_random(array)


def test_read_only_arrays_are_refused_as_c_may_write_them():
    random = np.ones(1, np.uint64)
    random.flags.writeable = False
    with pytest.raises(TypeError, match="read-only"):
        next_random(random)
    assert random[0] == 1


def test_arrays_without_numbers_are_taken():
    scene = Scene(np.zeros((0, 4, 2)), np.zeros((0, 4)), np.zeros(3))
    assert least_clearance(scene, np.zeros((2, 3)), np.zeros(1), 9.0) == 9.0
    assert len(touched_shapes(scene, np.zeros(3), 0.1)) == 0


def test_fields_with_other_dimensions_are_refused():
    for scene in (
        Scene(np.zeros((2, 4, 2)), np.zeros(8), np.zeros(3)),
        Scene(np.zeros((8, 2)), np.zeros((2, 4)), np.zeros(3)),
    ):
        with pytest.raises(TypeError, match="dimensions in Scene, where C takes"):
            touched_shapes(scene, np.zeros(3), 0.1)


def test_an_annotation_that_c_does_not_know_is_refused():
    def counts(numbers: NDArray[np.int64]) -> int:
        """Lacks the note of what numbers are in it."""

    with pytest.raises(TypeError, match="annotated as Int64s"):
        in_c(counts)


def test_a_missing_library_says_what_to_do(tmp_path):
    with pytest.raises(RuntimeError, match="install garage2usd"):
        load(tmp_path / "loops.so")


def test_a_library_of_other_sources_is_refused(tmp_path):
    for path in LIBRARY.parent.iterdir():
        if path.suffix in {".c", ".h", ".so"}:
            shutil.copy(path, tmp_path)
    copied = tmp_path / LIBRARY.name
    load(copied)
    with (tmp_path / "planning.h").open("a") as header:
        header.write("/* another struct */\n")
    load.cache_clear()
    with pytest.raises(RuntimeError, match=r"is stale: .* hatch_build\.py"):
        load(copied)


def test_arguments_by_keyword_are_refused():
    with pytest.raises(TypeError, match="by position alone, not random by name"):
        next_random(random=np.zeros(1, np.uint64))
