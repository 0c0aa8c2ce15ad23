"""GLB export: a stage as one binary glTF 2.0 file for engines, browsers and simulators."""

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray
from pxr import Usd, UsdLux

from garage2usd.as_built.shapes import are_upright
from garage2usd.common.errors import StageError
from garage2usd.garage import Stall
from garage2usd.layout.grounds import hulls_of
from garage2usd.maps.facts import StallFacts, stage_facts
from garage2usd.maps.glb_file import GlbFile, Piece
from garage2usd.maps.glb_lights import place_of, punctual_light, why_left_out
from garage2usd.maps.glb_meshes import are_rigid, by_facets, joined, rigid_inverses
from garage2usd.objects import CAR_LABELS, PIECE_LABELS
from garage2usd.reading.labels import Labels, read_labels
from garage2usd.reading.lanes import read_lanes
from garage2usd.reading.levels import levels_of
from garage2usd.scenes.looks import MeshLooks
from garage2usd.scenes.meshes import DRAWN_TYPES, Triangles
from garage2usd.scenes.prims import DrawnPart, Matrix, PlacedObject, once_for_each_look
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.values import metres_per_unit, metres_y_up
from garage2usd.scenes.walk import placed_objects

_STALLS = "stalls"
_STALL = "parking_stall"
_IDENTITY = np.eye(4)
_MATTE = 0.5
"""Roughness above which reflections of a surface are indistinct."""


def write_glb(
    stage: Usd.Stage,
    path: Path,
    *,
    labels: Labels | None = None,
    objects: Iterable[PlacedObject] | None = None,
    remarks: Remarks | None = None,
) -> None:
    """Write a composed stage as a binary glTF 2.0 file, in metres with Y up.

    Parameters
    ----------
    stage
        The stage.
    path
        The file, in an existing folder.
    labels
        Table of labels with instance ids; if left out, read by `garage2usd.reading.labels.read_labels`.
    objects
        Objects from `garage2usd.scenes.walk.placed_objects` in metres with Y up, if already known.
    remarks
        Receives remarks on features that glTF lacks.

    Raises
    ------
    StageError
        If the stage has nothing to draw, or the file beside it is not a table of labels.

    Notes
    -----
    Each object is a node with the path of its prim as its name and, as ``extras``, its class, its instance id and, for
    cars and stalls, the stall; painted parts are nodes below it. Objects of equal look share one mesh, with primitives
    by material. Faceted primitives have no normals, as glTF 2.0 (3.7.2.1) specifies. Each light is a node: a point, a
    spot or a sun. glTF has no area lights, so an area light is omitted if its lamp is emissive. Below the node
    ``stalls`` each stall is a node in the middle of its outline, whose Z axis leads to its mouth.

    Each level of a garage of several levels is a node at its floor, with its name and floor height as ``extras``; its
    objects, lights and stalls are nodes below it.
    """
    remarks, file = Remarks() if remarks is None else remarks, stage.GetRootLayer().realPath
    looks = Looks(remarks)
    glb = GlbFile(looks.pictures, remarks)
    labels = labels or read_labels(stage, Path(file) if file else None)
    look_of = once_for_each_look(looks.of)
    objects = placed_objects(stage, metres_y_up(stage)) if objects is None else objects
    looked_at = [(placed, look_of(placed)) for placed in objects]
    drawn = [(placed, look) for placed, look in looked_at if look.pieces]
    if not any(look.pieces or look.lights for _, look in looked_at):
        raise StageError(file, "nothing in it can be drawn")
    levels = _levels(glb, stage)
    homes = _parked(drawn, levels)
    mesh_of = once_for_each_look(lambda placed: glb.add_mesh(look_of(placed).pieces, name=_name(placed)))
    matrices = np.array([placed.matrix for placed, _ in drawn]).reshape(-1, 4, 4)
    rigid = are_rigid(matrices)
    inverses = np.zeros_like(matrices)
    inverses[rigid] = rigid_inverses(matrices[rigid])
    node_of: dict[str, tuple[int, Matrix]] = {}
    for (placed, look), is_rigid, inverse in zip(drawn, rigid.tolist(), inverses, strict=True):
        number = labels.ids.get(placed.path)
        level = _level_of(placed.path, levels)
        stall = level.stalls.at(placed.matrix) if placed.label == _STALL else homes.get(placed.path)
        extras: dict[str, Any] = {"class": placed.label} if placed.label else {}
        extras |= {} if number is None else {"id": number}
        extras |= {} if stall is None else {"stall": level.stalls.facts(stall)}
        if is_rigid:
            above, inverse_above = node_of.get(placed.path.rpartition("/")[0], (level.node, level.inverse))
            place = placed.matrix if inverse_above is None else placed.matrix @ inverse_above  # moves with its object
            node = glb.add_node(placed.path, place, mesh=mesh_of(placed), above=above, extras=extras)
            if placed.label not in PIECE_LABELS:
                node_of[placed.path] = node, inverse
        else:  # a node cannot hold this transform: it is applied to the vertices
            pieces = [piece._replace(triangles=piece.triangles.moved(placed.matrix)) for piece in look.pieces]
            mesh = glb.add_mesh(pieces, name=_name(placed))
            glb.add_node(placed.path, level.own(_IDENTITY), mesh=mesh, above=level.node, extras=extras)
    units = metres_per_unit(stage)
    for placed, look in looked_at:
        level = _level_of(placed.path, levels)
        for reason, part in look.left_out:
            remarks.add(reason, placed.path + part.path)
        for part in look.lights:
            name, matrix = placed.path + part.path, part.matrix @ placed.matrix
            light = punctual_light(part.prim, name, matrix, units, remarks)
            if light is not None:
                name = name if part.path or not look.pieces else f"{name}/light"
                glb.add_light(name, level.own(place_of(matrix)), light, above=level.node)
    for level in levels:
        _add_stalls(glb, level)
    path.write_bytes(glb.data({name: str(value) for name, value in stage_facts(stage).items()}))


class _Level(NamedTuple):
    """A level of a garage of several levels, or the whole garage if `path` is empty.

    Attributes
    ----------
    path
        Path of its prim.
    node
        Index of its node; None for none.
    inverse
        Transform from the scene to that node's space; None for none.
    stalls
        Its stalls.
    """

    path: str
    node: int | None
    inverse: Matrix | None
    stalls: StallFacts

    def has(self, path: str) -> bool:
        """True if a prim is on the level."""
        return path.startswith(f"{self.path}/")

    def own(self, place: Matrix) -> Matrix:
        """Convert a transform to the scene into one to the space of the level's node."""
        return place if self.inverse is None else place @ self.inverse


def _levels(glb: GlbFile, stage: Usd.Stage) -> list[_Level]:
    """Add the nodes of the levels of a garage of several; return the levels, then the rest of the garage."""
    lanes, found = read_lanes(stage).stalls, []
    places = [place for place in levels_of(stage) if not place.is_only]
    for number, place in enumerate(places):
        matrix, inverse = np.eye(4), np.eye(4)
        matrix[3, 1], inverse[3, 1] = place.floor_m, -place.floor_m
        node = glb.add_node(place.path, matrix, extras={"level": place.name, "floor_m": place.floor_m})
        stalls = StallFacts([stall for stall in lanes if stall.level == number], floor_m=place.floor_m)
        found.append(_Level(place.path, node, inverse, stalls))
    return [*found, _Level("", None, None, StallFacts(() if places else lanes))]


def _level_of(path: str, levels: Sequence[_Level]) -> _Level:
    return next(level for level in levels if level.has(path))


def _parked(drawn: Sequence[tuple[PlacedObject, "Look"]], levels: Sequence[_Level]) -> dict[str, Stall | None]:
    """Park the cars of each level in its stalls; return the stall of each car by its path."""
    homes: dict[str, Stall | None] = {}
    for level in levels:
        cars = [
            (placed.path, ground)
            for placed, look in drawn
            if placed.label in CAR_LABELS and _level_of(placed.path, levels) is level
            if len(ground := look.on_ground(placed.matrix))
        ]
        homes |= level.stalls.park([path for path, _ in cars], hulls_of([ground for _, ground in cars]))
    return homes


class Look(NamedTuple):
    """The drawable parts of an object: triangles, outline and lights.

    Attributes
    ----------
    pieces
        Pieces in the object's space.
    points_m
        All points in the object's space; float, shape (n, 3). Kept for cars only.
    outline_m
        Corners of the convex hull of the points seen from above; float, shape (k, 3).
    lights
        The parts that are lights.
    left_out
        Reasons for omitted parts.
    """

    pieces: Sequence[Piece]
    points_m: NDArray[np.floating[Any]]
    outline_m: NDArray[np.floating[Any]]
    lights: Sequence[DrawnPart]
    left_out: Sequence[tuple[str, DrawnPart]]

    def on_ground(self, matrix: Matrix) -> NDArray[np.floating[Any]]:
        """Project the outline of a placed object to ground points (x, z)."""
        points_m = self.outline_m if are_upright(matrix[None]).all() else self.points_m
        placed: NDArray[np.floating[Any]] = (points_m @ matrix[:3, :3] + matrix[3, :3])[:, [0, 2]]
        return placed


class Looks:
    """Reader of objects' drawable parts, which reads each mesh and surface of the stage once."""

    def __init__(self, remarks: Remarks) -> None:
        self._looks = MeshLooks(remarks=remarks)
        self.pictures = self._looks.pictures
        self._facets_of = cache(
            lambda mesh, is_matte: tuple(by_facets(self._looks.meshes.values[mesh], is_matte=is_matte))
        )
        self._moved: dict[tuple[Triangles, bytes], Triangles] = {}
        self._joined = cache(joined)
        self._outline_of = cache(lambda triangles: _hull(triangles.positions_m[:, [0, 2]]))

    def of(self, placed: PlacedObject) -> Look:
        """Return an object's look, one piece for each surface; faceted triangles, without normals, are separate."""
        alike: dict[tuple[int, bool, bool, bool], list[Triangles]] = {}
        surfaces = self._looks.surfaces.values
        left_out: list[tuple[str, DrawnPart]] = []
        for part in placed.parts:
            kind = part.prim.GetTypeName()
            if kind in DRAWN_TYPES:
                for mesh, surface, _ in self._looks.of_part(placed, part):
                    is_bumpy = bool(surfaces[surface].normal_texture)
                    for is_faceted, triangles in self._facets_of(mesh, _is_matte(surfaces[surface])):
                        own = self._placed(triangles, part.matrix)
                        key = surface, own.double_sided, is_faceted and not is_bumpy, own.colours is not None
                        alike.setdefault(key, []).append(own)
            elif not part.prim.HasAPI(UsdLux.LightAPI):
                left_out.append((f"prims of the type {kind} are left out", part))
        # cars of different paints then share joined meshes, which are written once
        pieces = [
            Piece(self._joined(tuple(group)), surfaces[surface], is_faceted)
            for (surface, _, is_faceted, _), group in alike.items()
        ]
        glows = any(any(piece.surface.emissive_rgb) for piece in pieces)
        lights = [part for part in placed.parts if part.prim.HasAPI(UsdLux.LightAPI)]
        left_out += [(reason, part) for part in lights if (reason := why_left_out(part.prim, glows=glows))]
        lights = [part for part in lights if not why_left_out(part.prim, glows=glows)]
        if placed.label not in CAR_LABELS or not pieces:
            return Look(pieces, np.zeros((0, 3)), np.zeros((0, 3)), lights, left_out)
        points_m = np.concatenate([piece.triangles.positions_m for piece in pieces])
        outline = _hull(np.concatenate([self._outline_of(piece.triangles) for piece in pieces]))
        return Look(pieces, points_m, np.insert(outline, 1, 0.0, axis=1), lights, left_out)

    def _placed(self, triangles: Triangles, matrix: Matrix) -> Triangles:
        """Transform a part's triangles to the space of its object."""
        if np.array_equal(matrix, _IDENTITY):
            return triangles
        key = triangles, matrix.tobytes()
        if key not in self._moved:
            self._moved[key] = triangles.moved(matrix)
        return self._moved[key]


def _is_matte(surface: SurfaceLook) -> bool:
    return surface.roughness >= _MATTE and surface.metallic <= 1 - _MATTE and not surface.clearcoat


def _hull(points_m: NDArray[np.floating[Any]]) -> NDArray[np.float64]:
    """Compute the corners of the convex hull of points, shape (n, 2)."""
    corners: NDArray[np.float64] = shapely.get_coordinates(hulls_of([points_m]))
    return corners


def _name(placed: PlacedObject) -> str:
    return placed.path.rpartition("/")[2]


def _add_stalls(glb: GlbFile, level: _Level) -> None:
    stalls = level.stalls
    if not stalls.stalls:
        return
    group = glb.add_node(f"{level.path}/{_STALLS}" if level.path else _STALLS, _IDENTITY, above=level.node)
    for name, stall in stalls.by_name.items():
        (x, z), (mouth_x, mouth_z) = stall.centre, stall.outwards
        axes = (mouth_z, 0, -mouth_x, 0), (0, 1, 0, 0), (mouth_x, 0, mouth_z, 0)
        matrix = np.array([*axes, (x, 0, z, 1)])
        glb.add_node(f"{_STALLS}/{name}", matrix, above=group, extras={"stall": stalls.outline(stall)})
