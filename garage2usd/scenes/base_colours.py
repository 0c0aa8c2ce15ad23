"""Textures of a surface as other formats take them: colour and opacity in one, and normals as bytes."""

from typing import NamedTuple

from garage2usd.scenes.pictures import Bands, Pictures, factored
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import Rgb, SurfaceLook
from garage2usd.scenes.textures import Texture

_DIRECTIONS = (2.0, 2.0, 2.0), (-1.0, -1.0, -1.0)
"""Scale and bias from a picture's values to a normal, where 8 bits store (n + 1) / 2."""


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


def normal_bands_of(texture: Texture, remarks: Remarks) -> Bands:
    """Return the bands of a normal map that stores (n + 1) / 2; add a remark if its scale and bias are not given."""
    scale, bias = texture.scale[:3], texture.bias[:3]
    if (scale, bias) == ((1.0,) * 3, (0.0,) * 3):
        remarks.add("normal maps without scale and bias are read with those of bytes, 2 and -1", texture.file)
        scale, bias = _DIRECTIONS
    return tuple(
        texture.band(channel)._replace(scale=scale[channel] / 2, bias=(bias[channel] + 1) / 2) for channel in range(3)
    )
