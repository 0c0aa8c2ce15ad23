"""Whole data sets made and verified in this process: what their files are called, and what a run that fails leaves."""

import gzip
import re
import tarfile
from contextlib import contextmanager

import pytest
import yaml
from click.testing import CliRunner
from support.data_sets import SMALL, small_recipe, tree_of
from support.soak import soak_but

from garage2usd.cli import main
from garage2usd.common.errors import ConfigError
from garage2usd.datasets import cluster, make_dataset, verify_dataset

ALL = ["add.xml", "dxf", "geojson", "glb", "osm", "osm.xml", "xodr", "xosc", "yaml"]
MASKS = {"maps": {"grid": {"resolution_m": 0.5, "keepout": True, "speed": True}}}
TEXTS = {"add.xml", "difficulty.json", "keepout.yaml", "labels.json", "netccfg", "osm", "report.json", "speed.yaml"}
TEXTS |= {"dxf", "geojson", "osm.xml", "xodr", "xosc", "yaml"}
PICTURES = {"pgm", "keepout.pgm", "speed.pgm"}


class OneProcess:
    """Does tasks as workers do, here."""

    def each(self, function, tasks, *shared):
        return ((task, function(*shared, task)) for task in tasks)


@pytest.fixture
def in_one_process(monkeypatch):
    """No cluster is started."""

    @contextmanager
    def workers(**_):
        yield OneProcess()

    monkeypatch.setattr(cluster, "workers", workers)


@pytest.mark.parametrize(
    ("form", "is_gzip", "is_self_contained", "exports"),
    soak_but(
        [("folder", False, False, ["xosc"])],
        [
            ("tar", False, False, ALL),
            ("tar", True, True, ALL),
            ("folder", False, True, ALL),
            ("folder", True, False, ALL),
            ("tar", True, False, ["yaml"]),
            ("folder", False, False, ["xosc"]),
            ("tar", False, True, []),
        ],
    ),
)
def test_every_file_belongs_to_its_garage_and_a_fresh_set_verifies(
    in_one_process, tmp_path, form, is_gzip, is_self_contained, exports
):
    make = {"exports": exports, "gzip": is_gzip, "self_contained": is_self_contained}
    shards = {"garages": 1, "form": form}
    recipe = small_recipe(count=2, garage={**SMALL["garage"], **MASKS}, make=make, shards=shards, splits={"all": 1})
    folder = tmp_path / "a [1]" / "set"
    made = make_dataset(recipe, folder)
    assert not made.failed
    assert verify_dataset(folder) == []
    brought = {"yaml": PICTURES | {"keepout.yaml", "speed.yaml"}, "xosc": {"xodr"}, "add.xml": {"netccfg", "xodr"}}
    expected = {"report.json", "difficulty.json", "labels.json", "plan.png", *exports}
    expected |= {"usdz"} if is_self_contained else {"usdc", "Drive.usdc", "LaneGraph.usdc"}
    expected |= {name for each in exports for name in brought.get(each, ())}
    packed = {f"{name}.gz" if is_gzip and name in TEXTS else name for name in expected}
    for row in made.rows:
        assert {file.suffix for file in row.files} == {f".{name}" for name in packed}
        place = folder / "shards" / row.shard
        if form == "tar":
            with tarfile.open(f"{place}.tar") as archive:
                archive.extractall(folder / "shards", filter="data")
        # as WebDataset takes names apart
        assert {path.name.partition(".")[::2] for path in place.iterdir()} == {(f"{row.number:08}", n) for n in packed}
        for name in packed & {"yaml.gz", "keepout.yaml.gz", "speed.yaml.gz", "yaml", "keepout.yaml", "speed.yaml"}:
            data = place.joinpath(f"{row.number:08}.{name}").read_bytes()
            said = yaml.safe_load(gzip.decompress(data) if is_gzip else data)
            assert place.joinpath(said["image"]).read_bytes()[:2] == b"P5"


def test_a_scheduler_that_cannot_be_reached_leaves_nothing(tmp_path, monkeypatch):
    monkeypatch.setattr(cluster, "_CONNECT_S", 0.5)
    there = tmp_path / "there"
    there.mkdir()
    for folder in (tmp_path / "new" / "deeper", there):
        with pytest.raises(ConfigError, match="scheduler: got"):
            make_dataset(small_recipe(), folder, scheduler="tcp://127.0.0.1:9")
    assert [path.name for path in tmp_path.rglob("*")] == ["there"]


def test_another_run_that_began_while_workers_started_is_not_overwritten(tmp_path, monkeypatch):
    @contextmanager
    def workers(**_):
        (tmp_path / "set").mkdir()
        (tmp_path / "set" / "recipe.json").write_text(small_recipe(seed=9).record())
        yield OneProcess()

    monkeypatch.setattr(cluster, "workers", workers)
    before = small_recipe(seed=9).record()
    with pytest.raises(ConfigError, match="the data set of another recipe"):
        make_dataset(small_recipe(), tmp_path / "set")
    assert (tmp_path / "set" / "recipe.json").read_text() == before
    assert len(tree_of(tmp_path)) == 1


def test_splits_that_are_too_small_for_a_garage_are_named(in_one_process, tmp_path):
    (tmp_path / "r.json").write_text(small_recipe(splits={"train": 0.8, "dev": 0.15, "test": 0.05}).record())
    said = CliRunner().invoke(main, ["dataset", str(tmp_path / "r.json"), "--count", "2", "-o", str(tmp_path / "set")])
    assert said.exit_code == 0, said.output
    assert "dev gets none of the 2 garages: its share is 0.3\n" in said.stderr
    assert "test gets none of the 2 garages: its share is 0.1\n" in said.stderr
    assert re.findall(r"(\w+)  (\d+) garages", said.stdout) == [("train", "2"), ("dev", "0"), ("test", "0")]


@pytest.mark.parametrize(
    "look", soak_but(1, [{"drawn": ["lights"]}, {"lights": {"dead_share": 0.9}}]), ids=["drawn", "given"]
)
def test_dead_lamps_of_a_look_are_no_fault(in_one_process, tmp_path, look):
    recipe = small_recipe(count=3, garage={**SMALL["garage"], "look": look}, shards={"garages": 3}, splits={"all": 1})
    make_dataset(recipe, tmp_path / "set")
    assert verify_dataset(tmp_path / "set") == []
