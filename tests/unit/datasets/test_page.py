"""The page of a data set: the same bytes again, alone in a browser, with the figures of its plans."""

import base64
import hashlib
import re
import subprocess
import sys
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import sync_playwright
from support.browser import find_browser
from support.sample_files import REPOSITORY
from support.soak import soak_but

from garage2usd.datasets.charts import bars, histogram, split_colours
from garage2usd.datasets.difficulty import Level
from garage2usd.datasets.drawn_plan import contour_shape
from garage2usd.datasets.page import write_page
from garage2usd.datasets.variety import FIGURES, PlanFigures, Variety
from garage2usd.structure.grid import Cell
from garage2usd.view.thumbnails import THUMBNAIL_COLOURS, draw_thumbnail

SPLITS = ("train", "val", "test")


def drawn_plans(count):
    """Made-up plans of three sizes: portals in two corners and lanes drawn at random."""
    draw = np.random.default_rng(4)
    plans = []
    for number in range(count):
        rows, cols = ((4, 5), (5, 5), (6, 8))[number % 3]
        cells = (draw.random((rows, cols)) < 0.5).astype(np.int8)
        cells[0, 0], cells[-1, -1] = Cell.ENTRANCE, Cell.EXIT
        if number % 4 == 0:
            cells[: rows // 2, cols // 2 :] = Cell.OBSTACLE
        plans.append(
            PlanFigures(
                key=f"{number:06d}",
                split=SPLITS[int(draw.choice(3, p=[0.7, 0.2, 0.1]))],
                cells=cells,
                stalls=int(draw.integers(10, 90)),
                loops=int(draw.integers(0, 4)),
                longest_dead_end_m=round(float(draw.uniform(0, 26)), 2),
                area_per_stall_m2=round(float(draw.uniform(24, 40)), 2),
                contour=contour_shape(cells),
                level=list(Level)[number % 3],
            )
        )
    return plans


class Table(HTMLParser):
    """The cells of the table of splits, row by row."""

    def __init__(self, text):
        super().__init__()
        self.rows, self.inside, self.cell = [], False, None
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.inside |= tag == "table" and dict(attrs).get("id") == "splits"
        if self.inside and tag == "tr":
            self.rows.append([])
        elif self.inside and tag in {"td", "th"}:
            self.rows[-1].append("")
            self.cell = True

    def handle_endtag(self, tag):
        self.inside &= tag != "table"
        self.cell = self.cell and tag not in {"td", "th"}

    def handle_data(self, data):
        if self.inside and self.cell:
            self.rows[-1][-1] += data.strip()


@pytest.fixture(scope="module")
def plans():
    return drawn_plans(70)


@pytest.fixture(scope="module")
def page(plans, tmp_path_factory):
    path = tmp_path_factory.mktemp("page") / "index.html"
    write_page(path, plans, title="Data set <of> & tests", facts={"Seed": "4"})
    return path


@pytest.mark.soak
def test_the_same_plans_give_the_same_bytes_in_another_process(page, plans, tmp_path):
    write_page(tmp_path / "again.html", plans, title="Data set <of> & tests", facts={"Seed": "4"})
    assert (tmp_path / "again.html").read_bytes() == page.read_bytes()
    program = (
        "import sys, hashlib, pathlib; from unit.datasets.test_page import drawn_plans;"
        "from garage2usd.datasets.page import write_page; path = pathlib.Path(sys.argv[1]);"
        "write_page(path, drawn_plans(70), title='Data set <of> & tests', facts={'Seed': '4'});"
        "print(hashlib.sha256(path.read_bytes()).hexdigest())"
    )
    run = subprocess.run(
        [sys.executable, "-c", program, tmp_path / "other.html"],
        env={"PYTHONPATH": f"{REPOSITORY}:{REPOSITORY / 'tests'}", "PYTHONHASHSEED": "7", "HOME": str(tmp_path)},
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout.strip() == hashlib.sha256(page.read_bytes()).hexdigest()


def test_nothing_outside_the_page_is_named_in_it(page):
    text = page.read_text()
    addresses = set(re.findall(r"https?://[^\s\"'<>)]+", text))
    assert addresses <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}
    assert not re.search(r"<script|<iframe|@import|url\((?!#)", text)
    assert not re.search(r"20\d\d-\d\d-\d\d", text)


@pytest.fixture(scope="module")
def browser():
    with sync_playwright() as playwright:
        yield playwright.chromium.launch(executable_path=find_browser(), args=["--no-sandbox"])


@pytest.mark.skipif(find_browser() is None, reason="no Chromium")
@pytest.mark.parametrize("scheme", soak_but(1, ["light", "dark"]))
@pytest.mark.parametrize("width_px", soak_but([390], [1280, 390]))
def test_a_browser_shows_it_without_a_complaint_or_a_request(browser, page, plans, scheme, width_px):
    complaints, asked = [], []
    with browser.new_page(viewport={"width": width_px, "height": 900}, color_scheme=scheme) as tab:
        tab.on("console", lambda line: complaints.append(line.text))
        tab.on("pageerror", lambda error: complaints.append(str(error)))
        tab.on("request", lambda request: asked.append(request.url))
        tab.goto(page.as_uri())
        assert tab.title() == "Data set <of> & tests"
        assert tab.evaluate("document.documentElement.scrollWidth") == width_px
        overflowing = "[...document.querySelectorAll('figure, .charts .card, .tiles div')]"
        assert tab.evaluate(f"{overflowing}.filter(box => box.scrollWidth > box.clientWidth + 1).length") == 0
        assert tab.evaluate("document.querySelectorAll('.sheet figure svg').length") == len(plans)
        assert tab.evaluate("document.querySelectorAll('.charts svg').length") == len(FIGURES) + 2
        ink, ground = (tab.evaluate(f"getComputedStyle(document.body).{name}") for name in ("color", "backgroundColor"))
        # letters of charts have the colour of all others, and all stand out from the ground
        chart = tab.evaluate("getComputedStyle(document.querySelector('.charts svg text')).fill")
        assert chart == ink
        assert contrast(ink, ground) > 7
    assert complaints == []
    assert asked == [page.as_uri()]


def contrast(one, other):
    """The ratio of luminances of two colours by WCAG 2."""

    def luminance(colour):
        shares = [int(part) / 255 for part in re.findall(r"\d+", colour)[:3]]
        linear = [share / 12.92 if share <= 0.04045 else ((share + 0.055) / 1.055) ** 2.4 for share in shares]
        return float(np.dot(linear, (0.2126, 0.7152, 0.0722)))

    dark, bright = sorted((luminance(one), luminance(other)))
    return (bright + 0.05) / (dark + 0.05)


def test_the_table_has_the_figures_of_the_plans(page, plans):
    rows = {row[0]: row[1:] for row in Table(page.read_text()).rows}
    splits = list(dict.fromkeys(plan.split for plan in plans))
    assert rows[""] == ["All", *splits]
    groups = [plans, *([plan for plan in plans if plan.split == split] for split in splits)]
    assert rows["Plans"][::2] == [str(len(group)) for group in groups]
    for figure in ("stalls", "loops", "longest_dead_end_m", "area_per_stall_m2", "squares"):
        for group, mean, spread in zip(groups, rows[FIGURES[figure]][::2], rows[FIGURES[figure]][1::2], strict=True):
            values = [getattr(plan, figure) for plan in group]
            assert float(mean) == pytest.approx(np.mean(values), abs=0.051)
            assert [float(end) for end in spread.split(" to ")] == pytest.approx([min(values), max(values)], abs=0.051)
    for name in ("rectangle", "L", "normal", "extreme"):
        counts = [sum(name in {plan.contour, plan.level} for plan in group) for group in groups]
        assert rows[name][::2] == [str(count) for count in counts]


def test_plans_in_two_splits_are_told(page, plans, tmp_path):
    def told(path):
        return re.search(r'<dd class="(\w+)" id="shared">(\d+)</dd>', path.read_text()).groups()

    assert told(page) == ("good", "0")
    first = plans[0]
    turned = PlanFigures(
        "copy", "leak", np.rot90(first.cells), first.stalls, first.loops, 0.0, 30.0, first.contour, first.level
    )
    variety = write_page(tmp_path / "shared.html", [*plans, turned])
    assert told(tmp_path / "shared.html") == ("bad", "1")
    assert variety.shared == 1


def test_of_many_plans_some_are_drawn_evenly_spread(plans, tmp_path):
    write_page(tmp_path / "few.html", plans, most_drawn=4)
    text = (tmp_path / "few.html").read_text()
    assert re.findall(r"<b>(\d{6})</b>", text) == ["000000", "000023", "000046", "000069"]
    assert "4 of 70 plans, evenly spread." in text


def test_the_page_holds_contact_sheets(plans, tmp_path):
    for name, kind in (("looks.png", "png"), ("night.jpg", "jpeg")):
        Image.new("RGB", (40, 20), (90, 80, 70)).save(tmp_path / name)
        write_page(tmp_path / "page.html", plans, sheets=[tmp_path / name])
        text = (tmp_path / "page.html").read_text()
        assert f"Contact sheet {name.partition('.')[0]}" in text
        held = re.search(rf"data:image/{kind};base64,([^\"]+)", text)[1]
        assert base64.b64decode(held) == (tmp_path / name).read_bytes()
    write_page(tmp_path / "page.html", plans)
    assert "Contact sheet" not in (tmp_path / "page.html").read_text()


def test_keys_and_splits_are_escaped(tmp_path):
    plan = drawn_plans(1)[0]
    odd = PlanFigures(
        "<b>&", 'a"<i>', plan.cells, plan.stalls, plan.loops, 0.0, 30.0, contour_shape(plan.cells), level=None
    )
    write_page(tmp_path / "odd.html", [odd], title="<script>")
    text = (tmp_path / "odd.html").read_text()
    assert "<script>" not in text
    assert 'a"<i>' not in text
    assert "&lt;b&gt;&amp;: " in text
    assert "Difficulty of the garage" not in text


def test_a_page_without_plans_says_so_in_figures(tmp_path):
    variety = write_page(tmp_path / "none.html", [])
    assert variety.shared == 0
    assert "\N{EN DASH}" in (tmp_path / "none.html").read_text()


def areas(svg, colour):
    """Heights of the bars of a colour in a chart."""
    paths = re.findall(rf'<path d="([^"]*)"[^>]*style="fill: {colour}', svg)
    heights = []
    for path in paths:
        y = [float(number) for number in re.findall(r"-?[\d.]+", path)[1::2]]
        heights.append(max(y) - min(y))
    return np.array(heights)


def test_bars_are_as_high_as_their_counts():
    counts = {"train": {"a": 6, "b": 3, "c": 0}, "val": {"a": 2, "b": 1, "c": 4}}
    svg = bars(counts, "Kinds")
    colours = split_colours(["train", "val"])
    train, val = (areas(svg, colours[split]) for split in counts)
    assert train / train[0] * 6 == pytest.approx([6, 3, 0], abs=0.01)
    assert val / train[0] * 6 == pytest.approx([2, 1, 4], abs=0.01)


def test_histograms_of_whole_numbers_have_a_bar_for_each():
    values = {"train": np.array([0.0, 0, 0, 2]), "val": np.array([2.0])}
    svg = histogram(values, "Loops")
    train = areas(svg, split_colours(["train"])["train"])
    assert train / train[0] * 3 == pytest.approx([3, 0, 1], abs=0.01)


def test_histograms_of_other_numbers_count_as_numpy_does():
    values = np.random.default_rng(1).normal(30, 4, 200)
    heights = areas(histogram({"train": values}, "Floor"), split_colours(["train"])["train"])
    expected, _ = np.histogram(values, 24)
    assert heights / heights.sum() * 200 == pytest.approx(expected, abs=0.05)


def test_a_thumbnail_has_each_square_once():
    plan = drawn_plans(6)[2]
    drawing = draw_thumbnail(plan.cells, "a plan")
    regions = [element for element in drawing.elements if getattr(element, "kind", "") in THUMBNAIL_COLOURS]
    covered = np.zeros(plan.cells.shape, dtype=int)
    for region in regions:
        (left, top), (right, bottom) = np.min(region.points, axis=0), np.max(region.points, axis=0)
        covered[int(top) : int(bottom), int(left) : int(right)] += 1
        kinds = {int(cell) for cell in plan.cells[int(top) : int(bottom), int(left) : int(right)].ravel()}
        allowed = {"lane": 1, "dead_end": 1, "entrance": 2, "exit": 3, "stalls": 0, "free": 0, "obstacle": -1}
        assert kinds == {allowed[region.kind]}
    assert (covered == 1).all()


def test_the_page_tells_floor_net_and_gross_and_landings_of_several_levels(plans, tmp_path):
    plan = replace(plans[0], gross_area_per_stall_m2=43.21, levels=2)
    row, col = np.argwhere(plan.cells == Cell.EXIT)[0].tolist()
    outside = np.pad(plan.cells, ((2, 0), (3, 0)), constant_values=Cell.OBSTACLE)
    shown = []
    for landings in ((), ((row + 2, col + 3),)):
        page = tmp_path / f"{len(landings)}.html"
        write_page(page, [replace(plan, cells=outside, landings=landings)])
        shown.append(page.read_text())
    assert f"{plan.area_per_stall_m2:.1f} m2 a stall net, 43.2 gross" in shown[0]
    without, marked = (page.count('class="landing"') for page in shown)
    assert marked == without + 1
    assert "landing of a ramp" in shown[1]


def test_the_variety_on_the_page_is_that_of_the_plans(plans, tmp_path):
    shown, own = write_page(tmp_path / "page.html", plans), Variety(plans)
    assert np.array_equal(shown.nearest_share, own.nearest_share)
