"""Outlines in (x, z), in metres and in local coordinates of their object."""

__all__ = ["Box", "Point", "Polygon", "rectangle", "square"]

Point = tuple[float, float]
Polygon = tuple[Point, ...]
"""Corners (x, z) in metres, without holes."""
Box = tuple[float, float, float, float]
"""An axis-aligned rectangle: left, top, right, bottom, in x and z."""


def rectangle(left: float, top: float, right: float, bottom: float) -> Polygon:
    """Return the corners of an axis-aligned rectangle outline, x from left to right and z from top to bottom."""
    return (left, top), (left, bottom), (right, bottom), (right, top)


def square(side_m: float) -> Polygon:
    """Return the corners of an axis-aligned square outline around the origin."""
    return rectangle(-side_m / 2, -side_m / 2, side_m / 2, side_m / 2)
