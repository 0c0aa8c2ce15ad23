"""HTTP servers of pages: loopback interface and fixed paths only. That of the viewer writes nothing."""

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
_NOT_HERE = "text/plain", b"not here\n"
_NUMBER = re.compile(r"[0-9]{1,6}")
_MOST_TEXTURE_BYTES = 1 << 26
# WebAssembly is needed for mesh simplification
_POLICY = (
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors "
)
_MOST_POSTED_BYTES = 1 << 24
_HEADERS = {
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
    "Cache-Control": "no-store",
}
Answer = tuple[str, bytes]
"""Content type and bytes."""


def page_files() -> Mapping[str, Answer]:
    """Load the files of the page: content type and bytes by path on the server."""
    found: dict[str, Answer] = {}
    for file in (resources.files("garage2usd") / "view" / "page").iterdir():
        suffix = file.name[file.name.rfind(".") :]
        if suffix in _TYPES:
            found[f"/{file.name}"] = _TYPES[suffix], file.read_bytes()
    found["/"] = found["/index.html"]
    return found


class LoopbackServer:
    """Server on the loopback interface, until it is closed.

    Parameters
    ----------
    port
        TCP port; 0 for any free port.
    framed_by
        Who may show its pages in a frame, as a Content-Security-Policy names it.

    Raises
    ------
    OutputError
        If the port is not available.

    Notes
    -----
    Requests with a different Host header are rejected, so that no foreign host name that resolves to this machine (DNS
    rebinding) can read what is served.
    """

    def __init__(self, port: int = 0, *, framed_by: str = "'none'") -> None:
        self.headers = {**_HEADERS, "Content-Security-Policy": _POLICY + framed_by}
        try:
            self._server = _Listener((HOST, port), _WritingHandler if self.takes_posts else _Handler)
        except (OSError, OverflowError) as error:
            raise OutputError(f"{HOST}:{port}", f"cannot listen here ({error})") from None
        self._server.viewer = self
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.1,), daemon=True)

    takes_posts = False
    """True if `posted` answers requests."""

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
        self._server.shutdown()
        self._thread.join()
        self._server.server_close()

    def answer(self, path: str) -> Answer | None:
        """Content type and bytes for a path; None if there are none."""
        raise NotImplementedError

    def posted(self, path: str, body: bytes) -> tuple[HTTPStatus, Answer] | None:
        """Answer a POST request to a path; None if there is nothing there."""
        raise NotImplementedError


class ShownScene:
    """The viewer's page, and a scene once it is published; requests for it wait until then.

    Notes
    -----
    Requests are answered from a table of paths made in advance, so that no other file can be reached. Textures are
    addressed by index and sent only if their bytes are an image.
    """

    def __init__(self) -> None:
        self.files = page_files()
        self._ready = threading.Event()
        self._scene: Scene | None = None
        self._encoded = b""

    def show(self, scene: Scene, traffic: ShownTraffic | None = None) -> None:
        """Publish a scene, and traffic to play in it."""
        self._encoded = encode_scene(scene, traffic)
        self._scene = scene
        self.release()

    @property
    def is_ready(self) -> bool:
        """True once a scene is published."""
        return self._scene is not None

    def release(self) -> None:
        """Let requests go that wait for a scene."""
        self._ready.set()

    def answer(self, path: str) -> Answer | None:
        """Content type and bytes for a path; None if there are none."""
        if path in {_SCENE, _COLLIDERS}:
            self._ready.wait()
            if self._scene is None:
                return None
            return _BINARY, self._encoded if path == _SCENE else encode_colliders(self._scene)
        if path.startswith(_TEXTURES):
            return self._texture(path.removeprefix(_TEXTURES))
        return self.files.get(path)

    def _texture(self, number: str) -> Answer | None:
        self._ready.wait()
        scene = self._scene
        if scene is None or not _NUMBER.fullmatch(number) or int(number) >= len(scene.textures):
            return None
        bands = scene.textures[int(number)]
        # a single channel holds a number, not a colour
        shown = scene.pictures.composed(bands, is_srgb=all(band is not None for band in bands))
        return (shown.kind, shown.data) if len(shown.data) <= _MOST_TEXTURE_BYTES else None


class ViewerServer(LoopbackServer):
    """Server of the viewer's page and a scene; parameters and errors as of `LoopbackServer`."""

    def __init__(self, port: int = 0, *, framed_by: str = "'none'") -> None:
        self._shown = ShownScene()
        super().__init__(port, framed_by=framed_by)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop the server and free the port."""
        self._shown.release()
        super().__exit__(kind, error, trace)

    def show(self, scene: Scene, traffic: ShownTraffic | None = None) -> None:
        """Publish a scene, and traffic to play in it; requests for it wait until then."""
        self._shown.show(scene, traffic)

    def answer(self, path: str) -> Answer | None:
        """Content type and bytes for a path; None if there are none."""
        return self._shown.answer(path)


class _Listener(http.server.ThreadingHTTPServer):
    daemon_threads = True
    block_on_close = False
    viewer: LoopbackServer


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
        if self._is_named():
            answer = self.server.viewer.answer(urlsplit(self.path).path)
            status = HTTPStatus.NOT_FOUND if answer is None else HTTPStatus.OK
            self._send(status, answer or _NOT_HERE, with_body=with_body)

    def _is_named(self) -> bool:
        """True if the request has this server's name; otherwise it is answered."""
        if self.headers.get("Host", "") in self.server.viewer.hosts:
            return True
        self._send(HTTPStatus.MISDIRECTED_REQUEST, ("text/plain", b"not the name of this server\n"), with_body=True)
        return False

    def _send(self, status: HTTPStatus, answer: Answer, *, with_body: bool) -> None:
        kind, body = answer
        self.send_response(status)
        for name, value in {
            **self.server.viewer.headers,
            "Content-Type": kind,
            "Content-Length": str(len(body)),
        }.items():
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


class _WritingHandler(_Handler):
    def do_POST(self) -> None:
        """Answer a POST request of this server's own page."""
        if not self._is_named():
            return
        server, length = self.server.viewer, self.headers.get("Content-Length", "")
        if self.headers.get("Origin", "") not in {f"http://{host}" for host in server.hosts}:
            self._send(HTTPStatus.FORBIDDEN, ("text/plain", b"not from this server's page\n"), with_body=True)
        elif not length.isdecimal() or int(length) > _MOST_POSTED_BYTES:
            self.close_connection = True
            self._send(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, ("text/plain", b"too long\n"), with_body=True)
        else:
            found = server.posted(urlsplit(self.path).path, self.rfile.read(int(length)))
            status, answer = found or (HTTPStatus.NOT_FOUND, _NOT_HERE)
            self._send(status, answer, with_body=True)
