"""The surfaces of a stage as rays meet them: where, and how each reflects light."""
# Over 300 lines: hits, and the looks and textures at them.

import math
from collections.abc import Collection, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.package import of_extra
from garage2usd.scenes.meshes import unit
from garage2usd.scenes.surfaces import SurfaceLook
from garage2usd.scenes.textures import Texture
from garage2usd.sensors.rays.ray_scene import RayScene

if TYPE_CHECKING:
    from embreex.rtcore_scene import EmbreeScene

Floats = NDArray[np.float32]
_PAST_M = 1e-4
_MOST_SHEETS = 8
"""How many surfaces that are opaque in part a ray passes."""
_SHINE = 0.04
"""Reflectance of a dielectric at normal incidence."""
_LEAST_ROUGHNESS = 0.03
_OPAQUE = 0.5
"""Opacity from which on surfaces stop rays in pictures other than colour, as in the path tracer's."""
_SHARPER = 0.7
"""Of a pixel's size, as which textures are looked up: a pixel is the mean of several places."""


def dots(one: NDArray[Any], other: NDArray[Any]) -> Floats:
    """Multiply rows of vectors; shape (n,)."""
    found: Floats = np.einsum("ij,ij->i", one, other)
    return found


def embree_scene(corners_m: Floats) -> "EmbreeScene":
    """Make the scene of triangles, shape (n, 3, 3), on which Embree casts rays.

    Raises
    ------
    MissingExtraError
        If Embree is not installed.
    """
    with of_extra("drawing by rays"):
        from embreex.mesh_construction import TriangleMesh  # noqa: PLC0415
        from embreex.rtcore_scene import EmbreeScene  # noqa: PLC0415
    scene = EmbreeScene()
    TriangleMesh(scene, corners_m)
    return scene


class Hits(NamedTuple):
    """First hits of rays; rows of rays without a hit are not among them.

    Attributes
    ----------
    ray
        Numbers of the rays; int64, shape (n,).
    triangle
        int64, shape (n,).
    weights
        Of the triangle's second and third corner; float32, shape (n, 2).
    range_m
        float32, shape (n,).
    """

    ray: NDArray[np.int64]
    triangle: NDArray[np.int64]
    weights: Floats
    range_m: Floats

    def of(self, rows: NDArray[np.int64]) -> "Hits":
        """Return some of the hits."""
        return Hits(self.ray[rows], self.triangle[rows], self.weights[rows], self.range_m[rows])


def _joined(parts: Sequence[Hits]) -> Hits:
    """Join hits."""
    return Hits(
        np.concatenate([each.ray for each in parts]),
        np.concatenate([each.triangle for each in parts]),
        np.concatenate([each.weights for each in parts]),
        np.concatenate([each.range_m for each in parts]),
    )


def stopped(hits: Hits, sheets: Iterable[tuple[Hits, Floats]], count: int) -> Hits:
    """Return the hits of so many rays with those on sheets that are more than half opaque, where these are nearer."""
    range_m = np.full(count, np.inf, np.float32)
    range_m[hits.ray] = hits.range_m
    parts = []
    for sheet, opacity in sheets:
        own = sheet.of(np.flatnonzero((opacity > _OPAQUE) & (sheet.range_m < range_m[sheet.ray])))
        range_m[own.ray] = own.range_m
        parts.append(own)
    if not parts:
        return hits
    veiled = _joined(parts)
    return _joined([hits.of(np.flatnonzero(~np.isin(hits.ray, veiled.ray))), veiled])


class Shades(NamedTuple):
    """How surfaces reflect light at places.

    Attributes
    ----------
    diffuse_rgb, shine_rgb, glow_rgb
        Albedo, reflectance at normal incidence, and radiance of their own; float32, shape (n, 3).
    roughness
        float32, shape (n,).
    normal
        Towards the side of the ray, by the normal map; float32, shape (n, 3).
    """

    diffuse_rgb: Floats
    shine_rgb: Floats
    glow_rgb: Floats
    roughness: Floats
    normal: Floats


@dataclass(frozen=True, eq=False)
class LitScene:
    """A ray scene whose surfaces reflect light.

    Attributes
    ----------
    scene
        Triangles and looks.
    """

    scene: RayScene

    def hits(self, origins_m: NDArray[Any], directions: NDArray[Any], unseen: Collection[int] = ()) -> Hits:
        """Find the first hits of rays, shape (n, 3) each, on what no texture makes opaque in part.

        They pass through objects of the ids that are unseen.
        """
        ways = np.ascontiguousarray(directions, dtype=np.float32)
        found = self._first(self._solid, 0, np.ascontiguousarray(origins_m, dtype=np.float32), ways)
        passed = np.isin(self.scene.instance[found.triangle], list(unseen)) if unseen else np.zeros(0, dtype=np.bool_)
        if not passed.any():
            return found
        behind, rays = found.of(np.flatnonzero(passed)), found.ray[passed]
        begins = np.asarray(origins_m)[rays] + ways[rays] * (behind.range_m + np.float32(_PAST_M))[:, None]
        there = self.hits(begins, ways[rays], unseen)
        range_m = there.range_m + behind.range_m[there.ray] + np.float32(_PAST_M)
        there = there._replace(ray=rays[there.ray], range_m=range_m)
        return _joined([found.of(np.flatnonzero(~passed)), there])

    def veils(self, origins_m: Floats, directions: Floats, range_m: Floats) -> Iterator[tuple[Hits, Floats]]:
        """Yield hits of rays on what is opaque in part, up to a range, from front to back, and their opacity."""
        going, passed_m, starts = np.arange(len(directions)), np.zeros(len(directions), np.float32), origins_m.copy()
        for _ in range(_MOST_SHEETS if len(self._numbers[1]) else 0):
            found = self._first(self._veils, 1, starts[going], directions[going])
            ray = going[found.ray]
            away_m = passed_m[ray] + found.range_m
            is_seen = away_m < range_m[ray] + np.float32(_PAST_M)
            sheet = Hits(ray[is_seen], found.triangle[is_seen], found.weights[is_seen], away_m[is_seen])
            going = sheet.ray
            if not len(going):
                return
            yield sheet, self._opacity(sheet)
            passed_m[going] = sheet.range_m + np.float32(_PAST_M)
            starts[going] = origins_m[going] + directions[going] * passed_m[going, None]

    def is_dark(self, origins_m: Floats, directions: Floats, range_m: Floats) -> NDArray[np.bool_]:
        """Test if something stands between origins and the ends of rays; bool, shape (n,)."""
        found = self._solid.run(origins_m, directions, dists=np.ascontiguousarray(range_m), query="OCCLUDED")
        dark: NDArray[np.bool_] = found != -1
        return dark

    def shades(self, hits: Hits, directions: NDArray[Any], footprint_m: Floats) -> Shades:
        """Find how surfaces reflect at hits of rays of unit vectors, shape (n, 3), by pixels of a size, shape (n,).

        Where all sizes are infinite, textures are their means, and normal maps count for nothing.
        """
        scene, count = self.scene, len(hits.triangle)
        diffuse, shine = np.empty((count, 3), np.float32), np.empty((count, 3), np.float32)
        glow, roughness = np.empty((count, 3), np.float32), np.empty(count, np.float32)
        normals, is_fine = self.blended(scene.normals, hits), bool(np.isfinite(footprint_m).all())
        surface = self._surfaces[hits.triangle]
        order = np.argsort(surface, kind="stable")  # 16 bits are sorted by their digits
        surface = surface[order]
        ends = [*(np.flatnonzero(surface[1:] != surface[:-1]) + 1).tolist(), count]
        for first, last in pairwise([0, *ends] if count else []):
            rows = order[first:last]
            look = scene.surfaces[surface[first]]
            own = _Rows(self, look, hits.of(rows), footprint_m[rows])
            colour = own.colour(look.colour_rgb, look.colour_texture)
            metal = own.number(look.metallic, look.metallic_texture)[:, None]
            base = np.array(look.specular_rgb, np.float32) if look.specular_rgb else np.float32(_SHINE)
            coat = own.number(look.clearcoat, look.clearcoat_texture)
            rough = own.number(look.roughness, look.roughness_texture)
            diffuse[rows] = colour * (1 - metal)
            shine[rows] = base * (1 - metal) + colour * metal
            glow[rows] = own.colour(look.emissive_rgb, look.emissive_texture)
            roughness[rows] = rough + (look.clearcoat_roughness - rough) * coat
            if look.normal_texture and is_fine:
                normals[rows] = own.bent(normals[rows])
        facing = _facing(unit(normals), directions)
        return Shades(diffuse, shine, glow, np.maximum(roughness, _LEAST_ROUGHNESS), facing)

    def flat_normals(self, hits: Hits, directions: NDArray[Any]) -> Floats:
        """Return the normals of the triangles that are hit, towards the side of the rays; float32, shape (n, 3)."""
        return _facing(self._flat[hits.triangle], directions)

    def smooth_normals(self, hits: Hits, directions: NDArray[Any]) -> Floats:
        """Interpolate the normals of vertices, without normal maps, towards the side of the rays; shape (n, 3)."""
        return _facing(unit(self.blended(self.scene.normals, hits)), directions)

    @cached_property
    def corners_m(self) -> Floats:
        """Return the corners of all triangles; float32, shape (triangles, 3, 3)."""
        return self.scene.vertices_m.astype(np.float32)[self.scene.triangles]

    @cached_property
    def _surfaces(self) -> NDArray[np.integer[Any]]:
        return self.scene.surface.astype(np.uint16 if len(self.scene.surfaces) < 1 << 16 else np.int32)

    @cached_property
    def _flat(self) -> Floats:
        first, second, third = self.corners_m.transpose(1, 0, 2)
        return unit(np.cross(second - first, third - first))

    def blended(self, values: NDArray[np.float32], hits: Hits) -> Floats:
        """Interpolate values of the scene's vertices at hits, between those of their corners."""
        first, second, third = (values[self.scene.triangles[hits.triangle, corner]] for corner in range(3))
        shape = (len(hits.triangle),) + (1,) * (values.ndim - 1)
        one, other = (hits.weights[:, number].reshape(shape) for number in range(2))
        blended: Floats = first + (second - first) * one + (third - first) * other
        return blended

    def _first(self, tree: "EmbreeScene", part: int, origins: Floats, ways: Floats) -> Hits:
        """Find the first hits on the solid part or the other one."""
        found = tree.run(origins, ways, output=True)
        ray = np.flatnonzero(found["primID"] >= 0)
        # Embree's u and v belong to the second and third corner
        weights = np.stack([found["u"][ray], found["v"][ray]], axis=1)
        return Hits(ray, self._numbers[part][found["primID"][ray]], weights, found["tfar"][ray])

    def _opacity(self, sheet: Hits) -> Floats:
        """Return the opacity of hits on veils; float32, shape (n,)."""
        opacity = np.ones(len(sheet.triangle), np.float32)
        surface = self.scene.surface[sheet.triangle]
        for number in np.unique(surface).tolist():
            rows, look = np.flatnonzero(surface == number), self.scene.surfaces[number]
            own = _Rows(self, look, sheet.of(rows), np.zeros(len(rows), np.float32)).number(
                look.opacity, look.opacity_texture
            )
            opacity[rows] = np.where(own > look.opacity_threshold, 1, 0) if look.opacity_threshold else own
        return opacity

    @cached_property
    def _numbers(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the numbers of the triangles that are solid, and of those that textures make opaque in part."""
        veiled: NDArray[np.bool_]
        veiled = np.array([bool(look.opacity_texture) for look in self.scene.surfaces])[self.scene.surface]
        return np.flatnonzero(~veiled), np.flatnonzero(veiled)

    @cached_property
    def _solid(self) -> "EmbreeScene":
        return embree_scene(self.corners_m[self._numbers[0]])

    @cached_property
    def _veils(self) -> "EmbreeScene":
        return embree_scene(self.corners_m[self._numbers[1]])

    @cached_property
    def _pyramids(self) -> dict[Texture, list[Floats]]:
        return {}

    def pyramid(self, texture: Texture) -> list[Floats]:
        """Return a texture in ever smaller sizes, last row first; float32, shape (rows, columns, 1 or 3) each."""
        if texture not in self._pyramids:
            channels = range(3) if texture.channel < 0 else (0,)
            planes = [self.scene.pictures.plane(texture.band(channel)) for channel in channels]
            sizes = [np.stack(planes, axis=2).astype(np.float32)[::-1]]
            while min(sizes[-1].shape[:2]) > 1:
                rows, columns = (length // 2 * 2 for length in sizes[-1].shape[:2])
                whole = sizes[-1][:rows, :columns]
                sizes.append((whole[::2, ::2] + whole[1::2, ::2] + whole[::2, 1::2] + whole[1::2, 1::2]) / 4)
            self._pyramids[texture] = sizes
        return self._pyramids[texture]


class _Rows:
    """Hits on one surface, whose textures are looked up."""

    def __init__(self, lit: LitScene, look: SurfaceLook, hits: Hits, footprint_m: Floats) -> None:
        self._lit, self._look, self._hits, self._footprint_m = lit, look, hits, footprint_m

    def colour(self, value: tuple[float, float, float], texture: Texture | None) -> Floats:
        """Return a colour at each hit; float32, shape (n, 3)."""
        if texture is None:
            return np.broadcast_to(np.array(value, np.float32), (len(self._hits.triangle), 3))
        return np.broadcast_to(self._sampled(texture), (len(self._hits.triangle), 3))

    def number(self, value: float, texture: Texture | None) -> Floats:
        """Return a number at each hit; float32, shape (n,)."""
        if texture is None:
            return np.full(len(self._hits.triangle), value, np.float32)
        return self._sampled(texture)[:, 0]

    def bent(self, normals: Floats) -> Floats:
        """Bend normals by the normal map, whose axes are those of the texture coordinates; float32, shape (n, 3)."""
        texture = self._look.normal_texture
        if texture is None:
            return normals
        bent = self._sampled(texture)
        (edge, other), (turn, turned) = self._edges
        sign = np.sign(turn[:, :1] * turned[:, 1:] - turned[:, :1] * turn[:, 1:])  # -1 where the texture is mirrored
        right = unit((edge * turned[:, 1:] - other * turn[:, 1:]) * sign)
        up = unit((other * turn[:, :1] - edge * turned[:, :1]) * sign)
        return np.asarray(right * bent[:, :1] + up * bent[:, 1:2] + normals * bent[:, 2:], dtype=np.float32)

    @cached_property
    def _edges(self) -> tuple[tuple[Floats, Floats], tuple[Floats, Floats]]:
        """Return both edges from the first corner of each triangle, in space and on the surface's first texture."""
        scene, triangles = self._lit.scene, self._lit.scene.triangles[self._hits.triangle]
        places = self._lit.corners_m[self._hits.triangle]
        textures = (self._look.normal_texture, self._look.colour_texture, self._look.roughness_texture)
        texture = next((each for each in textures if each), None)
        flat = scene.coordinates[triangles].reshape(-1, *scene.coordinates.shape[1:])
        on = (flat[:, 0] if texture is None else self._look.placed_on(texture, flat)).reshape(-1, 3, 2)
        return (places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]), (on[:, 1] - on[:, 0], on[:, 2] - on[:, 0])

    @cached_property
    def _span(self) -> Floats:
        """Return the length in texture coordinates of the pixels that see the hits; float32, shape (n,)."""
        (edge, other), (turn, turned) = self._edges
        normal = np.cross(edge, other)
        area = np.sqrt(dots(normal, normal))
        flat = np.abs(turn[:, 0] * turned[:, 1] - turn[:, 1] * turned[:, 0])
        span: Floats = self._footprint_m * np.sqrt(flat / np.maximum(area, 1e-12))
        return span

    def _sampled(self, texture: Texture) -> Floats:
        """Look up values of a texture at the hits; float32, shape (n, 1 or 3)."""
        sizes = self._lit.pyramid(texture)
        if np.isinf(self._footprint_m).all():
            return np.broadcast_to(sizes[-1].mean(axis=(0, 1)), (len(self._footprint_m), sizes[-1].shape[2]))
        at = self._look.placed_on(texture, self._lit.blended(self._lit.scene.coordinates, self._hits))
        if not self._footprint_m.any():
            return _bilinear(sizes[0], at)
        rows, columns = sizes[0].shape[:2]
        fine = np.log2(np.maximum(self._span * (_SHARPER * math.sqrt(rows * columns)), 1.0)).astype(np.int64)
        levels = np.minimum(fine, len(sizes) - 1)
        found = np.empty((len(at), sizes[0].shape[2]), np.float32)
        for level in range(levels.min(), levels.max() + 1):
            own = np.flatnonzero(levels == level)
            if len(own):
                found[own] = _bilinear(sizes[level], at[own])
        return found


def _facing(normals: Floats, directions: NDArray[Any]) -> Floats:
    """Turn normals towards the side that rays come from, in place."""
    normals[dots(normals, directions) > 0] *= -1
    return normals


def _bilinear(picture: Floats, at: Floats) -> Floats:
    """Sample a repeated picture whose first row is the lowest, between the middles of its pixels."""
    rows, columns, channels = picture.shape
    flat = picture.reshape(-1, channels)
    across, up = at[:, 0] * columns - np.float32(0.5), at[:, 1] * rows - np.float32(0.5)
    left, low = np.floor(across), np.floor(up)
    right_share, high_share = (across - left)[:, None], (up - low)[:, None]
    left, low = left.astype(np.int64), low.astype(np.int64)
    low_row, high_row = low % rows * columns, (low + 1) % rows * columns
    left, right = left % columns, (left + 1) % columns
    lower = flat[low_row + left] * (1 - right_share) + flat[low_row + right] * right_share
    upper = flat[high_row + left] * (1 - right_share) + flat[high_row + right] * right_share
    found: Floats = lower * (1 - high_share) + upper * high_share
    return found
