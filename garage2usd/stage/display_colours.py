"""Display colour of an asset, for viewers that do not draw materials."""

from collections.abc import Mapping

import numpy as np

from garage2usd.assets import Asset, Finish, Part, Rgb, finished
from garage2usd.assets.colours import material_colour

__all__ = ["display_colour"]


def display_colour(asset: Asset, finishes: Mapping[str, Finish]) -> Rgb:
    """Linear colour of the material that covers most of an asset's surface."""
    areas_m2 = dict.fromkeys((part.material for part in asset.parts), 0.0)
    if len(areas_m2) > 1:
        for part in asset.parts:
            areas_m2[part.material] += _area_m2(part)
    most = max(areas_m2, key=areas_m2.__getitem__)
    return material_colour(finished(most, finishes).material)


def _area_m2(part: Part) -> float:
    """Total area in square metres of a part's faces, each a fan of triangles around its first corner."""
    counts = part.face_counts
    corners = part.points[part.face_indices].astype(np.float64)
    starts = np.cumsum(counts) - counts
    first = np.repeat(corners[starts], counts, axis=0)
    crosses = np.cross(corners[:-1] - first[:-1], corners[1:] - first[1:])
    follows = np.repeat(np.arange(len(counts)), counts)
    inner = follows[:-1] == follows[1:]
    sums = np.zeros((len(counts), 3))
    np.add.at(sums, follows[:-1][inner], crosses[inner])
    return float(np.linalg.norm(sums, axis=1).sum() / 2)
