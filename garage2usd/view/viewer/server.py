"""HTTP server of the viewer: loopback interface and fixed paths only, nothing is written."""

import http.server
import re
import threading
from collections.abc import Mapping
from http import HTTPStatus
from importlib import resources
from types import TracebackType
from typing import Self
from urllib.parse import urlsplit

from garage2usd.common.errors import OutputError
from garage2usd.view.viewer.agents import ShownTraffic
from garage2usd.view.viewer.scene import Scene
from garage2usd.view.viewer.wire import encode_colliders, encode_scene

HOST = "127.0.0.1"
_TYPES = {".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".txt": "text/plain"}
_SCENE, _COLLIDERS, _TEXTURES = "/scene.bin", "/colliders.bin", "/textures/"
_BINARY = "application/octet-stream"
_NUMBER = re.compile(r"[0-9]{1,6}")
_MOST_TEXTURE_BYTES = 1 << 26
_HEADERS = {
    # WebAssembly is needed for mesh simplification
    "Content-Security-Policy": "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; "
    "img-src 'self' blob: data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
}
_Answer = tuple[str, bytes]


def page_files() -> Mapping[str, _Answer]:
    """Load the files of the page: content type and bytes by path on the server."""
    found: dict[str, _Answer] = {}
    for file in (resources.files("garage2usd") / "view" / "page").iterdir():
        suffix = file.name[file.name.rfind(".") :]
        if suffix in _TYPES:
            found[f"/{file.name}"] = _TYPES[suffix], file.read_bytes()
    found["/"] = found["/index.html"]
    return found


class ViewerServer:
    """Server of the viewer page and a scene on the loopback interface, until it is closed.

    Parameters
    ----------
    port
        TCP port; 0 for any free port.

    Raises
    ------
    OutputError
        If the port is not available.

    Notes
    -----
    Requests are answered from a table of paths made in advance, so that no other file can be reached. Textures are
    addressed by index and sent only if their bytes are an image. Requests with a different Host header are rejected, so
    that no foreign host name that resolves to this machine (DNS rebinding) can read the stage.
    """

    def __init__(self, port: int = 0) -> None:
        self.files = page_files()
        self._ready = threading.Event()
        self._scene: Scene | None = None
        self._encoded = b""
        try:
            self._server = _Listener((HOST, port), _Handler)
        except (OSError, OverflowError) as error:
            raise OutputError(f"{HOST}:{port}", f"cannot listen here ({error})") from None
        self._server.viewer = self
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.1,), daemon=True)

    @property
    def port(self) -> int:
        """TCP port of the server."""
        return int(self._server.server_address[1])

    @property
    def url(self) -> str:
        """Address of the page."""
        return f"http://{HOST}:{self.port}/"

    @property
    def hosts(self) -> frozenset[str]:
        """Accepted values of the Host header."""
        return frozenset(f"{name}:{self.port}" for name in (HOST, "localhost"))

    def __enter__(self) -> Self:
        """Start to answer requests."""
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop the server and free the port."""
        self._ready.set()  # releases requests that wait for a scene
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()

    def show(self, scene: Scene, traffic: ShownTraffic | None = None) -> None:
        """Publish a scene, and traffic to play in it; requests for it wait until then."""
        self._encoded = encode_scene(scene, traffic)
        self._scene = scene
        self._ready.set()

    def answer(self, path: str) -> _Answer | None:
        """Content type and bytes for a path; None if there are none."""
        if path in {_SCENE, _COLLIDERS}:
            self._ready.wait()
            if self._scene is None:
                return None
            return _BINARY, self._encoded if path == _SCENE else encode_colliders(self._scene)
        if path.startswith(_TEXTURES):
            return self._texture(path.removeprefix(_TEXTURES))
        return self.files.get(path)

    def _texture(self, number: str) -> _Answer | None:
        self._ready.wait()
        scene = self._scene
        if scene is None or not _NUMBER.fullmatch(number) or int(number) >= len(scene.textures):
            return None
        bands = scene.textures[int(number)]
        # a single channel holds a number, not a colour
        shown = scene.pictures.composed(bands, is_srgb=all(band is not None for band in bands))
        return (shown.kind, shown.data) if len(shown.data) <= _MOST_TEXTURE_BYTES else None


class _Listener(http.server.ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    viewer: ViewerServer


class _Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    timeout = 60
    server: _Listener

    def version_string(self) -> str:
        """Value of the Server header."""
        return "garage2usd"

    def do_GET(self) -> None:
        """Answer a GET request."""
        self._respond(with_body=True)

    def do_HEAD(self) -> None:
        """Answer a HEAD request."""
        self._respond(with_body=False)

    def _respond(self, *, with_body: bool) -> None:
        viewer = self.server.viewer
        if self.headers.get("Host", "") not in viewer.hosts:
            self._send(HTTPStatus.MISDIRECTED_REQUEST, ("text/plain", b"not the name of this server\n"), with_body=True)
            return
        answer = viewer.answer(urlsplit(self.path).path)
        if answer is None:
            self._send(HTTPStatus.NOT_FOUND, ("text/plain", b"not here\n"), with_body=with_body)
        else:
            self._send(HTTPStatus.OK, answer, with_body=with_body)

    def _send(self, status: HTTPStatus, answer: _Answer, *, with_body: bool) -> None:
        kind, body = answer
        self.send_response(status)
        for name, value in {**_HEADERS, "Content-Type": kind, "Content-Length": str(len(body))}.items():
            self.send_header(name, value)
        self.end_headers()
        if with_body:
            self.wfile.write(body)

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002 - the name in the base class
        """Suppress log messages."""

    def handle(self) -> None:
        """Handle requests; a connection closed by the client is not an error."""
        try:
            super().handle()
        except (ConnectionError, TimeoutError):
            self.close_connection = True
