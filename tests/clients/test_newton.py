"""Newton, a physics engine, finds every collider of a stage: of the right kind, size and place."""

import numpy as np
import pytest
from support.newton_reader import needs_newton, running_newton
from support.places import MILLIMETRE, assert_same_places
from support.sample_files import REPOSITORY
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd import GarageConfig, build
from garage2usd.assets import Collider
from garage2usd.layout.placement import to_world
from garage2usd.stage.prototypes import asset_of

pytestmark = [pytest.mark.client, needs_newton]

SHAPES = {Collider.MESH: "MESH", Collider.BOX: "BOX", Collider.CONVEX_HULL: "CONVEX_MESH"}
CASES = [("looks", None), ("paper_7x9", None), ("mixed_stalls", None), ("irregular", "nested")]
"""Samples with all kinds of objects, and forms of their stages."""
# newton turns a box to fit its points, which on a square slab is off by up to 15 mm
BOX_TOLERANCE_M = 0.02
# newton keeps the 64 most important points of a hull
HULL_POINTS, HULL_TOLERANCE_M = 64, 0.1


@pytest.fixture(scope="module")
def load_in_newton():
    with running_newton() as load:
        yield load


def colliders(layout):
    """(placement, part) of everything that can be touched."""
    for placement in layout.placements:
        for part in asset_of(placement.spec).parts:
            if part.collider is not None:
                yield placement, part


def expected_place(placement, part):
    """A box lies around the middle of its points, everything else at its own origin, such as a wheel's hub."""
    low, high = part.points.min(axis=0), part.points.max(axis=0)
    x, y, z = (low + high) / 2 if part.collider is Collider.BOX else (part.pose or (0.0, 0.0, 0.0))[:3]
    origin = placement.position_m
    world_x, world_z = to_world((x, z), (origin[0], origin[2]), placement.yaw_rad)
    return world_x, origin[1] + y, world_z


def assert_same_kinds_and_places(shapes, expected):
    assert len(shapes) == len(expected)
    # by the mesh's name, too: a wall's concrete in the place of its stripe does not count
    for collider, name in {(part.collider, part.name) for _, part in expected}:
        found = [
            shape["place"]
            for shape in shapes
            if shape["type"] == SHAPES[collider] and shape["path"].endswith(f"/{name}")
        ]
        places = [
            expected_place(placement, part)
            for placement, part in expected
            if part.collider is collider and part.name == name
        ]
        assert_same_places(found, places)


def assert_same_sizes(shapes, expected):
    # what a thing is called without the number of its place: a column on a shared tile has none
    parts = {}
    for placement, part in expected:
        parts.setdefault((placement.name.partition("_")[0], part.name), set()).add(part)
    for shape in shapes:
        owner, _, name = shape["path"].split("/")[-3:]
        meshes = (part.own_points for part in parts[owner.partition("_")[0], name])
        bounds = [(points.min(axis=0), points.max(axis=0)) for points in meshes]
        if shape["type"] == "BOX":
            sizes = [np.sort(high - low) for low, high in bounds]
            assert any(np.allclose(np.sort(shape["size"]), size, atol=2 * BOX_TOLERANCE_M) for size in sizes), shape
        else:
            assert shape["scale"] == [1, 1, 1]
            many = max(len(part.points) for part in parts[owner.partition("_")[0], name]) > HULL_POINTS
            tolerance = HULL_TOLERANCE_M if many else MILLIMETRE
            fits = [np.allclose([shape["low"], shape["high"]], pair, atol=tolerance) for pair in bounds]
            off_m = min(
                float(np.abs(np.array([shape["low"], shape["high"]]) - np.array(pair)).max()) for pair in bounds
            )
            assert any(fits), (shape["path"], off_m)


@pytest.mark.parametrize(("name", "form"), soak_but(1, CASES))
def test_newton_agrees_with_the_layout(name, form, builds, load_in_newton):
    build = builds(REPOSITORY / f"samples/{name}.toml", "usdc", form)
    scene = load_in_newton(build.stage)
    expected = list(colliders(build.garage.layout))
    assert expected
    assert scene["bodies"] == 0
    assert all(shape["collides"] for shape in scene["shapes"])
    assert_same_kinds_and_places(scene["shapes"], expected)
    assert_same_sizes(scene["shapes"], expected)


def test_a_garage_whose_z_points_up_is_loaded_as_any_other(tmp_path, load_in_newton):
    """Newton turns it into its own axes, of which Y points up here."""
    told, found = (
        load_in_newton(
            build(GarageConfig(**{**SETTINGS, "stage": {"up_axis": axis}}), tmp_path / f"{axis}.usdc").stage
        )["shapes"]
        for axis in ("Y", "Z")
    )
    assert len(told) > 100
    assert [(shape["path"], shape["type"]) for shape in found] == [(shape["path"], shape["type"]) for shape in told]
    for name in ("place", "size"):
        assert np.allclose([shape[name] for shape in found], [shape[name] for shape in told], atol=MILLIMETRE), name
