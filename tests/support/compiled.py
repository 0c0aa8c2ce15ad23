"""Compiled functions that only compiled ones call, within reach of a test."""

import numba


def from_python(inner):
    """The same function, compiled anew with a way in from Python."""
    return numba.njit(inner.py_func)
