"""Strips beside a car, from which `benchmarks/real.py` learns: read, drawn and changed, and what is found in them."""

import json
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image
from support.benchmarks import benchmark

from garage2usd.common.errors import ConfigError
from garage2usd.config import config_from_mapping
from garage2usd.datasets import load_recipe
from garage2usd.pipeline import build, generate
from garage2usd.reading.files import open_stage

average_precision, corner_maps, strips, strip_changes, strip_rig, strip_poses, drawn_folder, strip_labels = map(
    benchmark,
    (
        "average_precision",
        "corner_maps",
        "strips",
        "strip_changes",
        "strip_rig",
        "strip_poses",
        "drawn_folder",
        "strip_labels",
    ),
)
Detections, matched, score = average_precision.Detections, average_precision.matched, average_precision.score
NONE = np.zeros((0, 2))


def found(*places):
    places = np.array(places, dtype=np.float64).reshape(-1, 3)
    return Detections(places[:, :2], places[:, 2])


def judged(detections, corners, hidden=()):
    places = np.array([*corners, *hidden], dtype=np.float64).reshape(-1, 2)
    return matched(detections, places, np.arange(len(places)) >= len(corners))


class TestAveragePrecision:
    def test_a_case_by_hand(self):
        # by confidence: hit, false, hit, false; one of three is never found
        one = judged(found((10, 10, 0.9), (50, 50, 0.8)), [(10, 12)])
        two = judged(found((20, 20, 0.7), (70, 70, 0.1)), [(20, 20), (90, 290)])
        # precision 1 up to a third, 2/3 up to two thirds, 0 beyond
        assert score([one, two]).average_precision == pytest.approx((1 + 2 / 3) / 3)
        assert score([one, two]).best_f1 == pytest.approx(2 * 2 / (3 + 3))
        assert score([one, two]).threshold == pytest.approx(0.7)

    @given(
        st.lists(st.tuples(st.integers(1, 20), st.booleans()), max_size=40),
        st.integers(0, 10),
    )
    def test_it_is_the_mean_over_corners_of_the_best_precision_at_their_recall(self, entries, never_found):
        confidence = np.array([value / 20 for value, _ in entries])
        is_hit = np.array([hit for _, hit in entries], dtype=bool)
        true = int(is_hit.sum()) + never_found + 1
        picture = average_precision.Matched(
            confidence, is_hit, np.zeros((len(entries), 2)), np.where(is_hit, 0, -1), true
        )

        def counted(threshold):
            sure = confidence >= threshold
            return int((sure & is_hit).sum()), int(sure.sum())

        points = [counted(threshold) for threshold in set(confidence.tolist())]
        best = [max((hits / all_ for hits, all_ in points if hits >= rank), default=0.0) for rank in range(1, true + 1)]
        f1 = max((2 * hits / (all_ + true) for hits, all_ in points), default=0.0)
        assert score([picture]).average_precision == pytest.approx(sum(best) / true)
        assert score([picture]).best_f1 == pytest.approx(f1)

    def test_each_corner_is_found_once_by_the_surest(self):
        result = judged(found((10, 10, 0.5), (12, 10, 0.9)), [(10, 10)])
        assert result.confidence.tolist() == [0.9, 0.5]
        assert result.is_hit.tolist() == [True, False]

    def test_six_pixels_are_near_enough(self):
        assert judged(found((16, 10, 0.5)), [(10, 10)]).is_hit.all()
        assert not judged(found((16.01, 10, 0.5)), [(10, 10)]).is_hit.any()

    def test_at_an_occluded_corner_nothing_counts(self):
        result = judged(found((10, 10, 0.5), (80, 80, 0.4)), [], hidden=[(10, 10)])
        assert result.true == 0
        assert result.confidence.tolist() == [0.4]
        assert judged(found((10, 10, 0.5)), [(12, 10)], hidden=[(10, 10)]).is_hit.all()

    def test_nothing_found_is_worth_nothing(self):
        assert score([judged(Detections(NONE, np.zeros(0)), [(1, 1)])]).average_precision == 0

    def test_without_corners_there_is_no_score(self):
        with pytest.raises(ValueError, match="no corner"):
            score([judged(found((1, 1, 0.5)), [])])


class TestCornerMaps:
    def test_peaks_are_where_corners_are(self):
        corners = np.array([[3.0, 290.0], [40.0, 100.0], [60.0, 100.0], [95.0, 1.0]])
        peaks = corner_maps.peaks(corner_maps.corner_map(corners))
        apart = np.linalg.norm(peaks.places_px[:, None] - corners, axis=2)
        assert len(peaks.confidence) == len(corners)
        assert (apart.min(axis=0) <= math.hypot(2, 2)).all()

    def test_a_map_without_corners_has_no_peaks(self):
        assert not len(corner_maps.peaks(corner_maps.corner_map(NONE)).confidence)


def dotted(column, row, count, colour=(255, 255, 255)):
    """Grey strips with the car at the right edge and a dot about a place."""
    pixels = np.full((count, 300, 96, 3), 60, dtype=np.uint8)
    pixels[:, row - 2 : row + 2, column - 2 : column + 2] = colour
    pixels[:, 90:210, 88:] = 0
    return pixels, [np.array([[float(column), float(row)]])] * count


def dot(picture):
    """The centroid (column, row) of what is brighter than halfway between floor and dot, from the left upper edge."""
    grey = picture.mean(axis=2)
    rows, columns = np.nonzero(grey > (np.median(grey) + grey.max()) / 2)
    return np.array([columns.mean() + 0.5, rows.mean() + 0.5])


class TestChangedStrips:
    @pytest.fixture
    def unlit(self, monkeypatch):
        """Moved alone: light, cameras and exposure leave what is there."""
        monkeypatch.setattr(strip_changes, "_SHARES", {})
        monkeypatch.setattr(strip_changes, "_MOST_NOISE", 0.0)

    @pytest.mark.usefixtures("unlit")
    def test_corners_go_where_the_picture_goes(self):
        pictures, maps = strip_changes.changed(*dotted(42, 40, 60), np.random.default_rng(0))
        places = []
        for picture, heat in zip(pictures, maps, strict=True):
            (place,) = corner_maps.peaks(heat).places_px
            # half of a cell, and of the pixels that the dot is resampled to
            assert np.abs(dot(picture) - place).max() < 2.7
            places.append(place)
        columns, rows = np.array(places).T
        assert (rows < 150).sum() in range(15, 46)  # turned over
        assert columns.std() > 8
        assert rows[rows < 150].std() > 8

    @pytest.mark.usefixtures("unlit")
    def test_corners_that_leave_the_picture_are_left_out(self):
        pixels, corners = dotted(4, 150, 60)
        pictures, maps = strip_changes.changed(pixels, corners, np.random.default_rng(0))
        kept = [(heat == 1).sum() for heat in maps]
        assert set(kept) == {0, 1}
        assert 30 < sum(kept) < 55
        assert all(heat.max() == 0 for heat in maps if not (heat == 1).any())
        assert len(pictures) == len(maps) == 60

    @pytest.mark.parametrize("name", strip_changes._CHANGES)
    def test_light_and_cameras_leave_things_where_they_are(self, name):
        pixels, _ = dotted(42, 130, 1)
        for seed in range(20):
            before = pixels[0].astype(np.float32) / 255
            after = strip_changes._CHANGES[name](before, np.random.default_rng(seed))
            assert after.dtype == np.float32
            assert after.shape == before.shape
            assert after.min() >= 0
            assert (before == pixels[0].astype(np.float32) / 255).all()
            around = after[122:138, 34:50] - np.median(after[122:138, 34:50])
            assert np.abs(dot(around) - 8).max() < 1, seed  # where it was, 8 px from the edges

    def test_the_car_mirrors_and_takes_no_light(self):
        pixels, _ = dotted(42, 130, 1)
        for name in ("shades", "bars", "seams", "grey"):
            lit = strip_changes._CHANGES[name](pixels[0].astype(np.float32) / 255, np.random.default_rng(1))
            assert lit[92:208, 90:].max() == 0, name

    def test_bars_of_light_are_long_away_from_the_car(self):
        dark = np.full((300, 96, 3), 0.3, dtype=np.float32)
        spread = []
        for seed in range(40):
            light = (strip_changes._bars(dark, np.random.default_rng(seed)) - dark).mean(axis=2)
            down, right = np.gradient(light[130:170, :40])
            spread.append((np.abs(down).sum(), np.abs(right).sum()))
        down, right = np.sum(spread, axis=0)
        assert down > 1.8 * right

    def test_far_ground_is_smeared_and_near_ground_is_not(self):
        floor = np.random.default_rng(0).random((300, 96, 3), dtype=np.float32)
        kept = []
        for seed in range(20):
            smeared = strip_changes._smear(floor, np.random.default_rng(seed))
            kept.append([smeared[place].std() / floor[place].std() for place in (np.s_[140:160, 84:], np.s_[:20, :40])])
        near, far = np.mean(kept, axis=0)
        assert near > 0.7
        assert far < 0.5

    def test_the_same_seed_gives_the_same_bytes(self):
        pixels, corners = dotted(42, 40, 4)
        first, again, other = (
            strip_changes.changed(pixels, corners, np.random.default_rng(seed)) for seed in (3, 3, 4)
        )
        assert all((one == two).all() for one, two in zip(first, again, strict=True))
        assert (first[0] != other[0]).any()
        assert first[0].dtype == first[1].dtype == np.float32
        assert np.isfinite(first[0]).all()


def write(folder, name="hall_left/1.png", corners=([10.0, 20.0, False],), size=(96, 300)):
    place = folder / name
    place.parent.mkdir(parents=True, exist_ok=True)
    pixels = np.zeros((*size[::-1], 3), dtype=np.uint8)
    pixels[20:22, 9:11] = 200
    Image.fromarray(pixels).save(place)
    (folder / "corners.json").write_text(json.dumps({name: corners}))


class TestFolders:
    def test_right_strips_are_mirrored(self, tmp_path):
        write(tmp_path, "hall_b_right/1.png", corners=[[10.0, 21.0, False], [30.5, 100.0, True]])
        (strip,) = strips.read_strips(tmp_path)
        assert strip.garage == "hall_b"
        assert strip.corners_px.tolist() == [[86.0, 21.0], [65.5, 100.0]]
        assert strip.seen_px.tolist() == [[86.0, 21.0]]
        assert (strip.pixels[20:22, 85:87] == 200).all()

    def test_what_is_written_is_read(self, tmp_path):
        write(tmp_path)
        strips.write_strips(tmp_path, {"hall_left/1.png": [(10.5, 20.25, False), (1.0, 2.0, True)]})
        (strip,) = strips.read_strips(tmp_path)
        assert strip.corners_px.tolist() == [[10.5, 20.25], [1.0, 2.0]]
        assert strip.is_occluded.tolist() == [False, True]

    @pytest.mark.parametrize(
        ("change", "said"),
        [
            (lambda folder: (folder / "corners.json").unlink(), "a folder with corners.json"),
            (lambda folder: (folder / "corners.json").write_text("{"), "a folder with corners.json"),
            (lambda folder: (folder / "corners.json").write_text("[]"), "a table with the corners"),
            (lambda folder: (folder / "hall_left" / "1.png").unlink(), "a picture"),
            (lambda folder: (folder / "hall_left" / "1.png").write_bytes(b"none"), "a picture"),
            (lambda folder: write(folder, size=(96, 299)), "pictures of 96 x 300 px, not 96 x 299"),
            (lambda folder: write(folder, name="hall/1.png"), "GARAGE_left and GARAGE_right"),
            (lambda folder: write(folder, corners=[[97, 1, False]]), "within the picture"),
            (lambda folder: write(folder, corners=[[1, 1]]), "[x px, y px, is occluded]"),
            (lambda folder: write(folder, corners="none"), "[x px, y px, is occluded]"),
        ],
    )
    def test_what_is_wrong_is_said(self, tmp_path, change, said):
        write(tmp_path)
        change(tmp_path)
        with pytest.raises(ConfigError) as error:
            strips.read_strips(tmp_path)
        assert said in error.value.allowed

    def test_drawn_garages_are_read_in_their_order(self, tmp_path):
        for name in ("b", "a", "of_another_recipe"):
            write(tmp_path / name, f"{name}_left/1.png")
        drawn_folder.write_drawn(tmp_path, [tmp_path / "b", tmp_path / "a"])
        assert [[strip.garage for strip in garage] for garage in drawn_folder.read_drawn(tmp_path)] == [["b"], ["a"]]
        with pytest.raises(ConfigError, match=r"real\.py draw"):
            drawn_folder.read_drawn(tmp_path / "b")


class TestRigAndPoses:
    @pytest.mark.parametrize("effects", [False, True])
    @pytest.mark.parametrize("seed", range(8))
    def test_the_car_is_at_the_edge_as_in_photographs(self, seed, effects):
        rig = strip_rig.drawn_rig(np.random.default_rng(seed), effects=effects)
        for camera, edge in zip(rig.cameras, (-1, 0), strict=True):
            car = camera.lens.over_car(camera.lens.middles()).reshape(300, 96)
            assert 3 <= car.any(axis=0).sum() <= 15
            assert car[:, edge].any()
            assert 99 <= car.any(axis=1).sum() <= 161
            assert np.isfinite(camera.lens.rays(camera.lens.middles())[~car.ravel()]).all()

    def test_cars_are_free_and_show_corners(self, tmp_path):
        settings = {"seed": 3, "site": {"width_cells": 5, "height_cells": 5}, "stage": {"texture_quality": "low"}}
        built = build(config_from_mapping(settings), tmp_path / "garage.usdc")
        random = np.random.default_rng(0)
        rig = strip_rig.drawn_rig(random, effects=True)
        poses = strip_poses.StripPoses(open_stage(built.stage), built.stage, rig, random).drawn(40)
        assert len(poses) > 30
        stalls = built.garage.layout.stalls
        entries = np.array([corner for stall in stalls for corner in stall.corners_m()[:2]])
        grounds = [shapely.Polygon(stall.corners_m()) for stall in stalls]
        body, tail_m = rig.body, rig.body.ahead_m - rig.body.length_m
        beside_m = []
        for pose in poses:
            matrix, half_m = pose.vehicle_to_world, body.width_m / 2
            assert np.linalg.det(matrix[:3, :3]) == pytest.approx(1)
            in_car = (entries - matrix[[0, 2], 3]) @ matrix[[0, 2], :2]  # forwards and to the left
            camera = pose.camera
            ahead_m, left_m, _ = camera.position_m
            column = 48 - (in_car[:, 1] - left_m) / camera.metres_per_px
            row = 150 - (in_car[:, 0] - ahead_m) / camera.metres_per_px
            inside = (column >= 0) & (column < 96) & (row >= 0) & (row < 300)
            assert inside.any()
            beside_m.append(np.abs(in_car[inside, 1]).min())
            car = [(body.ahead_m, half_m), (body.ahead_m, -half_m), (tail_m, -half_m), (tail_m, half_m)]
            ground = shapely.Polygon(np.array(car) @ matrix[[0, 2], :2].T + matrix[[0, 2], 3])
            assert sum(ground.intersection(each).area for each in grounds) < ground.area / 3
        assert 1.2 < np.median(beside_m) < 3.2


@pytest.mark.client
def test_strips_are_drawn_once_with_the_corners_of_their_garage(tmp_path, monkeypatch):
    pytest.importorskip("bpy", reason="Blender's bpy is made for Python 3.11 only")
    drawn_strips = benchmark("drawn_strips")
    (tmp_path / "recipe.toml").write_text(
        'name = "small"\n[garage.site]\nwidth_cells = 5\nheight_cells = 5\n[garage.stage]\ntexture_quality = "low"\n'
    )
    recipe = load_recipe(tmp_path / "recipe.toml")
    settings = drawn_strips.StripSettings(pictures=2, samples=1)

    def draw(version):
        return drawn_strips.draw_strips(recipe, 1, tmp_path / "out", version=version, settings=settings, workers=1)

    (first,) = draw("1")
    made = strips.read_strips(first.folder)
    assert first.pictures == len(made) == 2
    views = json.loads((first.folder / "about.json").read_text())["views"]
    layout = generate(recipe.drawn(json.loads((first.folder / "about.json").read_text())["seed"])[0]).layout
    stalls = layout.stalls
    entries = np.array([corner for stall in stalls for corner in stall.corners_m()[:2]])
    labels = strip_labels.read_strip_labels(first.folder)
    every = np.array([stall.corners_m() for stall in stalls])
    is_occupied = layout.cars_in_stalls() >= 0
    slots = 0
    for strip in made:
        # the car is black and at the right edge
        assert strip.pixels[140:160, -2].max() == 0
        assert strip.pixels[:, :80].mean() > 20
        where = views[strip.name]
        matrix, (ahead_m, left_m, _) = np.array(where["vehicle_to_world"]), where["position_m"]
        in_car = (entries - matrix[[0, 2], 3]) @ matrix[[0, 2], :2]
        column = 48 - (in_car[:, 1] - left_m) / where["metres_per_px"]
        row = 150 - (in_car[:, 0] - ahead_m) / where["metres_per_px"]
        column = 96 - column if "_right/" in strip.name else column
        for corner in strip.corners_px:
            assert np.hypot(column - corner[0], row - corner[1]).min() < 0.1
        label = labels[strip.name]
        assert (strip.pixels[~label.is_known] == 0).all()
        assert label.is_free.mean() > 0.2
        in_car = (every - matrix[[0, 2], 3]) @ matrix[[0, 2], :2]
        column = 48 - (in_car[..., 1] - left_m) / where["metres_per_px"]
        row = 150 - (in_car[..., 0] - ahead_m) / where["metres_per_px"]
        places = np.stack([column, row], axis=-1)
        if "_right/" in strip.name:
            places = places[:, [1, 0, 3, 2]] * (-1, 1) + (96, 0)
        for corners, occupied in zip(label.corners_px, label.is_occupied, strict=True):
            apart = np.linalg.norm(places - corners, axis=2).max(axis=1)
            assert apart.min() < 0.1
            assert is_occupied[apart.argmin()] == occupied
            slots += 1
    assert slots
    monkeypatch.setattr(drawn_strips, "Drawing", None)
    assert list(draw("1")) == [first]
    with pytest.raises(TypeError):
        list(draw("2"))
