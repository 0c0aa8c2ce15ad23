"""Slots in the formats of detectors: what COCO's own evaluations and the rules of DMPR-PS say of them."""

import json
import math
from itertools import permutations

import numpy as np
import pytest
from PIL import Image
from pxr import Usd
from support.rays import Rays
from support.sample_files import REPOSITORY
from support.sensor_judges import HAS_SENSOR_JUDGES, run_judge
from support.slot_frames import equidistant, from_above, shot_from

from garage2usd.objects import CLASSES
from garage2usd.reading.labels import read_labels
from garage2usd.sensors.formats.coco import STUFF, CocoImage, coco_keypoints, coco_panoptic, panoptic_segments
from garage2usd.sensors.formats.slot_files import dmpr_ps, slots_document
from garage2usd.sensors.slots import read_slots

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
SIZE = 240, 180
needs_judges = pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason=".venv/sensor_judges is not there")


@pytest.fixture(scope="module")
def garage(builds):
    made = builds(HAND_DRAWN, "usdc", "instanced")
    stage = Usd.Stage.Open(str(made.stage))
    labels = read_labels(stage, made.stage)
    return stage, labels, Rays(stage, labels.ids), read_slots(stage)


@pytest.fixture(scope="module")
def shots(garage):
    _, _, rays, slots = garage
    mouths = [slot.corners_m[:2].mean(axis=0) for slot in slots.slots[::23]]
    outwards = [slot.corners_m[:2].mean(axis=0) - slot.corners_m[2:].mean(axis=0) for slot in slots.slots[::23]]
    eyes = [mouth + out / np.linalg.norm(out) * 3 + (0, 1.2, 0) for mouth, out in zip(mouths, outwards, strict=True)]
    lens = equidistant(SIZE, 190.0)
    return [shot_from(rays, lens, eye, yaw_deg=70.0 * number, pitch_deg=-15) for number, eye in enumerate(eyes)]


@needs_judges
def test_truth_fed_back_to_cocos_evaluations_is_perfect(garage, shots, tmp_path):
    slots = garage[-1]
    frames = [(CocoImage(f"{number}.png", SIZE), slots.seen_in(shot.frame)) for number, shot in enumerate(shots)]
    document = coco_keypoints(frames, description="slots")
    path = tmp_path / "slots.json"
    path.write_text(json.dumps(document))
    said = json.loads(run_judge("coco_judge.py", "keypoints", path, folder=tmp_path))
    assert len(document["annotations"]) > 50
    for judge in ("pycocotools", "faster_coco_eval"):
        assert said.pop(f"{judge} annotations") == len(document["annotations"])
        assert said.pop(f"{judge} masks") < 0.5  # pixels for each one around it
        for kind in ("bbox", "segm", "keypoints"):
            assert said.pop(f"{judge} {kind}") == pytest.approx(1.0, abs=1e-9)
    assert not said


def test_keypoints_are_the_record(garage, shots):
    slots = garage[-1]
    frames = [(CocoImage(f"{number}.png", SIZE), slots.seen_in(shot.frame)) for number, shot in enumerate(shots)]
    document = coco_keypoints(frames, description="slots")
    records = [record for _, found in frames for record in found if area_of(record) >= 16]
    assert [entry["id"] for entry in document["annotations"]] == list(range(1, len(records) + 1))
    categories = {entry["id"]: entry for entry in document["categories"]}
    for entry, record in zip(document["annotations"], records, strict=True):
        points = np.reshape(entry["keypoints"], (4, 3))
        assert points[:, 2].tolist() == list(record.visibility)
        there = points[:, 2] > 0
        assert np.abs(points[there, :2] - record.corners_px[there]).max(initial=0) < 1e-3
        assert (points[~there] == 0).all()
        assert entry["num_keypoints"] == there.sum()
        assert categories[entry["category_id"]]["keypoints"][0] == "entry_left"
        said = entry["attributes"]
        assert (said["number"], said["occupied"]) == (record.slot.stall.number, record.slot.stall.is_occupied)
        takes_cars = said["use"] in {"standard", "ev", "accessible"}
        assert categories[entry["category_id"]]["name"] == ("parking_slot" if takes_cars else "kept_free")
    assert {entry["attributes"]["occupied"] for entry in document["annotations"]} == {True, False}


def test_the_file_of_slots_says_where_each_corner_is(garage, shots):
    slots = garage[-1]
    frames = {str(number): slots.seen_in(shot.frame) for number, shot in enumerate(shots)}
    document = json.loads(json.dumps(slots_document(slots, frames, stage="hand_drawn.usdc"), allow_nan=False))
    about = {entry["name"]: entry for entry in document["slots"]}
    assert len(about) == len(slots.slots)
    count = 0
    for frame, shot in zip(document["frames"], shots, strict=True):
        for entry in frame["slots"]:
            expected = shot.place_of(np.array(about[entry["name"]]["corners_m"]))
            for place, found in zip(entry["corners_px"], expected, strict=True):
                assert (place is None) == (not np.isfinite(found).all())
                assert place is None or np.abs(np.array(place) - found).max() < 2e-3 * max(1, np.abs(found).max() / 1e3)
                count += 1
    assert count > 200


@needs_judges
def test_panoptic_segments_hold_each_labelled_pixel(garage, shots, tmp_path):
    _, labels, rays, _ = garage
    pictures = []
    for number, shot in enumerate(shots[:3]):
        width, height = SIZE
        middles = np.stack(np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5), axis=-1).reshape(-1, 2)
        directions = shot.lens_rays(middles)
        there = np.isfinite(directions).all(axis=1)
        instance = np.zeros(len(middles), dtype=np.int32)
        instance[there] = rays.cast(np.repeat(shot.eye[None], there.sum(), axis=0), directions[there])[0]
        instance = instance.reshape(height, width)
        segments, infos = panoptic_segments(instance, labels)
        digits = np.stack([segments >> shift & 255 for shift in (0, 8, 16)], axis=-1).astype(np.uint8)
        Image.fromarray(digits).save(tmp_path / f"{number}.png")
        pictures.append((CocoImage(f"{number}.jpg", SIZE), f"{number}.png", infos))
        # by the pixels: classes as in the picture of instances, one segment for each thing and each class of stuff
        class_of = np.array([labels.class_ids.get(each, 0) for each in range(max(labels.class_ids) + 1)])
        assert (class_of[segments] == class_of[instance]).all()
        names = {each: labels.classes[class_of[each]].name for each in np.unique(instance[instance > 0]).tolist()}
        things = {each for each, name in names.items() if name not in STUFF}
        stuff = {name for name in names.values() if name in STUFF}
        assert {"floor", "ceiling", "wall"} & stuff
        assert len(infos) == len(things) + len(stuff)
        assert things < {info["id"] for info in infos}
        for info in infos:
            rows, columns = np.nonzero(segments == info["id"])
            assert info["area"] == len(rows)
            left, top, wide, high = info["bbox"]
            assert (left, top) == (columns.min(), rows.min())
            assert (left + wide, top + high) == (columns.max() + 1, rows.max() + 1)
    path = tmp_path / "panoptic.json"
    path.write_text(json.dumps(coco_panoptic(pictures, labels, description="all")))
    said = json.loads(run_judge("coco_judge.py", "panoptic", path, tmp_path, folder=tmp_path))
    for group in ("All", "Things", "Stuff"):
        assert said[group]["pq"] == 1.0
        assert said[group]["n"] > 2


def test_classes_of_stuff_are_classes():
    assert {entry.label for entry in CLASSES} > STUFF


def test_marks_of_dmpr_ps_pair_to_its_slots(garage):
    """By the rules of the paper's section on inference: a slot is on the left of the way between marks that fit."""
    _, _, rays, slots = garage
    total = shapes = 0
    for slot in slots.slots[::17]:
        shot = from_above(rays, slot.corners_m.mean(axis=0), size_px=(600, 600), metres_per_px=1 / 60, turn_deg=0.0)
        label = dmpr_ps(slots.seen_in(shot.frame), slots)
        marks, told = np.array(label["marks"]).reshape(-1, 5), {tuple(entry[:2]) for entry in label["slots"]}
        assert all(entry[2:] == [1, 90] for entry in label["slots"])
        lengths = np.hypot(marks[:, 2] - marks[:, 0], marks[:, 3] - marks[:, 1])
        assert np.abs(lengths - 50).max(initial=0) < 0.01
        for one, other in told:
            # MATLAB's (1, 1) is the middle of the first pixel, whose place is (0.5, 0.5)
            found = [
                record
                for record in slots.seen_in(shot.frame)
                if np.abs(record.corners_px[:2] + 0.5 - marks[[one - 1, other - 1], :2]).max() < 0.01
            ]
            assert len(found) == 1
        width = {
            pair: math.dist(marks[pair[0] - 1, :2], marks[pair[1] - 1, :2])
            for pair in permutations(range(1, len(marks) + 1), 2)
        }
        fitting = {pair for pair in width if 120 < width[pair] < 200 and pairs(marks[pair[0] - 1], marks[pair[1] - 1])}
        assert told <= fitting
        total += len(told)
        shapes += int(marks[:, 4].sum())
    assert total > 20
    assert shapes > 0


def area_of(record):
    rings = [(part, np.roll(part, -1, axis=0)) for part in record.outline_px]
    return sum(abs((one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]).sum()) / 2 for one, two in rings)


def pairs(first, second):
    """Whether marks delimit a slot on the left of the way from the first to the second (rows grow downwards)."""
    way = second[:2] - first[:2]
    way /= np.linalg.norm(way)
    left = np.array([way[1], -way[0]])
    arms = [arms_of(mark) for mark in (first, second)]
    points_in = all(any(arm @ left > 0.9 for arm in mark) for mark in arms)
    across = [any(arm @ along > 0.9 for arm in mark) for mark, along in zip(arms, (way, -way), strict=True)]
    return points_in and all(across)


def arms_of(mark):
    """Directions of a mark's arms: the stem and both ends of a T's bar; an L's and a quarter turn clockwise of it."""
    arm = (mark[2:4] - mark[:2]) / 50
    clockwise = np.array([-arm[1], arm[0]])
    return (arm, clockwise, -clockwise) if mark[4] == 0 else (arm, clockwise)
