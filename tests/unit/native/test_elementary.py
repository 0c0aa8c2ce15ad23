"""Elementary functions written anew: their error, their corners, and that the library takes none of the system's."""

import math
import re
import subprocess
import sys

import numpy as np
import pytest
from support.sample_files import REPOSITORY

from garage2usd.native import LIBRARY, elementary

EXACT = {"ceil", "floor", "rint", "sqrt", "fmod", "remainder"}
"""Functions of the C library whose result IEEE 754 and C define to the last bit."""
OF_MEMORY = {"calloc", "free", "malloc", "memcpy", "memset", "memmove"}
LONG = np.longdouble
DRAWN = np.random.default_rng(1)
COUNT = 200_000
SMALL, WIDE = DRAWN.uniform(-7, 7, COUNT), DRAWN.uniform(-1e6, 1e6, COUNT)
QUARTERS = np.arange(-100_000, 100_000) * np.pi / 2
TINY = 10.0 ** DRAWN.uniform(-300, 0, COUNT)
UNIT = np.concatenate([DRAWN.uniform(-1, 1, COUNT), 1 - TINY, TINY, [0.5, -0.5, 0.975, 1.0, -1.0]])
POSITIVE = 10.0 ** DRAWN.uniform(-300, 300, COUNT)
ANGLES = np.concatenate([SMALL, WIDE, QUARTERS, TINY])


def error_ulp(name, *arguments):
    """Largest error in units in the last place, against NumPy with 64 bits of mantissa."""
    exact = getattr(np, name)(*(one.astype(LONG) for one in arguments))
    found = getattr(elementary, name)(*arguments)
    return float(np.max(np.abs(found.astype(LONG) - exact) / np.spacing(np.abs(exact.astype(np.float64)))))


@pytest.mark.skipif(np.finfo(LONG).nmant < 63, reason="long double has no more bits here")
@pytest.mark.parametrize(
    ("name", "arguments", "most_ulp"),
    [
        ("sin", (ANGLES,), 0.85),
        ("cos", (ANGLES,), 0.85),
        ("tan", (ANGLES,), 2.5),
        ("arcsin", (UNIT,), 0.95),
        ("arccos", (UNIT,), 0.95),
        ("arctan", (np.concatenate([SMALL, WIDE, TINY]),), 0.9),
        ("arctan2", (WIDE, SMALL), 1.5),
        ("arctan2", (SMALL, WIDE), 1.5),
        ("arctan2", (SMALL, DRAWN.permutation(SMALL)), 1.5),
        ("hypot", (SMALL, DRAWN.permutation(WIDE)), 1.25),
        ("exp", (DRAWN.uniform(-700, 700, COUNT),), 0.95),
        ("exp", (SMALL * 1e-6,), 0.95),
        ("log", (POSITIVE,), 0.9),
        ("log", (1 + SMALL * 1e-3,), 0.9),
        ("power", (DRAWN.uniform(1e-4, 1, COUNT), 1 / DRAWN.uniform(1, 1e6, COUNT)), 0.95),
        ("power", (DRAWN.uniform(1e-4, 1, COUNT), DRAWN.uniform(0, 3, COUNT)), 40.0),
    ],
)
def test_errors_are_small(name, arguments, most_ulp):
    assert 0.4 < error_ulp(name, *arguments) < most_ulp


@pytest.mark.parametrize("name", ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "exp", "log"])
def test_corners_are_those_of_numpy(name):
    corners = np.array(
        [0.0, -0.0, 1.0, -1.0, 5e-324, -5e-324, 1e-320, 1.0000001, np.inf, -np.inf, np.nan, 709.7, -745.0, 800]
    )
    with np.errstate(all="ignore"):
        expected = getattr(np, name)(corners)
    found = getattr(elementary, name)(corners)
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    assert np.array_equal(np.signbit(found[~np.isnan(found)]), np.signbit(expected[~np.isnan(found)]))
    assert np.allclose(found, expected, rtol=1e-15, atol=5e-324, equal_nan=True)


def test_quadrants_are_those_of_numpy():
    sides = np.array([0.0, -0.0, 1.0, -1.0, np.inf, -np.inf, 5e-324, 1e300])
    y, x = (grid.ravel() for grid in np.meshgrid(sides, sides))
    found, expected = elementary.arctan2(y, x), np.arctan2(y, x)
    is_upright = (x == 0) & (y != 0)
    assert (found[is_upright] == expected[is_upright]).all()
    assert np.array_equal(np.signbit(found), np.signbit(expected))
    assert np.allclose(found, expected, rtol=1e-15, atol=0)


def test_angles_beyond_the_reduction_are_no_numbers():
    assert np.isnan(elementary.sin(1.7e6))
    assert not np.isnan(elementary.sin(1.6e6))


def test_numbers_arrays_and_shapes_agree():
    angles = SMALL[:12].reshape(3, 4)[:, ::2]
    assert elementary.sin(angles).tolist() == [[elementary.sin(one) for one in row] for row in angles.tolist()]
    assert elementary.arctan2(angles, np.ones(2)).tolist() == elementary.arctan(angles).tolist()
    turned = elementary.turned(angles)
    assert turned.real.tolist() == elementary.cos(angles).tolist()
    assert turned.imag.tolist() == elementary.sin(angles).tolist()
    assert elementary.turned(np.array(0.5)).shape == ()
    assert isinstance(elementary.cos(0), float)


@pytest.mark.skipif(sys.platform != "linux", reason="reads the symbols by nm")
def test_the_library_takes_no_rounded_function_of_the_system():
    run = subprocess.run(
        ["nm", "--dynamic", "--undefined-only", str(LIBRARY)], capture_output=True, text=True, check=True
    )
    taken = {name.partition("@")[0] for name in re.findall(r" U (\S+)", run.stdout)}
    assert {"malloc", "free"} <= taken
    assert taken <= EXACT | OF_MEMORY


def test_the_loops_call_no_rounded_function_of_the_system():
    rounded = r"\b(sin|cos|tan|a(sin|cos|tan2?)|exp[2m]?1?|log(2|10|1p)?|pow|hypot|cbrt|fma|sincos)[fl]?\("
    for path in sorted((REPOSITORY / "garage2usd/native").glob("*.[ch]")):
        code = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
        assert re.findall(rounded, code) == [], path.name


def test_zeros_of_either_sign_are_told_apart_though_numbers_are_remembered():
    for _ in range(2):
        assert [math.copysign(1, elementary.sin(zero)) for zero in (0.0, -0.0)] == [1, -1]
        assert [elementary.arctan2(zero, -1.0) for zero in (0.0, -0.0)] == [math.pi, -math.pi]
        # equal keys of what is remembered, so whichever is asked first must not change the other
        assert [elementary.arctan2(1.0, zero) for zero in (-0.0, 0.0)] == [math.pi / 2] * 2
