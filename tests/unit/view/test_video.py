"""Videos: what cannot be made is one line before the work."""

import pytest
from click.testing import CliRunner
from support.hand_made_tracks import tracks_of, walker

from garage2usd.cli import main
from garage2usd.common import package
from garage2usd.maps.track_tables import write_track_csv

FAULTS = {
    "ending": (["--video", "run.avi"], "video: got 'run.avi'; allowed: a path that ends in .mp4"),
    "camera": (["--camera", "bird"], "camera: got 'bird'; allowed: above, or an agent: person_000"),
    "start": (["--start", "99"], "start: got 99.0; allowed: from 0 to less than 8.8, the end of the tracks"),
    "seconds": (["--seconds", "0"], "seconds: got 0.0; allowed: more than 0, up to 3600"),
    "speed": (["--speed", "-1"], "speed: got -1.0; allowed: more than 0"),
    "size": (["--size", "961x540"], "size: got '961x540'; allowed: width and height as 960x540, even numbers up to"),
}


@pytest.fixture
def seen(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_track_csv(tmp_path / "run.csv", tracks_of(walker("person_000", (0, 0), (2, 0), stands_s=5.6)))
    (tmp_path / "garage.usda").touch()

    def run(*words):
        found = CliRunner().invoke(main, ["view", "garage.usda", *words])
        assert found.exit_code == 1, found.output
        (line,) = found.stderr.splitlines()
        assert not list(tmp_path.glob("*.mp4"))
        return line

    return run


@pytest.mark.parametrize("fault", FAULTS)
def test_faults_are_one_line(seen, fault):
    words, told = FAULTS[fault]
    assert told in seen("--tracks", "run.csv", "--video", "run.mp4", *words)


def test_a_video_shows_tracks(seen):
    assert "video: got 'run.mp4'; allowed: with --tracks, which it shows" in seen("--video", "run.mp4")


@pytest.mark.parametrize("missing", [("av",), ("playwright",), ("av", "playwright")])
def test_the_extra_is_named(seen, missing, monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda module: None if module in missing else module)
    line = seen("--tracks", "run.csv", "--video", "run.mp4")
    assert line.startswith("a video needs ", line.index("a video"))
    assert line.endswith(package.installation_of("video"))
