"""Static models of an SDF world and their visuals: the levels of a garage, and each parked car."""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from pxr import UsdLux

from garage2usd.garage.levels import GARAGE_NAME, LevelPlace
from garage2usd.maps.glb import Look, Looks
from garage2usd.maps.glb_file import GlbFile, Piece
from garage2usd.maps.glb_meshes import are_rigid, joined
from garage2usd.maps.sdf_collisions import Z_UP
from garage2usd.objects import CAR_LABELS
from garage2usd.scenes.prims import Matrix, PlacedObject, once_for_each_look
from garage2usd.scenes.remarks import Remarks

_TO_NOSE = np.array([[0.0, 0.0, -1.0, 0.0], [-1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]])
"""From the axes of a car of the stage, whose nose looks to -Z, to x forward, y left, z up (REP 103)."""


class Model(NamedTuple):
    """A static model: a level, or a parked car.

    Attributes
    ----------
    name
        Its unique name.
    place
        From its frame to the world, for column vectors with Z up.
    objects
        Its objects.
    """

    name: str
    place: Matrix
    objects: list[PlacedObject]


class Visual(NamedTuple):
    """A node of the file of visuals, and its place in a model for points with Y up."""

    node: str
    place: Matrix


def models_of(levels: Sequence[LevelPlace], objects: Iterable[PlacedObject]) -> Iterator[Model]:
    """Sort objects into static models: the levels, what is on none of them, and each parked car with its parts."""
    names = dict.fromkeys([*(level.name or GARAGE_NAME for level in levels), GARAGE_NAME])
    buildings: dict[str, list[PlacedObject]] = {name: [] for name in names}
    cars: list[Model] = []
    for placed in objects:
        if cars and placed.path.startswith(f"{cars[-1].objects[0].path}/"):
            cars[-1].objects.append(placed)
        elif placed.label in CAR_LABELS and are_rigid(placed.matrix[None])[0]:
            axes = Z_UP @ placed.matrix.T @ np.linalg.inv(_TO_NOSE)
            axes[:3, :3] /= np.linalg.norm(axes[:3, :3], axis=0)
            cars.append(Model(f"Car_{len(cars) + 1}", axes, [placed]))
        else:
            home = next((level.name for level in levels if placed.path.startswith(f"{level.path}/")), "")
            buildings[home or GARAGE_NAME].append(placed)
    yield from (Model(name, np.eye(4), held) for name, held in buildings.items() if held)
    yield from cars


class Visuals:
    """The visuals of models as nodes of one GLB file, each of which Gazebo draws by its name."""

    def __init__(self, remarks: Remarks) -> None:
        looks = Looks(remarks)
        self.glb = GlbFile(looks.pictures, remarks, for_assimp=True)
        self._look_of, self._remarks = once_for_each_look(looks.of), remarks
        self._node_of: dict[int, str] = {}
        self.count = 0

    def of(self, model: Model) -> Iterator[Visual]:
        """Yield the visuals of a model: of a car those of its parts, of a building one for all."""
        if model.objects[0].label not in CAR_LABELS or np.array_equal(model.place, np.eye(4)):
            pieces = list(self._joined(model.objects))
            if pieces:
                yield self._add(model.name, pieces, Z_UP)
            return
        to_model = np.linalg.inv(model.place) @ Z_UP
        for placed in model.objects:
            look = self._look(placed)
            if look.pieces and not are_rigid(placed.matrix[None])[0]:  # a visual has no such place
                yield self._add(f"{model.name}_{self.count}", self._joined([placed]), to_model)
            elif look.pieces:
                mesh = self.glb.add_mesh(look.pieces, name=placed.path.rpartition("/")[2])
                if mesh not in self._node_of:
                    self._node_of[mesh] = self._add(f"Look_{len(self._node_of) + 1}", look.pieces, Z_UP).node
                yield Visual(self._node_of[mesh], to_model @ placed.matrix.T)

    def _look(self, placed: PlacedObject) -> Look:
        look = self._look_of(placed)
        for reason, part in look.left_out:
            if not part.prim.HasAPI(UsdLux.LightAPI):  # the world has lights of its own
                self._remarks.add(reason, placed.path + part.path)
        return look

    def _add(self, name: str, pieces: Iterable[Piece], place: Matrix) -> Visual:
        self.count += 1
        self.glb.add_node(name, np.eye(4), mesh=self.glb.add_mesh(pieces, name=name))
        return Visual(name, place)

    def _joined(self, objects: Iterable[PlacedObject]) -> Iterator[Piece]:
        """Join the pieces of objects that have one surface, so that Gazebo draws few large meshes."""
        alike: dict[tuple[int, bool, bool, bool], list[Piece]] = defaultdict(list)
        for placed in objects:
            for piece in self._look(placed).pieces:
                own = piece.triangles.moved(placed.matrix)
                key = id(piece.surface), own.double_sided, piece.is_faceted, own.colours is not None
                alike[key].append(piece._replace(triangles=own))
        for pieces in alike.values():
            yield pieces[0]._replace(triangles=joined([piece.triangles for piece in pieces]))
