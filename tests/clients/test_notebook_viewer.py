"""The viewer in a frame of another page: pages of this machine have it, others are refused by the browser."""

import socket

import pytest
from support.browser import find_browser
from support.framed_page import FOREIGN, framed
from support.hand_made_tracks import car, track_of, tracks_of
from support.sample_files import REPOSITORY

import garage2usd

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
]


@pytest.fixture(scope="module")
def viewer(builds):
    build = builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdz")
    tracks = tracks_of(track_of(car("car_000"), [0.0, 1.0, 2.0], x_m=3.0, z_m=5.0))
    with garage2usd.show(build.stage, tracks=tracks, height_px=500) as viewer:
        yield viewer


def test_a_page_of_this_machine_shows_it(viewer):
    seen = framed(viewer._repr_html_())
    assert "stalls" in seen.facts
    assert seen.colours > 1000
    assert seen.complaints == []


def test_a_page_of_another_host_is_refused(viewer):
    seen = framed(viewer._repr_html_(), host=FOREIGN, timeout_ms=3000)
    assert seen.facts == ""
    assert any("frame-ancestors" in line for line in seen.complaints)


def test_a_closed_viewer_says_so_and_frees_its_port(builds):
    viewer = garage2usd.show(builds(REPOSITORY / "samples" / "hand_drawn.toml", "usdz").stage)
    port = int(viewer.url.rstrip("/").rpartition(":")[2])
    viewer.close()
    viewer.close()
    assert viewer.url is None
    assert viewer._repr_html_() == "<p>hand_drawn.usdz: the viewer is closed</p>"
    with socket.socket() as again:
        again.bind(("127.0.0.1", port))
