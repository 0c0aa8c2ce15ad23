"""Cracks and patches of old asphalt: other ones with each seed and on each square, and none in the texture."""

import numpy as np
import pytest
import shapely
from PIL import Image
from support.small_survey import surveyed

from garage2usd.assets.textures import texture_folder
from garage2usd.config import GarageConfig
from garage2usd.config.outputs import TextureQuality
from garage2usd.layout import lay_out
from garage2usd.objects.floor_stain import StainMark
from garage2usd.stage.labels import world_bounds_m
from garage2usd.structure.grid import Structure, cells_from_text
from garage2usd.structure.lane_graph import build_lane_graph

PLAN = "..........\nE========X\n.........."
MARKS = {StainMark.SEAM, StainMark.REPAIR}


def laid_out(seed, finish="patched", **floor):
    config = GarageConfig(seed=seed, look={"floor": {"finish": finish, **floor}})
    structure = Structure.from_arrays(cells_from_text(PLAN, field="S"), 8.1, 8.1)
    return lay_out(structure, build_lane_graph(structure, config.bay), config)


def repairs(layout):
    return [place for place in layout.of_kind("floor_stain") if getattr(place.spec, "mark", None) in MARKS]


def arrangement(layout, square):
    """What lies on a square, by the place on it."""
    (panel,) = (place for place in layout.of_kind("floor") if place.square == square)
    x, _, z = panel.position_m
    return tuple(
        (place.spec, round(place.position_m[0] - x, 3), round(place.position_m[2] - z, 3), round(place.yaw_rad, 3))
        for place in repairs(layout)
        if place.square == square
    )


@pytest.fixture(scope="module")
def layout():
    return laid_out(1)


def test_cracks_differ_along_the_lane_and_with_the_seed(layout):
    squares = sorted({place.square for place in layout.of_kind("floor") if place.square[0] == 1})
    along = [arrangement(layout, square) for square in squares]
    assert sum(map(bool, along)) > 0.7 * len(along)
    assert len(set(filter(None, along))) == sum(map(bool, along))
    other = laid_out(2)
    assert not {arrangement(other, square) for square in squares} & set(filter(None, along))
    assert repairs(laid_out(1)) == repairs(layout)


def test_the_texture_of_the_floor_has_no_cracks_that_could_repeat():
    """No line of bitumen: the darkest pixels are scattered, and none is much darker than its surroundings."""
    picture = Image.open(texture_folder(TextureQuality.HIGH) / "asphalt_patched_colour.jpg").convert("L")
    value = np.asarray(picture.reduce(4), dtype=float)
    assert value.min() > 0.75 * value.mean()


def test_cracks_lie_on_their_square_apart_from_each_other_and_from_drains():
    made = laid_out(3, drains="channels")
    rows = made.placements.rows_of("floor_stain")
    low, high = world_bounds_m(made.placements, rows)
    boxes = {
        place.name + str(place.square): (place, shapely.box(a[0], a[2], b[0], b[2]))
        for place, a, b in zip(made.placements.at(rows), low, high, strict=True)
        if getattr(place.spec, "mark", None) in MARKS
    }
    assert len(boxes) > 8
    floors = {place.square: place for place in made.of_kind("floor")}
    for place, box in boxes.values():
        panel = floors[place.square]
        x, _, z = panel.position_m
        half_x, half_z = panel.spec.width_m / 2, panel.spec.depth_m / 2
        assert box.within(shapely.box(x - half_x, z - half_z, x + half_x, z + half_z).buffer(1e-4))
    grounds = [box for _, box in boxes.values()]
    one, other = shapely.STRtree(grounds).query(grounds, predicate="overlaps")
    assert not len(one)
    assert (one == other).all()


def test_other_floors_have_none():
    assert not repairs(laid_out(1, finish="asphalt"))
    assert not repairs(laid_out(1, finish="concrete"))


def test_the_floor_of_an_import_has_them_too(tmp_path):
    made = [surveyed(tmp_path, seed=seed, look={"floor": {"finish": "patched"}}) for seed in (1, 2)]
    places = [{(place.name, place.position_m) for place in repairs(layout)} for layout in made]
    assert min(map(len, places)) > 5
    assert not places[0] & places[1]
    stalls = shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in made[0].stalls])
    assert not any(stalls.contains(shapely.Point(place.position_m[::2])) for place in repairs(made[0]))
