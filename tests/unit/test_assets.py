import string
from collections import Counter, defaultdict

import networkx as nx
import numpy as np
import pytest
import shapely

from garage2usd import assets
from garage2usd.assets import MATERIALS, Collider, Marking
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.layout import specs as s
from garage2usd.pipeline import generate
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.prototypes import asset_of

PANEL = {
    "width_m": 8.1,
    "depth_m": 6.5,
    "base_material": "floor_concrete",
    "markings": [
        Marking(((-4.05, -1.0), (-4.05, -0.88), (4.05, -0.88), (4.05, -1.0)), "paint_yellow"),
        Marking(((0.0, 0.0), (1.0, 1.0), (0.2, 2.0)), "paint_white"),
        Marking(((0.2, 2.0), (1.0, 1.0), (2.0, 2.0)), "paint_white"),
    ],
    "openings": [((-3.0, -3.25), (-3.0, -2.0), (-1.0, -2.0), (-1.0, -3.25))],
    "label": "floor",
}

CASES = {
    "floor": assets.floor_panel(**PANEL),
    "wall": assets.wall_panel(8.1, 3.2, 0.3),
    "post": assets.wall_post(0.3, 3.2),
    "entrance": assets.portal_wall(8.1, 3.2, 0.3, door_width_m=6.0, door_height_m=2.6, is_entrance=True),
    "exit": assets.portal_wall(5.4, 3.0, 0.3, door_width_m=4.2, door_height_m=2.4, is_entrance=False),
    "open_door": assets.portal_wall(8.1, 3.2, 0.3, door_width_m=6.0, door_height_m=2.6, is_entrance=True, is_open=True),
    "ramp": assets.ramp(
        width_m=6.2,
        wall_m=0.3,
        threshold_m=(5.84, 0.3),
        profile=[(0.3, 0.0), (0.8, 0.0), (4.4, 0.27), (24.1, 3.23), (27.7, 3.5), (30.2, 3.5)],
        cover_m=(9.3, 3.2, 3.5),
        wall_top_m=4.8,
    ),
    "sky": assets.sky(width_m=6.8, start_m=9.3, end_m=30.21, ground_m=3.45, low_m=4.8, high_m=7.8),
    "raised_barrier": assets.barrier(arm_m=6.1, is_raised=True, elbow_m=2.75),
    "closed_barrier": assets.barrier(arm_m=6.1, is_raised=False, elbow_m=2.75),
    "obstacle": assets.obstacle_block(8.1, 5.4, 3.2),
    "column": assets.column(0.6, 3.2),
    "ceiling": assets.ceiling_panel(8.1, 8.1, 0.25),
    "tube": assets.tube_light(1.5, 0.12, drop_m=0.115, luminance_nit=4000.0),
    "beam": assets.beam(7.5, 0.4, 0.4),
    "node": assets.beam_node([(-0.3, -0.2, 0.3, 0.2), (-0.2, 0.2, 0.2, 0.3)], 0.4),
    "duct": assets.duct(8.1, 0.8, 0.35, hanger_m=0.15, hangers_at_m=(-3.0, 3.0)),
    "branch": assets.duct(0.65, 0.8, 0.35, hanger_m=0.15, hangers_at_m=(0.1,)),
    "tray": assets.cable_tray(8.1, 0.3, 0.06, 0.5, rods_at_m=(-2.0, 2.0)),
    "cone": assets.cone(),
    "bump": assets.speed_bump(7.2),
    "stop": assets.wheel_stop(1.65),
    "sign": assets.no_parking_sign(),
    "sprinkler": assets.sprinkler(8.1, 0.03, 0.075, rods_at_m=(-2.0, 1.0), heads_at_m=(-2.0, 2.0)),
    "pipe": assets.sprinkler(0.7, 0.03, 0.075, rods_at_m=(0.1,), heads_at_m=()),
    **{f"exit_sign_{turn}": assets.exit_sign(turn, 0.58, 0.2) for turn in (-90, 0, 90)},
    "mirror": assets.mirror(0.25, arm_m=0.12),
    "charger": assets.charger(),
    "oil": assets.floor_stain("oil", 2, 0.9, 0.7),
    "wear": assets.floor_stain("wear_t", 0, 8.1, 6.5),
    **{f"tyres_{turn}": assets.tyre_marks(1, 4.6, turn) for turn in (-1.2, 0.0, 1.2)},
    **{f"number_{digits}": assets.floor_number(digits, 0.45, pitch=0.71) for digits in [*"0123456789", "07", "88"]},
    **{
        f"plate_{text}": assets.zone_plate(text, 0.6, 0.38, pitch=0.71)
        for text in [*string.ascii_uppercase.replace("I", "").replace("O", ""), "7", "12"]
    },
    **{f"car_{body.name}": assets.car(body) for body in CAR_BODIES},
}
each_part = pytest.mark.parametrize(
    ("case", "part"),
    [(name, part) for name, asset in CASES.items() for part in asset.parts],
    ids=lambda v: getattr(v, "name", v),
)


def loops(part):
    return np.split(part.face_indices, np.cumsum(part.face_counts)[:-1])


@each_part
def test_arrays_fit_each_other(case, part):
    corners = part.face_counts.sum()
    assert part.face_indices.shape == (corners,) == part.st_indices.shape
    assert part.normals.shape == (corners, 3)
    assert np.linalg.norm(part.normals, axis=1) == pytest.approx(1.0, abs=1e-5)
    assert set(np.unique(part.face_indices)) == set(range(len(part.points)))
    assert set(np.unique(part.st_indices)) == set(range(len(part.st)))
    assert np.isfinite(part.points).all()
    assert np.isfinite(part.st).all()
    assert len(np.unique(part.points, axis=0)) == len(part.points)
    assert part.material in MATERIALS
    assert part.face_counts.min() >= 3


@each_part
def test_faces_have_area_and_look_where_their_normals_do(case, part):
    start = 0
    for loop in loops(part):
        corners = part.points[loop].astype(float)
        normal = sum(
            np.cross(a - corners[0], b - corners[0]) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)
        )
        assert np.linalg.norm(normal) > 1e-8
        assert (part.normals[start : start + len(loop)] @ normal > 0).all()
        start += len(loop)


@each_part
def test_meshes_are_manifold(case, part):
    directed = Counter()
    around = defaultdict(list)
    for index, loop in enumerate(loops(part)):
        for first, second in zip(loop, np.roll(loop, -1), strict=True):
            directed[int(first), int(second)] += 1
            around[int(first)].append(index)
    assert max(directed.values()) == 1  # consistent winding, and at most two faces an edge
    edges = defaultdict(list)
    for index, loop in enumerate(loops(part)):
        for first, second in zip(loop, np.roll(loop, -1), strict=True):
            edges[frozenset((int(first), int(second)))].append(index)
    for vertex, faces in around.items():
        fan = nx.Graph()
        fan.add_nodes_from(faces)
        fan.add_edges_from(pair for edge, pair in edges.items() if vertex in edge and len(pair) == 2)
        assert nx.is_connected(fan), part.points[vertex]


def signed_volume(part):
    total = 0.0
    for loop in loops(part):
        corners = part.points[loop].astype(float)
        for index in range(1, len(corners) - 1):
            total += np.dot(corners[0], np.cross(corners[index], corners[index + 1])) / 6
    return total


@pytest.mark.parametrize(
    ("case", "name", "volume"),
    [
        ("post", "Concrete", 0.3 * 0.3 * 3.2),
        ("ceiling", "Slab", 8.1 * 8.1 * 0.25),
        ("column", "Hazard", (0.36 - 2 * 0.03**2) * 1.2),
        ("column", "Shaft", (0.36 - 2 * 0.03**2) * 2.0),
        ("duct", "Body", 8.1 * 0.8 * 0.35),
        ("tube", "Housing", 1.5 * 0.12 * 0.06),
    ],
)
def test_closed_bodies_have_their_volume(case, name, volume):
    (part,) = [part for part in CASES[case].parts if part.name == name]
    assert signed_volume(part) == pytest.approx(volume, rel=1e-5)


def test_a_speed_bump_has_the_standard_s_section():
    points = np.concatenate([part.points for part in CASES["bump"].parts])
    assert np.ptp(points, axis=0) == pytest.approx([7.2, 0.05, 0.35], abs=1e-6)
    assert points[:, 1].min() == 0
    stop = np.concatenate([part.points for part in CASES["stop"].parts])
    assert np.ptp(stop, axis=0) == pytest.approx([1.65, 0.1, 0.15], abs=1e-6)


@pytest.mark.parametrize("body", CAR_BODIES, ids=lambda body: body.name)
def test_cars_keep_their_measures_and_stand_on_their_wheels(body):
    asset = CASES[f"car_{body.name}"]
    parts = {part.name: part for part in asset.parts}
    points = np.concatenate([part.points for part in asset.parts])
    low, high = points.min(axis=0), points.max(axis=0)
    assert high[0] == pytest.approx(body.overall_width_m / 2, abs=0.002)
    assert low[0] == pytest.approx(-body.overall_width_m / 2, abs=0.002)
    assert body.height_m - 0.03 < high[1] <= body.height_m + 0.02
    assert high[2] - low[2] <= body.length_m + 0.03
    assert low[1] == pytest.approx(0.0, abs=0.003)  # a tyre is a polygon of 36 corners
    tyres = np.concatenate([part.points for name, part in parts.items() if name.endswith("Tyre")])
    assert tyres[:, 1].min() == pytest.approx(0.0, abs=0.003)
    assert np.abs(tyres[:, 0]).max() <= body.width_m / 2
    assert parts["Body"].points[:, 1].min() > 0.15
    # rims in all four wheels, as far apart as the wheelbase
    z = parts["Rims"].points[:, 2]
    front = -body.length_m / 2 + body.front_overhang_m
    assert abs((z.min() + z.max()) / 2 - (front + body.wheelbase_m / 2)) < 0.01
    assert 2000 < sum(len(part.face_counts) for part in asset.parts) < 12000


def test_a_panel_is_partitioned_exactly():
    area = defaultdict(float)
    shapes = []
    for part in CASES["floor"].parts:
        assert (part.points[:, 1] == 0).all()
        assert (part.normals == (0, 1, 0)).all()
        for loop in loops(part):
            polygon = shapely.Polygon(part.points[loop][:, [0, 2]])
            area[part.material] += polygon.area
            shapes.append(polygon)
    assert area["paint_yellow"] == pytest.approx(8.1 * 0.12, abs=1e-4)
    assert area["paint_white"] == pytest.approx(0.9 + 0.9, abs=1e-4)
    assert sum(area.values()) == pytest.approx(8.1 * 6.5 - 2 * 1.25, abs=1e-4)
    assert shapely.union_all(shapes).area == pytest.approx(sum(area.values()), abs=1e-4)


def test_texture_coordinates_run_on_under_the_paint():
    by_point = {}
    for part in CASES["floor"].parts:
        repeat = MATERIALS[part.material].repeat_m
        for point, place in zip(part.points[part.face_indices], part.st[part.st_indices] * repeat, strict=True):
            known = by_point.setdefault(tuple(point.tolist()), place)
            assert known == pytest.approx(place, abs=1e-4)


def test_colliders_are_on_what_can_be_touched():
    untouchable = {"sky", "stall_number", "zone_plate", "floor_stain"}
    for asset in CASES.values():
        assert (asset.label in untouchable) != any(part.collider for part in asset.parts)
    assert {part.collider for part in CASES["floor"].parts} == {Collider.MESH}
    assert {part.collider for part in CASES["stop"].parts} == {Collider.CONVEX_HULL}


def test_every_spec_of_a_garage_has_an_asset():
    layout = generate(seed=3).layout
    for place in layout.placements:
        assert asset_of(place.spec).parts
        assert asset_of(place.spec) is asset_of(place.spec)
        assert asset_of(place.spec).label == OBJECT_LABELS[place.kind]
    assert any(isinstance(place.spec, s.CarSpec) for place in layout.placements)
