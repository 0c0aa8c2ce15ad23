"""Surfaces of a stage as materials of FBX: a colour and an opacity, their picture, and a normal map."""

from typing import Any

from garage2usd.maps.carla_names import plain_name
from garage2usd.scenes.pictures import Bands, Pictures
from garage2usd.scenes.plain_surfaces import normal_bands_of
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.textures import Texture

_LARGEST_PX = 1024
_MEANS = "roughness", "metallic", "clearcoat", "clearcoat_roughness", "occlusion", "emissive", "specular"
"""Textures that FBX has no place for, or that Unreal does not import."""
_SUFFIXES = {"image/png": ".png", "image/jpeg": ".jpg"}


class Materials:
    """Builder of the materials of an FBX file.

    Parameters
    ----------
    pictures
        Pictures of the surfaces' textures.
    remarks
        Receives remarks on features that these materials lack.

    Attributes
    ----------
    values
        The materials as plain values, in the order of their first use.
    files
        Bytes of their pictures by the names of files; pictures of equal bytes are one file.
    """

    def __init__(self, pictures: Pictures, remarks: Remarks) -> None:
        self.values: list[dict[str, Any]] = []
        self.files: dict[str, bytes] = {}
        self._pictures, self._remarks = pictures, remarks
        self._number_of: dict[int, int] = {}

    def number(self, surface: int, look: SurfaceLook) -> int:
        """Return the number of the material of a surface, itself given by its number."""
        if surface not in self._number_of:
            self._number_of[surface] = len(self.values)
            self.values.append(self._values_of(look))
        return self._number_of[surface]

    def _values_of(self, look: SurfaceLook) -> dict[str, Any]:
        """Return the plain values of a material: FBX has a colour, an opacity and a normal map as pictures."""
        layout = (texture := first_texture(look)) and texture.layout
        colour = look.colour_texture
        alpha, normal = (
            own if own and own.layout == layout else None for own in (look.opacity_texture, look.normal_texture)
        )
        if any(getattr(look, f"{kind}_texture") for kind in _MEANS):
            self._remarks.add("textures other than colour, opacity and normals are carried as their mean", look.name)
        if look.colour_name:
            self._remarks.add("colours by point are carried as their mean", look.name)
        bands: Bands = tuple(colour.band(channel) for channel in range(3)) if colour else ()
        if alpha:
            bands = (*(bands or look.colour_rgb), alpha.band())
        glow = look.emissive_rgb if look.emissive_texture is None else self._mean_colour(look.emissive_texture)
        name = f"{plain_name(look.name or 'Surface')}_{len(self.values):02d}"
        return {
            "name": name,
            "colour_rgb": list(look.colour_rgb),
            "emissive_rgb": list(glow),
            "roughness": self._mean(look, "roughness"),
            "metallic": self._mean(look, "metallic"),
            "opacity": 1.0 if alpha else look.opacity,
            "has_alpha": alpha is not None,
            "picture": self._file(bands, f"{name}_colour", is_srgb=True) if bands else "",
            "normals": self._file(normal_bands_of(normal, self._remarks), f"{name}_normal") if normal else "",
        }

    def _mean(self, look: SurfaceLook, name: str) -> float:
        texture: Texture | None = getattr(look, f"{name}_texture")
        return self._pictures.mean(texture.band()) if texture else float(getattr(look, name))

    def _mean_colour(self, texture: Texture) -> tuple[float, float, float]:
        red, green, blue = (self._pictures.mean(texture.band(channel)) for channel in range(3))
        return red, green, blue

    def _file(self, bands: Bands, name: str, *, is_srgb: bool = False) -> str:
        """Return the name of the file of a picture; pictures of equal bytes are stored once."""
        made = self._pictures.composed(bands, is_srgb=is_srgb, largest_px=_LARGEST_PX)
        same = next((file for file, data in self.files.items() if data == made.data), "")
        file = same or name + _SUFFIXES[made.kind]
        self.files[file] = made.data
        return file


def first_texture(look: SurfaceLook) -> Texture | None:
    """Return the texture whose layout all pictures of a material share; None without one."""
    return look.colour_texture or look.opacity_texture or look.normal_texture
