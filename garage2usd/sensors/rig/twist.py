"""How something rigid moves at one moment."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

__all__ = ["Twist"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Twist:
    """Velocity and rate of turning, both in the axes of what moves, and of its origin.

    Attributes
    ----------
    velocity_m_s
        Metres a second; float64, shape (3,).
    turn_rad_s
        Along the axis about which it turns, radians a second; float64, shape (3,).
    """

    velocity_m_s: Floats
    turn_rad_s: Floats

    @classmethod
    def at_rest(cls) -> Self:
        """Of what stands."""
        return cls(np.zeros(3), np.zeros(3))

    @classmethod
    def between(cls, before: Floats, after: Floats, seconds: float) -> Self:
        """From a pose to a later one, in the axes halfway; matrices to the world's axes, shape (4, 4).

        `seconds`, by which the later one is later, is more than 0.
        """
        from scipy.spatial.transform import Rotation  # noqa: PLC0415 - all who import this module would wait for it

        turned = Rotation.from_matrix(before[:3, :3].T @ after[:3, :3])
        angles = turned.as_rotvec()
        halfway = before[:3, :3] @ Rotation.from_rotvec(angles / 2).as_matrix()
        return cls(halfway.T @ (after[:3, 3] - before[:3, 3]) / seconds, angles / seconds)

    def of_part(self, part_to_whole: Floats) -> Self:
        """Of something that is fixed to what moves, in its own axes; `part_to_whole` has the shape (4, 4)."""
        turn, place_m = part_to_whole[:3, :3], part_to_whole[:3, 3]
        velocity = self.velocity_m_s + np.cross(self.turn_rad_s, place_m)
        return type(self)(turn.T @ velocity, turn.T @ self.turn_rad_s)

    def reversed(self) -> Self:
        """How what stands moves as seen from what moves."""
        return type(self)(-self.velocity_m_s, -self.turn_rad_s)

    def seen_after(self, points_m: Floats, seconds: float) -> Floats:
        """Where points that stand, shape (n, 3), are in the axes of what moves so long later, or earlier."""
        from scipy.linalg import expm  # noqa: PLC0415 - as above

        generator = np.zeros((4, 4))
        x, y, z = self.turn_rad_s
        generator[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        generator[:3, 3] = self.velocity_m_s
        back = expm(-seconds * generator)
        moved: Floats = points_m @ back[:3, :3].T + back[:3, 3]
        return moved

    @property
    def facts(self) -> dict[str, list[float]]:
        """Plain values, to a micrometre and a microradian a second."""
        return {
            "velocity_m_s": [round(float(value), 6) + 0.0 for value in self.velocity_m_s],
            "turn_rad_s": [round(float(value), 6) + 0.0 for value in self.turn_rad_s],
        }
