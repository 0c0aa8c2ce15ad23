"""The meshes that stop light in a stage of garage2usd, read with pxr alone; no point instancers are followed."""

import numpy as np
from pxr import Usd, UsdGeom, UsdShade

from support.rays import fans


def solid_triangles(stage, ids, *, left_out=()):
    """Vertices, triangles, and the number of the object of each; less the sky, panes and stains.

    Parameters
    ----------
    stage
        With Y up, in metres.
    ids
        Number of each object by the path of its prim.
    left_out
        Numbers of objects.
    """
    places = UsdGeom.XformCache()
    vertices, triangles, owners, first = [], [], [], 0
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdGeom.Mesh):
            continue
        seen = UsdGeom.Imageable(prim)
        if seen.ComputePurpose() != "default" or seen.ComputeVisibility() == "invisible":
            continue
        owner = _owner(prim, ids)
        if owner in left_out or not _stops_light(prim):
            continue
        place = np.array(places.GetLocalToWorldTransform(prim))
        mesh = UsdGeom.Mesh(prim)
        points = np.array(mesh.GetPointsAttr().Get()) @ place[:3, :3] + place[3, :3]
        own = fans(mesh)
        vertices.append(points)
        triangles.append(own + first)
        owners.append(np.full(len(own), owner))
        first += len(points)
    return np.concatenate(vertices), np.concatenate(triangles), np.concatenate(owners)


def _owner(prim, ids):
    while prim and str(prim.GetPath()) not in ids:
        prim = prim.GetParent()
    return ids[str(prim.GetPath())] if prim else 0


def _stops_light(prim):
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    opacity = material.ComputeSurfaceSource()[0].GetInput("opacity") if material else None
    return not opacity or (not opacity.HasConnectedSource() and opacity.Get() > 0.5)
