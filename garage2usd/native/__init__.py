"""Compiled C loops behind Python functions: declared in Python, implemented in the `.c` files of this folder.

The C files are compiled into one library when garage2usd is installed. The library does not link to Python.
"""

import ctypes
import functools
import struct
import typing
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from pathlib import Path
from typing import Annotated, Any, NamedTuple, ParamSpec, TypeVar, cast, get_type_hints

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.system import LIBRARY_SUFFIX
from garage2usd.native.digest import digest_of

__all__ = [
    "LIBRARY",
    "BoolTable",
    "Bools",
    "Float32Table",
    "Float32s",
    "Float64Cube",
    "Float64Table",
    "Float64s",
    "Int8Table",
    "Int8s",
    "Int32Cube",
    "Int32Table",
    "Int32s",
    "Int64Cube",
    "Int64Table",
    "Int64s",
    "UInt64s",
    "in_c",
    "load",
    "numbers_of",
    "packed",
    "using",
]

# Annotations of arrays for C name the element type, as the internals of `NDArray` differ between versions of NumPy.
Bools = Annotated[NDArray[np.bool_], np.dtype(np.bool_)]
Int8s = Annotated[NDArray[np.int8], np.dtype(np.int8)]
Int32s = Annotated[NDArray[np.int32], np.dtype(np.int32)]
Int64s = Annotated[NDArray[np.int64], np.dtype(np.int64)]
UInt64s = Annotated[NDArray[np.uint64], np.dtype(np.uint64)]
Float32s = Annotated[NDArray[np.float32], np.dtype(np.float32)]
Float64s = Annotated[NDArray[np.float64], np.dtype(np.float64)]

# Array fields of named tuples also name the number of dimensions if it is two or three.
BoolTable = Annotated[Bools, 2]
Int8Table = Annotated[Int8s, 2]
Int32Table = Annotated[Int32s, 2]
Int64Table = Annotated[Int64s, 2]
Float32Table = Annotated[Float32s, 2]
Float64Table = Annotated[Float64s, 2]
Int32Cube = Annotated[Int32s, 3]
Int64Cube = Annotated[Int64s, 3]
Float64Cube = Annotated[Float64s, 3]

P = ParamSpec("P")
T = TypeVar("T")

LIBRARY = Path(__file__).with_name(f"loops{LIBRARY_SUFFIX}")
"""Path of the shared library that `hatch_build.py` compiles from the C files."""
_CALLED = ContextVar("called", default=LIBRARY)

_NUMBERS: dict[Any, tuple[Callable[[Any], Any], Any]] = {
    bool: (bool, ctypes.c_bool),
    int: (int, ctypes.c_int64),
    float: (float, ctypes.c_double),
    np.uint64: (int, ctypes.c_uint64),
}


@functools.cache
def load(path: Path = LIBRARY) -> ctypes.CDLL:
    """Open the shared library of compiled C loops.

    Raises
    ------
    RuntimeError
        If the library is missing, or was compiled from other C files, whose structs may have another layout.
    """
    remedy = "install garage2usd, or run python hatch_build.py in its repository"
    if not path.exists():
        raise RuntimeError(f"{path} is missing: {remedy}")
    library, expected = ctypes.CDLL(str(path)), digest_of(path.parent)
    try:
        compiled = (ctypes.c_char * len(expected)).in_dll(library, "sources_digest").raw.decode()
    except ValueError:  # an old library without a digest
        compiled = "none"
    if compiled != expected:
        raise RuntimeError(
            f"{path} is stale: its C files have digest {expected}, it was compiled from {compiled}: {remedy}"
        )
    return library


@contextmanager
def using(library: Path) -> Iterator[None]:
    """Call the C functions of another shared library, such as one with an injected fault."""
    token = _CALLED.set(library)
    try:
        yield
    finally:
        _CALLED.reset(token)


def in_c(function: Callable[P, T]) -> Callable[P, T]:
    """Bind a Python declaration to the C function of the same name without its leading underscore.

    The body of the decorated function never runs. Named tuples are passed by the address of their fields, which
    `planning.h` declares in the same order. Arrays are passed by the address of their first number, numbers by value.
    Arrays are annotated as `Int64s` and the like. Fields of named tuples with two or three dimensions are annotated as
    `Int64Table` or `Int64Cube` and the like. Arguments are positional.

    Raises
    ------
    TypeError
        If an annotation is none of these; when called, if an argument is given by keyword, if an array has another
        type than annotated, is not contiguous or is read-only, or if a field has another number of dimensions.
    """
    hints = get_type_hints(function, include_extras=True)
    returns = hints.pop("return")
    packers = [_packer(hint) for hint in hints.values()]

    @functools.cache
    def symbol(library: Path) -> Callable[..., Any]:
        found = load(library)[function.__name__.lstrip("_")]
        found.argtypes = [kind for _, kind in packers]
        found.restype = None if returns is type(None) else _NUMBERS[returns][1]
        return found

    @functools.wraps(function)
    def call(*values: P.args, **named: P.kwargs) -> T:
        if named:
            raise TypeError(
                f"{function.__name__} takes its arguments by position alone, not {', '.join(named)} by name"
            )
        packed = [pack(value) for (pack, _), value in zip(packers, values, strict=True)]
        return cast("T", symbol(_CALLED.get())(*packed))

    return call


def numbers_of(hint: Any) -> np.dtype[Any] | None:  # noqa: ANN401 - an annotation
    """Return the NumPy scalar type of an array annotation such as `Int64s`; None for other annotations."""
    return next((one for one in typing.get_args(hint)[1:] if isinstance(one, np.dtype)), None)


def _packer(hint: Any) -> tuple[Callable[[Any], Any], Any]:  # noqa: ANN401 - an annotation
    """Return the function that converts an argument of some annotation for C, and its ctypes type."""
    if hint in _NUMBERS:
        return _NUMBERS[hint]
    dtype = numbers_of(hint)
    if dtype is not None:
        return functools.partial(_address, dtype), ctypes.c_void_p
    if not hasattr(hint, "_fields"):
        raise TypeError(f"C takes numbers, named tuples, and arrays annotated as Int64s and the like; not {hint}")
    return functools.partial(packed, hint), ctypes.c_char_p


def packed(kind: type, value: Any) -> bytes:  # noqa: ANN401 - a named tuple
    """Pack a named tuple as its C struct."""
    numbers: list[int | float] = []
    _add_numbers(kind, value, numbers)
    return _layout(kind).pack(*numbers)


class _Field(NamedTuple):
    """Layout of a field of a named tuple: type and dimensions of an array, a nested named tuple, or a plain number."""

    dtype: np.dtype[Any] | None
    dimensions: int
    inner: type | None


def _add_numbers(kind: type, value: Any, numbers: list[int | float]) -> None:  # noqa: ANN401 - a named tuple
    """Add the fields of a named tuple as the 8-byte words of its C struct."""
    for field, (dtype, dimensions, inner) in zip(value, _fields(kind), strict=True):
        if dtype is not None:
            numbers.append(_address(dtype, field))
            if field.ndim != dimensions:
                raise TypeError(f"an array of {field.ndim} dimensions in {kind.__name__}, where C takes {dimensions}")
            numbers.extend(field.shape)
        elif inner is not None:
            _add_numbers(inner, field, numbers)
        else:
            numbers.append(field)


@functools.cache
def _layout(kind: type) -> struct.Struct:
    """Compile the layout of the C struct of a named tuple."""

    def words(kind: type) -> str:
        letters = []
        for (dtype, dimensions, inner), hint in zip(_fields(kind), get_type_hints(kind).values(), strict=True):
            if dtype is not None:
                letters.append("q" * (1 + dimensions))
            else:
                letters.append(words(inner) if inner is not None else "d" if hint is float else "q")
        return "".join(letters)

    return struct.Struct(f"={words(kind)}")


@functools.cache
def _fields(kind: type) -> tuple[_Field, ...]:
    """Read the annotations of a named tuple's fields."""
    fields = []
    for hint in get_type_hints(kind, include_extras=True).values():
        dimensions = next((one for one in typing.get_args(hint)[1:] if isinstance(one, int)), 1)
        fields.append(_Field(numbers_of(hint), dimensions, hint if hasattr(hint, "_fields") else None))
    return tuple(fields)


def _address(dtype: np.dtype[Any], array: np.ndarray[Any, Any]) -> int:
    """Return the address of an array's first number."""
    if array.dtype == dtype:
        try:  # takes a third of the time of NumPy's own function, but only for contiguous, writable arrays
            return _address_of(_first_byte(array.data))
        except (TypeError, ValueError):
            if array.size == 0:
                return array.ctypes.data
    told = f"strides {array.strides}{'' if array.flags.writeable else ', read-only'}"
    raise TypeError(f"an array of {array.dtype}, {told}, where C takes {dtype} side by side that it may write")


_address_of, _first_byte = ctypes.addressof, ctypes.c_char.from_buffer
