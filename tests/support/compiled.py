"""Compiled functions that only compiled ones call, within reach of a test."""

import numba


def from_python(inner):
    """A way in from Python to a function that is compiled without one."""

    @numba.njit
    def outer(*arguments):
        return inner(*arguments)

    return outer
