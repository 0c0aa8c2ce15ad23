"""Around-view lenses: the ground around a car, composed from the cameras of a surround-view system.

Each pixel corresponds to a point of the ground and shows the view of the camera of its sector towards that point.
Objects that stand on the ground are smeared outwards, away from the camera. Parts of them near the seam between two
cameras may be missing.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.sensors.rays.lenses import Lens

SECTORS = ("front", "rear", "left", "right")
"""The sectors of the ground around the car, one for each side; the seams run from the car's corners at 45 degrees."""
SEAM_M = 1e-5
"""Tolerance by which sectors are enlarged, so that pixels on a seam belong to them in a renderer's single precision
too."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Eye:
    """A camera of an around view, with its lens and pose.

    Attributes
    ----------
    name
        Name of the camera.
    lens
        Lens of the camera.
    to_view
        Transform from the camera's axes (OpenCV's) to the view's, in metres, for column vectors; float64, shape (4, 4).
        The camera is above the ground.
    """

    name: str
    lens: Lens
    to_view: Floats

    @property
    def place_m(self) -> Floats:
        """Position of the camera in the view's axes; float64, shape (3,)."""
        return self.to_view[:3, 3]

    def sees(self, directions: Floats) -> NDArray[np.bool_]:
        """Test which directions in the view's axes, shape (n, 3), fall into the camera's picture."""
        return self.lens.within(self.lens.project(directions @ self.to_view[:3, :3]))


@dataclass(frozen=True, kw_only=True, eq=False)
class AroundView(Lens):
    """A lens composed of several cameras around a car, whose rays end at points of the ground.

    The axes are those of a camera on the ground that looks straight down: +X to the right and +Y down in the picture,
    +Z into the ground. The ground is at Z = 0, the top of the picture is forwards, and the optical axis meets the
    picture in `centre_px`.

    Attributes
    ----------
    metres_per_px
        Width and height of a pixel on the ground.
    car_m
        Left, front, right and rear edge of the car's footprint, in X, Y, X and Y; the picture is black within it.
    eyes
        The cameras of the `SECTORS`, in their order.
    """

    metres_per_px: float
    car_m: tuple[float, float, float, float]
    eyes: tuple[Eye, Eye, Eye, Eye]

    def ground(self, pixels: ArrayLike) -> Floats:
        """Map pixels, shape (n, 2), to points (X, Y) of the ground; float64, shape (n, 2)."""
        return (np.asarray(pixels, dtype=np.float64) - self.centre_px) * self.metres_per_px

    def sectors(self, ground_m: ArrayLike) -> NDArray[np.int64]:
        """Return the index in `SECTORS` of each point (X, Y) of the ground; int64, shape (n,)."""
        outside: NDArray[np.int64] = self._outside_m(ground_m).argmax(axis=1)
        return outside

    def over_car(self, pixels: ArrayLike) -> NDArray[np.bool_]:
        """Test which pixels, shape (n, 2), show ground that the car covers."""
        covered: NDArray[np.bool_] = (self._outside_m(self.ground(pixels)) < 0).all(axis=1)
        return covered

    def project(self, points: ArrayLike) -> Floats:
        """Project points in metres to pixels of the around view; see `Lens.project`.

        A point seen by two cameras is shown where the nearer one projects it. Points of the ground have a pixel even if
        no camera sees them.
        """
        points = np.asarray(points, dtype=np.float64)
        shown = np.full((len(points), 2), np.nan)
        nearest_m = np.full(len(points), np.inf)
        for sector, eye in enumerate(self.eyes):
            ground = _on_the_ground(points, eye.place_m)
            distance_m = np.linalg.norm(points - eye.place_m, axis=1)
            taken = np.isfinite(ground).all(axis=1) & (distance_m < nearest_m)
            taken[taken] = self.sectors(ground[taken]) == sector
            shown[taken] = ground[taken]
            nearest_m[taken] = distance_m[taken]
        return shown / self.metres_per_px + self.centre_px

    def rays(self, pixels: ArrayLike) -> Floats:
        """Return the rays of pixels from their cameras; NaN within the car and outside all fields of view."""
        ground = self.ground(pixels)
        rays = np.concatenate([ground, np.zeros((len(ground), 1))], axis=1) - self.starts(pixels)
        rays /= np.linalg.norm(rays, axis=1, keepdims=True)
        served = self.sectors(ground)
        is_seen = ~self.over_car(pixels)
        for sector, eye in enumerate(self.eyes):
            of_eye = served == sector
            is_seen[of_eye] &= eye.sees(rays[of_eye])
        return np.where(is_seen[:, None], rays, np.nan)

    def starts(self, pixels: ArrayLike) -> Floats:
        """Return the positions of the cameras in whose sectors pixels lie; see `Lens.starts`."""
        return np.array([eye.place_m for eye in self.eyes])[self.sectors(self.ground(pixels))]

    def parameters(self) -> Mapping[str, object]:
        """Return the parameters of the around view and of its cameras; see `Lens.parameters`."""
        return {
            "model": "around_view",
            "metres_per_px": self.metres_per_px,
            "centre_px": list(self.centre_px),
            "car_m": list(self.car_m),
            "cameras": {
                sector: {"name": eye.name, "camera_to_view": eye.to_view.tolist(), "lens": dict(eye.lens.parameters())}
                for sector, eye in zip(SECTORS, self.eyes, strict=True)
            },
        }

    def resized(self, size_px: tuple[int, int]) -> Self:
        """Resize the picture with square pixels; `metres_per_px` follows the width. See `Lens.resized`."""
        across, down = self._ratios(size_px)
        centre = self.centre_px[0] * across, self.centre_px[1] * down
        return replace(self, size_px=size_px, centre_px=centre, metres_per_px=self.metres_per_px / across)

    def _outside_m(self, ground_m: ArrayLike) -> Floats:
        """Measure how far points (X, Y) lie outside the car's edges, in the order of `SECTORS`; shape (n, 4)."""
        x, y = np.asarray(ground_m, dtype=np.float64).T
        left, front, right, rear = self.car_m
        return np.stack([front - y - SEAM_M, y - rear - SEAM_M, left - x, x - right], axis=1)


def _on_the_ground(points: Floats, place_m: Floats) -> Floats:
    """Intersect the rays from a camera through points with the ground; NaN for points at or above the camera."""
    below = points[:, 2] > place_m[2]
    stretch = np.where(below, -place_m[2] / np.where(below, points[:, 2] - place_m[2], 1.0), np.nan)
    ground: Floats = place_m[:2] + (points[:, :2] - place_m[:2]) * stretch[:, None]
    return ground
