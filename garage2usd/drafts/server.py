"""HTTP server of the page on which garages are drawn: loopback only, for those who know the address with its token."""

import json
import secrets
import threading
from http import HTTPStatus
from types import TracebackType
from typing import Any

from garage2usd.common.errors import Garage2UsdError
from garage2usd.drafts.desk import Desk, RefusalError, Told
from garage2usd.drafts.opening import files_beside, opened_beside
from garage2usd.view.viewer import LoopbackServer
from garage2usd.view.viewer.server import Answer, page_files

_FILES = {"draw.js", "trace.js", "file_bar.js", "file_bar.css", "licenses.txt"}
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

    def __init__(self, desk: Desk[Any], port: int = 0) -> None:
        super().__init__(port, framed_by="'self'")
        self.desk = desk
        self._token = secrets.token_urlsafe(_TOKEN_BYTES)
        self._pages = page_files()
        self._at_opening = threading.Lock()

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
        if name in self.desk.told:
            return _JSON, _json(getattr(self.desk, name)())
        if name == "files":
            return _JSON, _json(files_beside(self.desk.file))
        if name in _FILES:
            return self._pages[f"/{name}"]
        return self._pages[f"/{self.desk.page}"] if name == "" else None

    def open(self, message: dict[str, Any]) -> Told:
        """Open another file in place of the present one, whose unsaved work stays beside it."""
        with self._at_opening:
            before, self.desk = self.desk, opened_beside(self.desk, message)
            before.close()
        return {"name": self.desk.file.path.name}

    def posted(self, path: str, body: bytes) -> tuple[HTTPStatus, Answer] | None:
        """Answer a message of the page; None if there is no such message."""
        name = self._name(path)
        if name is None or name not in {*self.desk.done, "open"}:
            return None
        try:
            message = json.loads(body or b"{}")
            if not isinstance(message, dict):
                return HTTPStatus.BAD_REQUEST, (_JSON, _json({"error": "a message is an object"}))
            return HTTPStatus.OK, (_JSON, _json(getattr(self if name == "open" else self.desk, name)(message)))
        except RefusalError as error:
            return HTTPStatus.CONFLICT, (_JSON, _json({"error": str(error)}))
        except Garage2UsdError as error:
            return HTTPStatus.BAD_REQUEST, (_JSON, _json({"error": str(error).splitlines()[0]}))
        except (ValueError, RecursionError):
            return HTTPStatus.BAD_REQUEST, (_JSON, _json({"error": "a message is JSON"}))


def _json(told: object) -> bytes:
    return json.dumps(told, separators=(",", ":"), allow_nan=False).encode()
