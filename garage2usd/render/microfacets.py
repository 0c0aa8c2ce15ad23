"""Microfacets, which mirror light, and directions in which it is scattered."""

import math

import numpy as np
from numpy.typing import NDArray

from garage2usd.render.lit_scene import Floats, dots
from garage2usd.scenes.meshes import unit

_STEEP = 0.9
LEAST_COSINE = 0.02
"""Of angles by which something is divided."""


class Facets:
    """Microfacets of surfaces: GGX, which hide one another as Smith has it (Walter et al., 2007).

    Parameters
    ----------
    ways, normals, roughness
        Of the rays that meet surfaces, and of these; float32, shapes (n, 3), (n, 3) and (n,).
    """

    def __init__(self, ways: Floats, normals: Floats, roughness: Floats) -> None:
        self._ways, self._normals, self.roughness = ways, normals, roughness

    def towards(self, ways: Floats, rows: NDArray[np.int64]) -> tuple[Floats, Floats]:
        """Return how dense mirrored rays are along ways, and what of a lamp's irradiance is mirrored; 1 / sr."""
        normal, back = self._normals[rows], -self._ways[rows]
        half = unit(ways + back)
        tilt = np.clip(dots(half, normal), 0.0, 1.0)
        alpha2 = self.roughness[rows] ** 4
        facets = alpha2 / (math.pi * ((alpha2 - 1) * tilt**2 + 1) ** 2)
        density = facets * tilt / (4 * np.maximum(dots(half, back), LEAST_COSINE))
        facing, leaving = (np.maximum(dots(normal, each), LEAST_COSINE) for each in (back, ways))
        shadows = leaving * np.sqrt(alpha2 + (1 - alpha2) * facing**2)
        masks = facing * np.sqrt(alpha2 + (1 - alpha2) * leaving**2)
        mirrored = facets * leaving / (2 * (shadows + masks))
        return density, mirrored


def reflected(ways: Floats, normals: Floats) -> Floats:
    """Return the directions of rays mirrored at normals; float32, shape (n, 3)."""
    return ways - 2 * dots(ways, normals)[:, None] * normals


def scattered(normals: Floats, random: np.random.Generator) -> Floats:
    """Draw directions at random, by the cosine from normals; float32, shape (n, 3)."""
    height = random.random(len(normals), dtype=np.float32) * 2 - 1
    angle = random.random(len(normals), dtype=np.float32) * np.float32(2 * math.pi)
    ring = np.sqrt(1 - height**2)
    ways = normals * np.float32(1.0001) + np.stack([ring * np.cos(angle), height, ring * np.sin(angle)], axis=1)
    return np.ascontiguousarray(ways / np.sqrt(dots(ways, ways))[:, None], dtype=np.float32)


def facet_normals(normals: Floats, roughness: Floats, random: np.random.Generator) -> Floats:
    """Draw normals of microfacets by the distribution of GGX; float32, shape (n, 3)."""
    first, second = random.random((2, len(normals)), dtype=np.float32)
    slope = roughness**2 * np.sqrt(first / np.maximum(1 - first, 1e-6))
    angle = second * np.float32(2 * math.pi)
    is_steep = np.abs(normals[:, 1:2]) > _STEEP
    aside = np.where(is_steep, np.array([[1, 0, 0]], np.float32), np.array([[0, 1, 0]], np.float32))
    right = unit(np.cross(aside, normals))
    up = np.cross(normals, right)
    return unit(normals + right * (slope * np.cos(angle))[:, None] + up * (slope * np.sin(angle))[:, None])
