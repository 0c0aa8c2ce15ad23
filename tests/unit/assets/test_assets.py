from collections import Counter, defaultdict

import networkx as nx
import numpy as np
import pytest
import shapely
from support.object_specs import CASES, SPECS, asset_of_case
from support.soak import soak_but

from garage2usd.assets import MATERIALS, Collider, finished
from garage2usd.config.vehicles import CAR_BODIES, DRIVEN_BODIES
from garage2usd.pipeline import generate
from garage2usd.stage.prototypes import asset_of


def each_part(check):
    """Make a test of each object from a check of one of its parts."""

    @pytest.mark.parametrize("case", CASES)
    def test(case):
        for part in asset_of_case(case).parts:
            check(case, part)

    test.__name__ = check.__name__
    return test


def loops(part):
    return np.split(part.face_indices, np.cumsum(part.face_counts)[:-1])


def material_of(case, part):
    return finished(part.material, asset_of_case(case).finishes).material


@each_part
def test_arrays_fit_each_other(case, part):
    corners = part.face_counts.sum()
    assert part.face_indices.shape == (corners,) == part.normal_indices.shape
    assert part.st_indices.shape == ((corners,) if material_of(case, part).textures() else (0,))
    assert part.normals.shape[1:] == (3,)
    assert np.linalg.norm(part.normals, axis=1) == pytest.approx(1.0, abs=1e-4)
    assert len(np.unique(part.normals, axis=0)) == len(part.normals)
    assert set(np.unique(part.normal_indices)) == set(range(len(part.normals)))
    assert set(np.unique(part.face_indices)) == set(range(len(part.points)))
    assert set(np.unique(part.st_indices)) == set(range(len(part.st)))
    assert np.isfinite(part.points).all()
    assert np.isfinite(part.st).all()
    assert len(np.unique(part.points, axis=0)) == len(part.points)
    assert part.material in {*MATERIALS, *asset_of_case(case).finishes}
    assert part.face_counts.min() >= 3


@each_part
def test_faces_have_area_and_look_where_their_normals_do(case, part):
    start = 0
    for loop in loops(part):
        corners = part.points[loop].astype(float)
        spokes = corners - corners[0]
        normal = np.cross(spokes, np.roll(spokes, -1, axis=0)).sum(axis=0)
        assert np.linalg.norm(normal) > 1e-8
        assert (part.normals[part.normal_indices[start : start + len(loop)]] @ normal > 0).all()
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
    neighbours = defaultdict(list)
    for edge, pair in edges.items():
        if len(pair) == 2:
            for vertex in edge:
                neighbours[vertex].append(pair)
    for vertex, faces in around.items():
        fan = nx.Graph()
        fan.add_nodes_from(faces)
        fan.add_edges_from(neighbours[vertex])
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
        ("column", "Guard", (0.36 - 2 * 0.03**2) * 1.2),
        ("column", "Shaft", (0.36 - 2 * 0.03**2) * 2.0),
        ("duct", "Body", 8.1 * 0.8 * 0.35),
        ("tube", "Housing", 1.5 * 0.12 * 0.06),
    ],
)
def test_closed_bodies_have_their_volume(case, name, volume):
    (part,) = [part for part in asset_of_case(case).parts if part.name == name]
    assert signed_volume(part) == pytest.approx(volume, rel=1e-5)


def test_a_speed_bump_has_the_standard_s_section():
    points = np.concatenate([part.points for part in asset_of_case("bump").parts])
    assert np.ptp(points, axis=0) == pytest.approx([7.2, 0.05, 0.35], abs=1e-6)
    assert points[:, 1].min() == 0
    stop = np.concatenate([part.points for part in asset_of_case("stop").parts])
    assert np.ptp(stop, axis=0) == pytest.approx([1.65, 0.1, 0.15], abs=1e-6)


@pytest.mark.parametrize("body", soak_but(DRIVEN_BODIES, CAR_BODIES), ids=lambda body: body.name)
def test_cars_keep_their_measures_and_stand_on_their_wheels(body):
    asset = asset_of_case(f"car_{body.name}")
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
    assert parts["Body"].points[:, 1].min() > 0.12
    # rims in all four wheels, as far apart as the wheelbase
    z = np.concatenate([part.points for name, part in parts.items() if name.endswith("Rim")])[:, 2]
    front = -body.length_m / 2 + body.front_overhang_m
    assert abs((z.min() + z.max()) / 2 - (front + body.wheelbase_m / 2)) < 0.01
    assert 2000 < sum(len(part.face_counts) for part in asset.parts) < 12000


def test_a_panel_is_partitioned_exactly():
    area, painted = defaultdict(float), defaultdict(float)
    shapes = []
    for part in asset_of_case("floor").parts:
        assert (part.points[:, 1] == 0).all()
        assert (part.normals == (0, 1, 0)).all()
        for loop in loops(part):
            polygon = shapely.Polygon(part.points[loop][:, [0, 2]])
            area[part.material] += polygon.area
            painted[part.piece] += polygon.area
            shapes.append(polygon)
    assert area["paint_yellow"] == pytest.approx(8.1 * 0.12, abs=1e-4)
    assert area["paint_white"] == pytest.approx(0.9 + 0.9, abs=1e-4)
    assert painted == pytest.approx({"": area["floor_concrete"], "lane_line": 8.1 * 0.12, "hatching": 1.8}, abs=1e-4)
    assert sum(area.values()) == pytest.approx(8.1 * 6.5 - 2 * 1.25, abs=1e-4)
    assert shapely.union_all(shapes).area == pytest.approx(sum(area.values()), abs=1e-4)


def test_texture_coordinates_run_on_under_the_paint():
    by_point = {}
    for part in asset_of_case("floor").parts:
        repeat = MATERIALS[part.material].repeat_m
        for point, place in zip(part.points[part.face_indices], part.st[part.st_indices] * repeat, strict=True):
            known = by_point.setdefault(tuple(point.tolist()), place)
            assert known == pytest.approx(place, abs=1e-4)


@pytest.mark.parametrize("case", CASES)
def test_colliders_are_on_what_can_be_touched(case):
    kind = SPECS[case].kind
    is_floor = kind.name in {"floor", "stall"}
    assert (kind.is_solid or is_floor) == any(part.collider for part in asset_of_case(case).parts)


def test_floors_collide_as_meshes_and_wheel_stops_as_hulls():
    assert {part.collider for part in asset_of_case("floor").parts} == {Collider.MESH}
    assert {part.collider for part in asset_of_case("stop").parts} == {Collider.CONVEX_HULL}


def test_every_spec_of_a_garage_has_an_asset():
    layout = generate(seed=3).layout
    for place in layout.placements:
        assert asset_of(place.spec).parts
        assert asset_of(place.spec) is asset_of(place.spec)
    assert layout.of_kind("car")
