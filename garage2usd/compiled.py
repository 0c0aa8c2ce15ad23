"""The compiler of numeric loops; imported only by modules that are themselves imported on first use."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba

__all__ = ["compiled", "compiled_inner"]

P = ParamSpec("P")
T = TypeVar("T")


def compiled(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function on its first call and keep the machine code on disk.

    Beside the module where that folder can be written, else in the user's cache folder, else for this process only.
    """
    return _compiled(function)


def compiled_inner(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function that only compiled functions call.

    It gets no way in from Python: unpacking what a function takes is often more code than the function itself, and
    takes as long to compile.
    """
    return _compiled(function, no_cpython_wrapper=True, no_cfunc_wrapper=True)


def _compiled(function: Callable[P, T], **options: bool) -> Callable[P, T]:
    try:
        return cast("Callable[P, T]", numba.njit(cache=True, **options)(function))
    except RuntimeError:  # no folder can be written
        return cast("Callable[P, T]", numba.njit(**options)(function))
