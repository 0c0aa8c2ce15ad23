"""What stands on the floor of a garage and a car could touch, as named shapes."""

import numpy as np
import shapely

from garage2usd.driving.obstacles import Obstacles
from garage2usd.layout import Layout, Placement

__all__ = ["fixed_objects", "object_name", "parked_cars"]


def fixed_objects(layout: Layout) -> Obstacles:
    """Everything in a garage that a car could touch, but the parked cars; each by its `object_name`.

    Notes
    -----
    Wheel stops count, as no tyre goes over them; the arms of all gates are down; speed bumps do not count, nor does
    what hangs over the cars or is painted.
    """
    objects = layout.placements
    is_fixed = np.array([spec.kind.name != "car" and bool(spec.outlines()) for spec in objects.specs])
    return _named_shapes(objects.at(np.flatnonzero(is_fixed[objects.spec])))


def parked_cars(layout: Layout) -> Obstacles:
    """The cars of a garage with their mirrors, each by its `object_name`."""
    return _named_shapes(layout.of_kind("car"))


def object_name(place: Placement) -> str:
    """A name that no other object of the garage has: ``r03_c07/Car_2`` on a square, else its own."""
    if place.square is None:
        return place.name
    row, col = place.square
    return f"r{row:02d}_c{col:02d}/{place.name}"


def _named_shapes(placements: tuple[Placement, ...] | list[Placement]) -> Obstacles:
    return Obstacles.of(
        (
            object_name(place),
            shapely.MultiPolygon([shapely.Polygon(outline) for outline in place.outlines()]),
        )
        for place in placements
    )
