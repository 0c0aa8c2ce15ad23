"""How surfaces and lamps of a layout look by its settings alone: what every program that opens its stage should show.

Each program's own reader of surfaces is here too, so that one predicate judges them all.
"""

from collections import defaultdict
from pathlib import PurePosixPath
from typing import NamedTuple

import numpy as np

from garage2usd.assets import MATERIALS, VARYING, pascal_case
from garage2usd.assets.light import lamp_colour
from garage2usd.config.look import LampKind
from garage2usd.look import finishes_of
from garage2usd.objects.kind import piece_name
from garage2usd.stage.arrangement import arrange
from garage2usd.stage.looks import texture_file
from garage2usd.stage.prototypes import asset_of

NITS_PER_INTENSITY = 27
USUAL_LAMP_RGB = (1.0, 0.97, 0.92)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
TOLERANCE = 1e-4


class Surface(NamedTuple):
    """What a program shows of a surface.

    Attributes
    ----------
    colour_rgb
        Linear; the factor of the texture where there is one.
    glow_rgb
        Linear radiance.
    roughness
        1 where a texture says it.
    colour, packed, normal
        Names of the files of textures; empty for none.
    """

    colour_rgb: tuple[float, float, float]
    glow_rgb: tuple[float, float, float] = (0.0, 0.0, 0.0)
    roughness: float = 1.0
    colour: str = ""
    packed: str = ""
    normal: str = ""

    @property
    def numbers(self):
        return np.array([*self.colour_rgb, *self.glow_rgb, self.roughness])


class Lamp(NamedTuple):
    """What a program shows of a lamp: radiance is `intensity` times the colour; a round one has its diameter twice."""

    colour_rgb: tuple[float, float, float]
    intensity: float
    sides_m: tuple[float, float]
    is_round: bool


def lamp_of(spec):
    """The light of a lamp: as bright to the eye whatever its colour, and of none where it is dead."""
    rgb = lamp_colour(spec.temperature_k)
    lit = 0.0 if spec.is_dead else spec.luminance_nit / NITS_PER_INTENSITY
    return Lamp(rgb, lit * _brighter(rgb), (spec.length_m, spec.width_m), spec.form is LampKind.ROUND)


def _brighter(rgb):
    return float(LUMINANCE @ USUAL_LAMP_RGB / (LUMINANCE @ rgb))


def surfaces_by_object(layout, quality):
    """The surfaces of each object by its path and then by the name of its material."""
    finishes = finishes_of(layout.look)
    found = {}
    for path, placement in zip(arrange(layout, nested=False).paths(), layout.placements, strict=True):
        asset = asset_of(placement.spec)
        tint = np.ones(3)
        if asset.light is not None:
            rgb = lamp_colour(placement.spec.temperature_k)
            tint = _brighter(rgb) * np.array(rgb) / USUAL_LAMP_RGB
        found[path] = {}
        for key in {part.material for part in asset.parts}:
            usual = MATERIALS[asset.paints[placement.spec.paint] if key in VARYING else key]
            material = finishes[key].material if key in finishes else usual
            found[path][pascal_case(key)] = _surface(material, quality, tint)
    return found


def _surface(material, quality, tint):
    def name(texture):
        return "" if texture is None else texture_file(texture, quality).name

    return Surface(
        material.tint_rgb if material.colour_texture else material.colour_rgb,
        tuple((np.array(material.emissive_rgb) * tint).tolist()),
        1.0 if material.packed_texture else material.roughness,
        name(material.colour_texture),
        name(material.packed_texture),
        name(material.normal_texture),
    )


def materials_by_mesh(layout):
    """Name of the material of each mesh by its path."""
    placed = zip(arrange(layout, nested=False).paths(), layout.placements, strict=True)
    return {
        f"{path}/Asset/{piece_name(part.piece) if part.piece else 'Geom'}/{part.name}": pascal_case(part.material)
        for path, placement in placed
        for part in asset_of(placement.spec).parts
    }


def grouped(items, paths):
    """The surfaces of objects by their paths, of pairs of the path of something in an object and its surface."""
    found = defaultdict(set)
    for path, surface in items:
        owner = PurePosixPath(path)
        while str(owner) not in paths:
            assert owner != owner.parent, path
            owner = owner.parent
        found[str(owner)].add(surface)
    return found


def assert_shown(found, expected, *, normals=True):
    """Surfaces that are found in each object are those that are expected, and no others.

    Parameters
    ----------
    found, expected
        Surfaces by path or name.
    normals
        Whether the program shows normal maps.
    """
    assert found.keys() == expected.keys()
    known = {}
    for key, surfaces in found.items():
        pair = frozenset(surfaces), frozenset(expected[key])
        if pair not in known:
            known[pair] = all(
                any(_alike(one, other, normals=normals) for other in others)
                for some, others in (pair, pair[::-1])
                for one in some
            )
        assert known[pair], (key, sorted(pair[0]), sorted(pair[1]))


def _alike(one, other, *, normals):
    is_same = (one.colour, one.packed) == (other.colour, other.packed) and (not normals or one.normal == other.normal)
    return is_same and np.allclose(one.numbers, other.numbers, rtol=TOLERANCE, atol=TOLERANCE)


def three_surface(shown, names):
    """What three.js shows of a material, as the page says it; names of files are known by their marks."""
    maps = {name: names[mark] for name, mark in shown["maps"].items()}
    packed = {maps.get(name, "") for name in ("aoMap", "roughnessMap", "metalnessMap")}
    assert len(packed) == 1, maps
    return Surface(
        tuple(shown["color"]),
        tuple(shown["emissive"]),
        shown["roughness"],
        maps.get("map", ""),
        packed.pop(),
        maps.get("normalMap", ""),
    )


def glb_surface(glb, number, names):
    """A material of a GLB; names of files are known by what they hold."""
    material = glb.json["materials"][number]

    def name(info):
        image = glb.json["textures"][info["index"]]["source"]
        return names[bytes(glb.view(glb.json["images"][image]["bufferView"]))]

    reflection = material["pbrMetallicRoughness"]
    packed = reflection.get("metallicRoughnessTexture")
    if packed:
        assert material["occlusionTexture"]["index"] == packed["index"]
    strength = material.get("extensions", {}).get("KHR_materials_emissive_strength", {}).get("emissiveStrength", 1.0)
    return Surface(
        tuple(reflection.get("baseColorFactor", (1.0,) * 3)[:3]),
        tuple(strength * part for part in material.get("emissiveFactor", (0.0,) * 3)),
        reflection.get("roughnessFactor", 1.0),
        name(reflection["baseColorTexture"]) if "baseColorTexture" in reflection else "",
        name(packed) if packed else "",
        name(material["normalTexture"]) if "normalTexture" in material else "",
    )


def unity_surface(material, assets):
    """A material of the built-in pipeline in a prefab."""

    def linear(values):
        return tuple(v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in values)

    def name(slot):
        return assets[material["textures"][slot]]["name"] if slot in material["textures"] else ""

    packed = name("_MetallicGlossMap")
    assert name("_OcclusionMap") == packed
    floats = material["floats"]
    assert not packed or floats["_GlossMapScale"] == 1
    return Surface(
        linear(material["colors"]["_Color"][:3]),
        tuple(material["colors"].get("_EmissionColor", (0.0,) * 3)[:3]),
        1.0 if packed else 1 - floats["_Glossiness"],
        name("_MainTex"),
        packed,
        name("_BumpMap"),
    )


def viewer_surface(shown, textures):
    """A surface as the viewer's page draws it, which has no normal maps."""

    def name(number):
        if number < 0:
            return ""
        files = {band.file for band in textures[number] if band is not None}
        assert len(files) == 1
        return PurePosixPath(files.pop().rstrip("]")).name

    packed = name(shown.roughness_texture)
    assert name(shown.metallic_texture) == packed
    assert not packed or (shown.roughness_channel, shown.metallic_channel) == (1, 2)
    return Surface(shown.colour_rgb, shown.emissive_rgb, shown.roughness, name(shown.colour_texture), packed)


def blender_surface(shown):
    """A material of Blender, as its dump says it."""
    maps = {name: image for name, (image, _) in shown.items()}
    assert maps["Roughness"] == maps["Metallic"]
    return Surface(
        tuple(shown["Base Color"][1][:3]),
        tuple(shown["Emission Color"][1][:3]),
        1.0 if maps["Roughness"] else shown["Roughness"][1],
        maps["Base Color"],
        maps["Roughness"],
        maps["Normal"],
    )


def pxr_surface(shader):
    """A UsdPreviewSurface by pxr alone."""

    def given(name, default):
        source = shader.GetInput(name)
        connected = source.GetConnectedSources()[0] if source else []
        if not connected:
            return "", default if not source or source.Get() is None else source.Get()
        reader = connected[0].source.GetPrim()
        scale = reader.GetAttribute("inputs:scale")
        file = reader.GetAttribute("inputs:file").Get()
        assert file.resolvedPath, file
        return PurePosixPath(file.path).name, scale.Get() if scale else (1.0,) * 4

    colour, factor = given("diffuseColor", (0.18,) * 3)
    packed, rough = given("roughness", 0.5)
    assert given("occlusion", 1.0)[0] == given("metallic", 0.0)[0] == packed
    return Surface(
        tuple(factor)[:3],
        tuple(given("emissiveColor", (0.0,) * 3)[1]),
        1.0 if packed else rough,
        colour,
        packed,
        given("normal", None)[0],
    )
