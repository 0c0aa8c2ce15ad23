"""Outlines in (x, z), metres, in the coordinates of what they belong to."""

__all__ = ["Box", "Point", "Polygon", "rectangle", "square"]

Point = tuple[float, float]
Polygon = tuple[Point, ...]
"""Corners (x, z) in metres, without holes."""
Box = tuple[float, float, float, float]
"""An axis-aligned rectangle: left, top, right, bottom, in x and z."""


def rectangle(left: float, top: float, right: float, bottom: float) -> Polygon:
    """The corners of an axis-aligned rectangle, x from left to right and z from top to bottom."""
    return (left, top), (left, bottom), (right, bottom), (right, top)


def square(side_m: float) -> Polygon:
    """The corners of an axis-aligned square around the origin."""
    return rectangle(-side_m / 2, -side_m / 2, side_m / 2, side_m / 2)
