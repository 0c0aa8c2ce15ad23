"""Signs in the words of a country: that a garage has them, and everything else where it was."""

import re
from itertools import pairwise

import numpy as np
import pytest
import shapely
from pxr import Usd, UsdGeom, UsdShade
from support.lettering import agreement, outline
from support.soak import soak_but

from garage2usd.assets import MATERIALS, pascal_case
from garage2usd.assets.countries import Country
from garage2usd.assets.glyphs import text_length, text_shape
from garage2usd.assets.number_plates import (
    CHARACTERS,
    DOT,
    PLATE_STYLES,
    PROVINCES,
    SPACE,
    bake_plate_ink,
    ink_cell_corners,
    plate_coordinates,
)
from garage2usd.config import GarageConfig
from garage2usd.objects.exit_sign import ExitSignSpec, Turn
from garage2usd.objects.hydrant_cabinet import HydrantCabinetSpec
from garage2usd.objects.level_plate import LevelPlateSpec
from garage2usd.objects.level_sign import Heading, LevelSignSpec
from garage2usd.objects.lit_sign import lit_sign
from garage2usd.objects.signage import SIGNAGE, Way
from garage2usd.pipeline import build, generate
from garage2usd.profiles import Profile

PLAN = {"episodes": 100}
PROFILES = {"cn-jgj100": "CN", "de-garvo": "DE", "uk-istructe": "GB", "us-ada": "US"}
SIGNED = ("number_plate", "exit_sign", "portal", "hydrant_cabinet")


def laid_out(profile, of):
    return generate(GarageConfig(seed=3, plan=PLAN, profile=profile, look={"signs": {"of": of}})).layout


def places(layout):
    return [
        (place.name, place.kind, place.position_m, place.yaw_rad, place.square, place.ordinal)
        for place in layout.placements
    ]


@pytest.mark.parametrize(("profile", "country"), soak_but([("cn-jgj100", "CN"), ("us-ada", "US")], PROFILES.items()))
def test_signs_are_those_of_the_profile_and_stay_in_their_places(profile, country):
    usual, other = laid_out(profile, "international"), laid_out(profile, "profile")
    assert other.structure == usual.structure
    assert places(other) == places(usual)
    signed = [place.spec.country for layout in (usual, other) for kind in SIGNED for place in layout.of_kind(kind)]
    half = len(signed) // 2
    assert set(signed[:half]) == {Country.NONE}
    assert set(signed[half:]) == {country}
    assert {"portal", "hydrant_cabinet"} <= {place.kind for place in other.placements}


@pytest.mark.parametrize("country", ["", "SE"])
def test_a_profile_of_no_country_or_another_has_international_signs(country):
    layout = laid_out({"name": "none", "country": country}, "profile")
    assert {place.spec.country for kind in SIGNED for place in layout.of_kind(kind)} == {Country.NONE}


def test_a_country_is_a_code():
    with pytest.raises(ValueError, match="country"):
        Profile(name="own", country="Germany")


def drawn(parts, name):
    """What a part shows from the front, as (x, y) with y upwards."""
    part = next(part for part in parts if part.name == name)
    return outline(part.points, part.face_counts, part.face_indices), part.material


WORDS = {"CN": "出口", "GB": "WAY OUT", "US": "EXIT"}


@pytest.mark.parametrize(("country", "word"), WORDS.items())
def test_exit_signs_say_it_in_the_words_of_the_country(country, word):
    parts = ExitSignSpec(Turn.LEFT, 0.58, 0.2, Country(country)).asset().parts
    shape, material = drawn(parts, "Word")
    assert agreement(shape, word) > 0.95
    assert all(agreement(shape, other) < 0.8 for other in WORDS.values() if other != word)
    box = next(part for part in parts if part.name == "Box")
    assert (box.material, material) == (
        ("housing_white", "sign_red") if country == "US" else ("exit_green", "exit_white")
    )


def test_german_exit_signs_have_the_pictogram_alone():
    names = {part.name for part in ExitSignSpec(Turn.LEFT, 0.58, 0.2, Country.DE).asset().parts}
    assert "Runner" in names
    assert "Word" not in names


@pytest.mark.parametrize("country", [each for each in Country if each])
def test_what_is_on_an_exit_sign_stays_on_it_and_apart(country):
    parts = ExitSignSpec(Turn.RIGHT, 0.58, 0.2, country).asset().parts
    on_it = [drawn(parts, part.name)[0] for part in parts if part.name in {"Runner", "Word", "ArrowShaft"}]
    assert all(shapely.box(-0.4, -0.78, 0.4, -0.58).buffer(-0.005).contains(shape) for shape in on_it)
    bounds = sorted(shape.bounds for shape in on_it)
    assert all(left[2] < right[0] for left, right in pairwise(bounds))


@pytest.mark.parametrize("way", Way)
@pytest.mark.parametrize("country", Country)
def test_words_over_doors_fit_between_the_symbols(country, way):
    legend = lit_sign("Sign", way, (-2.5, 2.5), (2.6, 3.1), 0.0, country=country)[1]
    shape, _ = drawn([legend], "SignLegend")
    symbols = [part for part in shapely.get_parts(shape) if abs(part.centroid.x) > 0.93]
    words = [part for part in shapely.get_parts(shape) if abs(part.centroid.x) <= 0.93]
    left, _, right, _ = shapely.union_all(words).bounds
    assert left > max(part.bounds[2] for part in symbols if part.centroid.x < 0)
    assert right < min(part.bounds[0] for part in symbols if part.centroid.x > 0)


@pytest.mark.parametrize("heading", [None, *Heading])
@pytest.mark.parametrize("country", Country)
def test_signs_and_plates_of_levels_say_it_in_the_words_of_the_country(country, heading):
    sign = LevelSignSpec("U2", heading, 0.58, 0.4, is_way_out=heading is Heading.UP, country=country)
    parts = sign.asset().parts
    border, _ = drawn(parts, "Border")
    legend = [drawn(parts, name)[0] for name in ("Arrow", "Name", "Word") if name in {part.name for part in parts}]
    inside = shapely.Polygon(border.interiors[0])
    assert all(shape.within(inside.buffer(-0.02)) for shape in legend)
    bounds = sorted(shape.bounds for shape in legend)
    assert all(left[2] + 0.05 < right[0] for left, right in pairwise(bounds))
    assert agreement(drawn(parts, "Name")[0], "U2") > 0.95
    word = SIGNAGE[country].exit if sign.is_way_out else SIGNAGE[country].level
    if heading in {None, Heading.UP}:
        assert agreement(drawn(parts, "Word")[0], word) > 0.9
    plate = LevelPlateSpec("U3", country).asset().parts
    shapes = [drawn(plate, name)[0] for name in ("Name", "Word")]
    assert [agreement(shape, text) > 0.9 for shape, text in zip(shapes, ("U3", SIGNAGE[country].level), strict=True)]
    assert shapes[0].bounds[3] + 0.02 < shapes[1].bounds[1]
    assert shapely.union_all(shapes).within(drawn(plate, "Plate")[0].buffer(-0.01))


@pytest.mark.parametrize("country", Country)
def test_hydrant_cabinets_have_the_number_of_the_fire_brigade(country):
    shape, _ = drawn(HydrantCabinetSpec(country).asset().parts, "Letters")
    split = (shape.bounds[1] + shape.bounds[3]) / 2
    lower = shapely.intersection(shape, shapely.box(-1, shape.bounds[1], 1, split - 0.012))
    assert agreement(lower, SIGNAGE[country].fire_number) > 0.9
    assert shape.bounds[2] - shape.bounds[0] < 0.54


def test_chinese_characters_are_apart_and_full():
    for word in ("入口", "出口", "禁止驶入", "消火栓", "层"):
        shape = text_shape(word, 1.0)
        assert shape.bounds[2] - shape.bounds[0] == pytest.approx(text_length(word), abs=0.35)
        assert 0.2 < shape.area / len(word) < 0.6


PLATES = {"CN": "[京沪川湘冀][U-Z]·[A-Z]{3}\\d\\d", "DE": "[JTU] [A-Z]{2} \\d\\d", "GB": "[A-Z]{2}00 [A-Z]{3}"}
PLATES["US"] = "[A-Z]{2}\\d \\d[A-Z]{2}"


@pytest.mark.parametrize(
    ("profile", "country"), soak_but([("cn-jgj100", "CN"), ("uk-istructe", "GB")], PROFILES.items())
)
def test_number_plates_are_those_of_the_country(profile, country, tmp_path):
    config = GarageConfig(
        seed=3, plan=PLAN, profile=profile, look={"signs": {"of": "profile"}}, stage={"texture_quality": "low"}
    )
    stage = Usd.Stage.Open(str(build(config, tmp_path / "garage.usda").stage))
    texts = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not prim.HasAttribute("garage:numberPlate:text"):
            continue
        text = prim.GetAttribute("garage:numberPlate:text").Get()
        assert re.fullmatch(PLATES[country], text)
        texts.add(text)
        meshes = [each for each in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()) if each.IsA(UsdGeom.Mesh)]
        style = PLATE_STYLES[Country(country)]
        assert [mesh.GetName() for mesh in meshes] == [name for name, _ in style.meshes]
        for mesh, (_, key) in zip(meshes, style.meshes, strict=True):
            points = np.array(UsdGeom.Mesh(mesh).GetPointsAttr().Get())
            assert np.ptp(points[:, 0]) == pytest.approx(style.width_m, abs=1e-4)
            st = np.array(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("st").Get())
            assert st == pytest.approx(plate_coordinates(text, Country(country)), abs=1e-5)
            material = UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0]
            assert material.GetPrim().GetName() == pascal_case(key)
    assert len(texts) > 15


@pytest.mark.parametrize(
    ("country", "rear", "sheet"), [("CN", False, "blue"), ("GB", False, "white"), ("GB", True, "yellow")]
)
def test_plates_have_the_colours_of_the_country(country, rear, sheet):
    material = MATERIALS[PLATE_STYLES[Country(country)].meshes[int(rear)][1]]
    red, green, blue = material.colour_texture.paint_rgb
    assert {"blue": blue > 4 * red, "white": min(red, green, blue) > 0.6, "yellow": red > green > 5 * blue}[sheet]


def test_every_place_on_a_plate_of_ink_shows_its_character():
    ink = bake_plate_ink(np.random.default_rng(0)) / 255
    high, wide = ink.shape
    for character in CHARACTERS + DOT + PROVINCES:
        corners = ink_cell_corners(character) * (wide, high)
        left, low, right, top = *corners.min(axis=0), *corners.max(axis=0)
        cell = ink[round(high - top) : round(high - low), round(left) : round(right)]
        assert 0.005 < cell.mean() < 0.5
        assert cell[0].max() == cell[-1].max() == cell[:, 0].max() == cell[:, -1].max() == 0
    assert ink_cell_corners(SPACE).shape == (4, 2)
