"""Strangers' validators find nothing."""

import csv
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from pxr import Sdf, Usd, UsdValidation
from support.label_tables import labelled_objects
from support.sample_files import OBJECT_SAMPLES, SAMPLES, USUAL_SAMPLES, each_build, each_package
from support.small_garage import SETTINGS
from support.small_levels import SMALL_LEVELS
from support.soak import soak_but

from garage2usd import GarageConfig, build

pytestmark = pytest.mark.client

# NVIDIA's validator takes every choice of a variant set for a stage of its own, which is done with a garage of nine
# squares. Each thousand meshes of instances take it 1 to 2 s, so samples are validated without them, and with them a
# small garage that has all kinds of things that the paper's has. It then does not see the meshes of the samples'
# prototypes, which are validated as files of their own.
ALL_KINDS = {
    "seed": 4,
    "site": {"width_cells": 4, "height_cells": 4},
    "plan": {"episodes": 40},
    "fittings": {"speed_bump_rate": 1.0},
}
Z_UP = {**ALL_KINDS, "stage": {"up_axis": "Z"}}
VARIED = {
    "site": {"structure": "...\nE=X\n...\n"},
    "parking": {"occupancy": 0.0, "occupied_stalls": ["Stall_r00_c01_1"]},
}
PAPER = [sample for sample in SAMPLES if sample.stem == "paper_7x9"]
MIXED = [sample for sample in SAMPLES if sample.stem == "mixed_stalls"]


def usd_findings(path):
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    return [f"{f.GetName()} {f.GetMessage()}" for f in context.Validate(Usd.Stage.Open(str(path)))]


@each_package
def test_usd_validation_finds_nothing(sample, extension, builds):
    """Of packages, to which some of its rules are peculiar."""
    assert usd_findings(builds(sample, extension).stage) == []


def nvidia_findings(asset, output, *options):
    command = shutil.which("nvidia_usd_validate", path=str(Path(sys.executable).parent))
    run = subprocess.run(
        [command, str(asset), *options, "--csv-output", str(output)],
        capture_output=True,
        text=True,
        timeout=600,
        check=False,
    )
    assert output.exists(), run.stdout[-2000:] + run.stderr[-2000:]
    with output.open() as file:
        return list(csv.DictReader(file))


@each_build
def test_nvidia_validation_finds_nothing(sample, extension, builds, tmp_path):
    options = ["--no-variants", "--no-instance-prototypes"]
    assert nvidia_findings(builds(sample, extension).stage, tmp_path / "findings.csv", *options) == []


def test_nvidia_validation_finds_nothing_in_a_garage_whose_z_points_up(tmp_path):
    stage = build(GarageConfig(**Z_UP), tmp_path / "garage.usdc").stage
    assert usd_findings(stage) == []
    assert nvidia_findings(stage, tmp_path / "findings.csv", "--no-variants", "--no-instance-prototypes") == []


@pytest.fixture(scope="module")
def all_kinds(tmp_path_factory):
    """A garage of sixteen squares."""
    return build(GarageConfig(**ALL_KINDS), tmp_path_factory.mktemp("kinds") / "small.usdc")


def kinds_of(built):
    return {entry["class"] for entry in labelled_objects(built.labels)}


@pytest.mark.soak
def test_nvidia_validation_of_every_instance_finds_nothing(all_kinds, builds, tmp_path):
    assert kinds_of(all_kinds) >= kinds_of(builds(*PAPER, "usdc"))
    assert nvidia_findings(all_kinds.stage, tmp_path / "findings.csv", "--no-variants") == []


def test_validations_of_several_levels_find_nothing(tmp_path):
    stage = build(SMALL_LEVELS, tmp_path / "garage.usdz").stage
    assert usd_findings(stage) == []
    assert nvidia_findings(stage, tmp_path / "findings.csv", "--no-variants", "--no-instance-prototypes") == []


@pytest.mark.soak
def test_nvidia_validation_of_every_variant_finds_nothing(tmp_path):
    stage = build(GarageConfig(**VARIED), tmp_path / "small.usdc").stage
    opened = Usd.Stage.Open(str(stage))
    prims = Usd.PrimRange(opened.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    names = {name for prim in prims for name in prim.GetVariantSets().GetNames()}
    assert names == {"ceiling", "lights", "occupancy", "paint", "power"}
    assert nvidia_findings(stage, tmp_path / "findings.csv") == []


@pytest.mark.soak
def test_tiles_that_share_prototypes_pass_both(tmp_path):
    stage = build(GarageConfig(**ALL_KINDS, stage={"form": "nested"}), tmp_path / "small.usdc").stage
    assert usd_findings(stage) == []
    assert nvidia_findings(stage, tmp_path / "findings.csv", "--no-variants") == []


@pytest.mark.soak
def test_shared_assets_and_a_stage_that_refers_to_them_pass_both(tmp_path):
    config = GarageConfig(**{**SETTINGS, "stage": {**SETTINGS["stage"], "assets": "shared"}})
    made = build(config, tmp_path / "a" / "small.usdc")
    assert usd_findings(made.stage) == []
    for number, path in enumerate((made.stage, made.shared_assets)):
        assert nvidia_findings(path, tmp_path / f"{number}.csv", "--no-variants") == []


@pytest.mark.parametrize("samples", soak_but(1, [USUAL_SAMPLES, OBJECT_SAMPLES]), ids=["usual", "all"])
def test_nvidia_validation_of_prototypes_finds_nothing(samples, builds, tmp_path):
    """Those of samples that have all kinds of objects between them, at once, as many are of several."""
    for sample in samples:
        folder = builds(sample, "usdc").asset_folder
        for file in filter(Path.is_file, folder.rglob("*")):
            copy = tmp_path / "assets" / file.relative_to(folder)
            if copy.exists() and copy.read_bytes() != file.read_bytes():
                copy = copy.with_stem(f"{copy.stem}_{sample.stem}")  # a lane graph or a drive
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, copy)
    assert nvidia_findings(tmp_path / "assets", tmp_path / "findings.csv", "--no-variants") == []


def test_nvidia_validation_sees_a_broken_prototype(all_kinds, tmp_path):
    """Or else the test above would prove nothing of a folder of prototypes."""
    folder = shutil.copytree(all_kinds.asset_folder, tmp_path / "assets")
    layer = Sdf.Layer.FindOrOpen(str(min(folder.glob("Column_*.usdc"))))
    mesh = next(iter(layer.GetPrimAtPath("/Asset/Geom").nameChildren))
    mesh.attributes["extent"].default = [(0, 0, 0), (0.1, 0.1, 0.1)]
    layer.Save()
    findings = nvidia_findings(folder, tmp_path / "findings.csv", "--no-variants")
    assert [finding["Rule"] for finding in findings] == ["ExtentsChecker"]


@pytest.mark.parametrize("sample", soak_but(MIXED, [*PAPER, *MIXED]), ids=lambda path: path.stem)
def test_every_format_holds_the_same(sample, builds):
    """So that what one format passes in full, the others need not."""
    texts, assets = {}, {}
    for extension in ("usda", "usdc", "usdz"):
        build = builds(sample, extension)
        text = Sdf.Layer.FindOrOpen(str(build.stage)).ExportToString()
        if build.asset_folder is None:
            with zipfile.ZipFile(build.stage) as package:
                names = package.namelist()[1:]
                assets[extension] = {name.removeprefix("assets/"): package.read(name) for name in names}
        else:
            files = [file for file in build.asset_folder.rglob("*") if file.is_file()]
            assets[extension] = {str(file.relative_to(build.asset_folder)): file.read_bytes() for file in files}
            text = text.replace(f"@./{build.asset_folder.name}/", "@./assets/")
        texts[extension] = text
    assert texts["usda"] == texts["usdc"] == texts["usdz"]
    assert assets["usda"] == assets["usdc"] == assets["usdz"]
