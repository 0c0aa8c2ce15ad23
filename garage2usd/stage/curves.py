"""Guide curves above the floor of a USD stage."""

import numpy as np
from numpy.typing import NDArray
from pxr import Sdf, UsdGeom, Vt

from garage2usd.stage.authoring import attribute, define

__all__ = ["author_curves"]

_TYPES = Sdf.ValueTypeNames


def author_curves(
    layer: Sdf.Layer,
    path: Sdf.Path,
    line_m: NDArray[np.float64],
    counts: NDArray[np.int32],
    *,
    lift_m: float | NDArray[np.float64],
    width_m: float,
    closed: bool = False,
) -> Sdf.PrimSpec:
    """Straight lines from point to point.

    Parameters
    ----------
    layer, path
        Where the prim that holds all curves is authored.
    line_m
        The points (x, z) of all curves, one after the other; float64, shape (points, 2).
    counts
        Number of points of each curve; int32, shape (curves,).
    lift_m
        Height of the points; one, or float64, shape (points,).
    width_m
        Width of the drawn line.
    closed
        True if the curves are closed.
    """
    points = np.empty((len(line_m), 3), dtype=np.float32)
    points[:, [0, 2]], points[:, 1] = line_m, lift_m
    prim = define(layer, path, "BasisCurves")
    attribute(prim, "type", _TYPES.Token, UsdGeom.Tokens.linear, uniform=True)
    wrap = UsdGeom.Tokens.periodic if closed else UsdGeom.Tokens.nonperiodic
    attribute(prim, "wrap", _TYPES.Token, wrap, uniform=True)
    attribute(prim, "curveVertexCounts", _TYPES.IntArray, Vt.IntArray.FromNumpy(counts))
    vectors = Vt.Vec3fArray.FromNumpy(points)
    attribute(prim, "points", _TYPES.Point3fArray, vectors)
    widths = Vt.FloatArray([width_m])
    attribute(prim, "widths", _TYPES.FloatArray, widths).SetInfo("interpolation", UsdGeom.Tokens.constant)
    attribute(prim, "extent", _TYPES.Float3Array, UsdGeom.Curves.ComputeExtent(vectors, widths))
    return prim
