"""Canonical form and digest of plans, equal for all rotations and reflections."""

import hashlib
from collections.abc import Sequence

import numpy as np

from garage2usd.structure.grid import Cell, CellArray


def cropped_cells(cells: CellArray) -> CellArray:
    """Crop the border rows and columns that are entirely outside the contour.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Returns
    -------
    CellArray
        A view of `cells`, shape (rows, cols) of the cropped matrix; shape (0, 0) where every square is -1.
    """
    return cells[_frame(cells)]


def eight_symmetries(cells: CellArray) -> tuple[CellArray, ...]:
    """Return the images of the cells under the eight symmetries of the square.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Returns
    -------
    tuple of CellArray
        Views of `cells`: turned by 0, 90, 180 and 270 degrees counter-clockwise, then the same of its mirror image.
        Four of them have shape (rows, cols) and four (cols, rows); equal images are kept.
    """
    mirrored = cells[:, ::-1]
    return tuple(np.rot90(image, quarters) for image in (cells, mirrored) for quarters in range(4))


def canonical_cells(cells: CellArray) -> CellArray:
    """Return the canonical form shared by all rotations and reflections of a plan.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Returns
    -------
    CellArray
        A copy of the first of the eight images of the cropped cells (see `cropped_cells`), ordered by shape and then by
        values in reading order. It has at least as many columns as rows.
    """
    return min(eight_symmetries(cropped_cells(cells)), key=_order).copy()


def plan_digest(cells: CellArray) -> str:
    """Compute the SHA-256 digest, in hex, of a plan's canonical form: its shape and cells, without metres.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Notes
    -----
    Plans of equal digest are the same arrangement of squares up to rotation, reflection and the sizes of the squares.
    """
    return _digest(canonical_cells(cells))


def levels_digest(levels: Sequence[CellArray]) -> str:
    """Compute a digest of the plans of all levels that is the same for rotated and reflected ones: SHA-256, in hex.

    Parameters
    ----------
    levels
        S of each level, the top one first; int8, shape (rows, cols) each.

    Notes
    -----
    The digest is equal for rotations and reflections of the whole building, and that of one level is its `plan_digest`.
    """
    if len(levels) == 1:
        return plan_digest(levels[0])
    # crop all levels alike, to the squares that are inside on any level
    frame = _frame(np.max(np.stack(levels), axis=0))
    images = (np.stack(image) for image in zip(*(eight_symmetries(level[frame]) for level in levels), strict=True))
    return _digest(min(images, key=_order))


def _frame(cells: CellArray) -> tuple[slice, slice]:
    """Return the rows and columns that bound all squares inside the contour."""
    rows, cols = (np.flatnonzero((cells != Cell.OBSTACLE).any(axis=axis)) for axis in (1, 0))
    return (slice(rows[0], rows[-1] + 1), slice(cols[0], cols[-1] + 1)) if rows.size else (slice(0), slice(0))


def _digest(canonical: CellArray) -> str:
    digest = hashlib.sha256(np.array(canonical.shape, dtype="<i8").tobytes())
    digest.update(canonical.tobytes())
    return digest.hexdigest()


def _order(cells: CellArray) -> tuple[tuple[int, ...], bytes]:
    """Return the sort key of an image: bytes from 0 compare as the values from -1 do."""
    return cells.shape, (cells - Cell.OBSTACLE).astype(np.uint8).tobytes()
