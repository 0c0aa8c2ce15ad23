"""A garage with cars over their lines and misparked ones, and the truth of it by shapely alone."""

import shapely

from support.footprints import footprint

SETTINGS = {
    "seed": 3,
    "site": {"width_cells": 7, "height_cells": 6},
    "plan": {"episodes": 200},
    "parking": {"misparked": 0.25, "over_line": 0.2, "market": "germany"},
    "stage": {"texture_quality": "low"},
}


def homes_of(layout):
    """Name of the stall in which the middle of each car lies."""
    grounds = {stall.name: shapely.Polygon(stall.corners_m()) for stall in layout.stalls}
    middles = [footprint(car).centroid for car in layout.of_kind("car")]
    return [next(name for name, ground in grounds.items() if ground.covers(middle)) for middle in middles]


def taken_in(layout):
    """Names of the stalls that are taken: by cars of their own, or blocked by what reaches far into them."""
    return set(homes_of(layout)) | set(layout.blocked)
