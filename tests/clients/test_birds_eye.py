"""Bird's-eye views: their slots by plain arithmetic, and their paint by fisheyes that OpenCV warps onto the ground."""

import importlib.util
import json
import math
from types import SimpleNamespace

import cv2
import numpy as np
import pytest
import shapely
from PIL import Image
from pxr import Usd, UsdGeom, UsdPhysics
from support.rays import Rays
from support.sample_files import REPOSITORY
from support.slot_corners import judge_corners

from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import silent
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.objects.kind import PAINT_CLASSES
from garage2usd.reading.labels import read_labels
from garage2usd.recordings import record
from garage2usd.render.cameras import View
from garage2usd.render.drawing import Drawing
from garage2usd.render.free_views import birds_eye_view, looked_through
from garage2usd.render.pictures import Picture
from garage2usd.render.tables import SlotFormat, SlotLabels, check_slots
from garage2usd.sensors.rays.birds_eye import FREE_CLASSES, BirdsEye
from garage2usd.sensors.rig.rig import read_rig, rig_from_mapping

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
METRES_PER_PX = 0.02
SIZE = 600, 500
FISHEYE_SIZE = 640, 480
MIDDLE_M = 1.1, 0.2
CENTIMETRE = 0.01
PAINTED = [each.label for each in PAINT_CLASSES]
LINE_M = 0.12
"""Width of a line: half of it on each side of the border of two stalls, all of it inside at the rear."""
WITHIN_M, MEDIAN_M = 5.0, 0.02
KINDS = Picture.DEPTH, Picture.INSTANCE, Picture.SEMANTIC
SLOTS = [SlotFormat.DMPR_PS]
CAR_M, STEP_M = 2.0, 0.06
"""Height of the design car, and what is higher over the floor than a speed bump and lower than a kerb."""


def matrix_of(place, heading_deg):
    """From a vehicle's axes (ISO 8855) to a stage with Y up, for a rear axle at `place` that looks from +X to -Z."""
    angle = math.radians(heading_deg)
    ahead, up = np.array([math.cos(angle), 0.0, -math.sin(angle)]), np.array([0.0, 1.0, 0.0])
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([ahead, np.cross(up, ahead), up], axis=1)
    matrix[:3, 3] = place
    return matrix


def stalls_of(stage):
    """Corners of each stall, shape (4, 3), by its name, as its prim has them."""
    return {
        prim.GetAttribute("garage:stall:id").Get(): np.insert(prim.GetAttribute("garage:stall:corners").Get(), 1, 0, 1)
        for prim in stage.Traverse()
        if prim.GetAttribute("garage:stall:corners")
    }


@pytest.fixture(scope="module")
def drawn(builds, tmp_path_factory):
    """Two bird's-eye views, one of them without cars, and the four fisheyes at the first one's place."""
    made = builds(HAND_DRAWN, "usdc", "instanced")
    stage = Usd.Stage.Open(str(made.stage))
    labels = read_labels(stage, made.stage)
    # on the lane before two stalls, along it and askew
    poses = []
    for name, turn_deg in (("Stall_r00_c04_1", 90.0), ("Stall_r02_c03_2", 57.0)):
        left, right, _, rear = stalls_of(stage)[name]
        outwards = (left - rear) / np.linalg.norm(left - rear)
        heading = math.degrees(math.atan2(-outwards[2], outwards[0])) + turn_deg
        poses.append(matrix_of((left + right) / 2 + 2.6 * outwards, heading))
    settings = [
        BirdsEye(metres_per_px=METRES_PER_PX, size_px=SIZE, centre_m=MIDDLE_M),
        BirdsEye(metres_per_px=METRES_PER_PX, size_px=SIZE, centre_m=MIDDLE_M, cars=False),
    ]
    views = [
        birds_eye_view(f"above_{number}", setting, pose)
        for number, (setting, pose) in enumerate(zip(settings, poses, strict=True))
    ]
    hidden = [looked_through(labels, setting) for setting in settings]
    fisheyes = {sensor: sensor.lens.resized(FISHEYE_SIZE) for sensor in read_rig("avp_surround").cameras}
    for sensor, lens in fisheyes.items():
        to_world = poses[0] @ sensor.sensor_to_vehicle @ np.diag([1.0, -1, -1, 1])
        views.append(View(sensor.name, sensor.name, None, lens, FISHEYE_SIZE, to_world))
        hidden.append([])
    folder = tmp_path_factory.mktemp("birds_eye")
    work = tmp_path_factory.mktemp("work")
    Drawing(stage, labels, views, hidden, KINDS, 1, 0, folder).draw(work, silent)
    return SimpleNamespace(
        stage=stage, labels=labels, views=views, poses=poses, settings=settings, fisheyes=fisheyes, folder=folder
    )


def names_of(drawn, view):
    """Name of the class that each pixel shows."""
    names = {number: entry.name for number, entry in drawn.labels.classes.items()} | {0: ""}
    picture = np.asarray(Image.open(drawn.folder / "semantic" / f"{view}.png"))
    return np.array([names.get(number, "") for number in range(256)])[picture]


def arithmetic(points, pose):
    """Pixels of points of the stage: so many metres ahead and to the left of the middle, by the length of a pixel."""
    ahead, left, _, _ = np.linalg.inv(pose) @ np.append(points, np.ones((len(points), 1)), axis=1).T
    return np.stack(
        [SIZE[0] / 2 - (left - MIDDLE_M[1]) / METRES_PER_PX, SIZE[1] / 2 - (ahead - MIDDLE_M[0]) / METRES_PER_PX],
        axis=1,
    )


@pytest.mark.soak
def test_corners_lie_where_arithmetic_has_them(drawn):
    views = drawn.views[:2]
    files = SlotLabels(drawn.stage, drawn.labels, views, drawn.folder).write([SlotFormat.COCO, SlotFormat.DMPR_PS])
    assert [file.name for file in files] == ["slots.json", "slots_coco.json", "dmpr_ps"]
    stalls = stalls_of(drawn.stage)
    document = json.loads((drawn.folder / "slots.json").read_text())
    assert [frame["name"] for frame in document["frames"]] == ["above_0", "above_1"]
    seen = 0
    for frame, pose in zip(document["frames"], drawn.poses, strict=True):
        assert len(frame["slots"]) > 5
        for entry in frame["slots"]:
            places = arithmetic(stalls[entry["name"]], pose)
            assert np.abs(np.array(entry["corners_px"]) - places).max() * METRES_PER_PX < CENTIMETRE
            inside = ((places >= 0) & (places < SIZE)).all(axis=1)
            assert (np.array(entry["visibility"]) > 0).tolist() == inside.tolist()
            seen += entry["visibility"].count(2)
        marks = json.loads((drawn.folder / "dmpr_ps" / f"{frame['name']}.json").read_text())
        assert marks["slots"]
    assert seen > 20


@pytest.mark.soak
def test_the_middle_of_a_pixel_shows_what_lies_below_it(drawn):
    """Stall lines lie on the borders of stalls: what is painted there is within their width of an outline."""
    for number, pose in enumerate(drawn.poses):
        rows, columns = np.nonzero(names_of(drawn, f"above_{number}") == "stall_line")
        assert len(rows) > 1000
        outlines = [arithmetic(corners, pose) for corners in stalls_of(drawn.stage).values()]
        points, nearest = np.stack([columns, rows], axis=1) + 0.5, np.full(len(rows), np.inf)
        for outline in outlines:
            for start, end in zip(outline, np.roll(outline, -1, axis=0), strict=True):
                along = np.clip((points - start) @ (end - start) / ((end - start) @ (end - start)), 0, 1)
                nearest = np.minimum(nearest, np.linalg.norm(points - start - along[:, None] * (end - start), axis=1))
        assert nearest.max() * METRES_PER_PX < LINE_M + CENTIMETRE


@pytest.mark.soak
def test_cars_and_what_hangs_overhead_are_looked_through(drawn):
    with_cars, without = (set(names_of(drawn, f"above_{number}").ravel().tolist()) for number in (0, 1))
    overhead = {"ceiling", "light", "duct", "beam", "sprinkler", "cable_tray"}
    assert not (with_cars | without) & overhead
    assert "car" in with_cars
    assert "car" not in without
    assert {"floor", "stall_line", "column"} <= with_cars & without


@pytest.mark.soak
def test_fisheyes_that_opencv_warps_onto_the_ground_agree(drawn):
    width, height = SIZE
    columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    ahead = MIDDLE_M[0] + (height / 2 - rows) * METRES_PER_PX
    left = MIDDLE_M[1] + (width / 2 - columns) * METRES_PER_PX
    ground = np.stack([ahead, left, np.zeros_like(ahead)], axis=-1).reshape(-1, 3)
    warped, best = np.full(len(ground), "", dtype="U32"), np.full(len(ground), 75.0)
    for sensor, lens in drawn.fisheyes.items():
        to_camera = np.linalg.inv(sensor.sensor_to_vehicle)
        turn, _ = cv2.Rodrigues(to_camera[:3, :3])
        focal, (cx, cy) = np.diag([*lens.focal_px, 1.0]), lens.centre_px
        focal[:2, 2] = cx - 0.5, cy - 0.5  # OpenCV counts from the middle of the first pixel
        places, _ = cv2.fisheye.projectPoints(ground[None], turn, to_camera[:3, 3], focal, np.array(lens.coefficients))
        in_camera = ground @ to_camera[:3, :3].T + to_camera[:3, 3]
        angle = np.degrees(np.arccos(in_camera[:, 2] / np.linalg.norm(in_camera, axis=1)))
        chosen = angle < best  # of the four the one that looks most directly at it
        best[chosen] = angle[chosen]
        shown = np.arange(256, dtype=np.uint8)  # class ids, sampled where the place falls
        picture = np.asarray(Image.open(drawn.folder / "semantic" / f"{sensor.name}.png"))
        x, y = places[0].T.astype(np.float32).reshape(2, height, width)
        sampled = cv2.remap(shown[picture], x, y, cv2.INTER_NEAREST, borderValue=0).ravel()
        names = np.array([drawn.labels.classes[n].name if n in drawn.labels.classes else "" for n in range(256)])
        warped[chosen] = names[sampled[chosen]]
    warped, straight = warped.reshape(height, width), names_of(drawn, "above_0")
    near = np.hypot(ahead, left) <= WITHIN_M
    # what stands up covers more ground in the fisheyes than it stands on
    on_floor = np.isin(warped, list(FREE_CLASSES)) & np.isin(straight, list(FREE_CLASSES)) & near
    on_floor = cv2.erode(on_floor.astype(np.uint8), np.ones((7, 7))) > 0
    assert on_floor.sum() > 0.3 * near.sum()
    edges = [edges_of(np.isin(each, PAINTED)) for each in (warped, straight)]
    from_straight = cv2.distanceTransform((~edges[1]).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    from_warped = cv2.distanceTransform((~edges[0]).astype(np.uint8), cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    there, back = from_straight[edges[0] & on_floor], from_warped[edges[1] & on_floor]
    assert min(len(there), len(back)) > 500
    assert np.median(there) * METRES_PER_PX <= MEDIAN_M
    assert np.median(back) * METRES_PER_PX <= MEDIAN_M


def edges_of(mask):
    """Pixels of a mask with a neighbour that is not in it."""
    return mask & (cv2.erode(mask.astype(np.uint8), np.ones((3, 3))) == 0)


@pytest.fixture(scope="module")
def above(builds, tmp_path_factory):
    """A recording from the top of a ramp to a stall that is taken, with views from above that show no cars."""
    made = builds(HAND_DRAWN, "usdc", "instanced")
    stalls = {entry["name"]: entry for entry in json.loads(made.report.read_text())["levels"][0]["stalls"]}
    goal = next(name for name, entry in stalls.items() if entry["occupied"] and entry["use"] == "standard")
    settings = BirdsEye(metres_per_px=0.05, size_px=(240, 200), centre_m=MIDDLE_M, cars=False)
    camera = {"kind": "pinhole", "name": "ahead", "position_m": [3, 0, 1], "size_px": [32, 24], "focal_px": [20, 20]}
    folder, rig = tmp_path_factory.mktemp("above") / "drive", rig_from_mapping({"name": "one", "sensors": [camera]})
    asked = {"rig": rig, "along": f"1:{goal}", "every_m": 12.0}
    record(made.stage, folder, **asked, pictures=[Picture.SEMANTIC, Picture.DEPTH], slots=SLOTS, birds_eye=settings)
    table = json.loads((folder / "frames.json").read_text())
    names = {entry["id"]: entry["name"] for entry in table["classes"]}
    stage = Usd.Stage.Open(str(made.stage))
    cars = [hull_of(prim) for prim in stage.Traverse() if prim.GetName().startswith("Car_")]
    assert len(cars) == sum(entry["occupied"] for entry in stalls.values())
    home = shapely.Point(stalls[goal]["centre_m"])
    frames = [frame for frame in table["frames"] if frame["sensor"] == "birds_eye"]
    return SimpleNamespace(
        made=made,
        stage=stage,
        folder=folder,
        table=table,
        frames=frames,
        rig=rig,
        goal=goal,
        parked=shapely.union_all([car for car in cars if car.distance(home) > 0]),
        free={frame["name"]: np.asarray(Image.open(folder / frame["free_space"])) > 0 for frame in frames},
        shown={
            frame["name"]: np.array([names.get(number, "") for number in range(256)])[
                np.asarray(Image.open(folder / frame["files"]["semantic"]))
            ]
            for frame in frames
        },
    )


def test_a_recording_has_views_from_above_with_masks(above):
    frames, folder = above.frames, above.folder
    assert [frame["name"] for frame in frames] == [f"birds_eye_{number:04d}" for number in range(len(frames))]
    assert len(frames) == len(above.table["frames"]) / 2 > 2
    # the hatchback that the rig's car is, by the catalogue's measures: its ground and its mirrors
    ego = np.asarray(Image.open(folder / frames[0]["ego_mask"])) > 0
    rows, columns = np.nonzero(ego)
    body = next(each for each in CAR_BODIES if each.name == above.rig.car)
    assert (np.ptp(rows) + 1) * 0.05 == pytest.approx(body.length_m, abs=0.06)
    assert (np.ptp(columns) + 1) * 0.05 == pytest.approx(body.overall_width_m, abs=0.06)
    nose_m = body.wheelbase_m + body.front_overhang_m
    assert rows.min() == pytest.approx(100 - (nose_m - MIDDLE_M[0]) / 0.05, abs=1)
    for frame in frames:
        assert frame["metres_per_px"] == 0.05
        assert {"car", "ceiling", "light"} <= set(frame["hidden_classes"])
        assert "car" not in above.shown[frame["name"]]
        assert set(frame["files"]) == {"semantic", "depth"}
    # what slots and free space are told from is drawn, and published only where it is asked for
    assert sorted(path.name for path in folder.iterdir() if path.is_dir()) == sorted(
        ["calibration", "depth", "dmpr_ps", "ego", "free_space", "semantic"]
    )
    labels = json.loads((folder / "slots.json").read_text())
    assert next(slot for slot in labels["slots"] if slot["name"] == above.goal)["occupied"] is False
    assert len(list((folder / "dmpr_ps").iterdir())) == len(frames)


@pytest.mark.soak
def test_free_is_where_a_car_finds_its_height_over_floors_and_ramps(above):
    """Rays through the meshes, to the floor and up from it, without what garage2usd knows of the heights of ramps."""
    labels = read_labels(above.stage, above.made.stage)
    left_out = above.frames[0]["hidden_objects"]
    names = {path: labels.classes[labels.class_ids[number]].name for path, number in labels.ids.items()}
    ramps = [path for path, name in names.items() if name == "ramp"]
    driven = [f"{ramp}/Geom/{part}" for ramp in ramps for part in ("Floor", "Threshold")]
    level = [path for path, name in names.items() if name in {"floor", "parking_stall"}]
    floors = Rays(above.stage, dict.fromkeys(level, 1) | dict.fromkeys(driven, 2))
    gone = {path for path, name in names.items() if name in {"sky", "floor_stain"}} | set(labels.with_plates(left_out))
    solids = Rays(above.stage, {path: number for path, number in labels.ids.items() if path not in gone})
    under_cars = on_ramps = 0
    for frame in above.frames:
        free, shown, to_world = (
            above.free[frame["name"]],
            above.shown[frame["name"]],
            np.array(frame["vehicle_to_world"]),
        )
        assert "sky" not in shown
        down, right = np.mgrid[:200, :240] + 0.5
        ahead, left = MIDDLE_M[0] + (100 - down) * 0.05, MIDDLE_M[1] + (120 - right) * 0.05
        eyes = np.stack([ahead, left, np.full_like(ahead, 20.0), np.ones_like(ahead)], axis=-1).reshape(-1, 4)
        owner, place, _ = floors.cast((eyes @ to_world.T)[:, :3], np.tile(-to_world[:3, 2], (len(eyes), 1)))
        lies_on = owner > 0
        blocked_m = np.zeros(len(eyes))
        begins = place[lies_on] + (0.0, STEP_M, 0.0)
        _, met, _ = solids.cast(begins, np.tile([0.0, 1.0, 0.0], (len(begins), 1)))
        blocked_m[lies_on] = met[:, 1] - begins[:, 1]
        is_clear = (blocked_m > CAR_M - STEP_M).reshape(free.shape)
        x, z = np.nan_to_num(place[:, [0, 2]], posinf=1e6).T
        is_parked = shapely.contains_xy(above.parked, x, z).reshape(free.shape)
        near = shapely.dwithin(shapely.points(x, z), above.parked.boundary, 0.05).reshape(free.shape)
        expected = is_clear & ~is_parked
        sure = ~near & ~edges_around(expected) & ~edges_around(is_parked)
        is_level = to_world[1, 2] > 1 - 1e-9
        if not is_level:  # walls lean into the view, and what they hide is not seen to be free
            sure &= ~(expected & ~np.isin(shown, [*FREE_CLASSES, "sky", "barrier"]))
        assert sure.mean() > 0.8
        # now and then a ray passes between two meshes
        assert ((free != expected) & sure).mean() < 1e-4, frame["name"]
        on_ramps += (free & (owner == 2).reshape(free.shape)).sum()
        under_cars += (is_parked & np.isin(shown, [*FREE_CLASSES])).sum()
    assert under_cars > 1000
    assert on_ramps > 30_000
    assert sum(np.array(frame["vehicle_to_world"])[1, 2] < 0.999 for frame in above.frames) >= 2


def edges_around(mask):
    """Pixels beside the edge of a mask, on both sides."""
    wide = np.ones((3, 3), np.uint8)
    return cv2.dilate(mask.astype(np.uint8), wide) != cv2.erode(mask.astype(np.uint8), wide)


def test_corners_that_are_seen_show_the_floor_or_its_paint_from_above(above):
    judge_corners(above.folder, above.table)


def test_recordings_that_cannot_have_views_from_above_are_refused(above, tmp_path):
    stage = above.made.stage
    asked = {"rig": "avp_surround", "along": "1:A1-01", "birds_eye": BirdsEye()}
    with pytest.raises(ConfigError, match="semantic or instance among them"):
        record(stage, tmp_path, **asked, pictures=[Picture.DEPTH])
    lidar = {"kind": "spinning_lidar", "name": "top", "position_m": [1, 0, 2], "range_m": [0.5, 50]}
    lidar |= {"elevations_deg": [0.0], "azimuth_steps": 8}
    with pytest.raises(ConfigError, match="a rig with cameras"):
        record(stage, tmp_path, **{**asked, "rig": rig_from_mapping({"name": "l", "sensors": [lidar]})})


def hull_of(prim):
    """Convex ground of what can be touched below a prim, which mirrors cannot."""
    places, found = UsdGeom.XformCache(), []
    for each in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()):
        if each.HasAPI(UsdPhysics.CollisionAPI):
            points = np.array(UsdGeom.Mesh(each).GetPointsAttr().Get())
            place = np.array(places.GetLocalToWorldTransform(each))
            found.append((points @ place[:3, :3] + place[3, :3])[:, [0, 2]])
    return shapely.MultiPoint(np.concatenate(found)).convex_hull


def test_slots_are_refused_where_they_cannot_be_told():
    with pytest.raises(ConfigError, match="slots"):
        check_slots([SlotFormat.DMPR_PS], KINDS, has_ground_view=False)
    with pytest.raises(ConfigError, match="depth among them"):
        check_slots([SlotFormat.JSON], [Picture.COLOUR], has_ground_view=True)
    with pytest.raises(ConfigError, match="instance among them"):
        check_slots([SlotFormat.PANOPTIC], [Picture.DEPTH], has_ground_view=True)
    check_slots(list(SlotFormat), KINDS, has_ground_view=True)
