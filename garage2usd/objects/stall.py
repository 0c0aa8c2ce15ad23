"""The coated floor of stalls."""

from garage2usd.objects.kind import Kind, TilePart
from garage2usd.objects.panel import PanelSpec

__all__ = ["KIND", "StallSpec"]

KIND = Kind("stall", number=2, label="parking_stall", cityscapes="parking", is_solid=False, part=TilePart.PARKING)


class StallSpec(PanelSpec, kind=KIND):
    """The floor panel of a stall."""
