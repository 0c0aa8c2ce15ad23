"""The lane graph and the stalls of a stage."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom

from garage2usd.stage.reading import numbers_of
from garage2usd.view.viewer.scene import LaneCurves, StallOutline, moved

__all__ = ["lane_curves"]

_FACTS = ("id", "number", "type", "use", "row", "column", "entryEdge", "accessNode")
_CORNERS = 4


def lane_curves(guides: Sequence[Usd.Prim], to_metres: NDArray[np.float64]) -> LaneCurves | None:
    """What the curves ``Nodes``, ``Edges`` and ``Stalls`` say (see docs/stage.md); None where there are none.

    Parameters
    ----------
    guides
        Prims at and below which to look for them.
    to_metres
        From the stage's space to metres, Y up; shape (4, 4), points as rows.
    """
    curves = [prim for root in guides for prim in Usd.PrimRange(root) if prim.GetTypeName() == "BasisCurves"]
    nodes = next((prim for prim in curves if prim.HasAttribute("garage:lane:kind")), None)
    edges = next((prim for prim in curves if prim.HasAttribute("garage:lane:from")), None)
    stalls = next((prim for prim in curves if prim.HasAttribute("garage:stall:id")), None)
    if nodes is None and stalls is None:
        return None
    rings = [] if nodes is None else _curves(nodes, to_metres)
    middles = np.array([ring.mean(axis=0) for ring in rings], dtype=np.float32).reshape(-1, 3)
    kinds = [str(word) for word in _values(nodes, "garage:lane:kind")]
    pairs = np.array([_values(edges, "garage:lane:from"), _values(edges, "garage:lane:to")], dtype=np.int32)
    pairs = pairs.T.reshape(-1, 2) if pairs.ndim > 1 else np.zeros((0, 2), np.int32)
    ways = [str(word) == "forward" for word in _values(edges, "garage:lane:direction")]
    if len(pairs) and not 0 <= pairs.min() <= pairs.max() < len(middles):
        pairs, ways = pairs[:0], []
    return LaneCurves(
        nodes_m=middles,
        kinds=kinds if len(kinds) == len(middles) else [""] * len(middles),
        edges=pairs,
        forward=ways if len(ways) == len(pairs) else [False] * len(pairs),
        stalls=_stalls(stalls, to_metres),
    )


def _stalls(prim: Usd.Prim | None, to_metres: NDArray[np.float64]) -> Sequence[StallOutline]:
    if prim is None:
        return []
    outlines = _curves(prim, to_metres)
    columns = {name: _values(prim, f"garage:stall:{name}") for name in _FACTS}
    told = {name: values for name, values in columns.items() if len(values) == len(outlines)}
    return [
        StallOutline(
            facts={name: values[i] if isinstance(values[i], int) else str(values[i]) for name, values in told.items()},
            corners_m=outline[:, [0, 2]],
        )
        for i, outline in enumerate(outlines)
        if len(outline) == _CORNERS
    ]


def _curves(prim: Usd.Prim, to_metres: NDArray[np.float64]) -> list[NDArray[np.float32]]:
    """Points of each curve."""
    geometry = UsdGeom.BasisCurves(prim)
    points = numbers_of(geometry.GetPointsAttr(), np.float64, width=3)
    counts = numbers_of(geometry.GetCurveVertexCountsAttr(), np.int64)
    if counts.sum() != len(points) or (counts < 1).any():
        return []
    place = np.array(UsdGeom.XformCache().GetLocalToWorldTransform(prim)) @ to_metres
    return np.split(moved(points, place), np.cumsum(counts)[:-1])


def _values(prim: Usd.Prim | None, name: str) -> Sequence[str | int]:
    value = prim.GetAttribute(name).Get() if prim is not None and prim.HasAttribute(name) else None
    return list(value) if value is not None and hasattr(value, "__len__") else []
