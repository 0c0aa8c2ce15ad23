"""View transform from light to the pictures that one looks at: one of those that Blender and three.js both have."""

__all__ = ["EXPOSURE_EV", "VIEW_TRANSFORM"]

VIEW_TRANSFORM = "AgX"
"""Its name in Blender; in three.js it is ``AgXToneMapping``."""
EXPOSURE_EV = 0.0
"""Exposure in stops of pictures that `garage2usd render` draws and of the viewer's."""
