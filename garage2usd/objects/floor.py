"""The floor of squares, open where stalls lie."""

from garage2usd.objects.kind import Kind
from garage2usd.objects.panel import PanelSpec

__all__ = ["KIND", "FloorSpec"]

KIND = Kind("floor", number=1, label="floor", cityscapes="road", is_solid=False)


class FloorSpec(PanelSpec, kind=KIND):
    """The floor of a square."""
