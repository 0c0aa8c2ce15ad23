"""Scenes of nuScenes: the stretches of a recording, each at one location."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import groupby

from garage2usd.garage.level_place import nearest_floor
from garage2usd.sensors.formats.nuscenes_locations import Location
from garage2usd.sensors.formats.nuscenes_map import GlobalFrame
from garage2usd.sensors.formats.recording import Shot

__all__ = ["Stretch", "stretches_of"]


@dataclass(frozen=True, eq=False)
class Stretch:
    """Consecutive poses of a recording at one location, which make a scene.

    Attributes
    ----------
    number
        Number of the scene, from 1.
    location
        The location.
    by_pose
        The shots of each pose.
    """

    number: int
    location: Location
    by_pose: Sequence[Sequence[Shot]]

    @property
    def name(self) -> str:
        """Name of the scene."""
        return f"scene-{self.number:04d}"

    def key(self, key: object) -> str:
        """Return the key of what each scene has a record of its own of; the first scene's is the given one."""
        return str(key) if self.number == 1 else f"{key} {self.name}"


def stretches_of(shots: Iterable[Shot], locations: Sequence[Location], world: GlobalFrame) -> list[Stretch]:
    """Divide a recording where the vehicle comes to another level, which is half way on a ramp.

    Parameters
    ----------
    shots
        Shots of sensors on the vehicle.
    locations
        The garage, or its levels.
    world
        The global frame, in which heights are measured.
    """
    floors_m = [location.floor_m or 0.0 for location in locations]

    def location_of(shots: Sequence[Shot]) -> int:
        return nearest_floor(floors_m, float((world.matrix @ shots[0].mount_to_world)[2, 3]))

    by_pose = [list(group) for _, group in groupby(sorted(shots, key=_pose), key=_pose)]
    return [
        Stretch(number, locations[index], list(group))
        for number, (index, group) in enumerate(groupby(by_pose, key=location_of), 1)
    ]


def _pose(shot: Shot) -> int:
    return shot.pose
