"""Stages that others made: several folders below one root, formats and values that are not read, links."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from pxr import Gf, Sdf, Usd
from support.sample_files import REPOSITORY
from support.unity import foreign_stages, reader, stages_of_pxr
from support.unity.agreement import same, written
from support.unity.small_foreign import FOREIGN, NAMED, OF_MANY_FOLDERS

OUTSIDE = """
def "Outside" { string secret = "s" }
"""


def laid_out(folder: Path, files: dict[str, str], form: str) -> Path:
    """Write the layers as text or crates, and what is of another format as it is; the path of the first."""
    layers = {name: text for name, text in files.items() if name.endswith(".usd")}
    root = written(folder, layers, form)
    for name in files.keys() - layers.keys():
        (folder / name).write_text(files[name])
    return root


def verdict(usd_dump, root: Path, folder: Path) -> tuple[str, list[str]]:
    wanted = stages_of_pxr.stage_dump(Usd.Stage.Open(str(root)))
    return foreign_stages.verdict(wanted, usd_dump.ask("stage", root, folder))


@pytest.mark.parametrize("form", ["usda", "usdc"])
@pytest.mark.parametrize("name", FOREIGN)
def test_foreign_stage_is_equal(usd_dump, tmp_path, name, form):
    files, warnings = FOREIGN[name]
    kind, lines = verdict(usd_dump, laid_out(tmp_path, files, form), tmp_path)
    assert (kind, lines) == ("equal", warnings)


@pytest.mark.parametrize("form", ["usda", "usdc"])
@pytest.mark.parametrize("name", NAMED)
def test_foreign_stage_names_what_it_skips(usd_dump, tmp_path, name, form):
    files, warning = NAMED[name]
    root = laid_out(tmp_path, files, form)
    kind, lines = verdict(usd_dump, root, tmp_path)
    assert (kind, lines[0]) == ("named", warning)
    kept = {path for path, prim in usd_dump.ask("stage", root)["prims"].items() if "kept" in prim["properties"]}
    assert len(kept) == ("kept" in "".join(files.values()))


def test_numbers_of_a_crate_are_of_the_declared_type(usd_dump, tmp_path):
    """Programs write whole numbers where the attribute has fractions."""
    layer = Sdf.Layer.CreateNew(str(tmp_path / "numbers.usdc"))
    prim = Sdf.CreatePrimInLayer(layer, "/A")
    types = Sdf.ValueTypeNames
    for name, kind, value, declared in (
        ("whole", types.Int, 3, "float"),
        ("color", types.Int3, Gf.Vec3i(1, 2, 3), "color3f"),
        ("wide", types.Double, 0.25, "half"),
        ("many", types.FloatArray, [0.5, 2.0], "double[]"),
    ):
        attribute = Sdf.AttributeSpec(prim, name, kind)
        attribute.default = value
        attribute.SetInfo("typeName", declared)
    layer.Save()
    assert same(usd_dump, layer.identifier) == []


def test_without_a_root_the_folder_of_the_stage_is_it(usd_dump, tmp_path):
    root = laid_out(tmp_path, OF_MANY_FOLDERS, "usda")
    found = usd_dump.ask("stage", root)
    assert set(found["prims"]) == {"/Chair", "/Lamp", "/Set"}
    beyond = ["../../common/axis.usd", "./../look.usd", "../../assets/chair/chair.usd"]
    beyond += ["../../assets/./lamp//../lamp/lamp.usd", "../set.usd"]
    assert found["warnings"] == [f"shot.usd: @{path}@ is not a relative path within the root folder" for path in beyond]
    assert found == usd_dump.ask("stage", root, root.parent)


@pytest.mark.parametrize(
    "path", ["../../outside.usd", "../project/../../outside.usd", "{absolute}", "a/../../../outside.usd"]
)
def test_the_root_folder_is_not_left(usd_dump, tmp_path, path):
    outside = written(tmp_path, {"outside.usd": OUTSIDE}, "usda")
    path = path.format(absolute=outside)
    text = f"""
def "A" ( references = @{path}@</Outside> ) {{ float kept = 1 }}
def "B" ( references = @../near.usd@</Near> ) {{}}
"""
    files = {"scenes/shot.usd": text, "near.usd": 'def "Near" { float near = 1 }\n'}
    root = written(tmp_path / "project", files, "usda")
    found = usd_dump.ask("stage", root, tmp_path / "project")
    assert found["warnings"] == [f"scenes/shot.usd: @{path}@ is not a relative path within the root folder"]
    assert list(found["prims"]["/A"]["properties"]) == ["kept"]
    assert list(found["prims"]["/B"]["properties"]) == ["near"]


def test_a_stage_beside_the_root_is_refused(usd_dump, tmp_path):
    root = written(tmp_path / "project_of_others", {"scene.usd": OUTSIDE}, "usda")
    (tmp_path / "project").mkdir()
    refused = usd_dump.ask("stage", root, tmp_path / "project")["refused"]
    assert refused == [str(root), "file", f"is not in the root folder {tmp_path / 'project'}"]


def test_no_root_lets_a_package_refer_out_of_itself(usd_dump, tmp_path):
    written(tmp_path, {"outside.usd": OUTSIDE}, "usda")
    text = """
def "A" ( references = @../outside.usd@</Outside> ) {}
def "B" ( references = @outside.usd@</Outside> ) {}
def "C" ( references = @../../outside.usd@</Outside> ) { float kept = 1 }
"""
    package = tmp_path / "packages" / "package.usdz"
    inner = tmp_path / "inner.usda"
    inner.write_text("#usda 1.0\n" + text.replace(" }", "\n}"))
    package.parent.mkdir()
    with Sdf.ZipFileWriter.CreateNew(str(package)) as archive:
        archive.AddFile(str(inner), "inner.usda")
    outer = written(
        tmp_path, {"scenes/shot.usd": '\ndef "S" ( references = @../packages/package.usdz@</C> ) {}\n'}, "usda"
    )
    for stage in package, outer:
        found = usd_dump.ask("stage", stage, tmp_path)
        assert found["warnings"]
        assert "secret" not in str(found)
        assert all("package" in warning for warning in found["warnings"])
        assert "kept" in str(found)


def test_links_are_not_followed(usd_dump, tmp_path):
    written(tmp_path / "elsewhere", {"outside.usd": OUTSIDE}, "usda")
    text = """
def "File" ( references = @../link.usd@</Outside> ) {}
def "Folder" ( references = @../folder/outside.usd@</Outside> ) {}
def "Circle" ( references = @../circle.usd@</Outside> ) {}
def "Near" ( references = @../near.usd@</Near> ) {}
"""
    files = {"scenes/shot.usd": text, "near.usd": 'def "Near" { float near = 1 }\n'}
    root = written(tmp_path / "project", files, "usda")
    project = tmp_path / "project"
    (project / "link.usd").symlink_to(tmp_path / "elsewhere" / "outside.usd")
    (project / "folder").symlink_to(tmp_path / "elsewhere")
    (project / "circle.usd").symlink_to("circle.usd")
    found = usd_dump.ask("stage", root, project)
    why = "leads over a link, which may lead out of the root folder"
    assert found["warnings"] == [
        f"scenes/shot.usd: @../link.usd@ {why}",
        f"scenes/shot.usd: @../folder/outside.usd@ {why}",
        f"scenes/shot.usd: @../circle.usd@ {why}",
    ]
    assert "secret" not in str(found)
    assert list(found["prims"]["/Near"]["properties"]) == ["near"]


def test_a_link_that_the_caller_names_is_followed(usd_dump, tmp_path):
    """Projects have linked folders; what lies beside the stage in one of these is as near as the stage."""
    files = {
        "scene.usd": '\ndef "A" ( references = @near.usd@</Near> ) {}\n',
        "near.usd": 'def "Near" { float near = 1 }\n',
    }
    written(tmp_path / "elsewhere", files, "usda")
    (tmp_path / "project").mkdir()
    (tmp_path / "project" / "Assets").symlink_to(tmp_path / "elsewhere")
    found = usd_dump.ask("stage", tmp_path / "project" / "Assets" / "scene.usd", tmp_path / "project")
    assert found["warnings"] == []
    assert list(found["prims"]["/A"]["properties"]) == ["near"]


@pytest.mark.skipif(reader.missing() is not None, reason=str(reader.missing()))
def test_the_command_counts(tmp_path):
    for name, (files, _) in (NAMED | FOREIGN).items():
        laid_out(tmp_path / name.replace(" ", "_"), files, "usda")
    (tmp_path / "broken.usda").write_text("#usda 1.0\ndef")
    (tmp_path / "pointer.usdc").write_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n")
    command = [sys.executable, "-m", "support.unity.foreign_stages", tmp_path]
    done = subprocess.run(command, cwd=REPOSITORY / "tests", check=False, capture_output=True, text=True)
    *lines, counts = done.stdout.splitlines()
    opened = sum(name.endswith(".usd") for files, _ in (NAMED | FOREIGN).values() for name in files)
    named = len(NAMED)
    assert [int(number) for number in re.findall(r"(\d+) ", counts)] == [opened + 2, 1, opened - named, named, 0, 0]
    assert f"pxr opens {opened}: " in counts
    assert f"equal ({(opened - named) / opened:.1%})" in counts
    assert [line.split("/")[0] for line in lines if line.startswith("named")] == [
        f"named {name.replace(' ', '_')}" for name in sorted(NAMED)
    ]
    assert "unread broken.usda" in lines
    assert done.returncode == 1  # fewer than 97 %
