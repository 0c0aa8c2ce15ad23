"""The viewer inside a notebook: a server in the background, and a frame with its page."""

from html import escape
from pathlib import Path
from types import TracebackType
from typing import Self

from garage2usd.driving.tracks import Tracks
from garage2usd.reading.files import open_stage
from garage2usd.view.viewer.agents import read_agents
from garage2usd.view.viewer.reading import Looks, read_scene
from garage2usd.view.viewer.scene import Scene
from garage2usd.view.viewer.server import ViewerServer

_LOOPBACK = " ".join(f"{scheme}://{host}:*" for scheme in ("http", "https") for host in ("localhost", "127.0.0.1"))
"""Pages that may show the viewer in a frame: those of this machine, as a Content-Security-Policy names them."""


class Viewer:
    """The viewer of a stage, which a notebook shows in a frame; its server runs until `close` or the kernel's end.

    Attributes
    ----------
    scene
        The stage as it is shown.
    """

    def __init__(self, scene: Scene, server: ViewerServer, height_px: int) -> None:
        self.scene = scene
        self._server: ViewerServer | None = server
        self._height_px = height_px

    @property
    def url(self) -> str | None:
        """Address of the page on this machine; None once the viewer is closed."""
        return self._server.url if self._server else None

    def close(self) -> None:
        """Stop the server and free its port; closing again does nothing."""
        server, self._server = self._server, None
        if server:
            server.__exit__(None, None, None)

    def __enter__(self) -> Self:
        """Return the viewer, which is closed in the end."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Close the viewer."""
        self.close()

    def _repr_html_(self) -> str:
        name = escape(self.scene.name)
        if not self.url:
            return f"<p>{name}: the viewer is closed</p>"
        return (
            f'<iframe src="{self.url}" title="{name}" width="100%" height="{self._height_px}" style="border:0" '
            'allow="fullscreen" sandbox="allow-scripts allow-same-origin allow-pointer-lock"></iframe>'
        )


def show(stage: str | Path, *, tracks: Tracks | None = None, port: int = 0, height_px: int = 600) -> Viewer:
    """Show a stage in a notebook, as ``garage2usd view`` does in a browser.

    >>> garage2usd.show(built.stage)  # the last line of a cell

    Parameters
    ----------
    stage
        Path of the stage (.usd, .usda, .usdc or .usdz).
    tracks
        Tracks of traffic to play.
    port
        TCP port on this machine; 0 for any free port.
    height_px
        Height of the frame in pixels; it is as wide as the cell.

    Raises
    ------
    StageError
        If the stage cannot be read.
    OutputError
        If the port is not available.

    Notes
    -----
    The server listens to this machine only, and pages of this machine only may show it in a frame. So the notebook must
    be open in a browser on the machine of its kernel, at ``localhost`` or ``127.0.0.1``.
    """
    path, looks = Path(stage), Looks()
    scene = read_scene(open_stage(path), path, looks)
    traffic = None if tracks is None else read_agents(tracks, looks)
    server = ViewerServer(port, framed_by=_LOOPBACK)
    server.show(scene, traffic)
    return Viewer(scene, server.__enter__(), height_px)
