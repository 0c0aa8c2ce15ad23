"""The layer of traffic over a stage, composed by USD: agents stand where the tracks have them, while they are there."""

from dataclasses import replace
from enum import StrEnum
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdSemantics, UsdSkel, UsdValidation
from support.hand_made_tracks import hand_made, tracks_of, walker
from support.small_garage import SETTINGS

import garage2usd
from garage2usd.as_built.garage import garage_of_file
from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import body_named
from garage2usd.driving.tracks import AgentState
from garage2usd.scenes.walk import placed_objects
from garage2usd.stage.traffic import write_traffic_layer

RATE = 24.0


@pytest.fixture(scope="module")
def played(tmp_path_factory):
    """The tracks, and the stage with them over it."""
    folder = tmp_path_factory.mktemp("played")
    garage = garage2usd.build(garage2usd.GarageConfig(**SETTINGS), folder / "garage.usdc").stage
    tracks = hand_made(garage_of_file(garage))
    write_traffic_layer(folder / "traffic.usdc", tracks)
    layer = Sdf.Layer.CreateNew(str(folder / "whole.usda"))
    layer.subLayerPaths = ["./traffic.usdc", f"./{Path(garage).name}"]
    layer.Save()
    return tracks, Usd.Stage.Open(str(folder / "whole.usda"))


def prim_of(stage, track):
    return stage.GetPrimAtPath(f"/Garage/Traffic/{track.agent.name}")


def test_agents_are_where_the_tracks_have_them(played):
    tracks, stage = played
    layer = next(layer for layer in stage.GetLayerStack() if layer.identifier.endswith("traffic.usdc"))
    assert layer.timeCodesPerSecond == stage.GetTimeCodesPerSecond() == RATE
    assert tracks.duration_s * RATE <= layer.endTimeCode < tracks.duration_s * RATE + 1
    for track in tracks:
        prim = prim_of(stage, track)
        times = np.linspace(track.time_s[0], track.time_s[-1], 300)
        back = track.agent.rear_axle_m
        for time, (x, y, z, yaw, pitch) in zip(times.tolist(), track.at(times).tolist(), strict=True):
            matrix = UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(time * RATE)
            # the middle of the footprint lies ahead of the origin, the rear axle, along the car's -Z
            assert matrix.Transform((0, 0, -back)) == pytest.approx((x, y, z), abs=2e-3)
            nose = matrix.TransformDir((0, 0, -1))
            level = np.cos(pitch)
            if np.ptp(np.interp(time + np.array((-0.31, 0.31)), track.time_s, track.yaw_rad)) > 0.1:
                continue  # figures turn within 0.6 s
            assert nose == pytest.approx((-np.sin(yaw) * level, np.sin(pitch), -np.cos(yaw) * level), abs=2e-3)


def test_agents_are_visible_while_they_are_there(played):
    tracks, stage = played
    for track in tracks:
        image = UsdGeom.Imageable(prim_of(stage, track))
        first, last = track.time_s[0], track.time_s[-1]
        for time in (0.0, first - 0.1, first + 0.01, (first + last) / 2, last, last + 0.1, tracks.duration_s):
            if 0 <= time <= tracks.duration_s:
                seen = image.ComputeVisibility(round(time * RATE, 6)) != UsdGeom.Tokens.invisible
                assert seen == (first <= time <= last + 1e-6), (track.agent.name, time)


def test_a_car_of_the_stage_moves_with_its_plates_and_no_twin(played):
    tracks, stage = played
    (own,) = (track for track in tracks if track.agent.prim)
    prim = stage.GetPrimAtPath(own.agent.prim)
    assert not prim.IsActive()
    plates = prim.GetPath().ReplaceName(prim.GetName().replace("Car", "NumberPlate"))
    assert not stage.GetPrimAtPath(plates).IsActive()
    others = [path for path in stage.Traverse() if path.GetName().startswith("Car_")]
    assert len(others) == 1  # that which does not move
    box = UsdGeom.BBoxCache(0, ["default"]).ComputeWorldBound(prim_of(stage, own)).ComputeAlignedRange()
    assert box.GetMidpoint()[0] == pytest.approx(own.x_m[0], abs=0.1)
    assert box.GetMidpoint()[2] == pytest.approx(own.z_m[0], abs=0.1)


def test_models_are_drawn_only_by_agents_and_labelled(played):
    tracks, stage = played
    assert not [prim for prim in stage.Traverse() if "Models" in str(prim.GetPath())]
    for track in tracks:
        labels = UsdSemantics.LabelsAPI(prim_of(stage, track), "class").GetLabelsAttr().Get()
        assert list(labels) == [track.agent.kind]
        meshes = [prim for prim in Usd.PrimRange(prim_of(stage, track)) if prim.IsA(UsdGeom.Mesh)]
        assert meshes
        for mesh in meshes:
            (look,) = mesh.GetRelationship("material:binding").GetTargets()
            assert stage.GetPrimAtPath(look).IsA("Material")


def test_wheels_roll_as_far_as_the_car_drives(played):
    tracks, stage = played
    for track in tracks:
        if track.agent.kind == "person":
            continue
        turn = prim_of(stage, track).GetChild("RearLeftWheel").GetAttribute("xformOp:rotateX")
        parked = track.time_s[np.argmax(track.state == AgentState.PARKED)] * RATE
        driven = np.hypot(np.diff(track.x_m), np.diff(track.z_m))[track.time_s[1:] * RATE <= parked + 1e-6]
        forward = np.sign(track.speed_m_s[1:][: len(driven)])
        radius = body_named(track.agent.body).wheel_radius_m
        # the middle of the car moves a little further in bends than its rear axle
        assert -np.radians(turn.Get(parked)) * radius == pytest.approx((driven * forward).sum(), rel=0.03, abs=0.1)


def test_the_layer_is_reproducible_and_refers_to_nothing_beside_it(played, tmp_path):
    tracks, _ = played
    for name in "ab":
        assert write_traffic_layer(tmp_path / f"{name}.usdc", tracks) == ()
    assert (tmp_path / "a.usdc").read_bytes() == (tmp_path / "b.usdc").read_bytes()
    assert set(Sdf.Layer.FindOrOpen(str(tmp_path / "a.usdc")).GetExternalReferences()) == {""}


def test_the_stage_with_traffic_is_read(played):
    _, stage = played
    # at the default time, the beginning: one car comes, one of the stage is an agent, and one stays
    objects = [thing.label for thing in placed_objects(stage, np.eye(4))]
    assert objects.count("car") == 3
    assert objects.count("person") == 0


def test_unknown_bodies_and_odd_names(played, tmp_path):
    tracks, _ = played
    track = tracks.tracks[0]
    strange = replace(track, agent=replace(track.agent, body="tank"))
    with pytest.raises(ConfigError, match=r"tracks\.car_000\.body: got 'tank'; allowed: one of hatchback, "):
        write_traffic_layer(tmp_path / "a.usda", tracks_of(strange))
    assert not (tmp_path / "a.usda").exists()
    odd = [replace(track, agent=replace(track.agent, name=name)) for name in ("7 é", "Models", "7_è")]
    write_traffic_layer(tmp_path / "b.usda", tracks_of(*odd))
    stage = Usd.Stage.Open(str(tmp_path / "b.usda"))
    names = [prim.GetName() for prim in stage.GetPrimAtPath("/Garage/Traffic").GetAllChildren()]
    assert sorted(names) == ["Agent_7__", "Agent_7___", "Models", "Models_"]


def test_usd_validators_find_nothing_in_people(played):
    _, stage = played
    registry = UsdValidation.ValidationRegistry()
    validators = registry.GetOrLoadAllValidators()
    assert any("Skel" in validator.GetMetadata().name for validator in validators)
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    sites = [str(site.GetPrim().GetPath()) for error in errors for site in error.GetSites() if site.GetPrim()]
    assert not [site for site in sites if site.startswith("/Garage/Traffic")]


def test_people_share_models_and_children_are_small(tmp_path):
    heights = {"a": (1.62, ""), "b": (1.62, ""), "c": (1.8, "0"), "d": (1.8, "0"), "e": (1.2, "3")}
    tracks = [walker(name, (0, 0), (3, 1)) for name in heights]
    tracks = [
        replace(track, agent=replace(track.agent, height_m=height, body=body))
        for track, (height, body) in zip(tracks, heights.values(), strict=True)
    ]
    write_traffic_layer(tmp_path / "people.usda", tracks_of(*tracks))
    stage = Usd.Stage.CreateNew(str(tmp_path / "whole.usda"))
    stage.DefinePrim("/Garage", "Xform")
    stage.GetRootLayer().subLayerPaths.append("./people.usda")
    models = {}
    for name, (height, _) in heights.items():
        figure = stage.GetPrimAtPath(f"/Garage/Traffic/{name}/Figure")
        assert figure.IsA(UsdSkel.Root)
        (model,) = figure.GetMetadata("references").GetAddedOrExplicitItems()
        models[name] = str(model.primPath)
        box = UsdGeom.BBoxCache(0, ["default"]).ComputeWorldBound(figure.GetChild("Geom")).ComputeAlignedRange()
        assert box.GetSize()[1] == pytest.approx(height, rel=0.03)
    assert models["c"] == models["d"]
    assert models["e"].endswith("Child_3")
    assert len({*models.values()}) >= 3


def test_an_agent_of_another_kind_is_an_object_or_a_block_of_its_size(played, tmp_path):
    tracks, _ = played

    class Kinds(StrEnum):
        TROLLEY = "shopping_trolley"
        ROBOT = "robot"

    odd = [
        replace(tracks.tracks[0], agent=replace(tracks.tracks[0].agent, name=kind.value, kind=kind, body=""))
        for kind in Kinds
    ]
    write_traffic_layer(tmp_path / "odd.usda", tracks_of(*odd))
    stage = Usd.Stage.CreateNew(str(tmp_path / "whole.usda"))
    stage.DefinePrim("/Garage", "Xform")
    stage.GetRootLayer().subLayerPaths.append("./odd.usda")
    sizes = {}
    for kind in Kinds:
        body = stage.GetPrimAtPath(f"/Garage/Traffic/{kind.value}/Body")
        sizes[kind] = UsdGeom.BBoxCache(0, ["default"]).ComputeUntransformedBound(body).GetRange().GetSize()
    agent = tracks.tracks[0].agent
    assert sizes[Kinds.ROBOT] == pytest.approx((agent.width_m, agent.height_m, agent.length_m), abs=1e-4)
    assert sizes[Kinds.TROLLEY][1] == pytest.approx(1.0, abs=0.05)
