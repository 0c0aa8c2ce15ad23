"""Readers of a garage of several levels, judged by programs and computations that are not ours."""

import io
import json

import numpy as np
import pytest
import shapely
import trimesh
from PIL import Image
from support.browser import find_browser
from support.glb_reader import Glb, assert_like_the_stage
from support.gltf_validator import find_node, find_validator, validated
from support.label_tables import labelled_objects
from support.level_judge import LevelJudge, above, first_hits
from support.map_reader import FREE, OCCUPIED, UNKNOWN, read_map
from support.places import MILLIMETRE
from support.small_levels import FLOORS_M, SMALL_LEVELS
from support.viewer_page import viewed

import garage2usd

pytestmark = pytest.mark.client


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return garage2usd.build(SMALL_LEVELS, tmp_path_factory.mktemp("levels") / "garage.usdz")


@pytest.fixture(scope="module")
def judge(built):
    return LevelJudge(built.stage)


@pytest.fixture(scope="module")
def scene(built):
    path = built.stage.with_suffix(".glb")
    garage2usd.export(built.stage, [path])
    return path


@pytest.mark.skipif(
    find_node() is None or find_validator() is None, reason="environment.sh test installs the validator"
)
def test_the_validator_finds_nothing_in_a_scene_of_levels(scene):
    issues = validated(scene)["issues"]
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_a_scene_has_all_objects_of_all_levels_where_the_stage_has_them(built, scene):
    assert_like_the_stage(scene.read_bytes(), built.stage, labelled_objects(built.labels))


def test_trimesh_finds_each_level_below_its_node(scene, judge):
    read = trimesh.load(scene)
    tree = read.graph.transforms
    for name, floor_m in FLOORS_M.items():
        node = f"/Garage/Levels/{name}"
        assert tree.parents[node] == "world"
        assert read.graph.get(node)[0][1, 3] == pytest.approx(floor_m)
        floors = [each for each in read.graph.nodes_geometry if each.startswith(node) and each.endswith("/Floor")]
        assert floors
        for floor in floors:
            matrix, shape = read.graph.get(floor)
            assert trimesh.transform_points(read.geometry[shape].vertices, matrix)[:, 1].max() < floor_m + 0.05
        stalls = [each for each in tree.nodes if each.startswith(f"stalls/{name}/")]
        assert len(stalls) == judge.stall_levels.count([*FLOORS_M].index(name))
        for stall in stalls:
            outline = judge.outlines[judge.stall_ids.index(stall.partition("/")[2])]
            assert np.abs(read.graph.get(stall)[0][:3, 3] - outline.mean(axis=0)).max() < MILLIMETRE


def test_no_material_of_a_scene_is_written_twice_and_cars_stand_in_stalls_of_their_level(scene):
    glb = Glb(scene.read_bytes())
    materials = [json.dumps(material, sort_keys=True) for material in glb.json["materials"]]
    assert len(set(materials)) == len(materials)
    cars = [node for node in glb.nodes if node.get("extras", {}).get("class") == "car"]
    homes = {(node["name"].split("/")[3], node["extras"]["stall"]["id"].partition("/")[0]) for node in cars}
    assert homes == {(name, name) for name in FLOORS_M}


def test_an_occupancy_grid_has_the_obstacles_of_its_level_only(built, judge, tmp_path):
    written = garage2usd.export(built.stage, [tmp_path / "map.yaml"])
    assert [file.name for file in written] == [f"map_{name}.{end}" for name in FLOORS_M for end in ("yaml", "pgm")]
    objects = labelled_objects(built.labels)
    on_both = 0
    for number, name in enumerate(FLOORS_M):
        grid = read_map(tmp_path / f"map_{name}.yaml")
        cars = {level: [] for level in FLOORS_M}
        for thing in objects:
            (x0, _, z0), (x1, _, z1) = thing["min_m"], thing["max_m"]
            level, middle = thing["path"].split("/")[3], ((x0 + x1) / 2, -(z0 + z1) / 2)
            if thing["class"] == "car":
                cars[level].append(middle)
            elif thing["class"] == "column" and level == name:
                assert value_at(grid, middle) == OCCUPIED
        assert all(value_at(grid, car) == OCCUPIED for car in cars[name])
        (others,) = (places for level, places in cars.items() if level != name)
        alone = [place for place in others if min(np.hypot(*np.subtract(place, car)) for car in cars[name]) > 4]
        values = [value_at(grid, place) for place in alone]
        on_both += values.count(FREE)
        assert OCCUPIED not in [
            value for value, place in zip(values, alone, strict=True) if is_on_stall(judge, place, number)
        ]
        own = [place for place, level in zip(judge.places, judge.levels, strict=True) if level == number]
        nodes = [place for place in own if place[1] < FLOORS_M[name] + 3.5]  # the head of a ramp is on the level above
        assert {value_at(grid, (x, -z)) for x, _, z in nodes} == {FREE}
        for ramp in judge.ramps():
            x, _, z = ramp[len(ramp) // 2 - 1 : len(ramp) // 2 + 1].mean(axis=0)
            assert value_at(grid, (x, -z)) == (UNKNOWN if name == "U1" else FREE)
    assert on_both


def value_at(grid, place):
    """The value of the cell at (x, y)."""
    column, row = np.floor((np.array(place) - grid.origin) / grid.side).astype(int)
    return grid.cells[row, column]


def is_on_stall(judge, place, level):
    """Whether (x, y) is in a stall of a level."""
    return any(
        shapely.Polygon(outline[:, [0, 2]]).contains(shapely.Point(place[0], -place[1]))
        for outline, own in zip(judge.outlines, judge.stall_levels, strict=True)
        if own == level
    )


def floors_below_m(judge, places):
    """Heights of the floors and ramps of the stage's meshes under places, by rays from a metre above."""
    places = np.asarray(places)
    drive = judge.mesh("floor", "ramp")
    far = first_hits(drive, above(places, 1.0), np.tile([0.0, -1.0, 0.0], (len(places), 1)))
    return places[:, 1] + 1.0 - far


@pytest.fixture(scope="module")
def page(built):
    with viewed(built.stage) as opened:
        yield opened
        assert opened.complaints == []


@pytest.mark.soak
@pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path")
def test_the_viewer_hides_the_levels_above_the_chosen_one(page, judge):
    assert [button.inner_text() for button in page.page.query_selector_all("#levels button")] == [*FLOORS_M]
    visible = "viewer.scene.paths.filter((path, k) => viewer.instances.visible[k])"
    shown = f"{visible}.map((path) => path.split('/')[3])"
    assert {*page.eval(shown)} == {*FLOORS_M}
    for number, (name, floor_m) in reversed([*enumerate(FLOORS_M.items())]):
        page.page.click(f"#level-{name}")
        page.rest()
        assert {*page.eval(shown)} == {*list(FLOORS_M)[number:]}
        assert page.page.get_attribute(f"#level-{name}", "aria-pressed") == "true"
        stall = next(k for k, level in enumerate(judge.stall_levels) if level == number and judge.numbers[k])
        x, y, z = judge.outlines[stall].mean(axis=0)
        page.eval(
            f"viewer.orbit.target.set({x}, {y}, {z}), viewer.camera.position.set({x + 1}, {y + 22}, {z + 4}),"
            " viewer.orbit.update(), viewer.touch()"
        )
        page.rest()
        page.page.mouse.click(*page.screen((x, y, z)))
        facts = page.facts()
        assert (facts["Level"], facts["Stall id"]) == (name, judge.stall_ids[stall])
        assert facts["Number"] == judge.numbers[stall]
        assert facts["Prim"].startswith(f"/Garage/Levels/{name}/")
        assert page.eval("viewer.orbit.target.y") == pytest.approx(floor_m, abs=0.01)
    # a number without its level is one of the level that is shown
    page.page.fill("#query", judge.numbers[stall].partition("/")[2])
    page.page.keyboard.press("Enter")
    assert page.facts()["Stall id"] == judge.stall_ids[stall]
    page.eval("document.activeElement.blur(), viewer.select(-1)")


@pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path")
def test_a_ramp_is_lit_from_both_of_its_levels_without_an_edge(page, built, judge):
    down = next(ramp for ramp in judge.ramps() if ramp[0, 1] > ramp[-1, 1])
    runs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(down[:, [0, 2]], axis=0), axis=1))])
    ahead = (down[-1] - down[0]) / runs[-1]
    side = np.array([-ahead[2], 0.0, ahead[0]])
    level = built.garage.levels[1].layout
    half_m = level.well.lanes(level.structure)[0].width_m / 2

    def on_ramp(run_m, aside_m=0.0):
        return np.array([np.interp(run_m, runs, down[:, axis]) for axis in range(3)]) + aside_m * side

    eye = on_ramp(0.3 * runs[-1])
    page.show_panels(False)
    page.eval(
        f"(viewer.setMode('walk'), viewer.walker.feet.set({', '.join(map(str, eye))}),"
        f" viewer.walker.yaw = {np.arctan2(-ahead[0], -ahead[2])}, viewer.walker.pitch = -0.1, viewer.touch())"
    )
    page.rest()
    seen = np.asarray(Image.open(io.BytesIO(page.page.screenshot())).convert("L"), dtype=float)

    def brightness(places):
        found = [page.screen(place) for place in places]
        return np.mean([seen[int(y), int(x)] for x, y in found if 0 <= x < seen.shape[1] and 0 <= y < seen.shape[0]])

    at_m = 0.3 * runs[-1] + np.arange(4.0, 9.0, 0.05)
    bands = []
    for height_m in (0.3, -0.4):  # on both sides of the floor of the upper level
        wall = np.stack([on_ramp(run_m, half_m) for run_m in at_m])
        wall[:, 1] = height_m
        bands.append(brightness(wall))
    assert bands[1] == pytest.approx(bands[0], rel=0.15)
    floors = [brightness([on_ramp(run_m, 0.3)]) for run_m in np.linspace(0.42, 0.9, 24) * runs[-1]]
    assert min(floors) > 0.45 * bands[0]
    page.show_panels(True)


@pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path")
def test_one_walks_down_a_ramp_and_stands_on_each_floor(page, judge):
    for name, floor_m in FLOORS_M.items():
        page.page.keyboard.press("1")
        page.eval(f"document.getElementById('level-{name}').click()")
        page.page.keyboard.press("2")
        page.rest()
        assert page.eval("viewer.camera.position.y") == pytest.approx(floor_m + 1.65, abs=0.01)
        assert page.page.inner_text("#place").startswith(f"{name} ")
    down = next(ramp for ramp in judge.ramps() if ramp[0, 1] > ramp[-1, 1])
    way = down[-1] - down[0]
    # beside the middle of the ramp, as rays may miss the edges that the triangles of its floor share there
    x, z = down[0, [0, 2]] + 0.37 * np.array([way[2], -way[0]]) / np.hypot(way[0], way[2])
    assert page.eval(f"viewer.walkAt({x}, {z}, {np.arctan2(-way[0], -way[2])}, 0)")
    feet = page.eval(
        "(() => { const found = []; viewer.walker.key('KeyW', true); for (let k = 0; k < 130; k++) {"
        " viewer.walker.advance(0.1); found.push(viewer.walker.feet.toArray()); }"
        " viewer.walker.release(); viewer.touch(); return found; })()"
    )
    feet = np.array(feet)
    assert (feet[0, 1], feet[:, 1].min()) == pytest.approx((FLOORS_M["U1"], FLOORS_M["U2"]), abs=0.01)
    assert np.abs(feet[:, 1] - floors_below_m(judge, feet)).max() < MILLIMETRE
    page.rest()
    assert page.page.get_attribute("#level-U2", "aria-pressed") == "true"
    assert page.page.inner_text("#place").startswith("U2 ")
