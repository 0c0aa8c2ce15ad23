"""The compiler of numeric loops; imported only by modules that are themselves imported on first use."""

from collections.abc import Callable
from typing import ParamSpec, TypeVar, cast

import numba
import numpy as np
from numba.core.event import Event, Listener, register
from numpy.typing import NDArray

from garage2usd.progress import compiling

__all__ = ["Whole", "compiled", "compiled_allocating", "compiled_inner", "copy_row"]

P = ParamSpec("P")
T = TypeVar("T")

Whole = int | np.int64
"""A whole number that compiled code hands on; constants are of np.int64, as Numba compiles a function again for each
literal."""


def compiled(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function on its first call and keep the machine code on disk.

    Beside the module where that folder can be written, else in the user's cache folder, else for this process only.
    The function makes no array, so that the compiler need not count references, which is half of its work: arrays come
    from whoever calls.
    """
    return _compiled(function, is_inner=False, allocates=False)


def compiled_allocating(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function that makes arrays or lists of its own."""
    return _compiled(function, is_inner=False, allocates=True)


def compiled_inner(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function that only compiled functions call.

    It gets no way in from Python: unpacking what a function takes is often more code than the function itself, and
    takes as long to compile.
    """
    return _compiled(function, is_inner=True, allocates=False)


def compiled_inlined(function: Callable[P, T]) -> Callable[P, T]:
    """Compile a function as a part of the one compiled function that calls it."""
    return cast("Callable[P, T]", numba.njit(inline="always")(function))


def _compiled(function: Callable[P, T], *, is_inner: bool, allocates: bool) -> Callable[P, T]:
    def jit(*, cache: bool) -> Callable[P, T]:
        # its stubs lack these options; nothing here is called from C
        made = numba.njit(  # type: ignore[call-overload]
            cache=cache, no_cpython_wrapper=is_inner, no_cfunc_wrapper=True, _nrt=allocates
        )
        return cast("Callable[P, T]", made(function))

    try:
        return jit(cache=True)
    except RuntimeError:  # no folder can be written
        return jit(cache=False)


class _Compilations(Listener):
    """Passes on what is compiled, which is nothing once it lies in the cache."""

    def on_start(self, event: Event) -> None:
        """Pass on which module's function it is."""
        compiling(event.data["dispatcher"].__module__)

    def on_end(self, event: Event) -> None:
        """Pass nothing on."""


register("numba:compile", _Compilations())  # type: ignore[no-untyped-call]


@compiled_inner
def copy_row(target: NDArray[np.generic], source: NDArray[np.generic]) -> None:
    """Copy the numbers of one row over the first of another.

    A loop, as Numba compiles the error messages of a slice assignment for seconds.
    """
    for index in range(len(source)):
        target[index] = source[index]
