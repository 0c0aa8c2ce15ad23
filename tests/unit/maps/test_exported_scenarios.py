"""Scenarios by `garage2usd export`, `build --with` and `garage2usd.export`, with the maps that they name."""

import math
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import shapely
import shapely.affinity
from click.testing import CliRunner
from pxr import Usd
from support.driving_simulation import outlines
from support.openscenario_checker import issues_of, needs_checker
from support.openscenario_reader import OpenScenario
from support.sample_files import each_small_sample
from support.small_garage import PLAN, SETTINGS, with_trolley
from support.trajectory_judge import OpenWorld

import garage2usd
from garage2usd.cli import main
from garage2usd.common.errors import ConfigError, MissingExtraError
from garage2usd.config.outputs import MapsConfig, ScenarioConfig
from garage2usd.maps.openscenario import EGO

STALL, TAKEN = "Stall_r00_c01_2", "Stall_r00_c01_1"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return garage2usd.build(garage2usd.GarageConfig(**SETTINGS), tmp_path_factory.mktemp("scenarios") / "small.usda")


def exported(path, *options):
    return CliRunner().invoke(main, ["export", str(path), *options])


def track_of(file):
    """Time, x, z and yaw in the stage's frame, of each vertex of the trajectory."""
    time, x, y, _, heading, _, _ = OpenScenario(file).track().T
    return np.stack([time, x, -y, heading - math.pi / 2], axis=1)


def stood_in(track, garage):
    """Names of the stalls within which the car stands at first, for the longest time, and at last."""
    moves = np.flatnonzero(np.hypot(*np.diff(track[:, 1:3], axis=0).T) > 1e-6)
    longest = moves[np.argmax(np.diff(track[moves, 0]))] + 1
    bodies = outlines(track[[0, longest, -1], 1:])
    grounds = {stall.name: shapely.Polygon(stall.corners_m()).buffer(0.02) for stall in garage.layout.stalls}
    return [next((name for name, ground in grounds.items() if ground.covers(body)), None) for body in bodies]


def test_a_scenario_brings_the_map_that_it_names(made, tmp_path):
    scenario, road = garage2usd.export(made.stage, [tmp_path / "new" / "a.xosc"])
    assert (scenario.name, road.name) == ("a.xosc", "a.xodr")
    assert OpenScenario(scenario).road_file == "a.xodr"
    (alone,) = garage2usd.export(made.stage, [tmp_path / "alone.xodr"])
    assert road.read_bytes() == alone.read_bytes()


@pytest.mark.parametrize("order", [["b.xosc", "b.xodr"], ["b.xodr", "b.xosc"]])
def test_a_map_that_is_asked_for_as_well_is_written_once(made, tmp_path, order):
    run = exported(made.stage, *(word for name in order for word in ("-o", str(tmp_path / name))))
    assert run.exit_code == 0, run.output
    assert [line.split("/")[-1] for line in run.stdout.splitlines()] == order
    assert {file.name for file in tmp_path.iterdir()} == set(order)


def test_without_a_stall_the_car_visits_the_first_free_one(made, tmp_path):
    track = track_of(garage2usd.export(made.stage, [tmp_path / "a.xosc"])[0])
    held = {car.stall for car in made.garage.layout.of_kind("car")}
    free = [stall.name for stall in made.garage.layout.stalls if stall.use.takes_cars and stall.name not in held]
    assert TAKEN in held
    stands = stood_in(track, made.garage)
    assert stands == [None, free[0], None]


def test_where_no_stall_is_free_the_parked_car_gives_way(tmp_path):
    parking = {"occupancy": 1.0, "accessible_share": 0.0}
    made = garage2usd.build(garage2usd.GarageConfig(**{**SETTINGS, "parking": parking}), tmp_path / "full.usda")
    cars = made.garage.layout.of_kind("car")
    assert len(cars) == len(made.garage.layout.stalls)
    scenario, _ = garage2usd.export(made.stage, [tmp_path / "full.xosc"], scenario=ScenarioConfig(leg="in"))
    assert stood_in(track_of(scenario), made.garage)[-1] == made.garage.layout.stalls[0].name
    assert len(OpenScenario(scenario).vehicles) == len(cars)  # Ego in the place of one


def test_options_settings_and_arguments_give_the_same_scenario(made, tmp_path):
    config = tmp_path / "g.toml"
    config.write_text(f'[maps.scenario]\nstall = "{TAKEN}"\nentrance = 1\nexit = 1\nleg = "out"\n')
    options = ["--stall", TAKEN, "--entrance", "1", "--exit", "1", "--leg", "out"]
    for name, given in (("options", options), ("config", ["--config", str(config)])):
        run = exported(made.stage, "-o", str(tmp_path / name / "a.xosc"), *given)
        assert run.exit_code == 0, run.output
    asked = ScenarioConfig(stall=TAKEN, entrance=1, exit=1, leg="out")
    garage2usd.export(made.stage, [tmp_path / "asked" / "a.xosc"], scenario=asked)
    garage2usd.export(made.stage, [tmp_path / "settings" / "a.xosc"], settings=MapsConfig(scenario=asked))
    texts = {(tmp_path / name / "a.xosc").read_bytes() for name in ("options", "config", "asked", "settings")}
    assert len(texts) == 1
    stands = stood_in(track_of(tmp_path / "asked" / "a.xosc"), made.garage)
    assert (stands[0], stands[-1]) == (TAKEN, None)


def test_build_with_takes_the_configuration_s_scenario(tmp_path):
    config = tmp_path / "g.toml"
    config.write_text(
        f'seed = 2\n[site]\nstructure = """{PLAN}"""\n[bay]\ndimensioned = false\n'
        f'[maps.scenario]\nstall = "{STALL}"\nleg = "in"\n'
    )
    run = CliRunner().invoke(main, ["build", str(config), "--with", "xosc", "-o", str(tmp_path / "g.usdc")])
    assert run.exit_code == 0, run.output
    for name in ("g.xosc", "g.xodr"):
        assert f"export  {tmp_path / name}" in run.output
    garage = garage2usd.generate(garage2usd.load_config(config))
    assert stood_in(track_of(tmp_path / "g.xosc"), garage)[-1] == STALL
    again, _ = garage2usd.export(tmp_path / "g_report.json", [tmp_path / "again" / "g.xosc"])
    assert again.read_bytes() == (tmp_path / "g.xosc").read_bytes()


@pytest.mark.parametrize(
    ("outputs", "options", "said"),
    [
        (["a.xosc"], ["--stall", "nowhere"], "stall: got 'nowhere'"),
        (["a.glb", "a.xosc"], ["--entrance", "2"], "entrance: got 2"),
        (["a.xosc"], ["--exit", "0"], "0 is not in the range x>=1"),
        (["a.xosc"], ["--leg", "away"], "'away' is not one of"),
        (["a.xodr"], ["--leg", "in"], "ends in .xosc"),
    ],
)
def test_what_is_asked_amiss_is_one_error_and_no_file(made, tmp_path, outputs, options, said):
    folder = tmp_path / "out"
    run = exported(made.stage, *(word for name in outputs for word in ("-o", str(folder / name))), *options)
    assert run.exit_code != 0
    assert said in run.output + str(run.exception)
    assert not folder.exists()


def test_a_stall_that_no_car_gets_into_is_refused_with_what_is_in_the_way(made, tmp_path):
    edited = with_trolley(made.stage, tmp_path / "edited.usdc")
    with pytest.raises(ConfigError, match=r"stall: .*/Garage/Trolley"):
        garage2usd.export(edited, [tmp_path / "out" / "a.xosc"], scenario=ScenarioConfig(stall=STALL))
    assert not (tmp_path / "out").exists()


def test_a_stage_without_an_exit_and_one_without_lanes_are_refused(made, tmp_path):
    stage = Usd.Stage.Open(str(made.stage))
    stage.SetEditTarget(stage.GetSessionLayer())
    kinds = stage.GetPrimAtPath("/Garage/LaneGraph/Nodes").GetAttribute("garage:lane:kind")
    kinds.Set([str(kind).replace("exit", "lane") for kind in kinds.Get()])
    stage.Export(str(tmp_path / "closed.usdc"))
    with pytest.raises(ConfigError, match="a stall that lanes and ramps join with the street"):
        garage2usd.export(tmp_path / "closed.usdc", [tmp_path / "out" / "a.xosc"])
    stage.GetPrimAtPath("/Garage/LaneGraph").SetActive(False)
    stage.Export(str(tmp_path / "bare.usdc"))
    with pytest.raises(ConfigError, match="a stall that lanes and ramps join with the street"):
        garage2usd.export(tmp_path / "bare.usdc", [tmp_path / "out" / "a.xosc"])
    assert not (tmp_path / "out").exists()


def test_without_the_extra_it_is_refused_before_a_garage_is_made(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "scenariogeneration", None)
    with pytest.raises(MissingExtraError, match=r"pip install .*\[maps\]"):
        garage2usd.export(tmp_path / "none.usdc", [tmp_path / "a.xosc"])
    run = CliRunner().invoke(main, ["build", "--with", "xosc", "-o", str(tmp_path / "g.usdz")])
    assert run.exit_code != 0
    assert "[maps]" in run.output + str(run.exception)
    assert not list(tmp_path.iterdir())


@needs_checker
@each_small_sample
def test_the_scenario_of_a_sample_is_sound_and_touches_nothing(sample, builds, tmp_path):
    made = builds(sample, "usdc")
    scenario, road = garage2usd.export(made.stage, [tmp_path / "s.xosc"])
    assert issues_of(scenario, tmp_path) == []
    read = OpenScenario(scenario)
    assert read.road_file == road.name
    spaces = [thing for thing in ET.parse(road).getroot().iter("object") if thing.get("type") == "parkingSpace"]
    stalls = {stall.name for stall in made.garage.layout.stalls if stall.use.takes_cars}
    assert {space.get("name") for space in spaces} == stalls
    track = track_of(scenario)
    name = stood_in(track, made.garage)[1]
    stall = next(stall for stall in made.garage.layout.stalls if stall.name == name)
    rows = dict(zip(("time_s", "x_m", "z_m", "yaw_rad"), track.T, strict=True))
    assert OpenWorld(made.garage).swept(rows, stall) == set()
    bodies = outlines(track[:, 1:])
    swept = shapely.convex_hull(shapely.union(bodies[:-1], bodies[1:]))
    parked = [shapely.affinity.scale(read.box(name)[0], 1, -1, origin=(0, 0)) for name in read.vehicles if name != EGO]
    assert not len(shapely.STRtree(swept).query(parked, predicate="intersects")[0])
