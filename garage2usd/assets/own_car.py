"""Assets of the user's car models: meshes and materials of the model, with convex hulls as colliders."""

import re
from typing import TYPE_CHECKING

import numpy as np

from garage2usd.assets.materials import Finish, Material, StoredTexture, Touch
from garage2usd.assets.mesh import (
    MIN_AREA_M2,
    WELD_DECIMALS,
    Asset,
    Collider,
    Part,
    distinct_normals,
    make_part,
    unique_rows,
)
from garage2usd.config.own_cars import OwnCar, placed_parts

if TYPE_CHECKING:  # reading models imports USD, and few garages have any
    from garage2usd.scenes.foreign_models import ForeignPart
    from garage2usd.scenes.plain_surfaces import PlainPicture, PlainSurface

_CREASE_DEG = 40.0
_SMALLEST_HULL_M = 0.5
"""Size in all directions below which a part has no collider of its own."""
_LEAST_AREA_M2 = 1.01 * MIN_AREA_M2
_OPAQUE = 0.9
_USUAL_IOR = 1.5
_WORDS = {
    "glass": re.compile(r"(?i)glass|window|windscreen|windshield"),
    "tyre": re.compile(r"(?i)tyre|tire|rubber"),
    "rim": re.compile(r"(?i)rim|alloy"),
    "lamp_front": re.compile(r"(?i)head_?(lamp|light)"),
    "lamp_rear": re.compile(r"(?i)(tail|rear|brake)_?(lamp|light)"),
}
"""Patterns of names that determine friction and non-visual properties of a material; car paint by default."""


def own_car(car: OwnCar) -> Asset:
    """Make the asset of a car model; origin in the centre of its footprint on the floor, nose along -Z.

    Raises
    ------
    ConfigError
        If its file cannot be read, or has changed since the settings were read.
    """
    keys: dict[tuple[str, PlainSurface], str] = {}
    finishes: dict[str, Finish] = {}
    parts: list[Part] = []
    for given in placed_parts(car):
        kind = _kind(given)
        if (kind, given.surface) not in keys:
            key = keys[kind, given.surface] = f"{car.name}_{len(keys) + 1:02d}"
            finishes[key] = Finish(kind, _material(given.surface, kind))
        made = _part(f"Part_{len(parts) + 1:03d}", given, keys[kind, given.surface])
        if made is not None:
            parts.append(made)
    return Asset(tuple(parts), finishes=finishes)


def _kind(part: "ForeignPart") -> str:
    names = f"{part.surface.name} {part.name}"
    return next((kind for kind, words in _WORDS.items() if words.search(names)), "car_paint_white")


def _material(surface: "PlainSurface", kind: str) -> Material:
    def stored(stem: str, picture: "PlainPicture | None") -> StoredTexture | None:
        return StoredTexture(f"own_car_{stem}", picture.data, picture.suffix) if picture else None

    return Material(
        colour_rgb=surface.colour_rgb,
        tint_rgb=surface.colour_rgb if surface.picture else (1.0, 1.0, 1.0),
        colour_texture=stored("colour", surface.picture),
        packed_texture=stored("packed", surface.packed),
        normal_texture=stored("normal", surface.normals),
        roughness=surface.roughness,
        metallic=surface.metallic,
        opacity=surface.opacity if surface.opacity < _OPAQUE else 1.0,
        has_alpha=surface.has_alpha,
        clearcoat=surface.clearcoat,
        ior=surface.ior if surface.ior != _USUAL_IOR else None,
        wraps=surface.wraps,
        touch={"glass": Touch.PLASTIC, "tyre": Touch.RUBBER}.get(kind, Touch.STEEL),
    )


def _part(name: str, given: "ForeignPart", key: str) -> Part | None:
    """Weld the points of a part; None if no triangle has an area."""
    corners = np.round(given.triangles_m, WELD_DECIMALS) + 0.0
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    is_kept = np.linalg.norm(across, axis=1) > _LEAST_AREA_M2
    if not is_kept.any():
        return None
    corners = corners[is_kept]
    spans = np.ptp(corners.reshape(-1, 3), axis=0)
    collider = Collider.CONVEX_HULL if spans.max() >= _SMALLEST_HULL_M else None
    made = make_part(name, corners, "car_paint", collider=collider, crease_deg=_CREASE_DEG)
    normals, normal_indices = made.normals, made.normal_indices
    if given.normals is not None:
        normals, which = distinct_normals(given.normals[is_kept].reshape(-1, 3))
        normal_indices = which.astype(np.int32)
    st, st_indices = np.empty((0, 2)), np.empty(0, dtype=np.int64)
    if given.surface.picture or given.surface.packed or given.surface.normals:
        st, st_indices = unique_rows(np.round(given.st[is_kept].reshape(-1, 2), WELD_DECIMALS) + 0.0)
    return Part(
        name=name,
        points=made.points,
        face_counts=made.face_counts,
        face_indices=made.face_indices,
        normals=normals,
        normal_indices=normal_indices,
        st=st.astype(np.float32),
        st_indices=st_indices.astype(np.int32),
        material=key,
        collider=collider,
        double_sided=given.double_sided,
    )
