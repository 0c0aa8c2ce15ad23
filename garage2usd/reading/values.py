"""Values of a stage: its units and axes, and numbers, which may be of another type than their schema says."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.common.errors import StageError

__all__ = ["READ_AT", "lacks", "metres_per_unit", "metres_y_up", "number_of", "numbers_of", "opinions_of", "vector_of"]

_Scalar = TypeVar("_Scalar", bound=np.generic)
READ_AT = Usd.TimeCode.EarliestTime()
"""When stages are read: at the first time sample of what has samples."""
_Z_UP_TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, -1.0, 0], [0, 1.0, 0, 0], [0, 0, 0, 1.0]])


def metres_y_up(stage: Usd.Stage) -> NDArray[np.float64]:
    """The matrix for row vectors from a stage's coordinates to metres, Y up; float64, shape (4, 4)."""
    matrix = np.eye(4)
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
        matrix = _Z_UP_TO_Y_UP.copy()
    scale = metres_per_unit(stage)
    matrix[:3, :3] *= scale if scale > 0 else 1.0
    return matrix


def metres_per_unit(stage: Usd.Stage) -> float:
    """Metres in a unit of a stage; UsdGeom's own function refuses what some programs write, single precision."""
    return float(stage.GetMetadata(UsdGeom.Tokens.metersPerUnit))


def number_of(attribute: Usd.Attribute) -> float:
    """The number that an attribute holds; 0 for none.

    Raises
    ------
    StageError
        If it holds something else: USD gives whatever a file has, not what the schema says.
    """
    value = attribute.Get(READ_AT)
    try:
        return float(0.0 if value is None else value)
    except (TypeError, ValueError, OverflowError):
        raise lacks(attribute, "numbers") from None


def numbers_of(attribute: Usd.Attribute, dtype: type[_Scalar], *, width: int = 1) -> NDArray[_Scalar]:
    """The numbers that an attribute holds, shape (n, width), or (n,) for a width of 1; none if it has no value.

    Raises
    ------
    StageError
        If it holds something else.
    """
    value = attribute.Get(READ_AT)
    try:
        numbers = np.asarray(() if value is None else value, dtype=dtype)
        return numbers.reshape(-1, width) if width > 1 else numbers.reshape(-1)
    except (TypeError, ValueError, OverflowError):
        raise lacks(attribute, "numbers") from None


def vector_of(attribute: Usd.Attribute, width: int) -> tuple[float, ...]:
    """The first numbers that an attribute holds, each finite.

    Raises
    ------
    StageError
        If it holds fewer, or something else.
    """
    values = numbers_of(attribute, np.float64)
    if len(values) < width:
        raise lacks(attribute, "numbers")
    return tuple(np.nan_to_num(values[:width], posinf=0.0, neginf=0.0).tolist())


def opinions_of(prim: Usd.Prim) -> tuple[tuple[str, str], ...]:
    """Where a prim's own opinions are, by layer and path: prims with the same ones have the same values.

    Prototypes that differ in a variant share most of theirs.
    """
    return tuple((spec.layer.identifier, spec.path.pathString) for spec in prim.GetPrimStack())


def lacks(attribute: Usd.Attribute, what: str) -> StageError:
    """The error of an attribute whose value is not of the type that its schema demands."""
    file = attribute.GetStage().GetRootLayer().realPath
    return StageError(file, f"{attribute.GetPath()} does not hold {what}")
