"""The place of a level in its garage: its name, the path of its prim, and the height of its floor."""

from collections.abc import Sequence
from typing import NamedTuple

__all__ = ["GARAGE_NAME", "LEVELS_NAME", "ONLY_LEVEL", "LevelPlace", "level_name", "level_places", "nearest_floor"]

GARAGE_NAME, LEVELS_NAME = "Garage", "Levels"
"""Names of the prim of a garage, and of the prim below it that holds its levels where there are several."""
_DECIMALS = 6


class LevelPlace(NamedTuple):
    """The place of a level in its garage.

    Attributes
    ----------
    name
        Name of its prim, ``U1``; empty for the only level of a garage, whose prim is that of the garage.
    path
        Path of its prim.
    floor_m
        Height of its floor.
    """

    name: str
    path: str
    floor_m: float

    @property
    def is_only(self) -> bool:
        """True if the level is the whole garage."""
        return not self.name

    def in_whole(self, name: str, *, joint: str = "/") -> str:
        """Return the name in the whole garage of a stall or file of the level: ``U2/A1-08``, ``U2_plan``."""
        return name if self.is_only else f"{self.name}{joint}{name}"

    def own_name(self, name: str) -> str:
        """Return the name within the level of its stall that has a name in the whole garage."""
        return name.removeprefix(self.in_whole(""))

    def path_in_whole(self, place: str) -> str:
        """Return the path in the whole stage of a prim of the level's own; any other place after the level's name."""
        if self.is_only:
            return place
        root = f"/{self.path.split('/')[1]}"
        if place == root or place.startswith(f"{root}/"):
            return self.path + place[len(root) :]
        return self.in_whole(place) if place else self.name


ONLY_LEVEL = LevelPlace("", f"/{GARAGE_NAME}", 0.0)
"""The place of the only level of a garage."""


def level_places(count: int, storey_m: float) -> list[LevelPlace]:
    """Return the places of the levels of a garage, the top one first, whose floor lies at 0."""
    if count == 1:
        return [ONLY_LEVEL]
    return [
        LevelPlace(name, f"/{GARAGE_NAME}/{LEVELS_NAME}/{name}", round(-number * storey_m, _DECIMALS) + 0.0)
        for number, name in enumerate(map(level_name, range(count)))
    ]


def level_name(level: int) -> str:
    """Name of a level by its number from 0: ``U1`` is the first one below the street."""
    return f"U{level + 1}"


def nearest_floor(floors_m: Sequence[float], height_m: float) -> int:
    """Return the index of the floor of the level at a height; on a ramp it changes half way."""
    return min(range(len(floors_m)), key=lambda index: abs(floors_m[index] - height_m))
