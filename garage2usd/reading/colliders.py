"""Colliders of a stage: the collision shapes of its prims by UsdPhysics."""

from pxr import Usd

from garage2usd.scenes.values import READ_AT

BOXES = frozenset({"boundingCube"})
HULLS = frozenset({"convexHull", "convexDecomposition", "boundingSphere"})
"""Approximations of a mesh by its bounding box, and those by its convex hull here; others are the mesh itself."""


def collider_of(prim: Usd.Prim) -> str:
    """Return UsdPhysics' approximation of a prim's collision shape; empty for a prim without collision."""
    if "PhysicsCollisionAPI" not in prim.GetAppliedSchemas():
        return ""
    enabled = prim.GetAttribute("physics:collisionEnabled").Get(READ_AT)
    if enabled is False:
        return ""
    return str(prim.GetAttribute("physics:approximation").Get() or "none")
