"""The lane graph and the stalls of a prefab against the layout, and its answers against networkx."""

import itertools

import networkx as nx
import numpy as np
import pytest
from support import misparked_garage
from support.sample_files import SAMPLES
from support.unity.layer import from_usd, place_of
from support.unity.reader import PACKAGE

from garage2usd import GarageConfig, build
from garage2usd.structure.stalls import Edge

SAMPLE = next(sample for sample in SAMPLES if sample.stem == "irregular")
FORMS = [("usdz", None), ("usda", None), ("usdz", "nested"), ("usdc", "flat")]
"""The first, whose stages read as the others do, is enough for `make test`."""
HEIGHT_M = 0.05
PAIRS = 150


@pytest.fixture(
    scope="module", params=[FORMS[0], *(pytest.param(form, marks=pytest.mark.soak) for form in FORMS[1:])], ids=str
)
def imported(request, prefabs, builds):
    build = builds(SAMPLE, *request.param)
    return build, prefabs(build.stage)


def world(points_m) -> np.ndarray:
    """(x, z) of the layout at the height of the curves, in Unity's axes."""
    points = np.asarray(points_m, dtype=float)
    return from_usd(np.stack([points[..., 0], np.full(points.shape[:-1], HEIGHT_M), points[..., 1]], axis=-1))


def ways(graph) -> nx.DiGraph:
    """The lane graph with the directions that cars may take: out of entrances and into exits only."""
    made = nx.DiGraph()
    made.add_nodes_from(graph.graph.nodes)
    for one, other, length_m in graph.graph.edges(data="length_m"):
        for start, end in ((one, other), (other, one)):
            if graph.kind(end).value != "entrance" and graph.kind(start).value != "exit":
                made.add_edge(start, end, length_m=length_m)
    return made


def test_nodes_and_edges(imported):
    build, prefab = imported
    graph = build.garage.graph
    nodes, edges = prefab.found["graph"]["nodes"], prefab.found["graph"]["edges"]
    squares = [tuple(node["square"]) for node in nodes]
    assert sorted(squares) == sorted(graph.graph.nodes)
    for node, square in zip(nodes, squares, strict=True):
        own = graph.graph.nodes[square]
        assert node["kind"] == str(graph.kind(square))
        assert node["position"] == pytest.approx(world((own["x_m"], own["z_m"])), abs=1e-4)
        assert all(0 < width < 9 for width in node["widths"])
    expected = ways(graph)
    found = nx.DiGraph()
    for edge in edges:
        start, end = squares[edge["from"]], squares[edge["to"]]
        found.add_edge(start, end)
        assert expected.edges[start, end]["length_m"] == pytest.approx(edge["length"], abs=1e-4)
        if not edge["isOneWay"]:
            found.add_edge(end, start)
    assert set(found.edges) == set(expected.edges)


def test_stalls(imported):
    build, prefab = imported
    stalls = {item["stall"]["id"]: item["stall"] for item in prefab.objects if "stall" in item}
    assert prefab.found["graph"]["stalls"] == [stall.name for stall in build.garage.layout.stalls]
    assert stalls.keys() == {stall.name for stall in build.garage.layout.stalls}
    squares = [tuple(node["square"]) for node in prefab.found["graph"]["nodes"]]
    cars = {car.stall: car for car in build.garage.layout.of_kind("car")}
    places = {item["path"]: place_of(item) for item in prefab.objects}
    edges = {Edge.UP: "up", Edge.DOWN: "down", Edge.LEFT: "left", Edge.RIGHT: "right"}
    for stall in build.garage.layout.stalls:
        found = stalls[stall.name]
        assert found["number"] == stall.number
        assert found["type"] == str(stall.stall_type)
        assert found["use"] == str(stall.use)
        assert found["edge"] == edges[stall.edge]
        assert tuple(found["square"]) == stall.square
        assert squares[found["node"]] == stall.access_square
        assert np.allclose(np.reshape(found["corners"], (4, 3)), world(stall.corners_m()), atol=1e-3)
        assert np.allclose(found["centre"], world(stall.centre_m), atol=1e-3)
        car = cars.get(stall.name)
        assert found["occupied"] is (car is not None)
        if car is None:
            assert not found["car"]
        else:
            assert np.allclose(places[found["car"]], from_usd(np.array(car.position_m)), atol=1e-3)
        # from the mouth inwards, as a car does that is parked nose-in
        inwards = np.subtract(found["centre"], found["mouth"])
        assert np.allclose(found["forward"], inwards / np.linalg.norm(inwards), atol=1e-3)


def test_stalls_that_misparked_cars_block_are_taken(prefabs, tmp_path):
    built = build(GarageConfig(**misparked_garage.SETTINGS), tmp_path / "garage.usdc")
    layout = built.garage.layout
    stalls = [item["stall"] for item in prefabs(built.stage).objects if "stall" in item]
    assert {stall["id"] for stall in stalls if stall["occupied"]} == misparked_garage.taken_in(layout)
    assert layout.blocked
    assert not any(stall["car"] for stall in stalls if stall["id"] in layout.blocked)


def test_ways_between_stalls_are_the_shortest(imported, prefab_dump):
    build, prefab = imported
    graph, layout = build.garage.graph, build.garage.layout
    lanes = ways(graph)
    squares = [tuple(node["square"]) for node in prefab.found["graph"]["nodes"]]
    stalls = {stall.name: stall for stall in layout.stalls}
    chosen = np.random.default_rng(1).choice(sorted(stalls), (PAIRS, 2))
    answers = prefab_dump.ask("ways", build.stage, *chosen.ravel())
    assert len(answers) == PAIRS
    for (first, last), answer in zip(chosen, answers, strict=True):
        one, other = stalls[first], stalls[last]
        expected_m = nx.shortest_path_length(lanes, one.access_square, other.access_square, weight="length_m")
        passed = [squares[node] for node in answer["nodes"]]
        assert (passed[0], passed[-1]) == (one.access_square, other.access_square)
        assert sum(lanes.edges[step]["length_m"] for step in itertools.pairwise(passed)) == pytest.approx(expected_m)
        corners = [world(stall.corners_m()) for stall in (one, other)]
        mouths = [(corner[0] + corner[1]) / 2 for corner in corners]
        nodes = [world((graph.graph.nodes[square]["x_m"], graph.graph.nodes[square]["z_m"])) for square in passed]
        way = [world(one.centre_m), mouths[0], *nodes, mouths[1], world(other.centre_m)]
        lengths_m = np.linalg.norm(np.diff(way, axis=0), axis=1)
        assert answer["length"] == pytest.approx(lengths_m.sum(), abs=0.01)
        assert np.allclose(answer["start"], way[0], atol=1e-3)
        assert np.allclose(answer["end"], way[-1], atol=1e-3)
        assert np.allclose(answer["startDirection"], (way[1] - way[0]) / lengths_m[0], atol=1e-3)


def test_stalls_are_found_by_their_painted_numbers(imported, prefab_dump):
    build, _ = imported
    one, other = [stall for stall in build.garage.layout.stalls if stall.number][3:5]
    (answer,) = prefab_dump.ask("ways", build.stage, one.number, other.number)
    assert (answer["from"], answer["to"]) == (one.name, other.name)


def test_the_nearest_lane(imported, prefab_dump):
    build, prefab = imported
    nodes, edges = prefab.found["graph"]["nodes"], prefab.found["graph"]["edges"]
    starts, ends = (np.array([nodes[edge[key]]["position"] for edge in edges]) for key in ("from", "to"))
    places = np.random.default_rng(2).uniform([-10, -5, -110], [140, 5, 10], (100, 3))
    answers = prefab_dump.ask("near", build.stage, *places.ravel())
    for place, answer in zip(places, answers, strict=True):
        ways_m = ends - starts
        fractions = np.clip(np.einsum("ij,ij->i", place - starts, ways_m) / (ways_m**2).sum(axis=1), 0, 1)
        distances = np.linalg.norm(starts + fractions[:, None] * ways_m - place, axis=1)
        assert answer["distance"] == pytest.approx(distances.min(), abs=1e-3)
        edge = answer["edge"]
        assert distances[edge] == pytest.approx(distances.min(), abs=1e-3)
        assert answer["position"] == pytest.approx(starts[edge] + answer["fraction"] * ways_m[edge], abs=1e-3)


def test_cars_do_not_drive_out_of_entrances(prefabs, prefab_dump, tmp_path):
    """A graph of two nodes with a way in one direction: no path back."""
    (tmp_path / "lanes.usda").write_text("""#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Xform "Lanes"
{
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def BasisCurves "Nodes"
    {
        int[] curveVertexCounts = [1, 1]
        point3f[] points = [(0, 0, 0), (8, 6, 0)]
        custom token[] garage:lane:kind = ["entrance", "straight"]
        uniform token type = "linear"
    }
    def BasisCurves "Edges"
    {
        int[] curveVertexCounts = [2, 2]
        point3f[] points = [(0, 0, 0), (8, 6, 0), (0, 0, 0), (0, 0, 0)]
        custom int[] garage:lane:from = [0, 0]
        custom int[] garage:lane:to = [1, 7]
        custom float[] garage:lane:length = [10, 1]
        custom token[] garage:lane:direction = ["forward", "both"]
        uniform token type = "linear"
    }
    def BasisCurves "Stalls"
    {
        int[] curveVertexCounts = [4, 4, 3]
        point3f[] points = [(0, 2, 0), (1, 2, 0), (1, 5, 0), (0, 5, 0), (8, 8, 0), (9, 8, 0), (9, 11, 0), (8, 11, 0),
            (0, 0, 0), (0, 0, 0), (0, 0, 0)]
        custom token[] garage:stall:id = ["In", "Far", "Odd"]
        custom int[] garage:stall:accessNode = [0, 1, 0]
        uniform token type = "linear"
    }
}
""")
    prefab = prefabs(tmp_path / "lanes.usda")
    assert prefab.found["graph"]["stalls"] == ["In", "Far"]
    assert prefab.found["graph"]["nodes"][1]["position"] == [108, 0, 6]
    assert len(prefab.found["warnings"]) == 2
    there, back = prefab_dump.ask("ways", tmp_path / "lanes.usda", "In", "Far", "Far", "In")
    assert there["nodes"] == [0, 1]
    assert there["length"] == pytest.approx(1.5 + np.hypot(0.5, 2) + 10 + np.hypot(0.5, 2) + 1.5)
    assert "nodes" not in back


def test_ways_over_lanes_of_all_lengths(prefab_dump, tmp_path):
    """A random graph, where the way over the fewest lanes is seldom the shortest."""
    random = np.random.default_rng(3)
    count = 40
    lanes = nx.gnp_random_graph(count, 0.12, seed=4, directed=True)
    for edge in lanes.edges.values():
        edge["length_m"] = round(float(random.uniform(1, 50)), 2)
    starts, ends, lengths = zip(*lanes.edges(data="length_m"), strict=True)
    corners = "(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), " * count
    (tmp_path / "lanes.usda").write_text(f"""#usda 1.0
( metersPerUnit = 1 )
def Xform "Lanes"
{{
    def BasisCurves "Nodes"
    {{
        int[] curveVertexCounts = {[1] * count}
        point3f[] points = [{"(0, 0, 0), " * count}]
        token[] garage:lane:kind = {str(["straight"] * count).replace("'", '"')}
    }}
    def BasisCurves "Edges"
    {{
        int[] curveVertexCounts = {[2] * len(starts)}
        point3f[] points = [{"(0, 0, 0), (0, 0, 0), " * len(starts)}]
        int[] garage:lane:from = {list(starts)}
        int[] garage:lane:to = {list(ends)}
        float[] garage:lane:length = {list(lengths)}
        token[] garage:lane:direction = {str(["forward"] * len(starts)).replace("'", '"')}
    }}
    def BasisCurves "Stalls"
    {{
        int[] curveVertexCounts = {[4] * count}
        point3f[] points = [{corners}]
        token[] garage:stall:id = {str([f"S{node}" for node in range(count)]).replace("'", '"')}
        int[] garage:stall:accessNode = {list(range(count))}
    }}
}}
""")
    pairs = list(itertools.permutations(range(0, count, 3), 2))
    ends_of_ways = [f"S{node}" for pair in pairs for node in pair]
    answers = prefab_dump.ask("ways", tmp_path / "lanes.usda", *ends_of_ways)
    expected = dict(nx.all_pairs_dijkstra_path_length(lanes, weight="length_m"))
    for (start, end), answer in zip(pairs, answers, strict=True):
        way = answer.get("nodes")
        assert (way is None) == (end not in expected[start])
        if way is not None:
            found = sum(lanes.edges[step]["length_m"] for step in itertools.pairwise(way))
            assert found == pytest.approx(expected[start][end], abs=1e-3)


def test_the_sample_drives_along_the_lanes(prefabs, prefab_dump):
    """For four minutes, always on a lane square or a portal, at its speed, looking where it goes."""
    stage = PACKAGE / "Samples~" / "SmallGarage" / "SmallGarage.usdz"
    graph = prefabs(stage).found["graph"]
    nodes = np.array([node["position"] for node in graph["nodes"]])
    entrances = np.array([node["position"] for node in graph["nodes"] if node["kind"] == "entrance"])
    drive = prefab_dump.ask("drive", stage, 2400)
    places = np.array([step["position"] for step in drive])
    assert np.allclose(places[:, 1], nodes[0, 1] + 1.4, atol=1e-4)
    # squares of 8.1 m, and no farther than into the mouths of stalls
    assert np.abs(places[:, None, [0, 2]] - nodes[None, :, [0, 2]]).max(axis=2).min(axis=1).max() <= 8.1 / 2 + 1e-3
    steps = np.diff(places, axis=0)
    lengths = np.linalg.norm(steps, axis=1)
    rounds = np.flatnonzero(lengths > 0.401)
    assert len(rounds) >= 3
    # shorter around corners alone
    assert np.median(lengths) == pytest.approx(0.4, abs=1e-3)
    for start in rounds:
        assert np.linalg.norm(places[start + 1] - entrances - [0, 1.4, 0], axis=1).min() < 1e-3
    assert np.allclose([np.linalg.norm(step["forward"]) for step in drive], 1, atol=1e-3)
    assert len({round(step["length"], 3) for step in drive}) > 2
