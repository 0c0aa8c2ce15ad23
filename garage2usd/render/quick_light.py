"""Light of pictures by few rays: direct light, one reflected and one scattered ray a pixel, smoothed on each surface.

Direct light is that of a few lamps of each pixel, drawn by how brightly they shine there. A ray that is scattered at
random brings what walls, ceiling and cars throw back, a reflected one what shines in floors and paint, by their
microfacets. Each is smoothed on its surface, without the textures of what is lit.
"""

import math
from collections.abc import Collection, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.render.lamps import FACE_TRIANGLES, LampDraws, Lamps
from garage2usd.render.lit_scene import Floats, Hits, LitScene, Shades, dots, embree_scene, stopped
from garage2usd.render.microfacets import LEAST_COSINE, Facets, facet_normals, reflected, scattered
from garage2usd.render.pictures import Surfaces
from garage2usd.render.pixel_rays import PixelRays
from garage2usd.render.smoothing import Smoothing
from garage2usd.sensors.rays.lenses import Lens

if TYPE_CHECKING:
    from embreex.rtcore_scene import EmbreeScene

_OFF_M = 1e-3
"""How far before surfaces rays start and end that meet nothing else."""
_BLOCK_PX = 10
"""Side of the squares of pixels for which odds of lamps are computed."""
_NEAR_STEPS, _FARTHER_STEPS = (1, 2), (4, 8)
"""Pixels between those of which means are taken, of all light and of scattered light before."""
_FURTHER = 1.2
"""Light that is thrown back more than once, as a share of what the picture throws back."""
_BRIGHTEST = 6.0
"""Greatest radiance that a single ray brings, in means of the picture: brighter ones would be specks."""
_LEAST_M2 = 1e-4
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
    sheets: Sequence[tuple[Hits, Floats]]
    shades: Shades


class _Coloured(NamedTuple):
    """How pixels reflect light; see `Shades`."""

    diffuse_rgb: Floats
    shine_rgb: Floats
    glow_rgb: Floats
    roughness: Floats


class _Light(NamedTuple):
    """Irradiance by lamps and by what scatters their light, and mirrored radiance; float32, shape (n, 3) each."""

    direct: Floats
    scattered: Floats
    mirrored: Floats


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
        rays = PixelRays(lens, sensor_to_world, unseen)
        hits = self._lit.hits(rays.origins[rays.pixels], rays.ways[rays.pixels], unseen)
        pixel = rays.pixels[hits.ray]
        ways = rays.ways[pixel]
        flat = self._lit.flat_normals(hits, ways)
        shades = self._shades(hits, ways, rays.angle[pixel], flat)
        sheets = list(self._sheets(rays, rays.ways[rays.pixels], hits))
        seen = _Seen(pixel, rays.origins[pixel] + ways * hits.range_m[:, None], ways, flat, hits, sheets, shades)
        own = self._coloured(rays, seen, random)
        shape = rows, columns
        smooth = Smoothing(shape, pixel, seen.place_m, flat)
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
        return picture.reshape(rows, columns, 3), self._surfaces(shape, rays, seen)

    def _shades(self, hits: Hits, ways: Floats, angle: Floats, flat: Floats) -> Shades:
        cosine = np.maximum(np.abs(dots(flat, ways)), 0.05)
        return self._lit.shades(hits, ways, hits.range_m * angle / np.sqrt(cosine))

    def _coloured(self, rays: PixelRays, seen: _Seen, random: np.random.Generator) -> _Coloured:
        """Find how the pixels that see something reflect, as means over each, with what veils them."""
        sums = np.zeros((len(rays.angle), 11), np.float32)
        for turn in range(self._samples):
            ways = rays.within(random) if turn else rays.ways[rays.pixels]
            hits = self._lit.hits(rays.origins[rays.pixels], ways, rays.unseen) if turn else seen.hits
            left = np.zeros(len(ways), np.float32)
            left[hits.ray] = 1
            for sheet, opacity in self._sheets(rays, ways, hits) if turn else seen.sheets:
                share = (opacity * left[sheet.ray])[:, None]
                sums[rays.pixels[sheet.ray]] += _row_of(self._seen_by(rays, sheet, ways)) * share
                left[sheet.ray] *= 1 - opacity
            shades = self._seen_by(rays, hits, ways) if turn else seen.shades
            row, through = _row_of(shades), left[hits.ray, None]
            row[:, :3] *= through  # light comes through what veils a surface, and leaves through it
            sums[rays.pixels[hits.ray]] += row * through
        means = sums[seen.pixel, :10] / sums[seen.pixel, 10:]
        return _Coloured(means[:, :3], means[:, 3:6], means[:, 6:9], means[:, 9])

    def _sheets(self, rays: PixelRays, ways: Floats, hits: Hits) -> Iterator[tuple[Hits, Floats]]:
        """Yield what veils the hits of rays from the origins of pixels, as `LitScene.veils` does."""
        range_m = np.full(len(ways), np.inf, np.float32)
        range_m[hits.ray] = hits.range_m
        return self._lit.veils(rays.origins[rays.pixels], ways, range_m)

    def _seen_by(self, rays: PixelRays, hits: Hits, ways: Floats) -> Shades:
        own = ways[hits.ray]
        return self._shades(hits, own, rays.angle[rays.pixels[hits.ray]], self._lit.flat_normals(hits, own))

    def _lit_by(self, seen: _Seen, roughness: Floats, shape: tuple[int, int], random: np.random.Generator) -> _Light:
        """Compute the light of each pixel that sees something, before it is smoothed."""
        row, column = np.divmod(seen.pixel, shape[1])
        block = row // _BLOCK_PX * (shape[1] // _BLOCK_PX + 1) + column // _BLOCK_PX
        places = seen.place_m + seen.flat * np.float32(_OFF_M)
        normal = seen.shades.normal
        draws = LampDraws(self._lamps, block, places, reflected(seen.way, normal), roughness, self._samples)
        facets = Facets(seen.way, normal, roughness)
        direct, glare = self._direct(draws, places, normal, random, facets)
        thrown_back = seen.shades.diffuse_rgb * direct
        usual = thrown_back.mean(axis=0) if len(direct) else np.zeros(3, np.float32)
        around = self._incoming(places, scattered(normal, random), usual, random)
        shown = np.where(roughness[:, None] < _GLOSSY, 0, around) + glare
        shown += self._mirrored(draws, seen, facets, usual, random)
        return _Light(direct, around * np.float32(math.pi), shown)

    def _direct(
        self,
        draws: LampDraws,
        places: Floats,
        normals: Floats,
        random: np.random.Generator,
        facets: Facets | None = None,
    ) -> tuple[Floats, Floats]:
        """Compute the irradiance by lamps, and the radiance that facets mirror if every angle mirrored all of it."""
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
                glare[rows] += shone[rows] * (mirrored * share / np.maximum(cosine[rows], LEAST_COSINE))[:, None]
        return total / draws.count, glare / draws.count

    def _density(self, lamp: NDArray[np.int64], way: Floats, range_m: Floats) -> Floats:
        """Return how dense points of lamps' faces are by the solid angle, 1 / sr."""
        facing = np.maximum(np.abs(dots(self._lamps.axis[lamp], way)), LEAST_COSINE)
        density: Floats = range_m**2 / (np.maximum(self._lamps.area_m2[lamp], _LEAST_M2) * facing)
        return density

    def _incoming(self, places: Floats, ways: Floats, usual: Floats, random: np.random.Generator) -> Floats:
        """Compute the radiance along rays from places, of what is no lamp; float32, shape (n, 3)."""
        found = np.broadcast_to(self._lamps.sky_rgb, (len(places), 3)).copy()
        hits = self._lit.hits(places, ways)
        own = ways[hits.ray]
        shades = self._lit.shades(hits, own, np.full(len(own), np.inf, np.float32))
        flat = self._lit.flat_normals(hits, own)
        there = places[hits.ray] + own * hits.range_m[:, None]
        cells = np.floor(there / np.float32(_CELL_M)).astype(np.int64) @ np.array([1, 1 << 20, 1 << 40])
        there += flat * np.float32(_OFF_M)
        draws = LampDraws(self._lamps, cells, there, flat, np.ones(len(flat), np.float32), 1)
        direct, _ = self._direct(draws, there, flat, random)
        light = direct + usual * np.float32(_FURTHER)
        reflects = shades.diffuse_rgb + shades.shine_rgb
        found[hits.ray] = reflects * light / np.float32(math.pi) + shades.glow_rgb
        return np.minimum(found, max(usual.mean(), found.mean()) * np.float32(_BRIGHTEST)) if len(found) else found

    def _mirrored(
        self, draws: LampDraws, seen: _Seen, facets: Facets, usual: Floats, random: np.random.Generator
    ) -> Floats:
        """Compute the radiance that surfaces mirror, by one ray of each that is not rough; float32, shape (n, 3)."""
        found = np.zeros((len(seen.pixel), 3), np.float32)
        rows = np.flatnonzero(facets.roughness < _GLOSSY)
        normals = facet_normals(seen.shades.normal[rows], facets.roughness[rows], random)
        way = reflected(seen.way[rows], normals)
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
        density, _ = facets.towards(way[lit], own)
        of_lamp = self._density(lamp, way[lit], range_m)
        other = draws.odds_of(own, lamp) * of_lamp * draws.count
        shone = self._lamps.intensity(lamp, -way[lit]) / range_m[:, None] ** 2
        radiance = shone * of_lamp[:, None]  # that is over the solid angle
        found[own] = radiance * (density / (density + other))[:, None]
        return found

    @cached_property
    def _faces(self) -> "EmbreeScene":
        return embree_scene(self._lamps.faces_m)

    def _surfaces(self, shape: tuple[int, int], rays: PixelRays, seen: _Seen) -> Surfaces:
        ways = rays.ways[rays.pixels]
        shown = stopped(seen.hits, seen.sheets, len(ways))
        pixel = rays.pixels[shown.ray]
        depth = np.full(shape, np.inf, np.float32)
        normal, instance = np.zeros((*shape, 3), np.float32), np.zeros(shape, np.int32)
        depth.ravel()[pixel] = shown.range_m
        normal.reshape(-1, 3)[pixel] = self._lit.smooth_normals(shown, ways[shown.ray])
        instance.ravel()[pixel] = self._lit.scene.instance[shown.triangle]
        return Surfaces(depth, normal, instance)


def _row_of(shades: Shades) -> Floats:
    """Make a row for each place, whose last number counts the places."""
    ones = np.ones((len(shades.roughness), 1), np.float32)
    columns = (shades.diffuse_rgb, shades.shine_rgb, shades.glow_rgb, shades.roughness[:, None], ones)
    return np.concatenate(columns, axis=1)
