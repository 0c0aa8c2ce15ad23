"""The folder for Autoware: its map obeys Autoware's requirements, each named by its issue code, and each can fail."""

from itertools import count

import numpy as np
import pytest
import yaml
from click.testing import CliRunner
from pxr import Usd
from support.autoware_folder import AutowareFolder, cloud_complaints
from support.autoware_judge import CODES, AutowareMap, complaints
from support.sensor_judges import HAS_SENSOR_JUDGES
from support.small_garage import SETTINGS
from support.small_levels import SMALL_LEVELS

import garage2usd
from garage2usd import GarageConfig
from garage2usd.as_built.garage import garage_of_file
from garage2usd.cli import main
from garage2usd.common import package
from garage2usd.config.outputs import MapsConfig
from garage2usd.maps.autoware import write_lanelet_maps
from garage2usd.maps.ground_plan import ground_plan
from garage2usd.maps.point_cloud_map import write_point_cloud

CONFIGS = {
    "one level": GarageConfig(seed=3, plan={"episodes": 200}),
    "left-hand traffic": GarageConfig(seed=3, profile="uk-istructe", plan={"episodes": 200}),
    "two levels": SMALL_LEVELS,
}
LEVELS = [("one level", ""), ("left-hand traffic", ""), ("two levels", "U1"), ("two levels", "U2")]
FILES = ["goal_poses.yaml", "lanelet2_map.osm", "map_projector_info.yaml", "pointcloud_map.pcd"]


@pytest.fixture(scope="module")
def maps(tmp_path_factory):
    """The folders of some garages, without their point clouds."""
    made = {}
    for name, config in CONFIGS.items():
        folder = tmp_path_factory.mktemp("autoware")
        garage = garage_of_file(garage2usd.build(config, folder / "garage.usdc").stage)
        write_lanelet_maps(garage, folder, MapsConfig(), ground_plan(garage).levels)
        made[name] = folder
    return {(name, level): AutowareFolder(made[name], level) for name, level in LEVELS}


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    return garage2usd.build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("small") / "garage.usdc").stage


@pytest.fixture(scope="module")
def files(small, tmp_path_factory):
    return garage2usd.export(small, [tmp_path_factory.mktemp("files") / "small.autoware"])


@pytest.mark.parametrize("code", CODES)
def test_requirement(code, maps):
    for level in LEVELS:
        assert complaints(maps[level].map, code) == [], level


@pytest.mark.parametrize("level", LEVELS, ids=" ".join)
def test_a_route_leads_to_each_stall_and_away_from_it(level, maps):
    assert list(maps[level]._routes()) == []


def test_traffic_keeps_to_the_side_of_its_country(maps):
    for name, near_side in (("one level", "right"), ("left-hand traffic", "left")):
        found = maps[name, ""].map
        crossed = {"left": set(), "right": set()}
        for number, lanelet in found.lanelets.items():
            if (turn := lanelet.tags.get("turn_direction")) in crossed:
                crossed[turn].add(found.centres[number].length)
        shorter = min(crossed, key=lambda turn: np.median(list(crossed[turn])))
        assert shorter == near_side


def _first(found, **tags):
    return next(one for one in found.lanelets.values() if tags.items() <= one.tags.items())


def _turning(found):
    return next(one for one in found.lanelets.values() if "intersection_area" in one.tags)


def _in_junction(found):
    """A lanelet with a right of way that others yield to."""
    rules = found.rules("right_of_way")
    return next(
        (one, rules[rule])
        for one in found.lanelets.values()
        for rule in one.rules
        if rule in rules and len(rules[rule][0]) > 1
    )


def _way(found, kind):
    return next(iter(found.typed(kind).values()))


def _sign(found):
    return next(iter(found.rules("traffic_sign").values()))


def _without(tags, name):
    del tags[name]


def _parallel(found):
    """A copy of a lanelet's bounds in other lines, a little aside."""
    one = max(
        (one for one in found.lanelets.values() if "turn_direction" not in one.tags), key=lambda one: one.ground.area
    )
    new = count(10**6)
    shift = np.array(found.flat(one.bounds[1])[0]) - found.flat(one.bounds[0])[0]
    ways = []
    for bound in one.bounds:
        points = []
        for point in bound:
            x, y, z = found.places[point]
            number = next(new)
            found.nodes[number] = {"local_x": str(x + shift[0]), "local_y": str(y + shift[1]), "ele": str(z)}
            points.append(number)
        ways.append(next(new))
        found.ways[ways[-1]] = points, {"type": "virtual"}
    return one, ways, next(new)


def _second_lanelet(found, *, shorter=False):
    one, ways, number = _parallel(found)
    if shorter:
        for way in ways:
            points, _ = found.ways[way]
            ends = [
                np.array([float(found.nodes[points[end]][key]) for key in ("local_x", "local_y")]) for end in (0, -1)
            ]
            for end, share in ((0, 0.3), (-1, 0.6)):
                place = ends[0] + share * (ends[1] - ends[0])
                found.nodes[points[end]] |= {"local_x": str(place[0]), "local_y": str(place[1])}
            del points[1:-1]
    members = [("way", ways[0], "left"), ("way", ways[1], "right")]
    found.relations[number] = members, {**one.tags, "name": "beside"}


def _divide(found):
    """Two halves of a lanelet in a junction, both in its area."""
    one = max(
        (one for one in found.lanelets.values() if "intersection_area" in one.tags), key=lambda one: len(one.bounds[0])
    )
    new = count(10**6)
    members, _ = found.relations[one.number]
    halves = []
    for bound in one.bounds:
        line = [*bound]
        if len(line) < 3:
            (x0, y0, z), (x1, y1, _) = (found.places[point] for point in line)
            line.insert(1, next(new))
            found.nodes[line[1]] = {"local_x": str((x0 + x1) / 2), "local_y": str((y0 + y1) / 2), "ele": str(z)}
        middle = len(line) // 2
        halves.append((line[: middle + 1], line[middle:]))
    for index in range(2):
        ways = [next(new), next(new)]
        for way, half in zip(ways, halves, strict=True):
            found.ways[way] = half[index], {"type": "virtual"}
        kept = [] if index else [member for member in members if member[2] == "regulatory_element"]
        number = next(new)
        found.relations[number] = [("way", ways[0], "left"), ("way", ways[1], "right"), *kept], one.tags
    del found.relations[one.number]


def _lanelet_tag(name, value, **which):
    def change(found):
        tags = (_first(found, **which) if which else _turning(found)).tags
        if value is None:
            del tags[name]
        else:
            tags[name] = value

    return change


def _crosswalk_beside(found):
    one, other = [*found.lanelets.values()][:2]
    one.tags["subtype"] = "crosswalk"
    other.bounds = other.bounds[0], one.bounds[0]


def _crossed_zone(found):
    points, tags = _way(found, "building")
    tags["type"] = "hatched_road_markings"
    points[:2] = points[1::-1]


def _opposite_turns(found):
    """Lets a left turn follow soon after a right turn, without a shorter distance of its signal."""
    for one in found.lanelets.values():
        if one.tags.get("turn_direction") == "left":
            one.tags.pop("turn_signal_distance", None)
            for other in found.before[one.number]:
                found.lanelets[other].tags["turn_direction"] = "right"


def _joined_directions(found):
    """One line as the left bound of a lanelet and the right bound of another, without saying if lanes may change."""
    one, other = [one for one in found.lanelets.values() if "turn_direction" not in one.tags][:2]
    other.right = one.left
    found.ways[one.left][1].pop("lane_change", None)


CHANGES = {
    "Lane.RoadLaneletAttribute-001": _lanelet_tag("location", "nonurban", subtype="road"),
    "Lane.RoadLaneletAttribute-002": _lanelet_tag("one_way", "no", subtype="road"),
    "Lane.LaneletGeometry-001": lambda found: found.ways[_turning(found).left][0].append(
        found.ways[_turning(found).right][0][0]
    ),
    "Lane.SpeedLimitValidity-001": _lanelet_tag("speed_limit", "fast", subtype="road"),
    "Lane.SpeedLimitValidity-002": _lanelet_tag("speed_limit", "130", subtype="road"),
    "Lane.LocalCoordinatesDeclaration-001": lambda found: next(iter(found.nodes.values())).clear(),
    "Lane.LocalCoordinatesDeclaration-002": lambda found: _without(next(iter(found.nodes.values())), "local_y"),
    "Lane.LocalCoordinatesDeclaration-003": lambda found: _without(next(iter(found.nodes.values())), "local_x"),
    "Lane.LaneChangeAttribute-001": _joined_directions,
    "Lane.LaneChangeAttribute-002": lambda found: found.ways[_turning(found).left][1].update(lane_change="perhaps"),
    "Lane.LongitudinalSubtypeConnection-001": _lanelet_tag("subtype", "walkway"),
    "Lane.LongitudinalSubtypeConnection-002": _lanelet_tag("subtype", "road_shoulder"),
    "Lane.LateralSubtypeConnection-001": _crosswalk_beside,
    "Lane.BorderSharing-001": _second_lanelet,
    "Lane.BorderSharing-002": lambda found: _second_lanelet(found, shorter=True),
    "Intersection.IntersectionAreaDanglingReference-001": _lanelet_tag("intersection_area", "7"),
    "Intersection.IntersectionAreaTagging-001": _lanelet_tag("intersection_area", None),
    "Intersection.IntersectionAreaTagging-002": _lanelet_tag("intersection_area", "7"),
    "Intersection.IntersectionAreaTagging-003": lambda found: [
        points.pop() for points, _ in found.typed("intersection_area").values()
    ],
    "Intersection.IntersectionAreaTagging-004": _lanelet_tag("intersection_area", None),
    "Intersection.IntersectionAreaValidity-001": lambda found: (
        _way(found, "intersection_area")[0].reverse()
        or _way(found, "intersection_area")[0].insert(1, _way(found, "intersection_area")[0].pop(3))
    ),
    "Intersection.IntersectionAreaSegmentType-001": lambda found: _way(found, "intersection_area")[0].append(
        _way(found, "parking_space")[0][0]
    ),
    "Intersection.TurnDirectionTagging-001": _lanelet_tag("turn_direction", None, turn_direction="straight"),
    "Intersection.TurnDirectionTagging-002": _lanelet_tag("turn_direction", "back"),
    "Intersection.IntersectionLaneletBorderType-001": lambda found: found.ways[_turning(found).left][1].update(
        type="line_thin"
    ),
    "Intersection.LaneletDivision-001": _divide,
    "Intersection.RightOfWayWithoutTrafficLights-001": lambda found: _in_junction(found)[1][0].pop(0),
    "Intersection.RightOfWayWithoutTrafficLights-002": lambda found: _in_junction(found)[1][0].__setitem__(
        0, ("relation", 7, "right_of_way")
    ),
    "Intersection.RightOfWayWithoutTrafficLights-003": lambda found: _in_junction(found)[1][0].pop(),
    "Intersection.RightOfWayWithoutTrafficLights-004": lambda found: _in_junction(found)[1][0].append(
        ("relation", 7, "yield")
    ),
    "Intersection.RightOfWayWithoutTrafficLights-005": lambda found: [
        one.rules.clear() for one in found.lanelets.values()
    ],
    "Intersection.TurnSignalDistanceOverlap-001": _opposite_turns,
    "StopLine.MissingRegulatoryElements-001": lambda found: [
        found.relations.pop(number) for number in found.rules("traffic_sign")
    ],
    "StopLine.RegulatoryElementDetailsForTrafficSigns-001": lambda found: _sign(found)[0].pop(0),
    "StopLine.RegulatoryElementDetailsForTrafficSigns-002": lambda found: _way(found, "traffic_sign")[1].update(
        subtype="de206"
    ),
    "StopLine.RegulatoryElementDetailsForTrafficSigns-003": lambda found: _sign(found)[0].pop(1),
    "StopLine.RegulatoryElementDetailsForTrafficSigns-004": lambda found: _without(
        _way(found, "stop_line")[1], "subtype"
    ),
    "StopLine.RegulatoryElementDetailsForTrafficSigns-005": lambda found: found.nodes[
        _way(found, "stop_line")[0][0]
    ].update(local_x="900"),
    "Area.BufferZoneValidity-001": _crossed_zone,
    "Extension.Elevation": lambda found: _without(next(iter(found.nodes.values())), "ele"),
    "Extension.TurnDirection": lambda found: [one.tags.pop("turn_direction", None) for one in found.lanelets.values()],
    "Extension.SpeedBump": lambda found: _way(found, "speed_bump")[1].update(height="0"),
    "Documents.LaneletLength": lambda found: [
        tags.update(local_x=str(4 * float(tags["local_x"])), local_y=str(4 * float(tags["local_y"])))
        for tags in found.nodes.values()
    ],
    "Documents.Connection": lambda found: [
        found.relations.pop(number) for number, one in list(found.lanelets.items()) if number != _turning(found).number
    ],
    "Parking.Space": lambda found: _without(_way(found, "parking_space")[1], "width"),
    "Parking.Lot": lambda found: _without(_way(found, "parking_lot")[1], "area"),
    "Vocabulary": lambda found: _way(found, "stop_line")[1].update(type="traffic_light"),
}
"""What breaks a map, so that the rule of each code complains."""


@pytest.mark.parametrize("code", CODES)
def test_the_judge_finds_what_violates(code, maps):
    path = maps["one level", ""].folder / "lanelet2_map.osm"
    found = AutowareMap(path)
    CHANGES[code](found)
    for name in ("lanelets", "places", "centres", "following", "before", "conflicting"):
        if name != "lanelets" or code not in OF_LANELETS:
            found.__dict__.pop(name, None)
    assert complaints(found, code)


OF_LANELETS = {
    "Lane.LaneChangeAttribute-001",
    "Lane.LateralSubtypeConnection-001",
    "Intersection.RightOfWayWithoutTrafficLights-005",
}
"""Codes whose changes are made to lanelets that have been read."""


def test_the_command_writes_a_folder_beside_what_is_there(small, files, tmp_path):
    folder = tmp_path / "my garage.v1.autoware"
    folder.mkdir()
    (folder / "notes.txt").write_text("mine")
    run = CliRunner().invoke(main, ["export", str(small), "-o", f"{folder}/", "-o", str(tmp_path / "my garage.v1.glb")])
    assert run.exit_code == 0, run.output
    assert sorted(file.name for file in folder.iterdir()) == sorted([*FILES, "notes.txt"])
    assert (folder / "notes.txt").read_text() == "mine"
    assert all(str(folder / name) in run.output for name in FILES)
    assert yaml.safe_load((folder / "map_projector_info.yaml").read_text()) == {"projector_type": "Local"}
    assert [file.name for file in files] == FILES
    for file in files:
        assert file.read_bytes() == (folder / file.name).read_bytes()


def test_a_file_in_the_place_of_the_folder_is_named(small, tmp_path):
    (tmp_path / "a.autoware").write_text("a file")
    run = CliRunner().invoke(main, ["export", str(small), "-o", str(tmp_path / "a.autoware")])
    assert run.exit_code == 2
    (line,) = run.stderr.splitlines()
    assert "a.autoware" in line
    assert "a path at which no file stands, for a folder" in line
    assert (tmp_path / "a.autoware").read_text() == "a file"


@pytest.mark.parametrize(("missing", "extra"), [("pyproj", "maps"), ("embreex", "sensors")])
def test_without_its_extra_the_other_files_are_written(missing, extra, small, tmp_path, monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda module: None if module == missing else module)
    outputs = [part for name in ("a.autoware", "a.xodr") for part in ("-o", str(tmp_path / name))]
    run = CliRunner().invoke(main, ["export", str(small), *outputs])
    assert run.exit_code == 3, run.output
    (line,) = run.stderr.splitlines()
    assert line.endswith(package.installation_of(extra))
    assert [file.name for file in tmp_path.iterdir()] == ["a.xodr"]


@pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with Open3D")
def test_open3d_reads_points_on_the_surfaces(small, files, tmp_path):
    assert list(cloud_complaints(files[0].parent, Usd.Stage.Open(str(small)), tmp_path)) == []


def test_the_cloud_has_the_floor_of_stalls_but_no_cars(small, files):
    points = read_pcd(files[-1])
    garage = garage_of_file(small)
    taken = [stall for stall in garage.stalls if stall in garage.levels[0].taken_stalls]
    free = [stall for stall in garage.stalls if stall not in taken]
    assert taken
    assert free
    over = {}
    for name, stalls in (("taken", taken), ("free", free)):
        middles = np.array([stall.centre for stall in stalls]) * (1, -1)
        near = np.abs(points[:, None, :2] - middles).max(axis=2) < 0.8
        low = (points[:, 2] > 0.15) & (points[:, 2] < 1.6)
        over[name] = int((near.any(axis=1) & low).sum())
        floor = np.abs(points[:, 2]) < 0.01
        assert (near & floor[:, None]).sum(axis=0).min() > 0.5 * 1.6**2 / 0.2**2
    assert over == {"taken": 0, "free": 0}


def test_a_large_map_is_divided_into_tiles(tmp_path):
    places = np.random.default_rng(1).uniform((-30.0, -50.0, 0.0), (90.0, 20.0, 3.0), (50_000, 3)).astype(np.float32)
    write_point_cloud(places, tmp_path)
    metadata = yaml.safe_load((tmp_path / "pointcloud_map_metadata.yaml").read_text())
    assert (metadata.pop("x_resolution"), metadata.pop("y_resolution")) == (20.0, 20.0)
    assert {file.name for file in (tmp_path / "pointcloud_map.pcd").iterdir()} == metadata.keys()
    read = []
    for name, low in metadata.items():
        assert all(type(value) is int for value in low)
        points = read_pcd(tmp_path / "pointcloud_map.pcd" / name)
        assert (points[:, :2] >= low).all()
        assert (points[:, :2] <= np.add(low, 20)).all()
        read.append(points)
    found = np.concatenate(read)
    assert (np.sort(found.view("f4,f4,f4"), axis=0) == np.sort(places.view("f4,f4,f4"), axis=0)).all()


def read_pcd(path):
    """Points of a binary PCD file of x, y and z alone."""
    header, _, data = path.read_bytes().partition(b"DATA binary\n")
    lines = dict(line.split(" ", 1) for line in header.decode().splitlines() if not line.startswith("#"))
    assert (lines["FIELDS"], lines["SIZE"], lines["TYPE"], lines["HEIGHT"]) == ("x y z", "4 4 4", "F F F", "1")
    points = np.frombuffer(data, "<f4").reshape(-1, 3)
    assert len(points) == int(lines["POINTS"]) == int(lines["WIDTH"])
    return points
