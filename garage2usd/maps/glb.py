"""GLB: a stage as one glTF 2.0 file for engines, browsers and simulators that read no USD."""

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.errors import StageError
from garage2usd.maps.glb_file import GlbFile
from garage2usd.maps.glb_meshes import are_rigid, by_facets, joined, moved_triangles
from garage2usd.maps.stall_facts import StallFacts
from garage2usd.reading.labels import Labels, read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.looks import MeshLooks
from garage2usd.reading.meshes import DRAWN_TYPES, Triangles
from garage2usd.reading.objects import PlacedObject, once_for_each_look
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
    StageError
        If nothing in the stage can be drawn, or the file beside it is not a table of labels.

    Notes
    -----
    Each object is a node with the path of its prim as its name and, as ``extras``, its class, its instance id and, for
    cars and stalls, the stall. What it looks like is one mesh, which all objects that look alike share, with primitives
    by material; what is faceted has no normals, as glTF 2.0 (3.7.2.1) says. Lights are left out, as glTF has none with
    an area; what glows does. Below the node ``stalls`` each stall is a node in the middle of its outline, whose Z axis
    leads to its mouth.
    """
    glb, looks, file = GlbFile(), MeshLooks(), stage.GetRootLayer().realPath
    labels = labels or read_labels(stage, Path(file) if file else None)
    look_of = once_for_each_look(lambda placed: _look(placed, looks))
    drawn = [(placed, look) for placed in placed_objects(stage, metres_y_up(stage)) if (look := look_of(placed)).pieces]
    if not drawn:
        raise StageError(file, "nothing in it can be drawn")
    stalls = StallFacts(read_lanes(stage).stalls)
    homes = {
        placed.path: stalls.park(placed.path, look.hull_m, placed.matrix)
        for placed, look in drawn
        if placed.label == _CAR
    }
    mesh_of = once_for_each_look(lambda placed: glb.add_mesh(look_of(placed).pieces, name=_name(placed)))
    rigid = are_rigid(np.array([placed.matrix for placed, _ in drawn]))
    for (placed, look), is_rigid in zip(drawn, rigid.tolist(), strict=True):
        number = labels.ids.get(placed.path)
        stall = stalls.at(placed.matrix) if placed.label == _STALL else homes.get(placed.path)
        extras: dict[str, Any] = {"class": placed.label} if placed.label else {}
        extras |= {} if number is None else {"id": number}
        extras |= {} if stall is None else {"stall": stalls.facts(stall)}
        if is_rigid:
            glb.add_node(placed.path, placed.matrix, mesh=mesh_of(placed), extras=extras)
        else:  # no node can say so: it goes into the vertices
            pieces = [(moved_triangles(triangles, placed.matrix), surface) for triangles, surface in look.pieces]
            glb.add_node(placed.path, _IDENTITY, mesh=glb.add_mesh(pieces, name=_name(placed)), extras=extras)
    _add_stalls(glb, stalls)
    path.write_bytes(glb.data(_facts(stage)))


class _Look(NamedTuple):
    """What an object draws.

    Attributes
    ----------
    pieces
        Triangles and surface of each primitive, in the object's space.
    hull_m
        Corners of the convex hull of all of it; float, shape (n, 3). None are kept but of cars.
    """

    pieces: Sequence[tuple[Triangles, SurfaceLook]]
    hull_m: NDArray[np.floating[Any]]


def _look(placed: PlacedObject, looks: MeshLooks) -> _Look:
    """One piece for all that has the same surface, apart from what is faceted, which needs no normals."""
    alike: dict[tuple[int, bool, bool], list[Triangles]] = {}
    for part in placed.parts:
        if part.prim.GetTypeName() in DRAWN_TYPES:
            for mesh, surface in looks.of_prim(part.prim):
                triangles, is_bumpy = looks.meshes.values[mesh], bool(looks.surfaces.values[surface].normal_texture)
                if not np.array_equal(part.matrix, _IDENTITY):
                    triangles = moved_triangles(triangles, part.matrix)
                for is_faceted, own in by_facets(triangles):
                    alike.setdefault((surface, own.double_sided, is_faceted and not is_bumpy), []).append(own)
    pieces = [(joined(group), looks.surfaces.values[surface]) for (surface, _, _), group in alike.items()]
    if placed.label != _CAR:
        return _Look(pieces, np.zeros((0, 3)))
    return _Look(pieces, _hull(np.concatenate([triangles.positions_m for triangles, _ in pieces])))


def _hull(points_m: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """The corners of the convex hull; all points where they have no volume."""
    from scipy.spatial import ConvexHull, QhullError  # noqa: PLC0415 - all who import this module would wait for it

    with suppress(QhullError, ValueError):
        points_m = points_m[ConvexHull(points_m).vertices]
    return points_m


def _name(placed: PlacedObject) -> str:
    return placed.path.rpartition("/")[2]


def _add_stalls(glb: GlbFile, stalls: StallFacts) -> None:
    if not stalls.stalls:
        return
    group = glb.add_node(_STALLS, _IDENTITY)
    for name, stall in stalls.by_name.items():
        (x, z), (mouth_x, mouth_z) = stall.centre, stall.outwards
        axes = (mouth_z, 0, -mouth_x, 0), (0, 1, 0, 0), (mouth_x, 0, mouth_z, 0)
        matrix = np.array([*axes, (x, 0, z, 1)])
        glb.add_node(f"{_STALLS}/{name}", matrix, above=group, extras={"stall": stalls.outline(stall)})


def _facts(stage: Usd.Stage) -> dict[str, str]:
    root = stage.GetDefaultPrim()
    data = root.GetCustomData() if root else {}
    return {name: str(data[name]) for name in _FACTS if name in data}
