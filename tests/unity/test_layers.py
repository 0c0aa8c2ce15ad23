"""One layer at a time: the C# readers against ``pxr``, every opinion of every spec."""

import json
import os
import random
import subprocess
import sys
from pathlib import Path

import pytest
from pxr import Sdf, Tf, Usd
from support.unity import values_of_pxr
from support.unity.agreement import STAGES, installed
from support.unity.crate_tables import unpacked


def same(reader, path) -> None:
    """Both readers say the same of a layer, or both refuse it."""
    layer = Sdf.Layer.FindOrOpen(str(path))
    wanted = values_of_pxr.layer_dump(layer)
    found = reader.ask("layer", path)
    assert "refused" not in found, found
    values_of_pxr.agreed(wanted["root"], found["root"])
    assert not values_of_pxr.differences(wanted, found)


def opens(path: Path) -> bool:
    """Whether ``pxr`` reads the file: some of the validator's examples are bad on purpose."""
    try:
        return Sdf.Layer.FindOrOpen(str(path)) is not None
    except Tf.ErrorException:
        return False


@pytest.mark.parametrize("ending", ["usda", "usdc"])
@pytest.mark.parametrize("path", sorted(STAGES.rglob("*.usda")), ids=lambda path: path.stem)
def test_layer_of_the_tests(usd_dump, tmp_path, path, ending):
    if ending == "usdc":
        crate = tmp_path / f"{path.stem}.usdc"
        Sdf.Layer.FindOrOpen(str(path)).Export(str(crate))
        path = crate
    same(usd_dump, path)


@pytest.mark.parametrize("package", ["pxr", "usd_validation_nvidia", "newton", "warp"])
def test_layers_of_installed_packages(usd_dump, package):
    paths = installed(package, (".usda", ".usdc", ".usd"))
    if not paths:
        pytest.skip(f"{package} is not installed or carries no layers")
    for path in paths:
        if path.stat().st_size < 300_000 and opens(path):
            same(usd_dump, path)


def test_numbers_of_crates_in_every_coding(usd_dump, tmp_path):
    layer = Sdf.Layer.CreateNew(str(tmp_path / "numbers.usdc"))
    prim = Sdf.CreatePrimInLayer(layer, "/A")
    draw = random.Random(1)  # noqa: S311 - of test inputs
    for name, least, most in (
        ("Int", -(2**31), 2**31), ("UInt", 0, 2**32), ("Int64", -(2**63), 2**63), ("UInt64", 0, 2**64),
        ("UChar", 0, 256), ("Float", -9, 9), ("Double", -(2**31), 2**31 - 1), ("Half", -9, 9), ("TimeCode", 0, 9),
    ):  # fmt: skip
        for count in (0, 1, 15, 16, 17, 1000):
            values = {
                "wide": [draw.randrange(least, most) for _ in range(count)],
                "same": [5] * count,
                "rising": [index % 200 for index in range(count)],
                "twos": [2 if index % 2 else 8 for index in range(count)],
                "fractions": [index % 3 / 10 for index in range(count)],
            }
            for kind, items in values.items():
                if kind != "fractions" or name in {"Float", "Double", "Half", "TimeCode"}:
                    kind_of = getattr(Sdf.ValueTypeNames, f"{name}Array")
                    Sdf.AttributeSpec(prim, f"{name}_{kind}_{count}", kind_of).default = items
        for index, value in enumerate((0, 1, most - 1, least, -1 if least else 7)):
            value_of = Sdf.TimeCode if name == "TimeCode" else int
            Sdf.AttributeSpec(prim, f"{name}_{index}", getattr(Sdf.ValueTypeNames, name)).default = value_of(value)
    layer.Save()
    same(usd_dump, layer.identifier)


@pytest.mark.parametrize("minor", range(7, 14))
def test_crates_of_every_version(usd_dump, tmp_path, minor):
    newer = {"timecode": 9, "pathExpression": 10}
    kept = [kind for kind, version in newer.items() if minor < version]
    lines = (STAGES / "values.usda").read_text().splitlines(keepends=True)
    (tmp_path / "values.usda").write_text("".join(line for line in lines if not any(kind in line for kind in kept)))
    crate = tmp_path / "values.usdc"
    code = "import sys; from pxr import Sdf; Sdf.Layer.FindOrOpen(sys.argv[1]).Export(sys.argv[2])"
    environment = os.environ | {"USD_WRITE_NEW_USDC_FILES_AS_VERSION": f"0.{minor}.0"}
    subprocess.run([sys.executable, "-c", code, tmp_path / "values.usda", crate], env=environment, check=True)
    assert crate.read_bytes()[8:10] == bytes([0, minor])
    same(usd_dump, crate)


def test_crates_of_many_chunks(usd_dump, tmp_path):
    """Blocks of more than two gigabytes come in chunks: here each of a thousand bytes."""
    Sdf.Layer.FindOrOpen(str(STAGES / "scene.usda")).Export(str(tmp_path / "scene.usdc"))
    chunked = tmp_path / "chunked.usdc"
    chunked.write_bytes(unpacked((tmp_path / "scene.usdc").read_bytes()).packed(1000))
    same(usd_dump, chunked)


EQUAL = """#usda 1.0
def "A" {
 def "k" (
  prepend references = </A/B>
 ) {
  rel near = <../B>
  rel far = </A/B>
  float a = 1
  float a.connect = <.b>
 }
 def "j" {
  float a = 1
  string s = "x"
 }
 def "l" {
  float a = 1
 }
 def "long" {
  string s = "%s"
 }
}
"""
"""Prims and lines, some of which mean something else below another prim."""


def test_equal_text_means_what_its_place_says(usd_dump, tmp_path):
    others = (
        EQUAL.replace('def "A"', 'def "C"'),
        EQUAL.replace('def "A"', 'def "D"').replace("string s = ", "token s = "),
    )
    overridden = """
def "E" {
 float a = 1
 float a = 2
 string s = "x"
 string s = "x" (
  doc = "its own"
 )
 def "j" {
  float a = 1
  string s = "x"
 }
 def "l" {
  float a = 1
 }
 def "m" {
  float a = 1
  token visibility = "x"
  token visibility = "y"
 }
 variantSet "v" = {
  "one" {
   def "j" {
    float a = 1
    string s = "x"
   }
  }
 }
}
"""
    texts = [(EQUAL + "".join(others).replace("#usda 1.0", "") + overridden).replace("%s", "y" * 3000)]
    # indented alike, wherever it stands
    texts.append("\n".join(line.strip() for line in texts[0].split("\n")))
    for index, text in enumerate(texts):
        path = tmp_path / f"equal{index}.usda"
        path.write_text(text)
        same(usd_dump, path)


def test_metadata_on_the_next_line_belongs_to_its_property_alone(usd_dump, tmp_path):
    """Files that ``pxr`` wrote have it on the line of the property, and it reads nothing else."""
    texts = ['string s = "x"', 'string s = "x"\n(\n doc = "own"\n)']
    path = tmp_path / "next_line.usda"
    path.write_text("#usda 1.0\n" + "".join(f'def "P{i}" {{\n{text}\n}}\n' for i, text in enumerate(texts)))
    root = usd_dump.ask("layer", path)["root"]
    assert [json.dumps(child).count("own") for child in root["children"]] == [0, 1]


@pytest.mark.parametrize("end", ["", "\n", "\n\n", "\n\n\n", " \n\n", "\r\n\r\n", "\n\n ", "# a\n\n"])
def test_any_end_of_a_text_is_its_end(usd_dump, tmp_path, end):
    path = tmp_path / "end.usda"
    path.write_bytes(f'#usda 1.0\ndef "A" {{\n float a = 1\n}}{end}'.encode())
    same(usd_dump, path)


@pytest.mark.parametrize("end", ["", "\n", "\n\n", "\n\n\n"])
@pytest.mark.parametrize(
    "open_", ["", "float[] a = [1,", 'string a = """', "/*", "rel a = <", "float a", "float2 a = ("]
)
def test_a_text_that_ends_too_early_is_refused(usd_dump, tmp_path, open_, end):
    path = tmp_path / "end.usda"
    path.write_text(f'#usda 1.0\ndef "A" {{\n {open_}{end}')
    assert "refused" in usd_dump.ask("layer", path)


@pytest.mark.parametrize("count", [9, 10, 11, 40, 500])
def test_many_children_are_found_and_in_the_order_of_the_layer(usd_dump, tmp_path, count):
    names = [f"p{index}" for index in range(count)]
    random.Random(count).shuffle(names)  # noqa: S311 - of test inputs
    for ending in ("usda", "usdc"):
        layer = Sdf.Layer.CreateNew(str(tmp_path / f"many{count}.{ending}"))
        parent = Sdf.CreatePrimInLayer(layer, "/A")
        for name in names:
            Sdf.PrimSpec(parent, name, Sdf.SpecifierDef)
            Sdf.AttributeSpec(parent, name.replace("p", "a"), Sdf.ValueTypeNames.Float)
        layer.Save()
        same(usd_dump, layer.identifier)
    path = tmp_path / "twice.usda"
    path.write_text("#usda 1.0\n" + "".join(f'def "{name}" {{}}\n' for name in [*names, names[0]]))
    assert "a second prim" in usd_dump.ask("layer", path)["refused"][2]


def decimal(draw: random.Random) -> str:
    """Numbers of all lengths and sizes, many of them close to the middle between two doubles."""
    if draw.random() < 0.3:
        return repr(draw.uniform(-1, 1) * 10.0 ** draw.randint(-320, 300))
    digits = "".join(draw.choice("0123456789") for _ in range(draw.randint(1, 40)))
    point = draw.randint(0, len(digits))
    exponent = draw.choice(["", f"e{draw.randint(-340, 300)}", f"E+{draw.randint(0, 20)}"])
    return f"{draw.choice(['', '-'])}{digits[:point] or '0'}.{digits[point:]}{exponent}"


def test_numbers_are_the_nearest(usd_dump, tmp_path):
    draw = random.Random(5)  # noqa: S311 - of test inputs
    text = ", ".join(decimal(draw) for _ in range(20000))
    path = tmp_path / "numbers.usda"
    path.write_text(f'#usda 1.0\ndef "A" {{\n double[] d = [{text}]\n float[] f = [{text}]\n half[] h = [{text}]\n}}\n')
    same(usd_dump, path)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("#sdf 1.4.32\n", "neither a text nor a crate layer"),
        ('#usda 1.0\ndef "A" {', "expected a name"),
        ('#usda 1.0\ndef "A" { float a = x }', "expected a number"),
        ('#usda 1.0\ndef "A" { int a = 3000000000 }', "is not between"),
        ('#usda 1.0\ndef "A" { string a = "x\n" }', "does not end on its line"),
        ('#usda 1.0\ndef "A" { rel a = <../../B> }', "leads out of the layer"),
        ('#usda 1.0\ndef "A" {}\ndef "A" {}', "a second prim 'A'"),
        ('#usda 1.0\ndef "A" { int[] a = edit [ append 1', "expected a closing bracket"),
        ('#usda 1.0\ndef "A" { int[] a = edit append }', "expected '['"),
        ('#usda 1.0\ndef "A" { double a.spline = { 1: 2, "}\n', "does not end on its line"),
        ("#usda 1.0\n" + 'def "A" {' * 2000, "nested more than"),
        ("#usda 1.0\n" + 'def "A" {\ndef "k" {\n}\n' * 400, "nested more than"),
        ('#usda 1.0\ndef "A" (\nadd references = </B>\n) {\nadd references = </B>\n}', "expected a name"),
        ('#usda 1.0\ndef "A" {\ndef "B" {\n}\ndef "B" {\n}\n}', "a second prim 'B'"),
        ("#usda 1.0\n(a = " + "[" * 5000, "nested more than"),
        ("#usda 1.0\n(customLayerData = " + "{ dictionary a = " * 5000, "nested more than"),
    ],
)
def test_refuses(usd_dump, tmp_path, text, reason):
    path = tmp_path / "bad.usda"
    path.write_text(text)
    file, place, found = usd_dump.ask("layer", path)["refused"]
    assert (file, place.split()[0]) == (str(path), "byte" if "crate" in reason else "line")
    assert reason in found


assert Usd  # registers the fields of prims
