"""Take a picture of a page in a file, such as the page of variety of a data set, from one of its headings on.

Usage: python docs/pictures/page_picture.py PAGE PICTURE [--from "Plans"] [--size 1160x810]
"""

import argparse
import shutil
from pathlib import Path

from playwright.sync_api import sync_playwright


def main() -> None:
    """Show the page to a Chromium without a window."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path)
    parser.add_argument("picture", type=Path)
    parser.add_argument("--from", dest="heading", default="")
    parser.add_argument("--size", default="1160x810")
    options = parser.parse_args()
    width, height = map(int, options.size.split("x"))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=shutil.which("chromium"))
        page = browser.new_page(viewport={"width": width, "height": height})
        page.goto(options.page.absolute().as_uri())
        if options.heading:
            page.get_by_role("heading", name=options.heading, exact=True).evaluate("item => item.scrollIntoView()")
        page.screenshot(path=options.picture)
        browser.close()


if __name__ == "__main__":
    main()
