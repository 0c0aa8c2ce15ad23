"""Drains in lanes, level with the floor: gratings of gullies and of channels."""

from dataclasses import dataclass

import shapely

from garage2usd.assets.flat import GRID_M, flat_part
from garage2usd.assets.mesh import Asset
from garage2usd.objects.kind import Kind, Spec

KIND = Kind("drain", number=36, label="drain", cityscapes="road", is_solid=False)

GULLY_SIDE_M, CHANNEL_WIDTH_M = 0.3, 0.15
_FRAME_M = 0.016
_ELEMENT_M = 1.0
"""Approximate length of the elements of a channel drain."""
_GULLY_SLOTS, _CHANNEL_SLOTS = (7, 2), (3, 3)
"""Number of slots across and along each element of a drain's grating."""
_SLOT_SHARE = 0.52
"""Width of a slot as a share of the pitch of the grating's bars."""
_TIE_M = 0.022
"""Distance between consecutive slots along a drain."""
_JOINT_M = 0.004
"""Width of the joints between elements, and between a gully's grating and its frame."""


@dataclass(frozen=True)
class DrainSpec(Spec, kind=KIND):
    """A drain with its frame, long along Z; origin in its middle.

    Attributes
    ----------
    width_m, length_m
        Extent along X and Z; a gully is square, a channel longer than wide.
    """

    width_m: float
    length_m: float

    @property
    def is_channel(self) -> bool:
        """True for the galvanised steel grating of a channel, False for the cast iron grating of a gully."""
        return self.length_m > self.width_m

    def asset(self) -> Asset:
        """Make the meshes of a drain: its metal grating and the dark gaps between the bars."""
        x, z = self.width_m / 2, self.length_m / 2
        outline = shapely.box(-x, -z, x, z)
        seen = shapely.union_all([*self._slots(), *self._joints()], grid_size=GRID_M)
        bars = shapely.difference(outline, seen, grid_size=GRID_M)
        metal = "steel_galvanised" if self.is_channel else "steel_dark"
        return Asset(
            (
                flat_part("Grating", bars, metal, collider=None),
                flat_part("Gaps", shapely.intersection(outline, seen, grid_size=GRID_M), "drain_gaps", collider=None),
            )
        )

    def _elements(self) -> int:
        return max(1, round(self.length_m / _ELEMENT_M)) if self.is_channel else 1

    def _slots(self) -> list[shapely.Geometry]:
        (across, along), rim = (_CHANNEL_SLOTS, _TIE_M / 2) if self.is_channel else (_GULLY_SLOTS, _FRAME_M)
        inner, count = self.width_m / 2 - _FRAME_M, self._elements()
        element = self.length_m / count
        pitch, row = 2 * inner / across, (element - 2 * rim) / along
        half, half_length = pitch * _SLOT_SHARE / 2, (row - _TIE_M) / 2
        xs = [(index + 0.5) * pitch - inner for index in range(across)]
        starts = [index * element + rim - self.length_m / 2 for index in range(count)]
        zs = [start + (index + 0.5) * row for start in starts for index in range(along)]
        return [shapely.box(x - half, z - half_length, x + half, z + half_length) for x in xs for z in zs]

    def _joints(self) -> list[shapely.Geometry]:
        if not self.is_channel:
            inner = self.width_m / 2 - _FRAME_M
            return [shapely.box(-inner, -inner, inner, inner).exterior.buffer(_JOINT_M / 2, join_style="mitre")]
        x, element = self.width_m / 2, self.length_m / self._elements()
        ends = [index * element - self.length_m / 2 for index in range(1, self._elements())]
        return [shapely.box(-x, end - _JOINT_M / 2, x, end + _JOINT_M / 2) for end in ends]
