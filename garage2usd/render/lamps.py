"""Lamps of a stage as surfaces that shine, and light from points drawn on them."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.reading.lights import DOMES, LIGHT_TYPES, LightSource, light_of
from garage2usd.scenes.meshes import unit
from garage2usd.scenes.values import metres_per_unit
from garage2usd.scenes.walk import placed_objects

Floats = NDArray[np.float32]
_LEAST_LOBE = 0.3
"""Roughness for which lamps are drawn on surfaces that are less rough: a block sees them in more than one direction."""
_DISTANT_M, _TINY = 1e4, 1e-12
_DISTANT = "DistantLight"
_ALL_ROUND_DEG = 90.0
"""The cone of lamps that are not shaped: what they send sideways follows from their kind."""
FACE_TRIANGLES = 8
_LEAST_M2 = 0.5
"""Added to the square of distances where lamps are weighed against one another."""
_SHARED = 2e-4
"""Added to the odds of each lamp, so that all can be drawn."""


@dataclass(frozen=True, eq=False)
class Lamps:
    """The lamps of a stage.

    Attributes
    ----------
    middle_m, axis
        Middles, and unit vectors towards which they shine; float32, shape (n, 3).
    across_m, along_m
        Vectors from the middle to the ends of their faces; float32, shape (n, 3).
    candela_rgb
        Luminous intensity along the axis by colour; float32, shape (n, 3).
    is_round
        Whether a face is an ellipse, not a rectangle; bool, shape (n,).
    is_one_sided
        Whether it shines by the cosine from its axis and not backwards, unlike one that shines to all sides alike.
    least_cos
        Cosine of the greatest angle from the axis; float32, shape (n,).
    sky_rgb
        Radiance of the surroundings; float32, shape (3,).
    """

    middle_m: Floats
    axis: Floats
    across_m: Floats
    along_m: Floats
    candela_rgb: Floats
    is_round: NDArray[np.bool_]
    is_one_sided: NDArray[np.bool_]
    least_cos: Floats
    sky_rgb: Floats

    @cached_property
    def faces_m(self) -> Floats:
        """Return their faces as fans of triangles, each lamp's `FACE_TRIANGLES` in turn; float32, shape (n, 3, 3)."""
        turns = np.arange(FACE_TRIANGLES + 1) * 2 * math.pi / FACE_TRIANGLES
        ring = np.stack([np.cos(turns), np.sin(turns)], axis=1).astype(np.float32)
        square = ring / np.abs(ring).max(axis=1, keepdims=True)
        shape = np.where(self.is_round[:, None, None], ring, square)
        edge = shape[..., :1] * self.across_m[:, None] + shape[..., 1:] * self.along_m[:, None] + self.middle_m[:, None]
        middle = np.broadcast_to(self.middle_m[:, None], edge[:, 1:].shape)
        fans = np.stack([middle, edge[:, :-1], edge[:, 1:]], axis=2)
        return np.asarray(fans.reshape(-1, 3, 3), dtype=np.float32)

    @cached_property
    def area_m2(self) -> Floats:
        """Return the areas of their faces; float32, shape (n,)."""
        sides = np.sqrt((self.across_m**2).sum(axis=1) * (self.along_m**2).sum(axis=1))
        return np.asarray(np.where(self.is_round, math.pi, 4.0) * sides, dtype=np.float32)

    def odds(self, places_m: Floats, mirrored: Floats, facets: Floats) -> Floats:
        """Return the probabilities by which lamps are drawn, half by how they shine and half by how they are mirrored.

        Parameters
        ----------
        places_m
            float32, shape (n, 3).
        mirrored
            Where a mirror there would look, unit vectors; float32, shape (n, 3).
        facets
            The fourth power of the roughness; float32, shape (n,).

        Returns
        -------
        ndarray
            float32, shape (n, lamps).
        """
        apart = self.middle_m - places_m[:, None]
        square = np.einsum("nlk,nlk->nl", apart, apart)
        range_m = np.sqrt(square)
        cosine = np.maximum(-np.einsum("nlk,lk->nl", apart, self.axis), 0.0) / range_m
        facing = np.where(self.is_one_sided, cosine, 1.0)
        shines = self.candela_rgb.sum(axis=1) * facing / (square + _LEAST_M2)
        # the square of the cosine of half the angle between lamp and mirrored ray, by which microfacets are tilted
        tilt = (1 + np.einsum("nlk,nk->nl", apart, mirrored) / range_m) / 2
        glares = shines / ((facets[:, None] - 1) * tilt + 1) ** 2
        odds = sum(each / np.maximum(each.sum(axis=1, keepdims=True), _TINY) for each in (shines, glares)) + _SHARED
        return np.asarray(odds / odds.sum(axis=1, keepdims=True), dtype=np.float32)

    def points(self, lamps: NDArray[np.int64], random: np.random.Generator) -> Floats:
        """Draw a point on the face of each of some lamps; float32, shape (n, 3)."""
        first, second = random.random((2, len(lamps)), dtype=np.float32)
        radius, angle = np.sqrt(first), second * np.float32(2 * math.pi)
        is_round = self.is_round[lamps]
        across = np.where(is_round, radius * np.cos(angle), 2 * first - 1)
        along = np.where(is_round, radius * np.sin(angle), 2 * second - 1)
        aside = across[:, None] * self.across_m[lamps] + along[:, None] * self.along_m[lamps]
        found: Floats = self.middle_m[lamps] + aside.astype(np.float32)
        return found

    def intensity(self, lamps: NDArray[np.int64], away: Floats) -> Floats:
        """Return the intensity of some lamps along unit vectors away from them, by colour; float32, shape (n, 3)."""
        cosine = (away * self.axis[lamps]).sum(axis=1)
        share = np.where(self.is_one_sided[lamps], np.maximum(cosine, 0.0), 1.0) * (cosine >= self.least_cos[lamps])
        found: Floats = self.candela_rgb[lamps] * share[:, None].astype(np.float32)
        return found


class LampDraws:
    """Lamps drawn for places, by odds that are equal in each block of them.

    Parameters
    ----------
    lamps
        The lamps.
    block
        Number of each place's block; int64, shape (n,).
    places, mirrored, roughness
        Each place, the way of a ray that is mirrored there, and the roughness; float32, shapes (n, 3), (n, 3) and (n,).
    count
        How many lamps are drawn for each place.
    """

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
        """Return the odds of lamps at some of the places, by their numbers."""
        found: Floats = self._odds[self._block[places], lamp]
        return found


def read_lamps(stage: Usd.Stage) -> Lamps:
    """Read the lamps of a stage, in its axes and in metres."""
    metres = metres_per_unit(stage)
    sky_rgb, found = np.zeros(3), list[_Lamp]()
    for placed in placed_objects(stage, np.diag([metres, metres, metres, 1.0]), with_looks=False):
        for part in placed.parts:
            if part.prim.GetTypeName() in LIGHT_TYPES:
                matrix = part.matrix @ placed.matrix
                source = light_of(placed.twin_of(part), matrix, metres)
                if source.kind in DOMES:
                    sky_rgb += np.array(source.colour_rgb) * source.luminance_nit
                else:
                    found.append(_lamp(source, matrix))
    middle, axis, across, along, candela = (
        np.array([lamp[column] for lamp in found], dtype=np.float32).reshape(-1, 3) for column in range(5)
    )
    is_round, is_one_sided = (np.array([lamp[column] for lamp in found], dtype=np.bool_) for column in (5, 6))
    least_cos = np.array([lamp.least_cos for lamp in found], dtype=np.float32)
    sky = sky_rgb.astype(np.float32)
    return Lamps(middle, axis, across, along, candela, is_round, is_one_sided, least_cos, sky)


class _Lamp(NamedTuple):
    """A lamp, as `Lamps` has them."""

    middle_m: NDArray[np.float64]
    axis: NDArray[np.float64]
    across_m: NDArray[np.float64]
    along_m: NDArray[np.float64]
    candela_rgb: NDArray[np.float64]
    is_round: bool
    is_one_sided: bool
    least_cos: float


def _lamp(source: LightSource, matrix: NDArray[np.float64]) -> _Lamp:
    right, up, backwards = (row / max(float(np.linalg.norm(row)), _TINY) for row in matrix[:3, :3])
    middle, candela = matrix[3, :3], np.array(source.colour_rgb) * source.candela
    if source.kind == _DISTANT:
        middle, candela = backwards * _DISTANT_M, np.array(source.colour_rgb) * source.lux * _DISTANT_M**2
    is_shaped = source.cone_deg != _ALL_ROUND_DEG
    return _Lamp(
        middle,
        -backwards,
        right * source.width_m / 2,
        up * source.height_m / 2,
        candela,
        source.kind not in {"RectLight", "CylinderLight"},
        source.kind in {"RectLight", "DiskLight"},
        math.cos(math.radians(source.cone_deg)) if is_shaped else -1.0,
    )
