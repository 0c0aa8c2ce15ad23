"""What a look asks for is in the materials and lights of the prefab."""

import base64
import io
import math
import zipfile
from pathlib import PurePosixPath

import numpy as np
import pytest
from PIL import Image
from scipy.spatial import KDTree
from support.finishes import assert_shown, grouped, lamp_of, surfaces_by_object, unity_surface
from support.foreign_set import assert_foreign_set, foreign_config
from support.places import MILLIMETRE
from support.sample_files import REPOSITORY
from support.unity.layer import place_of

import garage2usd


@pytest.fixture(scope="module")
def built(builds):
    return builds(REPOSITORY / "samples" / "looks.toml", "usdz")


@pytest.fixture(scope="module")
def prefab(built, prefabs):
    return prefabs(built.stage)


def pixels_of(texture):
    """Red, green, blue and alpha, the first row on top."""
    values = np.frombuffer(base64.b64decode(texture["pixels"]), dtype=np.uint8)
    return values.reshape(texture["height"], texture["width"], 4)[::-1]


def path_of(item):
    """The path in the stage of an object of the prefab, whose root has the name of the file."""
    return f"/{item['path'].partition('/')[2]}"


def test_surfaces(built, prefab):
    surfaces = surfaces_by_object(built.garage.layout, built.garage.config.stage.texture_quality)
    expected = {path: set(own.values()) for path, own in surfaces.items()}
    found = [
        (path_of(item), unity_surface(prefab.assets[name], prefab.assets))
        for item in prefab.objects
        if "mesh" in item
        for name in item["materials"]
    ]
    assert_shown(grouped(found, expected), expected)


def test_gloss_is_turned_into_smoothness_and_worn_paint_is_as_it_is(built, prefab):
    textures = {asset["name"]: asset for asset in prefab.of_type("Texture2D").values()}
    with zipfile.ZipFile(built.stage) as archive:
        files = {PurePosixPath(name).name: archive.read(name) for name in archive.namelist() if name.endswith(".png")}
    judged = {name: data for name, data in files.items() if name.startswith(("gloss_", "wear_"))}
    assert {name.partition("_")[0] for name in judged} == {"gloss", "wear"}
    for name, data in judged.items():
        pixels = pixels_of(textures[name])
        with Image.open(io.BytesIO(data)) as picture:
            red, green, blue = np.asarray(picture.convert("RGB")).transpose(2, 0, 1)
        if name.startswith("gloss_"):
            assert np.array_equal(pixels, np.stack([blue, red, 0 * red, 255 - green], axis=2))
        else:
            assert np.array_equal(pixels[..., :3], np.stack([red, green, blue], axis=2))


def test_lamps(built, prefab):
    lamps = built.garage.layout.of_kind("light")
    lamp_at = KDTree([(place.position_m[0], -place.position_m[2]) for place in lamps])
    lights = [item for item in prefab.objects if "usdLight" in item]
    assert len(lights) == len(lamps)
    for item in lights:
        away_m, number = lamp_at.query(place_of(item)[[0, 2]])
        assert away_m < MILLIMETRE
        lamp = lamp_of(lamps[number].spec)
        given, light = item["usdLight"], item["light"]
        assert given["kind"] == "Disk"
        assert given["luminance"] == pytest.approx(lamp.intensity, rel=1e-5)
        assert given["candela"] == pytest.approx(lamp.intensity * math.pi / 4 * lamp.sides_m[0] ** 2, rel=1e-4)
        assert light["enabled"] == (lamp.intensity > 0)
        linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in light["color"]]
        assert linear == pytest.approx(lamp.colour_rgb, abs=1e-4)


def test_textures_of_ones_own(prefabs, tmp_path):
    built = garage2usd.build(foreign_config(tmp_path / "set"), tmp_path / "own.usdz")
    prefab = prefabs(built.stage)
    found = {}
    for material in prefab.of_type("Material").values():
        found.setdefault(material["name"], set()).add(unity_surface(material, prefab.assets))
    textures = {asset["name"]: asset for asset in prefab.of_type("Texture2D").values()}

    def halves(name):
        if name.endswith(".jpg"):
            return None  # the fakes decode none
        pixels = pixels_of(textures[name])
        rows, columns = pixels.shape[:2]
        return pixels[rows // 4, columns // 2], pixels[rows * 3 // 4, columns // 2]

    assert_foreign_set(found, halves, packed=lambda own: (own[2], own[0], 0, 255 - own[1]))
