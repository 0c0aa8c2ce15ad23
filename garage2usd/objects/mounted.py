"""Rules for objects that hang on walls and columns within reach of every place, such as fire extinguishers."""

from dataclasses import dataclass

from garage2usd.objects.kind import Kind, Spec

__all__ = ["Mounted"]


@dataclass(frozen=True)
class Mounted:
    """The rules of a kind that hangs on walls and columns; a module declares them as ``MOUNTED``.

    Attributes
    ----------
    spec
        Shape of the object; origin on the floor, in the middle of its back on the wall, facing +Z.
    setting
        Name of its switch in the fittings.
    clause
        Name of the profile's clause on its reach.
    reach_m
        Reach in metres if the profile has no such clause.
    count
        Number of objects within reach of each place.
    spacing
        Name of the profile's clause on the largest distance to the next object of the kind; None without a limit.
    is_walked
        True if the reach is a walking distance between rows of cars, along X and then Z; else a straight distance.
    """

    spec: Spec
    setting: str
    clause: str
    reach_m: float
    count: int = 1
    spacing: str | None = None
    is_walked: bool = True

    @property
    def kind(self) -> Kind:
        """Kind of the mounted object."""
        return self.spec.kind

    @property
    def norm(self) -> int:
        """Minkowski norm of the reach: 1 for a walking distance along both axes, 2 for a straight one."""
        return 1 if self.is_walked else 2
