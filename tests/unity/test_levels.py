"""The prefab of a garage of several levels: levels as objects, stalls and lanes of all, colliders over the ramps."""

from collections import Counter

import networkx as nx
import numpy as np
import pytest
import trimesh
from support.level_judge import LevelJudge, above, first_hits
from support.places import MILLIMETRE
from support.small_levels import FLOORS_M, SMALL_LEVELS
from support.unity.layer import from_usd, place_of, world_vertices

import garage2usd
from garage2usd.config.outputs import StageConfig, StageForm

HEIGHT_M = 0.05
"""Of the curves of the lane graph over the floor."""
FORMS = [StageForm.INSTANCED, pytest.param(StageForm.NESTED, marks=pytest.mark.soak)]


@pytest.fixture(scope="module", params=FORMS, ids=str)
def imported(request, prefabs, tmp_path_factory):
    config = SMALL_LEVELS.model_copy(update={"stage": StageConfig(form=request.param)})
    built = garage2usd.build(config, tmp_path_factory.mktemp("levels") / "garage.usdc")
    return built, prefabs(built.stage), LevelJudge(built.stage)


def test_levels_are_objects_at_their_floors(imported):
    _, prefab, _ = imported
    places = {item["path"].partition("/Levels/")[2]: place_of(item) for item in prefab.objects}
    for name, floor_m in FLOORS_M.items():
        assert places[name] == pytest.approx([0.0, floor_m, 0.0], abs=MILLIMETRE)
    assert not any("same id" in warning for warning in prefab.found["warnings"])


def test_stalls_are_those_of_all_levels_and_hold_their_cars(imported):
    built, prefab, judge = imported
    numbers = dict(zip(judge.stall_ids, judge.numbers, strict=True))
    found = {item["stall"]["id"]: item["stall"] for item in prefab.objects if "stall" in item}
    expected = built.garage.joined.quads
    assert prefab.found["graph"]["stalls"] == [stall.name for stall in expected]
    assert found.keys() == {stall.name for stall in expected}
    assert len(found) == sum("stall" in item for item in prefab.objects)
    places = {item["path"]: place_of(item) for item in prefab.objects}
    cars = {
        f"{name}/{car.stall}": from_usd(np.add(car.position_m, (0.0, floor_m, 0.0)))
        for (name, floor_m), level in zip(FLOORS_M.items(), built.garage.levels, strict=True)
        for car in level.layout.of_kind("car")
    }
    assert len(cars) > 10
    for stall in expected:
        entry, name = found[stall.name], stall.name.partition("/")[0]
        assert entry["level"] == name
        assert entry["number"] == numbers[stall.name]
        assert entry["node"] == stall.access
        assert entry["centre"][1] == pytest.approx(FLOORS_M[name] + HEIGHT_M, abs=MILLIMETRE)
        assert bool(entry["car"]) == (stall.name in cars)
        if entry["car"]:
            assert places[entry["car"]] == pytest.approx(cars[stall.name], abs=MILLIMETRE)


def test_lanes_lead_over_the_ramps_and_no_other_way(imported, prefab_dump):
    built, prefab, judge = imported
    graph = prefab.found["graph"]
    nodes = np.array([node["position"] for node in graph["nodes"]])
    assert np.allclose(nodes, from_usd(above(judge.places, HEIGHT_M)), atol=MILLIMETRE)
    assert Counter(node["level"] for node in graph["nodes"]) == Counter(judge.levels)
    lanes = nx.DiGraph()
    for start, end in judge.lanes.edges:
        lanes.add_edge(start, end, length_m=float(np.linalg.norm(judge.places[end] - judge.places[start])))
    on = {name: [stall for stall in built.garage.joined.quads if stall.name.startswith(name)] for name in FLOORS_M}
    pairs = [(on["U1"][0], on["U2"][-1]), (on["U2"][-1], on["U1"][0]), (on["U2"][3], on["U1"][40])]
    answers = prefab_dump.ask("ways", built.stage, *(stall.name for pair in pairs for stall in pair))
    for (one, other), answer in zip(pairs, answers, strict=True):
        passed = answer["nodes"]
        assert (passed[0], passed[-1]) == (one.access, other.access)
        driven_m = nx.path_weight(lanes, passed, "length_m")
        expected_m = nx.shortest_path_length(lanes, one.access, other.access, weight="length_m")
        assert driven_m == pytest.approx(expected_m, abs=0.01)


def test_colliders_carry_a_wheel_from_landing_to_landing(imported):
    _, prefab, judge = imported
    ground = []
    for item in prefab.objects:
        if item.get("collider", {}).get("type") == "MeshCollider" and "mesh" in item:
            corners = world_vertices(prefab, item)
            ground.append(corners[np.reshape(prefab.assets[item["mesh"]]["parts"][0], (-1, 3))])
    corners = np.concatenate(ground).reshape(-1, 3)
    mesh = trimesh.Trimesh(corners, np.arange(len(corners)).reshape(-1, 3), process=False, validate=False)
    ramps = judge.ramps()
    assert len(ramps) == 2
    for ramp in ramps:
        runs = np.cumsum([0.0, *np.linalg.norm(np.diff(ramp[:, [0, 2]], axis=0), axis=1)])
        at = np.arange(0.05, runs[-1], 0.5)
        line = from_usd(np.stack([np.interp(at, runs, ramp[:, axis]) for axis in range(3)], axis=1))
        down = np.tile([0.0, -1.0, 0.0], (len(line), 1))
        # the floor has grooves for grip
        assert np.abs(first_hits(mesh, above(line, 1.0), down) - 1.0).max() < 0.02
