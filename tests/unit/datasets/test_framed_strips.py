"""Strips in the form of an outside detector, as `benchmarks/real.py outside` shows them to it, and what it reports."""

import json

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support.benchmarks import benchmark

from garage2usd.common.errors import ConfigError
from garage2usd.datasets import load_recipe

average_precision, drawn_lines, framed_strips, strips = map(
    benchmark, ("average_precision", "drawn_lines", "framed_strips", "strips")
)
WIDTH, HEIGHT = strips.SIZE_PX


def strip(pixels):
    return strips.Strip("hall_left/1.png", "hall", pixels, np.zeros((0, 2)), np.zeros(0, dtype=bool))


class TestFrames:
    @given(st.lists(st.tuples(st.integers(0, 47), st.integers(0, 149)), min_size=1, max_size=12, unique=True))
    def test_corners_come_back_where_they_are(self, places):
        pixels = np.full((HEIGHT, WIDTH, 3), 90, dtype=np.uint8)
        corners = np.array(places) * 2 + 0.5
        pixels[(corners[:, 1]).astype(int), corners[:, 0].astype(int)] = 255
        frame = framed_strips.framed(strip(pixels))
        found = framed_strips.corners_in_strip((frame == frame.max()).astype(np.float32))
        apart_px = np.linalg.norm(found.places_px[:, None] - corners, axis=2)
        assert len(found.confidence) == len(corners)
        assert apart_px.min(axis=0).max() < 1

    def test_frames_are_what_networks_take(self):
        random = np.random.default_rng(0)
        frame = framed_strips.framed(strip(random.integers(0, 256, (HEIGHT, WIDTH, 3)).astype(np.uint8)))
        assert frame.shape == framed_strips.FRAME_PX[::-1]
        assert not np.any(np.array(frame.shape) % 32)
        assert frame.mean() == pytest.approx(0, abs=1e-5)
        assert frame.std() == pytest.approx(1, abs=1e-5)
        # the car goes on to the right
        assert np.ptp(frame[:, -10:]) == 0
        assert frame[0, -1] == frame.min()

    def test_a_strip_of_one_grey_is_framed(self):
        assert np.isfinite(framed_strips.framed(strip(np.zeros((HEIGHT, WIDTH, 3), dtype=np.uint8)))).all()

    def test_what_is_beside_the_strip_is_no_corner(self):
        confidence = np.zeros(framed_strips.FRAME_PX[::-1], dtype=np.float32)
        confidence[5, 100] = confidence[100, 20] = confidence[100, 150] = confidence[315, 100] = 0.9
        confidence[160, 92] = 0.4
        found = framed_strips.corners_in_strip(confidence)
        assert found.confidence == pytest.approx([0.4])
        assert found.places_px.tolist() == [[48.5, 150.5]]


def test_recall_and_precision_at_a_threshold():
    found = average_precision.Detections(
        np.array([[10.0, 10.0], [50.0, 50.0], [30.0, 30.0]]), np.array([0.9, 0.5, 0.4])
    )
    picture = average_precision.matched(found, np.array([[10.0, 12.0], [30.0, 31.0]]), np.zeros(2, dtype=bool))
    assert average_precision.at_threshold([picture], 0.95) == (0, 1)
    assert average_precision.at_threshold([picture], 0.5) == (0.5, 0.5)
    assert average_precision.at_threshold([picture, picture], 0.4) == (1, pytest.approx(2 / 3))
    with pytest.raises(ValueError, match="no corner"):
        average_precision.at_threshold([], 0.5)


@pytest.mark.parametrize(
    ("pattern", "colour", "said"),
    [
        ("closed", "#e8e6e0", "closed, white"),
        ("dashed", "#eac433", "closed, coloured"),
        ("double", "#3d6eab", "open, coloured"),
        ("sides", "#ddc9e7", "open, white"),
    ],
)
def test_drawn_garages_are_told_by_their_lines(tmp_path, pattern, colour, said):
    look = f'[garage.look.markings]\npattern = "{pattern}"\ncolour = "{colour}"\n'
    (tmp_path / "recipe.toml").write_text(f'name = "lines"\n{look}')
    recipe = load_recipe(tmp_path / "recipe.toml")
    (tmp_path / "about.json").write_text(json.dumps({"seed": 7}))
    assert drawn_lines.lines(recipe, tmp_path) == said
    (tmp_path / "about.json").unlink()
    with pytest.raises(ConfigError, match=r"about\.json"):
        drawn_lines.lines(recipe, tmp_path)
