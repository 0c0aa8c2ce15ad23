"""Strips changed at random as cameras and drives change them, so that a network learns from more than there are."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["changed"]

_FLIPPED_SHARE, _BLURRED_SHARE = 0.5, 0.5
_GAMMA_SD, _GAIN_SD, _CAST_SD, _OFFSET_SD = 0.35, 0.25, 0.06, 0.05
_MOST_NOISE = 0.03


def changed(
    pixels: NDArray[np.uint8], maps: NDArray[np.float32], random: np.random.Generator
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Pictures with other exposure, casts, noise and blur, some of them as if the car drove backwards.

    Parameters
    ----------
    pixels
        uint8, shape (n, rows, columns, 3).
    maps
        What is to be learnt of them, which is turned over with them; float32, shape (n, rows / k, columns / k).
    random
        What is drawn from.

    Returns
    -------
    tuple
        Pictures from about 0 to about 1, float32, and maps, of the same shapes.
    """
    count = len(pixels)
    each = (count, 1, 1, 1)
    x = pixels.astype(np.float32) / 255
    is_flipped = random.random(count) < _FLIPPED_SHARE
    x[is_flipped], maps = x[is_flipped, ::-1], np.where(is_flipped[:, None, None], maps[:, ::-1], maps)
    x **= np.exp(random.normal(0.0, _GAMMA_SD, each)).astype(np.float32)
    gain = np.exp(random.normal(0.0, _GAIN_SD, each)) * np.exp(random.normal(0.0, _CAST_SD, (count, 1, 1, 3)))
    x = x * gain.astype(np.float32) + random.normal(0.0, _OFFSET_SD, each).astype(np.float32)
    is_blurred = random.random(count) < _BLURRED_SHARE
    x[is_blurred] = _blurred(x[is_blurred])
    noise_sd = random.uniform(0.0, _MOST_NOISE, each).astype(np.float32)
    return x + random.standard_normal(x.shape, dtype=np.float32) * noise_sd, maps


def _blurred(x: NDArray[np.float32]) -> NDArray[np.float32]:
    """Each pixel with half of its neighbours in both directions."""
    for axis in (1, 2):
        x = (np.roll(x, -1, axis=axis) + 2 * x + np.roll(x, 1, axis=axis)) / 4
    return x
