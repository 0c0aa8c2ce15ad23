"""The viewer's scene: every object of a stage with its class and transform, every shape and surface once."""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.garage.levels import LevelPlace
from garage2usd.reading.lanes import Lanes
from garage2usd.scenes.meshes import Triangles
from garage2usd.scenes.pictures import ALPHA, Band, Bands, Pictures
from garage2usd.scenes.plain_surfaces import base_colour_of
from garage2usd.scenes.remarks import Remarks
from garage2usd.scenes.surfaces import Rgb, SurfaceLook
from garage2usd.scenes.textures import Layout, Texture

_NONE = -1
UNLABELLED = "unlabelled"
"""Class of objects without a semantic label."""


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
        True if the colour texture has an alpha channel.
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


def moved(points_m: NDArray[Any], place: NDArray[np.float64]) -> NDArray[np.float32]:
    """Transform points, shape (..., 3), by a matrix, shape (4, 4), with points as rows."""
    found: NDArray[np.float32] = (points_m @ place[:3, :3] + place[3, :3]).astype(np.float32)
    return found


@dataclass(frozen=True, eq=False)
class Piece:
    """A mesh of a shape in the object's space, with one surface.

    Attributes
    ----------
    mesh, matrix
        The triangles, and their transform; float64, shape (4, 4), points as rows.
    coordinates
        Texture coordinates of the vertices; float32, shape (vertices, 2).
    slot
        Index of its surface in the object's palette.
    is_blended
        True if the surface is translucent.
    collider
        Collision shape as UsdPhysics' token: ``none`` for the triangles themselves, ``convexHull``, ``boundingCube``
        and others; empty without collision.
    """

    mesh: Triangles
    matrix: NDArray[np.float64]
    coordinates: NDArray[np.float32]
    slot: int
    is_blended: bool
    collider: str = ""


@dataclass(frozen=True, eq=False)
class Light:
    """A light in its object's space.

    Attributes
    ----------
    kind
        UsdLux type.
    matrix
        float64, shape (4, 4), points as rows.
    width_m, height_m
        Side lengths, or the diameter twice.
    colour_rgb
        Linear colour.
    candela
        Luminous intensity along -Z.
    """

    kind: str
    matrix: NDArray[np.float64]
    width_m: float
    height_m: float
    colour_rgb: tuple[float, float, float]
    candela: float

    def moved(self, place: NDArray[np.float64]) -> "Light":
        """Return the light transformed by a matrix."""
        return replace(self, matrix=self.matrix @ place)

    def key(self) -> tuple[object, ...]:
        """Key of the light, equal for equal lights."""
        return (
            self.kind,
            self.matrix.tobytes(),
            self.width_m,
            self.height_m,
            self.colour_rgb,
            self.candela,
        )


@dataclass(frozen=True, eq=False)
class Shape:
    """Shape of an object in its own space; objects that differ only in colour share one."""

    pieces: Sequence[Piece]
    lights: Sequence[Light] = ()

    @property
    def colliders(self) -> list[Piece]:
        """Pieces with a collision shape."""
        return [piece for piece in self.pieces if piece.collider]


@dataclass(frozen=True, eq=False)
class Placed:
    """An object of the scene: its prim, class and transform.

    Attributes
    ----------
    path
        Path of its prim, or ``path[index]`` for a point of an instancer.
    label
        Semantic class, or `UNLABELLED`.
    square
        Label of the square on which it stands; empty without one.
    shape, palette
        Indices of its shape and palette in the scene.
    matrix
        Transform to the world; float64, shape (4, 4), points as rows.
    """

    path: str
    label: str
    square: str
    shape: int
    palette: int
    matrix: NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Scene:
    """A stage prepared for drawing, in metres, Y up.

    Attributes
    ----------
    name
        The stage's file name.
    facts
        Metadata of the stage, by name.
    objects
        Every object.
    shapes, palettes, surfaces
        Their geometry and surfaces; a palette has the index of a surface for each slot.
    textures, pictures
        Textures of the surfaces, and the images from which they are taken.
    lanes
        Lane graph and stalls, as far as they are valid.
    ids
        Instance id of each object by its path; empty without a label table beside the stage.
    bounds_m
        Least and greatest corner of the scene; float64, shape (2, 3).
    remarks
        Descriptions of everything that is not shown.
    levels
        The levels, the top one first.
    """

    name: str
    facts: Mapping[str, str]
    objects: Sequence[Placed]
    shapes: Sequence[Shape]
    palettes: Sequence[Sequence[int]]
    surfaces: Sequence[ShownSurface]
    textures: Sequence[Bands]
    pictures: Pictures
    lanes: Lanes
    ids: Mapping[str, int]
    bounds_m: NDArray[np.float64]
    remarks: Sequence[str] = field(default_factory=tuple)
    levels: Sequence[LevelPlace] = ()

    def counts(self) -> dict[str, int]:
        """Number of objects of each class, in descending order."""
        counts = Counter(placed.label for placed in self.objects)
        return dict(sorted(counts.items(), key=lambda item: (-item[1], item[0])))
