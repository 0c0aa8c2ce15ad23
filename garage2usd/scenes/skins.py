"""Meshes of UsdSkel in the rest pose of their skeletons."""

import numpy as np
from pxr import Usd, UsdGeom, UsdSkel, Vt

from garage2usd.scenes.values import READ_AT


def pose_skins(stage: Usd.Stage) -> None:
    """Author the points of skinned meshes, in the rest pose of their skeletons, in the stage's session layer.

    Instances that hold such meshes are resolved first, as prims below an instance cannot be authored.
    """
    stage.SetEditTarget(stage.GetSessionLayer())
    cache = UsdSkel.Cache()
    prims = list(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    for root in [prim for prim in prims if prim.IsA(UsdSkel.Root)]:
        for prim in root.GetPath().GetPrefixes():
            if stage.GetPrimAtPath(prim).IsInstance():
                stage.GetPrimAtPath(prim).SetInstanceable(False)
        own = UsdSkel.Root(stage.GetPrimAtPath(root.GetPath()))
        cache.Populate(own, Usd.TraverseInstanceProxies())
        for binding in cache.ComputeSkelBindings(own, Usd.TraverseInstanceProxies()):
            skeleton = cache.GetSkelQuery(binding.GetSkeleton())
            joints = _resting(skeleton)
            for target in binding.GetSkinningTargets():
                _pose(target, skeleton.GetPrim(), joints)


def _resting(skeleton: UsdSkel.SkeletonQuery) -> Vt.Matrix4dArray:
    """Return the transforms of points from the bind pose of each joint to its rest pose; empty if a pose is missing."""
    resting = skeleton.ComputeJointSkelTransforms(READ_AT, atRest=True)
    world = skeleton.GetSkeleton().GetBindTransformsAttr().Get()
    if not resting or not world or len(resting) != len(world):
        return Vt.Matrix4dArray()
    return Vt.Matrix4dArray([bind.GetInverse() * rest for bind, rest in zip(world, resting, strict=True)])


def _pose(target: UsdSkel.SkinningQuery, skeleton: Usd.Prim, joints: Vt.Matrix4dArray) -> None:
    """Author the points of one mesh."""
    prim = target.GetPrim()
    points = UsdGeom.Mesh(prim).GetPointsAttr().Get(READ_AT) if prim.IsA(UsdGeom.Mesh) else None
    if not points or not joints or prim.IsInstanceProxy():
        return
    own, mapper = joints, target.GetJointMapper()
    if mapper:
        own = Vt.Matrix4dArray()
        if not mapper.RemapTransforms(joints, own):
            return
    posed = Vt.Vec3fArray(points)
    if not target.ComputeSkinnedPoints(own, posed, READ_AT):
        return
    places = UsdGeom.XformCache(READ_AT)
    # the points of a skin are in the space of its skeleton
    matrix = places.GetLocalToWorldTransform(skeleton) * places.GetLocalToWorldTransform(prim).GetInverse()
    placed = np.asarray(posed, dtype=np.float64) @ np.array(matrix)[:3, :3] + np.array(matrix)[3, :3]
    if np.allclose(placed, np.asarray(points), atol=1e-6 * float(np.ptp(placed, axis=0).max(initial=1.0))):
        return
    mesh = UsdGeom.Mesh(prim)
    mesh.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(placed.astype(np.float32)))
    mesh.GetNormalsAttr().Block()
    primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar("normals")
    if primvar:
        primvar.GetAttr().Block()
