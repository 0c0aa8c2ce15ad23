from itertools import combinations

import numpy as np
import pytest
import shapely
from pxr import Usd, UsdGeom
from support.soak import soak_but

from garage2usd.assets import MATERIALS, Collider
from garage2usd.assets.car_shapes import SHAPES, Grille, Head, Rim, TailLamp
from garage2usd.assets.car_shell import Shell
from garage2usd.assets.car_wheels import MOST_STEER_DEG, steered_box
from garage2usd.assets.cars import car
from garage2usd.common.errors import ConfigError
from garage2usd.config.outputs import TextureQuality
from garage2usd.config.vehicles import CAR_BODIES, DRIVEN_BODIES, PAINTS
from garage2usd.objects.car import CarSpec
from garage2usd.stage.prototype_layer import write_prototype

KEPT = [body for body in CAR_BODIES if body in DRIVEN_BODIES or body.name == "roadster"]
"""All designs of shells; the others are wide."""
each_body = pytest.mark.parametrize("body", soak_but(KEPT, CAR_BODIES), ids=lambda body: body.name)
SEGMENTS = {"city", "hatchback", "saloon", "estate", "suv", "mpv", "van", "pickup", "sports"}
NEEDED = {"Body", "Cabin", "Glass", "HeadLamps", "TailLamps", "PlateHolders", "Mirrors", "Arches"}
TYRES = {f"{end}{side}Tyre" for end in ("Front", "Rear") for side in ("Left", "Right")}
RIMS = {name.replace("Tyre", "Rim") for name in TYRES}


def parts_of(body):
    return {part.name: part for part in car(body).parts}


def signed_volume(part):
    total, corners = 0.0, part.points.astype(float)
    for loop in np.split(part.face_indices, np.cumsum(part.face_counts)[:-1]):
        for index in range(1, len(loop) - 1):
            total += np.dot(corners[loop[0]], np.cross(corners[loop[index]], corners[loop[index + 1]])) / 6
    return total


def open_edges(part):
    edges = {}
    for loop in np.split(part.face_indices, np.cumsum(part.face_counts)[:-1]):
        for first, second in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True):
            edge = frozenset((first, second))
            edges[edge] = edges.get(edge, 0) + 1
    return [edge for edge, count in edges.items() if count != 2]


def test_the_catalogue_has_more_than_thirty_bodies_of_all_segments_and_nine_paints():
    assert [b.name for b in DRIVEN_BODIES] == ["hatchback", "saloon", "suv", "van", "pickup", "compact_ev"]
    assert len({b.name for b in CAR_BODIES}) == len(CAR_BODIES) >= 30
    assert SHAPES.keys() == {b.name for b in CAR_BODIES}
    assert {b.segment for b in CAR_BODIES} == SEGMENTS
    assert min(b.length_m for b in CAR_BODIES) == 2.7
    assert max(b.length_m for b in CAR_BODIES) == 5.6
    assert len(set(PAINTS)) >= 9
    assert {f"car_paint_{paint}" for paint in PAINTS} <= MATERIALS.keys()


@pytest.mark.parametrize("body", DRIVEN_BODIES, ids=lambda body: body.name)
def test_a_body_that_drives_parks_in_the_standard_stall(body):
    assert body.fits(2.4 - 0.2, 5.3 - 0.22)


@each_body
def test_a_body_fits_into_its_own_measures_and_into_nothing_smaller(body):
    assert body.width_m < body.overall_width_m
    assert body.fits(body.overall_width_m, body.length_m, body.height_m)
    assert not body.fits(body.overall_width_m - 0.01, body.length_m)
    assert not body.fits(body.overall_width_m, body.length_m - 0.01)
    assert not body.fits(body.overall_width_m, body.length_m, body.height_m - 0.01)


@each_body
def test_a_car_has_all_its_parts_in_few_points(body):
    parts = parts_of(body)
    assert parts.keys() >= NEEDED | TYRES | RIMS
    assert sum(len(part.points) for part in parts.values()) <= 12000
    painted = {name for name, part in parts.items() if part.material.startswith("car_paint")}
    assert painted >= {"Body", "Mirrors"}
    assert parts["Cabin"].material == ("soft_top" if body.name == "roadster" else "car_paint")
    assert {parts[name].material for name in painted} == {"car_paint"}
    assert tuple(car(body).paints) == PAINTS


@each_body
def test_a_car_fills_its_footprint_and_nothing_is_below_the_floor(body):
    points = np.concatenate([part.points for part in parts_of(body).values()])
    assert points[:, 2].min() == pytest.approx(-body.length_m / 2, abs=0.012)
    assert points[:, 2].max() == pytest.approx(body.length_m / 2, abs=0.012)
    assert np.abs(points[:, 2]).max() <= body.length_m / 2 + 1e-3
    assert points[:, 1].min() >= -1e-6


@each_body
def test_what_is_put_on_the_shell_is_closed_and_turned_outwards(body):
    parts = parts_of(body)
    for name in (
        "HeadLamps",
        "TailLamps",
        "ReverseLamps",
        "LampHousings",
        "Trim",
        "Bright",
        "Arches",
        "Seams",
        "Handles",
        "PlateHolders",
        "Mirrors",
    ):
        assert open_edges(parts[name]) == [], name
        assert signed_volume(parts[name]) > 0, name


def triangles(*parts):
    """The faces of parts, shape (n, 3, 3)."""
    found = []
    for part in parts:
        for loop in np.split(part.face_indices, np.cumsum(part.face_counts)[:-1]):
            found += [part.points[[loop[0], loop[k], loop[k + 1]]] for k in range(1, len(loop) - 1)]
    return np.array(found, dtype=float)


def unit_normals(faces):
    normals = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    return normals / np.linalg.norm(normals, axis=1, keepdims=True)


def first_hits(origins, directions, faces):
    """Distances along rays to the first faces that they meet, and whether they meet outsides (Moeller-Trumbore)."""
    first, second = faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]
    distances, outside = np.full(len(origins), np.inf), np.zeros(len(origins), bool)
    for ray, (origin, direction) in enumerate(zip(origins, directions, strict=True)):
        across = np.cross(direction, second)
        size = (first * across).sum(axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            away = origin - faces[:, 0]
            u = (away * across).sum(axis=1) / size
            turned = np.cross(away, first)
            v = (turned @ direction) / size
            distance = (second * turned).sum(axis=1) / size
            meets = np.flatnonzero((u >= 0) & (v >= 0) & (u + v <= 1) & (distance > -1e-9))
        if len(meets):
            nearest = meets[np.argmin(distance[meets])]
            distances[ray], outside[ray] = distance[nearest], size[nearest] > 0
    return distances, outside


@each_body
def test_lamps_stand_out_of_the_body_on_both_sides(body):
    parts = parts_of(body)
    shell = triangles(*(part for name, part in parts.items() if name in {"Body", "Cabin", "Glass", "RearGlass"}))
    for name in ("HeadLamps", "TailLamps", "ReverseLamps", "LampHousings"):
        faces = triangles(parts[name])
        middles, normals = faces.mean(axis=1), unit_normals(faces)
        inner = np.sign(middles[:, 2]) * (body.length_m / 2 - 0.8)
        outwards = (middles - np.stack([0 * inner, middles[:, 1], inner], axis=1)) * (1.0, 0.0, 1.0)
        outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
        outer = (normals * outwards).sum(axis=1) > 0.8
        assert (middles[outer, 0] > 0).sum() == (middles[outer, 0] < 0).sum() > 0
        near = shell[np.abs(shell[:, :, 2]).max(axis=1) > body.length_m / 2 - 0.9]
        right = outer & (middles[:, 0] > 0)
        places = np.concatenate([faces[right] * 0.98 + middles[right, None] * 0.02, middles[right, None]], axis=1)
        towards = np.repeat(-normals[right], 4, axis=0)
        distances, from_outside = first_hits(places.reshape(-1, 3), towards, near)
        assert from_outside.all(), (name, places.reshape(-1, 3)[~from_outside])
        assert distances.min() >= 0.002, (name, places.reshape(-1, 3)[np.argmin(distances)])


@each_body
def test_tail_lamps_are_tall_or_wide_as_their_design_is(body):
    lamps = parts_of(body)["TailLamps"].points
    reflector = Shell(body, SHAPES[body.name]).bumper_top(rear=True)
    right = lamps[(lamps[:, 0] > 0) & (lamps[:, 1] > reflector)]
    width, height = np.ptp(right[:, 0]), np.ptp(right[:, 1])
    design = SHAPES[body.name].tail_lamps
    if design is TailLamp.TALL:
        assert height > 0.25
        assert width < 0.25
    else:
        assert width > (0.5 if design is TailLamp.BAR else 0.2)
        assert height < 0.2


@each_body
def test_a_car_keeps_within_its_measures(body):
    parts = parts_of(body)
    points = np.concatenate([part.points for part in parts.values()])
    sides = np.concatenate([part.points for name, part in parts.items() if name != "Mirrors"])
    assert np.abs(points[:, 2]).max() <= body.length_m / 2 + 1e-6
    assert np.abs(points[:, 0]).max() <= body.overall_width_m / 2 + 1e-6
    assert np.abs(sides[:, 0]).max() <= body.width_m / 2 + 0.02  # handles and lips
    assert points[:, 1].max() <= body.height_m + 1e-6


@each_body
def test_each_wheel_stands_on_the_floor(body):
    parts = parts_of(body)
    axles = {"Front": body.front_overhang_m, "Rear": body.front_overhang_m + body.wheelbase_m}
    for side, sign in (("Left", -1), ("Right", 1)):
        for end, axle in axles.items():
            wheel = parts[f"{end}{side}Tyre"].points
            assert (wheel[:, 0] * sign > 0).all()
            assert np.abs(wheel[:, 2] - (axle - body.length_m / 2)).max() < body.wheel_radius_m + 0.01
            assert wheel[:, 1].min() == pytest.approx(0.0, abs=1e-6)
            assert np.ptp(wheel[:, 1]) == pytest.approx(2 * body.wheel_radius_m, abs=1e-5)


@each_body
def test_a_car_takes_150_kb(body, tmp_path):
    path = tmp_path / "Car.usdc"
    write_prototype(car(body), path, kind=CarSpec.kind, quality=TextureQuality.HIGH)
    assert path.stat().st_size <= 150_000


@pytest.mark.parametrize("steer_deg", [0.0, -15.0])
def test_the_four_wheels_of_a_car_share_their_arrays_and_stand_where_they_are(tmp_path, steer_deg):
    asset = CarSpec("saloon", "white", steer_deg).asset()
    write_prototype(asset, tmp_path / "Car.usdc", kind=CarSpec.kind, quality=TextureQuality.HIGH)
    stage = Usd.Stage.Open(str(tmp_path / "Car.usdc"))
    for kind, names in (("Rim", RIMS), ("Tyre", TYRES)):
        arrays = set()
        for part in (part for part in asset.parts if part.name in names):
            mesh = UsdGeom.Mesh(stage.GetPrimAtPath(f"/Asset/Geom/{part.name}"))
            points = np.array(mesh.GetPointsAttr().Get())
            normals = np.array(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("normals").Get())
            arrays.add((points.tobytes(), normals.tobytes()))
            matrix = np.array(mesh.GetLocalTransformation())
            assert points @ matrix[:3, :3] + matrix[3, :3] == pytest.approx(part.points, abs=2e-5)
            assert normals @ matrix[:3, :3] == pytest.approx(part.normals, abs=2e-4)
        assert len(arrays) == 1, kind


@each_body
def test_lamps_and_plate_holders_are_at_both_ends(body):
    parts = parts_of(body)
    assert parts["HeadLamps"].points[:, 2].max() < -body.length_m / 2 + 0.8
    assert parts["TailLamps"].points[:, 2].min() > body.length_m / 2 - 0.8
    plates = parts["PlateHolders"].points[:, 2]
    assert plates.min() < -body.length_m / 2 + 0.1
    assert plates.max() > body.length_m / 2 - 0.1


@each_body
def test_convex_hulls_stand_for_the_body_the_cabin_and_each_tyre(body):
    parts = parts_of(body)
    hulls = {name for name, part in parts.items() if part.collider is Collider.CONVEX_HULL}
    assert hulls == {"Body", "Cabin", *TYRES}
    assert parts["Cabin"].points[:, 1].max() > parts["Body"].points[:, 1].max() + 0.2


def silhouette(body, axes):
    """What of a plane the triangles of a car cover, seen along the third axis."""
    corners = triangles(*car(body).parts)[:, :, axes].round(4)
    faces = shapely.polygons(corners)
    return shapely.union_all(shapely.buffer(faces[shapely.area(faces) > 1e-6], 0.002, quad_segs=1)).simplify(0.002)


@pytest.mark.soak
def test_no_two_bodies_look_alike_from_the_side():
    sides = {body.name: silhouette(body, [2, 1]) for body in CAR_BODIES}
    for (first, one), (second, other) in combinations(sides.items(), 2):
        common = one.intersection(other).area / one.union(other).area
        assert common < 0.985, (first, second)


def test_no_two_bodies_have_the_same_design_and_all_designs_are_used():
    designs = [
        (shape.head, shape.tail_lamps, shape.grille, shape.rim, shape.clad, shape.shoulder) for shape in SHAPES.values()
    ]
    assert len(set(designs)) == len(CAR_BODIES)
    for number, design in enumerate((Head, TailLamp, Grille, Rim)):
        assert {chosen[number] for chosen in designs} == set(design)


@each_body
def test_rays_through_the_windows_meet_seats_or_what_lines_the_inside(body):
    parts = parts_of(body)
    shell = Shell(body, SHAPES[body.name])
    glass, inside, opaque = (
        triangles(*(part for part in parts.values() if part.material in materials and len(part.points)))
        for materials in (
            {"glass", "glass_dark"},
            {"interior_dark", "seat_black", "seat_grey", "seat_tan"},
            {part.material for part in parts.values()} - {"glass", "glass_dark"},
        )
    )
    along = shell.shape.pillars[0] * body.length_m + np.linspace(-0.4, 0.2, 49)
    for sign in (-1.0, 1.0):
        origins = np.array([(sign * 3.0, shell.shoulder(s) + 0.06, s - body.length_m / 2) for s in along.tolist()])
        towards = np.tile((-sign, 0.0, 0.0), (len(along), 1))
        through, _ = first_hits(origins, towards, glass)
        within, from_outside = first_hits(origins, towards, inside)
        first, _ = first_hits(origins, towards, opaque)
        is_seen = from_outside & (through < within) & (within <= first + 1e-6) & (within < 3.0)
        assert is_seen.sum() >= 2


@each_body
def test_what_is_inside_stays_inside(body):
    parts = parts_of(body)
    shell = Shell(body, SHAPES[body.name])
    points = np.concatenate([parts["Interior"].points, parts["Seats"].points]).astype(float)
    assert points[:, 2].max() < shell.deck - body.length_m / 2
    assert points[:, 2].min() > shell.cowl - body.length_m / 2
    for x, y, z in points:
        ring = shell._ring_at(z + body.length_m / 2)[4:]
        side = shapely.Polygon(np.concatenate([ring[:, :2], ring[::-1, :2] * (-1.0, 1.0)]))
        assert side.buffer(0).contains(shapely.Point(abs(x), max(y, ring[0, 1] + 0.01))), (x, y, z)


@each_body
def test_turned_wheels_stand_where_they_did_and_within_their_outline(body):
    straight, left = (CarSpec(body.name, "white", steer).asset() for steer in (0.0, MOST_STEER_DEG))
    before, after = ({part.name: part for part in asset.parts} for asset in (straight, left))
    (side, first, last) = steered_box(body, MOST_STEER_DEG)
    assert side <= body.overall_width_m / 2 + 0.01
    for name in ("FrontRightTyre", "FrontLeftTyre"):
        middle, moved = (parts[name].points.min(axis=0) + parts[name].points.max(axis=0) for parts in (before, after))
        assert moved == pytest.approx(middle, abs=0.02)
        points = after[name].points
        assert points[:, 1].min() == pytest.approx(0.0, abs=1e-6)
        assert np.abs(points[:, 0]).max() <= side + 1e-6
        assert first - 1e-6 <= points[:, 2].min()
        assert points[:, 2].max() <= last + 1e-6
    # the front of the right wheel goes to the left
    right = after["FrontRightTyre"].points
    ahead = right[right[:, 2] < np.median(right[:, 2])]
    assert ahead[:, 0].mean() < before["FrontRightTyre"].points[:, 0].mean() - 0.02
    for name in ("RearRightTyre", "RearLeftTyre"):
        assert np.array_equal(after[name].points, before[name].points)


@pytest.mark.parametrize("steer_deg", [20.1, -21.0, np.nan])
def test_wheels_turn_no_farther_than_mirrors_stand_out(steer_deg):
    with pytest.raises(ConfigError, match=r"steer_deg.*-20 to 20 degrees"):
        CarSpec("saloon", "white", steer_deg).asset()


@each_body
def test_dust_lies_on_the_flanks_and_thins_out_upwards(body):
    parts = {part.name: part for part in CarSpec(body.name, "white", is_dusty=True).asset().parts}
    dust = parts.pop("Dust")
    assert parts.keys() == parts_of(body).keys()
    assert np.abs(dust.points[:, 0]).max() <= body.width_m / 2 + 0.002
    assert dust.points[:, 1].max() < Shell(body, SHAPES[body.name]).shoulder(0.9 * body.length_m)
    high = np.array([dust.points[point, 1] for point in dust.face_indices])
    v = dust.st[dust.st_indices, 1]
    assert v[high < high.min() + 0.02].max() < 0.1
    assert v[high > high.min() + 0.6].min(initial=0.97) == pytest.approx(0.97)
    order = np.argsort(high)
    assert (np.diff(v[order]) >= -1e-5).all()
    faces = triangles(dust)
    across = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])[:, 0] * np.sign(faces[:, :, 0].mean(axis=1))
    assert across[across > 0].sum() > 0.999 * np.abs(across).sum()


@each_body
def test_no_face_folds_over_where_readers_halve_it(body):
    """Readers draw faces as fans from their first corners; each triangle looks where its corners' normals do."""
    for part in car(body).parts:
        first = np.cumsum([0, *part.face_counts[:-1]])
        for start, count in zip(first.tolist(), part.face_counts.tolist(), strict=True):
            points = part.points[part.face_indices[start : start + count]].astype(float)
            normals = part.normals[part.normal_indices[start : start + count]]
            for at in range(1, count - 1):
                area = np.cross(points[at] - points[0], points[at + 1] - points[0])
                assert area @ normals[[0, at, at + 1]].sum(axis=0) >= -1e-9, part.name
