"""What objects are made of, as plain values: meshes, materials and textures, free of any file format."""

from garage2usd.assets.materials import MATERIALS, VARYING, Material, Touch
from garage2usd.assets.mesh import Asset, Collider, Part, RectLight, pascal_case

__all__ = ["MATERIALS", "VARYING", "Asset", "Collider", "Material", "Part", "RectLight", "Touch", "pascal_case"]
