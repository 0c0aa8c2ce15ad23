"""Bird's-eye views: orthographic pictures of the ground around a vehicle, seen from straight above."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Annotated, Self

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from pydantic import Field

from garage2usd.common.settings import Settings
from garage2usd.sensors.rays.lenses import Lens

FLOOR_CLASSES = frozenset(
    {
        "crossing",
        "drain",
        "floor",
        "floor_stain",
        "hatching",
        "lane_arrow",
        "lane_line",
        "parking_stall",
        "stall_line",
        "stall_number",
        "stall_symbol",
    }
)
"""Semantic classes of the floor, its paint and its stains."""
FREE_CLASSES = FLOOR_CLASSES | {"ramp", "speed_bump"}
"""Semantic classes that a car can drive on."""

_HEIGHT_M = 20.0
"""Height of the bird's-eye camera over the vehicle's ground; objects overhead are transparent."""
_Side = Annotated[int, Field(ge=16, le=8192)]
_Metres = Annotated[float, Field(ge=-1000.0, le=1000.0)]

Floats = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Orthographic(Lens):
    """An orthographic lens, whose rays are parallel: u = X / metres_per_px + cx.

    Attributes
    ----------
    metres_per_px
        Width and height of a pixel.
    """

    metres_per_px: float

    def project(self, points: ArrayLike) -> Floats:
        """Project points in metres orthographically to pixels; see `Lens.project`."""
        return np.asarray(points, dtype=np.float64)[:, :2] / self.metres_per_px + self.centre_px

    def rays(self, pixels: ArrayLike) -> Floats:
        """Return the parallel rays of pixels, which start at Z = 0; see `Lens.rays` and `starts`."""
        return np.tile([0.0, 0.0, 1.0], (len(np.asarray(pixels)), 1))

    def starts(self, pixels: ArrayLike) -> Floats:
        """Return the starting points of the parallel rays of pixels at Z = 0; see `Lens.starts`."""
        flat = (np.asarray(pixels, dtype=np.float64) - self.centre_px) * self.metres_per_px
        return np.concatenate([flat, np.zeros((len(flat), 1))], axis=1)

    def parameters(self) -> Mapping[str, object]:
        """Return the model and parameters of the orthographic lens; see `Lens.parameters`."""
        return {
            "model": "orthographic",
            "metres_per_px": self.metres_per_px,
            "centre_px": list(self.centre_px),
        }

    def resized(self, size_px: tuple[int, int]) -> Self:
        """Resize the picture, both sides by the same factor so that pixels stay square; see `Lens.resized`.

        Raises
        ------
        ValueError
            If pixels would not stay square.
        """
        across, down = self._ratios(size_px)
        if across != down:
            raise ValueError(f"{size_px} is not {self.size_px} on another scale")
        x, y = self.centre_px
        return replace(
            self, size_px=size_px, centre_px=(x * across, y * down), metres_per_px=self.metres_per_px / across
        )


class BirdsEye(Settings):
    """Settings of a recording's bird's-eye views: forwards is up, and the ego vehicle is not drawn."""

    metres_per_px: float = Field(0.02, ge=0.001, le=1.0)
    """Width and height of a pixel."""
    size_px: tuple[_Side, _Side] = (600, 600)
    """Width and height of the picture."""
    centre_m: tuple[_Metres, _Metres] = (1.4, 0.0)
    """(x, y) of the picture's middle in the vehicle's frame: forward and to the left of the middle of the rear axle."""
    cars: bool = True
    """True if parked cars are drawn; free space excludes the ground under them either way."""

    @property
    def lens(self) -> Orthographic:
        """The orthographic lens of the bird's-eye view."""
        width, height = self.size_px
        return Orthographic(size_px=self.size_px, centre_px=(width / 2, height / 2), metres_per_px=self.metres_per_px)

    def sensor_to_vehicle(self) -> Floats:
        """Return the transform from camera axes (+X right, +Y down, +Z forward) to the vehicle's; shape (4, 4)."""
        matrix = np.eye(4)
        matrix[:3, :3] = [[0.0, -1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, -1.0]]
        matrix[:3, 3] = (*self.centre_m, _HEIGHT_M)
        return matrix

    def places(self, points_m: ArrayLike) -> Floats:
        """Project points (x, y) in the vehicle's frame, shape (n, 2), to (column, row); float64, shape (n, 2)."""
        ahead, left = (np.asarray(points_m, dtype=np.float64) - self.centre_m).T / self.metres_per_px
        width, height = self.size_px
        return np.stack([width / 2 - left, height / 2 - ahead], axis=1)

    def ground_mask(self, outlines_m: Sequence[ArrayLike]) -> NDArray[np.bool_]:
        """Mask the pixels whose middles lie in any of several ground polygons, such as the ego vehicle's footprint.

        Parameters
        ----------
        outlines_m
            Rings of points (x, y) in the vehicle's frame, each of shape (n, 2).

        Returns
        -------
        ndarray
            bool, shape (rows, columns).
        """
        width, height = self.size_px
        picture = shapely.box(0, 0, width, height)
        grounds = [shapely.Polygon(self.places(outline)) for outline in outlines_m]
        ground = shapely.union_all([each for each in grounds if each.intersects(picture)])
        shapely.prepare(ground)
        columns, rows = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
        inside: NDArray[np.bool_] = shapely.contains_xy(ground, columns, rows)
        return inside


def free_space(classes: NDArray[np.uint8], names: Mapping[int, str]) -> NDArray[np.bool_]:
    """Classify which pixels of a bird's-eye view show ground that a car can drive on.

    The class of ramps includes their walls and kerbs; `garage2usd.sensors.rays.driven_surface` separates the floor.

    Parameters
    ----------
    classes
        Semantic class id of each pixel; shape (rows, columns).
    names
        Name of each class by its id.
    """
    free = [number for number, name in names.items() if name in FREE_CLASSES]
    return np.isin(classes, free)
