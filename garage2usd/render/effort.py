"""Time that pictures take, and the number of samples that two minutes allow."""

from collections.abc import Iterable

__all__ = ["default_samples", "drawing_s"]

_BUDGET_S, _BUDGET_CORES = 120.0, 2
_LEAST, _MOST = 2, 64
_SCENE_S = 11.0
"""Seconds in which one core reads the stage and Blender reads the scene."""
_SAMPLE_S, _FINISH_S, _DATA_S = 33.0, 40.0, 12.0
"""Seconds of a core for a million pixels: of one sample, of the denoiser, and of all pictures other than colour."""
_MILLION = 1e6


def default_samples(sizes_px: Iterable[tuple[int, int]]) -> int:
    """Return the number of samples with which two cores draw colour pictures of some sizes in two minutes.

    At least 2, which the denoiser makes smooth, though many pictures take longer; at most 64.
    """
    pixels = _pixels(sizes_px)
    left_s = (_BUDGET_S - _SCENE_S) * _BUDGET_CORES - (_FINISH_S + _DATA_S) * pixels / _MILLION
    return min(_MOST, max(_LEAST, int(left_s / (_SAMPLE_S * max(pixels, 1) / _MILLION))))


def drawing_s(
    colours_px: Iterable[tuple[int, int]], data_px: Iterable[tuple[int, int]], *, samples: int, cores: int
) -> float:
    """Estimate the seconds in which processors draw colour pictures and all others of some sizes."""
    colour, data = _pixels(colours_px), _pixels(data_px)
    work_s = (colour * (samples * _SAMPLE_S + _FINISH_S) + data * _DATA_S) / _MILLION
    return _SCENE_S + work_s / cores


def _pixels(sizes_px: Iterable[tuple[int, int]]) -> int:
    return sum(width * height for width, height in sizes_px)
