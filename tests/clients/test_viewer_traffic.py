"""The viewer plays tracks in a browser: agents are where the tracks have them, at each time that the slider has."""

import numpy as np
import pytest
from support.browser import find_browser
from support.hand_made_tracks import hand_made
from support.small_garage import SETTINGS
from support.viewer_page import viewed

import garage2usd
from garage2usd.as_built.garage import garage_of_file
from garage2usd.track_forms import write_tracks

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
]
MATRICES = """() => viewer.traffic.group.children.map((mesh) => {
  viewer.traffic.place(0);
  return [...mesh.instanceMatrix.array];
})"""

PLAYED = "async () => { while (viewer.traffic.time <= %s) await new Promise(requestAnimationFrame); }"


@pytest.fixture(scope="module")
def opened(tmp_path_factory):
    folder = tmp_path_factory.mktemp("viewed")
    stage = garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "garage.usdc").stage
    garage = garage_of_file(stage)
    tracks = hand_made(garage)
    write_tracks(folder / "run.parquet", tracks, garage)
    with viewed(stage, options=["--tracks", folder / "run.parquet"]) as page:
        yield tracks, page
        assert page.complaints == []


def test_agents_stand_where_the_tracks_have_them(opened):
    tracks, page = opened
    cars = [track for track in tracks if track.agent.kind == "car"]
    people = [track for track in tracks if track.agent.kind == "person"]
    for time in (0.0, 7.05, 11.5, 40.0, 63.33, 120.0, 302.2):
        page.eval(f"viewer.traffic.seek({time})")
        for own, found in zip((cars, people), page.eval(MATRICES), strict=True):
            matrices = np.array(found).reshape(-1, 4, 4)
            for track, matrix in zip(own, matrices, strict=True):
                x, y, z, yaw, pitch = track.at(np.array([time]))[0]
                if np.isnan(x):
                    assert not matrix[:3, :3].any()
                    continue
                assert matrix[3, :3] == pytest.approx((x, y, z), abs=2e-3)
                # along the negative third axis lies the nose, as long as the agent
                nose = -matrix[2, [0, 2]]
                expected = track.agent.length_m * np.cos(pitch) * np.array([-np.sin(yaw), -np.cos(yaw)])
                assert nose == pytest.approx(expected, abs=1e-3)


def test_the_car_of_the_stage_is_hidden_for_its_agent(opened):
    tracks, page = opened
    (own,) = (track for track in tracks if track.agent.prim)
    hidden = page.eval("viewer.traffic.replaced.map((k) => [viewer.scene.paths[k], viewer.instances.visible[k]])")
    paths = dict(hidden)
    assert own.agent.prim in paths
    assert len(paths) == 2  # with its number plates
    assert not any(paths.values())


def test_the_time_line_plays_and_pauses(opened):
    tracks, page = opened
    page.eval("viewer.traffic.seek(0)")
    page.page.select_option("#speed", "16")
    page.page.click("#play")
    page.eval(PLAYED % 4)
    page.page.click("#play")
    stopped = page.eval("viewer.traffic.time")
    page.rest()
    assert page.eval("viewer.traffic.time") == stopped
    minutes, seconds = divmod(int(stopped), 60)
    assert page.page.inner_text("#clock").startswith(f"{minutes}:{seconds:02} / 5:09")
    assert float(page.page.input_value("#time")) == pytest.approx(stopped, abs=tracks.step_s)
    page.page.keyboard.press("t")
    page.eval(PLAYED % stopped)
    page.page.keyboard.press("t")
    assert not page.eval("viewer.traffic.playing")
