"""What ``render`` draws agrees with the table of labels, with rays through the meshes, and with itself."""

import importlib.util
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image
from pxr import Usd
from support.label_tables import cars_of_plates, labelled_objects
from support.rays import Rays
from support.sample_files import REPOSITORY
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.objects.kind import PAINT_CLASSES
from garage2usd.render import Device, Picture, render_stage

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SIZE = 160, 90
HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
MILLIMETRE = 0.001
# Where flat sheets lie on each other, or tiles meet in a pixel's very middle, two renderers may choose differently.
MOST_STRAY_PIXELS = 0.002


@pytest.fixture(scope="module")
def data_set(builds, tmp_path_factory):
    """The frames of a form of a sample, with their pictures as arrays; colour for the instanced form alone."""
    made = {}

    def frames(form):
        if form not in made:
            built = builds(HAND_DRAWN, "usdc", form)
            stage = built.stage
            folder = tmp_path_factory.mktemp(f"render_{form}")
            kinds = tuple(Picture) if form == "instanced" else tuple(set(Picture) - {Picture.COLOUR})
            cameras = {"cameras": ("Inside", "Drive"), "frames": "96"}
            if form == "instanced":
                cameras["cameras"] += ("Above",)
            render_stage(stage, folder, size_px=SIZE, samples=4, pictures=kinds, **cameras)
            table = json.loads((folder / "frames.json").read_text())
            made[form] = SimpleNamespace(
                table=table,
                frames=[read_frame(folder, frame) for frame in table["frames"]],
                labels=json.loads(built.labels.read_text()),
                objects=labelled_objects(built.labels),
                car_of=cars_of_plates(built.labels),
                stage=stage,
                folder=folder,
            )
        return made[form]

    return frames


def read_frame(folder, frame):
    """A frame with its pictures, by the conventions of ``frames.json`` alone."""
    import OpenEXR

    files = {kind: folder / name for kind, name in frame["files"].items()}
    with OpenEXR.File(str(files["depth"]), separate_channels=True) as file:
        depth = np.array(file.channels()["Z"].pixels)
    with OpenEXR.File(str(files["normals"]), separate_channels=True) as file:
        normal = np.stack([file.channels()[axis].pixels for axis in "XYZ"], axis=-1)
    assert depth.dtype == np.float32
    digits = np.asarray(Image.open(files["instance"])).astype(int)
    rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
    middles = np.stack([columns + 0.5, rows + 0.5, np.ones_like(rows)], axis=-1)
    to_world = np.linalg.inv(frame["world_to_camera"])
    direction = middles @ np.linalg.inv(frame["intrinsics"]).T @ to_world[:3, :3].T  # for each metre of depth
    return SimpleNamespace(
        about=frame,
        depth=depth,
        normal=normal,
        instance=digits @ [1, 256, 65536],
        semantic=np.asarray(Image.open(files["semantic"])),
        preview=np.asarray(Image.open(files["semantic_preview"])),
        colour=np.asarray(Image.open(files["colour"])).astype(float) if "colour" in files else None,
        eye=to_world[:3, 3],
        direction=direction,
    )


def test_signs_that_blender_reads_in_paths_are_signs_of_names(tmp_path, monkeypatch):
    built = build(GarageConfig(**SETTINGS), tmp_path / "small" / "small.usdz")
    folder = tmp_path / "s#{b}[1]@"
    temporary = tmp_path / "t#{b}[1]@"
    temporary.mkdir()
    shutil.copytree(built.stage.parent, folder)
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    how = {"cameras": ("Inside",), "size_px": (48, 27), "samples": 1, "pictures": (Picture.COLOUR, Picture.INSTANCE)}
    made = render_stage(folder / built.stage.name, tmp_path / "o#{b}[1]@", **how)
    monkeypatch.undo()
    plain = render_stage(built.stage, tmp_path / "plain", **how)
    for kind in how["pictures"]:
        (picture,) = (made.folder / kind).iterdir()
        assert picture.read_bytes() == (plain.folder / kind / picture.name).read_bytes()
    assert not list(temporary.iterdir())


def test_few_rays_draw_what_the_path_tracer_draws(data_set, tmp_path):
    made = data_set("instanced")
    wanted = {frame.about["name"]: frame for frame in made.frames}
    how = {"cameras": ("Inside", "Drive"), "frames": "96", "size_px": SIZE, "samples": 4, "device": Device.RAYS}
    by_rays = render_stage(made.stage, tmp_path, pictures=tuple(Picture), **how)
    for entry in json.loads(by_rays.frames.read_text())["frames"]:
        drawn, traced = read_frame(tmp_path, entry), wanted[entry["name"]]
        same = drawn.instance == traced.instance
        assert same.mean() > 1 - 10 * MOST_STRAY_PIXELS  # edges between objects, in single precision
        assert (drawn.semantic == traced.semantic).mean() > 1 - 10 * MOST_STRAY_PIXELS
        seen = same & np.isfinite(traced.depth)
        apart_m = np.abs(drawn.depth - traced.depth)[seen]
        assert np.quantile(apart_m / traced.depth[seen], 0.99) < MILLIMETRE
        assert np.quantile((drawn.normal * traced.normal).sum(axis=-1)[seen], 0.02) > 0.999
        for channel in range(3):
            one, other = (
                each.colour[..., channel].reshape(SIZE[1] // 10, 10, SIZE[0] // 10, 10).mean(axis=(1, 3))
                for each in (drawn, traced)
            )
            assert one.mean() == pytest.approx(other.mean(), rel=0.15)
            assert np.corrcoef(one.ravel(), other.ravel())[0, 1] > 0.8  # without the longest streaks of lamps


@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested"]))
def test_each_pixel_lies_in_the_box_of_its_instance(data_set, form):
    made = data_set(form)
    boxes = {entry["id"]: (entry["min_m"], entry["max_m"]) for entry in made.objects}
    assert len(made.frames) == {"instanced": 3, "nested": 2}[form]
    for frame in made.frames:
        seen = frame.instance > 0
        assert seen.mean() > 0.2
        assert (np.isfinite(frame.depth) == seen).mean() > 1 - MOST_STRAY_PIXELS
        place = frame.eye + frame.direction[seen] * frame.depth[seen][:, None]
        low, high = (np.array([boxes[number][end] for number in frame.instance[seen].tolist()]) for end in (0, 1))
        outside = np.maximum(low - place, place - high).max(axis=1)
        assert outside.max() < MILLIMETRE + 2e-5 * frame.depth[seen].max()


@pytest.mark.parametrize("form", soak_but(1, ["instanced", "nested"]))
def test_classes_are_those_of_the_table(data_set, form):
    made = data_set(form)
    class_ids = {entry["name"]: entry["id"] for entry in made.labels["classes"]}
    class_of = {entry["id"]: class_ids[entry["class"]] for entry in made.objects} | {0: 0}
    colours = {entry["id"]: entry["colour"] for entry in made.table["classes"]} | {0: [0, 0, 0]}
    assert {entry["name"]: entry["id"] for entry in made.table["classes"]} == class_ids
    assert len({tuple(colour) for colour in colours.values()}) == len(colours)
    for frame in made.frames:
        expected = np.vectorize(class_of.get)(frame.instance)
        plates = frame.semantic == class_ids["number_plate"]
        assert np.isin(frame.instance[plates], list(made.car_of.values())).all()
        assert (frame.semantic == expected)[~plates].all()
        expected = [[colours[number] for number in row] for row in frame.semantic.tolist()]
        assert (frame.preview == np.array(expected)).all()


@pytest.mark.soak
@pytest.mark.parametrize("name", ["hand_drawn", "irregular", "paper_7x9"])
def test_what_is_painted_has_classes_of_its_own_and_no_pixel_is_lost(builds, name, tmp_path):
    built = builds(REPOSITORY / "samples" / f"{name}.toml", "usdc")
    kinds = Picture.INSTANCE, Picture.SEMANTIC
    render_stage(built.stage, tmp_path, cameras=("Inside", "Above"), size_px=(640, 360), pictures=kinds)
    table = json.loads((tmp_path / "frames.json").read_text())
    objects = {entry["id"]: entry for entry in labelled_objects(built.labels)}
    names, seen = {entry["id"]: entry["name"] for entry in table["classes"]}, Counter()
    for frame in table["frames"]:
        semantic = np.asarray(Image.open(tmp_path / frame["files"]["semantic"]))
        counts = dict(zip(*(each.tolist() for each in np.unique(semantic, return_counts=True)), strict=True))
        nothing = counts.pop(0, 0)
        listed = Counter()
        for entry in frame["instances"]:
            listed[entry["class"]] += entry["pixels"]
            assert objects[entry["id"]]["class"] == entry["class"]
        for entry in frame["number_plates"]:
            assert objects[entry["id"]]["class"] == "car"
            listed["car"] -= entry["pixels"]
            listed["number_plate"] += entry["pixels"]
        assert {names[number]: count for number, count in counts.items()} == dict(+listed)
        assert nothing + sum(listed.values()) == semantic.size
        seen += listed
    assert seen.keys() >= {"floor", "parking_stall", "stall_line", "lane_line", "lane_arrow", "hatching", "crossing"}
    # paint is thin, and the floor that it is painted on is still most of it
    painted = sum(seen[each.label] for each in PAINT_CLASSES)
    assert 0.01 < painted / (painted + seen["floor"] + seen["parking_stall"]) < 0.4


def test_normals_face_the_camera(data_set):
    for frame in data_set("instanced").frames:
        seen = frame.instance > 0
        assert np.linalg.norm(frame.normal[seen], axis=1) == pytest.approx(1.0, abs=1e-4)
        assert not frame.normal[~np.isfinite(frame.depth)].any()
        towards = -(frame.normal * frame.direction).sum(axis=-1) / np.linalg.norm(frame.direction, axis=-1)
        assert towards[seen].min() > -1e-3


def test_frames_list_what_can_be_seen(data_set):
    made = data_set("instanced")
    objects = {entry["id"]: entry for entry in made.objects}
    for frame in made.frames:
        listed = {entry["id"]: entry for entry in frame.about["instances"]}
        assert listed.keys() == set(np.unique(frame.instance).tolist()) - {0}
        for number, entry in listed.items():
            rows, columns = np.nonzero(frame.instance == number)
            assert entry["pixels"] == len(rows)
            box = columns.min(), rows.min(), columns.max() + 1, rows.max() + 1
            assert tuple(entry["box_px"]) == box
            assert (entry["path"], entry["class"]) == (objects[number]["path"], objects[number]["class"])
    inside, drive, above = made.frames
    assert [frame.about["frame"] for frame in made.frames] == [None, 96.0, None]
    assert sum(entry["class"] == "car" for entry in inside.about["instances"]) > 5
    assert not np.allclose(inside.eye, drive.eye)
    hidden = {"ceiling", "beam", "duct", "cable_tray", "sprinkler", "exit_sign", "lane_sign", "fire_shutter"}
    assert set(above.about["hidden_classes"]) == hidden
    assert not hidden & {entry["class"] for entry in above.about["instances"]}
    assert inside.about["hidden_classes"] == []
    parked = sum(entry["class"] == "car" for entry in made.objects)
    assert sum(entry["class"] == "car" for entry in above.about["instances"]) == parked


@pytest.mark.soak
def test_rays_through_the_meshes_meet_the_same(data_set):
    """Depth to a tenth of a millimetre and 1e-5 of it, the instance, and of what is flat the normal."""
    made = data_set("instanced")
    classes = {entry["id"]: entry["class"] for entry in made.objects}
    stage = Usd.Stage.Open(str(made.stage))
    stains = next(entry["id"] for entry in made.table["classes"] if entry["name"] == "floor_stain")
    flat = {"floor", "ceiling", "wall", "beam", "column", "parking_stall", "duct", "zone_plate", "obstacle", "ramp"}
    compared, rays = 0, {}
    for frame in made.frames:
        hidden = frozenset({"floor_stain", *frame.about["hidden_classes"]})
        if hidden not in rays:
            solid = [entry for entry in made.objects if entry["class"] not in hidden]
            ids = {entry["path"]: made.car_of.get(entry["id"], entry["id"]) for entry in solid}
            rays[hidden] = Rays(stage, ids)
        whole = frame.semantic != stains  # whose texture says where they are
        directions = frame.direction[whole]
        owner, place, normal = rays[hidden].cast(np.broadcast_to(frame.eye, directions.shape), directions)
        same = owner == frame.instance[whole]
        assert (~same).mean() < MOST_STRAY_PIXELS
        met = same & (owner > 0)
        depth = frame.depth[whole][met]
        along = np.array(frame.about["world_to_camera"])[2]
        error = np.abs(place[met] @ along[:3] + along[3] - depth)
        assert (error < 1e-4 + 1e-5 * depth).mean() > 1 - MOST_STRAY_PIXELS
        is_flat = np.array([classes[number] in flat for number in owner[met].tolist()])
        cosine = (normal[met] * frame.normal[whole][met]).sum(axis=1)[is_flat]
        assert (np.abs(cosine) > 0.999).mean() > 1 - 5 * MOST_STRAY_PIXELS
        compared += len(depth)
    assert compared > SIZE[0] * SIZE[1]


def test_colours_fit_the_masks_where_they_lie(data_set):
    """Colours vary least within the instances when the mask is not moved."""
    for frame in data_set("instanced").frames:
        grey = frame.colour.mean(axis=-1)

        def variance_within(mask, grey=grey):
            core = grey[4:-4, 4:-4].ravel(), mask[4:-4, 4:-4].ravel()
            _, which = np.unique(core[1], return_inverse=True)
            means = np.bincount(which, core[0]) / np.bincount(which)
            return ((core[0] - means[which]) ** 2).mean()

        here = variance_within(frame.instance)
        moved = [
            variance_within(np.roll(frame.instance, (down, right), axis=(0, 1)))
            for down, right in ((0, 2), (0, -2), (2, 0), (-2, 0), (3, 3), (-3, -3))
        ]
        assert here < min(moved)


@pytest.mark.soak
def test_ids_of_more_than_fifteen_bits_stay_exact_and_all_else_the_same_bytes(data_set, tmp_path):
    made = data_set("instanced")
    shutil.copytree(made.stage.parent, tmp_path / "stage")
    stage = tmp_path / "stage" / made.stage.name
    objects = {
        parent: [[name, number * 4093, *rest] for name, number, *rest in rows]
        for parent, rows in made.labels["objects"].items()
    }
    parked = [[number * 4093 for number in pair] for pair in made.labels["parked"]]
    plates = [[plates * 4093, car * 4093, text] for plates, car, text in made.labels["number_plates"]]
    table = {**made.labels, "objects": objects, "parked": parked, "number_plates": plates}
    stage.with_name(f"{stage.stem}_labels.json").write_text(json.dumps(table))
    assert 2**15 < max(row[1] for rows in objects.values() for row in rows) < 2**24
    kinds = [Picture.COLOUR, Picture.DEPTH, Picture.INSTANCE]
    render_stage(stage, tmp_path / "out", size_px=SIZE, cameras=("Inside",), samples=4, pictures=kinds)
    digits = np.asarray(Image.open(tmp_path / "out" / "instance" / "Inside.png")).astype(int)
    assert (digits @ [1, 256, 65536] == made.frames[0].instance * 4093).all()
    for name in ("colour/Inside.png", "depth/Inside.exr"):
        assert (tmp_path / "out" / name).read_bytes() == (made.folder / name).read_bytes()


def test_a_kill_in_mid_render_leaves_no_file_and_no_blender(tmp_path):
    stage = build(GarageConfig(**SETTINGS), tmp_path / "small" / "small.usdc").stage
    out, temporary = tmp_path / "out", tmp_path / "tmp"
    temporary.mkdir()
    command = [sys.executable, "-m", "garage2usd", "render", str(stage), "-o", str(out), "--samples", "4096"]
    process = subprocess.Popen(
        command, env={**os.environ, "TMPDIR": str(temporary)}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )
    deadline = time.monotonic() + 120
    while not (blender := [child for child in descendants(process.pid) if "blender.py" in command_line(child)]):
        assert time.monotonic() < deadline
        time.sleep(0.1)
    time.sleep(2.0)
    found = descendants(process.pid)
    assert set(blender) <= set(found)
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=60) == 128 + signal.SIGTERM
    assert not any("garage2usd" in command_line(child) for child in found)
    assert list(temporary.iterdir()) == []
    assert not out.exists()


def descendants(parent):
    try:
        with open(f"/proc/{parent}/task/{parent}/children") as file:
            children = file.read().split()
    except FileNotFoundError:  # it has ended
        return []
    return [*children, *(inner for child in children for inner in descendants(child))]


def command_line(process):
    try:
        with open(f"/proc/{process}/cmdline") as file:
            return file.read()
    except FileNotFoundError:
        return ""
