"""Base colour of a surface: colour and opacity combined, for formats with one texture for both."""

from typing import NamedTuple

from garage2usd.scenes.pictures import Bands, Pictures, factored
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import Rgb, SurfaceLook
from garage2usd.scenes.textures import Texture

__all__ = ["BaseColour", "base_colour_of"]


class BaseColour(NamedTuple):
    """Base colour of a surface: factors, and a texture multiplied by them.

    Attributes
    ----------
    colour_rgb, opacity
        0 to 1.
    bands
        Channels of the texture; the fourth is the opacity.
    texture
        Layout of the texture on the surface; None without a texture.
    """

    colour_rgb: Rgb
    opacity: float
    bands: Bands
    texture: Texture | None


def base_colour_of(surface: SurfaceLook, pictures: Pictures, remarks: Remarks) -> BaseColour:
    """Combine a surface's colour and opacity; add a remark to `remarks` where they cannot be combined."""
    colour, opacity = surface.colour_texture, surface.opacity_texture
    factors, share = [min(part, 1.0) for part in surface.colour_rgb], surface.opacity
    if colour and opacity and colour.layout != opacity.layout:
        remarks.add("opacity textures that lie unlike the colour's are carried as their mean", opacity.file)
        share, opacity = min(max(pictures.mean(opacity.band()), 0.0), 1.0), None
    bands: Bands = (1.0, 1.0, 1.0)
    if colour:
        factors, bands = factored(colour.band(channel) for channel in range(3))
    if opacity:
        (share,), alpha = factored([opacity.band()])
        bands += alpha
    elif colour and surface.is_blended and pictures.has_alpha(colour.file):
        bands += (1.0,)
    red, green, blue = factors
    return BaseColour((red, green, blue), share, bands, colour or opacity)
