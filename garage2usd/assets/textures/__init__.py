"""Shipped textures: procedural generators and location."""

from garage2usd.assets.textures.baking import bake_textures, texture_folder

__all__ = ["bake_textures", "texture_folder"]
