"""Standing people."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from garage2usd.assets.figures import Figure, Outfit, figure_asset
from garage2usd.assets.mesh import Asset
from garage2usd.assets.poses import POSES
from garage2usd.objects.kind import Kind, Polygon, Spec, rectangle

KIND = Kind("person", number=45, label="person", cityscapes="person", group="Clutter")

_COAT, _JACKET, _SHIRT, _DRESS = Outfit.COAT, Outfit.JACKET, Outfit.SHIRT, Outfit.DRESS
PEOPLE: tuple[Figure, ...] = tuple(
    Figure(
        height,
        build,
        is_woman,
        outfit,
        f"cloth_{top}",
        f"cloth_{bottom}",
        f"leather_{shoes}",
        f"skin_{skin}",
        f"hair_{hair}",
        is_long,
    )
    for height, build, is_woman, outfit, top, bottom, shoes, skin, hair, is_long in (
        (1.80, 1.00, False, _JACKET, "navy", "denim", "brown", "pale", "brown", False),
        (1.74, 1.12, False, _JACKET, "grey", "black", "black", "tan", "black", False),
        (1.86, 0.95, False, _SHIRT, "white", "beige", "brown", "brown", "black", False),
        (1.70, 1.22, False, _SHIRT, "green", "denim", "black", "pale", "grey", False),
        (1.77, 1.02, False, _COAT, "black", "grey", "black", "pale", "grey", False),
        (1.83, 1.06, False, _JACKET, "red", "denim", "black", "dark", "black", False),
        (1.76, 1.00, False, _JACKET, "yellow", "navy", "black", "tan", "brown", False),
        (1.66, 0.98, True, _JACKET, "red", "black", "black", "pale", "blond", True),
        (1.62, 1.05, True, _COAT, "beige", "black", "brown", "tan", "brown", True),
        (1.71, 0.95, True, _DRESS, "navy", "navy", "black", "brown", "black", True),
        (1.58, 1.15, True, _SHIRT, "white", "denim", "brown", "tan", "black", False),
        (1.68, 1.00, True, _COAT, "grey", "denim", "black", "dark", "black", False),
        (1.64, 1.02, True, _DRESS, "green", "brown", "brown", "pale", "brown", True),
        (1.60, 1.10, True, _JACKET, "brown", "grey", "black", "pale", "grey", False),
    )
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
