"""Connected pieces of many placed meshes, computed in one batch for speed."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.outlines import outlines_of
from garage2usd.as_built.shapes import Body, are_upright
from garage2usd.layout.grounds import Grounds, grounds_of_corners, hulls_around

_LEAST_CORNERS = 3


class PlacedPieces(NamedTuple):
    """Connected pieces of placed meshes, in columns.

    Attributes
    ----------
    owner
        Index of the mesh of each piece, ascending; int64, shape (pieces,).
    counts
        Number of corners of each convex outline, seen from above; int64, shape (pieces,).
    corners
        (x, z) of the corners of all outlines in order, in metres; float64, shape (n, 2).
    low_m, high_m
        Least and greatest height of each piece; float64, shape (pieces,).
    """

    owner: NDArray[np.int64]
    counts: NDArray[np.int64]
    corners: NDArray[np.float64]
    low_m: NDArray[np.float64]
    high_m: NDArray[np.float64]

    @property
    def piece(self) -> NDArray[np.int64]:
        """Number of the piece of each corner; int64, shape (n,)."""
        return np.repeat(np.arange(len(self.counts)), self.counts)

    @property
    def have_area(self) -> NDArray[np.bool_]:
        """True for each piece that is more than a line or a point; bool, shape (pieces,)."""
        return self.counts >= _LEAST_CORNERS

    @property
    def footprints(self) -> Grounds:
        """Outlines of the pieces as polygons; all must have an area."""
        return grounds_of_corners(self.corners, self.piece)

    @property
    def hulls(self) -> Grounds:
        """Outlines of the pieces as polygons, or as lines and points where they have no area."""
        return hulls_around(self.corners, self.counts)

    def kept(self, are_kept: NDArray[np.bool_]) -> "PlacedPieces":
        """Select pieces by a mask; bool, shape (pieces,)."""
        corners = self.corners[np.repeat(are_kept, self.counts)]
        return PlacedPieces(
            self.owner[are_kept], self.counts[are_kept], corners, self.low_m[are_kept], self.high_m[are_kept]
        )


def lows_m(bodies: Sequence[Body]) -> NDArray[np.float64]:
    """Return the least height of each of many placed meshes of a garage as built; float64, shape (meshes,)."""
    matrices = _matrices(bodies)
    lows: NDArray[np.float64] = np.array([body.shape.lowest for body in bodies]) * matrices[:, 1, 1] + matrices[:, 3, 1]
    for index in np.flatnonzero(~are_upright(matrices)).tolist():
        lows[index] = bodies[index].low_m()
    return lows


def placed_pieces(bodies: Sequence[Body], are_whole: NDArray[np.bool_]) -> PlacedPieces:
    """Return the connected pieces of many meshes, ordered by mesh and then as in the mesh.

    Parameters
    ----------
    bodies
        The meshes.
    are_whole
        True for each mesh that counts as one piece; bool, shape (meshes,).
    """
    matrices = _matrices(bodies)
    found = [body.shape.outlines(whole=whole) for body, whole in zip(bodies, are_whole.tolist(), strict=True)]
    for index in np.flatnonzero(~are_upright(matrices)).tolist():
        found[index] = outlines_of(bodies[index].pieces(whole=bool(are_whole[index])))
        matrices[index] = np.eye(4)
    owner = np.repeat(np.arange(len(found)), [len(pieces.counts) for pieces in found])
    corners, counts, low_m, high_m = (np.concatenate(column) for column in zip(outlines_of([]), *found, strict=True))
    x, z = corners.T
    place = matrices[np.repeat(owner, counts)]
    placed = [x * place[:, 0, axis] + z * place[:, 2, axis] + place[:, 3, axis] for axis in (0, 2)]
    rise, lift = matrices[owner, 1, 1], matrices[owner, 3, 1]
    return PlacedPieces(owner, counts, np.stack(placed, axis=1), low_m * rise + lift, high_m * rise + lift)


def _matrices(bodies: Sequence[Body]) -> NDArray[np.float64]:
    return np.array([body.matrix for body in bodies], dtype=np.float64).reshape(-1, 4, 4)
