import numpy as np
import pytest

from garage2usd import assets
from garage2usd.assets import Collider
from garage2usd.config.vehicles import CAR_BODIES, PAINTS

each_body = pytest.mark.parametrize("body", CAR_BODIES, ids=lambda body: body.name)
NEEDED = {"Body", "Cabin", "Glass", "HeadLamps", "TailLamps", "Plates", "Tyres", "Rims", "Mirrors", "Arches"}


def parts_of(body):
    return {part.name: part for part in assets.car(body).parts}


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


def test_the_catalogue_has_six_kinds_and_nine_paints():
    assert [b.name for b in CAR_BODIES] == ["hatchback", "saloon", "suv", "van", "pickup", "compact_ev"]
    assert len(set(PAINTS)) >= 9


@each_body
def test_a_body_parks_in_the_standard_stall(body):
    assert body.length_m <= 5.3 - 0.22
    assert body.overall_width_m <= 2.4 - 0.2
    assert body.width_m < body.overall_width_m


@each_body
def test_a_car_has_all_its_parts_in_few_points(body):
    parts = parts_of(body)
    assert parts.keys() >= NEEDED
    assert sum(len(part.points) for part in parts.values()) <= 12000
    painted = {name for name, part in parts.items() if part.material.startswith("car_paint")}
    assert painted >= {"Body", "Cabin", "Mirrors"}
    assert {parts[name].material for name in painted} == {"car_paint"}
    assert tuple(assets.car(body).paints) == PAINTS


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
    for name in ("HeadLamps", "TailLamps", "Trim", "Arches", "Seams", "Handles", "Plates", "Mirrors"):
        assert open_edges(parts[name]) == [], name
        assert signed_volume(parts[name]) > 0, name


@each_body
def test_lamps_and_plates_are_at_both_ends(body):
    parts = parts_of(body)
    assert parts["HeadLamps"].points[:, 2].max() < -body.length_m / 2 + 0.8
    assert parts["TailLamps"].points[:, 2].min() > body.length_m / 2 - 0.8
    plates = parts["Plates"].points[:, 2]
    assert plates.min() < -body.length_m / 2 + 0.1
    assert plates.max() > body.length_m / 2 - 0.1


@each_body
def test_two_convex_hulls_stand_for_the_body_and_the_cabin(body):
    parts = parts_of(body)
    hulls = {name for name, part in parts.items() if part.collider is Collider.CONVEX_HULL}
    assert hulls == {"Body", "Cabin"}
    assert parts["Cabin"].points[:, 1].max() > parts["Body"].points[:, 1].max() + 0.2
