"""The viewer plays tracks in a browser: agents are where the tracks have them, at each time that the slider has."""

import subprocess
import sys

import numpy as np
import pytest
from support.browser import find_browser
from support.hand_made_tracks import hand_made
from support.small_garage import SETTINGS
from support.viewer_page import viewed

import garage2usd
from garage2usd.as_built.garage import garage_of_file
from garage2usd.config.vehicles import body_named
from garage2usd.track_forms import write_tracks

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
]
ROWS = """() => { viewer.traffic.place(0);
  const rowsOf = (object) => [...viewer.instances.instances.slice(16 * object, 16 * object + 12)];
  return viewer.scene.tracks.agents.map(({ parts }) =>
    parts.map(({ object }) => viewer.instances.moving.includes(object) ? rowsOf(object) : null));
}"""
LOWEST = """() => { viewer.traffic.place(0);
  const { object } = viewer.scene.tracks.agents.find(({ gait }) => gait).parts[0];
  const { skin, vertices: [first, count] } = viewer.scene.shapes[viewer.scene.shape[object]];
  const [joints, weights] = [skin.joints, skin.weights].map((array) => viewer.scene.bytes(array));
  const row = viewer.instances.instances.slice(16 * object + 4, 16 * object + 8);
  let lowest = Infinity;
  for (let k = 0; k < count; k++) {
    const p = [...viewer.scene.positions.slice(3 * (first + k), 3 * (first + k) + 3), 1];
    const { data } = viewer.traffic.bones.image;
    const moved = [0, 1, 2].map((r) => [0, 1, 2, 3].reduce((sum, i) => sum + weights[4 * k + i] / 255 *
      p.reduce((own, x, c) => own + x * data[4 * (3 * joints[4 * k + i] + r) + c], 0), 0));
    lowest = Math.min(lowest, row[0] * moved[0] + row[1] * moved[1] + row[2] * moved[2] + row[3]);
  }
  return lowest;
}"""
PLAYED = "async () => { while (viewer.traffic.time <= %s) await new Promise(requestAnimationFrame); }"


@pytest.fixture(scope="module")
def opened(tmp_path_factory):
    folder = tmp_path_factory.mktemp("viewed")
    stage = garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "garage.usdc").stage
    garage = garage_of_file(stage)
    tracks = hand_made(garage)
    write_tracks(folder / "run.parquet", tracks, garage)
    with viewed(stage, options=["--tracks", folder / "run.parquet"]) as page:
        page.stage, page.tracks = stage, folder / "run.parquet"
        yield tracks, page
        assert page.complaints == []


def test_agents_stand_where_the_tracks_have_them(opened):
    tracks, page = opened
    for time in (0.0, 7.05, 11.5, 40.0, 63.33, 120.0, 302.2):
        page.eval(f"viewer.traffic.seek({time})")
        for track, parts in zip(tracks, page.eval(ROWS), strict=True):
            x, y, z, yaw, pitch = track.at(np.array([time]))[0]
            if np.isnan(x):
                assert not any(parts)
                continue
            body, *wheels = np.array(parts).reshape(-1, 3, 4)
            assert body[:, 3] == pytest.approx((x, y, z), abs=2e-3)
            # a figure looks along its third axis, a car against it
            nose = body[[0, 2], 2] if track.agent.kind == "person" else -body[[0, 2], 2]
            expected = np.cos(pitch) * np.array([-np.sin(yaw), -np.cos(yaw)])
            assert nose == pytest.approx(expected, abs=5e-3)
            steering = np.interp(time, track.time_s, track.steering_rad)
            rolled = np.interp(time, track.time_s, track.rolled_m(track.agent.rear_axle_m))
            assert len(wheels) == (0 if track.agent.kind == "person" else 4)
            for wheel in wheels:
                hub = body[:, :3].T @ (wheel[:, 3] - body[:, 3])
                own = body[:, :3].T @ wheel[:, :3]
                assert 0.2 < hub[1] < 0.45
                turned = steering if hub[2] < 0 else 0.0
                assert own[:, 0] == pytest.approx((np.cos(turned), 0, -np.sin(turned)), abs=2e-3)
                radius = body_named(track.agent.body).wheel_radius_m
                assert own[1, 1] == pytest.approx(np.cos(rolled / radius), abs=0.05)


def test_feet_stay_on_the_floor(opened):
    _, page = opened
    lowest = []
    for time in (300.4, 300.9, 301.3, 301.7, 304.0, 308.1):
        page.eval(f"viewer.traffic.seek({time})")
        lowest.append(page.eval(LOWEST))
    assert np.abs(lowest).max() < 0.02


def test_a_film_is_as_long_as_it_should_be_and_moves(opened, tmp_path):
    import av

    _, page = opened
    drives = ["--tracks", page.tracks, "--start", 13, "--seconds", 0.4, "--speed", 8, "--size", "320x180"]
    for camera in ("above", "car_000"):
        file = tmp_path / f"{camera}.mp4"
        command = [sys.executable, "-m", "garage2usd", "view", page.stage, *drives, "--camera", camera, "--video", file]
        subprocess.run([str(word) for word in command], check=True, capture_output=True, timeout=600)
        with av.open(str(file)) as film:
            frames = np.array([frame.to_ndarray(format="gray") for frame in film.decode(video=0)], float)
            assert film.streams.video[0].average_rate == 25
        assert frames.shape == (10, 180, 320)
        assert frames.std() > 10
        # from above one car moves, a driver sees all move
        assert np.abs(frames[-1] - frames[0]).max() > 30
        if camera != "above":
            assert (np.abs(np.diff(frames, axis=0)).max(axis=(1, 2)) > 8).all()


def test_the_car_of_the_stage_is_hidden_for_its_agent(opened):
    tracks, page = opened
    (own,) = (track for track in tracks if track.agent.prim)
    hidden = page.eval("[...viewer.scene.replaced].map((k) => [viewer.scene.paths[k], viewer.instances.visible[k]])")
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
