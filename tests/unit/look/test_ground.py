"""Dirt, puddles and drains of lanes: that a garage has what is asked for, and nothing else moves."""

import itertools
import json
from collections import Counter

import numpy as np
import pytest
import shapely
from PIL import Image
from pxr import Usd, UsdPhysics, UsdShade
from support.footprints import footprint
from support.looks import beside_its_look, garage
from support.soak import soak_but

from garage2usd.assets.stain_texture import CELLS, CELLS_ACROSS, DIRT_CELLS
from garage2usd.assets.textures import texture_folder
from garage2usd.config import GarageConfig, LookConfig
from garage2usd.config.look import Dirt, Drains
from garage2usd.config.outputs import TextureQuality
from garage2usd.garage_sources import check
from garage2usd.layout.floor.drainage import drains
from garage2usd.look import drawn_look, finishes_of
from garage2usd.objects.floor_stain import DirtSpec, PuddleSpec, StainMark, StainSpec
from garage2usd.pipeline import build, generate
from garage2usd.structure.grid import Cell

LEVEL_M = 0.0005
"""A tyre notices nothing that is lower."""


def without(made, is_left_out):
    """What no look changes, but for some objects, by their names and kinds."""
    kept = beside_its_look(made)
    stays = [not is_left_out(name, kind) for name, kind in zip(kept["names"], kept["kinds"], strict=True)]
    lists = ("names", "kinds", "places", "outlines")
    return kept | {key: list(itertools.compress(kept[key], stays)) for key in lists}


def is_wear(place):
    return place.name == "Wear"


def is_puddle(name, _kind):
    return name == "Puddle"


def puddles(made):
    return [place for place in made.layout.of_kind("floor_stain") if place.name == "Puddle"]


def dry_lanes(made):
    """The lane squares without a bump."""
    lanes = np.argwhere(made.layout.structure.cells == Cell.LANE).tolist()
    return {tuple(square) for square in lanes} - {bump.square for bump in made.layout.of_kind("speed_bump")}


def seen_polygon(place, part):
    """The ground that a part of an object covers, by its mesh."""
    mesh = next(each for each in place.spec.asset().parts if each.name == part)
    faces = mesh.points[mesh.face_indices.reshape(-1, 3)]
    return shapely.union_all([shapely.Polygon([place.to_world((x, z)) for x, _, z in face]) for face in faces])


@pytest.fixture(scope="module")
def usual():
    return garage()


@pytest.mark.parametrize("dirt", [Dirt.FAINT, Dirt.FILTHY])
def test_dirt_takes_the_place_of_usual_wear(usual, dirt):
    made = garage(floor={"dirt": dirt})
    assert beside_its_look(made) == beside_its_look(usual)
    pairs = list(zip(made.layout.of_kind("floor_stain"), usual.layout.of_kind("floor_stain"), strict=True))
    assert any(is_wear(place) for place, _ in pairs)
    for place, before in pairs:
        wanted = DirtSpec(*vars(before.spec).values(), dirt) if is_wear(place) else before.spec
        assert place.spec == wanted


def test_a_swept_floor_has_no_wear_and_all_other_stains(usual):
    made = garage(floor={"dirt": "swept"})
    assert "Wear" not in {place.name for place in made.layout.placements}
    assert beside_its_look(made) == without(usual, lambda name, _: name == "Wear")


def test_dirt_darkens_more_and_more():
    def alpha(name, cells):
        picture = np.asarray(Image.open(texture_folder(TextureQuality.HIGH) / name).convert("RGBA"))[:, :, 3]
        cell = len(picture) // CELLS_ACROSS
        windows = [picture[y * cell : (y + h) * cell, x * cell : (x + w) * cell] for x, y, w, h in cells]
        return np.mean(windows) / 255

    for mark in (mark.value for mark in StainMark if mark.name.startswith("WEAR")):
        faint, filthy = (alpha("dirt.png", DIRT_CELLS[dirt][mark]) for dirt in (Dirt.FAINT, Dirt.FILTHY))
        as_usual = alpha("stains.png", CELLS[mark])
        assert 0.3 * as_usual < faint < 0.6 * as_usual
        assert 1.3 * as_usual < filthy < 2.2 * as_usual


@pytest.mark.parametrize("wet", soak_but([0.6], [0.2, 0.6, 1.0]))
def test_a_share_of_the_lanes_has_puddles_and_nothing_else_moves(usual, wet):
    made = garage(floor={"wet": wet})
    assert without(made, is_puddle) == beside_its_look(usual)
    lanes = dry_lanes(made)
    squares = [place.square for place in puddles(made)]
    assert len(squares) == len(set(squares)) == round(wet * len(lanes))
    assert set(squares) <= lanes


def test_a_larger_share_has_the_puddles_of_a_smaller_one():
    few, many = (garage(floor={"wet": wet}) for wet in (0.3, 0.7))
    assert {(place.square, place.spec, place.position_m) for place in puddles(few)} < {
        (place.square, place.spec, place.position_m) for place in puddles(many)
    }


@pytest.mark.parametrize("kind", ["none", "gratings", "channels"])
def test_puddles_keep_clear_of_columns_stalls_and_bumps(kind):
    made = garage(floor={"wet": 1.0, "drains": kind})
    avoided = [place for place in made.layout.placements if place.kind in {"column", "wall", "obstacle", "speed_bump"}]
    standing = shapely.union_all([footprint(place) for place in avoided])
    stalls = shapely.union_all([shapely.Polygon(stall.corners_m()) for stall in made.layout.stalls])
    for place in puddles(made):
        water, damp = seen_polygon(place, "Water"), seen_polygon(place, "Damp")
        covered = shapely.union(water, damp)
        assert 0.2 < water.area / (place.spec.width_m * place.spec.depth_m) < 0.8
        assert water.intersection(damp).area < 1e-4
        assert covered.intersection(standing).area == 0
        assert covered.intersection(stalls).area < 1e-6


@pytest.mark.parametrize("seeds", soak_but(1, [range(4), range(12)]))
def test_puddles_lie_at_gullies_and_before_ramps_first(seeds):
    low, elsewhere = Counter(), Counter()
    for seed in seeds:
        floor = {"wet": 0.25, "drains": "gratings"}
        made = generate(GarageConfig(seed=seed, plan={"episodes": 100}, look={"floor": floor}))
        wet = {place.square for place in puddles(made)}
        gullies = {place.square: place for place in made.layout.of_kind("drain")}
        cells = np.pad(made.layout.structure.cells, 1, constant_values=Cell.OBSTACLE)
        for row, col in dry_lanes(made):
            around = {cells[row + 1 + down, col + 1 + right] for down, right in ((0, 1), (1, 0), (0, -1), (-1, 0))}
            is_low = (row, col) in gullies or around & {Cell.ENTRANCE, Cell.EXIT}
            (low if is_low else elsewhere)[(row, col) in wet] += 1
        for place in puddles(made):
            if place.square in gullies:
                assert footprint(gullies[place.square]).distance(shapely.Point(place.position_m[::2])) < 1.7
    assert low[True] / low.total() > 1.5 * elsewhere[True] / elsewhere.total()


@pytest.mark.parametrize("kind", ["gratings", "channels"])
def test_drains_move_nothing_but_marks_of_the_concrete_that_would_lie_over_them(usual, kind):
    made = garage(floor={"drains": kind})
    concrete = ("Crack", "Patch", "Damp")

    def is_left_out(name, own):
        return own == "drain" or name.startswith(concrete)

    assert made.layout.counts()["drain"] > 2
    assert without(made, is_left_out) == without(usual, is_left_out)
    stains, before = (
        {(place.name, place.square, place.position_m) for place in each.layout.of_kind("floor_stain")}
        for each in (made, usual)
    )
    gratings = shapely.union_all([footprint(place) for place in made.layout.of_kind("drain")])
    gone = [
        place
        for place in usual.layout.of_kind("floor_stain")
        if (place.name, place.square, place.position_m) not in stains
    ]
    assert stains <= before
    for place in made.layout.of_kind("floor_stain"):
        if place.name.startswith(concrete):
            assert footprint(place).intersection(gratings).area < 1e-6
    for place in gone:
        assert footprint(place).buffer(1.0).intersects(gratings)


@pytest.mark.parametrize("kind", ["gratings", "channels"])
def test_drains_are_level_with_lanes_and_clear_of_columns_and_stalls(kind):
    made = garage(floor={"drains": kind})
    standing = [place for place in made.layout.placements if place.kind in {"column", "wall", "obstacle", "stall"}]
    avoided = shapely.union_all([footprint(place) for place in standing])
    for place in made.layout.of_kind("drain"):
        assert 0 < place.position_m[1] < LEVEL_M
        assert np.ptp(np.concatenate([part.points[:, 1] for part in place.spec.asset().parts])) == 0
        assert place.spec.is_channel == (kind == "channels")
        assert place.spec.width_m == (0.15 if kind == "channels" else 0.3)
        assert footprint(place).intersection(avoided).area < 1e-6
        bars, gaps = seen_polygon(place, "Grating"), seen_polygon(place, "Gaps")
        assert shapely.union(bars, gaps).symmetric_difference(footprint(place)).area < 1e-5
        assert 0.25 < gaps.area / footprint(place).area < 0.55


def test_gullies_lie_off_paint_on_each_third_square_along_a_lane():
    made = garage(floor={"drains": "gratings"})
    gullies = {place.square: place for place in made.layout.of_kind("drain")}
    assert all(sum(square) % 3 == 0 for square in gullies)
    wanted = [
        square for square in np.argwhere(made.layout.structure.cells == Cell.LANE).tolist() if sum(square) % 3 == 0
    ]
    assert len(gullies) > 0.8 * len(wanted)
    for panel in made.layout.of_kind("floor"):
        for marking in panel.spec.markings if panel.square in gullies else ():
            paint = shapely.Polygon([panel.to_world(point) for point in marking.polygon])
            assert paint.distance(footprint(gullies[panel.square])) > 0.04


def test_channels_run_on_from_square_to_square():
    made = garage(floor={"drains": "channels"})
    structure = made.layout.structure
    channels = {
        place.square: footprint(place)
        for place in made.layout.of_kind("drain")
        if structure.cells[place.square] == Cell.LANE
    }
    joined = 0
    for (row, col), channel in channels.items():
        x0, z0, x1, z1 = channel.bounds
        beyond = (row, col + 1) if x1 - x0 > z1 - z0 else (row + 1, col)
        other = channels.get(beyond)
        if other is not None and (other.bounds[2] - other.bounds[0] > other.bounds[3] - other.bounds[1]) == (
            x1 - x0 > z1 - z0
        ):
            assert channel.distance(other) < 1e-6
            joined += 1
    assert joined > 3
    doors = [place for place in made.layout.of_kind("drain") if structure.cells[place.square] != Cell.LANE]
    assert len(doors) == made.layout.counts()["portal"]


def test_there_are_none_unless_they_are_asked_for(usual):
    assert usual.layout.counts()["drain"] == 0
    assert puddles(usual) == []
    assert not any(isinstance(spec, DirtSpec | PuddleSpec) for spec in usual.layout.placements.specs)
    ground = {"dirt": "swept", "wet": 0.5, "drains": "channels"}
    assert finishes_of(LookConfig(floor=ground)) == finishes_of(LookConfig())
    assert list(drains((), (), Drains.NONE)) == []


def test_a_stage_has_water_that_mirrors_and_drains_of_their_class(tmp_path):
    floor = {"dirt": "filthy", "wet": 0.5, "drains": "gratings"}
    site = {"width_cells": 6, "height_cells": 5}
    config = GarageConfig(seed=3, site=site, plan={"episodes": 100}, look={"floor": floor})
    built = build(config, tmp_path / "wet.usdc")
    dry = build(config.model_copy(update={"look": LookConfig()}), tmp_path / "dry.usdc")
    assert check(built.stage)[0] == check(dry.stage)[0]
    stage = Usd.Stage.Open(str(built.stage))
    prims = list(stage.Traverse(Usd.TraverseInstanceProxies()))
    meshes = {name: [prim for prim in prims if prim.GetName() == name] for name in ("Water", "Gaps", "Mark")}
    water, _ = UsdShade.MaterialBindingAPI(meshes["Water"][0]).ComputeBoundMaterial()
    surface, *_ = water.ComputeSurfaceSource()
    assert surface.GetInput("roughness").Get() == pytest.approx(0.03)
    assert surface.GetInput("opacity").Get() > 0.5
    assert not any(prim.HasAPI(UsdPhysics.CollisionAPI) for each in ("Water", "Gaps") for prim in meshes[each])
    bound = {UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPrim().GetName() for prim in meshes["Mark"]}
    assert "Dirt" in bound
    table = json.loads((tmp_path / "wet_labels.json").read_text())
    objects = [entry[:3] for group in table["objects"].values() for entry in group]
    drain = next(entry["id"] for entry in table["classes"] if entry["name"] == "drain")
    stain = next(entry["id"] for entry in table["classes"] if entry["name"] == "floor_stain")
    assert drain == 36
    assert sum(own == drain for _, _, own in objects) == built.garage.layout.counts()["drain"] > 0
    assert [own for name, _, own in objects if name == "Puddle"] == [stain] * len(puddles(built.garage))


def test_half_of_drawn_garages_have_drains_and_one_in_five_puddles():
    floors = [drawn_look(LookConfig(drawn=True), seed).floor for seed in range(600)]
    assert {floor.dirt for floor in floors} == set(Dirt)
    assert {floor.drains for floor in floors} == set(Drains)
    assert np.mean([floor.drains is not Drains.NONE for floor in floors]) == pytest.approx(0.5, abs=0.06)
    assert np.mean([floor.wet > 0 for floor in floors]) == pytest.approx(0.2, abs=0.05)
    given = [drawn_look(LookConfig(drawn=True, floor={"wet": 0.9}), seed).floor for seed in range(20)]
    assert [floor.model_copy(update={"wet": 0.9}) for floor in floors[:20]] == given
    assert all(isinstance(floor.wet, float) for floor in floors)


def test_wear_of_a_square_is_a_stain_of_its_own_size(usual):
    made = garage(floor={"dirt": "filthy"})
    for place in made.layout.of_kind("floor_stain"):
        if is_wear(place):
            assert isinstance(place.spec, StainSpec)
            assert place.spec.asset().parts[0].material == "dirt"
