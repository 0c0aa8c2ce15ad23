"""Plans that are the same but for a turn or a mirror image: one canonical form, and one digest, for all of them."""

import hashlib

import numpy as np

from garage2usd.structure.grid import Cell, CellArray

__all__ = ["canonical_cells", "cropped_cells", "eight_symmetries", "plan_digest"]


def cropped_cells(cells: CellArray) -> CellArray:
    """The cells without the rows and columns at the border that lie outside altogether.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Returns
    -------
    CellArray
        A view of `cells`, shape (rows, cols) of what is left; shape (0, 0) where every square is -1.
    """
    is_inside = cells != Cell.OBSTACLE
    rows, cols = (np.flatnonzero(is_inside.any(axis=axis)) for axis in (1, 0))
    if not rows.size:
        return cells[:0, :0]
    return cells[rows[0] : rows[-1] + 1, cols[0] : cols[-1] + 1]


def eight_symmetries(cells: CellArray) -> tuple[CellArray, ...]:
    """The images of the cells under the eight symmetries of the square.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Returns
    -------
    tuple of CellArray
        Views of `cells`: turned by 0, 90, 180 and 270 degrees counter-clockwise, then the same of its mirror image.
        Four of them have shape (rows, cols) and four (cols, rows); images that are equal are not left out.
    """
    mirrored = cells[:, ::-1]
    return tuple(np.rot90(image, quarters) for image in (cells, mirrored) for quarters in range(4))


def canonical_cells(cells: CellArray) -> CellArray:
    """The one form that all turns and mirror images of a plan have in common.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Returns
    -------
    CellArray
        The cropped cells (see `cropped_cells`) in that of their eight images which comes first by shape and then by its
        values in reading order; at least as many columns as rows, a copy.
    """
    return min(eight_symmetries(cropped_cells(cells)), key=_order).copy()


def plan_digest(cells: CellArray) -> str:
    """SHA-256 in hex of the canonical form: its shape and its cells, not the metres of its squares.

    Parameters
    ----------
    cells
        S, int8, shape (rows, cols).

    Notes
    -----
    Two plans of equal digest are the same arrangement of squares, however they are turned and however wide their
    squares are.
    """
    canonical = canonical_cells(cells)
    digest = hashlib.sha256(np.array(canonical.shape, dtype="<i8").tobytes())
    digest.update(canonical.tobytes())
    return digest.hexdigest()


def _order(cells: CellArray) -> tuple[tuple[int, ...], bytes]:
    """By what images are compared: bytes from 0 compare as the values from -1 do."""
    return cells.shape, (cells - Cell.OBSTACLE).astype(np.uint8).tobytes()
