"""The meshes that are made ahead: that they are what would be made, of the shapes that garages have."""

import json
import zlib
from dataclasses import replace
from functools import lru_cache
from importlib import import_module

import numpy as np
import pytest
from support.object_specs import CASES, SPECS

from garage2usd.assets import Asset
from garage2usd.common.errors import StageError
from garage2usd.config import GarageConfig
from garage2usd.config.vehicles import CAR_BODIES
from garage2usd.objects.car import CarSpec
from garage2usd.pipeline import generate
from garage2usd.stage import prototypes
from garage2usd.stage.prototypes import MESH_FILE, _asset_of_shape, bake_meshes, baked_asset, baked_shapes

AGAIN = "bake the meshes again: garage2usd meshes garage2usd/stage (--choose where shapes have other measures)"
ARRAYS = ("points", "face_counts", "face_indices", "normals", "normal_indices", "st", "st_indices")


def described(asset):
    parts = [(part.name, part.material, part.piece, part.collider, type(part.collider)) for part in asset.parts]
    return parts, asset.light, list(asset.paints.items())


def arrays(asset):
    return [(getattr(part, name).dtype, getattr(part, name).tobytes()) for part in asset.parts for name in ARRAYS]


def test_what_is_made_ahead_is_what_would_be_made():
    shapes = list(baked_shapes())
    stale = [
        shape
        for shape in shapes
        if described(shape.asset()) != described(baked_asset(shape))
        or arrays(shape.asset()) != arrays(baked_asset(shape))
    ]
    assert not stale, AGAIN
    assert len(shapes) > 200
    assert len({shape.kind for shape in shapes}) > 20
    assert MESH_FILE.stat().st_size < 3_500_000


def rewritten(path, change):
    """A copy of the file of meshes whose last group is changed."""
    with np.load(MESH_FILE) as file:
        kept = {name: file[name] for name in file.files}
    start = kept["ends"][-2]
    last = zlib.compress(change(zlib.decompress(kept["groups"][start:].tobytes())))
    kept["groups"] = np.append(kept["groups"][:start], np.frombuffer(last, np.uint8))
    kept["ends"][-1] = len(kept["groups"])
    np.savez(path, **kept)


def test_a_change_of_one_number_is_found(tmp_path, monkeypatch):
    rewritten(tmp_path / "meshes.npz", lambda data: data[:-1] + bytes([data[-1] ^ 1]))
    use(tmp_path / "meshes.npz", monkeypatch)
    with pytest.raises(AssertionError, match="garage2usd meshes"):
        test_what_is_made_ahead_is_what_would_be_made()


def use(path, monkeypatch):
    monkeypatch.setattr(prototypes, "MESH_FILE", path)
    for name in ("_packed_groups", "_group"):
        monkeypatch.setattr(prototypes, name, lru_cache(getattr(prototypes, name).__wrapped__))


def test_usual_garages_find_almost_all_of_their_shapes():
    layout = generate(GarageConfig(plan={"episodes": 100}), seed=101).layout
    shapes = {spec.shape for spec in layout.placements.specs}
    assert sum(baked_asset(shape) is None for shape in shapes) < 0.15 * len(shapes)


def test_any_other_shape_is_made(tmp_path, monkeypatch):
    bake_meshes([SPECS["column"], SPECS["cone"]], tmp_path / "two.npz")
    use(tmp_path / "two.npz", monkeypatch)
    assert [baked_asset(spec) is not None for spec in (SPECS["column"], SPECS["cone"], SPECS["floor"])] == [1, 1, 0]
    assert described(_asset_of_shape.__wrapped__(SPECS["floor"])) == described(SPECS["floor"].asset())
    assert set(baked_shapes()) == {SPECS["column"], SPECS["cone"]}


@pytest.mark.parametrize("case", CASES)
def test_a_shape_is_found_by_all_its_measures(tmp_path, monkeypatch, case):
    spec = SPECS[case]
    if spec.asset().light is not None:
        return
    bake_meshes([spec], tmp_path / "one.npz")
    use(tmp_path / "one.npz", monkeypatch)
    assert [other for other in SPECS.values() if baked_asset(other) is not None] == [spec]
    assert list(baked_shapes()) == [spec]
    assert arrays(baked_asset(spec)) == arrays(spec.asset())


def test_a_garage_reads_the_cars_that_it_has_alone(monkeypatch):
    use(MESH_FILE, monkeypatch)
    cars = [shape for shape in baked_shapes() if isinstance(shape, CarSpec)]
    assert {shape.body for shape in cars} == {body.name for body in CAR_BODIES}
    use(MESH_FILE, monkeypatch)
    assert baked_asset(cars[0]) is not None
    assert baked_asset(cars[0]) is not None
    assert prototypes._group.cache_info().currsize == 1


def test_a_car_that_was_used_is_made_from_what_is_made_ahead(monkeypatch):
    used = CarSpec("hatchback", "white", steer_deg=20.0, is_dusty=True, is_lit=True)
    made = used.asset()
    monkeypatch.setattr("garage2usd.objects.car.car", lambda _: pytest.fail("its body was made again"))
    assert described(_asset_of_shape.__wrapped__(used)) == described(made)
    assert arrays(_asset_of_shape.__wrapped__(used)) == arrays(made)


def test_a_mesh_that_is_not_rounded_is_kept_as_it_is(tmp_path, monkeypatch):
    cone = SPECS["cone"]
    part = cone.asset().parts[0]
    odd = Asset((replace(part, points=part.points + np.float32(3e-6)),))
    monkeypatch.setattr(type(cone), "asset", lambda _: odd)
    bake_meshes([cone], tmp_path / "odd.npz")
    use(tmp_path / "odd.npz", monkeypatch)
    assert arrays(baked_asset(cone)) == arrays(odd)


def test_nobody_changes_what_is_made_ahead():
    with pytest.raises(ValueError, match="read-only"):
        baked_asset(next(baked_shapes())).parts[0].points[0] = 0


@pytest.mark.parametrize("key", ['["Marquee", {}]', '["ColumnSpec", {"girth_m": 2.0}]'])
def test_a_shape_that_is_none_any_longer_is_named(tmp_path, monkeypatch, key):
    def renamed(data):
        head, _, body = data.partition(b"\n")
        said = json.loads(head)
        said["entries"] = {key: next(iter(said["entries"].values()))}
        return json.dumps(said).encode() + b"\n" + body

    rewritten(tmp_path / "old.npz", renamed)
    use(tmp_path / "old.npz", monkeypatch)
    with pytest.raises(StageError, match="no such shape any longer"):
        list(baked_shapes())


def test_shapes_of_two_garages_are_chosen(monkeypatch):
    command = import_module("garage2usd.cli.shipped")
    monkeypatch.setattr(command, "_GARAGES", ((2, {"width_cells": 5, "height_cells": 4, "obstacles": 0}),))
    sites = [{"width_cells": 5, "height_cells": 4, "obstacles": 0}] * 2
    garages = [
        {spec.shape for spec in generate(GarageConfig(site=site), seed=seed).layout.placements.specs}
        for seed, site in enumerate(sites)
    ]
    chosen = command._usual_shapes()
    cars = {shape for shape in chosen if isinstance(shape, CarSpec)}
    assert {shape.body for shape in cars} == {body.name for body in CAR_BODIES}
    common = {shape for shape in garages[0] & garages[1] if shape.asset().light is None}
    assert set(chosen) - cars == {shape for shape in common if not isinstance(shape, CarSpec)} != set()
