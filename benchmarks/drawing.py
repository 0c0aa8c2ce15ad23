"""The page to draw a garage: how long an edit and the view in 3D take, beside a build of the same garage."""

import statistics
import sys
import tempfile
import time
from pathlib import Path

import garage2usd

HERE = Path(__file__).parent
sys.path.append(str(HERE.parent / "tests"))
from support.draw_page import DrawPage, drawn, opened_browser  # noqa: E402 - of the tests

__all__ = ["drawing"]

EDITS, VIEWS = 20, 3
_BAYS, _AISLE, _CROSS = "." * 16, ".==============.", ".=............=."
_LARGE = [
    *(_BAYS, f"{_AISLE[:-1]}E", _CROSS, _CROSS, _AISLE, _CROSS),
    *(_CROSS, _AISLE, _CROSS, _CROSS, f"X{_AISLE[1:]}", _BAYS),
]
_SMALL = [".......#", "E.......", *["........"] * 4, "X.......", "........"]
DRAWINGS = {
    "12 x 16, lanes drawn": f'[site]\nstructure = """\n{chr(10).join(_LARGE)}\n"""\n',
    "8 x 8, two levels, lanes planned": f'[site]\nstructure = """\n{chr(10).join(_SMALL)}\n"""\n\n'
    "[building]\nlevels = 2\n\n[bay]\nsquare_side_m = 8.1\n",
}
"""Configuration of each drawing."""


def drawing() -> str:
    """One row for each drawing."""
    rows = [
        "| drawing | edit, server | edit, on the page | 3D, button to first frame | `build` |",
        "|---|---|---|---|---|",
    ]
    with opened_browser() as browser, tempfile.TemporaryDirectory() as folder:
        for number, (name, text) in enumerate(DRAWINGS.items()):
            path = Path(folder, f"{number}.toml")
            path.write_text(text)
            with drawn(browser, path) as page:
                if "planned" in name:
                    page.page.click("#plan")
                    page.page.wait_for_selector("#figures:has-text('lanes planned')", timeout=600_000)
                    views, server, shown = _views(page), [], []
                else:
                    views = _views(page)
                    server, shown = _edits(page)
            start = time.perf_counter()
            garage2usd.build(garage2usd.load_config(path), Path(folder, f"{number}.usdc"))
            build_s = time.perf_counter() - start
            rows.append(
                f"| {name} | {_spread(server, build_s)} | {_spread(shown, build_s)} | {_spread(views, build_s)} | "
                f"{build_s:.1f} s |"
            )
    heading = (
        "## Drawing\n\n"
        "Of `garage2usd draw` in a headless Chromium that draws in software: median / worst of "
        f"{EDITS} painted squares, and of {VIEWS} views in 3D of a drawing that has rested, each with the ratio of the "
        "median to the build of the same garage in the same run.\n"
    )
    return "\n".join([heading, *rows])


def _edits(page: DrawPage) -> tuple[list[float], list[float]]:
    """Paint squares of a row, and time the server's answers and what is on the page until then."""
    page.choose("#")
    server, shown = [], []
    for number in range(EDITS):
        start = time.perf_counter()
        page.drag((2 + number // 10, 2 + number % 10))
        shown.append(time.perf_counter() - start)
        server.append(page.state["seconds"])
    return server, shown


def _views(page: DrawPage) -> list[float]:
    """Show the drawing in 3D, each time another seed of it, and time button to first frame."""
    found = []
    for seed in range(1, VIEWS + 1):
        page.fill("#settings label:has-text('Seed') input", seed)
        if page.page.is_enabled("#plan") and page.state["sketch"]["state"] == "open":
            page.page.click("#plan")
            page.page.wait_for_selector("#figures:has-text('lanes planned')", timeout=600_000)
        number = page.state["number"]
        page.page.wait_for_selector(f"html[data-checked='{number}']", state="attached", timeout=600_000)
        page.page.wait_for_timeout(6000)  # someone looks at the plan
        start = time.perf_counter()
        page.page.click("#build")
        page.page.wait_for_selector("#view-dialog[open]", timeout=120_000)
        view = page.page.frame_locator("#view-frame")
        view.locator("html[data-ready=yes]").wait_for(state="attached", timeout=120_000)
        found.append(time.perf_counter() - start)
        page.page.keyboard.press("Escape")
        page.page.wait_for_selector("#view-dialog", state="hidden")
    return found


def _spread(seconds: list[float], build_s: float) -> str:
    if not seconds:
        return ""
    median = statistics.median(seconds)
    return f"{median:.2f} / {max(seconds):.2f} s ({median / build_s:.2f})"
