"""What checks, viewer and render take from a stage stands where UsdGeom computes it, on stages of others too."""

import warnings
from collections import Counter

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade
from support.foreign_stages import TRAPS, installed_stages

from garage2usd.as_built.contents import read_contents as scene_of_checks
from garage2usd.render.drawn_prims import read_drawn_prims as scene_of_render
from garage2usd.scenes.values import metres_y_up
from garage2usd.scenes.walk import placed_objects
from garage2usd.view.viewer.reading import Looks

STAGES = {**installed_stages(), **TRAPS}
TYPES = ("Mesh", "Cube", "Sphere", "Cylinder", "Cone", "Capsule", "Plane")
NOW = Usd.TimeCode.EarliestTime()
DRAWN = {UsdGeom.Tokens.default_, UsdGeom.Tokens.render}


def places_of_pxr(stage, types=TYPES):
    """The place of every prim of some types that is drawn, by UsdGeom alone: metres, Y up, points as rows."""
    cache, to_metres, found = UsdGeom.XformCache(NOW), metres_y_up(stage), []
    prims = iter(Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies(Usd.PrimDefaultPredicate)))
    for prim in prims:
        if prim.IsA(UsdGeom.PointInstancer):
            prims.PruneChildren()
            if is_drawn(prim):
                found += [place @ to_metres for place in places_of_points(prim, cache)]
        elif is_solid(prim, types) and is_drawn(prim):
            found.append(np.array(cache.GetLocalToWorldTransform(prim)) @ to_metres)
    return found


def places_of_points(prim, cache):
    instancer = UsdGeom.PointInstancer(prim)
    numbers = instancer.GetProtoIndicesAttr().Get(NOW)
    moves = instancer.ComputeInstanceTransformsAtTime(
        NOW, NOW, UsdGeom.PointInstancer.IncludeProtoXform, UsdGeom.PointInstancer.IgnoreMask
    )
    mask = instancer.ComputeMaskAtTime(NOW) or [True] * len(numbers)
    roots = [prim.GetStage().GetPrimAtPath(path) for path in instancer.GetPrototypesRel().GetForwardedTargets()]
    for number, move, shown in zip(numbers, moves, mask, strict=True):
        below = Usd.PrimRange(roots[number], Usd.TraverseInstanceProxies(Usd.PrimIsActive & Usd.PrimIsLoaded))
        for part in below if shown else ():
            if is_solid(part):
                within, resets = cache.ComputeRelativeTransform(part, roots[number])
                assert not resets
                yield np.array(within) @ np.array(move) @ np.array(cache.GetLocalToWorldTransform(prim))


def is_solid(prim, types=TYPES):
    if prim.GetTypeName() != "Mesh":
        return prim.GetTypeName() in types
    mesh = UsdGeom.Mesh(prim)
    points = mesh.GetPointsAttr().Get(NOW) or ()
    counts, indices = mesh.GetFaceVertexCountsAttr().Get(NOW), mesh.GetFaceVertexIndicesAttr().Get(NOW)
    return bool(len(points) and counts and UsdGeom.Mesh.ValidateTopology(indices, counts, len(points))[0])


def is_drawn(prim):
    imageable = UsdGeom.Imageable(prim)
    return imageable.ComputePurpose() in DRAWN and imageable.ComputeVisibility(NOW) != UsdGeom.Tokens.invisible


def counted(places):
    return Counter(tuple(np.round(place.ravel(), 4) + 0.0) for place in places)


@pytest.fixture(params=STAGES)
def stage(request):
    source = STAGES[request.param]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of others' stages
        if callable(source):
            made = Usd.Stage.CreateInMemory()
            UsdGeom.SetStageMetersPerUnit(made, 1.0)
            UsdGeom.SetStageUpAxis(made, UsdGeom.Tokens.y)
            source(made)
            yield made
        else:
            yield Usd.Stage.Open(str(source))


def test_there_are_thirty_stages_of_others_with_something_to_place():
    assert sum(bool(places_of_pxr(Usd.Stage.Open(str(path)))) for path in installed_stages().values()) >= 30


def test_all_that_is_drawn_stands_where_usd_computes(stage):
    # checks take the box around what they do not take apart
    boxed = counted(places_of_pxr(stage, (*TYPES, "TetMesh")))
    of_checks = [body.matrix for thing in scene_of_checks(stage).things for body in thing.bodies]
    assert counted(of_checks) == boxed
    expected = counted(places_of_pxr(stage))
    looks = Looks()
    of_viewer = [
        piece.matrix @ placed.matrix
        for placed in looks.objects(stage, metres_y_up(stage))
        for piece in looks.shapes.values[placed.shape].pieces
    ]
    assert counted(of_viewer).keys() == expected.keys()  # a mesh has a part for each of its materials
    scene = scene_of_render(stage, {})
    turn = metres_y_up(stage)
    turn[:3, :3] /= UsdGeom.GetStageMetersPerUnit(stage)
    solid = [is_solid(stage.GetPrimAtPath(path)) for path in scene.shapes]
    of_render = [
        place.T @ turn for number, place in zip(scene.shape.tolist(), scene.to_world, strict=True) if solid[number]
    ]
    assert counted(of_render) == expected


def test_an_instancer_that_is_its_own_prototype_ends():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.Cube.Define(stage, "/World/Cube")
    points = UsdGeom.PointInstancer.Define(stage, "/World/Points")
    points.CreatePrototypesRel().SetTargets(["/World", "/World/Points"])
    points.CreateProtoIndicesAttr([0, 1])
    points.CreatePositionsAttr([(1, 0, 0), (2, 0, 0)])
    found = placed_objects(stage, np.eye(4))
    assert [placed.path for placed in found][:2] == ["/World/Cube", "/World/Points[0]"]


def test_what_is_below_a_material_is_not_drawn():
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.Cube.Define(stage, "/Drawn")
    UsdShade.Material.Define(stage, "/Paint")
    UsdGeom.Cube.Define(stage, "/Paint/Cube")
    assert [found.path for found in placed_objects(stage, np.eye(4))] == ["/Drawn"]
