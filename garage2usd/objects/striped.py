"""Black and yellow rubber bars, for speed bumps and wheel stops."""

import numpy as np

from garage2usd.assets.mesh import Asset, Collider, Face, make_part

__all__ = ["striped"]


def striped(profile: list[tuple[float, float]], start: float, step: float, count: int) -> Asset:
    """Make a black and yellow bar by extruding a profile (z, y) along X, from its -Z foot over the top."""
    black: list[Face] = []
    yellow: list[Face] = []
    for index in range(count):
        low, high = start + index * step, start + (index + 1) * step
        faces = yellow if index % 2 else black
        for (z0, y0), (z1, y1) in zip(profile, [*profile[1:], profile[0]], strict=True):
            faces.append(np.array([(low, y0, z0), (low, y1, z1), (high, y1, z1), (high, y0, z0)]))
        faces.append(np.array([(low, y, z) for z, y in reversed(profile)]))
        faces.append(np.array([(high, y, z) for z, y in profile]))
    parts = [
        make_part("Black", black, "rubber_black", collider=Collider.CONVEX_HULL),
        make_part("Yellow", yellow, "rubber_yellow", collider=Collider.CONVEX_HULL),
    ]
    return Asset(tuple(parts))
