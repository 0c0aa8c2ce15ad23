"""The compiler of numeric loops; imported only by modules that are themselves imported on first use."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba

__all__ = ["compiled"]

P = ParamSpec("P")
T = TypeVar("T")


def compiled(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function on its first call and keep the machine code on disk.

    Beside the module where that folder can be written, else in the user's cache folder, else for this process only.
    """
    try:
        return cast("Callable[P, T]", numba.njit(cache=True)(function))
    except RuntimeError:  # no folder can be written
        return cast("Callable[P, T]", numba.njit(function))
