"""Camera lenses: projection of points to pixels, rays of pixels, and radius polynomials of fisheye lenses.

Camera axes are OpenCV's: +X to the right, +Y down, +Z along the optical axis. Pixel (column, row) covers
[column, column + 1) and its middle is column + 0.5; OpenCV and WoodScape count from the middle of the first pixel, so
that their coordinates are 0.5 less.
"""
# Over 300 lines: one class for each model of a lens, with the polynomials that two of them invert.

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
_STEPS = 60
"""Maximum number of Newton steps; that many bisections of pi exhaust double precision."""
_TINY = 1e-300
_SAMPLES = 20_001
_ON_AXIS = 1e-300


@dataclass(frozen=True)
class RadiusPolynomial:
    """A fisheye's radius r(theta) = sum of c_i theta^i, which increases from r(0) = 0.

    Attributes
    ----------
    coefficients
        c_0, which is 0, c_1 and so on.
    """

    coefficients: Sequence[float]

    def __call__(self, angle_rad: ArrayLike) -> Floats:
        """Evaluate the radius at angles, shape (n,)."""
        return _horner(self.coefficients, np.asarray(angle_rad, dtype=np.float64))

    @property
    def slope(self) -> tuple[float, ...]:
        """Coefficients of the derivative, lowest degree first."""
        return tuple(power * factor for power, factor in enumerate(self.coefficients))[1:]

    @property
    def grows_up_to_rad(self) -> float:
        """The angle up to which the radius increases, at most pi.

        The slope is sampled in steps of less than 0.01 degrees, since polynomial root finding is inaccurate for
        coefficients of very different magnitude.
        """
        angles = np.linspace(0.0, math.pi, _SAMPLES)
        falls = np.flatnonzero(_horner(self.slope, angles) <= 0)
        return float(angles[max(falls[0] - 1, 0)]) if len(falls) else math.pi

    def angles_rad(self, radius: ArrayLike, *, most_rad: float) -> Floats:
        """Invert the radius polynomial: the angles of radii, shape (n,); NaN for radii beyond the limit's.

        Parameters
        ----------
        radius
            At least 0.
        most_rad
            Limit of the angle, up to which the radius increases.
        """
        radius = np.asarray(radius, dtype=np.float64)
        slope = self.slope
        seen = radius <= self(most_rad)
        low, high = np.zeros(radius.shape), np.full(radius.shape, most_rad)
        angle = np.clip(radius / slope[0], low, high)
        for _ in range(_STEPS):  # Newton's method, with bisection where a step leaves the bracket
            over = self(angle) - radius
            high, low = np.where(over >= 0, angle, high), np.where(over <= 0, angle, low)
            step = angle - over / np.maximum(_horner(slope, angle), _TINY)
            following = np.where((step >= low) & (step <= high), step, (low + high) / 2)
            if (following == angle)[seen].all():
                break
            angle = following
        return np.where(seen, angle, np.nan)


def _horner(coefficients: Sequence[float], values: Floats) -> Floats:
    total = np.zeros(values.shape)
    for factor in reversed(coefficients):
        total = total * values + factor
    return total


@dataclass(frozen=True, kw_only=True)
class Lens(ABC):
    """The projection of a camera, without its pose.

    Attributes
    ----------
    size_px
        Width and height of the picture.
    centre_px
        Principal point, where the optical axis meets the picture, from its left and upper edge.
    """

    size_px: tuple[int, int]
    centre_px: tuple[float, float]

    @abstractmethod
    def project(self, points: ArrayLike) -> Floats:
        """Project points in camera axes to pixels.

        Parameters
        ----------
        points
            Points in camera axes, in any unit; shape (n, 3).

        Returns
        -------
        ndarray
            (column, row), float64, shape (n, 2); NaN for points outside the lens's field of view. Projected points may
            still lie outside the picture, see `within`.
        """

    @abstractmethod
    def rays(self, pixels: ArrayLike) -> Floats:
        """Return the directions of the rays of pixels.

        Parameters
        ----------
        pixels
            (column, row), in pixels from the left and upper edge; shape (n, 2).

        Returns
        -------
        ndarray
            Unit vectors in camera axes, float64, shape (n, 3); NaN outside the lens's field of view.
        """

    def starts(self, pixels: ArrayLike) -> Floats:
        """Return the starting points of the rays of pixels, shape (n, 2), in camera axes and metres; shape (n, 3).

        Rays start at the camera, except in lenses that override this method.
        """
        return np.zeros((len(np.asarray(pixels)), 3))

    @abstractmethod
    def parameters(self) -> Mapping[str, object]:
        """Return the lens model and all its parameters as plain values, keyed by attribute name."""

    @abstractmethod
    def resized(self, size_px: tuple[int, int]) -> Self:
        """Return the lens for a picture of another size with the same edges."""

    def middles(self) -> Floats:
        """Return the middles of all pixels, row by row; float64, shape (height * width, 2)."""
        rows, columns = np.mgrid[: self.size_px[1], : self.size_px[0]]
        return np.stack([columns.ravel() + 0.5, rows.ravel() + 0.5], axis=1)

    def within(self, pixels: ArrayLike) -> NDArray[np.bool_]:
        """Test which pixel coordinates, shape (n, 2), lie in the picture; False for NaN."""
        places = np.asarray(pixels, dtype=np.float64)
        inside: NDArray[np.bool_] = ((places >= 0) & (places < self.size_px)).all(axis=1)
        return inside

    def _ratios(self, size_px: tuple[int, int]) -> tuple[float, float]:
        return size_px[0] / self.size_px[0], size_px[1] / self.size_px[1]


@dataclass(frozen=True, kw_only=True)
class Pinhole(Lens):
    """A pinhole lens, without distortion: u = fx * X / Z + cx.

    Attributes
    ----------
    focal_px
        Focal lengths (fx, fy) in widths and heights of a pixel.
    """

    focal_px: tuple[float, float]

    def project(self, points: ArrayLike) -> Floats:
        """Project points to pixels; NaN for points that are not in front of the camera. See `Lens.project`."""
        points = np.asarray(points, dtype=np.float64)
        depth = np.where(points[:, 2] > 0, points[:, 2], np.nan)[:, None]
        pixels: Floats = points[:, :2] / depth * self.focal_px + self.centre_px
        return pixels

    def rays(self, pixels: ArrayLike) -> Floats:
        """Return the directions of the rays of pixels through the pinhole; see `Lens.rays`."""
        flat = (np.asarray(pixels, dtype=np.float64) - self.centre_px) / self.focal_px
        rays = np.concatenate([flat, np.ones((len(flat), 1))], axis=1)
        unit: Floats = rays / np.linalg.norm(rays, axis=1, keepdims=True)
        return unit

    def parameters(self) -> Mapping[str, object]:
        """Return the parameters of the pinhole; see `Lens.parameters`."""
        return {"model": "pinhole", "focal_px": list(self.focal_px), "centre_px": list(self.centre_px)}

    def resized(self, size_px: tuple[int, int]) -> Self:
        """Scale the pinhole's focal lengths and principal point to another size; see `Lens.resized`."""
        ratios = self._ratios(size_px)
        return replace(
            self, size_px=size_px, centre_px=_times(self.centre_px, ratios), focal_px=_times(self.focal_px, ratios)
        )


@dataclass(frozen=True, kw_only=True)
class Fisheye(Lens):
    """A fisheye lens: the radius of a point in the picture is a polynomial of the angle theta from the optical axis.

    A point is shown at a distance r(theta) from `centre_px` in the direction of (X, Y), scaled by `stretch` along
    columns and rows. The polynomial r increases up to `max_angle_rad`, the edge of the field of view.

    Attributes
    ----------
    max_angle_rad
        Half of the field of view.
    """

    max_angle_rad: float

    @property
    @abstractmethod
    def radius(self) -> RadiusPolynomial:
        """The radius r(theta) as a polynomial."""

    @property
    @abstractmethod
    def stretch(self) -> tuple[float, float]:
        """Pixels per unit of r along columns and rows."""

    def project(self, points: ArrayLike) -> Floats:
        """Project points to pixels of the fisheye; see `Lens.project`."""
        points = np.asarray(points, dtype=np.float64)
        across = np.hypot(points[:, 0], points[:, 1])
        angle = np.arctan2(across, points[:, 2])
        seen = (angle <= self.max_angle_rad) & (points != 0).any(axis=1)
        radius = np.where(seen, self.radius(angle), np.nan)
        direction = points[:, :2] / np.maximum(across, _ON_AXIS)[:, None]
        pixels: Floats = radius[:, None] * direction * self.stretch + self.centre_px
        return pixels

    def rays(self, pixels: ArrayLike) -> Floats:
        """Return the directions of the rays of pixels through the fisheye; see `Lens.rays`."""
        flat = (np.asarray(pixels, dtype=np.float64) - self.centre_px) / self.stretch
        radius = np.hypot(flat[:, 0], flat[:, 1])
        angle = self.radius.angles_rad(radius, most_rad=self.max_angle_rad)
        across = flat / np.maximum(radius, _ON_AXIS)[:, None] * np.sin(angle)[:, None]
        return np.concatenate([across, np.cos(angle)[:, None]], axis=1)


@dataclass(frozen=True, kw_only=True)
class KannalaBrandt(Fisheye):
    """OpenCV's fisheye lens: r = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8).

    Kannala and Brandt, *A Generic Camera Model and Calibration Method for Conventional, Wide-Angle, and Fish-Eye
    Lenses* (2006), radially symmetric, as in `cv2.fisheye` and ROS ("equidistant"). The field of view may extend beyond
    90 degrees from the axis, where OpenCV's projection ends.

    Attributes
    ----------
    focal_px
        (fx, fy).
    coefficients
        (k1, k2, k3, k4).
    """

    focal_px: tuple[float, float]
    coefficients: tuple[float, float, float, float]

    @property
    def radius(self) -> RadiusPolynomial:
        """The odd polynomial of Kannala and Brandt; see `Fisheye.radius`."""
        k1, k2, k3, k4 = self.coefficients
        return RadiusPolynomial((0.0, 1.0, 0.0, k1, 0.0, k2, 0.0, k3, 0.0, k4))

    @property
    def stretch(self) -> tuple[float, float]:
        """Focal lengths (fx, fy); see `Fisheye.stretch`."""
        return self.focal_px

    def parameters(self) -> Mapping[str, object]:
        """Return the parameters of the Kannala-Brandt lens; see `Lens.parameters`."""
        return {
            "model": "kannala_brandt",
            "focal_px": list(self.focal_px),
            "centre_px": list(self.centre_px),
            "coefficients": list(self.coefficients),
            "max_angle_rad": self.max_angle_rad,
        }

    def resized(self, size_px: tuple[int, int]) -> Self:
        """Scale the focal lengths and principal point of the fisheye to another size; see `Lens.resized`."""
        ratios = self._ratios(size_px)
        return replace(
            self, size_px=size_px, centre_px=_times(self.centre_px, ratios), focal_px=_times(self.focal_px, ratios)
        )


@dataclass(frozen=True, kw_only=True)
class WoodScape(Fisheye):
    """WoodScape's fisheye lens: r = k1 theta + k2 theta^2 + k3 theta^3 + k4 theta^4, in pixels.

    Yogamani et al., *WoodScape: A multi-task, multi-camera fisheye dataset for autonomous driving* (2019), and the
    `radial_poly` of its calibration files.

    Attributes
    ----------
    coefficients_px
        (k1, k2, k3, k4).
    aspect_ratio
        Factor by which rows are stretched.
    """

    coefficients_px: tuple[float, float, float, float]
    aspect_ratio: float

    @property
    def radius(self) -> RadiusPolynomial:
        """The polynomial of degree four of WoodScape; see `Fisheye.radius`."""
        return RadiusPolynomial((0.0, *self.coefficients_px))

    @property
    def stretch(self) -> tuple[float, float]:
        """The aspect ratio as factors of columns and rows; see `Fisheye.stretch`."""
        return 1.0, self.aspect_ratio

    def parameters(self) -> Mapping[str, object]:
        """Return the parameters of the WoodScape lens; see `Lens.parameters`."""
        return {
            "model": "woodscape",
            "coefficients_px": list(self.coefficients_px),
            "centre_px": list(self.centre_px),
            "aspect_ratio": self.aspect_ratio,
            "max_angle_rad": self.max_angle_rad,
        }

    def resized(self, size_px: tuple[int, int]) -> Self:
        """Scale the polynomial and principal point of the fisheye to another size; see `Lens.resized`."""
        wider, higher = self._ratios(size_px)
        k1, k2, k3, k4 = self.coefficients_px
        return replace(
            self,
            size_px=size_px,
            centre_px=_times(self.centre_px, (wider, higher)),
            coefficients_px=(k1 * wider, k2 * wider, k3 * wider, k4 * wider),
            aspect_ratio=self.aspect_ratio * higher / wider,
        )


def _times(pair: tuple[float, float], ratios: tuple[float, float]) -> tuple[float, float]:
    return pair[0] * ratios[0], pair[1] * ratios[1]
