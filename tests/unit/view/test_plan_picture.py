"""Plans as pictures: what stands in the SVG is the layout in metres, and the PNG shows the same."""

import json
import math
import os
from itertools import pairwise
from xml.etree import ElementTree as ET

import networkx as nx
import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from PIL import Image
from support.footprints import footprint
from support.sample_files import REPOSITORY

from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.garage import LaneKind, StallUse
from garage2usd.pipeline import build, generate
from garage2usd.planning import measured_circulation
from garage2usd.structure.grid import Cell
from garage2usd.view.drawing import CM_PER_M, to_image, to_svg, write_png
from garage2usd.view.plan_picture import draw_plan, find_stall, route_of
from garage2usd.view.plan_sheet import MARK_COLOUR, Mark

SVG = "{http://www.w3.org/2000/svg}"
HAND_DRAWN = REPOSITORY / "samples" / "hand_drawn.toml"
CENTIMETRE = 0.01
MARKS = [
    Mark(9.5, 9.0, "error", "Aisle is 5.40 m wide; 6.00 m required"),
    Mark(30.0, 20.0, "warning", "<narrow> & so on"),
]


@pytest.fixture(scope="module")
def garage(builds):
    return builds(HAND_DRAWN, "usdc").garage


@pytest.fixture(scope="module", params=["hand_drawn", "large"])
def drawn(request, garage):
    """A garage, its drawing and its parsed SVG; the large one has 20 x 30 squares."""
    if request.param == "large":
        rows = ["." * 30, "E" + "=" * 28 + "X", "." * 30, "." * 30]
        config = GarageConfig(site={"structure": "\n".join(rows * 5)}, seed=4)
        garage = generate(config)
    drawing = draw_plan(garage.layout, marks=MARKS)
    return garage, drawing, ET.fromstring(to_svg(drawing))


def polygons(svg, kind):
    """Outlines in metres by their id, of the polygons that have a class."""
    return [
        (element.get("id"), shapely.Polygon(points(element)))
        for element in svg.iter(f"{SVG}polygon")
        if kind in element.get("class", "").split()
    ]


def points(element):
    return [tuple(float(value) / CM_PER_M for value in pair.split(",")) for pair in element.get("points").split()]


def texts(svg, kind):
    return [element for element in svg.iter(f"{SVG}text") if kind in element.get("class", "").split()]


def same(one, other):
    return one.symmetric_difference(other).area < CENTIMETRE * (one.length + other.length)


def test_stalls_are_where_the_layout_has_them(drawn):
    garage, _, svg = drawn
    found = dict(polygons(svg, "stall"))
    assert len(found) == len(garage.layout.stalls)
    for stall in garage.layout.stalls:
        x, z = stall.centre_m
        across, along = (stall.width_m, stall.length_m) if math.isclose(math.sin(stall.yaw_rad), 0, abs_tol=1e-9) else (
            stall.length_m, stall.width_m,
        )  # fmt: skip
        expected = shapely.box(x - across / 2, z - along / 2, x + across / 2, z + along / 2)
        assert same(found[stall.name], expected)
    for use in StallUse:
        expected_names = {stall.name for stall in garage.layout.stalls if stall.use is use}
        assert {name for name, _ in polygons(svg, use)} == expected_names


def test_each_number_stands_in_its_stall(drawn):
    garage, _, svg = drawn
    shown = {element.text: element for element in texts(svg, "number")}
    expected = {stall.number: stall for stall in garage.layout.stalls if stall.number}
    assert shown.keys() == expected.keys()
    for number, stall in expected.items():
        element = shown[number]
        at = float(element.get("x")) / CM_PER_M, float(element.get("y")) / CM_PER_M
        outline = shapely.Polygon(stall.corners_m())
        assert outline.contains(shapely.Point(at).buffer(float(element.get("font-size")) / CM_PER_M / 2))
        assert at != pytest.approx(stall.centre_m, abs=0.5)


def test_squares_lanes_and_what_stands_in_the_way_are_drawn_true_to_scale(drawn):
    garage, _, svg = drawn
    structure = garage.layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    for kind in LaneKind:
        squares = [square for square in garage.graph.graph if garage.graph.kind(square) is kind]
        expected = shapely.union_all([shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in squares])
        found = [shape for name, shape in polygons(svg, kind) if shape.area > 20]
        assert len(found) == len(squares)
        assert same(shapely.union_all(found), expected) if squares else True
    for kind, object_kind in (("column", "column"), ("obstacle", "obstacle")):
        expected = [footprint(place) for place in garage.layout.of_kind(object_kind)]
        found = [shape for _, shape in polygons(svg, kind)]
        assert len(found) == len(expected)
        assert same(shapely.union_all(found), shapely.union_all(expected)) if expected else True
    cars = [shape for _, shape in polygons(svg, "car")]
    assert len(cars) == len(garage.layout.of_kind("car"))
    for car, place in zip(cars, garage.layout.of_kind("car"), strict=True):
        assert footprint(place).buffer(CENTIMETRE).contains(car)
        assert car.area > 0.75 * footprint(place).area


def test_walls_close_the_garage_but_for_its_doors(drawn):
    garage, _, svg = drawn
    walls = shapely.union_all([shape for _, shape in polygons(svg, "wall")]).buffer(CENTIMETRE)
    doors = shapely.union_all([shape for _, shape in polygons(svg, "portal")]).buffer(CENTIMETRE)
    portals = garage.layout.of_kind("portal")
    assert len(polygons(svg, "portal")) == len(portals)
    assert shapely.union_all([walls, doors]).geom_type == "Polygon"
    assert len(shapely.union_all([walls, doors]).interiors) == 1
    assert walls.geom_type == "MultiPolygon"
    assert sorted(element.text for element in texts(svg, "portal")) == sorted(
        "IN" if place.spec.is_entrance else "OUT" for place in portals
    )


def test_dimensions_are_those_of_r_and_c(drawn):
    garage, _, svg = drawn
    structure = garage.layout.structure
    shown = sorted(element.text for element in texts(svg, "dimension"))
    widths, depths = (np.diff(edges).tolist() for edges in (structure.column_edges_m, structure.row_edges_m))
    expected = [*widths, *depths, sum(widths), sum(depths)]
    assert shown == sorted(f"{value:.2f}" for value in expected)
    for edges, kind, axis in ((structure.column_edges_m, "column", "x"), (structure.row_edges_m, "row", "y")):
        middles = [(start + end) / 2 for start, end in pairwise(edges.tolist())]
        numbers = texts(svg, kind)
        assert [int(element.text) for element in numbers] == list(range(len(middles)))
        assert [float(element.get(axis)) / CM_PER_M for element in numbers] == pytest.approx(middles, abs=CENTIMETRE)


def test_directions_keep_right_and_portals_are_one_way(garage):
    drawing = draw_plan(garage.layout)
    chevrons = [
        element.points
        for element in drawing.elements
        if getattr(element, "kind", "") == "direction" and len(element.points) == 3
    ]
    lanes = {
        square
        for square, kind in garage.graph.graph.nodes(data="kind")
        if kind not in {LaneKind.ENTRANCE, LaneKind.EXIT}
    }
    inner = garage.graph.graph.subgraph(lanes).number_of_edges()
    portals = 2  # each with an arrow before its door as well
    assert len(chevrons) == 2 * inner + 2 * portals
    nodes = garage.graph.graph.nodes
    for one, other in garage.graph.graph.subgraph(lanes).edges:
        ends = np.array([(nodes[square]["x_m"], nodes[square]["z_m"]) for square in (one, other)])
        near = [
            np.array(points) for points in chevrons if np.linalg.norm(np.array(points[1]) - ends.mean(axis=0)) < 1.5
        ]
        assert len(near) == 2
        for points_ in near:
            ahead = points_[1] - (points_[0] + points_[2]) / 2
            aside = points_[1] - ends.mean(axis=0)
            # with z downwards a turn to the right goes from +x to +z
            assert ahead[0] * aside[1] - ahead[1] * aside[0] > 0


@pytest.mark.parametrize("number", ["A1-04", "A2-22", "B1-14", "B1-31"])
def test_the_route_is_the_shortest_over_lanes(garage, number):
    stall = find_stall(garage.layout.quads, number)
    assert {find_stall(garage.layout.quads, name).name for name in (number.lower(), stall.name.upper())} == {stall.name}
    lanes, graph = garage.layout.lane_graph, garage.graph.graph
    route = route_of(lanes, stall)
    (kind_in, kind_out) = (lanes.nodes[node].kind for node in (route.to_stall[0], route.from_stall[-1]))
    assert (kind_in, kind_out) == (LaneKind.ENTRANCE, LaneKind.EXIT)
    assert route.to_stall[-1] == route.from_stall[0] == stall.access
    squares_of = {node: square for square, node in garage.graph.number_of.items()}
    to_stall, from_stall = ([squares_of[node] for node in way] for way in (route.to_stall, route.from_stall))
    for way in (to_stall, from_stall):
        assert nx.is_path(graph, way)
        assert nx.path_weight(graph, way, "length_m") == pytest.approx(
            nx.shortest_path_length(graph, way[0], way[-1], weight="length_m")
        )
    drawing = draw_plan(garage.layout, stall=stall)
    svg = ET.fromstring(to_svg(drawing))
    x, z = garage.layout.structure.column_edges_m, garage.layout.structure.row_edges_m
    for way, squares in (("in", to_stall), ("out", from_stall)):
        line, head = [points(element) for element in svg.iter(f"{SVG}polyline") if element.get("class") == f"way {way}"]
        ground = shapely.union_all([shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in squares])
        outline = stall.polygon
        assert shapely.union_all([ground, outline]).buffer(0.5).contains(shapely.LineString(line))
        start, end = (line[0], line[-1]) if way == "in" else (line[-1], line[0])
        portal = squares[0] if way == "in" else squares[-1]
        assert math.dist(start, (graph.nodes[portal]["x_m"], graph.nodes[portal]["z_m"])) < 1
        assert outline.buffer(CENTIMETRE).contains(shapely.Point(end))
        assert head[1] == line[-1]
    with pytest.raises(ConfigError, match="numbers as A1-01"):
        find_stall(garage.layout.quads, "A9-99")


def test_findings_stand_at_their_places_and_in_the_list(drawn):
    _, _, svg = drawn
    circles = [element for element in svg.iter(f"{SVG}circle") if "mark" in element.get("class").split()]
    assert len(circles) == 2 * len(MARKS)
    for number, mark in enumerate(MARKS, 1):
        of_severity = [element for element in circles if mark.severity in element.get("class").split()]
        at = [(float(element.get("cx")) / CM_PER_M, float(element.get("cy")) / CM_PER_M) for element in of_severity]
        assert (mark.x_m, mark.z_m) in at
        assert of_severity[0].get("fill") == "#{:02x}{:02x}{:02x}".format(*MARK_COLOUR[mark.severity])
        assert [element.text for element in texts(svg, "mark")].count(str(number)) == 2
    assert [element.text for element in texts(svg, "finding")] == [f"{mark.severity}: {mark.text}" for mark in MARKS]


def test_texts_of_the_sheet_are_inside_and_keep_clear_of_each_other(drawn):
    _, _drawing, svg = drawn
    left, top, width, height = (float(value) for value in svg.get("viewBox").split())
    paper = shapely.box(left, top, left + width, top + height)
    boxes = []
    for kind in ("title", "dimension", "portal", "row", "column", "legend", "summary", "finding"):
        for element in texts(svg, kind):
            size = float(element.get("font-size"))
            long = size * 0.62 * len(element.text) if kind != "legend" else size * 0.5 * len(element.text)
            x, y = float(element.get("x")), float(element.get("y"))
            box = shapely.box(
                0 if element.get("text-anchor") else -long / 2,
                -size / 2,
                long if element.get("text-anchor") else long / 2,
                size / 2,
            )
            box = shapely.affinity.rotate(box, 90, origin=(0, 0)) if element.get("transform") else box
            boxes.append(shapely.affinity.translate(box, x, y))
            assert paper.contains(boxes[-1]), element.text
    tree = shapely.STRtree(boxes)
    one, other = tree.query(boxes, predicate="intersects")
    assert (one == other).all()


def test_the_png_shows_the_same(drawn):
    garage, drawing, _ = drawn
    image = to_image(drawing)
    (left, top), (right, bottom), scale = drawing.low, drawing.high, drawing.px_per_m
    assert image.size == (round((right - left) * scale), round((bottom - top) * scale))
    assert max(image.size) < 5000
    assert scale * 2.4 > 35  # a stall's number can be read
    colours = {
        StallUse.STANDARD: (206, 222, 238), StallUse.EV: (190, 228, 196), StallUse.ACCESSIBLE: (168, 196, 246),
        StallUse.ACCESS_AISLE: (232, 226, 196), StallUse.TURNING: (240, 212, 140),
    }  # fmt: skip
    cars = {car.stall for car in garage.layout.of_kind("car")}
    marked = shapely.union_all([shapely.Point(mark.x_m, mark.z_m).buffer(2) for mark in MARKS])

    def pixel(x, z):
        return image.getpixel((int((x - left) * scale), int((z - top) * scale)))

    for stall in garage.layout.stalls:
        if not marked.contains(shapely.Point(stall.centre_m)):
            has_car = stall.name in cars
            assert pixel(*stall.centre_m) == ((112, 146, 192) if has_car else colours[stall.use])
    lane_colours = {
        LaneKind.CROSSROADS: (98, 146, 148), LaneKind.T_JUNCTION: (114, 158, 158), LaneKind.STRAIGHT: (132, 172, 170),
        LaneKind.ENTRANCE: (72, 160, 96), LaneKind.EXIT: (206, 84, 72),
    }  # fmt: skip
    rounds = measured_circulation(garage.layout.structure).circulation.rounds
    for square, about in garage.graph.graph.nodes(data=True):
        place = about["x_m"], about["z_m"]
        if not marked.contains(shapely.Point(place)):
            expected = (204, 152, 104) if rounds[square] else lane_colours[garage.graph.kind(square)]
            assert pixel(*place) == expected


CIRCULATES = """
.......E....
.==========.
.=..=.=...=.
.=..=.===.=.
.====...=.=.
....=...====
..===......X
"""


@pytest.fixture(scope="module")
def circulating():
    return generate(GarageConfig(site={"structure": CIRCULATES}, seed=1))


def test_lanes_are_tinted_by_whether_cars_drive_through_them(circulating):
    svg = ET.fromstring(to_svg(draw_plan(circulating.layout)))
    structure = circulating.layout.structure
    x, z = structure.column_edges_m, structure.row_edges_m
    graph = circulating.graph.graph.copy()
    portals = {square for square in graph if structure.cells[square] > Cell.LANE}
    while tips := [square for square in graph if graph.degree(square) < 2 and square not in portals]:
        graph.remove_nodes_from(tips)
    through = set(graph) - portals
    for kind, squares in (("through", set(graph)), ("dead_end", set(circulating.graph.graph) - set(graph))):
        expected = shapely.union_all([shapely.box(x[c], z[r], x[c + 1], z[r + 1]) for r, c in squares])
        assert same(shapely.union_all([shape for _, shape in polygons(svg, kind)]), expected)
    assert through
    legend = [element.text for element in texts(svg, "legend")]
    assert {"lane driven through", "dead end", "ramp"} <= set(legend)


def test_the_title_has_the_figures_of_the_report(circulating, tmp_path):
    report = json.loads(build(circulating.config, tmp_path / "g.usda").report.read_text())
    (title,) = texts(ET.fromstring(to_svg(draw_plan(circulating.layout))), "title")
    (level,) = report["levels"]
    figures, loops = level["circulation"], level["circulation"]["loops"]
    assert title.text == (
        f"{report['parking_stalls']} stalls, {sum(stall['occupied'] for stall in level['stalls'])} occupied, "
        f"{report['area_per_stall_m2']:.1f} m2 a stall net, {report['gross_area_per_stall_m2']:.1f} gross, "
        f"{loops} loops, "
        f"longest dead end {figures['longest_dead_end_m']:.1f} m, "
        f"longest stretch without a junction {figures['longest_stretch_m']:.1f} m"
    )
    assert loops == 2
    structure = circulating.layout.structure
    found = measured_circulation(structure)
    assert (figures["longest_dead_end_m"], figures["longest_stretch_m"]) == (found.dead_end_m, found.stretch_m)
    assert (figures["longest_dead_end_squares"], figures["blocks"]) == (found.circulation.dead_end_squares, 0)
    assert (figures["rules_asked"], list(figures["rules_broken"])) == (["R1", "R2", "R3"], ["R1"])
    assert f"{figures['longest_dead_end_squares']} squares deep" in figures["rules_broken"]["R1"]
    assert 0 < figures["neither_share"] < 1


def test_ramps_are_drawn_from_their_doors_on_as_far_as_the_sheet_goes(drawn, circulating):
    for garage in (drawn[0], circulating):
        drawing = draw_plan(garage.layout)
        svg = ET.fromstring(to_svg(drawing))
        expected = shapely.union_all([footprint(place) for place in garage.layout.of_kind("ramp")])
        found = shapely.union_all([shape for _, shape in polygons(svg, "ramp")])
        assert bool(found.area) == bool(garage.layout.of_kind("ramp"))
        assert expected.buffer(CENTIMETRE).contains(found)
        assert shapely.box(*drawing.low, *drawing.high).contains(found)
        doors = shapely.union_all([footprint(place) for place in garage.layout.of_kind("portal")])
        assert all(shapely.distance(part, doors) < CENTIMETRE for part in shapely.get_parts(found))


def test_doors_of_stair_cores_are_drawn_where_they_open():
    config = GarageConfig(site={"structure": ".......\n..#....\nE=====X\n......."})
    garage = generate(config)
    svg = ET.fromstring(to_svg(draw_plan(garage.layout)))
    doors = [points(line) for line in svg.iter(f"{SVG}polyline") if "on_foot" in line.get("class", "").split()]
    assert len(doors) == len(garage.layout.cores) == 2
    x, z = garage.layout.structure.column_edges_m, garage.layout.structure.row_edges_m
    middles = [np.mean(door, axis=0) for door in doors]
    # that of the obstacle opens onto the lane below it, the other one stands back from the lane above
    assert any(middle == pytest.approx([(x[2] + x[3]) / 2, z[2]]) for middle in middles)
    assert np.allclose(sorted(map(tuple, middles)), sorted(core.door_m for core in garage.layout.cores))
    assert "door of a stair core" in [element.text for element in texts(svg, "legend")]


def test_a_png_of_few_colours_looks_the_same(drawn, tmp_path):
    image = to_image(drawn[1])
    for name in ("one.png", "other.png"):
        write_png(image, tmp_path / name)
    assert (tmp_path / "one.png").read_bytes() == (tmp_path / "other.png").read_bytes()
    with Image.open(tmp_path / "one.png") as written:
        assert written.mode == "P"
        off = np.abs(np.asarray(written.convert("RGB")).astype(int) - np.asarray(image).astype(int)).max(axis=2)
    assert off.max() < 24  # rims of letters
    assert (off > 1).mean() < 0.03


def test_the_same_drawing_gives_the_same_bytes(garage):
    one, other = (draw_plan(garage.layout, marks=MARKS) for _ in range(2))
    assert to_svg(one) == to_svg(other)
    assert to_image(one).tobytes() == to_image(other).tobytes()


def run(*arguments):
    return CliRunner().invoke(main, ["plan", *(str(argument) for argument in arguments)])


def test_configuration_report_and_stage_give_the_picture_of_the_build(builds, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    built = builds(REPOSITORY / "samples" / "dimensioned.toml", "usdc")
    for path in (built.report, built.stage):
        result = run(path, "-o", "out/p.png", "-o", "p.svg")
        assert result.exit_code == 0, result.output
        assert (tmp_path / "out" / "p.png").read_bytes() == built.pictures[0].read_bytes()
    assert run(built.stage).exit_code == 0
    assert (tmp_path / "dimensioned_plan.svg").read_bytes() == (tmp_path / "p.svg").read_bytes()
    assert run(HAND_DRAWN, "-o", "h.png").exit_code == 0
    assert (tmp_path / "h.png").read_bytes() == builds(HAND_DRAWN, "usdc").pictures[0].read_bytes()


def test_a_stall_is_chosen_by_its_number(tmp_path):
    result = run(HAND_DRAWN, "--stall", "A2-07", "-o", tmp_path / "p.svg")
    assert result.exit_code == 0, result.output
    classes = [element.get("class") for element in ET.parse(tmp_path / "p.svg").iter(f"{SVG}polyline")]
    assert {"chosen", "way in", "way out"} <= set(classes)


@pytest.mark.parametrize(
    ("arguments", "code", "said"),
    [
        ([HAND_DRAWN, "-o", "p.gif"], 2, "a path that ends in .png, .svg"),
        ([HAND_DRAWN, "--stall", "Z1-01"], 1, "stall: got 'Z1-01'; allowed: numbers as A1-01"),
        (["none.usdc"], 1, "PATH: got 'none.usdc'; allowed: an existing file"),
        (["alone.usdc"], 1, "a stage with the report of its build beside it, alone_report.json"),
        (["none.json"], 1, "none.json'; allowed: a readable file (No such file"),
        (["none.obj"], 1, "PATH: got 'none.obj'"),
        (["pipe.json"], 1, "allowed: a regular file"),
        (["broken.json"], 1, "report: got 'broken.json'; allowed: JSON ("),
        (["other.json"], 1, "other.json: not a report of a build: seed"),
        (["other.json", "--seed", "3"], 1, "a seed beside a configuration only"),
    ],
)
def test_what_cannot_be_drawn_ends_in_one_line_and_no_file(tmp_path, monkeypatch, arguments, code, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "broken.json").write_text("{")
    (tmp_path / "alone.usdc").touch()
    os.mkfifo(tmp_path / "pipe.json")
    (tmp_path / "other.json").write_text(json.dumps({"classes": []}))
    before = set(tmp_path.iterdir())
    result = run(*arguments)
    assert result.exit_code == code
    (line,) = result.output.strip().splitlines()
    assert said in line
    assert set(tmp_path.iterdir()) == before


def test_pictures_open_as_such(tmp_path):
    run(HAND_DRAWN, "-o", tmp_path / "p.png", "-o", tmp_path / "p.svg")
    with Image.open(tmp_path / "p.png") as image:
        assert image.mode == "P"
        svg = ET.parse(tmp_path / "p.svg").getroot()
        assert (round(float(svg.get("width"))), round(float(svg.get("height")))) == image.size


def test_what_a_check_finds_is_drawn_at_its_place(builds, tmp_path):
    build = builds(REPOSITORY / "samples" / "paper_7x9.toml", "usdc")
    report = json.loads(build.report.read_text())
    moved = report["levels"][0]["stalls"][3]
    moved["centre_m"][0] += 0.5
    (tmp_path / "garage_report.json").write_text(json.dumps(report))
    picture = tmp_path / "plan.svg"
    arguments = ["plan", str(tmp_path / "garage_report.json"), "--findings", "-o", str(picture)]
    assert CliRunner().invoke(main, arguments).exit_code == 0
    assert "error: report-stalls: the report tells another place" in " ".join(ET.parse(picture).getroot().itertext())
