"""The design car, and its poses on the floor."""

import math
from dataclasses import dataclass

from garage2usd.common.errors import ConfigError
from garage2usd.config.vehicles import CarBody
from garage2usd.native import elementary
from garage2usd.profiles.profile import USUAL_CAR_LENGTH_M, USUAL_CAR_WIDTH_M

Point = tuple[float, float]
"""(x, z) in metres."""
_WIDEST_M, _LONGEST_M, _WIDEST_TURN_M = 3.0, 12.0, 30.0


@dataclass(frozen=True, slots=True)
class Pose:
    """Pose of a car: the middle of its rear axle on the floor, and its yaw.

    Attributes
    ----------
    x_m, z_m
        Position of the rear axle's middle.
    yaw_rad
        Right-handed turn about +Y, as in a placement: at 0 the nose points to -Z, and a turn to the driver's left is
        positive.
    """

    x_m: float
    z_m: float
    yaw_rad: float

    def moved(self, length_m: float, curvature_per_m: float = 0.0) -> "Pose":
        """Return the exact pose after an arc.

        Parameters
        ----------
        length_m
            Length of the rear axle's path; negative in reverse.
        curvature_per_m
            Curvature of that path, positive to the driver's left; 0 for a straight.
        """
        yaw = self.yaw_rad + length_m * curvature_per_m
        if length_m * curvature_per_m == 0.0:
            along_x, along_z = -elementary.sin(yaw) * length_m, -elementary.cos(yaw) * length_m
        else:
            along_x = (elementary.cos(yaw) - elementary.cos(self.yaw_rad)) / curvature_per_m
            along_z = -(elementary.sin(yaw) - elementary.sin(self.yaw_rad)) / curvature_per_m
        return Pose(self.x_m + along_x, self.z_m + along_z, yaw)


@dataclass(frozen=True, slots=True)
class DesignCar:
    """The design car: a rectangle on two axles with a least turning radius.

    Attributes
    ----------
    length_m, width_m
        Size of the body without mirrors: JGJ 100's small car.
    wheelbase_m, rear_overhang_m
        Distance between the axles, and from the rear axle to the tail. The standard gives neither; these are common in
        cars of that length.
    track_m
        Distance between the middles of the front tyres.
    turning_radius_m
        Radius of the circle of the outer front tyre's middle at full lock, as JGJ 100 gives for cars.

    Raises
    ------
    ConfigError
        If a dimension is not positive, or such a car has no such turning radius.
    """

    length_m: float = USUAL_CAR_LENGTH_M
    width_m: float = USUAL_CAR_WIDTH_M
    wheelbase_m: float = 2.7
    rear_overhang_m: float = 1.2
    track_m: float = 1.55
    turning_radius_m: float = 6.0

    def __post_init__(self) -> None:
        """Validate the car's dimensions."""
        for name, most in (("length_m", _LONGEST_M), ("width_m", _WIDEST_M), ("turning_radius_m", _WIDEST_TURN_M)):
            value = getattr(self, name)
            if not 0 < value <= most:
                raise ConfigError(f"car.{name}", value, f"more than 0 and at most {most} m")
        if not 0 < self.track_m <= self.width_m:
            raise ConfigError("car.track_m", self.track_m, f"more than 0 and at most the width of {self.width_m} m")
        if not (self.wheelbase_m > 0 and self.rear_overhang_m >= 0 and self.front_overhang_m >= 0):
            axles = self.wheelbase_m, self.rear_overhang_m
            raise ConfigError("car.wheelbase_m", axles, f"axles within the length of {self.length_m} m")
        if not (self.turning_radius_m > self.wheelbase_m and self.rear_axle_radius_m > self.width_m / 2):
            least = math.hypot(self.wheelbase_m, (self.width_m + self.track_m) / 2)
            raise ConfigError("car.turning_radius_m", self.turning_radius_m, f"more than {least:.2f} m for its axles")

    @property
    def front_overhang_m(self) -> float:
        """Distance from the car's front axle to its nose."""
        return self.length_m - self.wheelbase_m - self.rear_overhang_m

    @property
    def rear_axle_radius_m(self) -> float:
        """Least radius of the rear axle's middle: sqrt(turning_radius^2 - wheelbase^2) - track / 2."""
        return math.sqrt(self.turning_radius_m**2 - self.wheelbase_m**2) - self.track_m / 2

    @property
    def ahead_m(self) -> float:
        """Distance from the car's rear axle to its nose."""
        return self.length_m - self.rear_overhang_m

    def holds(self, body: CarBody) -> bool:
        """Return True if a body without its mirrors lies within the car, with the rear axles at the same place."""
        behind_m = body.length_m - body.ahead_m
        return body.ahead_m <= self.ahead_m and behind_m <= self.rear_overhang_m and body.width_m <= self.width_m

    def centred(self, middle: Point, yaw_rad: float) -> Pose:
        """Return the pose that puts the middle of the car's footprint at `middle`."""
        back = self.length_m / 2 - self.rear_overhang_m
        return Pose(middle[0] + elementary.sin(yaw_rad) * back, middle[1] + elementary.cos(yaw_rad) * back, yaw_rad)

    def corners(self, pose: Pose) -> tuple[Point, Point, Point, Point]:
        """Return (x, z) of the car's corners: front left, front right, rear right, rear left."""
        sin, cos = elementary.sin(pose.yaw_rad), elementary.cos(pose.yaw_rad)
        half = self.width_m / 2

        def at(ahead: float, left: float) -> Point:
            return pose.x_m - sin * ahead - cos * left, pose.z_m - cos * ahead + sin * left

        return (
            at(self.ahead_m, half),
            at(self.ahead_m, -half),
            at(-self.rear_overhang_m, -half),
            at(-self.rear_overhang_m, half),
        )
