"""A stage in a browser: read with pxr, sent once to a page of this package."""

from garage2usd.view.viewer.reading import read_scene
from garage2usd.view.viewer.scene import Scene
from garage2usd.view.viewer.server import ViewerServer

__all__ = ["Scene", "ViewerServer", "read_scene"]
