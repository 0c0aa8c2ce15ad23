"""Viewer of a stage in a browser: the stage is read with pxr and sent once to the package's page."""

from garage2usd.view.viewer.agents import ShownTraffic, read_agents
from garage2usd.view.viewer.reading import Looks, read_scene
from garage2usd.view.viewer.scene import Scene
from garage2usd.view.viewer.server import LoopbackServer, ShownScene, ViewerServer

__all__ = [
    "Looks",
    "LoopbackServer",
    "Scene",
    "ShownScene",
    "ShownTraffic",
    "ViewerServer",
    "read_agents",
    "read_scene",
]
