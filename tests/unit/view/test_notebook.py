"""Values draw themselves in notebooks: well-formed pages with what the values hold."""

import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest
import shapely
from support.hand_made_tracks import car, track_of, tracks_of, walker
from support.sample_files import REPOSITORY

import garage2usd
from garage2usd.driving.tracks import AgentState, Tracks
from garage2usd.view import notebook
from garage2usd.view.drawing import CM_PER_M

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(scope="module")
def default():
    return garage2usd.generate()


@pytest.fixture(scope="module")
def two_levels():
    settings = garage2usd.load_config(REPOSITORY / "samples" / "two_levels.toml").model_dump(exclude_unset=True)
    return garage2usd.generate(garage2usd.GarageConfig(**settings))


def parsed(html):
    """The page of a value by a parser of XML that takes nothing that is not closed."""
    return ET.fromstring(f"<div>{html}</div>")


def classes(svg, kind):
    return [part for part in svg.iter() if kind in part.get("class", "").split()]


def tooltips(svg, kind):
    return {part.findtext(f"{SVG}title").split()[0] for part in classes(svg, kind)}


def test_a_garage_shows_the_stalls_of_all_its_levels_and_their_section(two_levels):
    page = parsed(two_levels._repr_html_())
    *plans, section = page.iter(f"{SVG}svg")
    assert len(plans) == len(two_levels.levels) == 2
    for plan, level in zip(plans, two_levels.levels, strict=True):
        assert tooltips(plan, "stall") == {stall.name for stall in level.layout.quads}
        assert parsed(level._repr_svg_()).find(f"{SVG}svg").findtext(f"{SVG}title") == plan.findtext(f"{SVG}title")
    assert section.findtext(f"{SVG}title") == "Section through a parking garage of 2 levels"
    assert f"{two_levels.parking_stalls} stalls on 2 levels" in "".join(page.find("figure/figcaption").itertext())


def test_drawings_on_one_page_share_no_id_and_bring_their_paper(two_levels, default):
    page = parsed(f"{two_levels._repr_html_()}{default.layout._repr_svg_()}{default.plan._repr_svg_()}")
    drawings = list(page.iter(f"{SVG}svg"))
    assert len(drawings) == 5
    assert [part.get("id") for part in page.iter() if part.get("id")] == []
    for svg in drawings:
        # on a dark page too, ink lies on paper as large as the drawing
        paper = classes(svg, "paper")[0]
        points = np.array([point.split(",") for point in paper.get("points").split()], dtype=float)
        left, top, width, height = map(float, svg.get("viewBox").split())
        assert (points.min(axis=0), points.max(axis=0) - points.min(axis=0)) == (
            pytest.approx((left, top)),
            pytest.approx((width, height)),
        )
        assert "max-width:100%" in svg.get("style")


def test_the_default_garage_takes_little_room(default):
    assert len(default._repr_html_().encode()) < 300_000
    assert max(len(repr(value)) for value in (default, default.levels[0], default.layout, default.plan)) < 200


def test_a_plan_shows_its_squares_its_score_and_its_one_way_stretches():
    config = garage2usd.GarageConfig(seed=3, plan={"episodes": 40, "starts": 1, "aisles": "one-way"})
    plan = garage2usd.generate(config).plan
    svg = ET.fromstring(plan._repr_svg_())
    assert len(plan.one_way_stretches) > 0
    assert len(classes(svg, "direction")) == 2 * len(plan.one_way_stretches)
    rows, cols = plan.structure.shape
    assert classes(svg, "title")[0].text == (
        f"{rows} x {cols} squares, {plan.score.stalls} stalls, score {plan.score.value:.2f}"
    )


def test_a_build_says_where_it_is_and_what_was_found(builds):
    build = builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdc")
    said = "".join(parsed(build._repr_html_()).find("figure/figcaption").itertext())
    assert str(build.stage) in said
    assert f"{len(build.findings)} findings" in said


def test_tracks_show_the_ways_on_each_level_and_count_agents():
    times = np.arange(0, 20, 0.1)
    levels = np.where(times > 10, 1, 0)
    drives = track_of(car("car_000"), times, x_m=8 * np.sin(times / 6), z_m=3 * times, level=levels)
    stays = track_of(car("car_<1>"), [0.0, 5.0], x_m=3.0, z_m=-4.0, yaw_rad=0.3, state=AgentState.PARKED)
    html = tracks_of(drives, stays, walker("person_000", (0, 0), (4, 0)))._repr_html_()
    page = parsed(html)
    upper, lower = page.iter(f"{SVG}svg")
    assert [len(classes(svg, "track")) for svg in (upper, lower)] == [2, 1]
    (outline,) = classes(upper, "parked")
    corners = np.array([point.split(",") for point in outline.get("points").split()], dtype=float) / CM_PER_M
    parked = shapely.Polygon(corners)
    assert (parked.centroid.x, parked.centroid.y) == pytest.approx((3.0, -4.0), abs=0.01)
    assert parked.area == pytest.approx(stays.agent.length_m * stays.agent.width_m, rel=0.01)
    # its heading is that of a car that drives along -Z turned to the left
    ahead = corners[:2].mean(axis=0) - corners[2:].mean(axis=0)
    assert np.arctan2(-ahead[0], -ahead[1]) == pytest.approx(0.3, abs=0.01)
    assert outline.findtext(f"{SVG}title") == "car_<1> parked"
    rows = [[cell.text or "" for cell in row] for row in page.find("table")]
    assert rows == [["class", "agents", "behaviour"], ["car", "2", ""], ["person", "1", ""]]


def test_no_tracks_are_no_drawing():
    page = parsed(Tracks((), 0.1, 60.0)._repr_html_())
    assert list(page.iter(f"{SVG}svg")) == []


def test_a_drawing_of_too_many_elements_is_a_picture(default, monkeypatch):
    monkeypatch.setattr(notebook, "_MOST_SVG", 1000)
    page = parsed(default._repr_html_())
    assert list(page.iter(f"{SVG}svg")) == []
    (picture,) = page.iter("img")
    assert re.fullmatch(r"data:image/png;base64,iVBOR[A-Za-z0-9+/=]+", picture.get("src"))
