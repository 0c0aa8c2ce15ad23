"""By ctypes, with NumPy's `ndpointer` for arrays and a `Structure` for the named tuple."""

import ctypes
from pathlib import Path
from typing import Any

import numpy as np
from numpy.ctypeslib import ndpointer

_CUBE, _TABLE, _ROW = (ndpointer(np.float64, ndim=dimensions, flags="C") for dimensions in (3, 2, 1))
_FLAGS = ndpointer(np.bool_, ndim=1, flags="C,W")


class _Scene(ctypes.Structure):
    _fields_ = (
        ("shapes", ctypes.c_void_p), ("layers", ctypes.c_int64), ("rows", ctypes.c_int64), ("columns", ctypes.c_int64),
        ("boxes", ctypes.c_void_p), ("box_rows", ctypes.c_int64), ("box_columns", ctypes.c_int64),
        ("body", ctypes.c_void_p), ("count", ctypes.c_int64),
    )  # fmt: skip


_library = ctypes.CDLL(str(next((Path(__file__).parents[2] / "garage2usd" / "native").glob("loops.so"))))
_least_along, _mark_touched = _library.least_along, _library.mark_touched
_least_along.argtypes = [ctypes.POINTER(_Scene), _TABLE, ctypes.c_int64, _ROW, ctypes.c_double]
_least_along.restype = ctypes.c_double
_mark_touched.argtypes, _mark_touched.restype = [ctypes.POINTER(_Scene), _ROW, ctypes.c_double, _FLAGS], None


def _packed(scene: Any) -> _Scene:  # noqa: ANN401 - a named tuple
    words = []
    for kind, array in zip((_CUBE, _TABLE, _ROW), scene, strict=True):
        kind.from_param(array)
        words += [array.ctypes.data, *array.shape]
    return _Scene(*words)


def least_along(scene: Any, poses: Any, steps: int, bulges: Any, most: float) -> float:  # noqa: ANN401 - arrays
    """Return the least clearance along poses."""
    return _least_along(_packed(scene), poses, steps, bulges, most)


def mark_touched(scene: Any, pose: Any, margin: float, is_touched: Any) -> None:  # noqa: ANN401 - arrays
    """Mark the shapes that a car at a pose touches."""
    _mark_touched(_packed(scene), pose, margin, is_touched)
