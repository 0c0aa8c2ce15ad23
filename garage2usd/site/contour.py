"""The contour: a union of random rectangles of squares."""

import numpy as np

from garage2usd.common.errors import GenerationError
from garage2usd.common.randomness import Step, generator
from garage2usd.config import SiteConfig
from garage2usd.structure.grid import Mask

__all__ = ["draw_contour"]

_ATTEMPTS = 2000
_MIN_SIDE_CELLS = 3
_MIN_OVERLAP_CELLS = 2


def draw_contour(site: SiteConfig, *, seed: int, attempt: int = 0) -> Mask:
    """Draw a random contour: the squares inside the garage.

    Parameters
    ----------
    site
        Its ``width_cells``, ``height_cells``, ``rectangles`` and ``min_fill``.
    seed, attempt
        Seed and number of the restart.

    Returns
    -------
    Mask
        bool, shape (height_cells, width_cells): the paper's zeta; 4-connected.

    Raises
    ------
    GenerationError
        If no union of rectangles covers ``min_fill`` of the squares.

    Notes
    -----
    Algorithm 1. Deviation: the paper requires that rectangles overlap, without saying which; requiring all pairs fails
    for almost every draw of many rectangles. A rectangle is accepted if it overlaps an accepted one by 2 x 2 squares,
    so that the union is connected and at least two squares wide. Deviation: sides are at least three squares, so that a
    portal has a lane and a stall behind it. Deviation: a union that covers less than ``min_fill`` of the squares is
    drawn again, as small ones hold few stalls.
    """
    height, width = site.shape
    if site.rectangles == 0:
        return np.ones((height, width), dtype=np.bool_)
    rng = generator(seed, Step.CONTOUR, attempt)
    best = 0.0
    for _ in range(_ATTEMPTS):
        inside = _union(rng, height=height, width=width, count=site.rectangles)
        fill = float(inside.mean())
        if fill >= site.min_fill:
            return inside
        best = max(best, fill)
    reason = f"{site.rectangles} rectangles covered at most {best:.2f} of the squares, min_fill is {site.min_fill}"
    raise GenerationError("contour", reason, seed=seed, attempts=_ATTEMPTS)


def _union(rng: np.random.Generator, *, height: int, width: int, count: int) -> Mask:
    inside = np.zeros((height, width), dtype=np.bool_)
    accepted: list[tuple[int, int, int, int]] = []
    for _ in range(_ATTEMPTS * count):
        top, bottom = _span(rng, height)
        left, right = _span(rng, width)
        overlaps = not accepted or any(
            min(bottom, b) - max(top, t) >= _MIN_OVERLAP_CELLS and min(right, r) - max(left, x) >= _MIN_OVERLAP_CELLS
            for t, b, x, r in accepted
        )
        if overlaps:
            accepted.append((top, bottom, left, right))
            inside[top:bottom, left:right] = True
            if len(accepted) == count:
                break
    return inside


def _span(rng: np.random.Generator, side: int) -> tuple[int, int]:
    """Draw a half-open range of squares, at least three long, from 0 to `side`."""
    while True:
        first, last = sorted(rng.integers(0, side, size=2).tolist())
        if last + 1 - first >= _MIN_SIDE_CELLS:
            return first, last + 1
