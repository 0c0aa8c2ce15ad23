"""The viewer in a browser: it shows what the layout holds, and one can click, switch, walk and find in it."""

import io
from collections import Counter

import numpy as np
import pytest
from PIL import Image
from support.browser import find_browser
from support.label_tables import labelled_objects
from support.sample_files import REPOSITORY
from support.soak import soak_but
from support.viewer_page import viewed

from garage2usd.stage.arrangement import arrange
from garage2usd.stage.labels import OBJECT_LABELS

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
]

# one package as a browser likes it, and the largest garage with its files beside it
VIEWED = {"hand_drawn": "usdz", "large_20x30": "usdc"}


@pytest.fixture(scope="module", params=soak_but(["hand_drawn"], VIEWED))
def opened(builds, request):
    build = builds(REPOSITORY / "samples" / f"{request.param}.toml", VIEWED[request.param])
    with viewed(build.stage) as page:
        yield build, page
        assert page.complaints == []
        assert all(url.startswith((page.url, "data:", "blob:")) for url in page.asked)


def picture(page):
    page.rest()
    return np.asarray(Image.open(io.BytesIO(page.page.screenshot())).convert("RGB"), dtype=int)


def is_magenta(seen):
    return np.minimum(seen[..., 0], seen[..., 2]) > seen[..., 1] + 60


def test_it_counts_the_objects_of_each_class_as_the_layout_does(opened):
    build, page = opened
    placements = build.garage.layout.placements
    rows = page.page.query_selector_all(".class")
    shown = {row.get_attribute("data-label"): int(row.get_attribute("data-count")) for row in rows}
    pieces = [entry["class"] for entry in labelled_objects(build.labels)[len(placements) :]]
    assert "stall_line" in pieces
    assert shown == Counter([*(OBJECT_LABELS[placement.kind] for placement in placements), *pieces])
    assert page.page.inner_text("#object-count") == f"{len(placements) + len(pieces):,} objects"
    assert f"{build.garage.layout.parking_stalls:,} stalls" in page.page.inner_text("#stage-facts")


def test_a_click_on_a_stall_shows_its_class_id_prim_and_stall(opened):
    build, page = opened
    layout = build.garage.layout
    paths = arrange(layout, nested=False).paths()
    occupied = {car.stall for car in layout.of_kind("car")}
    rows = {(place.stall, place.kind): row for row, place in enumerate(layout.placements)}
    clicked = 0
    for stall in layout.stalls[:: max(1, len(layout.stalls) // 30)]:
        taken = stall.name in occupied
        x, z = stall.centre_m
        page.eval(
            f"viewer.setMode('orbit'), viewer.orbit.target.set({x}, 0, {z}),"
            f" viewer.camera.position.set({x + 1}, 22, {z + 4}), viewer.orbit.update(), viewer.touch()"
        )
        page.rest()
        page.page.mouse.click(*page.screen((x, 0.0 if not taken else 0.8, z)))
        facts = page.facts()
        number = rows[stall.name, "car" if taken else "stall"]
        assert facts["Class"] == ("car" if taken else "parking_stall")
        assert facts["Prim"] == paths[number]
        assert facts["Instance id"] == str(number + 1)
        assert facts["Stall id"] == stall.name
        assert facts["Number"] == (stall.number or "-")
        assert facts["Use"] == str(stall.use).replace("_", " ")
        assert facts["Type"] == str(stall.stall_type).replace("_", " ")
        assert facts["Entry edge"] == stall.edge.name.lower()
        assert facts["Kind"] == "perpendicular"
        assert facts["Mouth and side"] == f"{stall.width_m:.2f} \u00d7 {stall.length_m:.2f} m"
        assert facts["Car"] == ("parked" if taken else "none")
        clicked += 1
        if clicked == 4:
            break
    assert clicked == 4
    page.page.keyboard.press("Escape")
    assert page.page.is_hidden("#inspector")


def test_a_stall_is_found_by_its_painted_number(opened):
    build, page = opened
    stall = next(stall for stall in reversed(build.garage.layout.stalls) if stall.number)
    page.page.fill("#query", stall.number.lower())
    page.page.keyboard.press("Enter")
    assert page.facts()["Stall id"] == stall.name
    target = page.eval("viewer.orbit.target.toArray()")
    # the middle of its ground without the lines beside and behind it, which are half as wide at most
    assert np.allclose([target[0], target[2]], stall.centre_m, atol=0.07)
    page.page.fill("#query", "no such stall")
    page.page.keyboard.press("Enter")
    assert "missed" in page.page.get_attribute("#query", "class")
    page.page.fill("#query", "")
    page.eval("document.activeElement.blur(), viewer.select(-1)")


@pytest.mark.soak
def test_layers_take_away_what_they_name_and_bring_it_back(opened):
    _, page = opened
    page.page.click("#mode-orbit")
    before, drawn = picture(page), page.drawn()
    inside = np.s_[100:380, 280:720]
    for layer in ("cars", "lanes", "stalls", "colliders"):
        switch = page.page.locator(f"label:has(#layer-{layer})")
        switch.click()
        if layer == "colliders":
            page.page.locator("#view").evaluate(
                "async () => { while (!viewer.colliders.group.children.length)"
                " await new Promise((done) => setTimeout(done, 20)); }"
            )
        changed = picture(page)
        assert np.abs(changed - before)[inside].mean() > 0.5, layer
        if layer == "cars":
            assert page.drawn()["triangles"] < drawn["triangles"]
        switch.click()
        assert np.abs(picture(page) - before)[inside].mean() < 0.05, layer
    assert page.drawn() == drawn


def test_labels_are_seen_in_the_colours_of_the_legend(opened):
    build, page = opened
    stall = next(
        stall
        for stall in build.garage.layout.stalls
        if stall.name not in {car.stall for car in build.garage.layout.of_kind("car")}
    )
    x, z = stall.centre_m
    page.eval(
        f"viewer.orbit.target.set({x}, 0, {z}), viewer.camera.position.set({x}, 14, {z + 1}), viewer.orbit.update()"
    )
    page.page.keyboard.press("4")
    seen = picture(page)
    column, row = (int(value) for value in page.screen((x, 0, z)))
    legend = page.eval(
        "getComputedStyle(document.querySelector('.class[data-label=parking_stall] .chip')).backgroundColor"
    )
    colour = np.array([int(word) for word in legend[4:-1].split(",")])
    pixel = seen[row, column]
    assert np.abs(pixel / np.linalg.norm(pixel) - colour / np.linalg.norm(colour)).max() < 0.05
    page.page.keyboard.press("3")


@pytest.mark.soak
def test_one_walks_at_eye_height_and_through_no_wall(opened):
    build, page = opened
    page.page.click("#mode-walk")
    page.rest()
    assert page.eval("document.documentElement.dataset.mode") == "walk"
    start = page.eval("viewer.walker.feet.toArray()")
    eye = page.eval("viewer.camera.position.toArray()")
    assert eye[1] == pytest.approx(1.65, abs=0.01)
    page.page.keyboard.down("w")
    page.page.wait_for_timeout(700)
    page.page.keyboard.up("w")
    assert np.linalg.norm(np.subtract(page.eval("viewer.walker.feet.toArray()"), start)) > 0.3
    # a long way in every direction, by the walker's own steps: never out of the garage, into a car or off the floor
    structure = build.garage.layout.structure
    floors = [(0.0, structure.column_edges_m[-1], 0.0, structure.row_edges_m[-1])]
    for entry in labelled_objects(build.labels):
        if entry["class"] == "ramp":
            (x0, _, z0), (x1, _, z1) = entry["min_m"], entry["max_m"]
            floors.append((x0, x1, z0, z1))
    ways = page.eval(
        "(() => { const found = [], { walker } = viewer; walker.key('KeyW', true); walker.key('ShiftLeft', true);"
        f" for (let way = 0; way < 4; way++) {{ walker.feet.fromArray({start}); walker.yaw = 0.6 * way;"
        " for (let k = 0; k < 90; k++) { if (k % 6 === 0) walker.yaw += 2.4;"
        " walker.advance(0.35); found.push(walker.feet.toArray()); } }"
        " walker.release(); return found; })()"
    )
    ways = np.array(ways)
    assert np.ptp(ways[:, 0]) + np.ptp(ways[:, 2]) > 8
    for x, y, z in ways:
        assert any(x0 <= x <= x1 and z0 <= z <= z1 for x0, x1, z0, z1 in floors)
        if all(0 <= value <= most for value, most in zip((x, z), floors[0][1::2], strict=True)):
            assert abs(y) < 0.2
    cars = [entry for entry in labelled_objects(build.labels) if entry["class"] == "car"]
    lows, highs = (np.array([entry[name] for entry in cars])[:, [0, 2]] for name in ("min_m", "max_m"))
    feet = ways[:, None, [0, 2]]
    assert np.maximum(lows - feet, feet - highs).max(axis=2).min() > 0
    page.eval("viewer.touch()")
    page.rest()
    # the plan shows where one is
    assert page.page.inner_text("#place") == f"{ways[-1][0]:.1f}, {ways[-1][2]:.1f} m"


def test_inside_it_is_lit_the_ceiling_too(opened):
    _, page = opened
    page.eval("viewer.walkIn(), viewer.walker.pitch = 0.5, viewer.touch()")
    ceiling = picture(page)[90:240, 280:720]
    assert 70 < ceiling.mean() < 235
    assert ceiling.std() > 4
    # a sky of a colour that no garage has shows through no gap, but where the ceiling is hidden
    page.eval("(viewer.sky = viewer.world.background.getHex(), viewer.world.background.set(0xff00ff), viewer.touch())")
    ceiling = picture(page)[90:240, 280:720]
    page.page.keyboard.press("c")
    open_air = picture(page)[90:240, 280:720]
    page.eval("(viewer.world.background.set(viewer.sky), viewer.touch())")
    assert not is_magenta(ceiling).any()
    assert is_magenta(open_air).mean() > 0.2
    page.page.keyboard.press("1")
