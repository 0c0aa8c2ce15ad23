"""The garage of a stage that someone edited: shown whole, and in its own frame wherever it was moved to."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom

from garage2usd.common.errors import StageError
from garage2usd.reading.files import open_stage
from garage2usd.scenes.values import READ_AT, Z_UP_TO_Y_UP, metres_y_up

__all__ = ["GRAPH", "LEVELS", "garage_root", "in_own_frame", "open_garage"]

LEVELS = "Levels"
"""Name of the prim below the root that holds the levels of a garage of several."""
GRAPH = "LaneGraph"
"""Name of the prim below the root that holds the lane graph."""
_SHOWN = {"level": "all", "ceiling": "shown"}
"""Variants that hide nothing, by variant set."""
_FRAME = "ownFrame"
_SAME = 1e-9
_DIGITS = 9
_LEAST_SCALE = 1e-9

_Matrix = NDArray[np.float64]


def open_garage(path: Path) -> Usd.Stage:
    """Open a stage to read its garage; raises as `garage2usd.reading.files.open_stage`.

    Notes
    -----
    Positions, hidden levels and selected views are for looking at a garage and change nothing about it. The stage's
    session layer puts the garage back into its own frame, without turn and shift but with its scale, and shows its
    levels, its groups and its ceiling. A single hidden object is no part of the garage.
    """
    stage = open_stage(path)
    root = garage_root(stage)
    if root and (root.GetChild(GRAPH) or root.GetChild(LEVELS)):
        with Usd.EditContext(stage, stage.GetSessionLayer()):
            _show(root)
            _put_back(stage, root)
    return stage


def garage_root(stage: Usd.Stage) -> Usd.Prim:
    """Return the root of a garage: the default prim, or in a stage that refers to a garage the parent of its lanes."""
    root = stage.GetDefaultPrim()
    if root and (root.GetChild(GRAPH) or root.GetChild(LEVELS)):
        return root
    graph = next((prim for prim in stage.Traverse() if prim.GetName() == GRAPH), None)
    return root if graph is None else graph.GetParent()


def in_own_frame(to_world: _Matrix) -> _Matrix | None:
    """Return the part of a transform that is no turn and no shift: its scale, and the exchange of axes to Y up.

    Parameters
    ----------
    to_world
        From a prim's coordinates to the world's, in metres with Y up, for row vectors; float64, shape (4, 4).

    Returns
    -------
    ndarray or None
        From the prim's coordinates to metres with Y up; None for a scale of 0.
    """
    left, scales, right = np.linalg.svd(to_world[:3, :3])
    if scales.min() < _LEAST_SCALE:
        return None
    size, turn = (left * scales) @ left.T, left @ right
    if np.linalg.det(turn) < 0:  # a mirrored garage stays mirrored
        mirror = np.diag([-1.0, 1.0, 1.0])
        size, turn = size @ mirror, mirror @ turn
    own = np.eye(4)
    axes = np.eye(3) if abs(turn[1, 1]) >= abs(turn[2, 1]) else Z_UP_TO_Y_UP[:3, :3]
    own[:3, :3] = np.round(size @ axes, _DIGITS)
    return own


def _show(root: Usd.Prim) -> None:
    """Select the variants that hide nothing, and show the groups and levels of a garage.

    The opinions are on each level itself too, which is also read as a stage of its own.
    """
    wholes = [root, *_levels(root)]
    above = (prefix for path in root.GetPath().GetPrefixes() if (prefix := root.GetStage().GetPrimAtPath(path)))
    prims = [*above, *wholes, *(group for whole in wholes for group in whole.GetChildren())]
    hidden = [attribute for prim in prims if (attribute := _invisible(prim))]
    sets = [(prim.GetVariantSets(), name, shown) for prim in wholes for name, shown in _SHOWN.items()]
    chosen = [
        (found.GetVariantSet(name), shown)
        for found, name, shown in sets
        if found.HasVariantSet(name)
        and found.GetVariantSelection(name) not in {"", shown}
        and shown in found.GetVariantSet(name).GetVariantNames()
    ]
    for choices, shown in chosen:
        choices.SetVariantSelection(shown)
    for attribute in hidden:
        attribute.Set(UsdGeom.Tokens.inherited)


def _invisible(prim: Usd.Prim) -> Usd.Attribute | None:
    """Return the visibility of a prim that is hidden itself."""
    imageable = UsdGeom.Imageable(prim)
    visibility = imageable.GetVisibilityAttr() if imageable else None
    is_hidden = visibility and visibility.HasAuthoredValue() and visibility.Get(READ_AT) == UsdGeom.Tokens.invisible
    return visibility if is_hidden else None


def _levels(root: Usd.Prim) -> list[Usd.Prim]:
    group = root.GetChild(LEVELS)
    return list(group.GetChildren()) if group else []


def _put_back(stage: Usd.Stage, root: Usd.Prim) -> None:
    """Turn and shift all of a stage so that the garage lies in its own frame."""
    to_metres = metres_y_up(stage)
    to_world = np.array(UsdGeom.XformCache(READ_AT).GetLocalToWorldTransform(root)) @ to_metres
    if not np.isfinite(to_world).all():
        return
    own = in_own_frame(to_world)
    if own is None:
        raise StageError(
            stage.GetRootLayer().realPath, f"{root.GetPath()} has a scale of 0, so nothing in it has a size"
        )
    back = to_metres @ np.linalg.inv(to_world) @ own @ np.linalg.inv(to_metres)
    if np.abs(back - np.eye(4)).max() < _SAME:
        return
    for xformable in _outermost(stage.GetPseudoRoot()):
        operations, resets = xformable.GetOrderedXformOps(), xformable.GetResetXformStack()
        operation = xformable.AddTransformOp(opSuffix=_FRAME)
        operation.Set(Gf.Matrix4d(back))
        xformable.SetXformOpOrder([operation, *operations], resets)


def _outermost(prim: Usd.Prim) -> Iterator[UsdGeom.Xformable]:
    """Yield the outermost prims that have a place."""
    for child in prim.GetChildren():
        xformable = UsdGeom.Xformable(child)
        if xformable:
            yield xformable
        else:
            yield from _outermost(child)
