"""The garage of a stage that someone edited: shown whole, and in its own frame wherever it was moved to."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Usd, UsdGeom

from garage2usd.common.errors import StageError
from garage2usd.garage.levels import LEVELS_NAME
from garage2usd.reading.files import open_stage
from garage2usd.scenes.values import READ_AT, Z_UP_TO_Y_UP, metres_y_up, numbers_of

GRAPH = "LaneGraph"
"""Name of the prim below the root that holds the lane graph."""
_SHOWN = {"level": "all", "ceiling": "shown"}
"""Variants that hide nothing, by variant set."""
_FRAME = "ownFrame"
_DIGITS = 9
_LEAST_SCALE = 1e-9
_CORNERS = 3
_ALL = Usd.TraverseInstanceProxies(Usd.PrimIsDefined)
"""Includes inactive prims."""

_Matrix = NDArray[np.float64]


def open_garage(path: Path) -> Usd.Stage:
    """Open a stage to read its garage; raises as `garage2usd.reading.files.open_stage`.

    Notes
    -----
    Positions, hidden levels and selected views are for looking at a garage and change nothing about it. The stage's
    session layer puts the garage back into its own frame, without turn and shift but with its scale, and shows its
    levels, its groups and its ceiling. A single hidden object is not part of the garage.
    """
    stage = open_stage(path)
    with Usd.EditContext(stage, stage.GetSessionLayer()):
        root = _editable_root(stage)
        if root and (root.GetChild(GRAPH) or root.GetChild(LEVELS_NAME)):
            _show(root)
            _put_back(stage, root)
    return stage


def garage_root(stage: Usd.Stage) -> Usd.Prim:
    """Return the root of a garage: the default prim, or in a stage that refers to a garage the parent of its lanes."""
    root = stage.GetDefaultPrim()
    if root and (root.GetChild(GRAPH) or root.GetChild(LEVELS_NAME)):
        return root
    prims = [stage.GetPseudoRoot()]
    while prims:  # breadth first: levels have inactive lane graphs of their own, deeper down
        graph = next((prim for prim in prims if prim.GetName() == GRAPH), None)
        if graph is not None:
            return graph.GetParent()
        prims = [child for prim in prims for child in prim.GetFilteredChildren(_ALL)]
    return root


def _editable_root(stage: Usd.Stage) -> Usd.Prim:
    """Return the root of a garage, of which no prim above is an instance any more: nothing in instances is edited."""
    root = garage_root(stage)
    while root and (root.IsInstance() or root.IsInstanceProxy()):
        held = root
        while not held.IsInstance():
            held = held.GetParent()
        held.SetInstanceable(False)
        root = garage_root(stage)
    return root


def in_own_frame(to_world: _Matrix, *, is_z_up: bool | None = None) -> _Matrix | None:
    """Return a transform without its rotation and translation: its scale, and the exchange of axes to Y up.

    Parameters
    ----------
    to_world
        From a prim's coordinates to the world's, in metres with Y up, for row vectors; float64, shape (4, 4).
    is_z_up
        True if the prim's own coordinates have Z up, False for Y; None for the axis that is the steeper one.

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
    if is_z_up is None:
        is_z_up = abs(turn[1, 1]) < abs(turn[2, 1])
    axes = Z_UP_TO_Y_UP[:3, :3] if is_z_up else np.eye(3)
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
    group = root.GetChild(LEVELS_NAME)
    return list(group.GetChildren()) if group else []


def _put_back(stage: Usd.Stage, root: Usd.Prim) -> None:
    """Turn and shift all of a stage so that the garage lies in its own frame."""
    to_metres = metres_y_up(stage)
    to_world = np.array(UsdGeom.XformCache(READ_AT).GetLocalToWorldTransform(root)) @ to_metres
    if not np.isfinite(to_world).all():
        return
    own = in_own_frame(to_world, is_z_up=_has_z_up(root))
    if own is None:
        raise StageError(
            stage.GetRootLayer().realPath, f"{root.GetPath()} has a scale of 0, so nothing in it has a size"
        )
    if np.array_equal(to_world, own):
        return
    to_stage = np.linalg.inv(to_metres)
    back = Gf.Matrix4d(to_metres @ np.linalg.inv(to_world) @ own @ to_stage)
    for xformable in _outermost(stage.GetPseudoRoot()):
        operations, resets = xformable.GetOrderedXformOps(), xformable.GetResetXformStack()
        operation = xformable.AddTransformOp(opSuffix=_FRAME)
        operation.Set(back)
        xformable.SetXformOpOrder([operation, *operations], resets)
    whole = UsdGeom.Xformable(root)
    operation = UsdGeom.XformOp(whole.GetTransformOp(opSuffix=_FRAME)) or whole.AddTransformOp(opSuffix=_FRAME)
    operation.Set(Gf.Matrix4d(own @ to_stage))
    whole.SetXformOpOrder([operation], True)  # without the rounding of the way there and back


def _has_z_up(root: Usd.Prim) -> bool | None:
    """Return True if the floor of a garage is normal to its own Z axis, False if to Y; None without stalls."""
    stalls = UsdGeom.BasisCurves(root.GetPrimAtPath(f"{GRAPH}/Stalls"))
    if not (stalls and UsdGeom.Xformable(root)):
        return None
    points = numbers_of(stalls.GetPointsAttr(), np.float64, width=3)
    if len(points) < _CORNERS:
        return None
    to_root = np.array(UsdGeom.XformCache(READ_AT).ComputeRelativeTransform(stalls.GetPrim(), root)[0])[:3, :3]
    first, second, third = points[:_CORNERS] @ to_root
    normal = np.abs(np.cross(second - first, third - second))
    return bool(normal[2] > normal[1])


def _outermost(prim: Usd.Prim) -> Iterator[UsdGeom.Xformable]:
    """Yield the outermost prims that have a place."""
    for child in prim.GetChildren():
        xformable = UsdGeom.Xformable(child)
        if xformable:
            yield xformable
        else:
            yield from _outermost(child)
