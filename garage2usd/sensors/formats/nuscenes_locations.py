"""Locations of nuScenes: a garage of one level, or each level of a garage, with the ground of its map."""

from pathlib import Path
from typing import NamedTuple

from pxr import Usd

from garage2usd.reading.labels import Labels
from garage2usd.reading.levels import levels_of, paths_from_above
from garage2usd.sensors.formats.nuscenes_classes import FLAT

__all__ = ["Location", "locations_of"]


class Location(NamedTuple):
    """A location, which has one map.

    Attributes
    ----------
    name
        Name of the location and of the file of its map: the stage's, as ``two``, and of a level ``two_U1``.
    key
        Key of its log and of its map in the tables.
    floor_m
        Height of its floor.
    paths
        Beginnings of the paths of its objects: of a level its own, and of the ramps that lead down from it.
    """

    name: str
    key: str
    floor_m: float
    paths: tuple[str, ...]

    def grounds(self, labels: Labels) -> list[list[int]]:
        """Return the ids of the objects of the ground, in groups within which none lies above another."""
        flat = [*labels.paths_of(FLAT)]
        return [[labels.ids[path] for path in flat if path.startswith(start)] for start in self.paths]


def locations_of(stage: Usd.Stage, file: Path) -> list[Location]:
    """Return the locations of a stage: its levels, the top one first, or the garage of one level."""
    levels = levels_of(stage)
    return [
        Location(
            f"{file.stem}_{level.name}", f"{file.name} {level.name}", level.floor_m, paths_from_above(levels, number)
        )
        for number, level in enumerate(levels)
    ] or [Location(file.stem, file.name, 0.0, ("",))]
