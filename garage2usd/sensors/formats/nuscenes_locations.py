"""Locations of nuScenes: a garage of one level, or each level of a garage, which have a map each."""

from pathlib import Path
from typing import NamedTuple

from pxr import Usd

from garage2usd.reading.labels import Labels
from garage2usd.reading.levels import levels_of, paths_from_above

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
        Height of its floor; None in a garage of one level.
    paths
        Beginnings of the paths of its objects: of a level its own, and of the ramps that lead down from it.
    """

    name: str
    key: str
    floor_m: float | None
    paths: tuple[str, ...]

    def objects(self, labels: Labels, names: frozenset[str]) -> list[list[int]]:
        """Return the ids of the objects of some classes, for each of `paths`."""
        found = [*labels.paths_of(names)]
        return [[labels.ids[path] for path in found if path.startswith(start)] for start in self.paths]


def locations_of(stage: Usd.Stage, file: Path) -> list[Location]:
    """Return the locations of a stage: its levels, the top one first, each of which is a map of its own."""
    levels = levels_of(stage)
    return [
        Location(
            "_".join(filter(None, (file.stem, level.name))),
            " ".join(filter(None, (file.name, level.name))),
            None if level.is_only else level.floor_m,
            paths_from_above(levels, number),
        )
        for number, level in enumerate(levels)
    ]
