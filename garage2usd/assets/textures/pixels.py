"""Conversion of fields to pixels: sRGB values, packed surfaces, normals."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from garage2usd.assets.fields import Field

Pixels = NDArray[np.uint8]
"""uint8, shape (rows, columns, 3), or 4 with alpha; (rows, columns) for wear masks."""
Bakers = dict[str, Callable[[np.random.Generator], Pixels]]
"""Generators of textures by file name."""

_ROUGHNESS_STEP = 5


def levels(value: Field) -> Pixels:
    """Quantise sRGB values to 8 bits."""
    rounded: Pixels = np.clip(np.rint(value), 0, 255).astype(np.uint8)
    return rounded


def shaded(value: Field, tint: tuple[float, float, float]) -> Pixels:
    """Tint a field of sRGB values 0 to 255."""
    return levels(np.clip(value, 0.0, 255.0)[:, :, None] * np.array(tint))


def mixed_over(base: Pixels, over: tuple[int, int, int], share: Field) -> Pixels:
    """Blend a colour over pixels by a share from 0 to 1."""
    mixed = base * (1.0 - share[:, :, None]) + np.array(over) * share[:, :, None]
    return levels(mixed)


def packed(occlusion: Field | float, roughness: Field, metallic: Field | float = 0.0) -> Pixels:
    """Pack occlusion, roughness and metallic, 0 to 1, into red, green and blue, with few levels."""
    channels = [np.broadcast_to(value, roughness.shape) for value in (occlusion, roughness, metallic)]
    return levels(np.rint(np.stack(channels, axis=2) * 255 / _ROUGHNESS_STEP) * _ROUGHNESS_STEP)


def normal_map(height: Field, strength: float) -> Pixels:
    """Tangent-space normal map of a height field, as (n + 1) / 2 in 8 bits."""
    dx = (np.roll(height, 1, axis=1) - np.roll(height, -1, axis=1)) * strength
    dy = (np.roll(height, -1, axis=0) - np.roll(height, 1, axis=0)) * strength
    length = np.sqrt(dx * dx + dy * dy + 1.0)
    normal = np.stack([dx / length, dy / length, 1.0 / length], axis=2)
    return levels((normal + 1.0) * 127.5)


def distance_to(shape: tuple[int, int], period: int, axis: int, start: int = 0) -> Field:
    """Distance in pixels from the nearest of parallel lines, one every `period` pixels along an axis."""
    place = (np.arange(shape[axis]) - start) % period
    away = np.minimum(place, period - place).astype(np.float64)
    return np.broadcast_to(away[:, None] if axis == 0 else away[None, :], shape)
