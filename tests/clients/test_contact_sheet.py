"""A contact sheet shows each level of garages inside and from above, and goes on where it was interrupted."""

import importlib.util

import numpy as np
import pytest
from PIL import Image
from pxr import Usd

from garage2usd import contact_sheet, generate
from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.contact_sheet import SheetGarage, draw_contact_sheet
from garage2usd.garage import StallUse
from garage2usd.render.free_views import free_view

pytestmark = [
    pytest.mark.client,
    pytest.mark.skipif(importlib.util.find_spec("bpy") is None, reason="Blender's bpy is made for Python 3.11 only"),
]

SIZE = 64, 36
SMALL = {"width_cells": 4, "height_cells": 4}
TWO_LEVELS = {
    "seed": 4,
    "profile": {"name": "none"},
    "parking": {"occupancy": 0},
    "building": {"levels": 2, "storey_m": 2.9, "ramp_slope_percent": 20, "ramp_transition_m": 2.0},
    "fittings": {"ceiling_height_m": 2.6},
    "plan": {"episodes": 30, "starts": 1, "climb": False},
    "site": {"width_cells": 9, "height_cells": 5},
    "look": {"floor": {"bays": "red"}},
}


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


@pytest.mark.soak
def test_each_level_is_seen_alone_from_above(tmp_path):
    config, size_px = GarageConfig(**TWO_LEVELS), (160, 90)
    garage = generate(config)
    made = draw_contact_sheet(
        [SheetGarage("two", config, tape=garage.tape)], tmp_path / "sheet.png", size_px=size_px, samples=4, columns=2
    )
    insides, aboves = zip(*cells_of(made, size_px, columns=2, count=2), strict=True)
    layouts = [level.layout for level in garage.levels]
    for number, above in enumerate(aboves):
        right, wrong = (layouts[number], layouts[1 - number])
        # the number painted in a stall may hide its red in one place of twenty
        assert share_explained(above, right, size_px) > 0.9
        assert share_explained(above, wrong, size_px) < 0.75
        # there is no floor, and no light, where the ramps lie
        structure = right.structure
        x, z = (edges[:-1] + np.diff(edges) / 2 for edges in (structure.column_edges_m, structure.row_edges_m))
        wells = [(x[col], z[row]) for row, col in garage.building.ramps.squares]
        assert colours_at(above, wells, right, size_px).max() < 60
    assert np.abs(insides[0] - insides[1]).mean() > 5
    assert min(inside.std() for inside in insides) > 5


def cells_of(path, size_px, *, columns, count):
    """Return the two pictures of each cell of a sheet; float64, shape (height, width, 3)."""
    with Image.open(path) as sheet:
        pixels = np.asarray(sheet.convert("RGB")).astype(float)
    (width, height), gap = size_px, contact_sheet._GAP_PX
    found = []
    for number in range(count):
        row, column = divmod(number, columns)
        top = gap + row * (height + contact_sheet._CAPTION_PX + gap)
        left = gap + column * (2 * width + gap)
        found.append([pixels[top : top + height, start : start + width] for start in (left, left + width)])
    return found


def share_explained(above, layout, size_px):
    """Share of the stalls of usual use and of the lanes of a layout that are red and not red in a picture."""
    stalls = [np.mean(quad.corners, axis=0) for quad in layout.quads if quad.use is StallUse.STANDARD]
    stalls_are_red, lanes_are_red = (
        is_red(colours_at(above, points, layout, size_px)) for points in (stalls, layout.lane_graph.positions_m)
    )
    assert min(len(stalls_are_red), len(lanes_are_red)) > 8
    return (stalls_are_red.mean() + 1 - lanes_are_red.mean()) / 2


def is_red(colours):
    return colours[:, 0] > 1.6 * colours[:, 1:].max(axis=1)


def colours_at(above, points, layout, size_px):
    """Colours of points (x, z) on the floor in the picture from above; shape (n, 3)."""
    view = free_view(Usd.Stage.CreateInMemory(), *contact_sheet._over(layout, size_px), size_px, [])
    places = np.array([(x, 0, z, 1) for x, z in points])
    seen = view.intrinsics() @ (view.world_to_camera() @ places.T)[:3]
    across, down = (seen[:2] / seen[2]).astype(int)
    return above[down, across]


def test_a_sheet_has_a_cell_for_each_level_and_goes_on_with_whole_garages(tmp_path, monkeypatch):
    asked, ends = [], [True]

    def picture(stage, folder, *, cameras=(), over=None, size_px, **_):
        assert stage.exists()
        asked.append((stage.stem, folder.name))
        if asked[-1][0] == "U2" and ends.pop():
            raise KeyboardInterrupt
        number = len(asked)
        return [Image.new("RGB", size_px, (number, count, 0)) for count in range(2 if cameras else 1)]

    monkeypatch.setattr(contact_sheet, "_rendered", picture)
    two = SheetGarage("two", GarageConfig(**TWO_LEVELS, stage={"form": "flat"}))
    impossible = SheetGarage("none", GarageConfig(**{**TWO_LEVELS, "site": SMALL}))
    every, output, said = [*garages(1), two, impossible, *garages(1)], tmp_path / "sheet.png", []
    with pytest.raises(KeyboardInterrupt):
        draw_contact_sheet(every, output, size_px=SIZE, columns=2)
    assert asked == [("garage", "both"), ("garage", "inside"), ("U1", "U1"), ("U2", "U2")]
    ends.append(False)
    draw_contact_sheet(every, output, size_px=SIZE, columns=2, announce=said.append)
    # the first garage is not drawn again, the second one is, and the last one is new
    assert asked[4:] == [("garage", "inside"), ("U1", "U1"), ("U2", "U2"), ("garage", "both")]
    assert [words.partition(":")[0] for words in said] == ["without none"]
    with Image.open(output) as sheet:
        assert sheet.size == contact_sheet._sheet_size(2, 2, SIZE)
    insides = [cell[0][0, 0].tolist() for cell in cells_of(output, SIZE, columns=2, count=4)]
    assert insides == [[1, 0, 0], [5, 0, 0], [5, 1, 0], [8, 0, 0]]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["sheet.png"]
