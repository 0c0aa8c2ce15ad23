"""What can be moved weighs what its kind says: newton finds the mass where somebody makes a body of it."""

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdPhysics
from support.newton_reader import needs_newton, running_newton
from support.object_specs import SPECS

import garage2usd
from garage2usd.assets import Collider
from garage2usd.objects import KINDS
from garage2usd.stage import arrangement_of
from garage2usd.stage.prototypes import asset_of

MOVABLE = {"car", "cone", *(kind.name for kind in KINDS if kind.group == "Clutter")}
CONFIG = garage2usd.GarageConfig(
    seed=4,
    site={"height_cells": 5, "width_cells": 5},
    clutter={"open_boots": 10.0}
    | dict.fromkeys(
        ("people", "bicycles", "motorbikes", "trolleys", "prams", "bins", "boxes", "pallets", "bags"), 25.0
    ),
    stage={"texture_quality": "low"},
)


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build(CONFIG, tmp_path_factory.mktemp("masses") / "garage.usdc")


def masses_by_path(built):
    """The mass that its shape gives each object, by the path of its prim."""
    layout = built.garage.layout
    paths = arrangement_of(layout, CONFIG.stage).paths()
    return dict(zip(paths, (place.spec.mass_kg for place in layout.placements), strict=True))


def test_what_can_be_moved_has_a_mass_and_colliders_that_may_move():
    assert {spec.kind.name for spec in SPECS.values() if spec.mass_kg is not None} == MOVABLE
    for spec in SPECS.values():
        if spec.mass_kg is not None:
            # physics engines move no triangle meshes
            touched = [part.collider for part in asset_of(spec).parts if part.collider is not None]
            assert touched
            assert Collider.MESH not in touched


@pytest.mark.soak
@pytest.mark.client
@needs_newton
def test_newton_weighs_each_thing_that_is_made_a_body(built, tmp_path):
    expected = {path: mass for path, mass in masses_by_path(built).items() if mass is not None}
    layer = Sdf.Layer.CreateNew(str(tmp_path / "bodies.usda"))
    layer.subLayerPaths = [str(built.stage)]
    stage = Usd.Stage.Open(layer)
    for path in expected:
        prim = stage.GetPrimAtPath(path)
        assert prim.IsValid(), path
        UsdPhysics.RigidBodyAPI.Apply(prim)
    layer.Save()
    with running_newton() as load:
        moving = load(layer.realPath)
    assert moving["bodies"] == len(expected) > 50
    found = moving["masses_kg"]
    assert found.keys() == expected.keys()
    assert np.allclose([found[path] for path in expected], list(expected.values()), rtol=1e-3)
