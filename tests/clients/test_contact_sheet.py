"""A contact sheet shows each garage inside and from above, and goes on where it was interrupted."""

import importlib.util

import numpy as np
import pytest
from PIL import Image

from garage2usd import contact_sheet
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.contact_sheet import SheetGarage, draw_contact_sheet

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SIZE = 64, 36
SMALL = {"width_cells": 4, "height_cells": 4}


def garages(count):
    settings = {"site": SMALL, "plan": {"episodes": 50}}
    return [SheetGarage(f"seed {seed}", GarageConfig(seed=seed, **settings)) for seed in range(count)]


def test_a_sheet_goes_on_where_it_was_interrupted_and_has_a_cell_a_garage(tmp_path, monkeypatch):
    output, drawn = tmp_path / "sheet.png", []
    draw = contact_sheet._draw

    def draw_or_end(garage, *arguments):
        if len(drawn) == 1:
            raise KeyboardInterrupt
        draw(garage, *arguments)
        drawn.append(garage.name)

    monkeypatch.setattr(contact_sheet, "_draw", draw_or_end)
    with pytest.raises(KeyboardInterrupt):
        draw_contact_sheet(garages(2), output, size_px=SIZE, samples=1, columns=2)
    assert not output.exists()
    assert (tmp_path / "sheet.png.unfinished").is_dir()
    with pytest.raises(ConfigError, match="other work"):
        draw_contact_sheet(garages(2), output, size_px=SIZE, samples=2, columns=2)
    drawn.insert(0, "before")  # so that the second garage is drawn
    monkeypatch.setattr(contact_sheet, "_draw", lambda *given: (draw(*given), drawn.append(given[0].name)))
    draw_contact_sheet(garages(2), output, size_px=SIZE, samples=1, columns=2)
    assert drawn == ["before", "seed 0", "seed 1"]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["sheet.png"]
    with Image.open(output) as sheet:
        pixels = np.asarray(sheet.convert("L")).astype(float)
    width, height = SIZE
    gap, cell = contact_sheet._GAP_PX, 2 * width + contact_sheet._GAP_PX
    for column in range(2):
        for view in range(2):
            left = gap + column * cell + view * width
            picture = pixels[gap : gap + height, left : left + width]
            assert picture.std() > 5, (column, view)
            assert 20 < picture.mean() < 230, (column, view)


@pytest.mark.parametrize("name", ["sheet.tif", "sheet"])
def test_a_sheet_is_a_png_or_a_jpeg(tmp_path, name):
    with pytest.raises(ConfigError, match=r"\.png, \.jpg"):
        draw_contact_sheet(garages(1), tmp_path / name)
