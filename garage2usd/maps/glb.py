"""GLB: a stage as one glTF 2.0 file for engines, browsers and simulators that read no USD."""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.errors import StageError
from garage2usd.maps.glb_file import GlbFile
from garage2usd.maps.glb_meshes import is_rigid, moved_triangles
from garage2usd.maps.stall_facts import StallFacts
from garage2usd.reading.labels import Labels, read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.lights import LIGHT_TYPES, light_of
from garage2usd.reading.looks import MeshLooks
from garage2usd.reading.meshes import DRAWN_TYPES, Triangles
from garage2usd.reading.objects import Matrix, PlacedObject, once_for_each_look
from garage2usd.reading.surfaces import SurfaceLook
from garage2usd.reading.values import metres_y_up
from garage2usd.reading.walk import placed_objects

__all__ = ["write_glb"]

_FACTS = ("generator", "version", "seed", "configDigest", "structureDigest")
_STALLS = "stalls"
_CAR, _STALL = "car", "parking_stall"
_IDENTITY = np.eye(4)


def write_glb(stage: Usd.Stage, path: Path, *, labels: Labels | None = None) -> None:
    """Write a stage as a binary glTF 2.0 file, in metres, Y up, as it is composed now.

    Parameters
    ----------
    stage
        The stage.
    path
        The file; its folder is there.
    labels
        Which object has which instance id; left out, what `garage2usd.reading.labels.read_labels` finds.

    Raises
    ------
    MissingExtraError
        If trimesh is not installed.
    StageError
        If nothing in the stage can be drawn, or the file beside it is not a table of labels.

    Notes
    -----
    Each object is a node with the path of its prim as its name and, as ``extras``, its class, its instance id and, for
    cars and stalls, the stall. Each prim that it draws is a node below it; equal meshes with equal materials are one
    mesh. Lights are nodes that draw nothing, as glTF has no lights with an area. Below the node ``stalls`` each stall
    is a node in the middle of its outline whose Z axis leads to its mouth.
    """
    glb, looks, file = GlbFile(), MeshLooks(), stage.GetRootLayer().realPath
    labels = labels or read_labels(stage, Path(file) if file else None)
    look_of = once_for_each_look(lambda placed: _look(placed, looks))
    drawn = [(placed, look) for placed in placed_objects(stage, metres_y_up(stage)) if (look := look_of(placed)).parts]
    if not drawn:
        raise StageError(file, "nothing in it can be drawn")
    stalls = StallFacts(read_lanes(stage).stalls)
    homes = {
        placed.path: stalls.park(placed.path, look.hull_m, placed.matrix)
        for placed, look in drawn
        if placed.label == _CAR and len(look.hull_m)
    }
    for placed, look in drawn:
        number = labels.ids.get(placed.path)
        stall = stalls.at(placed.matrix) if placed.label == _STALL else homes.get(placed.path)
        extras: dict[str, Any] = {"class": placed.label} if placed.label else {}
        extras |= {} if number is None else {"id": number}
        extras |= {} if stall is None else {"stall": stalls.facts(stall)}
        _add_object(glb, placed, look, extras)
    _add_stalls(glb, stalls)
    path.write_bytes(glb.data(_facts(stage)))


@dataclass(frozen=True, eq=False)
class _Part:
    """What a prim of an object draws.

    Attributes
    ----------
    path
        From the object's path to that of the prim.
    matrix
        To the object's space.
    triangles, surface
        What is drawn; None for a light.
    extras
        What its node says.
    """

    path: str
    matrix: Matrix
    triangles: Triangles | None = None
    surface: SurfaceLook | None = None
    extras: dict[str, Any] | None = None


@dataclass(frozen=True, eq=False)
class _Look:
    """What an object draws, and the corners of its convex hull in its own space; float, shape (n, 3)."""

    parts: Sequence[_Part]
    hull_m: NDArray[np.floating[Any]]


def _look(placed: PlacedObject, looks: MeshLooks) -> _Look:
    parts: list[_Part] = []
    for prim, path, matrix in placed.parts:
        kind = str(prim.GetTypeName())
        if kind in DRAWN_TYPES:
            for mesh, surface, subset in looks.of_prim(prim):
                name = f"{path}/{subset}" if subset else path
                parts.append(_Part(name, matrix, looks.meshes.values[mesh], looks.surfaces.values[surface]))
        elif kind in LIGHT_TYPES:
            parts.append(_Part(path, matrix, extras={"light": _light_facts(prim)}))
    hull_m = np.concatenate(
        [
            np.zeros((0, 3)),
            *(part.triangles.positions_m @ part.matrix[:3, :3] + part.matrix[3, :3] for part in parts if part.triangles),
        ]
    )
    return _Look(parts, _hull(hull_m) if placed.label == _CAR else hull_m[:0])


def _hull(points_m: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """The corners of the convex hull; all points where they have no volume."""
    from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415 - all who import this module would wait for it

    with suppress(QhullError, ValueError):
        return points_m[ConvexHull(points_m).vertices]
    return points_m


def _light_facts(prim: Usd.Prim) -> dict[str, Any]:
    light = light_of(prim)
    return {
        "type": light.kind,
        "width_m": light.width_m,
        "height_m": light.height_m,
        "colour": list(light.colour_rgb),
        "intensity": light.intensity,
    }


def _add_object(glb: GlbFile, placed: PlacedObject, look: _Look, extras: dict[str, Any]) -> None:
    """Add the node of an object and those of its parts; what no node can say of a place goes into the vertices."""
    place, inner = placed.matrix, _IDENTITY
    if not is_rigid(place):
        place, inner = _moved_only(place), place.copy()
        inner[3] = 0, 0, 0, 1
    if not any(part.path == "" for part in look.parts):
        glb.add_node(placed.path, place, extras=extras)
    for part in look.parts:
        matrix, triangles = part.matrix @ inner, part.triangles
        if not is_rigid(matrix):
            triangles = triangles and moved_triangles(triangles, matrix)
            matrix = _IDENTITY if triangles else _moved_only(matrix)
        mesh = None
        if triangles is not None and part.surface is not None:
            mesh = glb.mesh(triangles, part.surface, name=(part.path or placed.path).rpartition("/")[2])
        if part.path:
            glb.add_node(placed.path + part.path, matrix, mesh=mesh, above=placed.path, extras=part.extras)
        else:
            glb.add_node(placed.path, matrix @ place, mesh=mesh, extras=extras | (part.extras or {}))


def _moved_only(matrix: Matrix) -> Matrix:
    moved = _IDENTITY.copy()
    moved[3, :3] = matrix[3, :3]
    return moved


def _add_stalls(glb: GlbFile, stalls: StallFacts) -> None:
    if not stalls.stalls:
        return
    glb.add_node(_STALLS, _IDENTITY)
    for name, stall in stalls.by_name.items():
        (x, z), (mouth_x, mouth_z) = stall.centre, stall.outwards
        axes = (mouth_z, 0, -mouth_x, 0), (0, 1, 0, 0), (mouth_x, 0, mouth_z, 0)
        matrix = np.array([*axes, (x, 0, z, 1)])
        glb.add_node(f"{_STALLS}/{name}", matrix, above=_STALLS, extras={"stall": stalls.outline(stall)})


def _facts(stage: Usd.Stage) -> dict[str, str]:
    root = stage.GetDefaultPrim()
    data = root.GetCustomData() if root else {}
    return {name: str(data[name]) for name in _FACTS if name in data}
