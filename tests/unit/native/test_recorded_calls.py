"""Calls of the loops in C, recorded on one machine and repeated on another."""

import gzip
import importlib.util
import pickle
import subprocess
import sys

import numpy as np
import pytest
from support.sample_files import REPOSITORY

from garage2usd.driving.obstacles import Scene
from garage2usd.native import LIBRARY, Float64s, UInt64s


@pytest.fixture
def recorded(tmp_path):
    """A recording of three calls: of numbers, of an array that changes, and of a struct of arrays."""
    spec = importlib.util.spec_from_file_location("release_windows", REPOSITORY / "release/windows.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)

    def elementary(function: int, x: float, y: float) -> float: ...
    def next_random(random: UInt64s) -> np.uint64: ...
    def least_along(scene: Scene, poses: Float64s, steps: int, bulges: Float64s, most: float) -> float: ...

    wall = np.array([[(-2, -8), (2, -8), (2, -7), (-2, -7)]], float)
    scene = Scene(wall, np.concatenate([wall.min(axis=1), wall.max(axis=1)], axis=1), np.array([3.7, 1.0, 0.9]))
    poses = np.array([[0.0, 0.0, 0.0], [0.0, -1.0, 0.1]])
    with gzip.open(tmp_path / "calls.gz", "wb") as file:
        bind = module.Recorder(file).in_c
        bind(elementary)(0, 1.25, 0.0)
        bind(next_random)(np.array([7], np.uint64))
        assert bind(least_along)(scene, poses, 1, np.zeros(1), 9.0) < 9.0
    return tmp_path / "calls.gz"


def replay(calls):
    command = [sys.executable, str(REPOSITORY / "release/replay.py"), str(LIBRARY), str(calls)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


def changed(calls, key, value):
    """Change an entry of every call of a recording."""
    with gzip.open(calls) as file:
        made = [pickle.load(file) | {key: value} for _ in range(3)]  # noqa: S301 - our own
    with gzip.open(calls, "wb") as file:
        for call in made:
            pickle.dump(call, file)


def test_the_same_library_gives_the_same_bits(recorded):
    run = replay(recorded)
    assert (run.returncode, run.stdout.splitlines()[-1]) == (0, "3 calls of 3 functions, 0 differ"), run.stderr


@pytest.mark.parametrize(("key", "value", "differ"), [("result", b"\0" * 8, 3), ("after", [b"other"], 3)])
def test_another_result_or_array_is_found(recorded, key, value, differ):
    changed(recorded, key, value)
    run = replay(recorded)
    assert (run.returncode, run.stdout.splitlines()[-1]) == (1, f"3 calls of 3 functions, {differ} differ")
