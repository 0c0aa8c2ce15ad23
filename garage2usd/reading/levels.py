"""The levels of a stage: their prims, and each of them as a stage of its own."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Sdf, Usd, UsdGeom, Vt

from garage2usd.common.errors import StageError
from garage2usd.objects.ramp import KIND as RAMP
from garage2usd.reading.whole_garage import LEVELS, garage_root, in_own_frame
from garage2usd.scenes.values import READ_AT, metres_y_up

__all__ = [
    "StageLevel",
    "level_stage",
    "levels_of",
    "nearest_floor",
    "paths_from_above",
    "placed_level",
    "refuse_levels",
]

_COPIED = ("upAxis", "metersPerUnit", "kilogramsPerUnit", "timeCodesPerSecond", "startTimeCode", "endTimeCode")
_KEPT = ("LaneGraph", "PhysicsScene")
"""Prims of a level that are inactive in the whole garage, which has them once."""


class StageLevel(NamedTuple):
    """A level of a stage.

    Attributes
    ----------
    name
        Name of its prim, ``U1``.
    path
        Path of its prim.
    floor_m
        Height of its floor.
    """

    name: str
    path: str
    floor_m: float


def levels_of(stage: Usd.Stage) -> list[StageLevel]:
    """Return the levels of a garage of several levels, the top one first; none of a garage of one level."""
    root = garage_root(stage)
    group = root.GetChild(LEVELS) if root else None
    if not group:
        return []
    return [
        StageLevel(prim.GetName(), prim.GetPath().pathString, round(float(_to_metres(stage, prim)[3, 1]), 6))
        for prim in group.GetChildren()
    ]


def placed_level(stage: Usd.Stage, level: StageLevel) -> NDArray[np.float64]:
    """Return the transform from a level as a garage of its own to the whole, in metres with Y up, for row vectors."""
    to_metres = _to_metres(stage, stage.GetPrimAtPath(level.path))
    placed: NDArray[np.float64] = np.linalg.inv(_own_frame(stage, level, to_metres)) @ to_metres
    return placed


def _to_metres(stage: Usd.Stage, prim: Usd.Prim) -> NDArray[np.float64]:
    """Return the transform from a prim's coordinates to metres with Y up; of a level as if a bad one were none."""
    local = np.array(UsdGeom.XformCache(READ_AT).GetLocalToWorldTransform(prim))
    to_metres: NDArray[np.float64] = (local if np.isfinite(local).all() else np.eye(4)) @ metres_y_up(stage)
    return to_metres


def _own_frame(stage: Usd.Stage, level: StageLevel, to_metres: NDArray[np.float64]) -> NDArray[np.float64]:
    own = in_own_frame(to_metres)
    if own is None:
        raise StageError(stage.GetRootLayer().realPath, f"{level.path} has a scale of 0, so nothing in it has a size")
    return own


def nearest_floor(floors_m: Sequence[float], height_m: float) -> int:
    """Return the index of the floor of the level at a height; on a ramp it changes half way."""
    return min(range(len(floors_m)), key=lambda index: abs(floors_m[index] - height_m))


def paths_from_above(levels: Sequence[StageLevel], index: int) -> tuple[str, ...]:
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


def level_stage(stage: Usd.Stage, level: StageLevel) -> Usd.Stage:
    """Open a level of a stage as the stage of a garage of this level alone, with its floor at 0."""
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


def refuse_levels(stage: Usd.Stage, source: str, what: str) -> None:
    """Refuse a garage of several levels.

    Parameters
    ----------
    stage, source
        The stage and its file.
    what
        What cannot be done with it yet, as the beginning of a sentence.

    Raises
    ------
    StageError
        If the stage has more than one level.
    """
    names = [level.name for level in levels_of(stage)]
    if len(names) > 1:
        raise StageError(source, f"{what} is not built yet for garages of several levels ({', '.join(names)})")
