"""Slots in frames: against the attributes of the stalls' prims and against rays, both without garage2usd."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from pxr import Usd, UsdGeom
from support.held_stage import held_aloft
from support.rays import Rays
from support.sample_files import REPOSITORY
from support.slot_frames import equidistant, pinhole, shot_from
from support.soak import soak_but

from garage2usd.common.errors import StageError
from garage2usd.reading.labels import read_labels
from garage2usd.sensors.rays.sight import outline_in_picture
from garage2usd.sensors.rig.rig import read_rig
from garage2usd.sensors.slots import CORNERS, read_slots

HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
MIXED = REPOSITORY / "samples" / "mixed_stalls.toml"
SIZE = 240, 180
HALF_A_PIXEL = 0.5
LEAST_CORNERS = 500
MOST_STRAYS = 0.001


@pytest.fixture(scope="module", params=soak_but([MIXED], [HAND_DRAWN, MIXED]), ids=lambda path: path.stem)
def stage(builds, request):
    return Usd.Stage.Open(str(builds(request.param, "usdc", "instanced").stage))


@pytest.fixture(scope="module")
def rays(stage):
    return Rays(stage, read_labels(stage, REPOSITORY / "none.usdc").ids)


@pytest.fixture(scope="module")
def stalls(stage):
    """Corners (x, z) of each stall, by its name, as its prim has them."""
    found = {}
    for prim in stage.Traverse():
        name = prim.GetAttribute("garage:stall:id")
        if name and prim.GetAttribute("garage:stall:corners"):
            found[name.Get()] = np.array(prim.GetAttribute("garage:stall:corners").Get()), prim
    assert len(found) > 50
    return found


@pytest.fixture(scope="module")
def shots(stage, rays):
    """Frames from lane squares to all sides, by a pinhole and by a fisheye that sees what is beside the camera."""
    nodes = UsdGeom.BasisCurves(stage.GetPrimAtPath("/Garage/LaneGraph/Nodes"))
    rings = np.array(nodes.GetPointsAttr().Get()).reshape(len(nodes.GetCurveVertexCountsAttr().Get()), -1, 3)
    eyes = rings.mean(axis=1)[::3] * (1, 0, 1) + (0.3, 1.1, 0.2)
    lenses = pinhole(SIZE, 90.0), equidistant(SIZE, 190.0)
    return [
        shot_from(rays, lens, eye, yaw_deg=yaw, pitch_deg=-12.0)
        for number, eye in enumerate(eyes)
        for lens, yaw in ((lenses[0], 90.0 * number), (lenses[1], 90.0 * number + 45.0))
    ]


def test_what_a_slot_is_agrees_with_its_prim(stage, stalls):
    slots = read_slots(stage)
    assert {slot.stall.name for slot in slots.slots} == stalls.keys()
    for slot in slots.slots:
        corners, prim = stalls[slot.stall.name]
        assert np.abs(slot.corners_m[:, [0, 2]] - corners).max() < 1e-4
        assert np.abs(slot.corners_m[:, 1]).max() < 1e-6  # on the floor
        assert slot.stall.use == prim.GetAttribute("garage:stall:use").Get()
        assert str(slot.stall.number) == prim.GetAttribute("garage:stall:number").Get()
        assert slot.stall.is_occupied is bool(prim.GetAttribute("garage:stall:occupied").Get())
        told = prim.GetAttribute("garage:stall:kind")
        assert slot.stall.kind == (told.Get() if told else "perpendicular")
        # signed: acute where the sides lean to the right of a driver who enters
        (right_x, right_z), (in_x, in_z) = corners[1] - corners[0], corners[3] - corners[0]
        turn = math.atan2(right_z * in_x - right_x * in_z, right_x * in_x + right_z * in_z)
        assert slot.facts["angle_deg"] == pytest.approx(math.degrees(turn), abs=0.01)
        # a driver who enters looks from the entry to the rear and has the right corners on the right
        inwards = corners[3] - corners[0]
        right = np.array([-inwards[1], inwards[0]])
        assert (corners[1] - corners[0]) @ right > 0
        assert (corners[2] - corners[3]) @ right > 0
    assert CORNERS == ("entry_left", "entry_right", "rear_right", "rear_left")


def test_corners_are_where_the_lens_sees_them(stage, stalls, shots):
    slots, compared = read_slots(stage), 0
    for shot in shots:
        for record in slots.seen_in(shot.frame):
            corners = np.insert(stalls[record.slot.stall.name][0], 1, 0.0, axis=1)
            expected = shot.place_of(corners)  # one by one, by trigonometry
            finite = np.isfinite(expected).all(axis=1)
            assert (np.isfinite(record.corners_px).all(axis=1) == finite).all()
            inside = finite & (np.abs(np.nan_to_num(expected, nan=1e9)) < 1e4).all(axis=1)
            assert np.abs(record.corners_px - expected)[inside].max(initial=0.0) < HALF_A_PIXEL / 10
            assert (record.entry_px == record.corners_px[:2])[finite[:2]].all()
            compared += inside.sum()
    assert compared > LEAST_CORNERS


def test_visibility_agrees_with_rays_to_the_corners(stage, rays, stalls, shots):
    slots, compared, hidden, strays = read_slots(stage), 0, 0, 0
    # what is around a corner and holds its pixel; an edge that passes there decides either way
    around = np.stack(np.meshgrid(*[np.linspace(-1, 1, 9)] * 2), axis=-1).reshape(-1, 2)
    for shot in shots:
        records = slots.seen_in(shot.frame)
        if not records:  # a wall before the camera
            continue
        corners = np.concatenate([np.insert(stalls[record.slot.stall.name][0], 1, 0.0, axis=1) for record in records])
        visibility = np.concatenate([record.visibility for record in records])
        places = shot.place_of(corners)
        inside = ((places >= 0) & (places < SIZE)).all(axis=1)
        assert ((visibility > 0) == inside).all()
        directions = shot.lens_rays((places[inside, None] + around).reshape(-1, 2))
        known = np.isfinite(directions).all(axis=1)
        met = np.full((len(directions), 3), np.inf)
        _, met[known], _ = rays.cast(np.repeat(shot.eye[None], known.sum(), axis=0), directions[known])
        is_floor = (np.abs(met[:, 1]) < 0.02).reshape(-1, len(around))
        sure = known.reshape(-1, len(around)).all(axis=1) & (is_floor.all(axis=1) | ~is_floor.any(axis=1))
        strays += ((visibility[inside] == 2) != is_floor[:, 0])[sure].sum()
        compared += sure.sum()
        hidden += (visibility[inside][sure] == 1).sum()
    assert compared > LEAST_CORNERS
    assert strays <= MOST_STRAYS * compared
    assert 0.1 < hidden / compared < 0.9


def test_what_is_level_with_the_floor_and_of_another_class_hides_it(stage, shots):
    slots, changed = read_slots(stage), 0
    for shot in shots:
        nothing = np.zeros(shot.frame.seen_m.shape[:2], dtype=bool)
        assert slots.seen_in(replace(shot.frame, shows_floor=nothing)) == []
        left = nothing.copy()
        left[:, : SIZE[0] // 2] = True
        told = {record.slot.stall.name: record for record in slots.seen_in(shot.frame)}
        for record in slots.seen_in(replace(shot.frame, shows_floor=left)):
            whole = told[record.slot.stall.name]
            is_right = record.corners_px[:, 0] >= SIZE[0] // 2
            expected = np.where(is_right, np.minimum(whole.visibility, 1), whole.visibility)
            assert record.visibility == tuple(expected.tolist())
            assert record.seen_px <= whole.seen_px
            changed += record.visibility != whole.visibility
    assert changed > 5


def test_the_ground_of_a_slot_is_its_pixels(stage, stalls, shots):
    slots = read_slots(stage)
    for shot in shots[:6]:
        records = {record.slot.stall.name: record for record in slots.seen_in(shot.frame)}
        seen = shot.frame.seen_m.reshape(-1, 3)
        floor = seen[np.abs(seen[:, 1]) < 0.02][:, [0, 2]]
        for name, (corners, _) in stalls.items():
            edges = np.roll(corners, -1, axis=0) - corners
            to_points = floor[:, None] - corners
            sides = edges[:, 0] * to_points[..., 1] - edges[:, 1] * to_points[..., 0]
            count = (sides < 0).all(axis=1).sum()
            assert (name in records) or not count
            assert not count or records[name].seen_px == count
        # the whole ground, hidden or not, is where rays would meet it if nothing stood on the floor
        rows, columns = np.mgrid[: SIZE[1], : SIZE[0]]
        directions = shot.lens_rays(np.stack([columns + 0.5, rows + 0.5], axis=-1).reshape(-1, 2))
        falls = directions[:, 1] < -1e-9
        distance = np.where(falls, shot.eye[1] / np.where(falls, -directions[:, 1], 1.0), np.nan)
        ground = (shot.eye + directions * distance[:, None])[:, [0, 2]]
        for record in records.values():
            corners = stalls[record.slot.stall.name][0]
            pixels = shapely.contains_xy(shapely.Polygon(corners), *ground[np.isfinite(ground).all(axis=1)].T).sum()
            area = sum(polygon_area(part) for part in record.outline_px)
            perimeter = sum(
                np.linalg.norm(np.roll(part, -1, axis=0) - part, axis=1).sum() for part in record.outline_px
            )
            assert abs(area - pixels) <= 0.5 * perimeter + 2, record.slot.stall.name


def polygon_area(ring):
    x, y = ring.T
    return abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def test_slots_of_a_stage_with_z_up_in_centimetres(stage, tmp_path):
    over = held_aloft(stage, tmp_path)
    plain, held_slots = read_slots(stage), read_slots(over)
    assert (held_slots.ground_axes, held_slots.up_axis) == ((0, 1), 2)
    for one, other in zip(plain.slots, held_slots.slots, strict=True):
        x, y, z = one.corners_m.T
        assert np.abs(other.corners_m - np.stack([x + 3, -z - 2, y + 4.5], axis=1)).max() < 1e-4
        assert other.stall.angle_deg == pytest.approx(one.stall.angle_deg, abs=0.01)


def test_a_stage_without_stalls_is_refused(tmp_path):
    empty = Usd.Stage.CreateNew(str(tmp_path / "empty.usda"))
    with pytest.raises(StageError, match="no slots in it: no curves Nodes, Edges, Stalls"):
        read_slots(empty)


@pytest.mark.parametrize("camera", ["FV", "RV", "MVL"])
def test_the_outline_of_the_ground_below_a_fisheye_goes_along_its_rim(camera):
    """The stall that the car stands in, which goes on below and behind its cameras, is what their rays meet of it."""
    sensor = next(each for each in read_rig("woodscape_like").scaled(0.25).cameras if each.name == camera)
    lens, place = sensor.lens, sensor.sensor_to_vehicle
    stall = np.array([(4.2, 1.2, 0.0), (4.2, -1.2, 0.0), (-1.1, -1.2, 0.0), (-1.1, 1.2, 0.0)])
    to_camera = np.linalg.inv(place)
    outline = outline_in_picture(stall, lambda points: lens.project(points @ to_camera[:3, :3].T + to_camera[:3, 3]))
    middles = lens.middles()
    rays = lens.rays(middles) @ place[:3, :3].T
    with np.errstate(divide="ignore", invalid="ignore"):
        ground = place[:3, 3] - rays * (place[2, 3] / rays[:, 2:])
        meets = (rays[:, 2] < 0) & (ground[:, 0] > -1.1) & (ground[:, 0] < 4.2) & (np.abs(ground[:, 1]) < 1.2)
    told = shapely.contains_xy(outline, middles)
    assert meets.sum() > 1000
    assert (told != meets).sum() < 0.01 * meets.sum()
