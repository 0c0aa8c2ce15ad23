"""Composed stages: the C# readers against ``pxr``, every prim, value, target and prototype."""

import json

import pytest
from pxr import Tf, Usd, UsdUtils
from support.sample_files import OBJECT_SAMPLES, SAMPLES
from support.small_garage import SETTINGS
from support.unity.agreement import STAGES, as_pxr_says, installed, same, written
from support.unity.small_stages import SMALL_STAGES

from garage2usd import GarageConfig, build

PAPER = next(sample for sample in SAMPLES if sample.stem == "paper_7x9")


def named(sample):
    """The name of a sample, of which none is the garage of twelve squares."""
    return sample.stem if sample else "small"


@pytest.mark.parametrize("form", ["usda", "usdc"])
@pytest.mark.parametrize("name", SMALL_STAGES)
def test_small_stage(usd_dump, tmp_path, name, form):
    same(usd_dump, written(tmp_path, SMALL_STAGES[name], form))


@pytest.mark.parametrize("name", ["ancestral references", "variants", "instances", "implied inherits"])
def test_small_stage_in_a_package(usd_dump, tmp_path, name):
    root = written(tmp_path / "files", SMALL_STAGES[name], "usdc")
    package = tmp_path / "package.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(root), str(package))
    same(usd_dump, package)


def test_package_that_a_layer_refers_to(usd_dump, tmp_path):
    root = written(tmp_path / "files", SMALL_STAGES["instances"], "usdc")
    (tmp_path / "sub").mkdir(exist_ok=True)
    assert UsdUtils.CreateNewUsdzPackage(str(root), str(tmp_path / "sub" / "package.usdz"))
    text = """
def "A" ( references = @sub/package.usdz@</World> ) {}
def "B" ( references = @sub/package.usdz[root.usd]@</World/I1> ) {}
"""
    same(usd_dump, written(tmp_path, {"outer.usda": text}, "usda"))


@pytest.mark.parametrize("form", ["instanced", "nested"])
def test_stage_with_shared_assets(usd_dump, tmp_path, form):
    stage = {**SETTINGS["stage"], "form": form, "assets": "shared"}
    made = build(GarageConfig(**{**SETTINGS, "stage": stage}), tmp_path / "garage" / "g.usdc")
    assert same(usd_dump, made.stage, tmp_path) == []
    # the folder of the stage is the root where none is named, and leads to none of the assets
    alone = usd_dump.ask("stage", made.stage)["warnings"]
    assert any("../assets/" in warning and "within the root folder" in warning for warning in alone)


@pytest.mark.parametrize("path", sorted(STAGES.glob("*.usda")), ids=lambda path: path.stem)
def test_stage_of_the_tests(usd_dump, path):
    same(usd_dump, path)


@pytest.mark.parametrize("package", ["pxr", "usd_validation_nvidia", "newton"])
def test_stages_of_installed_packages(usd_dump, package):
    paths = installed(package, (".usda", ".usdc", ".usd", ".usdz"))
    if not paths:
        pytest.skip(f"{package} is not installed or carries no layers")
    read = 0
    for path in paths:
        try:
            stage = Usd.Stage.Open(str(path))
        except Tf.ErrorException:
            continue  # bad on purpose
        assert stage
        same(usd_dump, path)
        read += 1
    assert read > 0.8 * len(paths)


@pytest.mark.parametrize(
    "sample", [None, *(pytest.param(sample, marks=pytest.mark.soak) for sample in OBJECT_SAMPLES)], ids=named
)
def test_sample(usd_dump, builds, small_builds, sample):
    """The crate is what ``pxr`` says; text and package are the crate to the last bit, so one comparison serves all."""
    made = {
        extension: builds(sample, extension) if sample else small_builds(extension)
        for extension in ("usda", "usdc", "usdz")
    }
    stages = {extension: build.stage for extension, build in made.items()}
    text, crate, package = (usd_dump.answer("stage", stage) for stage in stages.values())
    assert text == crate
    assert package == crate
    assert as_pxr_says(json.loads(crate), stages["usdc"]) == []


@pytest.mark.parametrize("sample", [None, pytest.param(PAPER, marks=pytest.mark.soak)], ids=named)
@pytest.mark.parametrize(("extension", "form"), [("usdc", "flat"), ("usda", "nested")])
def test_form_of_a_sample(usd_dump, builds, small_builds, sample, extension, form):
    made = builds(sample, extension, form) if sample else small_builds(extension, form)
    assert same(usd_dump, made.stage) == []
