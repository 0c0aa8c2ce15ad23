"""The viewer's page in a headless Chromium, driven by Playwright."""

import os
import re
import subprocess
import sys
from contextlib import contextmanager

from playwright.sync_api import sync_playwright

from support.browser import find_browser

BROWSER_ARGUMENTS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
]
_READY = "html[data-ready=yes], #curtain.failed"


class Page:
    """The page of a stage, ready, with all that it complained of and asked for."""

    def __init__(self, page, url):
        self.page, self.url = page, url
        self.complaints, self.asked = [], []
        page.on(
            "console", lambda line: self.complaints.append(line.text) if line.type in {"error", "warning"} else None
        )
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda request: self.asked.append(request.url))
        page.on("requestfailed", lambda request: self.complaints.append(f"{request.url}: {request.failure}"))
        page.goto(url)
        page.wait_for_selector(_READY, state="attached", timeout=120_000)
        self.rest()

    def eval(self, expression):
        return self.page.evaluate(expression)

    def rest(self):
        """Wait until the full picture stands."""
        self.eval(
            "async () => { const busy = () => viewer.quality.moving || viewer.dirty || viewer.fence;"
            " for (let k = 0; k < 2; k += busy() ? 0 : 1) await new Promise(requestAnimationFrame); }"
        )

    def show_panels(self, shown):
        """Show or hide all that covers the picture."""
        visibility = "" if shown else "hidden"
        self.eval(
            "document.querySelectorAll('body > :not(#view)')"
            f".forEach((panel) => {{ panel.style.visibility = '{visibility}'; }})"
        )

    def screen(self, point):
        """CSS pixels of a place in metres."""
        x, y = self.eval(
            f"(() => {{ const p = viewer.camera.position.clone().set({point[0]}, {point[1]}, {point[2]})"
            ".project(viewer.camera); return [(p.x + 1) / 2 * innerWidth, (1 - p.y) / 2 * innerHeight]; })()"
        )
        return x, y

    def facts(self):
        """What the inspector says, by name."""
        return {
            cell.get_attribute("data-fact"): cell.inner_text() for cell in self.page.query_selector_all("#inspected dd")
        }

    def drawn(self):
        return self.eval("({...viewer.instances.drawn})")


@contextmanager
def viewed(stage, *, size=(1024, 640), options=()):
    """`garage2usd view` of a stage, and its page."""
    command = [sys.executable, "-m", "garage2usd", "view", str(stage), "--no-browser", *map(str, options)]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as server:
        try:
            url = re.search(r"http://\S+", server.stdout.readline())[0]
            with sync_playwright() as playwright:
                browser = playwright.chromium.launch(executable_path=find_browser(), args=BROWSER_ARGUMENTS)
                try:
                    yield Page(browser.new_page(viewport={"width": size[0], "height": size[1]}), url)
                finally:
                    browser.close()
        finally:
            server.terminate()
            server.wait(timeout=30)
