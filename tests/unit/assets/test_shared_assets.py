"""Assets that are the same in every garage: their names, the folder that stages share, and what a process keeps."""

import hashlib
import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdShade, UsdUtils
from support.small_garage import SETTINGS
from support.soak import soak_but

from garage2usd.common.errors import ConfigError, StageError
from garage2usd.config import GarageConfig
from garage2usd.config.outputs import StageForm
from garage2usd.garage_sources import check
from garage2usd.pipeline import build
from garage2usd.reading.files import open_stage
from garage2usd.stage.asset_files import _asset_file
from garage2usd.stage.looks import texture_file
from garage2usd.stage.prototypes import _asset_of_shape
from garage2usd.view.viewer import read_scene
from garage2usd.view.viewer.wire import encode_scene


def small(seed=2, **stage):
    return GarageConfig(**{**SETTINGS, "seed": seed, "stage": {"texture_quality": "low", **stage}})


def contents(folder):
    """The files below a folder but for reports, which hold how long everything took."""
    files = (path for path in folder.rglob("*") if path.is_file() and not path.name.endswith("_report.json"))
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def forget():
    for kept in (_asset_file, _asset_of_shape, texture_file):
        kept.cache_clear()


def assert_named_by_content(folder):
    for path in folder.rglob("*.*"):
        stem, _, digest = path.stem.rpartition("_")
        assert stem
        assert hashlib.sha256(path.read_bytes()).hexdigest().startswith(digest)
        assert len(digest) == 16


def test_assets_are_named_by_what_they_hold_and_garages_have_most_in_common(tmp_path):
    folders = [build(small(seed), tmp_path / f"{seed}.usda").asset_folder for seed in (2, 3)]
    names = []
    for folder in folders:
        for layer in ("Drive", "LaneGraph"):
            (folder / f"{layer}.usdc").unlink()
        assert_named_by_content(folder)
        names.append(set(contents(folder)))
    assert len(names[0] & names[1]) > 0.8 * len(names[0])


def test_the_quality_of_textures_changes_no_asset_that_has_none(tmp_path):
    low, high = (
        set(contents(build(small(texture_quality=quality), tmp_path / f"{quality}.usda").asset_folder))
        for quality in ("low", "high")
    )
    assert {name for name in low & high if name.startswith("Car_")}
    assert not {name for name in low & high if name.startswith(("Floor_", "textures/"))}


@pytest.mark.parametrize("name", ["g.usda", "g.usdz"])
def test_what_a_process_built_before_changes_no_byte(tmp_path, name):
    forget()
    build(small(3), tmp_path / "before" / name)
    build(small(2), tmp_path / "warm" / name)
    assert _asset_file.cache_info().hits
    forget()
    build(small(2), tmp_path / "cold" / name)
    assert contents(tmp_path / "warm") == contents(tmp_path / "cold")


def test_what_a_process_keeps_is_bounded():
    assert _asset_file.cache_info().maxsize == 4096
    assert texture_file.cache_info().maxsize == 256


def composed(path):
    """Every prim of a stage with its type, place, points, material and textures, instances included."""
    layers, textures, missing = UsdUtils.ComputeAllDependencies(str(path))
    assert len(layers) > 50
    assert textures
    assert not missing
    stage = Usd.Stage.Open(str(path))
    cache, found = UsdGeom.XformCache(), {}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        points = UsdGeom.Mesh(prim).GetPointsAttr().Get() if prim.IsA(UsdGeom.Mesh) else None
        texture = prim.GetAttribute("inputs:file").Get() if prim.HasAttribute("inputs:file") else None
        assert texture is None or texture.resolvedPath
        labels = prim.GetAttribute("semantics:labels:class")
        found[str(prim.GetPath())] = (
            prim.GetTypeName(),
            prim.IsInstance(),
            cache.GetLocalToWorldTransform(prim) if prim.IsA(UsdGeom.Xformable) else None,
            None if points is None else np.array(points).tobytes(),
            str(UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPath()),
            texture and texture.path.rpartition("/")[2],
            list(labels.Get()) if labels else None,
            prim.GetVariantSets().GetNames(),
        )
    return found


FORMS_AND_FOLDERS = [
    (form, folder) for form in ("instanced", "nested") for folder in ("../assets", ".", "models/of garages/")
]


@pytest.mark.parametrize(
    ("form", "folder"), soak_but([("instanced", "models/of garages/"), ("nested", "../assets")], FORMS_AND_FOLDERS)
)
def test_shared_assets_make_the_same_stage_wherever_all_of_it_stands(tmp_path, form, folder):
    own = build(small(form=form), tmp_path / "own" / "g.usdc")
    settings = {"form": form, "assets": "shared", "asset_folder": folder}
    shared = build(small(**settings), tmp_path / "shared" / "1" / "g.usdc")
    assert shared.shared_assets == (tmp_path / "shared" / "1" / folder).resolve()
    assert shared.shared_assets.is_dir()
    assert own.shared_assets is None
    assert shared.labels.read_bytes() == own.labels.read_bytes()
    assert not list(shared.asset_folder.rglob("*_????????????????.*"))
    (tmp_path / "shared").rename(tmp_path / "moved")
    assert composed(tmp_path / "moved" / "1" / "g.usdc") == composed(own.stage)


def corners(mesh, name):
    """A primvar of a mesh at each corner of its faces."""
    primvar = UsdGeom.PrimvarsAPI(mesh).GetPrimvar(name)
    return np.array(primvar.ComputeFlattened()).tobytes() if primvar.HasValue() else b""


def seen(path):
    """What each mesh of a stage looks like at the corners of its faces, and its material with all that it says."""
    stage, found = Usd.Stage.Open(str(path)), {}
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        if not prim.IsA(UsdGeom.Mesh):
            continue
        binding = UsdShade.MaterialBindingAPI(prim)
        materials = [binding.ComputeBoundMaterial(purpose)[0].GetPrim() for purpose in ("", "physics")]
        says = [
            (
                each.GetName(),
                name.GetName(),
                str(name.Get()).rpartition("/")[2],
                [to.name for to in name.GetConnections()],
            )
            for material in materials
            if material
            for each in Usd.PrimRange(material, Usd.TraverseInstanceProxies())
            for name in each.GetAttributes()
        ]
        found[str(prim.GetPath())] = corners(prim, "st"), corners(prim, "normals"), says
    return found


def test_the_own_layer_of_a_drawn_look_defines_materials_once_and_looks_the_same(tmp_path):
    settings = {**SETTINGS, "seed": 2, "look": {"drawn": True}}
    own, shared = (
        build(
            GarageConfig(**{**settings, "stage": {"texture_quality": "low", "assets": place}}),
            tmp_path / place / "1" / "g.usdc",
        )
        for place in ("own", "shared")
    )
    layer = Sdf.Layer.FindOrOpen(str(shared.asset_folder / "Grounds.usdc"))
    kinds = {root.name.partition("_")[0] for root in layer.rootPrims}
    assert {"Looks", "Floor", "StallNumber", "Column", "Wall", "Light"} <= kinds
    surfaces = []
    layer.Traverse("/", lambda path: surfaces.append(path) if path.name == "Surface" and path.IsPrimPath() else None)
    defined = [path.GetParentPath() for path in surfaces if layer.GetPrimAtPath(path).specifier == Sdf.SpecifierDef]
    altered = [path for path in defined if path.GetParentPath() != Sdf.Path("/Looks")]
    assert len(defined) > len(altered)
    assert {path.GetPrefixes()[0].name.partition("_")[0] for path in altered} <= {"Light"}
    assert shared.labels.read_bytes() == own.labels.read_bytes()
    assert seen(shared.stage) == seen(own.stage)


def test_check_and_view_read_shared_assets_as_ones_of_the_stages_own(tmp_path):
    found, shown = [], []
    for assets in ("own", "shared"):
        path = build(small(assets=assets), tmp_path / assets / "a" / "g.usdc").stage
        found.append(check(path)[0])
        # but for the digest of the configuration, which says where the assets are
        shown.append(encode_scene(replace(read_scene(open_stage(path), path), facts={})))
    assert found[0] == found[1]
    assert shown[0] == shown[1]


@pytest.mark.parametrize("seeds", soak_but(1, [[7, 21, 54], [7, 21, 54, 22]]))
def test_garages_that_share_assets_are_small(tmp_path, seeds):
    """Garages of 7 x 9 squares, the default, of the seeds below 100 whose files are largest."""
    config = GarageConfig(stage={"assets": "shared"})
    sizes = []
    for seed in seeds:
        folder = tmp_path / str(seed)
        made = build(config, folder / "g.usdc", seed=seed)
        files = [path for path in folder.rglob("*") if path.is_file()]
        own_layers = [path for path in files if path.suffix == ".usdc"]
        assert {path.name for path in own_layers} == {"g.usdc", "Drive.usdc", "LaneGraph.usdc"}
        assert sum(path.stat().st_size for path in own_layers) < 110_000
        assert set(files) == {made.report, made.labels, *made.pictures, *own_layers}
        assert len(files) == 6
        assert sum(path.stat().st_size for path in files) <= 250_000
        sizes.append(sum(map(len, contents(tmp_path / "assets").values())))
    # the second and third add what is theirs alone: outlines of stalls, stains, numbers, and some models of cars
    assert sizes[2] < 1.65 * sizes[0] < 4_600_000
    assert_named_by_content(tmp_path / "assets")


def test_assets_that_are_there_stay_and_damaged_ones_are_written_again(tmp_path):
    config = small(assets="shared")
    made = build(config, tmp_path / "1" / "g.usdc")
    store = made.shared_assets
    whole = contents(store)
    cut, changed, lost = (min(store.rglob(name)) for name in ("Car_*", "Column_*", "floor_colour_*"))
    cut.write_bytes(cut.read_bytes()[:1000])
    data = bytearray(changed.read_bytes())
    data[len(data) // 2] ^= 1
    changed.write_bytes(data)
    lost.unlink()
    before = {path: path.stat() for path in store.rglob("*.*")}
    build(config, tmp_path / "2" / "g.usdc")
    assert contents(store) == whole
    written = {path for path, status in before.items() if path.stat().st_ino != status.st_ino}
    assert written == {cut, changed}


def test_a_stage_whose_shared_asset_is_damaged_is_refused_with_its_name(tmp_path):
    made = build(small(assets="shared"), tmp_path / "1" / "g.usdc")
    car = min(made.shared_assets.glob("Car_*"))
    car.write_bytes(car.read_bytes()[:1000])
    with pytest.raises(StageError, match=car.name):
        open_stage(made.stage)


BUILDS = """
import json
import sys
from pathlib import Path

import garage2usd

settings, folder = json.loads(sys.argv[1]), Path(sys.argv[2])
print("ready", flush=True)
input()
for seed in map(int, sys.argv[3:]):
    garage2usd.build(garage2usd.GarageConfig(**{**settings, "seed": seed}), folder / f"{seed}" / "g.usdc")
"""


@pytest.mark.soak
def test_several_processes_share_a_folder(tmp_path):
    """Both write at once, most of it the same."""
    settings = json.dumps({**SETTINGS, "stage": {"texture_quality": "low", "assets": "shared"}})
    commands = [
        [sys.executable, "-c", BUILDS, settings, str(tmp_path / "stages"), *seeds] for seeds in (["1", "2"], ["3", "4"])
    ]
    running = [
        subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) for command in commands
    ]
    for process in running:
        assert process.stdout.readline() == "ready\n"
    for process in running:
        process.communicate("\n", timeout=300)
    assert [process.returncode for process in running] == [0, 0]
    store = tmp_path / "stages" / "assets"
    assert_named_by_content(store)
    # and nothing half written was left
    assert {path.suffix for path in store.rglob("*.*")} == {".usdc", ".png", ".jpg"}
    assert not [path for path in store.rglob("*") if path.name.startswith(".")]
    alone = tmp_path / "alone"
    for seed in (1, 2, 3, 4):
        build(small(seed, assets="shared"), alone / f"{seed}" / "g.usdc")
    assert contents(alone) == contents(tmp_path / "stages")


@pytest.mark.parametrize(
    ("stage", "field", "allowed"),
    [
        ({"assets": "shared", "form": StageForm.FLAT}, "stage.assets", "'own' where stage.form is 'flat'"),
        ({"assets": "all"}, "stage.assets", "'own' or 'shared'"),
        *(
            ({"asset_folder": folder}, "stage.asset_folder", "")
            for folder in ("", "/assets", "C:/assets", "a@b", "..\\assets", "a\nb", "x" * 201)
        ),
    ],
)
def test_settings_that_share_nothing_are_refused(stage, field, allowed):
    with pytest.raises(ConfigError) as caught:
        GarageConfig(stage=stage)
    assert caught.value.field == field
    assert allowed in caught.value.allowed


@pytest.mark.parametrize(
    ("name", "folder", "field", "allowed"),
    [
        ("g.usdz", "../assets", "stage.assets", "'own' for a .usdz"),
        ("g.usdc", "g_assets", "stage.asset_folder", "a folder outside of g_assets"),
        ("g.usdc", "x/../g_assets/y", "stage.asset_folder", "a folder outside of g_assets"),
    ],
)
def test_stages_that_cannot_share_are_refused_before_anything_is_made(tmp_path, name, folder, field, allowed):
    with pytest.raises(ConfigError) as caught:
        build(small(assets="shared", asset_folder=folder), tmp_path / name)
    assert caught.value.field == field
    assert allowed in caught.value.allowed
    assert not list(tmp_path.iterdir())
