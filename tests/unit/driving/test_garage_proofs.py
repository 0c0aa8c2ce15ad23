import json
import math
import re
from collections import Counter
from dataclasses import replace

import networkx as nx
import numpy as np
import pytest
import shapely
from pxr import Usd, UsdGeom
from support.driving_simulation import World, drive_stalls, ground
from support.sample_files import REPOSITORY
from support.soak import soak_but

import garage2usd
from garage2usd.common.errors import ConfigError
from garage2usd.driving import DesignCar, Manoeuvre, Obstacles, prove_garage, prove_stalls
from garage2usd.driving.layout_garage import layout_garage, object_name
from garage2usd.driving.proof import lane_poses
from garage2usd.driving.trajectory import write_witness
from garage2usd.garage import StallUse
from garage2usd.garage_sources import check
from garage2usd.layout import lay_out
from garage2usd.stage.curves import write_driving_layer
from garage2usd.structure.grid import Cell

DRAWN = """
##########
E====....#
#..=.....X
#..=======
#..=.....#
#..=.....#
##########
"""


def drawn(*, structure=DRAWN, **sections):
    sections = {"fittings": {"no_parking_sign_rate": 0.0}, **sections}
    return garage2usd.generate(garage2usd.GarageConfig(site={"structure": structure}, **sections))


def proofs_of(garage, **settings):
    return prove_stalls(garage.layout, **settings)


def named(arcs, garage):
    """Arcs by (row, col) of their ends."""
    squares = list(garage.graph.number_of)
    return {(squares[one], squares[other]) for one, other in arcs}


@pytest.fixture(scope="module")
def garage():
    return drawn()


@pytest.fixture(scope="module")
def proofs(garage):
    return proofs_of(garage)


@pytest.mark.parametrize("count", soak_but(1, [30, 150]))
def test_a_simulated_car_drives_stalls_of_default_garages_as_claimed(count):
    driven, faults, unproven = drive_stalls(count, seed=400)
    assert (driven, faults, unproven) == (count, [], [])


def test_the_simulation_sees_ways_that_are_not_as_claimed(garage, proofs):
    """The check of the check: each way moved by half a metre, or with its first move left out, is found at fault."""
    world = World(garage)
    for stall, proof in zip([s for s in garage.layout.stalls if s.use.takes_cars], proofs, strict=True):
        start, moves = proof.way_in.start, proof.way_in.moves
        aside = Manoeuvre(type(start)(start.x_m + 0.5, start.z_m + 0.5, start.yaw_rad), moves, 0.0)
        short = Manoeuvre(start, moves[1:], 0.0)
        for way in (aside, short):
            damaged = type(proof)(proof.stall, proof.nose, way, proof.way_out, proof.is_full, proof.backs_out)
            assert world.faults(stall, damaged), proof.stall


def test_every_stall_that_takes_a_car_has_its_proof(garage, proofs):
    assert [proof.stall for proof in proofs] == [s.name for s in garage.layout.stalls if s.use.takes_cars]
    assert all(proof.is_proven and proof.is_full for proof in proofs)


def test_what_a_car_could_touch_is_held_by_its_outline():
    garage = garage2usd.generate(garage2usd.load_config(REPOSITORY / "samples" / "irregular.toml"))
    obstacles = layout_garage(garage.layout).standing
    outline = {
        name: shapely.union_all(
            [shapely.MultiPoint(piece).convex_hull for piece in obstacles.pieces[obstacles.owner == number]]
        )
        for number, name in enumerate(obstacles.names)
    }
    kinds = set()
    for place in garage.layout.placements:
        if object_name(place) in outline:
            beyond = ground(place).difference(outline[object_name(place)].buffer(0.001, join_style="mitre"))
            assert beyond.area < 1e-6, (place.name, beyond.bounds)
            kinds.add(place.kind)
    world = {place.kind for place, _ in World(garage).items if hasattr(place, "spec")}
    assert kinds == world


def test_directions_are_those_of_driving_on_from_an_entrance_and_to_an_exit():
    for seed in range(3):
        made = garage2usd.generate(seed=seed)
        cells, graph = made.plan.structure.cells, made.graph.graph
        roads = nx.DiGraph(graph)
        roads.remove_edges_from([(a, b) for a, b in roads.edges if cells[a] == Cell.EXIT or cells[b] == Cell.ENTRANCE])
        lines = nx.line_graph(roads)
        lines.remove_edges_from([(a, b) for a, b in lines.edges if a[0] == b[1] or cells[a[1]] != Cell.LANE])
        starts = [edge for edge in lines if cells[edge[0]] == Cell.ENTRANCE]
        ends = [edge for edge in lines if cells[edge[1]] == Cell.EXIT]
        lanes = made.graph.lanes
        assert named(lanes.arriving, made) == {b for b in lines if any(nx.has_path(lines, a, b) for a in starts)}
        assert named(lanes.leaving, made) == {a for a in lines if any(nx.has_path(lines, a, b) for b in ends)}


def test_a_dead_end_is_backed_out_of_only_where_there_is_no_other_way(garage, proofs):
    backing = named(layout_garage(garage.layout).backing, garage)
    assert {((3, 3), (4, 3)), ((4, 3), (5, 3))} <= backing
    assert not {((4, 3), (3, 3)), ((5, 3), (4, 3))} & backing
    for proof in proofs:
        if not proof.backs_out:
            end = proof.way_out.end
            assert World(garage).leads_to_exit((end.x_m, end.z_m, end.yaw_rad))


def test_lane_poses_keep_the_whole_car_on_the_carriageway(garage):
    car, setback_m = DesignCar(), garage.config.bay.carriageway_setback_m
    lanes, numbers = garage.graph.lanes, list(garage.graph.number_of)
    x, z = garage.plan.structure.column_edges_m, garage.plan.structure.row_edges_m
    for edge in lanes.near(numbers.index((3, 3)), 2):
        squares = [shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in (numbers[end] for end in edge)]
        for pose in lane_poses(lanes, [edge], car):
            along = np.array([-math.sin(pose.yaw_rad), -math.cos(pose.yaw_rad)])
            across = np.array([along[1], -along[0]])
            for end in (-0.5, 0.5):
                for side in (-0.5, 0.5):
                    middle = np.array(pose.middle_m) + end * pose.length_m * along + side * pose.width_m * across
                    corners = car.corners(car.centred(tuple(middle.tolist()), pose.yaw_rad))
                    body = shapely.Polygon(corners)
                    assert shapely.union_all(squares).buffer(1e-6).contains(body)
                    sides = body.buffer(setback_m - 1e-6, cap_style="square", join_style="mitre")
                    wide = sides.intersection(body.buffer(9, join_style="mitre")).bounds
                    low, high = (wide[1], wide[3]) if abs(along[0]) > 0.5 else (wide[0], wide[2])
                    box = shapely.union_all(squares).bounds
                    least, most = (box[1], box[3]) if abs(along[0]) > 0.5 else (box[0], box[2])
                    assert least <= low
                    assert high <= most


NARROW = {
    "structure": """
#######
E====.#
#..=..X
#..====
#..=..#
#######
""",
    "bay": {"row_depths_m": [8.1, 8.1, 5.4, 3.2, 5.4, 8.1], "column_widths_m": 8.1},
}


@pytest.fixture(scope="module")
def kept():
    """The narrow garage with the stalls that no car gets into."""
    return drawn(**NARROW, plan={"unreachable_stalls": "keep"})


@pytest.fixture(scope="module")
def failures(kept):
    """Proofs that failed in the narrow garage."""
    failed = [proof for proof in proofs_of(kept) if not proof.is_proven]
    assert failed
    return failed


@pytest.fixture(scope="module")
def dropped():
    """The narrow garage without the stalls that no car gets into."""
    return drawn(**NARROW, plan={"unreachable_stalls": "drop"})


def test_the_plan_of_a_garage_that_fails_is_kept(tmp_path):
    config = garage2usd.GarageConfig(site={"structure": NARROW["structure"]}, bay=NARROW["bay"])
    with pytest.raises(ConfigError) as caught:
        garage2usd.build(config, tmp_path / "a" / "g.usdz")
    kept = [tmp_path / "a" / f"g_failed_plan.{suffix}" for suffix in ("json", "png")]
    assert [*caught.value.kept] == sorted((tmp_path / "a").iterdir()) == kept
    matrices = json.loads(kept[0].read_text())
    assert matrices["S"] == NARROW["structure"].split()
    assert matrices["C"] == NARROW["bay"]["row_depths_m"]
    assert "aisle-width" in {finding.rule for finding in check(kept[0])[0]}


def test_a_lane_too_narrow_for_its_stalls_is_refused_with_the_stalls_unless_told_otherwise(failures):
    with pytest.raises(ConfigError) as caught:
        drawn(**NARROW)
    assert caught.value.field == "bay.row_depths_m"
    named = set(re.findall(r"Stall_r\d+_c\d+_\d+", str(caught.value)))
    assert named
    assert named <= {proof.stall for proof in failures}
    assert "their aisles are 2.50 m clear" in str(caught.value)


def test_a_lane_too_narrow_for_its_stalls_is_named_with_what_is_in_the_way(kept, failures):
    stalls = {stall.name: stall for stall in kept.layout.stalls}
    assert {stalls[proof.stall].access_square[0] for proof in failures} == {3}
    for proof in failures:
        assert (proof.nose, proof.way_in, proof.way_out, proof.is_single_cause) == (None, None, None, True)
        row, col = stalls[proof.stall].square
        beside = {f"Column_r{row + down:02d}_c{col + right:02d}" for down in (0, 1) for right in (0, 1)}
        cars = {f"r{r:02d}_c{c:02d}/Car_{n}" for r in (2, 4) for c in (col - 1, col, col + 1) for n in (1, 2, 3)}
        stops = {name.replace("Car", "WheelStop") for name in cars}
        assert set(proof.touched) <= beside | cars | stops


def test_stalls_without_ways_are_marked_and_hold_nothing(kept, failures):
    marked = drawn(**NARROW, plan={"unreachable_stalls": "mark"})
    unreachable = [stall for stall in marked.layout.stalls if stall.use is StallUse.UNREACHABLE]
    assert {proof.stall for proof in failures} <= {stall.name for stall in unreachable}
    assert len(marked.layout.stalls) == len(kept.layout.stalls)
    assert all(proof.is_proven for proof in proofs_of(marked))
    held = {(place.stall, place.kind) for place in marked.layout.placements}
    for stall in unreachable:
        assert {kind for name, kind in held if name == stall.name} == {"stall"}
        assert not stall.number


def test_stalls_without_ways_are_left_out_and_the_floor_there_is_closed(kept, failures, dropped):
    assert {proof.stall for proof in failures} <= dropped.layout.unreachable
    names = {stall.name for stall in kept.layout.stalls}
    assert {stall.name for stall in dropped.layout.stalls} == names - dropped.layout.unreachable
    assert all(proof.is_proven for proof in proofs_of(dropped))
    stalls_on = Counter(stall.square for stall in dropped.layout.stalls)
    for floor in dropped.layout.of_kind("floor"):
        assert len(floor.spec.openings) == stalls_on[floor.square]
    assert len(dropped.layout.of_kind("stall")) == len(dropped.layout.stalls)


def test_a_garage_without_any_stall_that_cars_get_into_is_refused(kept, dropped):
    names = {stall.name for stall in kept.layout.stalls}
    with pytest.raises(ConfigError, match=r"plan.unreachable_stalls: got 'drop'; allowed: a plan that leaves a stall"):
        lay_out(dropped.layout.structure, dropped.graph, dropped.config, unreachable=names)


@pytest.mark.parametrize("choice", soak_but(["mark"], ["mark", "drop"]))
def test_a_build_says_what_it_marked_or_left_out_and_passes_the_proof(choice, tmp_path):
    site = {"structure": NARROW["structure"]}
    config = garage2usd.GarageConfig(site=site, bay=NARROW["bay"], plan={"unreachable_stalls": choice})
    built = garage2usd.build(config, tmp_path / "garage.usdc")
    told = json.loads(built.report.read_text())
    assert set(told["levels"][0]["unreachable_stalls"]) == built.garage.layout.unreachable != set()
    for path in (built.stage, built.report):
        found = {finding.rule for finding in check(path)[0]}
        assert "aisle-width" in found
        assert not {"swept-path", "report-stalls", "plan-refused"} & found


@pytest.mark.parametrize("choice", ["mark", "drop"])
def test_where_all_is_proven_nothing_is_marked_or_left_out(choice, garage):
    proven = drawn(plan={"unreachable_stalls": choice})
    assert list(proven.layout.stalls) == list(garage.layout.stalls)
    assert list(proven.layout.placements) == list(garage.layout.placements)
    assert not proven.layout.unreachable


def test_a_single_cause_is_named():
    """A sign on a square at the end of a row of stalls is far from all; a column set before a mouth is the cause."""
    garage = drawn()
    proofs = proofs_of(garage)
    stall = next(s for s in garage.layout.stalls if s.name == proofs[4].stall)
    x, z = np.mean(stall.corners_m()[:2], axis=0)
    pillar = Obstacles.of([("new pillar", shapely.box(x - 0.3, z - 0.3, x + 0.3, z + 0.3))])
    made = layout_garage(garage.layout)
    made = replace(made, standing=made.standing.joined(pillar))
    (proof,) = prove_garage(made, [s for s in made.stalls if s.name == stall.name])
    assert (proof.is_proven, proof.touched, proof.is_single_cause) == (False, ("new pillar",), True)
    assert -1.4 < proof.clearance_m < 0.05


def turned(garage, yaw_rad):
    """The same plain garage, turned about the origin."""
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)

    def at(point):
        return point[0] * cos + point[1] * sin, -point[0] * sin + point[1] * cos

    stalls = [replace(stall, corners=tuple(map(at, stall.corners))) for stall in garage.stalls]
    nodes = [replace(node, position=at(node.position)) for node in garage.lanes.nodes]
    standing = garage.standing.seen_from(0.0, 0.0, -yaw_rad)
    lanes = replace(garage.lanes, nodes=tuple(nodes))
    return replace(garage, stalls=tuple(stalls), lanes=lanes, standing=standing)


@pytest.mark.parametrize("yaw_rad", [1e-6, 0.5])
def test_a_garage_that_is_turned_is_driven_alike(garage, proofs, yaw_rad):
    """Squares keep their sides, which only matter where they are shorter than a car."""
    made = turned(layout_garage(garage.layout), yaw_rad)
    for proof, other in zip(proofs, prove_garage(made), strict=True):
        assert (other.stall, other.is_proven, other.is_full) == (proof.stall, True, True)
        assert other.way_out.clearance_m >= 0.05


def test_the_witness_says_in_json_what_was_proven(proofs, tmp_path):
    write_witness(tmp_path / "ways.json", proofs)
    document = json.loads((tmp_path / "ways.json").read_text())
    assert document["car"]["turning_radius_m"] == 6.0
    for proof, stall in zip(proofs, document["stalls"], strict=True):
        assert (stall["name"], stall["proven"], stall["nose"]) == (proof.stall, True, str(proof.nose))
        for name, way in (("in", proof.way_in), ("out", proof.way_out)):
            poses = np.array(stall[name]["poses"])
            assert poses[-1, 0] == pytest.approx(way.length_m, abs=1e-5)
            assert poses[-1, 1:3] == pytest.approx((way.end.x_m, way.end.z_m), abs=1e-5)
            # each pose follows from the one before it by its gear and curvature
            turned = np.diff(poses[:, 3]) - np.diff(poses[:, 0]) * poses[:-1, 4] * poses[:-1, 5]
            assert np.abs(np.remainder(turned + np.pi, math.tau) - np.pi).max() < 1e-4


def test_the_layer_of_the_ways_goes_over_the_stage(proofs, tmp_path):
    write_driving_layer(tmp_path / "ways.usdc", proofs)
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.Xform.Define(stage, "/Garage")
    stage.GetRootLayer().subLayerPaths.append(str(tmp_path / "ways.usdc"))
    for name, ways in (("In", [p.way_in for p in proofs]), ("Out", [p.way_out for p in proofs])):
        curves = UsdGeom.BasisCurves(stage.GetPrimAtPath(f"/Garage/Ways/{name}"))
        assert curves.ComputePurpose() == UsdGeom.Tokens.guide
        counts = np.array(curves.GetCurveVertexCountsAttr().Get())
        points = np.array(curves.GetPointsAttr().Get())
        assert counts.sum() == len(points) == len(curves.GetPrim().GetAttribute("garage:way:yaw").Get())
        ends = points[np.cumsum(counts) - 1][:, [0, 2]]
        assert ends == pytest.approx(np.array([(way.end.x_m, way.end.z_m) for way in ways]), abs=1e-4)
        assert list(curves.GetPrim().GetAttribute("garage:way:stall").Get()) == [p.stall for p in proofs]
