"""The concrete floor of squares, with openings for the stalls."""

from garage2usd.objects.kind import Kind
from garage2usd.objects.panel import PanelSpec

KIND = Kind("floor", number=1, label="floor", cityscapes="road", is_solid=False)


class FloorSpec(PanelSpec, kind=KIND):
    """The floor panel of a square."""
