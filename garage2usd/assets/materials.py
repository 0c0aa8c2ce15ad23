"""Materials of all parts, as parameters of a standard surface."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple

from pydantic import TypeAdapter

from garage2usd.common.documents import shipped_toml
from garage2usd.config.map_names import Channel
from garage2usd.config.texture_sets import MapFile

Rgb = tuple[float, float, float]


class PaintedTexture(NamedTuple):
    """A texture of paint that is worn down to its ground.

    Attributes
    ----------
    mask
        File name in the texture folder of an indexed image with the degree of wear.
    paint_rgb, ground_rgb
        Linear colours of the paint and of the ground below it.
    """

    mask: str
    paint_rgb: Rgb
    ground_rgb: Rgb


class OwnTexture(NamedTuple):
    """A texture of the user.

    Attributes
    ----------
    role
        Role of the texture set.
    maps
        Only colour, only normal, or any of occlusion, roughness and metallic, which are packed into one texture.
    roughness, metallic
        Values of a packed texture without these maps, 0 to 1.
    """

    role: str
    maps: tuple[tuple[Channel, MapFile], ...]
    roughness: float = 0.6
    metallic: float = 0.0

    @property
    def use(self) -> str:
        """Input of the surface that uses the texture: ``colour``, ``normal`` or ``packed``."""
        channel = self.maps[0][0]
        return str(channel) if channel in {Channel.COLOUR, Channel.NORMAL} else "packed"


class StoredTexture(NamedTuple):
    """A texture of a model that the user supplies.

    Attributes
    ----------
    stem
        Beginning of its file name.
    data
        RGB or RGBA image.
    suffix
        Extension of its format: ``.png`` or ``.jpg``.
    """

    stem: str
    data: bytes
    suffix: str = ".png"


Texture = str | PaintedTexture | OwnTexture | StoredTexture
"""A file name in the texture folder, or the source of a derived texture."""


class Touch(StrEnum):
    """Class of friction against a tyre."""

    CONCRETE = "concrete"
    COATING = "coating"
    RUBBER = "rubber"
    STEEL = "steel"
    PLASTIC = "plastic"


@dataclass(frozen=True)
class Material:
    """A material as parameters of a standard surface.

    Attributes
    ----------
    colour_rgb
        Linear base colour without a texture.
    colour_texture, packed_texture, normal_texture
        Textures. A packed one has occlusion, roughness and metallic in red, green and blue.
    tint_rgb
        Linear factor on the colour texture.
    roughness, metallic, opacity, clearcoat
        0 to 1.
    has_alpha
        True if the colour texture's alpha is the opacity.
    ior
        Index of refraction; None for the default.
    emissive_rgb
        Linear radiance.
    repeat_m
        Size of one repeat of the textures in metres.
    repeat_up_m
        Size along V, if it differs.
    wraps
        Wrap modes of the textures along U and V: ``repeat``, ``mirror`` or ``clamp``.
    touch
        Class of friction.
    """

    colour_rgb: Rgb = (0.5, 0.5, 0.5)
    colour_texture: Texture | None = None
    tint_rgb: Rgb = (1.0, 1.0, 1.0)
    roughness: float = 0.6
    packed_texture: Texture | None = None
    normal_texture: Texture | None = None
    metallic: float = 0.0
    opacity: float = 1.0
    has_alpha: bool = False
    clearcoat: float = 0.0
    ior: float | None = None
    emissive_rgb: Rgb = (0.0, 0.0, 0.0)
    repeat_m: float = 1.0
    repeat_up_m: float | None = None
    wraps: tuple[str, str] = ("repeat", "repeat")
    touch: Touch = Touch.CONCRETE

    def textures(self) -> tuple[Texture, ...]:
        """Textures of the material."""
        names = (self.colour_texture, self.packed_texture, self.normal_texture)
        return tuple(name for name in names if name is not None)


class Finish(NamedTuple):
    """A material that replaces a standard one in a garage.

    Attributes
    ----------
    key
        Key of the material in `MATERIALS` that defines its friction and non-visual properties.
    material
        Appearance.
    """

    key: str
    material: Material


VARYING = frozenset({"car_paint"})
"""Materials with paint variants, which set colour, roughness and metallic."""

GLOSSES: dict[str, str] = {
    "mirror": "gloss_mirror.png",
    "polished": "gloss_polished.png",
    "satin": "gloss_satin.png",
    "matt": "gloss_matt.png",
}
"""Packed textures by gloss for floors of concrete and epoxy, from smooth to rough."""


def _read_materials() -> dict[str, Material]:
    adapter = TypeAdapter(Material)
    materials: dict[str, Material] = {}
    for key, given in shipped_toml("garage2usd.assets", "materials").items():
        materials[key] = materials[given] if isinstance(given, str) else adapter.validate_python(given)
    return materials


MATERIALS = _read_materials()
"""Every material by its key, as in `materials.toml`."""


def finished(key: str, finishes: Mapping[str, Finish]) -> Finish:
    """Return the finish of a material in a garage, or the material itself if it has no finish."""
    return finishes.get(key) or Finish(key, MATERIALS[key])
