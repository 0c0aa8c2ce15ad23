"""Walkers in USD: as USD's own skinning and validators see them."""

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdSkel, UsdValidation

from garage2usd.assets.figures import skinned_figure
from garage2usd.assets.gait import walked
from garage2usd.objects.person import PEOPLE
from garage2usd.stage.walkers import Walker, write_walkers

FRAMES = 72


def a_walker(name="Person_1", number=9):
    """A person who walks around a bend at 24 frames per second, 0.2 m above the origin."""
    figure, times = PEOPLE[number], np.arange(FRAMES) / 24
    yaws = 0.3 + 0.4 * times
    steps = np.column_stack([np.sin(yaws), np.cos(yaws)]) * 1.3 / 24
    ground = np.cumsum(steps, axis=0)
    places = np.column_stack([ground[:, 0], np.full(FRAMES, 0.2), ground[:, 1]])
    return Walker(name, figure, places, yaws, walked(skinned_figure(figure).skeleton, times, ground, yaws))


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    folder = tmp_path_factory.mktemp("walkers")
    write_walkers(folder / "walkers.usdc", [a_walker(), a_walker("Person_2", 3)])
    stage = Usd.Stage.CreateNew(str(folder / "garage.usda"))
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Garage").GetPrim())
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    stage.GetRootLayer().subLayerPaths.append("./walkers.usdc")
    stage.Save()
    return stage


def skinned_points(stage, mesh, frame):
    """World positions of a mesh's points by UsdSkel."""
    root = UsdSkel.Root(mesh.GetParent().GetParent())
    cache = UsdSkel.Cache()
    cache.Populate(root, Usd.PrimDefaultPredicate)
    query = cache.GetSkelQuery(UsdSkel.Skeleton(root.GetPrim().GetChild("Skeleton")))
    points = UsdGeom.Mesh(mesh).GetPointsAttr().Get()
    assert cache.GetSkinningQuery(mesh).ComputeSkinnedPoints(query.ComputeSkinningTransforms(frame), points, frame)
    to_world = UsdGeom.Xformable(root).ComputeLocalToWorldTransform(frame)
    return np.array([to_world.Transform(point) for point in points])


@pytest.mark.parametrize("frame", [0, 31, 71])
def test_usd_moves_the_skin_as_the_gait_does(stage, frame):
    walker = a_walker()
    skin = skinned_figure(walker.figure)
    posed = skin.posed_m(walker.motion.turns[frame], walker.motion.hips_m[frame])
    cos, sin = np.cos(walker.yaws_rad[frame]), np.sin(walker.yaws_rad[frame])
    turn = np.array([(cos, 0.0, sin), (0.0, 1.0, 0.0), (-sin, 0.0, cos)])
    for part, points in zip(skin.parts, posed, strict=True):
        mesh = stage.GetPrimAtPath(f"/Garage/Walkers/Person_1/Geom/{part.name}")
        expected = points @ turn.T + walker.places_m[frame]
        assert np.abs(skinned_points(stage, mesh, frame) - expected).max() < 2e-4, part.name


def test_feet_stay_on_the_floor_in_usd(stage):
    shoes = stage.GetPrimAtPath("/Garage/Walkers/Person_2/Geom/Shoes")
    for frame in range(0, FRAMES, 6):
        assert abs(skinned_points(stage, shoes, frame)[:, 1].min() - 0.2) < 0.003


def test_usd_validators_find_nothing(stage):
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    names = {validator.GetMetadata().name for validator in registry.GetOrLoadAllValidators()}
    assert any("Skel" in name for name in names)
    assert not [error.GetMessage() for error in context.Validate(stage)]


def test_usd_validators_see_a_skin_outside_of_a_person(stage):
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    wrong = Usd.Stage.Open(stage.Flatten())
    UsdSkel.BindingAPI.Apply(wrong.DefinePrim("/Garage/Elsewhere", "Mesh"))
    assert any("SkelRoot" in error.GetMessage() for error in context.Validate(wrong))


def test_the_same_walkers_give_the_same_bytes(tmp_path):
    for name in ("a.usdc", "b.usdc"):
        write_walkers(tmp_path / name, [a_walker()])
    assert (tmp_path / "a.usdc").read_bytes() == (tmp_path / "b.usdc").read_bytes()
