"""Uses and kinds of stalls."""

from enum import StrEnum


class StallUse(StrEnum):
    """Use of a stall."""

    STANDARD = "standard"
    TURNING = "turning"
    """Turning bay, kept free at the end of a long dead-end aisle."""
    EV = "ev"
    """Stall with a charger for electric cars."""
    ACCESSIBLE = "accessible"
    """Stall for people with a disability, beside an access aisle."""
    ACCESS_AISLE = "access_aisle"
    """Hatched access aisle for wheelchairs, kept free beside accessible stalls."""
    UNREACHABLE = "unreachable"
    """Hatched stall, kept free because cars cannot drive into it and out of it."""
    MOTORCYCLE = "motorcycle"
    """Stall of the size class for motorcycles."""

    @property
    def takes_cars(self) -> bool:
        """True if cars park in a stall of this use."""
        return self.is_parked_in and self is not StallUse.MOTORCYCLE

    @property
    def is_parked_in(self) -> bool:
        """True if vehicles of any kind park in a stall of this use."""
        return self not in {StallUse.TURNING, StallUse.ACCESS_AISLE, StallUse.UNREACHABLE}


class StallKind(StrEnum):
    """Orientation of a stall relative to its lane."""

    PERPENDICULAR = "perpendicular"
    """Perpendicular to the lane, and at least as long as wide."""
    PARALLEL = "parallel"
    """Parallel to the lane: square to its mouth, and wider than long."""
    ANGLED = "angled"
    """At an angle to the lane: its sides are not square to its mouth."""
