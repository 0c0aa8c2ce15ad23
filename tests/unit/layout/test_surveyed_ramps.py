"""Ramps of surveyed buildings: their lines, meshes, openings, lanes and drives."""

import dataclasses
import itertools
import json
import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from support.bend_judge import overlaps
from support.level_judge import LevelJudge
from support.levels_osm import ramp_file

from garage2usd.assets.materials import MATERIALS
from garage2usd.assets.mesh import Part
from garage2usd.checks.levels import findings_of_whole
from garage2usd.config import GarageConfig, config_from_mapping
from garage2usd.driving import DesignCar, Pose
from garage2usd.driving.line_fit import pieces_along
from garage2usd.driving.path import Path
from garage2usd.garage.levels import unreached_stalls
from garage2usd.garage.path_line import PathLine
from garage2usd.garage_sources import drive, read_built
from garage2usd.imports import import_layout
from garage2usd.layout.surveyed.ramp_places import placed_ramps
from garage2usd.maps.arc_line import line_of_arcs
from garage2usd.objects.ceiling import OpenCeilingSpec
from garage2usd.survey.reader import read_building
from garage2usd.survey.surveyed_building import aligned_building

LOW = config_from_mapping({"stage": {"texture_quality": "low"}})
BENT = [(-6.0, -10.0), (-6.0, -22.0), (40.0, -22.0), (40.0, -10.0)]


def imported(tmp_path_factory, *names, **line):
    folder = tmp_path_factory.mktemp("ramps")
    return import_layout(ramp_file(*names, **line).write(folder / "a.osm"), folder / "a.usdc", config=LOW)


@pytest.fixture(scope="module")
def below(tmp_path_factory):
    return imported(tmp_path_factory, "0", "-1")


@pytest.fixture(scope="module")
def stacked(tmp_path_factory):
    return imported(tmp_path_factory, "1", "0", "-1")


@pytest.fixture(scope="module")
def bent(tmp_path_factory):
    return imported(tmp_path_factory, "0", "-1", line=BENT)


@pytest.fixture(scope="module")
def swung(tmp_path_factory):
    """A ramp that swings aside and back, so that its ends lie in one line."""
    line = [(-6.0, -10.0), (4.0, -10.0), (14.0, -15.0), (22.0, -15.0), (32.0, -10.0), (40.0, -10.0)]
    return imported(tmp_path_factory, "0", "-1", line=line)


@pytest.mark.parametrize("name", ["below", "stacked", "bent", "swung"])
def test_cars_reach_every_stall_over_the_ramp(name, request):
    made = request.getfixturevalue(name)
    assert unreached_stalls(made.garage.joined, may_turn_back=True) == []
    assert {proof.outcome.value for proof in made.proofs} == {"reached"}
    built, profile, *_ = read_built(made.stage)
    assert findings_of_whole(built, profile) == []
    assert built.faults == ()
    storeys = len(made.garage.levels) - 1
    assert [line.is_down for line in built.ramp_lines] == [False, True] * storeys
    for line in built.ramp_lines:
        assert np.ptp(line.places[[0, -1], 1]) == pytest.approx(3.6, abs=1e-6)
        assert line.width_m == pytest.approx(3.35, abs=0.1)


@pytest.mark.parametrize(("name", "turned_deg"), [("bent", 180.0), ("swung", 0.0)])
def test_a_drive_keeps_on_the_floor_and_between_the_walls_of_a_ramp_that_bends(name, turned_deg, request):
    made = request.getfixturevalue(name)
    assert not [remark for remark in made.remarks if "ramp" in remark]
    judge, states = LevelJudge(made.stage), drive(made.stage, "U2/3").trajectory
    places = np.stack([states.x_m, states.y_m, states.z_m], axis=1)
    on_ramp = (states.y_m < -0.01) & (states.y_m > -3.59)
    heights, _ = judge.ground().nearest(places[states.y_m < 0.0])
    assert np.abs(heights - places[states.y_m < 0.0, 1]).max() < 1e-3
    assert states.y_m.min() == pytest.approx(-3.6, abs=1e-4)
    down = on_ramp & (states.arc_m < states.arc_m[on_ramp].mean())
    assert abs(math.degrees(np.ptp(states.yaw_rad[down][[0, -1]]))) == pytest.approx(turned_deg, abs=25.0)
    assert np.abs(states.speed_m_s[on_ramp]).min() > 0.5
    standing = [
        (f"{level}/{label}", part)
        for (level, label), parts in judge.triangles.items()
        if label not in {"car", "number_plate", "barrier"}
        for part in parts
    ]
    assert overlaps(states, standing) == set()
    walls = [each for each in standing if each[0].endswith("/ramp")]
    assert overlaps(states, walls, wider_m=0.8)  # those of the ramp are found


@pytest.mark.parametrize(
    ("name", "stall", "street"), [("below", "U2/3", 0), ("stacked", "U1/3", 1), ("stacked", "U3/3", 1)]
)
def test_a_drive_leads_from_the_street_over_the_ramp(name, stall, street, request):
    made = request.getfixturevalue(name)
    doors = [len(level.layout.of_kind("portal")) for level in made.garage.levels]
    assert doors == [1 if number == street else 0 for number in range(len(doors))]
    found = drive(made.stage, stall).trajectory
    parked = found.y_m[np.argmin(np.abs(found.speed_m_s) + (found.arc_m < 60))]
    assert parked == pytest.approx(-3.6 * (int(stall[1]) - 1), abs=0.01)
    slopes = np.abs(np.diff(found.y_m)) / np.maximum(np.diff(found.arc_m), 1e-3)
    assert slopes[np.diff(found.arc_m) > 0.02].max() < 0.2
    ends = found.y_m[[0, -1]] - (0.0 if street == 0 else -3.6)
    assert ends == pytest.approx([3.4, 3.4], abs=0.3)  # at the tops of the ramps to the street


def test_the_report_has_the_ramps(below):
    links = json.loads(below.report.read_text())["links"]
    assert [(link["kind"], link["upper"], link["lower"], link["direction"]) for link in links] == [
        ("surveyed", "U1", "U2", "up"),
        ("surveyed", "U1", "U2", "down"),
    ]
    assert {link["rise_m"] for link in links} == {3.6}
    assert all(link["steepest_percent"] <= 15.0 + 1e-6 for link in links)


def test_floors_and_ceilings_are_open_over_the_ramp(below):
    upper, lower = (level.layout for level in below.garage.levels)
    for ramp in lower.source.part.ramps.up:
        runs = np.linspace(ramp.open_m + 0.2, ramp.line.length_m - 0.2, 40)
        places = ramp.line.at(runs)
        for kind, layout in (("floor", upper), ("ceiling", lower)):
            for slab in layout.of_kind(kind):
                half_x, half_z = slab.spec.width_m / 2, slab.spec.depth_m / 2
                openings = [shapely.Polygon(shape) for shape in getattr(slab.spec, "openings", ())]
                shape = shapely.box(-half_x, -half_z, half_x, half_z).difference(shapely.union_all(openings))
                x, _, z = slab.position_m
                assert not shapely.contains_xy(shape, places.u_m - x, places.v_m - z).any(), kind


def volume_m3(part: Part):
    """Return the volume that the faces of a part enclose, by the theorem of Gauss; negative if they face inwards."""
    volume, first = 0.0, 0
    for count in part.face_counts:
        corners = part.points.astype(np.float64)[part.face_indices[first : first + count]]
        volume += sum(np.linalg.det(corners[[0, at, at + 1]]) for at in range(1, count - 1)) / 6
        first += count
    return volume


def test_an_open_ceiling_is_a_closed_slab():
    hole = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    edge = ((3.0, -2.0), (5.0, -2.0), (5.0, 0.0), (3.0, 0.0))
    (slab,) = OpenCeilingSpec(8.0, 6.0, 0.25, openings=(hole, edge)).asset().parts
    assert volume_m3(slab) == pytest.approx((8 * 6 - 4 - 2) * 0.25)


def test_the_walls_of_a_ramp_face_outwards(below):
    ramps = [place for place in below.garage.levels[1].layout.of_kind("ramp") if "way" in place.name]
    assert len(ramps) == 2
    for place in ramps:
        parts = {part.name: part for part in place.spec.asset().parts}
        assert {"Floor", "Slab", "HeadWall", "FootWall"} < parts.keys()
        assert len([name for name in parts if name.endswith(("LeftWall", "RightWall"))]) == 1
        head = parts["HeadWall"]
        size = np.ptp(head.points, axis=0)
        assert volume_m3(head) == pytest.approx(np.prod(size), rel=1e-6)
        floor = parts["Floor"]
        assert floor.points[:, 1].max() == pytest.approx(3.6)
        assert floor.points[:, 1].min() == 0.0


def test_textures_are_hardly_stretched_on_a_ramp_that_bends(bent):
    for place in (place for place in bent.garage.levels[1].layout.of_kind("ramp") if "way" in place.name):
        for part in place.spec.asset().parts:
            look, first = MATERIALS[part.material], 0
            repeats_m = look.repeat_m, look.repeat_up_m or look.repeat_m
            for count in part.face_counts.tolist():
                at = slice(first, first + count)
                first += count
                steps = np.diff(part.points[part.face_indices[at]].astype(float), axis=0)[:2]
                drawn = np.diff(part.st[part.st_indices[at]] * repeats_m, axis=0)[:2]
                if np.linalg.norm(np.cross(*steps)) > 0.01:
                    lengths = np.linalg.norm(steps, axis=1)
                    assert np.linalg.norm(drawn, axis=1) == pytest.approx(lengths, rel=0.09), part.name


def test_a_line_keeps_its_distance_and_rounds_its_corners():
    line = PathLine.rounded([(0.0, 0.0), (20.0, 0.0), (20.0, 30.0)], 4.0, 8.0)
    assert line.length_m == pytest.approx(50 - 16 + 4 * math.pi, abs=0.01)
    assert not line.is_straight
    runs = np.linspace(0.0, line.length_m, 60)
    beside = line.beside(1.5, 2.0)
    assert shapely.distance(line.line, shapely.points(beside.at(runs[2:-8]).u_m, beside.at(runs[2:-8]).v_m)) == (
        pytest.approx(1.5, abs=0.02)
    )
    places = line.at(runs)
    assert line.foot(places.u_m, places.v_m)[0] == pytest.approx(runs, abs=1e-6)
    assert line.ground(0.0, line.length_m, (2.0, 2.0)).area == pytest.approx(4 * line.length_m, rel=0.01)
    assert line.between(5.0, 12.0).length_m == pytest.approx(7.0)
    assert PathLine.rounded([(0.0, 0.0), (9.0, 0.0)], 3.0, 8.0).is_straight


@pytest.fixture(scope="module")
def building(tmp_path_factory):
    return aligned_building(read_building(ramp_file("0", "-1").write(tmp_path_factory.mktemp("b") / "a.osm")))[0]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"points": ((14.0, 30.0), (30.0, 30.0))}, "its end is more than 1.5 m from the lanes"),
        ({"points": ((18.0, 11.5), (32.0, 11.5))}, "0.0 m between the lanes for 3.60 m of height; 18.6 m are needed"),
        ({"points": ((14.0, 6.0), (60.0, 6.0))}, "its end is more than 1.5 m from the lanes"),
        ({"points": ((14.0, 17.0), (60.0, 17.0))}, "stalls or columns stand on its 6.4 m"),
    ],
)
def test_a_ramp_that_cannot_be_built_is_named(building, change, reason):
    (ramp,) = building.ramps
    broken = replace(building, ramps=(replace(ramp, **change),))
    ramps, remarks = placed_ramps(broken, [0.0, -3.6], [GarageConfig()] * 2)
    assert remarks == [f"ramp way 32 between levels 0 and -1 is not built: {reason}"]
    assert all(not own.up and not own.down for own in ramps)


def test_a_ramp_past_a_level_is_named(building):
    (ramp,) = building.ramps
    levels = (building.levels[0], replace(building.levels[1], name="M"), building.levels[1])
    _, remarks = placed_ramps(replace(building, levels=levels), [0.0, -3.6, -7.2], [GarageConfig()] * 3)
    assert remarks == ["ramp way 32 between levels 0 and -1 is not built: it does not join levels next to one another"]
    assert ramp.levels == ("0", "-1")


def test_a_line_of_arcs_is_smooth_and_passes_its_places():
    places = PathLine.rounded([(0.0, 0.0), (20.0, 0.0), (20.0, 30.0), (60.0, 40.0), (30.0, 60.0)], 4.0, 8.0).points
    line, runs = line_of_arcs(places)
    assert max(math.dist(line.at(run)[:2], place) for run, place in zip(runs, places, strict=True)) < 1e-3
    for one, other in itertools.pairwise(line.arcs):
        x, y, heading = one.at(one.length_m)
        assert math.dist((x, y), other.start) < 1e-9
        assert heading == pytest.approx(other.heading_rad, abs=1e-9)
    assert len(line.arcs) < len(places) / 4
    bent = [arc.curvature_per_m for arc in line.arcs if abs(arc.curvature_per_m) > 1e-3]
    assert np.abs(bent) == pytest.approx(1 / 8, rel=1e-3)


def test_a_path_keeps_both_axles_along_a_line_and_a_bend_that_is_too_tight_has_none():
    line = PathLine.rounded([(0.0, 10.0), (0.0, -20.0), (30.0, -20.0)], 3.5, 8.0)
    start, end = Pose(0.0, 8.0, 0.0), Pose(26.0, -20.0, -math.pi / 2)
    path = Path(start, pieces_along(line, start, end, DesignCar()))
    assert dataclasses.astuple(path.end) == pytest.approx(dataclasses.astuple(end), abs=1e-5)
    at = path.at(np.linspace(0.0, path.length_m, 200))
    assert np.abs(line.foot(at.x_m, at.z_m)[1]).max() == pytest.approx(0.225, abs=0.04)  # half of 8 - sqrt(8^2 - 2.7^2)
    assert [piece.start_per_m for piece in path.pieces[1:]] == [piece.end_per_m for piece in path.pieces[:-1]]
    tight = PathLine.rounded([(0.0, 10.0), (0.0, 0.0), (2.0, 0.0), (2.0, 10.0)], 3.5, 1.0)
    assert pieces_along(tight, start, Pose(2.0, 8.0, math.pi), DesignCar()) is None
