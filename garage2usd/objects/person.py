"""Standing people."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from garage2usd.assets.figures import Figure, Outfit, figure_asset
from garage2usd.assets.mesh import Asset
from garage2usd.assets.poses import POSES
from garage2usd.common.documents import shipped_toml
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("person", number=45, label="person", cityscapes="person", group="Clutter")

PEOPLE: tuple[Figure, ...] = tuple(
    Figure(**{**given, "outfit": Outfit(given["outfit"])})
    for given in shipped_toml("garage2usd.objects", "people")["people"]
)
"""The figures of people, each in different clothes."""


@dataclass(frozen=True)
class PersonSpec(Spec, kind=KIND):
    """A standing person; origin on the floor below the hips, facing +Z.

    Attributes
    ----------
    number
        Index in `PEOPLE`.
    pose
        Name of a pose of `garage2usd.assets.poses.POSES`.
    """

    number: int
    pose: str = "standing"

    @property
    def mass_kg(self) -> float:
        """Mass of the person by stature, a body mass index of 23 and the build: 75 kg at 1.80 m."""
        figure = PEOPLE[self.number]
        return round(23.0 * figure.height_m**2 * figure.build**2, 1)

    def asset(self) -> Asset:
        """Make the meshes of a dressed person with any carried things."""
        return figure_asset(PEOPLE[self.number], POSES[self.pose])

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the bounding rectangle of the person on the floor."""
        return _outlines(self)


@lru_cache
def _outlines(spec: PersonSpec) -> tuple[Polygon, ...]:
    points = np.concatenate([part.points[:, [0, 2]] for part in spec.asset().parts]).astype(float)
    (left, top), (right, bottom) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return (
        rectangle(round(left - 0.001, 4), round(top - 0.001, 4), round(right + 0.001, 4), round(bottom + 0.001, 4)),
    )
