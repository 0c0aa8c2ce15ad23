"""Elementary functions that give the same bits on every machine, for numbers and arrays.

NumPy and the C library round these functions differently from processor to processor. Use this module for each number
that decides a plan, a layout or a drive, or that is written to a file unrounded. `elementary.c` names the methods.
"""

from functools import lru_cache
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from garage2usd.native import Float64s, in_c

Floats = NDArray[np.float64]
F = TypeVar("F", float, Floats)

_SIN, _COS, _TAN, _ARCSIN, _ARCCOS, _ARCTAN, _EXP, _LOG, _ARCTAN2, _HYPOT, _POWER = range(11)


def sin(angle_rad: F) -> F:
    """Sine of angles below 2^20 quarter turns; NaN beyond."""
    return _of(_SIN, angle_rad)


def cos(angle_rad: F) -> F:
    """Cosine of angles below 2^20 quarter turns; NaN beyond."""
    return _of(_COS, angle_rad)


def tan(angle_rad: F) -> F:
    """Tangent of angles below 2^20 quarter turns; NaN beyond."""
    return _of(_TAN, angle_rad)


def turned(angle_rad: Floats) -> NDArray[np.complex128]:
    """Unit complex numbers at angles in radians, of the same shape: cosine + i sine."""
    angles = np.array(angle_rad, np.float64, order="C")
    results = np.empty((*angles.shape, 2))
    _write_turns(angles, results, angles.size)
    return results.view(np.complex128)[..., 0]


def rect(length: float, angle_rad: float) -> complex:
    """Complex number of some length at an angle in radians."""
    return complex(length * cos(angle_rad), length * sin(angle_rad))


def arcsin(sine: F) -> F:
    """Angle in radians from -pi/2 to pi/2; NaN where the sine lies outside -1 to 1."""
    return _of(_ARCSIN, sine)


def arccos(cosine: F) -> F:
    """Angle in radians from 0 to pi; NaN where the cosine lies outside -1 to 1."""
    return _of(_ARCCOS, cosine)


def arctan(tangent: F) -> F:
    """Angle in radians from -pi/2 to pi/2."""
    return _of(_ARCTAN, tangent)


def arctan2(y: F, x: F) -> F:
    """Angle in radians from the x axis to a point, from -pi to pi."""
    return _of(_ARCTAN2, y, x)


def hypot(x: F, y: F) -> F:
    """Length of the hypotenuse of a right triangle, as sqrt(x * x + y * y)."""
    return _of(_HYPOT, x, y)


def exp(exponent: F) -> F:
    """Exponential function."""
    return _of(_EXP, exponent)


def log(value: F) -> F:
    """Natural logarithm; NaN below 0."""
    return _of(_LOG, value)


def power(base: F, exponent: F) -> F:
    """Raise positive numbers to a power, as exp(exponent * log(base)).

    The relative error grows with the size of the exponential's argument, by 1.1e-16 for each unit.
    """
    return _of(_POWER, base, exponent)


def _of(function: int, first: F, second: F | None = None) -> F:
    """Evaluate a function of `elementary.c`; arrays are broadcast."""
    if isinstance(first, int | float) and (second is None or isinstance(second, int | float)):
        # 0 and -0 are equal keys of the cache, so a first argument of 0 is not cached: its sign matters
        return (_remembered if first else _elementary)(function, first, 0.0 if second is None else second)
    given = (first,) if second is None else np.broadcast_arrays(first, second)
    copies = [np.array(values, np.float64, order="C") for values in given]
    results = np.empty_like(copies[0])
    _write_elementary(function, copies[0], copies[-1], results, results.size)
    return results


@in_c
def _elementary(function: int, first: float, second: float) -> float:
    """Evaluate a function of one pair of numbers."""
    raise NotImplementedError


@lru_cache(maxsize=8192)
def _remembered(function: int, first: float, second: float) -> float:
    """Evaluate a function with a cache, as a garage has few different angles and many objects."""
    return _elementary(function, first, second)


@in_c
def _write_elementary(function: int, firsts: Float64s, seconds: Float64s, results: Float64s, count: int) -> None:
    """Evaluate a function of each pair of two arrays."""


@in_c
def _write_turns(angles: Float64s, results: Float64s, count: int) -> None:
    """Write cosine and sine of each angle."""
