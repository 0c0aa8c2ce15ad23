"""Face subsets of a mesh by material."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray
from pxr import Usd, UsdGeom, UsdShade

from garage2usd.common.errors import StageError
from garage2usd.scenes.values import READ_AT, numbers_of

__all__ = ["face_sets"]


def face_sets(prim: Usd.Prim) -> Iterator[tuple[Usd.Prim, NDArray[np.intp] | None]]:
    """Split a mesh into the face subsets with materials of their own and the remaining faces.

    Yields
    ------
    tuple
        The prim with the material binding, and the numbers of its faces; None for all.

    Raises
    ------
    StageError
        If a subset names a face that the mesh lacks.
    """
    children = prim.GetFilteredChildren(Usd.TraverseInstanceProxies())
    subsets = [child for child in children if child.IsA(UsdGeom.Subset) and _is_bound(child)]
    if not subsets:
        yield prim, None
        return
    faces_of = [numbers_of(UsdGeom.Subset(child).GetIndicesAttr(), np.intp) for child in subsets]
    count = len(numbers_of(UsdGeom.Mesh(prim).GetFaceVertexCountsAttr(), np.int64))
    for subset, faces in zip(subsets, faces_of, strict=True):
        wrong = faces[(faces < 0) | (faces >= count)].tolist()
        if wrong:
            file = prim.GetStage().GetRootLayer().realPath
            raise StageError(file, f"{subset.GetPath()} names face {wrong[0]} of {count}")
        yield subset, faces
    rest = np.setdiff1d(np.arange(count), np.concatenate(faces_of))
    if len(rest):
        yield prim, rest


def _is_bound(subset: Usd.Prim) -> bool:
    """Return True if a subset consists of faces and has a material of its own."""
    if UsdGeom.Subset(subset).GetElementTypeAttr().Get(READ_AT) != UsdGeom.Tokens.face:
        return False
    bindings = UsdShade.MaterialBindingAPI(subset)
    purposes = UsdShade.Tokens.allPurpose, UsdShade.Tokens.preview
    return any(bindings.GetDirectBindingRel(purpose).HasAuthoredTargets() for purpose in purposes) or any(
        bindings.GetCollectionBindings(purpose) for purpose in purposes
    )
