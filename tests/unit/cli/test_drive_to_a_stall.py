"""`garage2usd drive --stall`: trajectories, and the car in time over the stage."""

import csv
import json

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Sdf, Usd, UsdGeom
from support.small_garage import SETTINGS, with_trolley

from garage2usd import GarageConfig, build
from garage2usd.cli import main
from garage2usd.config import load_config
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.driving import DesignCar
from garage2usd.stage.driving_car import CAR_NAME, body_within

STALL = "Stall_r00_c01_2"


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("driven") / "small.usda")


def driven(path, *options):
    return CliRunner().invoke(main, ["drive", *([] if path is None else [str(path)]), *options])


def rows_of(file):
    with file.open() as opened:
        table = list(csv.DictReader(opened))
    return {name: np.array([float(row[name]) for row in table]) for name in table[0]}


def test_a_stage_and_its_report_have_the_same_trajectory(made, tmp_path):
    texts = []
    for path in (made.stage, made.report):
        file = tmp_path / f"{path.suffix[1:]}.csv"
        result = driven(path, "--stall", STALL, "-o", str(file))
        assert result.exit_code == 0, result.output
        assert "arrival" in result.stdout
        assert "departure" in result.stdout
        texts.append(rows_of(file))
    for name, values in texts[0].items():
        # the ramp of a stage has its mesh's single precision; at the end it decides whether the car still brakes
        own = slice(-1) if name == "acceleration_m_s2" else slice(None)
        assert texts[1][name][own] == pytest.approx(values[own], abs=2e-4), name


def test_a_stall_is_found_by_name_and_number_in_letters_of_another_case(made, tmp_path):
    number = next(
        stall["number"]
        for stall in json.loads(made.report.read_text())["levels"][0]["stalls"]
        if stall["name"] == STALL
    )
    asked = {STALL, STALL.upper(), number, number.lower()}
    assert len(asked) == 4
    said = []
    for way, name in enumerate(sorted(asked)):
        result = driven(made.stage, "--stall", name, "--leg", "in", "-o", str(tmp_path / f"{way}.json"))
        assert result.exit_code == 0, result.output
        said.append((tmp_path / f"{way}.json").read_text())
    assert len(set(said)) == 1
    result = driven(made.stage, "--stall", f"{number.lower()}x")
    assert (result.exit_code, "one of the garage's" in result.output) == (1, True)
    assert result.output.rstrip().endswith("stalls: A1-01 to A1-11")
    assert len(result.output.splitlines()) == 1


def test_csv_and_json_hold_the_same(made, tmp_path):
    for suffix in ("csv", "json"):
        assert (
            driven(made.stage, "--stall", STALL, "--leg", "out", "-o", str(tmp_path / f"way.{suffix}")).exit_code == 0
        )
    document = json.loads((tmp_path / "way.json").read_text())
    for name, values in rows_of(tmp_path / "way.csv").items():
        assert document["columns"][name] == values.tolist()
    assert (document["stall"], document["leg"], document["entrance"]) == (STALL, "out", None)


def test_the_settings_of_a_configuration_and_of_its_report_count(tmp_path):
    config = tmp_path / "slow.toml"
    config.write_text(
        'seed = 2\n[site]\nstructure = """\n....\nE==X\n....\n"""\n[bay]\ndimensioned = false\n'
        "[maps.drive]\nlane_speed_m_s = 1.25\n"
    )
    result = driven(config, "--stall", STALL, "-o", str(tmp_path / "slow.csv"))
    assert result.exit_code == 0, result.output
    rows = rows_of(tmp_path / "slow.csv")
    assert np.abs(rows["speed_m_s"]).max() == pytest.approx(1.25)
    report = build(load_config(config), tmp_path / "slow.usda").report
    assert driven(report, "--stall", STALL, "-o", str(tmp_path / "report.csv")).exit_code == 0
    for name, values in rows_of(tmp_path / "report.csv").items():
        assert values == pytest.approx(rows[name], abs=2e-4), name


@pytest.mark.parametrize("suffix", ["usda", "usdc"])
def test_the_car_drives_in_time_over_the_stage(made, tmp_path, suffix):
    layer, table = tmp_path / f"car.{suffix}", tmp_path / "way.csv"
    assert driven(made.stage, "--stall", STALL, "--animate", "-o", str(layer)).exit_code == 0
    assert driven(made.stage, "--stall", STALL, "-o", str(table)).exit_code == 0
    rows = rows_of(table)
    root = Usd.Stage.CreateInMemory()
    root.GetRootLayer().subLayerPaths = [str(layer), str(made.stage)]
    assert Usd.Stage.Open(str(layer)).GetTimeCodesPerSecond() == Usd.Stage.Open(str(made.stage)).GetTimeCodesPerSecond()
    car = root.GetPrimAtPath(f"/Garage/{CAR_NAME}")
    transform = UsdGeom.Xformable(car)
    last = Usd.Stage.Open(str(layer)).GetEndTimeCode()
    assert last == np.ceil(rows["time_s"][-1] * 24)
    for frame in np.linspace(0, last, 60).round().tolist():
        matrix = np.array(transform.ComputeLocalToWorldTransform(frame))
        seconds = min(frame / 24, rows["time_s"][-1])
        place = [np.interp(seconds, rows["time_s"], rows[name]) for name in ("x_m", "y_m", "z_m")]
        assert matrix[3, :3] == pytest.approx(place, abs=2e-3)
        yaw, pitch = (np.interp(seconds, rows["time_s"], rows[name]) for name in ("yaw_rad", "pitch_rad"))
        nose = -matrix[2, :3]
        assert nose == pytest.approx(
            [-np.sin(yaw) * np.cos(pitch), np.sin(pitch), -np.cos(yaw) * np.cos(pitch)], abs=3e-3
        )


def test_the_car_s_meshes_lie_within_the_design_car_and_its_wheels_roll(made, tmp_path):
    layer = tmp_path / "car.usdc"
    assert driven(made.stage, "--stall", STALL, "--leg", "in", "--animate", "-o", str(layer)).exit_code == 0
    stage = Usd.Stage.Open(str(layer))
    car = stage.OverridePrim(f"/Garage/{CAR_NAME}")
    stage.GetPrimAtPath("/Garage").SetSpecifier(Sdf.SpecifierDef)
    box = UsdGeom.BBoxCache(0.0, ["default"]).ComputeUntransformedBound(car).ComputeAlignedRange()
    low, high = np.array(box.GetMin()), np.array(box.GetMax())
    design = DesignCar()
    assert low[2] >= -design.ahead_m - 0.02
    assert high[2] <= design.rear_overhang_m + 0.02
    assert abs(low[1]) < 0.01
    assert max(abs(low[0]), high[0]) < 1.0
    body = body_within(design)
    assert body in CAR_BODIES
    wheels = [child for child in car.GetChildren() if child.GetName().endswith("Wheel")]
    assert sorted(wheel.GetName() for wheel in wheels) == [
        "FrontLeftWheel",
        "FrontRightWheel",
        "RearLeftWheel",
        "RearRightWheel",
    ]
    last = stage.GetEndTimeCode()
    for wheel in wheels:
        hub = np.array(UsdGeom.Xformable(wheel).GetLocalTransformation(0.0))[3, :3]
        assert hub[1] == pytest.approx(body.wheel_radius_m, abs=0.01)
        assert (hub[0] > 0) == ("Right" in wheel.GetName())
        assert hub[2] == pytest.approx(-body.wheelbase_m if "Front" in wheel.GetName() else 0.0, abs=0.01)
        turned = wheel.GetAttribute("xformOp:rotateX").Get(last)
        assert turned != 0
        assert wheel.HasAttribute("xformOp:rotateY") == ("Front" in wheel.GetName())


@pytest.mark.parametrize(
    ("options", "field"),
    [
        (["--stall", "nowhere", "-o", "way.csv"], "stall"),
        (["--stall", STALL, "--entrance", "2", "-o", "way.csv"], "entrance"),
        (["--stall", STALL, "--exit", "2", "-o", "way.csv"], "exit"),
        (["--stall", STALL, "-o", "way.usda"], "output"),
        (["--stall", STALL, "--animate", "-o", "way.csv"], "output"),
        (["--stall", STALL, "--animate"], "output"),
        (["--entrance", "1", "-o", "way.json"], "entrance"),
        (["--leg", "in", "-o", "way.json"], "leg"),
        (["--animate", "-o", "way.usda"], "animate"),
        (["--stall", STALL, "--rig", "avp_surround", "-o", "way.csv"], "rig"),
        (["--stall", STALL, "--animate", "--rig", "none", "-o", "way.usda"], "rig"),
    ],
)
def test_what_is_asked_amiss_is_one_error_and_no_file(made, tmp_path, monkeypatch, options, field):
    monkeypatch.chdir(tmp_path)
    result = driven(made.stage, *options)
    assert result.exit_code != 0
    assert f"{field}: got" in result.output + str(result.exception)
    assert list(tmp_path.iterdir()) == []


def test_a_stall_that_no_car_gets_into_is_refused_with_what_is_in_the_way(made, tmp_path):
    edited = with_trolley(made.stage, tmp_path / "edited.usdc")
    result = driven(edited, "--stall", STALL, "-o", str(tmp_path / "way.csv"))
    assert result.exit_code != 0
    assert "/Garage/Trolley" in result.output + str(result.exception)
    assert not (tmp_path / "way.csv").exists()
