"""Point instancers for many objects of few shapes without colliders."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Gf, Kind, Sdf, Vt

from garage2usd.layout import ObjectTable
from garage2usd.objects import KINDS, Spec
from garage2usd.stage.authoring import attribute, define, new_layer, numbers, relationship
from garage2usd.stage.bounds import world_bounds_m
from garage2usd.stage.prototypes import Prototype

__all__ = ["write_instancer"]

_TYPES = Sdf.ValueTypeNames


def write_instancer(
    path: Path,
    objects: ObjectTable,
    rows: NDArray[np.intp],
    prototypes: Mapping[Spec, Prototype],
    *,
    name: str,
    asset_folder: str,
    own_assets: str,
) -> None:
    """Write a layer with a point instancer `name`, with a point for each object in `rows`, all of one kind.

    The paths `asset_folder` and `own_assets` of its assets are relative to the layer.

    Notes
    -----
    Objects with colliders are excluded, since physics engines ignore colliders of point instancers. Some browser
    viewers draw only one copy.
    """
    shapes, indices = np.unique(objects.spec[rows], return_inverse=True)
    specs = [objects.specs[shape] for shape in shapes]
    root = Sdf.Path.absoluteRootPath.AppendChild(name)
    with new_layer(path, default_prim=name) as layer:
        prim = define(layer, root, "PointInstancer", kind=Kind.Tokens.group, label=KINDS[objects.kind[rows[0]]].label)
        _author_prototypes(prim, [prototypes[spec] for spec in specs], (asset_folder, own_assets))
        _author_points(prim, objects, rows, indices)


def _author_prototypes(instancer: Sdf.PrimSpec, prototypes: Sequence[Prototype], assets: tuple[str, str]) -> None:
    folder = define(instancer.layer, instancer.path.AppendChild("Prototypes"), "Scope", kind=Kind.Tokens.group)
    targets = []
    for prototype in prototypes:
        child = define(instancer.layer, folder.path.AppendChild(prototype.name), "Xform")
        layer, root = prototype.place(*assets)
        reference = Sdf.Reference(layer, f"/{root}" if root else Sdf.Path.emptyPath)
        child.SetInfo("references", Sdf.ReferenceListOp.Create(prependedItems=[reference]))
        targets.append(child.path)
    relationship(instancer, "prototypes", targets)


def _author_points(prim: Sdf.PrimSpec, objects: ObjectTable, rows: NDArray[np.intp], indices: NDArray[np.intp]) -> None:
    positions, yaws_rad = objects.position_m[rows], objects.yaw_rad[rows]
    numbers(prim, "protoIndices", indices)
    attribute(prim, "positions", _TYPES.Point3fArray, Vt.Vec3fArray.FromNumpy(positions.astype(np.float32)))
    turns = {yaw: Gf.Quath(math.cos(yaw / 2), 0.0, math.sin(yaw / 2), 0.0) for yaw in set(yaws_rad.tolist())}
    attribute(prim, "orientations", _TYPES.QuathArray, Vt.QuathArray([turns[yaw] for yaw in yaws_rad.tolist()]))
    least, greatest = world_bounds_m(objects, rows)
    extent = np.stack([least.min(axis=0), greatest.max(axis=0)]).astype(np.float32)
    attribute(prim, "extent", _TYPES.Float3Array, Vt.Vec3fArray.FromNumpy(extent))
