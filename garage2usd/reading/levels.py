"""The levels of a stage: their prims, and each of them as a stage of its own."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from garage2usd.common.errors import StageError
from garage2usd.garage.levels import LEVELS_NAME, ONLY_LEVEL, LevelPlace
from garage2usd.objects.ramp import KIND as RAMP
from garage2usd.reading.whole_garage import garage_root, in_own_frame
from garage2usd.scenes.values import READ_AT, metres_y_up

_COPIED = ("upAxis", "metersPerUnit", "kilogramsPerUnit", "timeCodesPerSecond", "startTimeCode", "endTimeCode")
_KEPT = ("LaneGraph", "PhysicsScene")
"""Prims of a level that are inactive in the whole garage, which has them once."""


def levels_of(stage: Usd.Stage) -> list[LevelPlace]:
    """Return the levels of a garage, the top one first: the garage itself where its stage has no levels.

    Raises
    ------
    StageError
        If the stage has levels of which none is active.
    """
    root = garage_root(stage)
    group = root.GetChild(LEVELS_NAME) if root else None
    if not group:
        return [ONLY_LEVEL._replace(path=root.GetPath().pathString) if root else ONLY_LEVEL]
    levels = [
        LevelPlace(prim.GetName(), prim.GetPath().pathString, round(float(_to_metres(stage, prim)[3, 1]), 6))
        for prim in group.GetChildren()
    ]
    if not levels:
        raise StageError(stage.GetRootLayer().realPath, f"{group.GetPath()} has no active level")
    return levels


def placed_level(stage: Usd.Stage, level: LevelPlace) -> NDArray[np.float64]:
    """Return the transform from a level as a garage of its own to the whole, in metres with Y up, for row vectors."""
    to_metres = _to_metres(stage, stage.GetPrimAtPath(level.path))
    return np.linalg.inv(_own_frame(stage, level, to_metres)) @ to_metres


def _to_metres(stage: Usd.Stage, prim: Usd.Prim) -> NDArray[np.float64]:
    """Return the transform from a prim's coordinates to metres with Y up; of a level as if a bad one were none."""
    local = np.array(UsdGeom.XformCache(READ_AT).GetLocalToWorldTransform(prim))
    return (local if np.isfinite(local).all() else np.eye(4)) @ metres_y_up(stage)


def _own_frame(stage: Usd.Stage, level: LevelPlace, to_metres: NDArray[np.float64]) -> NDArray[np.float64]:
    own = in_own_frame(to_metres)
    if own is None:
        raise StageError(stage.GetRootLayer().realPath, f"{level.path} has a scale of 0, so nothing in it has a size")
    return own


def paths_from_above(levels: Sequence[LevelPlace], index: int) -> tuple[str, ...]:
    """Return the beginnings of the paths of what a map shows of a level: its own objects, and the ramps down from it.

    Parameters
    ----------
    levels
        All levels, the top one first. A ramp belongs to the level at its foot.
    index
        Index of the level.
    """
    ramps_down = (f"{below.path}/{RAMP.group}/" for below in levels[index + 1 : index + 2])
    return (f"{levels[index].path}/", *ramps_down)


def level_stage(stage: Usd.Stage, level: LevelPlace) -> Usd.Stage:
    """Open a level of a stage as the stage of a garage of this level alone, with its floor at 0."""
    if level.is_only:
        return stage
    source = stage.GetRootLayer()
    path, session = Sdf.Path(level.path), stage.GetSessionLayer()
    layer = Sdf.Layer.CreateAnonymous(".usda")
    own = _own_frame(stage, level, _to_metres(stage, stage.GetPrimAtPath(path))) @ np.linalg.inv(metres_y_up(stage))
    with Sdf.ChangeBlock():
        for key in _COPIED:
            if source.pseudoRoot.HasInfo(key):
                layer.pseudoRoot.SetInfo(key, source.pseudoRoot.GetInfo(key))
        layer.defaultPrim = path.GetPrefixes()[0].name
        root = Sdf.CreatePrimInLayer(layer, Sdf.Path.absoluteRootPath.AppendChild(layer.defaultPrim))
        if session.GetPrimAtPath(path):
            Sdf.CopySpec(session, path, layer, root.path)
        root.specifier = Sdf.SpecifierDef
        reference = Sdf.Reference(source.identifier, path)
        root.SetInfo("references", Sdf.ReferenceListOp.Create(prependedItems=[reference]))
        order = root.attributes.get("xformOpOrder") or Sdf.AttributeSpec(
            root, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform
        )
        order.default = Vt.TokenArray([])
        if not np.allclose(own, np.eye(4)):
            operation = Sdf.AttributeSpec(root, "xformOp:transform:ownFrame", Sdf.ValueTypeNames.Matrix4d)
            operation.default = Gf.Matrix4d(own)
            order.default = Vt.TokenArray(["xformOp:transform:ownFrame"])
        for kept in _KEPT:
            Sdf.CreatePrimInLayer(layer, root.path.AppendChild(kept)).SetInfo("active", True)
    return Usd.Stage.Open(layer)
