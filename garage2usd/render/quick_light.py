"""Light of pictures by few rays: direct light, one reflected and one scattered ray a pixel, smoothed on each surface.

Direct light is that of a few lamps of each pixel, drawn by how brightly they shine there. A ray that is scattered at
random brings what walls, ceiling and cars throw back, a reflected one what shines in floors and paint, by the
microfacets of Walter et al. (2007). Each is smoothed by the edge-avoiding wavelets of Dammertz et al. (2010), without
the textures of what is lit.
"""
# Over 300 lines: each part of the light of a pixel, and how it is smoothed.

import math
from collections.abc import Collection, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.render.lamps import FACE_TRIANGLES, Lamps
from garage2usd.render.lit_scene import Floats, Hits, LitScene, Shades, dots, embree_scene
from garage2usd.render.pictures import Surfaces
from garage2usd.scenes.meshes import unit
from garage2usd.sensors.rays.lenses import Lens

if TYPE_CHECKING:
    from embreex.rtcore_scene import EmbreeScene

_OFF_M = 1e-3
"""How far before surfaces rays start and end that meet nothing else."""
_BLOCK_PX = 10
"""Side of the squares of pixels for which odds of lamps are computed."""
_NEAR_STEPS, _FARTHER_STEPS = (1, 2), (4, 8)
"""Pixels between those of which means are taken, of all light and of scattered light before."""
_KERNEL = np.array([1, 4, 6, 4, 1], dtype=np.float32) / 16
_SAME_PLANE_M, _SAME_NORMAL = 0.02, 0.95
_FURTHER = 0.8
"""Light that is thrown back more than once, as a share of what the picture throws back."""
_BRIGHTEST = 6.0
"""Greatest radiance that a single ray brings, in means of the picture: brighter ones would be specks."""
_STEEP, _LEAST_COSINE, _LEAST_M2 = 0.9, 0.02, 1e-4
_LEAST_LOBE = 0.3
"""Roughness for which lamps are drawn on surfaces that are less rough: a block sees them in more than one direction."""
_CELL_M = 2.0
"""Side of the cubes for which odds of lamps are computed where rays end."""
_SHARP, _DULL = 0.1, 0.35
"""Roughness from which on reflections are smoothed farther, and of those that are smoothed wholly."""
_GLOSSY = 0.6
"""Rougher surfaces mirror what they scatter."""


class _Seen(NamedTuple):
    """What the pixels of a picture see through their middles."""

    pixel: NDArray[np.int64]
    place_m: Floats
    way: Floats
    flat: Floats
    hits: Hits
    shades: Shades


class _Coloured(NamedTuple):
    """How pixels reflect light; see `Shades`."""

    diffuse_rgb: Floats
    shine_rgb: Floats
    glow_rgb: Floats
    roughness: Floats


class QuickLight:
    """Pictures of a stage's surfaces under its lamps.

    Parameters
    ----------
    lit, lamps
        The surfaces, and the lamps in the same axes.
    samples
        How many rays go through each pixel, at which colours are looked up, and how many lamps shine there.
    """

    def __init__(self, lit: LitScene, lamps: Lamps, samples: int) -> None:
        self._lit, self._lamps, self._samples = lit, lamps, samples

    def taken(
        self,
        lens: Lens,
        sensor_to_world: NDArray[np.float64],
        random: np.random.Generator,
        unseen: Collection[int] = (),
    ) -> tuple[Floats, Surfaces]:
        """Take a picture.

        Parameters
        ----------
        lens, sensor_to_world
            The lens, and the pose of its camera (OpenCV's axes), shape (4, 4).
        random
            What is drawn from.
        unseen
            Ids of the objects that the picture looks through, though light does not.

        Returns
        -------
        tuple
            Linear light of red, green and blue, float32, shape (rows, columns, 3), black where the lens sees nothing;
            and the surfaces that are seen through the middles of the pixels, with their distance along the rays.
        """
        columns, rows = lens.size_px
        rays = _PixelRays(lens, sensor_to_world, unseen)
        hits = self._lit.hits(rays.origins[rays.pixels], rays.ways[rays.pixels], unseen)
        pixel = rays.pixels[hits.ray]
        ways = rays.ways[pixel]
        flat = self._lit.flat_normals(hits, ways)
        shades = self._shades(hits, ways, rays.angle[pixel], flat)
        seen = _Seen(pixel, rays.origins[pixel] + ways * hits.range_m[:, None], ways, flat, hits, shades)
        own = self._coloured(rays, seen, random)
        shape = rows, columns
        smooth = _Smoothing(shape, seen)
        lit = self._lit_by(seen, own.roughness, shape, random)
        light = smooth(smooth(lit.scattered, _FARTHER_STEPS) + lit.direct, _NEAR_STEPS)
        sharp = smooth(lit.mirrored, _NEAR_STEPS[:1])
        share = np.clip((own.roughness[:, None] - _SHARP) / (_DULL - _SHARP), 0, 1)
        reflected = sharp + (smooth(sharp, _FARTHER_STEPS[:1]) - sharp) * share
        facing = np.abs(dots(seen.shades.normal, seen.way))[:, None]
        most = np.maximum(1 - own.roughness[:, None], own.shine_rgb)
        mirrored = own.shine_rgb + (most - own.shine_rgb) * (1 - facing) ** 5
        value = own.diffuse_rgb * (1 - mirrored) * light / np.float32(math.pi) + mirrored * reflected + own.glow_rgb
        picture = np.zeros((rows * columns, 3), np.float32)
        picture[rays.pixels] = self._lamps.sky_rgb
        picture[pixel] = value
        return picture.reshape(rows, columns, 3), self._surfaces(shape, rays, hits)

    def _shades(self, hits: Hits, ways: Floats, angle: Floats, flat: Floats) -> Shades:
        cosine = np.maximum(np.abs(dots(flat, ways)), 0.05)
        return self._lit.shades(hits, ways, hits.range_m * angle / np.sqrt(cosine))

    def _coloured(self, rays: "_PixelRays", seen: _Seen, random: np.random.Generator) -> _Coloured:
        """How the pixels that see something reflect, as means over each, with what veils them."""
        sums = np.zeros((len(rays.angle), 11), np.float32)
        origins = rays.origins[rays.pixels]
        for turn in range(self._samples):
            ways = rays.within(random) if turn else rays.ways[rays.pixels]
            hits = self._lit.hits(origins, ways, rays.unseen) if turn else seen.hits
            range_m, left = np.full(len(ways), np.inf, np.float32), np.zeros(len(ways), np.float32)
            range_m[hits.ray], left[hits.ray] = hits.range_m, 1
            for sheet, opacity in self._lit.veils(origins, ways, range_m):
                share = (opacity * left[sheet.ray])[:, None]
                sums[rays.pixels[sheet.ray]] += _row_of(self._seen_by(rays, sheet, ways)) * share
                left[sheet.ray] *= 1 - opacity
            shades = self._seen_by(rays, hits, ways) if turn else seen.shades
            sums[rays.pixels[hits.ray]] += _row_of(shades) * left[hits.ray, None]
        means = sums[seen.pixel, :10] / sums[seen.pixel, 10:]
        return _Coloured(means[:, :3], means[:, 3:6], means[:, 6:9], means[:, 9])

    def _seen_by(self, rays: "_PixelRays", hits: Hits, ways: Floats) -> Shades:
        own = ways[hits.ray]
        return self._shades(hits, own, rays.angle[rays.pixels[hits.ray]], self._lit.flat_normals(hits, own))

    def _lit_by(self, seen: _Seen, roughness: Floats, shape: tuple[int, int], random: np.random.Generator) -> "_Light":
        """The light of each pixel that sees something, before it is smoothed."""
        row, column = np.divmod(seen.pixel, shape[1])
        block = row // _BLOCK_PX * (shape[1] // _BLOCK_PX + 1) + column // _BLOCK_PX
        places = seen.place_m + seen.flat * np.float32(_OFF_M)
        normal = seen.shades.normal
        mirrored = seen.way - 2 * dots(seen.way, normal)[:, None] * normal
        draws = _Draws(self._lamps, block, places, mirrored, roughness, self._samples)
        direct, glare = self._direct(draws, places, normal, random, _Facets(seen, roughness))
        thrown_back = seen.shades.diffuse_rgb * direct
        usual = thrown_back.mean(axis=0) if len(direct) else np.zeros(3, np.float32)
        scattered = self._incoming(places, _scattered(normal, random), usual, random)
        mirrored = np.where(roughness[:, None] < _GLOSSY, 0, scattered)
        mirrored += glare + self._reflected(draws, seen, roughness, usual, random)
        return _Light(direct, scattered * np.float32(math.pi), mirrored)

    def _direct(
        self,
        draws: "_Draws",
        places: Floats,
        normals: Floats,
        random: np.random.Generator,
        facets: "_Facets | None" = None,
    ) -> tuple[Floats, Floats]:
        """Irradiance by lamps, and the radiance that facets mirror if every angle mirrored all of it."""
        total, glare = np.zeros((len(places), 3), np.float32), np.zeros((len(places), 3), np.float32)
        for lamp, odds in draws.lamps(random):
            apart = self._lamps.points(lamp, random) - places
            range_m = np.sqrt(dots(apart, apart))
            way = apart / range_m[:, None]
            cosine = np.maximum(dots(normals, way), 0.0)
            shone = self._lamps.intensity(lamp, -way) * (cosine / (range_m**2 * odds))[:, None]
            rows = np.flatnonzero(shone.any(axis=1))
            rows = rows[~self._lit.is_dark(places[rows], way[rows], range_m[rows] - np.float32(2 * _OFF_M))]
            total[rows] += shone[rows]
            if facets is not None:
                density, mirrored = facets.towards(way[rows], rows)
                other = odds[rows] * self._density(lamp[rows], way[rows], range_m[rows]) * draws.count
                share = other / (other + np.where(facets.roughness[rows] < _GLOSSY, density, 0))
                glare[rows] += shone[rows] * (mirrored * share / np.maximum(cosine[rows], _LEAST_COSINE))[:, None]
        return total / draws.count, glare / draws.count

    def _density(self, lamp: NDArray[np.int64], way: Floats, range_m: Floats) -> Floats:
        """How dense points of lamps' faces are by the solid angle, 1 / sr."""
        facing = np.maximum(np.abs(dots(self._lamps.axis[lamp], way)), _LEAST_COSINE)
        density: Floats = range_m**2 / (np.maximum(self._lamps.area_m2[lamp], _LEAST_M2) * facing)
        return density

    def _incoming(self, places: Floats, ways: Floats, usual: Floats, random: np.random.Generator) -> Floats:
        """Radiance along rays from places, of what is no lamp; float32, shape (n, 3)."""
        found = np.broadcast_to(self._lamps.sky_rgb, (len(places), 3)).copy()
        hits = self._lit.hits(places, ways)
        own = ways[hits.ray]
        shades = self._lit.shades(hits, own, np.full(len(own), np.inf, np.float32))
        flat = self._lit.flat_normals(hits, own)
        there = places[hits.ray] + own * hits.range_m[:, None]
        cells = np.floor(there / np.float32(_CELL_M)).astype(np.int64) @ np.array([1, 1 << 20, 1 << 40])
        there += flat * np.float32(_OFF_M)
        draws = _Draws(self._lamps, cells, there, flat, np.ones(len(flat), np.float32), 1)
        direct, _ = self._direct(draws, there, flat, random)
        light = direct + usual * np.float32(_FURTHER)
        reflects = shades.diffuse_rgb + shades.shine_rgb
        found[hits.ray] = reflects * light / np.float32(math.pi) + shades.glow_rgb
        return np.minimum(found, max(usual.mean(), found.mean()) * np.float32(_BRIGHTEST)) if len(found) else found

    def _reflected(
        self, draws: "_Draws", seen: _Seen, roughness: Floats, usual: Floats, random: np.random.Generator
    ) -> Floats:
        """Radiance that surfaces mirror, by one ray of each that is not rough; float32, shape (n, 3)."""
        found = np.zeros((len(seen.pixel), 3), np.float32)
        rows = np.flatnonzero(roughness < _GLOSSY)
        normals = _microfacets(seen.shades.normal[rows], roughness[rows], random)
        way = seen.way[rows] - 2 * dots(seen.way[rows], normals)[:, None] * normals
        is_out = dots(way, seen.flat[rows]) > 0
        rows, way = rows[is_out], np.ascontiguousarray(way[is_out])
        places = seen.place_m[rows] + seen.flat[rows] * np.float32(_OFF_M)
        found[rows] = self._incoming(places, way, usual, random)
        if not len(self._lamps.middle_m) or not len(rows):
            return found
        faces = self._faces.run(places, way, output=True)
        lit = np.flatnonzero(faces["primID"] >= 0)
        lit = lit[~self._lit.is_dark(places[lit], way[lit], faces["tfar"][lit] - np.float32(2 * _OFF_M))]
        lamp, range_m, own = faces["primID"][lit].astype(np.int64) // FACE_TRIANGLES, faces["tfar"][lit], rows[lit]
        density, _ = _Facets(seen, roughness).towards(way[lit], own)
        other = draws.odds_of(own, lamp) * self._density(lamp, way[lit], range_m) * draws.count
        shone = self._lamps.intensity(lamp, -way[lit]) / range_m[:, None] ** 2  # over the solid angle: the radiance
        radiance = shone * self._density(lamp, way[lit], range_m)[:, None]
        found[own] = radiance * (density / (density + other))[:, None]
        return found

    @cached_property
    def _faces(self) -> "EmbreeScene":
        return embree_scene(self._lamps.faces_m)

    def _surfaces(self, shape: tuple[int, int], rays: "_PixelRays", hits: Hits) -> Surfaces:
        ways = rays.ways[rays.pixels]
        shown = self._lit.stopped(hits, rays.origins[rays.pixels], ways)
        pixel = rays.pixels[shown.ray]
        depth = np.full(shape, np.inf, np.float32)
        normal, instance = np.zeros((*shape, 3), np.float32), np.zeros(shape, np.int32)
        depth.ravel()[pixel] = shown.range_m
        normal.reshape(-1, 3)[pixel] = self._lit.smooth_normals(shown, ways[shown.ray])
        instance.ravel()[pixel] = self._lit.scene.instance[shown.triangle]
        return Surfaces(depth, normal, instance)


class _Light(NamedTuple):
    """Irradiance by lamps and by what scatters their light, and mirrored radiance; float32, shape (n, 3) each."""

    direct: Floats
    scattered: Floats
    mirrored: Floats


class _Draws:
    """Lamps drawn for places, by odds that are equal in each block of them."""

    def __init__(
        self,
        lamps: Lamps,
        block: NDArray[np.int64],
        places: Floats,
        mirrored: Floats,
        roughness: Floats,
        count: int,
    ) -> None:
        self.count = count
        self._number = len(lamps.middle_m) if len(places) else 0
        if self._number:
            _, self._block = np.unique(block, return_inverse=True)
            values = np.concatenate([places, mirrored, np.maximum(roughness, _LEAST_LOBE)[:, None] ** 4], axis=1)
            sums = np.stack([np.bincount(self._block, column) for column in values.T], axis=1)
            means = (sums / np.bincount(self._block)[:, None]).astype(np.float32)
            self._odds = lamps.odds(means[:, :3], unit(means[:, 3:6]), means[:, 6])

    def lamps(self, random: np.random.Generator) -> Iterator[tuple[NDArray[np.int64], Floats]]:
        """Yield a lamp for each place, and the odds of it."""
        if not self._number:
            return
        rising = np.cumsum(self._odds.astype(np.float64), axis=1)
        stairs = (rising / rising[:, -1:] + np.arange(len(rising))[:, None]).ravel()
        offset = random.random(len(self._block))
        for draw in range(self.count):
            step = np.searchsorted(stairs, self._block + (draw + offset) / self.count, side="right")
            lamp = np.minimum(step - self._block * self._number, self._number - 1)
            yield lamp, self._odds[self._block, lamp]

    def odds_of(self, places: NDArray[np.int64], lamp: NDArray[np.int64]) -> Floats:
        """Odds of lamps at some of the places, by their numbers."""
        found: Floats = self._odds[self._block[places], lamp]
        return found


class _Facets:
    """The microfacets of what pixels see: GGX, which hide one another as Smith has it (Walter et al., 2007)."""

    def __init__(self, seen: _Seen, roughness: Floats) -> None:
        self._seen, self.roughness = seen, roughness

    def towards(self, ways: Floats, rows: NDArray[np.int64]) -> tuple[Floats, Floats]:
        """How dense mirrored rays are along ways, 1 / sr, and what of a lamp's irradiance is mirrored, 1 / sr."""
        normal, back = self._seen.shades.normal[rows], -self._seen.way[rows]
        half = unit(ways + back)
        tilt = np.clip(dots(half, normal), 0.0, 1.0)
        alpha2 = self.roughness[rows] ** 4
        facets = alpha2 / (math.pi * ((alpha2 - 1) * tilt**2 + 1) ** 2)
        density = facets * tilt / (4 * np.maximum(dots(half, back), _LEAST_COSINE))
        facing, leaving = (np.maximum(dots(normal, each), _LEAST_COSINE) for each in (back, ways))
        shadows = leaving * np.sqrt(alpha2 + (1 - alpha2) * facing**2)
        masks = facing * np.sqrt(alpha2 + (1 - alpha2) * leaving**2)
        mirrored = facets * leaving / (2 * (shadows + masks))
        return density, mirrored


class _PixelRays:
    """The rays of a picture's pixels.

    Attributes
    ----------
    origins, ways
        Of the middle of each pixel, in the world; float32, shape (pixels, 3).
    pixels
        Numbers of the pixels that have a ray.
    angle
        Between the rays of neighbouring pixels; float32, shape (pixels,).
    unseen
        Ids of the objects that they pass through.
    """

    def __init__(self, lens: Lens, to_world: NDArray[np.float64], unseen: Collection[int]) -> None:
        self.unseen = unseen
        places_px, (columns, rows) = lens.middles(), lens.size_px
        ways = lens.rays(places_px) @ to_world[:3, :3].T
        self.origins = (lens.starts(places_px) @ to_world[:3, :3].T + to_world[:3, 3]).astype(np.float32)
        self.ways = ways.astype(np.float32)
        self.pixels = np.flatnonzero(np.isfinite(ways).all(axis=1))
        grid = self.ways.reshape(rows, columns, 3)
        self._steps = [_step_along(grid, axis) for axis in (0, 1)]
        down, across = (np.linalg.norm(step, axis=1) for step in self._steps)
        self.angle = np.sqrt(down * across)

    def within(self, random: np.random.Generator) -> Floats:
        """Directions through points at random within the pixels that have a ray; float32, shape (n, 3)."""
        shares = random.random((2, len(self.pixels), 1), dtype=np.float32) - np.float32(0.5)
        ways = self.ways[self.pixels]
        for step, share in zip(self._steps, shares, strict=True):
            ways += step[self.pixels] * share
        ways /= np.sqrt(dots(ways, ways))[:, None]
        return ways


def _step_along(ways: Floats, axis: int) -> Floats:
    """How rays change to the next pixel along an axis: the smaller of the changes to both sides; shape (pixels, 3)."""
    step = np.diff(ways, axis=axis)
    nothing = np.full_like(np.take(ways, [0], axis=axis), np.nan)
    behind, ahead = np.concatenate([nothing, step], axis=axis), np.concatenate([step, nothing], axis=axis)
    sizes = [np.nan_to_num(np.linalg.norm(each, axis=2), nan=np.inf) for each in (behind, ahead)]
    smaller = np.where((sizes[0] < sizes[1])[..., None], behind, ahead)
    return np.nan_to_num(smaller.reshape(-1, 3), nan=0.0)


class _Smoothing:
    """Means over ever wider surroundings of each pixel in one plane with it."""

    def __init__(self, shape: tuple[int, int], seen: _Seen) -> None:
        self._shape, self._pixel = shape, seen.pixel
        self._normal = np.zeros((*shape, 3), np.float32)
        self._normal.reshape(-1, 3)[seen.pixel] = seen.flat
        self._place = np.full((*shape, 3), 1e6, np.float32)
        self._place.reshape(-1, 3)[seen.pixel] = seen.place_m
        self._known: dict[tuple[int, int], tuple[list[tuple[int, Floats]], Floats]] = {}

    def __call__(self, values: Floats, steps: Sequence[int]) -> Floats:
        """Values of the pixels that see something, shape (n, 3), smoothed over pixels so far apart."""
        rows, columns = self._shape
        picture = np.zeros((rows, columns, 3), np.float32)
        picture.reshape(-1, 3)[self._pixel] = values
        for step in steps:
            for axis in (0, 1):
                picture = self._along(picture, axis, step)
        found: Floats = picture.reshape(-1, 3)[self._pixel]
        return found

    def _along(self, picture: Floats, axis: int, step: int) -> Floats:
        total = picture * _KERNEL[2]
        shares, whole = self._shares(axis, step)
        for shift, own in shares:
            total[_part(axis, shift)] += picture[_part(axis, -shift)] * own
        smoothed: Floats = total / whole
        return smoothed

    def _shares(self, axis: int, step: int) -> tuple[list[tuple[int, Floats]], Floats]:
        """What each neighbour along an axis counts, by how far it is away, and the sum of all."""
        if (axis, step) not in self._known:
            whole, shares = np.full((*self._shape, 1), _KERNEL[2], np.float32), []
            for shift in (-2 * step, -step, step, 2 * step):
                if abs(shift) >= self._shape[axis]:
                    continue
                here, there = _part(axis, shift), _part(axis, -shift)
                apart = np.einsum("ijk,ijk->ij", self._place[there] - self._place[here], self._normal[here])
                alike = np.einsum("ijk,ijk->ij", self._normal[here], self._normal[there])
                is_same = (np.abs(apart) < _SAME_PLANE_M) & (alike > _SAME_NORMAL)
                own = (_KERNEL[2 + shift // step] * is_same)[..., None].astype(np.float32)
                whole[here] += own
                shares.append((shift, own))
            self._known[axis, step] = shares, whole
        return self._known[axis, step]


def _part(axis: int, shift: int) -> tuple[slice, slice]:
    """The pixels of a picture that have a neighbour so far before them, or behind them if the shift is negative."""
    own = slice(shift, None) if shift > 0 else slice(None, shift)
    return (own, slice(None)) if axis == 0 else (slice(None), own)


def _row_of(shades: Shades) -> Floats:
    """A row for each place, whose last number counts the places."""
    ones = np.ones((len(shades.roughness), 1), np.float32)
    columns = (shades.diffuse_rgb, shades.shine_rgb, shades.glow_rgb, shades.roughness[:, None], ones)
    return np.concatenate(columns, axis=1)


def _scattered(normals: Floats, random: np.random.Generator) -> Floats:
    """Directions at random, by the cosine from normals; float32, shape (n, 3)."""
    height = random.random(len(normals), dtype=np.float32) * 2 - 1
    angle = random.random(len(normals), dtype=np.float32) * np.float32(2 * math.pi)
    ring = np.sqrt(1 - height**2)
    ways = normals * np.float32(1.0001) + np.stack([ring * np.cos(angle), height, ring * np.sin(angle)], axis=1)
    return np.ascontiguousarray(ways / np.sqrt(dots(ways, ways))[:, None], dtype=np.float32)


def _microfacets(normals: Floats, roughness: Floats, random: np.random.Generator) -> Floats:
    """Normals of microfacets by the distribution of GGX; float32, shape (n, 3)."""
    first, second = random.random((2, len(normals)), dtype=np.float32)
    slope = roughness**2 * np.sqrt(first / np.maximum(1 - first, 1e-6))
    angle = second * np.float32(2 * math.pi)
    is_steep = np.abs(normals[:, 1:2]) > _STEEP
    aside = np.where(is_steep, np.array([[1, 0, 0]], np.float32), np.array([[0, 1, 0]], np.float32))
    right = unit(np.cross(aside, normals))
    up = np.cross(normals, right)
    return unit(normals + right * (slope * np.cos(angle))[:, None] + up * (slope * np.sin(angle))[:, None])
