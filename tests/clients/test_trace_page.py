"""A survey is traced over a picture in a browser, saved, and imported, and has what was traced where it was."""

import math
import tomllib

import pytest
from PIL import Image, ImageDraw
from support.browser import find_axe, find_browser
from support.draw_page import drawn, opened_browser
from support.sample_files import REPOSITORY

from garage2usd.imports import import_layout, surveyed_floor, unplaced_parts

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
]

PIXELS_A_METRE = 25
OUTLINE = [(2, 2), (38, 2), (38, 20), (2, 20)]
LOT = """# a lot of ours
outline = [[0, 0], [30, 0], [30, 16], [0, 16]]

[[runs]]  # along the wall
first = [4, 5]
last = [24, 5]
side = "left"
count = 8

[[lanes]]
points = [[0, 8], [30, 8]]

[[portals]]
at = [0, 8]
"""


@pytest.fixture(scope="module")
def browser():
    with opened_browser() as found:
        yield found


@pytest.fixture(scope="module")
def picture(tmp_path_factory):
    """The plan of a lot of 40 x 22 m as a PNG."""
    path = tmp_path_factory.mktemp("plans") / "plan.png"
    image = Image.new("RGB", (40 * PIXELS_A_METRE, 22 * PIXELS_A_METRE), "white")
    pen = ImageDraw.Draw(image)
    pen.polygon([(x * PIXELS_A_METRE, z * PIXELS_A_METRE) for x, z in OUTLINE], outline="black", width=4)
    image.save(path)
    return path


def near(found, wanted, within=0.15):
    return math.dist(found, wanted) < within


def test_a_lot_traced_over_a_picture_is_imported_as_it_was_traced(browser, picture, tmp_path):
    path = tmp_path / "lot.toml"
    with drawn(browser, path, "--trace") as page:
        page.page.set_input_files("#picture", picture)
        page.page.wait_for_selector("#hint:has-text('Scale of picture')")
        scale = page.eval("page.tracer.picture.scale")
        # the upper wall is 36 m long
        for x, z in OUTLINE[:2]:
            page.page.mouse.click(*page.point(x * PIXELS_A_METRE * scale, z * PIXELS_A_METRE * scale))
        page.fill("#length", 36)
        page.click("#set-scale")
        assert page.eval("page.tracer.picture.scale") == pytest.approx(1 / PIXELS_A_METRE, rel=0.01)
        page.trace("outline", *OUTLINE)
        page.trace("lanes", (2, 11), (38, 11))
        page.trace("runs", (6, 8), (31.1, 8), (10, 4))  # 10 stalls of 2.5 m
        page.trace("runs", (6, 14), (31.1, 14), (10, 18))
        page.page.select_option("#editor label:has-text('Stalls') select", "angled")
        page.settle()
        page.trace("entrance", (2, 11))
        page.trace("exit", (38, 11))
        page.trace("columns", (4, 17))
        page.trace("solids", (34, 16), (38, 16), (38, 20), (34, 20))
        page.trace("stalls", (32, 8), (34.5, 8), (33, 3))
        number = page.state["number"]
        page.page.wait_for_selector(f"html[data-checked='{number}']", state="attached", timeout=120_000)
        assert page.page.inner_text("#figures").startswith(f"{len(page.state['stalls'])} stalls drawn")
        page.page.keyboard.press("Control+s")
        page.page.wait_for_selector("#saved:text-is('saved')")
        drawing, stalls = page.state["drawing"], page.state["stalls"]
        assert page.complaints == []
    assert tomllib.loads(path.read_text()) == drawing
    assert all(near(a, b) for a, b in zip(drawing["outline"], OUTLINE, strict=True))
    assert [run["side"] for run in drawing["runs"]] == ["left", "right"]
    assert [run.get("kind") for run in drawing["runs"]] == [None, "angled"]
    built = import_layout(path, tmp_path / "lot.usdc", proves=False)
    assert unplaced_parts(built.garage) == ()
    floor = surveyed_floor(built.garage)
    # by their ids, as the file has them: each stall is the one that the page showed
    assert sorted(stall.source.name for stall in floor.fitted) == sorted(stall["name"] for stall in stalls)
    sides = {
        stall.source.name: sorted(map(math.dist, stall.source.corners, stall.source.corners[1:]))
        for stall in floor.fitted
    }
    for stall in stalls:
        lengths = sorted(map(math.dist, stall["corners"], stall["corners"][1:]))
        assert sides[stall["name"]] == pytest.approx(lengths, abs=0.02)
    assert built.garage.parking_stalls == len(stalls) == 10 + 8 + 1


def test_parts_are_chosen_changed_moved_and_removed_with_the_comments_kept(browser, tmp_path):
    path = tmp_path / "lot.toml"
    path.write_text(LOT)
    with drawn(browser, path) as page:
        page.page.click("#part-list button:has-text('Run 1: 8 stalls')")
        page.fill("#editor label:has-text('Count') input", 6)
        assert len(page.state["stalls"]) == 6
        # its end by mouse, then all of it by a key
        (x, y), (to_x, to_y) = page.point(24, 5), page.point(20, 5)
        page.page.mouse.move(x, y)
        page.page.mouse.down()
        page.page.mouse.move(to_x, to_y, steps=3)
        page.page.mouse.up()
        assert near(page.state["drawing"]["runs"][0]["last"], (20, 5))
        page.keys("ArrowRight")
        assert near(page.state["drawing"]["runs"][0]["first"], (5, 5))
        # a portal by keyboard alone: the cross begins at (5, 5)
        page.keys("Escape", "X", *["ArrowRight"] * 25, *["ArrowDown"] * 3, "Space")
        assert page.state["drawing"]["portals"][1] == {"at": [30, 8], "kind": "exit"}
        page.keys("Delete")
        assert len(page.state["drawing"]["portals"]) == 1
        while page.state["can_undo"]:
            page.click("#undo")
        page.page.click("#part-list button:has-text('Lane 1')")
        page.page.check("#editor label:has-text('One way') input")
        page.settle()
        page.click("#save")
        page.page.wait_for_selector("#saved:text-is('saved')")
        assert page.complaints == []
    assert path.read_text() == LOT.replace("[30, 8]]\n", "[30, 8]]\none_way = true\n")


def test_a_finger_traces_and_two_fingers_move_the_plan(browser, tmp_path):
    path = tmp_path / "lot.toml"
    path.write_text(LOT)
    with drawn(browser, path, size=(420, 800), has_touch=True) as page:
        page.page.locator("label:has(input[name=tool][value=columns])").tap()
        page.page.locator("#board").scroll_into_view_if_needed()
        page.page.touchscreen.tap(*page.point(27, 12))
        (column,) = page.state["drawing"]["columns"]
        assert near(column["at"], (27, 12))
        scale, session = page.eval("page.tracer.sheet.view.scale"), page.page.context.new_cdp_session(page.page)
        x, y = page.point(15, 8)
        for kind, *aparts in (("touchStart", -20, 20), ("touchMove", -40, 40), ("touchEnd",)):
            points = [{"x": x + apart, "y": y, "id": number} for number, apart in enumerate(aparts)]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
        assert len(page.state["drawing"]["columns"]) == 1
        assert page.eval("page.tracer.sheet.view.scale") < 0.8 * scale
        assert page.eval("document.documentElement.scrollWidth") <= 420
        assert page.complaints == []


def test_another_file_is_opened_and_no_work_is_lost(browser, tmp_path):
    (tmp_path / "lot.toml").write_text(LOT)
    (tmp_path / "garage.toml").write_text((REPOSITORY / "samples" / "hand_drawn.toml").read_text())
    with drawn(browser, tmp_path / "garage.toml") as page:
        page.drag((0, 0))
        changed = page.state["sketch"]["levels"][0]["rows"]

        def turn_to(name, *answers):
            page.click("#open")
            page.page.click(f"#files button:has-text('{name}')")
            for answer in answers:
                page.page.click(f"#notice button:text('{answer}')")
            page.page.wait_for_selector(f"#name:text-is('{name}')", timeout=60_000)
            page.page.wait_for_selector("html[data-ready]", state="attached", timeout=60_000)
            page.settle()

        turn_to("lot.toml", "Open without saving")
        assert len(page.state["stalls"]) == 8
        turn_to("garage.toml")
        page.page.click("#notice button:text('Take it')")
        assert page.rows == changed
        # a text from elsewhere becomes a new file, beside the one of its name
        page.click("#open")
        page.page.set_input_files("#open-file", {"name": "lot.toml", "mimeType": "text/plain", "buffer": LOT.encode()})
        page.page.click("#notice button:text('Save first')")
        page.page.wait_for_selector("#name:text-is('lot_2.toml')", timeout=60_000)
        page.page.wait_for_selector("html[data-ready]", state="attached", timeout=60_000)
        assert page.page.inner_text("#saved") == "not saved yet"
        # a file with a fault is told, and the one that was open stays
        page.click("#open")
        faulty = {"name": "bad.toml", "mimeType": "text/plain", "buffer": b"outline = 3\n"}
        page.page.set_input_files("#open-file", faulty)
        page.page.wait_for_selector("#notice:has-text('outline: got 3')")
        assert page.complaints == []
    assert (tmp_path / "garage.toml").read_text() != (REPOSITORY / "samples" / "hand_drawn.toml").read_text()
    assert not (tmp_path / "lot_2.toml").exists()


@pytest.mark.skipif(find_axe() is None, reason="axe-core is not installed; environment.sh test does it")
def test_axe_finds_nothing_serious(browser, tmp_path):
    path = tmp_path / "lot.toml"
    path.write_text(LOT)
    with drawn(browser, path, size=(1024, 640), device_scale_factor=1.25, bypass_csp=True) as page:
        page.page.click("#part-list button:has-text('Run 1')")
        page.page.add_script_tag(path=find_axe())
        for opener in (None, "#open"):
            if opener:
                page.page.click(opener)
                page.page.wait_for_selector("#files li")
            found = page.eval("axe.run()")["violations"]
            grave = [each for each in found if each["impact"] in {"serious", "critical"}]
            assert [(each["id"], [node["html"][:120] for node in each["nodes"]]) for each in grave] == []
        assert page.eval("document.documentElement.scrollWidth <= innerWidth")
