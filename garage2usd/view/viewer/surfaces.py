"""Surfaces in the form in which the page draws them."""

from typing import NamedTuple

from garage2usd.scenes.base_colours import base_colour_of
from garage2usd.scenes.pictures import ALPHA, Band, Bands, Pictures
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import Rgb, SurfaceLook
from garage2usd.scenes.textures import Layout, Texture

__all__ = ["ShownSurface", "ShownSurfaces"]

_NONE = -1


class ShownSurface(NamedTuple):
    """A surface with at most one texture each for colour with opacity, roughness and metallic.

    Attributes
    ----------
    colour_rgb, emissive_rgb, roughness, metallic, opacity, clearcoat, opacity_threshold
        As in `garage2usd.scenes.surfaces.SurfaceLook`; factors on the texture if there is one.
    colour_texture, roughness_texture, metallic_texture
        Indices of textures; -1 for none.
    roughness_channel, metallic_channel
        Channel of the texture.
    has_alpha
        Whether the colour texture has an alpha channel.
    set, layout
        Set of texture coordinates, and the transform of the texture.
    """

    colour_rgb: Rgb
    emissive_rgb: Rgb
    roughness: float
    metallic: float
    opacity: float
    clearcoat: float
    opacity_threshold: float
    colour_texture: int
    roughness_texture: int
    roughness_channel: int
    metallic_texture: int
    metallic_channel: int
    has_alpha: bool
    set: int
    layout: Layout

    @property
    def is_blended(self) -> bool:
        """True if the surface is translucent."""
        return self.has_alpha or self.opacity < 1


class ShownSurfaces:
    """Converter of surfaces for the page, which collects their textures.

    Parameters
    ----------
    pictures
        Images of textures.
    remarks
        Called with everything that the page cannot show.

    Attributes
    ----------
    textures
        Image of each texture.
    """

    def __init__(self, pictures: Pictures, remarks: Remarks) -> None:
        self.textures: list[Bands] = []
        self._pictures, self._remarks = pictures, remarks

    def of(self, look: SurfaceLook) -> ShownSurface:
        """Convert a surface for the page."""
        base = base_colour_of(look, self._pictures, self._remarks)
        rough, metal, layout = look.roughness_texture, look.metallic_texture, Layout()
        roughness, metallic = look.roughness, look.metallic
        if base.texture:
            layout = base.texture.layout
        elif rough:
            layout = rough.layout
        if rough and rough.layout != layout:
            self._remarks.add("roughness textures that lie unlike the colour's are shown as their mean", rough.file)
            roughness, rough = self._pictures.mean(rough.band()), None
        if look.colour_name:
            self._remarks.add("colours by point are shown as their mean", look.name or look.colour_name)
        return ShownSurface(
            colour_rgb=base.colour_rgb,
            emissive_rgb=self._glow(look),
            roughness=roughness,
            metallic=metallic,
            opacity=base.opacity,
            clearcoat=look.clearcoat,
            opacity_threshold=look.opacity_threshold,
            colour_texture=self._number(base.bands) if base.texture else _NONE,
            **self._channel("roughness", rough),
            **self._channel("metallic", metal),
            has_alpha=len(base.bands) > ALPHA and isinstance(base.bands[ALPHA], Band),
            set=look.sets.index(layout.coordinates) if layout.coordinates in look.sets else 0,
            layout=layout,
        )

    def _channel(self, name: str, texture: Texture | None) -> dict[str, int]:
        """Index and channel of a texture for a scalar input."""
        if texture is None:
            return {f"{name}_texture": _NONE, f"{name}_channel": 0}
        band = texture.band()
        channel = band.channel % ALPHA
        bands = tuple(band if number == channel else None for number in range(3))
        return {f"{name}_texture": self._number(bands), f"{name}_channel": channel}

    def _number(self, bands: Bands) -> int:
        if bands not in self.textures:
            self.textures.append(bands)
        return self.textures.index(bands)

    def _glow(self, look: SurfaceLook) -> Rgb:
        if look.emissive_texture is None:
            return look.emissive_rgb
        self._remarks.add("textures of what glows are shown as their mean", look.emissive_texture.file)
        red, green, blue = (self._pictures.mean(look.emissive_texture.band(channel)) for channel in range(3))
        return red, green, blue
