"""Concrete blocks and stair cores."""

from dataclasses import dataclass

import numpy as np
import shapely

from garage2usd.assets.faces import box_faces, frame_faces
from garage2usd.assets.mesh import Asset, Collider, Part, make_part
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle
from garage2usd.objects.signage import running_man
from garage2usd.objects.wall import dado_part

KIND = Kind("obstacle", number=6, label="obstacle", cityscapes="building", group="Obstacles")

_STRIPE_M = 0.12
_SIGN_OVER_DOOR_M = (2.3, 2.6)
"""Lower and upper edge of the exit sign over a stair core's door."""
_CORE_DOOR_M = (1.2, 0.09)
"""Width of a stair core's door with its frame, and its projection from the wall."""


@dataclass(frozen=True)
class ObstacleSpec(Spec, kind=KIND):
    """A concrete block or stair core; origin in the middle of its foot, door in the middle of the side facing +Z.

    Attributes
    ----------
    width_m, depth_m, height_m
        Extent of the block.
    has_door
        True for a stair core with a door.
    dado_m
        Height of a painted band at the foot, 0 for none; None for hazard stripes.
    """

    width_m: float
    depth_m: float
    height_m: float
    has_door: bool = True
    dado_m: float | None = None

    def asset(self) -> Asset:
        """Make the meshes of a concrete block: the band around its foot, and a core's door and exit sign."""
        x, z = self.width_m / 2, self.depth_m / 2
        top = _STRIPE_M * 3 if self.dado_m is None else self.dado_m
        band = box_faces((-x, 0, -z), (x, top, z), without="tb")
        body = box_faces((-x, top, -z), (x, self.height_m, z), without="b")
        block = [make_part("Core", body, "wall_concrete", collider=Collider.BOX)]
        if self.dado_m is None:
            block.insert(0, make_part("Band", band, "hazard", collider=Collider.BOX))
        elif self.dado_m:
            block.insert(0, dado_part("Band", band, self.dado_m, collider=Collider.BOX))
        if not self.has_door:
            return Asset(tuple(block))
        door = box_faces((-0.5, 0.0, z), (0.5, 2.1, z + 0.03), without="n")
        frame = frame_faces(0.5, 2.1, 0.08, z + 0.001, z + 0.045)
        handle = box_faces((0.34, 1.0, z + 0.03), (0.44, 1.03, z + 0.08))
        return Asset(
            (
                *block,
                make_part("Door", door, "door_steel", collider=Collider.BOX),
                make_part("Frame", frame, "steel_dark", collider=Collider.MESH),
                make_part("Handle", handle, "steel_galvanised", collider=Collider.BOX),
                *_exit_sign(z, self.height_m),
            ),
        )

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the concrete block and of its door with the frame."""
        x, z = self.width_m / 2, self.depth_m / 2
        block = rectangle(-x, -z, x, z)
        if not self.has_door:
            return (block,)
        half = min(_CORE_DOOR_M[0] / 2, x)
        return block, rectangle(-half, z, half, z + _CORE_DOOR_M[1])


def _exit_sign(face_m: float, height_m: float) -> list[Part]:
    """Make the green exit sign with the running man over a stair core's door; none if the ceiling is too low."""
    low, high = _SIGN_OVER_DOOR_M
    if high > height_m - _STRIPE_M:
        return []
    half, front, side = (high - low), face_m + 0.03, high - low
    plate = box_faces((-half, low, face_m), (half, high, front), without="n")
    drawn = shapely.get_parts(running_man())
    faces = [
        np.array([(x * side, low + y * side, front + 0.004) for x, y in list(triangle.exterior.coords)[-2::-1]])
        for shape in drawn
        for triangle in shapely.get_parts(shapely.constrained_delaunay_triangles(shape))
    ]
    faces = [face if np.cross(face[1] - face[0], face[2] - face[0])[2] > 0 else face[::-1] for face in faces]
    return [make_part("Sign", plate, "sign_green"), make_part("Pictogram", faces, "sign_white")]
