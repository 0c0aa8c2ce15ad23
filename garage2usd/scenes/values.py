"""Values of a stage: its units and axes, and numbers, whose type may differ from the schema."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.common.errors import StageError

_Scalar = TypeVar("_Scalar", bound=np.generic)
READ_AT = Usd.TimeCode.EarliestTime()
"""Time code at which stages are read: the earliest, so the first time sample of animated attributes."""
Z_UP_TO_Y_UP = np.array([[1.0, 0, 0, 0], [0, 0, -1.0, 0], [0, 1.0, 0, 0], [0, 0, 0, 1.0]])
"""Exchange of the axes of a stage whose Z points up, for row vectors."""


def metres_y_up(stage: Usd.Stage) -> NDArray[np.float64]:
    """Return the matrix for row vectors from a stage's coordinates to metres, Y up; float64, shape (4, 4)."""
    matrix = np.eye(4)
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
        matrix = Z_UP_TO_Y_UP.copy()
    scale = metres_per_unit(stage)
    matrix[:3, :3] *= scale if scale > 0 else 1.0
    return matrix


def up_axis(stage: Usd.Stage) -> int:
    """Return the index of the axis of a stage that points up: 1 for Y, 2 for Z."""
    return 2 if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z else 1


def metres_per_unit(stage: Usd.Stage) -> float:
    """Return the metres per unit of a stage; reads single-precision values too, unlike UsdGeom's function."""
    return float(stage.GetMetadata(UsdGeom.Tokens.metersPerUnit))


def number_of(attribute: Usd.Attribute) -> float:
    """Return the number in an attribute; 0 without a value.

    Raises
    ------
    StageError
        If the value is not a number: USD returns the type in the file, not that of the schema.
    """
    value = attribute.Get(READ_AT)
    try:
        return float(0.0 if value is None else value)
    except (TypeError, ValueError, OverflowError):
        raise lacks(attribute, "numbers") from None


def numbers_of(attribute: Usd.Attribute, dtype: type[_Scalar], *, width: int = 1) -> NDArray[_Scalar]:
    """Return the numbers in an attribute, shape (n, width), or (n,) for a width of 1; none without a value.

    Raises
    ------
    StageError
        If the value has another type.
    """
    value = attribute.Get(READ_AT)
    try:
        numbers = np.asarray(() if value is None else value, dtype=dtype)
        return numbers.reshape(-1, width) if width > 1 else numbers.reshape(-1)
    except (TypeError, ValueError, OverflowError):
        raise lacks(attribute, "numbers") from None


def vector_of(attribute: Usd.Attribute, width: int) -> tuple[float, ...]:
    """Return the first numbers in an attribute, all finite.

    Raises
    ------
    StageError
        If the value has fewer numbers, or another type.
    """
    values = numbers_of(attribute, np.float64)
    if len(values) < width:
        raise lacks(attribute, "numbers")
    return tuple(np.nan_to_num(values[:width], posinf=0.0, neginf=0.0).tolist())


def opinions_of(prim: Usd.Prim) -> tuple[tuple[str, str], ...]:
    """Return layer and path of a prim's own opinions; prims with the same opinions have the same values.

    Prototypes that differ in a variant share most of their opinions.
    """
    return tuple((spec.layer.identifier, spec.path.pathString) for spec in prim.GetPrimStack())


def lacks(attribute: Usd.Attribute, what: str) -> StageError:
    """Return the error of an attribute whose value does not have the type of its schema."""
    file = attribute.GetStage().GetRootLayer().realPath
    return StageError(file, f"{attribute.GetPath()} does not hold {what}")
