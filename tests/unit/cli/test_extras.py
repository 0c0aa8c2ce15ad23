"""What an extra brings is looked for before the work: one line names the extra, and nothing is left."""

import json
import sys
import tomllib
from importlib.metadata import packages_distributions

import pytest
from click.testing import CliRunner
from support.sample_files import REPOSITORY

from garage2usd.cli import main
from garage2usd.common import package

MIXED = REPOSITORY / "samples" / "recipes" / "mixed.toml"
RECIPE = 'name = "small"\ncount = 1\n[garage.site]\nwidth_cells = 5\nheight_cells = 5\n[make]\n'
RENDER, ALONG = ["render", "none.usdz", "-o", "out"], ["--along", "1:A1-08"]
CASES = {
    "a recipe with Lanelet2 maps": (["pyproj"], ["dataset", MIXED, "--count", "2", "-o", "out"], "maps"),
    "a recipe with scenarios": (["scenariogeneration"], ["dataset", "xosc.toml", "-o", "out"], "maps"),
    "a recipe with both": (["pyproj", "scenariogeneration"], ["dataset", "both.toml", "-o", "out"], "maps"),
    "a recipe with fisheyes": (["bpy"], ["dataset", "fisheyes.toml", "-o", "out"], "blender"),
    "masks of fisheyes": (["trimesh"], ["dataset", "fisheyes.toml", "-o", "out"], "sensors"),
    "a recipe with LiDARs": (["embreex"], ["dataset", "lidar.toml", "-o", "out"], "sensors"),
    "a recipe with bags": (["rosbags"], ["dataset", "lidar.toml", "-o", "out"], "sensors"),
    "maps of a build": (["scenariogeneration", "pyproj"], ["build", "--with", "xosc,osm", "-o", "g.usdz"], "maps"),
    "a drawing": (["ezdxf"], ["import", "none.dxf", "-o", "g.usdz"], "cad"),
    "a building model": (["ifcopenshell"], ["import", "none.ifc", "-o", "g.usdz"], "cad"),
    "a folder for Autoware": (["embreex", "pyproj"], ["export", "none.usdz", "-o", "out.autoware/"], "maps,sensors"),
    "an export": (["pyproj"], ["export", "none.usdz", "-o", "out.osm"], "maps"),
    "pictures": (["bpy"], RENDER, "blender"),
    "pictures that are read": (["OpenEXR"], RENDER, "sensors"),
    "pictures of Blender that are read": (["bpy", "OpenEXR"], RENDER, "blender"),
    "pictures by rays": (["bpy", "embreex", "OpenEXR"], [*RENDER, "--device", "rays"], "sensors"),
    "fisheyes": (["embreex"], [*RENDER, "--rig", "avp_surround", *ALONG], "sensors"),
    "views from above": (
        ["bpy", "embreex"],
        [*RENDER, "--rig", "column_camera", *ALONG, "--birds-eye", "0.02"],
        "blender,sensors",
    ),
    "all that a rig needs": (
        ["bpy", "trimesh", "rosbags"],
        [*RENDER, "--rig", "lidar_32", *ALONG, "--also", "ros2"],
        "blender,sensors",
    ),
}  # fmt: skip


@pytest.fixture
def inputs(tmp_path, monkeypatch):
    made = {
        "xosc.toml": 'exports = ["xosc"]\n',
        "both.toml": 'exports = ["osm", "xosc"]\n',
        "fisheyes.toml": '[make.drives]\nrig = "avp_surround"\n',
        "lidar.toml": '[make.drives]\nrig = "lidar_32"\nalso = ["ros2"]\n',
    }
    for name, text in made.items():
        (tmp_path / name).write_text(RECIPE + text)
    (tmp_path / "none.usdz").touch()  # not opened, as what is missing is found before
    monkeypatch.chdir(tmp_path)
    return {path.name for path in tmp_path.iterdir()}


@pytest.mark.parametrize("case", CASES)
def test_what_is_missing_is_named_before_the_work(case, inputs, tmp_path, monkeypatch):
    missing, command, extra = CASES[case]
    # what is not named is there, on machines that have no Blender too
    monkeypatch.setattr(package, "find_spec", lambda module: None if module in missing else module)
    for module in missing:
        monkeypatch.setitem(sys.modules, module, None)
    run = CliRunner().invoke(main, [str(word) for word in command])
    assert run.exit_code == 1, run.output
    (line,) = [line for line in run.stderr.splitlines() if " gets none of the " not in line]  # so few garages
    assert line.endswith(package.installation_of(extra))
    assert {path.name for path in tmp_path.iterdir()} == inputs


@pytest.mark.parametrize(
    ("origin", "command"),
    [
        (None, "pip install 'garage2usd[maps]'"),
        ({"url": "HERE", "dir_info": {}}, "pip install '.[maps]'"),
        ({"url": "HERE", "dir_info": {"editable": True}}, "pip install -e '.[maps]'"),
        ({"url": "HERE/my%20garages", "dir_info": {}}, "pip install 'PLACE/my garages[maps]'"),
        ({"url": "HERE/gone", "dir_info": {"editable": True}}, "pip install 'garage2usd[maps]'"),
        ({"url": "HERE/g.whl", "archive_info": {}}, "pip install 'garage2usd[maps] @ HERE/g.whl'"),
    ],
)
def test_a_hint_installs_an_extra_as_garage2usd_was_installed(origin, command, tmp_path, monkeypatch):
    class Installed:
        def read_text(self, name):
            assert name == "direct_url.json"
            return origin and json.dumps(origin).replace("HERE", tmp_path.as_uri())

    (tmp_path / "my garages").mkdir()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(package, "distribution", lambda _name: Installed())
    told = command.replace("HERE", tmp_path.as_uri()).replace("PLACE", str(tmp_path))
    monkeypatch.setattr(package, "find_spec", lambda _name: None)
    with pytest.raises(package.MissingExtraError) as raised:
        package.require("a map", ["pyproj"])
    assert str(raised.value) == f"a map needs pyproj: {told}"


def test_without_its_python_blender_is_said_to_need_it(monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda _name: None)
    monkeypatch.setattr(sys, "version_info", (3, 13, 0))
    with pytest.raises(package.MissingExtraError, match=r"render needs Python 3.11 instead of 3.13, and in it Blender"):
        package.require("render", package.BLENDER)


def test_extras_bring_what_they_are_said_to_bring():
    optional = tomllib.loads((REPOSITORY / "pyproject.toml").read_text())["project"]["optional-dependencies"]
    distributions = packages_distributions()
    for module, (extra, _) in package._BROUGHT.items():
        names = {name.lower() for name in distributions.get(module, [module])}
        assert any(requirement.lower().startswith(tuple(names)) for requirement in optional[extra]), module
