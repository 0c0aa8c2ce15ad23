"""What cameras do to light: measured on fields whose pictures are known."""

import numpy as np
import pytest

from garage2usd.common.errors import ConfigError
from garage2usd.sensors.developing import develop, exposure_scale, sensed
from garage2usd.sensors.rays.lenses import Pinhole
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping
from garage2usd.sensors.rig.sensors import CameraEffects

LENS = Pinhole(size_px=(96, 64), centre_px=(48.0, 32.0), focal_px=(60.0, 60.0))
PLAIN = CameraEffects(exposure="fixed", tone="linear")


def taken(light, effects, *, frame="f", seed=1, lens=LENS):
    return develop(light, lens, effects, camera="c", frame=frame, seed=seed)


def flat(value, shape=(64, 96)):
    return np.full((*shape, 3), value)


@pytest.mark.parametrize(("full_well", "read"), [(4000.0, 12.0), (900.0, 4.0)])
def test_variance_grows_with_the_mean_as_electrons_say(full_well, read):
    effects = CameraEffects(full_well_electrons=full_well, read_noise_electrons=read, bits=12)
    random = np.random.default_rng(5)
    numbers = [
        sensed(np.full(1_000_000, level), effects, full_well, random) * 4095 for level in np.linspace(0.1, 0.7, 6)
    ]
    slope, offset = np.polyfit([each.mean() for each in numbers], [each.var() for each in numbers], 1)
    per_electron = 4095 / full_well
    assert slope == pytest.approx(per_electron, rel=0.02)
    # what is left at no light is the noise of reading and of rounding
    assert offset == pytest.approx((read * per_electron) ** 2 + 1 / 12, rel=0.25)


def test_gain_leaves_fewer_electrons():
    effects = PLAIN.model_copy(update={"full_well_electrons": 2000.0, "exposure_ev": 2.0})
    picture = taken(flat(0.1, (64, 96)), effects)
    facts = picture.facts["cameras"]["c"]
    assert facts["gain"] == 4.0
    assert facts["electrons_per_number"] == pytest.approx(500 / 4095, abs=1e-6)
    values = picture.pixels / 255
    assert values.mean() == pytest.approx(0.4, rel=0.01)
    assert values.var() == pytest.approx(0.4 / 500 + 1 / 12 / 255**2, rel=0.05)


def test_automatic_exposure_makes_the_mean_grey():
    light = np.random.default_rng(0).gamma(0.7, 0.2, (5000, 3))
    effects = CameraEffects(grey=0.25)
    scale = exposure_scale(light, effects)
    luminance = light @ [0.2126, 0.7152, 0.0722]
    assert np.minimum(luminance * scale, 1).mean() == pytest.approx(0.25, rel=1e-6)
    assert exposure_scale(light * 1e-9, effects) == 2.0**effects.most_gain_ev


def test_a_plain_camera_changes_nothing_but_the_curve():
    light = np.random.default_rng(1).uniform(0, 1, (64, 96, 3))
    assert np.array_equal(taken(light, PLAIN).pixels, np.rint(light * 255))


def test_vignetting_takes_its_share_at_the_corner():
    pixels = taken(flat(0.8), PLAIN.model_copy(update={"vignetting": 0.5})).pixels / 255
    assert pixels[32, 48, 0] == pytest.approx(0.8, abs=0.005)
    assert pixels[0, 0, 0] == pytest.approx(0.4, abs=0.015)


def test_red_is_larger_than_green_and_blue_smaller():
    light = flat(0.0)
    light[:, 80:] = 1.0  # an edge 32 pixels to the right of the axis
    pixels = taken(light, PLAIN.model_copy(update={"chromatic_error": 0.02})).pixels / 255
    edges = 96 - pixels[32].sum(axis=0)
    assert edges == pytest.approx([48 + 32 * 1.02, 80, 48 + 32 * 0.98], abs=0.06)


def test_bloom_keeps_the_light_and_reaches_the_dark():
    light = flat(0.0)
    light[30:34, 46:50] = 20.0
    pixels = taken(light, PLAIN.model_copy(update={"bloom": 0.5, "bloom_width": 0.03})).pixels
    assert pixels[32, 54, 0] > 20
    assert not taken(light, PLAIN).pixels[32, 54].any()


def test_flare_lies_across_the_axis():
    light = flat(0.0)
    light[14:18, 70:74] = 30.0
    ghost = taken(light, PLAIN.model_copy(update={"flare": 0.5, "bloom_width": 0.005})).pixels[..., 0].astype(float)
    ghost[10:22, 66:78] = 0
    rows, columns = np.indices(ghost.shape) + 0.5
    assert (columns * ghost).sum() / ghost.sum() == pytest.approx(48 - 24 * 0.6, abs=1)
    assert (rows * ghost).sum() / ghost.sum() == pytest.approx(32 + 16 * 0.6, abs=1)


def test_dirt_stays_on_the_lens_and_noise_does_not():
    dirty = PLAIN.model_copy(update={"dirt": 6})
    first, second = (taken(flat(0.7), dirty, frame=frame).pixels for frame in "ab")
    assert np.array_equal(first, second)
    assert first.min() < 0.6 * 255
    assert not np.array_equal(first, taken(flat(0.7), dirty, seed=2).pixels)
    noisy = PLAIN.model_copy(update={"full_well_electrons": 500.0})
    one, again, other = (taken(flat(0.7), noisy, frame=frame).pixels for frame in "aab")
    assert np.array_equal(one, again)
    assert not np.array_equal(one, other)


def test_jpeg_is_the_same_each_time_and_coarser_at_lower_quality():
    light = np.random.default_rng(1).uniform(0, 1, (64, 96, 3))
    fine, coarse = (PLAIN.model_copy(update={"jpeg_quality": quality}) for quality in (95, 20))
    assert np.array_equal(taken(light, coarse).pixels, taken(light, coarse).pixels)
    error = [np.abs(taken(light, each).pixels - light * 255).mean() for each in (fine, coarse)]
    assert 0 < error[0] < error[1]


def test_headroom_tells_what_would_be_burnt_out():
    light = flat(1.0)
    light[:, :48] = 3.0
    assert np.unique(taken(light, PLAIN).pixels).tolist() == [255]
    wide = taken(light, PLAIN.model_copy(update={"headroom": 8.0})).pixels
    assert 128 < wide[0, 90, 0] < wide[0, 0, 0] < 255


def test_cameras_of_an_around_view_differ_at_its_seams():
    rig = read_rig("avp_around_view").scaled(0.2)
    lens = rig.cameras[0].lens
    effects = CameraEffects(exposure="fixed", tone="linear", exposure_spread_ev=0.6, white_balance_spread=0.1)
    picture = develop(flat(0.2, (120, 120)), lens, effects, camera="around", frame="around_0000", seed=3)
    facts = picture.facts["cameras"]
    assert set(facts) == {"front", "rear", "left", "right"}
    for name, (row, column) in {"front": (5, 60), "rear": (115, 60), "left": (60, 5), "right": (60, 115)}.items():
        wanted = 0.2 * facts[name]["exposure"] * np.array(facts[name]["white_balance"])
        assert picture.pixels[row, column] / 255 == pytest.approx(np.minimum(wanted, 1), abs=0.003)
    assert len({facts[name]["exposure"] for name in facts}) == 4
    assert not picture.pixels[60, 60].any()


def test_what_no_camera_has_is_refused():
    sensor = {"kind": "pinhole", "name": "a", "position_m": [1, 0, 1], "size_px": [64, 48], "focal_px": [50, 50]}
    with pytest.raises(ConfigError, match="bits") as refused:
        rig_from_mapping({"name": "r", "sensors": [{**sensor, "effects": {"bits": 4}}]})
    assert refused.value.field == "rig.sensors.0.effects.bits"
    around = read_rig("avp_around_view").model_dump(mode="json")
    around["sensors"][0]["effects"] = {"chromatic_error": 0.01}
    with pytest.raises(ConfigError, match="without chromatic_error"):
        rig_from_mapping(around)
