"""Drawn prims of a stage: its distinct shapes, and all their placements."""

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom, UsdLux, UsdShade

from garage2usd.reading.labels import owner_of
from garage2usd.scenes.objects import DrawnPart, PlacedObject, once_for_each_look
from garage2usd.scenes.values import metres_per_unit
from garage2usd.scenes.walk import placed_objects

__all__ = ["SHAPE_PROPERTY", "DrawnPrims", "read_drawn_prims", "write_shapes"]

SHAPE_PROPERTY = "garage2usd_shape"
"""Custom property that holds the shape's index on a Blender object."""


@dataclass(frozen=True, eq=False)
class DrawnPrims:
    """The drawn prims of a stage.

    Attributes
    ----------
    shapes
        Path of one prim for each distinct mesh or light, shared by instances.
    materials
        Paths of the materials that the shapes are bound to.
    domes
        Paths of the dome lights.
    shape
        Shape index of each drawn prim; int32, shape (n,).
    instance
        Instance id of each drawn prim's object, 0 for none; int32, shape (n,).
    to_world
        Transform from local space to the stage's axes, in metres, for column vectors; float64, shape (n, 4, 4).
    """

    shapes: tuple[Sdf.Path, ...]
    materials: tuple[Sdf.Path, ...]
    domes: tuple[Sdf.Path, ...]
    shape: NDArray[np.int32]
    instance: NDArray[np.int32]
    to_world: NDArray[np.float64]


_DOMES = (UsdLux.DomeLight, UsdLux.DomeLight_1)


def read_drawn_prims(stage: Usd.Stage, ids: Mapping[str, int]) -> DrawnPrims:
    """Read all drawn prims of a stage.

    Parameters
    ----------
    stage
        The stage; instances and point instancers are expanded.
    ids
        Instance ids by prim path; a point of an instancer has its index in brackets after the instancer's path. A drawn
        prim belongs to its nearest ancestor with an id.

    Notes
    -----
    See `garage2usd.scenes.walk.placed_objects` for the prims that are drawn.
    """
    metres = metres_per_unit(stage)
    numbers: dict[Hashable, int] = {}
    shapes: list[Sdf.Path] = []
    materials: set[Sdf.Path] = set()
    domes: list[Sdf.Path] = []
    drawn: list[tuple[int, int, NDArray[np.float64]]] = []

    def look_of(placed: PlacedObject) -> list[tuple[int, DrawnPart]]:
        """Return the placed drawable parts of an object, each with the index of its shape."""
        look = []
        for part in placed.parts:
            twin = Sdf.Path(placed.twin + part.path)
            if any(part.prim.IsA(dome) for dome in _DOMES):
                domes.append(twin)
                continue
            number = numbers.setdefault((part.prim.GetPath(), part.inherited), len(shapes))
            if number == len(shapes):
                shapes.append(twin)
                materials.update(_materials(stage.GetPrimAtPath(twin)))
            look.append((number, part))
        return look

    remembered = once_for_each_look(look_of)
    for placed in placed_objects(stage, np.diag([metres, metres, metres, 1.0])):
        for number, part in remembered(placed):
            drawn.append((number, owner_of(placed.path + part.path, ids), (part.matrix @ placed.matrix).T))
    shape, instance, to_world = zip(*drawn, strict=True) if drawn else ((), (), ())
    return DrawnPrims(
        tuple(shapes),
        tuple(sorted(materials)),
        tuple(domes),
        np.array(shape, dtype=np.int32),
        np.array(instance, dtype=np.int32),
        np.array(to_world, dtype=np.float64).reshape(-1, 4, 4),
    )


def write_shapes(stage: Usd.Stage, scene: DrawnPrims, path: Path) -> None:
    """Write an override layer in which no shape is an instance and each has its index as a custom property."""
    layer = Sdf.Layer.CreateAnonymous(path.suffix)
    layer.subLayerPaths.append(str(Path(stage.GetRootLayer().realPath)))
    over = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(over, UsdGeom.GetStageUpAxis(stage))
    UsdGeom.SetStageMetersPerUnit(over, metres_per_unit(stage))
    with Sdf.ChangeBlock():
        for number, shape in enumerate(scene.shapes):
            for parent in shape.GetPrefixes():
                if stage.GetPrimAtPath(parent).IsInstance() or stage.GetPrimAtPath(parent).IsInstanceable():
                    Sdf.CreatePrimInLayer(layer, parent).SetInfo("instanceable", False)
            spec = Sdf.CreatePrimInLayer(layer, shape)
            mark = Sdf.AttributeSpec(
                spec, f"userProperties:{SHAPE_PROPERTY}", Sdf.ValueTypeNames.Int, declaresCustom=True
            )
            mark.default = number
    layer.Export(str(path))


def _materials(prim: Usd.Prim) -> Iterator[Sdf.Path]:
    parts = UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim))
    for bound in (prim, *(part.GetPrim() for part in parts)):
        material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial(UsdShade.Tokens.preview)
        if material:
            yield material.GetPath()
