"""HTTP server of the page on which garages are drawn: loopback only, for those who know the address with its token."""

import json
import secrets
from http import HTTPStatus
from types import TracebackType
from typing import TYPE_CHECKING, Any

from garage2usd.common.errors import Garage2UsdError
from garage2usd.drafts.desk import Desk, RefusalError
from garage2usd.view.viewer import LoopbackServer
from garage2usd.view.viewer.server import Answer, page_files

if TYPE_CHECKING:
    from collections.abc import Callable

_PAGE = ("draw.html", "draw.css", "draw.js", "licenses.txt")
_JSON = "application/json"
_TOKEN_BYTES = 16


class DrawServer(LoopbackServer):
    """Server of the page on which a garage is drawn.

    Parameters
    ----------
    desk
        The drawing.
    port
        TCP port; 0 for any free port.

    Raises
    ------
    OutputError
        If the port is not available.

    Notes
    -----
    All paths begin with a token that is drawn at the start, so that neither other users of this machine nor other pages
    in the browser reach the drawing. Requests that change something must also come from this server's own page.
    """

    takes_posts = True

    def __init__(self, desk: Desk, port: int = 0) -> None:
        super().__init__(port, framed_by="'self'")
        self.desk = desk
        self._token = secrets.token_urlsafe(_TOKEN_BYTES)
        files = page_files()
        self._files = {name: files[f"/{name}"] for name in _PAGE}
        self._files[""] = self._files["draw.html"]
        self._told: dict[str, Callable[[], Any]] = {
            "state": desk.state,
            "controls": desk.controls,
            "findings": desk.findings,
            "progress": desk.progress,
            "file": desk.changed_outside,
        }
        self._done: dict[str, Callable[[dict[str, Any]], Any]] = {
            each.__name__: each
            for each in (
                desk.edit, desk.undo, desk.redo, desk.restore, desk.reload, desk.save, desk.learn, desk.stop,
                desk.adopt, desk.build,
            )
        }  # fmt: skip

    @property
    def url(self) -> str:
        """Address of the page, with the token."""
        return f"{super().url}{self._token}/"

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Stop the server and free the port."""
        self.desk.close()
        super().__exit__(kind, error, trace)

    def _name(self, path: str) -> str | None:
        """Return what follows the token; None for a path with another one."""
        _, token, *rest = [*path.split("/", 2), ""][:3]
        is_ours = secrets.compare_digest(token.encode(), self._token.encode()) and path.count("/") > 1
        return rest[0] if is_ours else None

    def answer(self, path: str) -> Answer | None:
        """Content type and bytes for a path; None if there are none."""
        name = self._name(path)
        if name is None:
            return None
        if name.startswith("3d/"):
            number, _, inner = name.removeprefix("3d/").partition("/")
            shown = self.desk.view(number)
            return None if shown is None else shown.answer(f"/{inner}")
        if name in self._told:
            return _JSON, _json(self._told[name]())
        return self._files.get(name)

    def posted(self, path: str, body: bytes) -> tuple[HTTPStatus, Answer] | None:
        """Answer a message of the page; None if there is no such message."""
        name = self._name(path)
        if name is None or name not in self._done:
            return None
        try:
            message = json.loads(body or b"{}")
            if not isinstance(message, dict):
                return HTTPStatus.BAD_REQUEST, (_JSON, _json({"error": "a message is an object"}))
            return HTTPStatus.OK, (_JSON, _json(self._done[name](message)))
        except RefusalError as error:
            return HTTPStatus.CONFLICT, (_JSON, _json({"error": str(error)}))
        except Garage2UsdError as error:
            return HTTPStatus.BAD_REQUEST, (_JSON, _json({"error": str(error).splitlines()[0]}))
        except (ValueError, RecursionError):
            return HTTPStatus.BAD_REQUEST, (_JSON, _json({"error": "a message is JSON"}))


def _json(told: object) -> bytes:
    return json.dumps(told, separators=(",", ":"), allow_nan=False).encode()
