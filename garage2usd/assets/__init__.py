"""Meshes, materials and textures of objects as plain values, independent of file formats."""

from garage2usd.assets.materials import (
    GLOSSES,
    MATERIALS,
    VARYING,
    Finish,
    Material,
    OwnTexture,
    PaintedTexture,
    Rgb,
    StoredTexture,
    Texture,
    Touch,
    finished,
)
from garage2usd.assets.mesh import WELD_DECIMALS, AreaLight, Asset, Collider, Part, pascal_case
from garage2usd.assets.non_visual import BASE_OF_TOUCH, NON_VISUAL, NonVisual

__all__ = [
    "BASE_OF_TOUCH",
    "GLOSSES",
    "MATERIALS",
    "NON_VISUAL",
    "VARYING",
    "WELD_DECIMALS",
    "AreaLight",
    "Asset",
    "Collider",
    "Finish",
    "Material",
    "NonVisual",
    "OwnTexture",
    "PaintedTexture",
    "Part",
    "Pose",
    "Rgb",
    "StoredTexture",
    "Texture",
    "Touch",
    "finished",
    "pascal_case",
]
