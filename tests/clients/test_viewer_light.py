"""The viewer shows a place as bright as Cycles draws it, by the same view transform and exposure."""

import importlib.util
import io
import json

import numpy as np
import pytest
from PIL import Image
from pxr import Usd
from support.browser import find_browser
from support.small_garage import SETTINGS
from support.viewer_page import viewed

from garage2usd import GarageConfig, build
from garage2usd.render import Picture, render_stage
from garage2usd.stage.cameras import APERTURE_MM, FOCAL_MM

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(find_browser() is None, reason="no Chromium on the path"),
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

WIDTH_PX, HEIGHT_PX = 192, 120
SAMPLES = 12


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """The stage of a garage of white cars, and a camera before one of them."""
    built = build(GarageConfig(**SETTINGS), tmp_path_factory.mktemp("light") / "garage.usda")
    stage = Usd.Stage.Open(str(built.stage))
    for prim in stage.Traverse():
        if prim.GetVariantSets().HasVariantSet("paint"):
            prim.GetVariantSet("paint").SetVariantSelection("white")
    stage.Save()
    x, _, z = next(car for car in built.garage.layout.of_kind("car") if car.stall.startswith("Stall_r00")).position_m
    return built.stage, (x + 2.0, 1.5, z + 7.5), (x, 0.9, z)


def luminance(picture):
    """Linear luminance of a picture as it is shown."""
    shown = np.asarray(picture.convert("RGB")) / 255
    return np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4) @ [0.2126, 0.7152, 0.0722]


@pytest.fixture(scope="module")
def drawn(place, tmp_path_factory):
    """Luminance by Cycles and by the viewer, and the class of each pixel by its name."""
    stage, at, look_at = place
    folder = tmp_path_factory.mktemp("drawn") / "cycles"
    kinds = Picture.COLOUR, Picture.SEMANTIC
    render_stage(
        stage, folder, at_m=at, look_at_m=look_at, size_px=(WIDTH_PX, HEIGHT_PX), samples=SAMPLES, pictures=kinds
    )
    (colour,), (semantic,) = ([*(folder / str(kind)).iterdir()] for kind in kinds)
    names = {each["id"]: each["name"] for each in json.loads((folder / "frames.json").read_text())["classes"]}
    fov_deg = np.degrees(2 * np.arctan(APERTURE_MM[0] / FOCAL_MM / 2 * HEIGHT_PX / WIDTH_PX))
    with viewed(stage, size=(WIDTH_PX, HEIGHT_PX)) as page:
        page.show_panels(False)
        page.eval(
            f"(viewer.setMode('orbit'), viewer.orbit.maxPolarAngle = Math.PI, viewer.camera.fov = {fov_deg},"
            f" viewer.orbit.target.set({', '.join(map(str, look_at))}),"
            f" viewer.camera.position.set({', '.join(map(str, at))}), viewer.orbit.update(), viewer.touch())"
        )
        page.rest()
        viewer = Image.open(io.BytesIO(page.page.screenshot()))
        assert page.complaints == []
    classes = np.vectorize(lambda number: names.get(number, ""))(np.asarray(Image.open(semantic)))
    with Image.open(colour) as cycles:
        return luminance(cycles), luminance(viewer), classes


@pytest.mark.parametrize(("label", "share", "most"), [("floor", 0.5, 1.7), ("wall", 0.5, 1.7), ("car", 0.9, 1.4)])
def test_it_is_as_bright_as_cycles_draws_it(drawn, label, share, most):
    """Of a car its bright sheet: Cycles draws its shady side darker than the viewer, which knows no shadows there."""
    cycles, viewer, classes = drawn
    is_it = classes == label
    assert is_it.sum() > 300
    expected, found = (np.quantile(light[is_it], share) for light in (cycles, viewer))
    assert 1 / most < found / expected < most


def test_no_sheet_of_a_white_car_is_burnt_out(drawn):
    _, viewer, classes = drawn
    assert np.quantile(viewer[classes == "car"], 0.98) < 0.6
