"""Composed stages: the C# readers against ``pxr``, every prim, value, target and prototype."""

import pytest
import sample_files
import stages_of_pxr
import values_of_pxr
from pxr import Sdf, Tf, Usd, UsdUtils
from small_stages import SMALL_STAGES
from test_layers import installed


def same(reader, path) -> list[str]:
    """Both say the same of a stage; gives the warnings."""
    found = reader.ask("stage", path)
    assert "refused" not in found, found
    warnings = found.pop("warnings")
    wanted = stages_of_pxr.stage_dump(Usd.Stage.Open(str(path)))
    stages_of_pxr.numbered_alike(wanted, found)
    assert not stages_of_pxr.misplaced(wanted, found)
    assert not values_of_pxr.differences(wanted, found)
    return warnings


def written(folder, files: dict[str, str], form: str):
    """Write layers as text or crates; the path of the first."""
    for name, text in files.items():
        layer = Sdf.Layer.CreateAnonymous(".usda")
        # pxr wants each statement on a line of its own
        layer.ImportFromString("#usda 1.0\n" + text.replace(" }", "\n}"))
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        assert layer.Export(str(path), args={"format": form})
    return folder / next(iter(files))


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


@pytest.mark.parametrize("package", ["pxr", "usd_validation_nvidia"])
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
    assert read > len(paths) / 2


SAMPLES = {sample.stem: sample for sample in sample_files.SAMPLES}


@pytest.mark.parametrize("name", SAMPLES)
def test_sample(usd_dump, builds, tmp_path, name):
    """Each sample as it is built against ``pxr``; the same stage as a crate and in a package reads the same."""
    build = builds(SAMPLES[name], "usda")
    assert same(usd_dump, build.stage) == []
    found = usd_dump.ask("stage", build.stage)
    crate = build.stage.with_suffix(".usdc")
    Sdf.Layer.FindOrOpen(str(build.stage)).Export(str(crate))
    package = tmp_path / f"{name}.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(crate), str(package))
    assert usd_dump.ask("stage", crate) == found
    assert with_bare_assets(usd_dump.ask("stage", package)) == with_bare_assets(found)


def with_bare_assets(dump: dict) -> dict:
    """The dump with the names alone of textures: a package has folders of its own."""
    for prim in dump["prims"].values():
        for one in prim["properties"].values():
            if one["type"] == "asset" and "value" in one:
                one["value"][1] = [text.rpartition("/")[2] for text in one["value"][1]]
    return dump


@pytest.mark.parametrize(("extension", "form"), [("usdc", "flat"), ("usda", "nested"), ("usdz", None)])
def test_form_of_a_sample(usd_dump, builds, extension, form):
    assert same(usd_dump, builds(SAMPLES["paper_7x9"], extension, form).stage) == []
