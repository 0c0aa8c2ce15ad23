"""Prefabs built on running fakes of Unity's classes hold what the layout holds, where it stands."""

import hashlib
import itertools
import json
import re
import shutil
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdPhysics, UsdShade
from support.label_tables import labelled_objects
from support.places import assert_same_places, place_of_part
from support.sample_files import OBJECT_SAMPLES, SAMPLES
from support.small_garage import SETTINGS
from support.unity.layer import axes_of, from_usd, place_of, world_vertices

from garage2usd import GarageConfig, build
from garage2usd.assets.mesh import Collider
from garage2usd.objects import KINDS
from garage2usd.stage.labels import OBJECT_LABELS
from garage2usd.stage.prototypes import asset_of

SAMPLE = {sample.stem: sample for sample in SAMPLES}
SMALL = None
"""In the place of a sample: the garage of twelve squares."""
IN_ALL_FORMS = SAMPLE["irregular"], SAMPLE["mixed_stalls"]
FORMS = [("usda", None), ("usdc", "nested"), ("usdz", None), ("usdc", "flat")]
IMPORTS = [
    *itertools.product([SMALL, *IN_ALL_FORMS], FORMS),
    *((sample, ("usdc", "nested")) for sample in OBJECT_SAMPLES if sample not in IN_ALL_FORMS),
    (SAMPLE["paper_7x9"], ("usdz", "flat")),
]


def each_import(cases):
    """The small garage in all forms, and wide ones of samples."""
    marked = [
        pytest.param(
            sample,
            *form,
            id="-".join(map(str, (sample.stem if sample else "small", *form))),
            marks=[] if sample is SMALL else [pytest.mark.soak],
        )
        for sample, form in cases
    ]
    return pytest.mark.parametrize(("sample", "extension", "form"), marked)


def in_forms(*forms):
    return each_import(itertools.product([SMALL, SAMPLE["irregular"]], forms))


INSTANCERS = tuple(f"/{kind.scattered}" for kind in KINDS if kind.scattered)
COLLIDERS = {
    Collider.MESH: ("MeshCollider", False),
    Collider.CONVEX_HULL: ("MeshCollider", True),
    Collider.BOX: ("BoxCollider", None),
}


@pytest.fixture(scope="session")
def imported(prefabs, builds, small_builds):
    """Import a sample, or the small garage, in a format and form, once."""
    made = {}

    def one(sample, extension, form=None):
        key = sample, extension, form
        if key not in made:
            build = small_builds(extension, form) if sample is SMALL else builds(sample, extension, form)
            made[key] = build, prefabs(build.stage)
        return made[key]

    return one


def directed(position_m, yaw_rad) -> np.ndarray:
    """Where something stands and which way its +Z looks, in Unity's axes."""
    looks = np.stack([np.sin(yaw_rad), np.zeros_like(yaw_rad), np.cos(yaw_rad)], axis=1)
    return np.hstack([from_usd(position_m), from_usd(looks)])


def directed_object(item) -> np.ndarray:
    # +Z of the stage is -Z here
    return np.concatenate([place_of(item), -axes_of(item)[:, 2]])


@each_import(IMPORTS)
def test_every_object_of_the_layout_stands_and_looks_as_it_should(imported, sample, extension, form):
    build, prefab = imported(sample, extension, form)
    placements = build.garage.layout.placements
    for kind in OBJECT_LABELS:
        rows = placements.rows_of(kind)
        expected = directed(placements.position_m[rows], placements.yaw_rad[rows])
        # an instancer has the label of its points
        items = [item for item in prefab.labelled(OBJECT_LABELS[kind]) if not item["path"].endswith(INSTANCERS)]
        found = np.array([directed_object(item) for item in items]).reshape(-1, 6)
        assert_same_places(found, expected)


def test_a_garage_whose_z_points_up_is_imported_as_any_other(imported, prefabs, tmp_path):
    _, usual = imported(SMALL, "usda")
    turned = GarageConfig(**{**SETTINGS, "stage": {**SETTINGS["stage"], "up_axis": "Z"}})
    found = prefabs(build(turned, tmp_path / "small.usda").stage)
    assert [item["path"] for item in found.objects] == [item["path"] for item in usual.objects]
    for item, other in zip(found.objects, usual.objects, strict=True):
        assert np.allclose(place_of(item), place_of(other), atol=1e-4), item["path"]
        if "mesh" in item:
            told, shown = world_vertices(usual, other), world_vertices(found, item)
            assert np.allclose(shown, told, atol=1e-4), item["path"]


@in_forms(("usda", None), ("usdc", "nested"), ("usdc", "flat"))
def test_every_part_of_every_asset_is_drawn_and_collides_as_it_should(imported, sample, extension, form):
    build, prefab = imported(sample, extension, form)
    expected = {}
    for placement in build.garage.layout.placements:
        for part in asset_of(placement.spec).parts:
            expected.setdefault((part.name, COLLIDERS.get(part.collider)), []).append(place_of_part(placement, part))
    found = {}
    for item in prefab.objects:
        collider = item.get("collider")
        if "mesh" in item:
            kind = None if collider is None else (collider["type"], collider.get("convex"))
            found.setdefault((item["path"].rpartition("/")[2], kind), []).append(place_of(item))
        else:
            assert collider is None
    assert {key: len(places) for key, places in found.items()} == {key: len(places) for key, places in expected.items()}
    for key, places in expected.items():
        assert_same_places(found[key], from_usd(places))


def test_boxes_are_around_their_meshes_and_colliders_rub_as_the_stage_says(imported):
    build, prefab = imported(SMALL, "usda")
    stage = Usd.Stage.Open(str(build.stage))
    expected = Counter()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.HasAPI(UsdPhysics.CollisionAPI):
            material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial("physics")[0]
            api = UsdPhysics.MaterialAPI(material)
            attributes = api.GetStaticFrictionAttr(), api.GetDynamicFrictionAttr(), api.GetRestitutionAttr()
            expected[prim.GetName(), *(round(attribute.Get(), 4) for attribute in attributes)] += 1
    found = Counter()
    for item in prefab.objects:
        if "collider" in item:
            friction = prefab.assets[item["collider"]["material"]]["friction"]
            found[item["path"].rpartition("/")[2], *(round(number, 4) for number in friction)] += 1
            if item["collider"]["type"] == "BoxCollider":
                mesh = prefab.assets[item["mesh"]]
                assert item["collider"]["center"] == mesh["center"]
                assert item["collider"]["size"] == mesh["size"]
            else:
                assert item["collider"]["mesh"] == item["mesh"]
    assert found == expected


def content(prim: Usd.Prim) -> str:
    """A digest of all that makes a mesh look as it does."""
    digest = hashlib.sha256()
    names = ["points", "faceVertexCounts", "faceVertexIndices", "orientation", "doubleSided", "holeIndices"]
    names += [f"primvars:{name}{tail}" for name in ("normals", "st") for tail in ("", ":indices")]
    for name in names:
        value = prim.GetAttribute(name).Get() if prim.HasAttribute(name) else None
        digest.update(f"{name} {np.array(value).tobytes() if value is not None else None}".encode())
    return digest.hexdigest()


@in_forms(*FORMS)
def test_there_is_one_mesh_asset_for_each_distinct_mesh(imported, sample, extension, form):
    build, prefab = imported(sample, extension, form)
    stage = Usd.Stage.Open(str(build.stage))
    roots = [stage.GetPseudoRoot(), *stage.GetPrototypes()]
    meshes = {content(prim) for root in roots for prim in Usd.PrimRange(root) if prim.IsA(UsdGeom.Mesh)}
    used = {item["mesh"] for item in prefab.objects if "mesh" in item}
    assert used == prefab.of_type("Mesh").keys()
    assert len(used) == len(meshes)
    for name in used:
        assert not prefab.assets[name]["has32BitIndices"]


def file_names(prim: Usd.Prim, connected: str) -> set[str]:
    """Image files behind an input of a material's surface."""
    surface = UsdShade.Material(prim).ComputeSurfaceSource()[0]
    source = surface.GetInput(connected).GetConnectedSource() if surface.GetInput(connected) else None
    if source is None:
        return set()
    return {Path(source[0].GetPrim().GetAttribute("inputs:file").Get().path).name}


@in_forms(("usdz", None), ("usdc", "nested"))
def test_every_material_has_its_textures(imported, sample, extension, form):
    build, prefab = imported(sample, extension, form)
    stage = Usd.Stage.Open(str(build.stage))
    expected = Counter()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdGeom.Mesh) and not prim.GetPath().HasPrefix("/Garage/StallNumbers"):
            if prim.GetPath().HasPrefix("/Garage/ZonePlates"):
                continue
            material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0].GetPrim()
            mask = set().union(*(file_names(material, name) for name in ("metallic", "roughness", "occlusion")))
            files = [file_names(material, "diffuseColor"), file_names(material, "normal"), mask]
            expected[prim.GetName(), *(" ".join(sorted(names)) for names in files)] += 1
    found = Counter()
    for item in prefab.objects:
        if "mesh" not in item or "/StallNumbers/" in item["path"] or "/ZonePlates/" in item["path"]:
            continue
        (material,) = item["materials"]
        textures = prefab.assets[material]["textures"]
        assert textures.get("_MetallicGlossMap") == textures.get("_OcclusionMap")
        names = [prefab.assets[textures[key]]["name"] if key in textures else "" for key in ("_MainTex", "_BumpMap")]
        mask = textures.get("_MetallicGlossMap")
        found[item["path"].rpartition("/")[2], *names, prefab.assets[mask]["name"] if mask else ""] += 1
    assert found == expected
    assert {texture for asset in prefab.of_type("Material").values() for texture in asset["textures"].values()} == set(
        prefab.of_type("Texture2D")
    )


def test_the_fronts_of_all_meshes_look_outwards(imported):
    _, prefab = imported(SMALL, "usda")
    checked = 0
    for mesh in prefab.of_type("Mesh").values():
        if "vertices" not in mesh:
            continue
        points, normals = (np.array(mesh[name]).reshape(-1, 3) for name in ("vertices", "normals"))
        for part in mesh["parts"]:
            a, b, c = np.array(part).reshape(-1, 3).T
            cross = np.cross(points[b] - points[a], points[c] - points[a])
            area = np.linalg.norm(cross, axis=1)
            # slivers of a rounding's size have no direction
            facing = np.einsum("ij,ij->i", cross, normals[a] + normals[b] + normals[c])[area > 1e-7]
            assert (facing > 0).all()
            checked += len(facing)
    assert checked > 5000


def test_an_asymmetric_garage_is_not_mirrored(imported):
    """The corners of every column, as the layout has them, are in the prefab and those of its mirror image are not."""
    build, prefab = imported(SAMPLE["mixed_stalls"], "usdz")
    columns = build.garage.layout.of_kind("column")
    corners = np.concatenate(
        [np.array(asset_of(column.spec).parts[0].points) + column.position_m for column in columns]
    )
    shafts = [item for item in prefab.objects if "/Columns/" in item["path"] and "mesh" in item]
    first = asset_of(columns[0].spec).parts[0].name
    found = [world_vertices(prefab, item) for item in shafts if item["path"].endswith(first)]
    found = np.unique(np.round(np.concatenate(found), 4), axis=0)
    expected = np.unique(np.round(from_usd(corners), 4) + 0.0, axis=0)
    assert_same_places(np.unique(np.round(found + 0.0, 3), axis=0), np.unique(np.round(expected, 3), axis=0))
    middle = expected.mean(axis=0)
    mirrored = (expected - middle) * [-1, 1, 1] + middle
    with pytest.raises(AssertionError):
        assert_same_places(np.unique(np.round(mirrored, 3), axis=0), np.unique(np.round(expected, 3), axis=0), 0.5)


def test_lights_shine_down_from_the_tubes_as_strongly_as_the_formula_says(imported):
    build, prefab = imported(SMALL, "usda")
    tubes = np.array([place.position_m for place in build.garage.layout.of_kind("light")])
    lights = [item for item in prefab.objects if "light" in item]
    found = np.array([place_of(item) for item in lights])
    assert_same_places(found[:, [0, 2]], from_usd(tubes)[:, [0, 2]])
    for item in lights:
        light, given = item["light"], item["usdLight"]
        assert 0 < build.garage.layout.ceiling_height_m - place_of(item)[1] < 0.2
        assert light["forward"] == pytest.approx([0, -1, 0], abs=1e-5)
        assert (given["kind"], light["type"]) == ("Rect", "Spot")
        width, height = given["size"][:2]
        assert given["luminance"] == pytest.approx(given["stated"] / 27, rel=1e-3)
        assert given["candela"] == pytest.approx(given["luminance"] * width * height)
        assert given["lumen"] == pytest.approx(np.pi * given["candela"])
        largest = np.array(light["color"]).max()
        assert largest == pytest.approx(1, abs=1e-6)
        assert light["intensity"] == pytest.approx(given["candela"] / np.pi, rel=1e-5)
    assert not [item for item in prefab.objects if item["path"].endswith("/Glow")]


@in_forms(("usda", None), ("usdc", "nested"), ("usdc", "flat"))
def test_labelled_objects_have_the_ids_of_the_table_beside_the_stage(imported, sample, extension, form):
    build, prefab = imported(sample, extension, form)
    expected = {item["path"]: (item["id"], item["class"]) for item in labelled_objects(build.labels)}
    found = {}
    for item in prefab.objects:
        if "labels" in item:
            path = item["path"].partition("/")[2]
            # points are below their instancer and named after it
            path = re.sub(r"(\w+)/\1\[", r"\1[", path)
            found[f"/{path}"] = item["instance"], item["labels"].get("class", [None])[0]
    assert {path: found[path] for path in expected} == expected
    others = [instance for path, (instance, _) in found.items() if path not in expected]
    assert sorted(others) == list(range(len(expected) + 1, len(found) + 1))


def test_labels_without_a_table_are_numbered_and_bad_tables_refused(prefabs, prefab_dump, small_builds, tmp_path):
    build = small_builds("usdz")
    alone = tmp_path / "alone" / "alone.usdz"
    alone.parent.mkdir()
    shutil.copy(build.stage, alone)
    labelled = [item["instance"] for item in prefabs(alone).objects if "labels" in item]
    assert sorted(labelled) == list(range(1, len(labelled) + 1))
    table = alone.with_name("alone_labels.json")
    for text in (
        '{"objects": [["A", 1]]}',
        '{"objects": {"": [["A"]]}}',
        '{"objects": {"": [["A", 0]]}}',
        '{"objects": {"": [["A", "x"]]}}',
        '{"objects": {"": [["A", 1',
        "[" * 300,
        "",
    ):
        table.write_text(text)
        (error,) = prefab_dump.ask("prefab", alone)["errors"]
        assert "alone_labels.json" in error
    name = json.dumps('\u00e9\\/\n"')
    values = f'[1.5e3, null, {{"b": {name}}}]'
    table.write_text(f'{{"a": {values}, "objects": {{{name}: [], "/A": [[{name}, 1], ["B", 7, {values}]]}}}}')
    assert len([item for item in prefabs(alone).objects if item.get("instance") == 7]) == 1


def test_what_moves_is_not_static(imported):
    _, prefab = imported(SMALL, "usda")
    moving = {item["path"] for label in ("car", "number_plate", "barrier") for item in prefab.labelled(label)}
    assert moving
    for item in prefab.objects[1:]:
        parents = itertools.accumulate(item["path"].split("/"), lambda a, b: f"{a}/{b}")
        is_moving = any(parent in moving for parent in parents)
        # contributes to GI, occludes, is occluded, is reflected; never batched with instancing on
        assert item["static"] == (0 if is_moving else 1 | 2 | 16 | 64), item["path"]


def test_variants_of_the_stage_decide_what_is_there(prefabs, small_builds):
    build = small_builds("usdc")
    stage = Usd.Stage.CreateNew(str(build.stage.with_name("switched.usda")))
    root = stage.DefinePrim("/Garage")
    root.GetReferences().AddReference(f"./{build.stage.name}")
    stage.SetDefaultPrim(root)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    for name, choice in {"occupancy": "empty", "lights": "off", "ceiling": "hidden"}.items():
        root.GetVariantSet(name).SetVariantSelection(choice)
    stage.Save()
    prefab = prefabs(build.stage.with_name("switched.usda"))
    assert not [item for item in prefab.labelled("car") if item["shown"]]
    assert not [item for item in prefab.labelled("ceiling") if item["shown"]]
    assert [item for item in prefab.labelled("column") if item["shown"]]
    lights = [item["light"] for item in prefab.objects if "light" in item]
    assert lights
    assert all(light["intensity"] == 0 and not light["enabled"] for light in lights)


def test_an_import_depends_on_every_file_that_it_read(imported):
    build, prefab = imported(SMALL, "usda")
    folder = build.stage.parent.name
    files = {f"{folder}/{path.relative_to(build.stage.parent)}" for path in build.asset_folder.rglob("*.*")}
    assert set(prefab.found["sources"]) >= files - {f"{folder}/{build.stage.name}"}
    assert prefab.found["dependencies"] == ["Garage.Unity/RenderPipeline"]
