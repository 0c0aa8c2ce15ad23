import os
import zipfile

import click
import pytest
from click.testing import CliRunner
from pxr import Sdf, Usd

from garage2usd.cli.options import Commands
from garage2usd.common.errors import StageError
from garage2usd.reading.files import open_stage, usd_text
from garage2usd.scenes.prims import label_of, labels_of
from garage2usd.scenes.values import number_of, numbers_of

TEXT = '#usda 1.0\n(\n    defaultPrim = "Garage"\n)\ndef Xform "Garage" (\n    references = @./asset.usdc@\n)\n{\n}\n'


@pytest.fixture
def stage(tmp_path):
    """A stage that refers to an asset."""
    asset = Usd.Stage.CreateNew(str(tmp_path / "asset.usdc"))
    asset.SetDefaultPrim(asset.DefinePrim("/Asset", "Cube"))
    asset.GetRootLayer().Save()
    (tmp_path / "garage.usda").write_text(TEXT)
    return tmp_path / "garage.usda"


def packed(path, entries, method=zipfile.ZIP_STORED):
    with zipfile.ZipFile(path, "w", method) as package:
        for name, data in entries:
            package.writestr(name, data)
    return path


def reason(path):
    with pytest.raises(StageError) as caught:
        open_stage(path)
    return caught.value.reason


def test_a_sound_stage_opens_with_what_it_refers_to(stage):
    assert open_stage(stage).GetPrimAtPath("/Garage").GetTypeName() == "Xform"
    assert len(open_stage(stage).GetUsedLayers()) >= 2


def test_what_is_not_there_is_left_to_the_checks(stage):
    (stage.parent / "asset.usdc").unlink()
    assert open_stage(stage).GetPrimAtPath("/Garage")


def test_a_damaged_layer_is_named_though_another_refers_to_it(stage):
    asset = stage.parent / "asset.usdc"
    asset.write_bytes(asset.read_bytes()[:-40])
    assert "asset.usdc, which it refers to" in reason(stage)


def test_what_is_no_stage_is_refused_with_its_reason(tmp_path):
    (tmp_path / "text.usda").write_text("no stage")
    (tmp_path / "empty.usdc").write_bytes(b"")
    (tmp_path / "folder.usdz").mkdir()
    os.mkfifo(tmp_path / "pipe.usda")
    (tmp_path / "circle.usda").symlink_to(tmp_path / "circle.usda")
    assert reason(tmp_path / "text.usda").startswith("USD cannot read it (")
    assert "/opt/" not in reason(tmp_path / "text.usda")
    assert reason(tmp_path / "empty.usdc").startswith("0 bytes")
    assert reason(tmp_path / "folder.usdz") == reason(tmp_path / "pipe.usda") == "not a regular file"
    assert "symbolic links" in reason(tmp_path / "circle.usda")
    assert reason(tmp_path / "picture.png").startswith("not a stage: a stage ends in .usd")
    assert reason(tmp_path / "missing.usda") == "No such file or directory"


def test_packages_store_their_files_once_and_inside(tmp_path):
    layer = b'#usda 1.0\ndef Cube "C" {\n}\n'
    sound = packed(tmp_path / "sound.usdz", [("root.usda", layer)])
    assert open_stage(sound).GetPrimAtPath("/C")
    bomb = packed(tmp_path / "bomb.usdz", [("root.usda", layer), ("zeros.png", bytes(10**6))], zipfile.ZIP_DEFLATED)
    assert "compressed" in reason(bomb)
    for number, name in enumerate(("../up.usda", "/root.usda", "a/../../b.usda", "a\\b.usda")):
        assert "leaves the package" in reason(packed(tmp_path / f"{number}.usdz", [("root.usda", layer), (name, b"")]))
    with pytest.warns(UserWarning, match="Duplicate name"):
        twice = packed(tmp_path / "twice.usdz", [("root.usda", layer), ("root.usda", layer)])
    assert "twice" in reason(twice)
    (tmp_path / "none.usdz").write_bytes(b"PK")
    assert reason(tmp_path / "none.usdz").startswith("not a package")


def test_layers_in_circles_open(tmp_path):
    for one, other in (("a", "b"), ("b", "a")):
        layer = Sdf.Layer.CreateNew(str(tmp_path / f"{one}.usda"))
        Sdf.CreatePrimInLayer(layer, "/P").referenceList.Prepend(Sdf.Reference(f"./{other}.usda", "/P"))
        layer.Save()
    assert open_stage(tmp_path / "a.usda").GetPrimAtPath("/P")


def test_values_are_what_they_should_be_whatever_the_file_says(tmp_path):
    layer = Sdf.Layer.CreateNew(str(tmp_path / "light.usda"))
    prim = Sdf.CreatePrimInLayer(layer, "/Lamp")
    for name, kind, value in (
        ("height", Sdf.ValueTypeNames.Token, "tall"),
        ("width", Sdf.ValueTypeNames.Double, 1.5),
        ("nothing", Sdf.ValueTypeNames.Float, None),
        ("points", Sdf.ValueTypeNames.Point3fArray, [(1, 2, 3), (4, 5, 6)]),
        ("words", Sdf.ValueTypeNames.TokenArray, ["a", "b"]),
        ("semantics:labels:class", Sdf.ValueTypeNames.TokenArray, ["lamp", "light"]),
        ("semantics:labels:square", Sdf.ValueTypeNames.Int, 7),
    ):
        attribute = Sdf.AttributeSpec(prim, name, kind)
        if value is not None:
            attribute.default = value
    layer.Save()
    stage = Usd.Stage.Open(layer)  # which a prim does not keep open
    lamp = stage.GetPrimAtPath("/Lamp")
    assert (number_of(lamp.GetAttribute("width")), number_of(lamp.GetAttribute("nothing"))) == (1.5, 0.0)
    assert numbers_of(lamp.GetAttribute("points"), float, width=3).tolist() == [[1, 2, 3], [4, 5, 6]]
    assert len(numbers_of(lamp.GetAttribute("nothing"), float)) == 0
    for read in (lambda: number_of(lamp.GetAttribute("height")), lambda: numbers_of(lamp.GetAttribute("words"), float)):
        with pytest.raises(StageError, match=r"/Lamp.* does not hold numbers"):
            read()
    assert label_of(lamp) == "lamp"
    assert labels_of(lamp, "other") == ()
    with pytest.raises(StageError, match=r"/Lamp.semantics:labels:square does not hold labels"):
        label_of(lamp, "square")


def test_what_usd_says_is_one_line_of_text_whatever_it_repeats():
    assert usd_text(lambda: " two\n lines ") == "two lines"
    assert usd_text(b"\x80".decode) == "it holds bytes that are not text"


def test_a_name_that_is_no_text_ends_a_command_in_one_line(tmp_path):
    layer = Sdf.Layer.CreateNew(str(tmp_path / "names.usdc"))
    Sdf.CreatePrimInLayer(layer, "/P").typeName = "QQQQZZZZ"
    layer.Save()
    damaged = tmp_path / "damaged.usdc"
    data = (tmp_path / "names.usdc").read_bytes()
    assert data.count(b"QQQQZZZZ") == 1
    damaged.write_bytes(data.replace(b"QQQQZZZZ", b"QQQQ\xffZZZ"))

    @click.group(cls=Commands)
    def program():
        """A program."""

    @program.command()
    def names():
        stage = open_stage(damaged)  # which a prim does not keep open
        stage.GetPrimAtPath("/P").GetTypeName()

    ended = CliRunner().invoke(program, ["names"])
    assert (ended.exit_code, ended.stdout) == (1, "")
    assert ended.stderr == "Error: USD cannot read the stage (it holds bytes that are not text)\n"
