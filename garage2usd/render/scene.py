"""What a stage draws, taken apart: its different shapes, and each place where one of them is drawn."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import Enum, auto
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, Usd, UsdGeom, UsdLux, UsdShade

__all__ = ["SHAPE_PROPERTY", "Scene", "read_scene", "write_shapes"]

SHAPE_PROPERTY = "garage2usd_shape"
"""Custom property by which Blender's objects are known again: the number of their shape."""


@dataclass(frozen=True, eq=False)
class Scene:
    """The drawn prims of a stage.

    Attributes
    ----------
    shapes
        For each different mesh or light the path of a prim that is one; several prims of instances share it.
    materials
        Paths of the materials that the shapes are bound to.
    domes
        Paths of the lights that stand for the surroundings.
    shape
        Number of the shape of each drawn prim; int32, shape (n,).
    instance
        Id of the object that each drawn prim belongs to, 0 for none; int32, shape (n,).
    to_world
        Local to world, metres, the stage's axes, for column vectors; float64, shape (n, 4, 4).
    """

    shapes: tuple[Sdf.Path, ...]
    materials: tuple[Sdf.Path, ...]
    domes: tuple[Sdf.Path, ...]
    shape: NDArray[np.int32]
    instance: NDArray[np.int32]
    to_world: NDArray[np.float64]


class _Role(Enum):
    """What a prim of a type is to a renderer."""

    POINTS = auto()
    DOME = auto()
    SHAPE = auto()
    OTHER = auto()


_TYPES = {
    _Role.POINTS: (UsdGeom.PointInstancer,),
    _Role.DOME: (UsdLux.DomeLight, UsdLux.DomeLight_1),
    _Role.SHAPE: (UsdGeom.Gprim,),
}


class _Reader:
    """Collects the drawn prims of a stage at one time."""

    def __init__(self, stage: Usd.Stage, ids: Mapping[str, int]) -> None:
        self._ids = ids
        self._places = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
        metres = UsdGeom.GetStageMetersPerUnit(stage)
        self._to_metres = np.diag([metres, metres, metres, 1.0])
        self._roles: dict[str, _Role] = {}
        self._numbers: dict[Sdf.Path, int] = {}
        self.shapes: list[Sdf.Path] = []
        self.materials: set[Sdf.Path] = set()
        self.domes: list[Sdf.Path] = []
        self.drawn: list[tuple[int, int, NDArray[np.float64]]] = []

    def read(self, root: Usd.Prim) -> None:
        prims = iter(_drawn_range(root))
        for prim in prims:
            role = self._role(prim)
            if role is _Role.POINTS:
                prims.PruneChildren()
                if _is_shown(prim):
                    self._read_points(UsdGeom.PointInstancer(prim))
            elif role is _Role.DOME:
                self.domes.append(prim.GetPath())
            elif (role is _Role.SHAPE or prim.HasAPI(UsdLux.LightAPI)) and _is_shown(prim):
                place = _array(self._places.GetLocalToWorldTransform(prim))
                self._add(prim, place, _owner(prim.GetPath(), self._ids))

    def _role(self, prim: Usd.Prim) -> _Role:
        """What a prim is by its type alone; a stage has many prims of few types."""
        type_name = prim.GetTypeName()
        if type_name not in self._roles:
            self._roles[type_name] = next(
                (role for role, types in _TYPES.items() if any(prim.IsA(schema) for schema in types)), _Role.OTHER
            )
        return self._roles[type_name]

    def _read_points(self, instancer: UsdGeom.PointInstancer) -> None:
        """The shapes of each prototype, once for each point."""
        prim, time = instancer.GetPrim(), Usd.TimeCode.EarliestTime()
        base = _array(self._places.GetLocalToWorldTransform(prim))
        numbers = instancer.GetProtoIndicesAttr().Get(time) or []
        places = instancer.ComputeInstanceTransformsAtTime(
            time, time, UsdGeom.PointInstancer.ExcludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
        )
        mask = instancer.ComputeMaskAtTime(time) or [True] * len(numbers)
        parts = [list(self._parts(prim, path)) for path in instancer.GetPrototypesRel().GetForwardedTargets()]
        whole = _owner(prim.GetPath(), self._ids)
        for point, (number, place, shown) in enumerate(zip(numbers, places, mask, strict=True)):
            owner = self._ids.get(f"{prim.GetPath()}[{point}]", whole)
            for part, within in parts[number] if shown else ():
                self._add(part, base @ _array(place) @ within, owner)

    def _parts(self, instancer: Usd.Prim, path: Sdf.Path) -> Iterator[tuple[Usd.Prim, NDArray[np.float64]]]:
        """Drawable prims of a prototype, and where they are within its points."""
        root = instancer.GetStage().GetPrimAtPath(path)
        if not root:
            return
        # the prototype's own transform counts, that of its parents does not
        above = np.linalg.inv(_array(self._places.GetParentToWorldTransform(root)))
        for prim in _drawn_range(root):
            if _is_drawable(prim):
                yield prim, above @ _array(self._places.GetLocalToWorldTransform(prim))

    def _add(self, prim: Usd.Prim, place: NDArray[np.float64], owner: int) -> None:
        source = prim.GetPrimInPrototype().GetPath() if prim.IsInstanceProxy() else prim.GetPath()
        number = self._numbers.get(source)
        if number is None:
            number = self._numbers[source] = len(self.shapes)
            self.shapes.append(prim.GetPath())
            self.materials.update(_materials(prim))
        self.drawn.append((number, owner, self._to_metres @ place))


def read_scene(stage: Usd.Stage, ids: Mapping[str, int]) -> Scene:
    """Find everything that a stage draws: visible geometry and lights of the purposes default and render.

    Parameters
    ----------
    stage
        The stage, with all of its instances and point instancers.
    ids
        Instance id by the path of an object's prim; a point of an instancer has its number in brackets after the
        instancer's path. What is drawn belongs to the nearest of its parents that is there.
    """
    reader = _Reader(stage, ids)
    reader.read(stage.GetPseudoRoot())
    shape, instance, to_world = zip(*reader.drawn, strict=True) if reader.drawn else ((), (), ())
    return Scene(
        tuple(reader.shapes),
        tuple(sorted(reader.materials)),
        tuple(reader.domes),
        np.array(shape, dtype=np.int32),
        np.array(instance, dtype=np.int32),
        np.array(to_world, dtype=np.float64).reshape(-1, 4, 4),
    )


def write_shapes(stage: Usd.Stage, scene: Scene, path: Path) -> None:
    """Write a layer over a stage in which each shape is no instance and carries its number as a custom property."""
    layer = Sdf.Layer.CreateAnonymous(path.suffix)
    layer.subLayerPaths.append(str(Path(stage.GetRootLayer().realPath)))
    over = Usd.Stage.Open(layer)
    UsdGeom.SetStageUpAxis(over, UsdGeom.GetStageUpAxis(stage))
    UsdGeom.SetStageMetersPerUnit(over, UsdGeom.GetStageMetersPerUnit(stage))
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


def _drawn_range(root: Usd.Prim) -> Usd.PrimRange:
    return Usd.PrimRange(root, Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate))


def _is_drawable(prim: Usd.Prim) -> bool:
    return bool(prim.IsA(UsdGeom.Gprim) or prim.HasAPI(UsdLux.LightAPI))


def _is_shown(prim: Usd.Prim) -> bool:
    imageable = UsdGeom.Imageable(prim)
    drawn = imageable.ComputePurpose() in {UsdGeom.Tokens.default_, UsdGeom.Tokens.render}
    return bool(drawn and imageable.ComputeVisibility(Usd.TimeCode.EarliestTime()) != UsdGeom.Tokens.invisible)


def _materials(prim: Usd.Prim) -> Iterator[Sdf.Path]:
    parts = UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim))
    for bound in (prim, *(part.GetPrim() for part in parts)):
        material, _ = UsdShade.MaterialBindingAPI(bound).ComputeBoundMaterial()
        if material:
            yield material.GetPath()


def _owner(path: Sdf.Path, ids: Mapping[str, int]) -> int:
    """Id of the nearest of a prim and its parents that has one."""
    while path != Sdf.Path.absoluteRootPath:
        found = ids.get(path.pathString)
        if found is not None:
            return found
        path = path.GetParentPath()
    return 0


def _array(matrix: object) -> NDArray[np.float64]:
    """A matrix of USD, which is for row vectors, for column vectors."""
    return np.array(matrix, dtype=np.float64).T
