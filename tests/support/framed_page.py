"""A page with a frame of the viewer, as a notebook is one, in a headless Chromium."""

import io
import threading
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import NamedTuple

import numpy as np
from PIL import Image
from playwright.sync_api import TimeoutError as TookTooLongError
from playwright.sync_api import sync_playwright

from support.browser import find_browser
from support.viewer_page import BROWSER_ARGUMENTS

FOREIGN = "notebooks.example"
"""A host that is not this machine's name, which leads to it here."""


class Framed(NamedTuple):
    """The frame of a page: what the viewer says of its stage, its colours on the screen, complaints of the browser."""

    facts: str
    colours: int
    complaints: list[str]


def framed(html, *, host="localhost", timeout_ms=120_000):
    """Open a page of another origin with a frame in it; `facts` are empty where the viewer does not come."""
    with _served(html) as port, sync_playwright() as playwright:
        arguments = [*BROWSER_ARGUMENTS, f"--host-resolver-rules=MAP {FOREIGN} 127.0.0.1"]
        browser = playwright.chromium.launch(executable_path=find_browser(), args=arguments)
        try:
            page = browser.new_page(viewport={"width": 1000, "height": 700})
            complaints = []
            page.on("console", lambda line: complaints.append(line.text) if line.type in {"error", "warning"} else None)
            page.on("pageerror", lambda error: complaints.append(str(error)))
            page.goto(f"http://{host}:{port}/")
            view = page.frame_locator("iframe")
            try:
                view.locator("html[data-ready=yes]").wait_for(state="attached", timeout=timeout_ms)
            except TookTooLongError:
                return Framed("", 0, complaints)
            seen = Image.open(io.BytesIO(page.locator("iframe").screenshot())).convert("RGB")
            colours = len(np.unique(np.asarray(seen).reshape(-1, 3), axis=0))
            return Framed(view.locator("#stage-facts").inner_text(), colours, complaints)
        finally:
            browser.close()


@contextmanager
def _served(html):
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self):
            body = f'<!doctype html><link rel="icon" href="data:,"><title>notebook</title>{html}'.encode()
            self.send_response(200)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(body)))
            self.end_headers()
            self.wfile.write(body)

        def log_message(self, format, *args):  # noqa: A002 - the name in the base class
            """Keep quiet."""

    with ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        try:
            yield server.server_port
        finally:
            server.shutdown()
