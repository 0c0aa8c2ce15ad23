"""Around views: the ground around a car through the cameras on it, as the surround-view systems of series cars have it.

Each pixel stands for a point of the ground, and shows what the camera that serves it sees towards that point. What
stands on the ground is smeared outwards, away from the camera; near the seams between two cameras some of it is on the
side of neither, and not seen.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from garage2usd.sensors.rays.lenses import Lens

__all__ = ["SEAM_M", "SECTORS", "AroundView", "Eye"]

SECTORS = ("front", "rear", "left", "right")
"""The sides of the car by which the ground around it is divided; seams leave its corners at 45 degrees."""
SEAM_M = 1e-5
"""By which sides take more, so that pixels on a seam are theirs in a renderer's single precision too."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Eye:
    """A camera that an around view looks through.

    Attributes
    ----------
    name
        Of the camera.
    lens
        What it sees.
    to_view
        From its axes (OpenCV's) to the view's, in metres, for column vectors; float64, shape (4, 4). Its height over
        the ground is above 0.
    """

    name: str
    lens: Lens
    to_view: Floats

    @property
    def place_m(self) -> Floats:
        """Where it is in the view's axes; float64, shape (3,)."""
        return self.to_view[:3, 3]

    def sees(self, directions: Floats) -> NDArray[np.bool_]:
        """Whether its picture holds what lies in directions in the view's axes, shape (n, 3)."""
        return self.lens.within(self.lens.project(directions @ self.to_view[:3, :3]))


@dataclass(frozen=True, kw_only=True, eq=False)
class AroundView(Lens):
    """A lens whose rays start at several cameras and go through the points of the ground that pixels stand for.

    Its axes are those of a camera on the ground that looks straight down: +X to the right and +Y down in the picture,
    which is forwards at the top, +Z into the ground, which is where Z is 0; the axis meets the picture in `centre_px`.

    Attributes
    ----------
    metres_per_px
        Width and height of a pixel on the ground.
    car_m
        Left, front, right and rear edge of the car's ground, in X, Y, X and Y; nothing is shown within.
    eyes
        The cameras that serve `SECTORS`.
    """

    metres_per_px: float
    car_m: tuple[float, float, float, float]
    eyes: tuple[Eye, Eye, Eye, Eye]

    def ground(self, pixels: ArrayLike) -> Floats:
        """The points (X, Y) of the ground that places, shape (n, 2), stand for; float64, shape (n, 2)."""
        ground: Floats = (np.asarray(pixels, dtype=np.float64) - self.centre_px) * self.metres_per_px
        return ground

    def sectors(self, ground_m: ArrayLike) -> NDArray[np.int64]:
        """For points (X, Y) of the ground the index in `SECTORS` of the side that serves them; int64, shape (n,)."""
        outside: NDArray[np.int64] = self._outside_m(ground_m).argmax(axis=1)
        return outside

    def over_car(self, pixels: ArrayLike) -> NDArray[np.bool_]:
        """Which places, shape (n, 2), stand for ground that the car covers."""
        covered: NDArray[np.bool_] = (self._outside_m(self.ground(pixels)) < 0).all(axis=1)
        return covered

    def project(self, points: ArrayLike) -> Floats:
        """See `Lens.project`; points are in metres.

        What is seen through two cameras is shown where the nearer one has it. Points of the ground have a place whether
        or not a camera sees them.
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
        pixels: Floats = shown / self.metres_per_px + self.centre_px
        return pixels

    def rays(self, pixels: ArrayLike) -> Floats:
        """See `Lens.rays`; they start at the cameras, see `starts`. NaN within the car and where no camera sees."""
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
        """See `Lens.starts`: the places of the cameras that serve the pixels."""
        places: Floats = np.array([eye.place_m for eye in self.eyes])[self.sectors(self.ground(pixels))]
        return places

    def parameters(self) -> Mapping[str, object]:
        """See `Lens.parameters`."""
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
        """See `Lens.resized`; pixels stay square: `metres_per_px` follows the width."""
        across, down = self._ratios(size_px)
        centre = self.centre_px[0] * across, self.centre_px[1] * down
        return replace(self, size_px=size_px, centre_px=centre, metres_per_px=self.metres_per_px / across)

    def _outside_m(self, ground_m: ArrayLike) -> Floats:
        """How far points (X, Y) lie outside of the car's edges, in the order of `SECTORS`; shape (n, 4)."""
        x, y = np.asarray(ground_m, dtype=np.float64).T
        left, front, right, rear = self.car_m
        return np.stack([front - y - SEAM_M, y - rear - SEAM_M, left - x, x - right], axis=1)


def _on_the_ground(points: Floats, place_m: Floats) -> Floats:
    """Where the rays from a place through points meet the ground; NaN for points that are not below the place."""
    below = points[:, 2] > place_m[2]
    stretch = np.where(below, -place_m[2] / np.where(below, points[:, 2] - place_m[2], 1.0), np.nan)
    ground: Floats = place_m[:2] + (points[:, :2] - place_m[:2]) * stretch[:, None]
    return ground
