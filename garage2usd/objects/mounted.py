"""Objects that hang on walls and columns, as many as it takes for every place to have one within reach."""

from dataclasses import dataclass

from garage2usd.objects.kind import Kind, Spec

__all__ = ["Mounted"]


@dataclass(frozen=True)
class Mounted:
    """What a module declares as ``MOUNTED`` beside its kind, so that the layout places it.

    Attributes
    ----------
    spec
        The shape; origin on the floor, in the middle of its back, which touches what it hangs on; it looks to +Z.
    setting
        Name of its switch in the fittings.
    clause
        Name of the profile's clause on how far it serves.
    reach_m
        The same where the profile has none.
    count
        How many serve each place.
    spacing
        Name of the profile's clause on how far the next one of its kind is at most; None where that does not matter.
    is_walked
        Whether how far it serves is measured as people walk between rows of cars, along X and then along Z; else
        straight.
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
        """What it is."""
        return self.spec.kind

    @property
    def norm(self) -> int:
        """The Minkowski norm of its distance: 1 if it is walked along both axes, 2 if it is straight."""
        return 1 if self.is_walked else 2
