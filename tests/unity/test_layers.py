"""One layer at a time: the C# readers against ``pxr``, every opinion of every spec."""

import random
from importlib.util import find_spec
from pathlib import Path

import pytest
import values_of_pxr
from pxr import Sdf, Usd

STAGES = Path(__file__).parent / "stages"


def same(reader, path) -> None:
    """Both readers say the same of a layer, or both refuse it."""
    layer = Sdf.Layer.FindOrOpen(str(path))
    wanted = values_of_pxr.layer_dump(layer)
    found = reader.ask("layer", path)
    assert "refused" not in found, found
    values_of_pxr.agreed(wanted["root"], found["root"])
    assert not values_of_pxr.differences(wanted, found)


def installed(package: str, endings: tuple[str, ...]) -> list[Path]:
    spec = find_spec(package)
    folders = [] if spec is None else spec.submodule_search_locations
    return sorted(path for folder in folders for path in Path(folder).rglob("*") if path.suffix in endings)


@pytest.mark.parametrize("path", sorted(STAGES.rglob("*.usda")), ids=lambda path: path.stem)
def test_text_layer_of_the_tests(usd_dump, path):
    same(usd_dump, path)


@pytest.mark.parametrize("package", ["pxr", "newton"])
def test_text_layers_of_installed_packages(usd_dump, package):
    paths = installed(package, (".usda",))
    if not paths:
        pytest.skip(f"{package} is not installed or carries no layers")
    for path in paths:
        same(usd_dump, path)


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
        ("#usda 1.0\n(\n relocates = { </A/B>: </A/C> }\n)", "relocates are not supported"),
        ('#usda 1.0\ndef "A" { int[] a = edit [ append 1 ] }', "edits of arrays are not supported"),
        ("#usda 1.0\n" + 'def "A" {' * 2000, "nested more than"),
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
