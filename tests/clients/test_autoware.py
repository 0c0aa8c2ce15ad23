"""Folders for Autoware of garages of all kinds: the requirements of its maps, and what Lanelet2 and Open3D read."""

import time
from functools import cache

import pytest
from pxr import Usd
from support.autoware_folder import AutowareFolder, cloud_complaints
from support.map_judges import HAS_LANELET2, lanelet2_map
from support.sample_files import REPOSITORY
from support.sensor_judges import HAS_SENSOR_JUDGES
from support.small_levels import SMALL_HELICES, SMALL_LEVELS

import garage2usd
from garage2usd import GarageConfig, load_config
from garage2usd.imports import import_layout

pytestmark = [pytest.mark.client, pytest.mark.soak]
SAMPLES = REPOSITORY / "samples"
LEFT = {"seed": 3, "profile": "uk-istructe"}
GARAGES = {
    "one level": lambda: load_config(SAMPLES / "paper_7x9.toml"),
    "irregular": lambda: load_config(SAMPLES / "irregular.toml"),
    "slanted and mixed": lambda: load_config(SAMPLES / "mixed_stalls.toml"),
    "dimensioned": lambda: load_config(SAMPLES / "dimensioned.toml"),
    "two levels": lambda: SMALL_LEVELS,
    "helices": lambda: SMALL_HELICES,
    "three levels": lambda: load_config(SAMPLES / "three_levels.toml"),
    "left-hand traffic": lambda: GarageConfig(**LEFT),
    "imported": lambda: SAMPLES / "surveys/lot.toml",
    "imported levels": lambda: SAMPLES / "surveys/levels.osm",
    "large": lambda: load_config(SAMPLES / "large_20x30.toml"),
}
OVERLAPPING = {"imported levels": {"Extension.TurnDirection", "Lane.BorderSharing-001"}}
"""Rules on lanelets over each other that a layout breaks: its ramps lie closer together than their lanes are wide."""
MOST_S, MOST_MB = 60.0, 60.0


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """The stage and folder of a garage, and the seconds of a processor that its export took."""

    @cache
    def make(name):
        folder, source = tmp_path_factory.mktemp("garage"), GARAGES[name]()
        build = garage2usd.build if isinstance(source, GarageConfig) else import_layout
        stage = build(source, folder / "garage.usdc").stage
        begun = time.process_time()
        garage2usd.export(stage, [folder / "garage.autoware"])
        return stage, folder / "garage.autoware", time.process_time() - begun

    return make


def levels_of(folder):
    """Names of the maps of single levels, or the one of the only level: rules look at maps from above."""
    return [path.stem.removeprefix("lanelet2_map_") for path in sorted(folder.glob("lanelet2_map_*.osm"))] or [""]


@pytest.mark.parametrize("name", GARAGES)
def test_maps_obey_autoware_s_requirements(name, made):
    _, folder, _ = made(name)
    for level in levels_of(folder):
        assert list(AutowareFolder(folder, level).complaints(but=OVERLAPPING.get(name, ()))) == [], level


@pytest.mark.parametrize("name", GARAGES)
def test_an_export_takes_at_most_a_minute_and_sixty_megabytes(name, made):
    _, folder, seconds = made(name)
    megabytes = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file()) / 1e6
    assert seconds < MOST_S, f"{name}: {seconds:.1f} s, {megabytes:.1f} MB"
    assert megabytes < MOST_MB, f"{name}: {seconds:.1f} s, {megabytes:.1f} MB"


@pytest.mark.skipif(not HAS_LANELET2, reason="no environment with lanelet2")
@pytest.mark.parametrize("name", GARAGES)
def test_lanelet2_reads_the_map_and_routes_as_the_rules_assume(name, made, tmp_path):
    """The rule of speed bumps is Autoware's own; all else is read without an error."""
    _, folder, _ = made(name)
    judged = AutowareFolder(folder).map
    found = lanelet2_map(folder / "lanelet2_map.osm", tmp_path, 49.0, 9.0)
    unknown = [f"get id {number} from" for number in judged.rules("speed_bump")]
    assert [error for error in found["errors"][1:] if not any(text in error for text in ("speed_bump", *unknown))] == []
    assert found["faults"] == []
    if name not in OVERLAPPING:  # a road of 5 cm there keeps both of its ends
        assert found["close"] == []
    assert {one["id"]: sorted(one["following"]) for one in found["lanelets"]} == {
        number: sorted(onward) for number, onward in judged.following.items()
    }
    assert all(one["passable"] and one["one_way"] for one in found["lanelets"])


@pytest.mark.skipif(not HAS_SENSOR_JUDGES, reason="no environment with Open3D")
@pytest.mark.parametrize("name", GARAGES)
def test_open3d_reads_points_within_a_centimetre_of_the_surfaces(name, made, tmp_path):
    stage, folder, _ = made(name)
    assert list(cloud_complaints(folder, Usd.Stage.Open(str(stage)), tmp_path)) == []
