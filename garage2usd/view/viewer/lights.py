"""Lights of a stage, converted for the viewer."""

import numpy as np
from pxr import Usd

from garage2usd.reading.lights import light_of
from garage2usd.scenes.objects import Matrix
from garage2usd.view.viewer.scene import Light

__all__ = ["placed_light"]


def placed_light(prim: Usd.Prim, within: Matrix, to_world: Matrix, metres_per_unit: float) -> Light:
    """Convert a UsdLux light to its object's space.

    Parameters
    ----------
    prim
        The light.
    within, to_world
        Transforms from the light's space to that of the object, and to the world in metres.
    metres_per_unit
        Length unit of the stage.
    """
    source = light_of(prim, to_world, metres_per_unit)
    sizes = np.maximum(np.linalg.norm(to_world[:2, :3], axis=1), np.finfo(np.float64).tiny)
    return Light(
        kind=source.kind,
        matrix=within,
        width_m=float(source.width_m / sizes[0]),
        height_m=float(source.height_m / sizes[1]),
        colour_rgb=source.colour_rgb,
        candela=source.candela,
    )
