"""The server of the viewer's page: this machine alone, fixed paths alone, nothing written."""

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
from garage2usd.view.viewer.scene import Scene
from garage2usd.view.viewer.wire import encode_colliders, encode_scene

__all__ = ["ViewerServer", "page_files"]

HOST = "127.0.0.1"
_TYPES = {".html": "text/html; charset=utf-8", ".js": "text/javascript", ".css": "text/css", ".txt": "text/plain"}
_SCENE, _COLLIDERS, _TEXTURES = "/scene.bin", "/colliders.bin", "/textures/"
_BINARY = "application/octet-stream"
_NUMBER = re.compile(r"[0-9]{1,6}")
_MOST_TEXTURE_BYTES = 1 << 26
_HEADERS = {
    # WebAssembly is what makes coarse meshes of fine ones
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
    """Type and bytes of each file of the page by its path on the server."""
    found: dict[str, _Answer] = {}
    for file in (resources.files("garage2usd") / "view" / "page").iterdir():
        suffix = file.name[file.name.rfind(".") :]
        if suffix in _TYPES:
            found[f"/{file.name}"] = _TYPES[suffix], file.read_bytes()
    found["/"] = found["/index.html"]
    return found


class ViewerServer:
    """Serves the page and, once one is shown, a scene, on the loopback interface until it is closed.

    Parameters
    ----------
    port
        TCP port; 0 for any that is free.

    Raises
    ------
    OutputError
        If the port cannot be had.

    Notes
    -----
    A request is answered from a table of paths made beforehand, so that none can reach another file; textures go by
    number, and only where their bytes are an image. Requests whose Host is not this server's are refused, so that no
    foreign name that was pointed here (DNS rebinding) can read the stage.
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
        """The port that it listens on."""
        return int(self._server.server_address[1])

    @property
    def url(self) -> str:
        """Address of the page."""
        return f"http://{HOST}:{self.port}/"

    @property
    def hosts(self) -> frozenset[str]:
        """What a request may call this server."""
        return frozenset(f"{name}:{self.port}" for name in (HOST, "localhost"))

    def __enter__(self) -> Self:
        """Start to answer."""
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop, and free the port."""
        self._ready.set()  # nobody waits any longer
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()

    def show(self, scene: Scene) -> None:
        """Answer requests for the scene, which wait until then."""
        self._encoded = encode_scene(scene)
        self._scene = scene
        self._ready.set()

    def answer(self, path: str) -> _Answer | None:
        """Type and bytes of what stands at a path; None for nothing."""
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
        # a channel of its own holds a number, and is no colour
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
        """What it calls itself."""
        return "garage2usd"

    def do_GET(self) -> None:
        """Answer a request."""
        self._respond(with_body=True)

    def do_HEAD(self) -> None:
        """Answer a request without its bytes."""
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
        """Keep quiet."""

    def handle(self) -> None:
        """Answer until the other side goes, which is not an error."""
        try:
            super().handle()
        except (ConnectionError, TimeoutError):
            self.close_connection = True
