"""Surfaces reduced to three pictures with equal coordinates: colour with opacity, finish, and normals."""
# Over 300 lines: the reading of materials, and their pictures as formats for files take them.

import io
import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from garage2usd.scenes.pictures import Band, Bands, Pictures, factored, has_sixteen_bits, resized
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import Rgb, SurfaceLook, within
from garage2usd.scenes.textures import Layout, Texture

_DIRECTIONS = (2.0, 2.0, 2.0), (-1.0, -1.0, -1.0)
"""Scale and bias from a picture's values to a normal, where 8 bits store (n + 1) / 2."""
_LARGEST_PX, _MUCH_PX = 1024, 4096
_KEPT_MODES, _KEPT_SUFFIXES = frozenset({"L", "RGB", "RGBA"}), {"PNG": ".png", "JPEG": ".jpg"}
_WORD_TO_BYTE = 257
_WHITE = (1.0, 1.0, 1.0)
_REFLECTED = 0.04
"""Reflectance of a dielectric at normal incidence."""
_SMOOTH_COAT = 0.05
_SMALLEST = 1e-6


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


@dataclass(frozen=True)
class PlainPicture:
    """A picture of at most 1024 pixels a side: a PNG of 8 bits, or a JPEG.

    Attributes
    ----------
    data, suffix
        Its bytes, and the extension of its file.
    """

    data: bytes
    suffix: str


@dataclass(frozen=True)
class PlainSurface:
    """A surface of a model.

    Attributes
    ----------
    name
        Name of the material in the file.
    colour_rgb
        Linear colour, or the tint of `picture`.
    roughness, metallic, opacity, clearcoat
        From 0 to 1.
    ior
        Index of refraction.
    picture
        Base colour, with the opacity as alpha if `has_alpha`; None for none.
    packed
        Occlusion, roughness and metallic in red, green and blue, which replace these numbers; None for none.
    normals
        Normal map, in which 8 bits store (n + 1) / 2; None for none.
    has_alpha
        True if the picture's alpha is the opacity.
    wraps
        Wrap modes outside the unit square along U and V: ``repeat``, ``mirror`` or ``clamp``.
    """

    name: str = ""
    colour_rgb: Rgb = (0.5, 0.5, 0.5)
    roughness: float = 0.5
    metallic: float = 0.0
    opacity: float = 1.0
    clearcoat: float = 0.0
    ior: float = 1.5
    picture: PlainPicture | None = None
    packed: PlainPicture | None = None
    normals: PlainPicture | None = None
    has_alpha: bool = False
    wraps: tuple[str, str] = ("repeat", "repeat")


def plain_surface_of(look: SurfaceLook, pictures: Pictures, remarks: Remarks) -> tuple[PlainSurface, Layout | None]:
    """Reduce a surface to three pictures; also return the layout that they share, None without pictures.

    Parameters
    ----------
    look
        The surface.
    pictures
        Its pictures.
    remarks
        Receives remarks on properties that are omitted or replaced by a mean.
    """
    return _Reduction(_metallic(look, pictures, remarks), pictures, remarks).result()


class _Reduction:
    """A surface that is being reduced."""

    def __init__(self, look: SurfaceLook, pictures: Pictures, remarks: Remarks) -> None:
        self._look, self._pictures, self._remarks = look, pictures, remarks
        textures = (
            look.colour_texture,
            look.opacity_texture,
            look.roughness_texture,
            look.metallic_texture,
            look.normal_texture,
            look.occlusion_texture,
        )
        self._layout = next((texture.layout for texture in textures if texture), None)

    def result(self) -> tuple[PlainSurface, Layout | None]:
        look = self._look
        if any(look.emissive_rgb):
            self._remarks.add("emission is not used", look.name)
        if look.clearcoat and (look.clearcoat_roughness_texture or look.clearcoat_roughness > _SMOOTH_COAT):
            self._remarks.add("the roughness of coats is not used", look.name)
        colour, opacity, bands = self._coloured()
        roughness, metallic = self._number("roughness"), self._number("metallic")
        occlusion = self._number("occlusion")
        finish = occlusion, roughness, metallic
        is_packed = any(isinstance(value, Band) for value in finish)
        normal = self._alike(look.normal_texture)
        if look.normal_texture and not normal:
            self._remarks.add("normal maps that lie unlike the colour's are left out", look.normal_texture.file)
        layout = self._layout
        surface = PlainSurface(
            look.name,
            colour,
            1.0 if isinstance(roughness, Band) else roughness,
            1.0 if isinstance(metallic, Band) else metallic,
            opacity,
            self._mean("clearcoat"),
            look.ior,
            self._picture(bands, is_srgb=True) if bands else None,
            self._picture(finish) if is_packed else None,
            self._picture(normal_bands_of(normal, self._remarks)) if normal else None,
            has_alpha=len(bands) > len(_WHITE),
            wraps=(layout.wrap_s, layout.wrap_t) if layout else ("repeat", "repeat"),
        )
        return surface, layout

    def _coloured(self) -> tuple[Rgb, float, Bands]:
        """Return the colour or the tint of the picture, the opacity, and the bands of the picture, if any."""
        look, colour = self._look, self._alike(self._look.colour_texture)
        tint, bands = list(look.colour_rgb), Bands()
        if colour:
            tint, bands = factored(colour.band(channel) for channel in range(3))
        alpha = self._alike(look.opacity_texture)
        opacity = look.opacity
        if look.opacity_texture and not alpha:
            opacity = self._mean("opacity")
        red, green, blue = tint
        if not alpha:
            cut = look.opacity_threshold
            return (red, green, blue), float(opacity >= cut) if cut else opacity, bands
        band = alpha.band()
        if cut := look.opacity_threshold:
            band = self._cut(band, cut / max(opacity, _SMALLEST))
        else:
            band = band._replace(scale=band.scale * opacity, bias=band.bias * opacity)
        return (red, green, blue), 1.0, (*(bands or _WHITE), band)

    def _cut(self, band: Band, threshold: float) -> Band:
        """Return a band of 1 where another one reaches a threshold, and of 0 elsewhere."""
        file = f"{band} from {threshold}"
        self._pictures.give_values(file, (self._pictures.plane(band) >= threshold).astype(np.float64))
        return Band(file, 0)

    def _alike(self, texture: Texture | None) -> Texture | None:
        """Return a texture if its layout is that of the first one."""
        return texture if texture and texture.layout == self._layout else None

    def _number(self, name: str) -> Band | float:
        """Return the band of a number's texture, or the number."""
        texture = self._alike(getattr(self._look, f"{name}_texture"))
        return texture.band() if texture else self._mean(name)

    def _mean(self, name: str) -> float:
        """Return a number, or the mean of its texture if the texture cannot be kept."""
        texture: Texture | None = getattr(self._look, f"{name}_texture")
        value = float(getattr(self._look, name))
        if texture is None:
            return value
        which = "" if name == "clearcoat" else " that lie unlike the colour's"
        self._remarks.add(f"textures of {name}{which} are carried as their mean", texture.file)
        return within(self._pictures.mean(texture.band()), 1.0)

    def _picture(self, bands: Bands, *, is_srgb: bool = False) -> PlainPicture:
        made = self._pictures.composed(bands, is_srgb=is_srgb, largest_px=_LARGEST_PX)
        return self._fitted(made.data, has_alpha=len(bands) > len(_WHITE))

    def _fitted(self, data: bytes, *, has_alpha: bool) -> PlainPicture:
        """Reduce a picture to a form that every reader of USD supports."""
        with Image.open(io.BytesIO(data)) as picture:
            picture.load()
            suffix = _KEPT_SUFFIXES.get(picture.format or "", "")
            is_byte = picture.mode in _KEPT_MODES and not has_sixteen_bits(data)
            if suffix and is_byte and max(picture.size) <= _LARGEST_PX:
                return PlainPicture(data, suffix)
            grey = picture.mode.startswith("I")  # 16 bits, which `convert` would cut off at 255
            whole = Image.fromarray((np.asarray(picture) // _WORD_TO_BYTE).astype(np.uint8)) if grey else picture
            image = whole.convert("RGBA" if has_alpha else "RGB")
        if max(image.size) > _MUCH_PX:
            self._remarks.add(
                f"pictures of over {_MUCH_PX} pixels a side are reduced to {_LARGEST_PX}", self._look.name
            )
        scale = min(1.0, _LARGEST_PX / max(image.size))
        width, height = (max(1, round(side * scale)) for side in image.size)
        stream = io.BytesIO()
        image.resize((width, height), Image.Resampling.BOX).save(stream, format="PNG", compress_level=6)
        return PlainPicture(stream.getvalue(), ".png")


def _metallic(look: SurfaceLook, pictures: Pictures, remarks: Remarks) -> SurfaceLook:
    """Return a surface with a specular colour as one with metallic, by the conversion of Khronos.

    Notes
    -----
    From the appendix of KHR_materials_pbrSpecularGlossiness: a surface whose specular colour is brighter than that of
    the metalness is the one that explains the brightness of both colours.
    """
    specular_rgb = look.specular_rgb
    if specular_rgb is None:
        return look
    given = look.colour_texture, look.specular_texture
    if given[0] and given[1] and given[0].layout != given[1].layout:
        remarks.add("specular textures that lie unlike the colour's are carried as their mean", given[1].file)
        given = given[0], None
        mean = [pictures.mean(look.specular_texture.band(channel)) for channel in range(3)]  # type: ignore[union-attr]
        specular_rgb = mean[0], mean[1], mean[2]
    colours = zip(given, (look.colour_rgb, specular_rgb), strict=True)
    planes = [_plane(texture, rgb, pictures) for texture, rgb in colours]
    rows, columns = max((plane.shape[:2] for plane in planes), key=math.prod)
    share = min(1.0, _LARGEST_PX / max(rows, columns))
    size = max(1, round(share * columns)), max(1, round(share * rows))
    diffuse, specular = (
        np.stack([resized(plane[..., channel], size) for channel in range(3)], axis=2) for plane in planes
    )
    metallic, colour = _by_khronos(diffuse, specular)
    first = given[0] or given[1]
    if first is None:
        red, green, blue = colour[0, 0].tolist()
        return replace(look, colour_rgb=(red, green, blue), metallic=float(metallic[0, 0]), specular_rgb=None)
    files = " and ".join(texture.file for texture in given if texture)
    factors = [texture and (texture.scale, texture.bias, texture.channel) for texture in given]
    said = f"{files}, {look.colour_rgb}, {specular_rgb}, {factors}"
    names = [f"{kind} of {said}" for kind in ("colour", "metallic")]
    pictures.give_values(names[0], colour, is_srgb=True)
    pictures.give_values(names[1], metallic)
    return replace(
        look,
        colour_texture=Texture(names[0], -1, first.layout, colour_space="sRGB"),
        metallic_texture=Texture(names[1], 0, first.layout, colour_space="raw"),
        colour_rgb=_WHITE,
        metallic=1.0,
        specular_rgb=None,
        specular_texture=None,
    )


def _plane(texture: Texture | None, rgb: Rgb, pictures: Pictures) -> NDArray[np.float64]:
    """Return the linear colours of a texture, shape (rows, columns, 3); one pixel without a texture."""
    if texture is None:
        return np.array(rgb, dtype=np.float64)[None, None]
    return np.stack([pictures.plane(texture.band(channel)) for channel in range(3)], axis=2).clip(0, 1)


def _by_khronos(
    diffuse: NDArray[np.float64], specular: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return metallic, shape (...), and base colour, shape (..., 3), of diffuse and specular colours."""
    left = 1 - specular.max(axis=-1)
    dark, bright = (np.sqrt(colour**2 @ np.array([0.299, 0.587, 0.114])) for colour in (diffuse, specular))
    half = (dark * left / (1 - _REFLECTED) + bright - 2 * _REFLECTED) / (2 * _REFLECTED)
    root = np.sqrt(np.maximum(half**2 - (_REFLECTED - bright) / _REFLECTED, 0))
    metallic = np.where(bright < _REFLECTED, 0.0, np.clip(root - half, 0, 1))
    share = metallic[..., None]
    plain = diffuse * (left / (1 - _REFLECTED))[..., None] / np.maximum(1 - share, _SMALLEST)
    metal = (specular - _REFLECTED * (1 - share)) / np.maximum(share, _SMALLEST)
    return metallic, np.clip(plain + (metal - plain) * share**2, 0, 1)
