"""Rigid-body motion at one moment: linear and angular velocity."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

__all__ = ["Twist"]

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Twist:
    """Velocity and angular velocity of a rigid body, in its own axes and at its origin.

    Attributes
    ----------
    velocity_m_s
        Velocity in metres per second; float64, shape (3,).
    turn_rad_s
        Angular velocity along the axis of rotation, in radians per second; float64, shape (3,).
    """

    velocity_m_s: Floats
    turn_rad_s: Floats

    @classmethod
    def at_rest(cls) -> Self:
        """Return the twist of a body at rest."""
        return cls(np.zeros(3), np.zeros(3))

    @classmethod
    def between(cls, before: Floats, after: Floats, seconds: float) -> Self:
        """Compute the mean twist between two poses, in the axes halfway; matrices to the world's axes, shape (4, 4).

        `seconds` between the poses is greater than 0.
        """
        from scipy.spatial.transform import Rotation  # noqa: PLC0415 - all who import this module would wait for it

        turned = Rotation.from_matrix(before[:3, :3].T @ after[:3, :3])
        angles = turned.as_rotvec()
        halfway = before[:3, :3] @ Rotation.from_rotvec(angles / 2).as_matrix()
        return cls(halfway.T @ (after[:3, 3] - before[:3, 3]) / seconds, angles / seconds)

    def of_part(self, part_to_whole: Floats) -> Self:
        """Return the twist of a part fixed to the body, in the part's own axes; `part_to_whole` has shape (4, 4)."""
        turn, place_m = part_to_whole[:3, :3], part_to_whole[:3, 3]
        velocity = self.velocity_m_s + np.cross(self.turn_rad_s, place_m)
        return type(self)(turn.T @ velocity, turn.T @ self.turn_rad_s)

    def reversed(self) -> Self:
        """Return the motion of the static world as seen from the moving body."""
        return type(self)(-self.velocity_m_s, -self.turn_rad_s)

    def seen_after(self, points_m: Floats, seconds: float) -> Floats:
        """Transform static points, shape (n, 3), to the moving body's axes after a time; negative times are earlier."""
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
        """Velocity and angular velocity as plain values, rounded to micrometres and microradians per second."""
        return {
            "velocity_m_s": [round(float(value), 6) + 0.0 for value in self.velocity_m_s],
            "turn_rad_s": [round(float(value), 6) + 0.0 for value in self.turn_rad_s],
        }
