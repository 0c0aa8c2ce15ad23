"""The levels of a stage: their prims, and each of them as a stage of its own."""

from collections.abc import Sequence
from typing import NamedTuple

from pxr import Sdf, Usd, UsdGeom, Vt

from garage2usd.common.errors import StageError
from garage2usd.objects.ramp import KIND as RAMP

__all__ = [
    "LEVELS",
    "StageLevel",
    "level_stage",
    "levels_of",
    "nearest_floor",
    "paths_from_above",
    "refuse_levels",
]

LEVELS = "Levels"
"""Name of the prim below the root that holds the levels of a garage of several."""
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
    root = stage.GetDefaultPrim()
    group = root.GetChild(LEVELS) if root else None
    if not group:
        return []
    cache = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
    return [
        StageLevel(
            prim.GetName(),
            prim.GetPath().pathString,
            round(float(cache.GetLocalToWorldTransform(prim).ExtractTranslation()[1]), 6),
        )
        for prim in group.GetChildren()
    ]


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
    name = stage.GetDefaultPrim().GetName()
    layer = Sdf.Layer.CreateAnonymous(".usda")
    with Sdf.ChangeBlock():
        for key in _COPIED:
            if source.pseudoRoot.HasInfo(key):
                layer.pseudoRoot.SetInfo(key, source.pseudoRoot.GetInfo(key))
        layer.defaultPrim = name
        root = Sdf.CreatePrimInLayer(layer, Sdf.Path.absoluteRootPath.AppendChild(name))
        root.specifier = Sdf.SpecifierDef
        reference = Sdf.Reference(source.identifier, Sdf.Path(level.path))
        root.SetInfo("references", Sdf.ReferenceListOp.Create(prependedItems=[reference]))
        order = Sdf.AttributeSpec(root, "xformOpOrder", Sdf.ValueTypeNames.TokenArray, Sdf.VariabilityUniform)
        order.default = Vt.TokenArray([])
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
