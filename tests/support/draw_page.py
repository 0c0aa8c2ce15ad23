"""The page to draw on in a headless Chromium, with a mouse, a keyboard and a finger."""

import os
import re
import subprocess
import sys
from contextlib import contextmanager

from playwright.sync_api import sync_playwright

from support.browser import find_browser
from support.viewer_page import BROWSER_ARGUMENTS

_PLACE = """([row, col, down, right]) => {
  const board = page.board, box = board.svg.getBoundingClientRect(), { x, z, scale } = board.view;
  const between = (edges, line, share) => edges[line] + share * (edges[line + 1] - edges[line]);
  return [box.left + (between(board.xs, col, right) - x) / scale, box.top + (between(board.zs, row, down) - z) / scale];
}"""


class DrawPage:
    """The page of a drawing, with all that it complained of."""

    def __init__(self, page, url):
        self.page, self.complaints = page, []
        page.set_default_timeout(120_000)  # ten of such pages may share two cores
        page.on("console", self._hear)
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.goto(url)
        page.wait_for_selector("html[data-ready]", state="attached", timeout=120_000)
        self.settle()

    def _hear(self, line):
        # a refused message is answered with these codes, and the page says why
        if line.type in {"error", "warning"} and not re.search("status of (400|409)", line.text):
            self.complaints.append(line.text)

    def eval(self, expression):
        return self.page.evaluate(expression)

    def settle(self):
        """Wait until the server has answered to all that was done."""
        self.page.wait_for_timeout(30)
        while self.eval("page.desk.isBusy || (page.board ?? page.tracer).isPainting"):
            self.page.wait_for_timeout(20)

    @property
    def state(self):
        self.settle()
        return self.eval("page.desk.state")

    @property
    def rows(self):
        return self.state["sketch"]["levels"][0]["rows"]

    def place(self, row, col, down=0.5, right=0.5):
        """Pixel of a place in a square, by shares of its sides."""
        return self.page.evaluate(_PLACE, [row, col, down, right])

    def point(self, x_m, z_m):
        """Pixel of a place of a survey."""
        at = "({ left, top }, { x, z, scale }) => [left + (%s - x) / scale, top + (%s - z) / scale]"
        return self.eval(f"({at % (x_m, z_m)})(page.tracer.svg.getBoundingClientRect(), page.tracer.sheet.view)")

    def trace(self, tool, *points):
        """Click places of a survey with a tool; lines and outlines end with Enter."""
        self.page.locator(f"label:has(input[name=tool][value={tool}])").click()
        for place in points:
            self.page.mouse.click(*self.point(*place))
        if tool in {"outline", "lanes", "solids"}:
            self.page.keyboard.press("Enter")
        self.settle()

    def choose(self, symbol=None, shape=None):
        for name, value in (("symbol", symbol), ("shape", shape)):
            if value is not None:
                self.page.locator(f'label:has(input[name={name}][value="{value}"])').click()

    def drag(self, *squares):
        """Draw over the middles of squares with the mouse."""
        mouse = self.page.mouse
        mouse.move(*self.place(*squares[0]))
        mouse.down()
        for square in squares[1:]:
            mouse.move(*self.place(*square), steps=2)
        mouse.up()
        self.settle()

    def keys(self, *keys):
        """Press keys on the plan."""
        self.page.focus("#board")
        for key in keys:
            self.page.keyboard.press(key)
        self.settle()

    def click(self, selector):
        self.page.click(selector)
        self.settle()

    def fill(self, selector, value):
        self.page.fill(selector, str(value))
        self.page.keyboard.press("Tab")
        self.settle()


@contextmanager
def opened_browser():
    """A headless Chromium; the pages of a module share one, as Playwright runs once in a thread."""
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_browser(), args=BROWSER_ARGUMENTS)
        try:
            yield browser
        finally:
            browser.close()


@contextmanager
def drawn(browser, config, *more, size=(1280, 800), **context):
    """`garage2usd draw` of a configuration or survey, and its page."""
    command = [sys.executable, "-m", "garage2usd", "draw", str(config), "--no-browser", *more]
    environment = {**os.environ, "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as server:
        try:
            url = re.search(r"http://\S+", server.stdout.readline())[0]
            window = browser.new_context(viewport={"width": size[0], "height": size[1]}, **context)
            try:
                yield DrawPage(window.new_page(), url)
            finally:
                window.close()
        finally:
            server.terminate()
            server.wait(timeout=30)
