"""Loads a .usdz or a .glb into three.js in a headless browser; everything is served from this machine."""

import base64
import json
import os
import queue
import shutil
import subprocess
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import quote

PAGE_FOLDER = Path(__file__).parents[1] / "clients" / "threejs"
THREE_VERSION = "0.187.0"
AXE_VERSION = "4.10.3"
_BROWSERS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
_ARGUMENTS = (
    "--headless",
    "--no-sandbox",
    "--no-first-run",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-quic",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-default-apps",
    "--disable-dev-shm-usage",
    "--disable-sync",
)
_TYPES = {".html": "text/html", ".js": "text/javascript", ".usdz": "model/vnd.usdz+zip", ".glb": "model/gltf-binary"}


def find_browser():
    """A Chromium on the path, or None."""
    return next(filter(None, map(shutil.which, _BROWSERS)), None)


def find_three():
    """The folder of three.js: where environment.sh installs it, or THREEJS_FOLDER; None if it is not there."""
    default = Path(__file__).parents[2] / ".venv" / "node" / "node_modules" / "three"
    folder = Path(os.environ.get("THREEJS_FOLDER", default))
    return folder if (folder / "package.json").is_file() else None


def find_axe():
    """axe-core's script, which judges how accessible a page is, where environment.sh installs it; else None."""
    script = Path(__file__).parents[2] / ".venv" / "node" / "node_modules" / "axe-core" / "axe.min.js"
    return script if script.is_file() else None


def load_in_three(stage, profile, *, pictures=False, page="page.html", camera="", timeout_s=300):
    """What the script of a page found in `stage`; `profile` is an empty folder for the browser's own files.

    `camera` is what the page is told of where to look from, where the file has no cameras.

    Raises
    ------
    queue.Empty
        The page has not answered in time.
    """
    answers = queue.Queue()
    with _Server(stage, answers) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        url = f"http://127.0.0.1:{server.server_port}/{page}{f'?pictures={quote(camera)}' if pictures else ''}"
        with (profile / "browser.log").open("wb") as log:
            browser = subprocess.Popen(
                [find_browser(), *_ARGUMENTS, f"--user-data-dir={profile / 'profile'}", url], stdout=log, stderr=log
            )
            try:
                answer = answers.get(timeout=timeout_s)
            finally:
                browser.terminate()
                browser.wait(timeout=30)
                server.shutdown()
    answer["missing"] = server.missing
    answer["pictures"] = {
        name: base64.b64decode(url.partition(",")[2]) for name, url in answer.get("pictures", {}).items()
    }
    return answer


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, stage, answers):
        super().__init__(("127.0.0.1", 0), _Handler)
        self.stage, self.answers, self.missing = Path(stage), answers, []

    def file_of(self, path):
        if path == f"/stage{self.stage.suffix}":
            return self.stage
        if path.startswith("/three/"):
            return find_three() / path.removeprefix("/three/")
        return PAGE_FOLDER / path.removeprefix("/")


class _Handler(BaseHTTPRequestHandler):
    def do_GET(self):
        path = self.path.partition("?")[0]
        file = self.server.file_of(path)
        if path == "/favicon.ico":
            self._answer(204, b"")
        elif file.is_file():
            self._answer(200, file.read_bytes(), _TYPES.get(file.suffix, "application/octet-stream"))
        else:
            self.server.missing.append(path)
            self._answer(404, b"")

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self._answer(204, b"")
        self.server.answers.put(json.loads(body))

    def _answer(self, status, body, content_type="text/plain"):
        self.send_response(status)
        self.send_header("Content-Type", content_type)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format, *args):  # noqa: A002 - the name in the base class
        """Keep quiet."""
