"""Settings of the kinds of stall: perpendicular, angled and parallel ones, and classes of size."""

from enum import StrEnum
from typing import Annotated, Literal, Self

from pydantic import BeforeValidator, Field, model_validator

from garage2usd.common.settings import Settings
from garage2usd.config.site import Side, SquareIndex
from garage2usd.garage.kinds import StallKind

FREE = "free"
"""Kinds that planning chooses."""

Share = Annotated[float, Field(ge=0, le=1)]
WidthM = Annotated[float, Field(ge=0.8, le=6)]
LengthM = Annotated[float, Field(ge=1.8, le=12)]
AngleDeg = Annotated[float, Field(ge=30, le=85)]


def _free_or_shares(value: object) -> object:
    if isinstance(value, str) and value != FREE:
        raise ValueError(f"{FREE!r}, or the share of each kind")
    return value


class SizeClass(StrEnum):
    """Size classes of stalls."""

    STANDARD = "standard"
    """`bay.stall_width_m` by `bay.stall_length_m`."""
    COMPACT = "compact"
    LARGE = "large"
    VAN = "van"
    MOTORCYCLE = "motorcycle"
    """For motorcycles alone, perpendicular to the lane."""

    @property
    def takes_cars(self) -> bool:
        """True if cars park in stalls of the class."""
        return self is not SizeClass.MOTORCYCLE


_SIZES_M = {
    SizeClass.COMPACT: (2.3, 4.9),
    SizeClass.LARGE: (2.6, 5.5),
    SizeClass.VAN: (3.0, 6.0),
    SizeClass.MOTORCYCLE: (1.2, 2.5),
}
"""Usual widths and lengths; assumptions, except those of compact stalls, near the 8 by 16 ft of US towns, and of stalls
for motorcycles, of AS/NZS 2890.1."""
_LEAST_CAR_M = (1.8, 3.5)
"""Least width and length of a stall for cars."""


class GivenRun(Settings):
    """The stalls of consecutive squares along a lane, instead of drawn ones."""

    first: SquareIndex
    """(row, col) of the square at one end, the one nearer to [0, 0]."""
    last: SquareIndex
    """(row, col) of the square at the other end, on the same line."""
    edge: Side
    """The side of the squares that the stalls open to, where the lane is."""
    kind: StallKind = StallKind.PERPENDICULAR
    """'perpendicular', 'angled' or 'parallel'."""
    angle_deg: AngleDeg | None = None
    """Angle of angled stalls to the lane."""
    size: SizeClass = SizeClass.STANDARD
    """Size class of the stalls."""
    leans: Literal["with traffic", "against traffic"] = "with traffic"
    """Direction in which angled stalls are entered."""

    @model_validator(mode="after")
    def _in_a_line(self) -> Self:
        axis = int(self.edge in {"up", "down"})
        if self.first[1 - axis] != self.last[1 - axis] or self.first[axis] > self.last[axis]:
            raise ValueError(f"squares from first to last along one {'row' if axis else 'column'}")
        if (self.kind is StallKind.ANGLED) != (self.angle_deg is not None):
            raise ValueError("angle_deg for angled stalls, and for these only")
        if not self.size.takes_cars and self.kind is not StallKind.PERPENDICULAR:
            raise ValueError("kind = 'perpendicular' for stalls for motorcycles")
        return self


class StallsConfig(Settings):
    """Shares of the kinds and sizes of stalls. By default all stalls are perpendicular and of one size."""

    kinds: Annotated[dict[StallKind, Share] | Literal["free"], BeforeValidator(_free_or_shares)] = Field(
        {StallKind.PERPENDICULAR: 1.0}
    )
    """Share of the stalls of each kind, 'perpendicular', 'angled' and 'parallel'; in proportion to their sum. A kind
    that does not fit a place takes no part there. 'free': the kind with the least floor per stall in this garage."""
    angles_deg: tuple[AngleDeg, ...] = Field((60.0, 45.0, 75.0), min_length=1)
    """Angles of angled stalls to the lane, from which each run of stalls draws one; where kinds are 'free', those from
    which the garage gets one."""
    sizes: dict[SizeClass, Share] = Field({SizeClass.STANDARD: 1.0})
    """Share of the stalls of each size class, 'standard', 'compact', 'large', 'van' and 'motorcycle', likewise. Those
    for motorcycles are perpendicular, whatever the kinds of the others."""
    sizes_m: dict[SizeClass, tuple[WidthM, LengthM]] = Field({})
    """Width and length of a class, instead of the usual ones; those of the standard class are in `bay`."""
    parallel_length_m: float | None = Field(None, ge=4.5, le=10)
    """Length of parallel stalls of the standard class; left out, that of the profile, or 6 m. Those of another class
    are longer or shorter by as much as its perpendicular stalls."""
    runs: tuple[GivenRun, ...] = ()
    """Stalls that are given instead of drawn."""
    only_runs: bool = False
    """True if all stalls are given, so that squares outside `runs` have none."""

    @model_validator(mode="after")
    def _some_of_each(self) -> Self:
        for name, shares in (("kinds", self._kinds), ("sizes", self.sizes)):
            if not sum(shares.values()) > 0:
                raise ValueError(f"{name} with a share above 0")
        if SizeClass.STANDARD in self.sizes_m:
            raise ValueError("bay.stall_width_m and bay.stall_length_m for the size of standard stalls")
        if self.only_runs and not self.runs:
            raise ValueError("some runs where only_runs is true")
        if not any(share for size, share in self.sizes.items() if size.takes_cars):
            raise ValueError("sizes with a share above 0 for a class of cars, beside that of motorcycles")
        if self.only_runs and not any(run.size.takes_cars for run in self.runs):
            raise ValueError("some runs for cars where only_runs is true")
        for size, sides_m in self.sizes_m.items():
            if size.takes_cars and (sides_m[0] < _LEAST_CAR_M[0] or sides_m[1] < _LEAST_CAR_M[1]):
                least = " by ".join(map(str, _LEAST_CAR_M))
                raise ValueError(f"sizes_m.{size} of at least {least} m")
        return self

    @property
    def is_free(self) -> bool:
        """True if planning chooses the kind of the stalls that are not given."""
        return self.kinds == FREE and not self.only_runs

    @property
    def _kinds(self) -> dict[StallKind, float]:
        """Shares of the kinds; perpendicular stalls alone where the kind is to be chosen."""
        return {StallKind.PERPENDICULAR: 1.0} if isinstance(self.kinds, str) else self.kinds

    def of_kind(self, kind: StallKind, angle_deg: float | None = None) -> "StallsConfig":
        """Return the settings with all drawn stalls of one kind, angled ones at one angle."""
        angles = {} if angle_deg is None else {"angles_deg": (angle_deg,)}
        return self.model_copy(update={"kinds": {kind: 1.0}, **angles})

    @property
    def is_uniform(self) -> bool:
        """True if all stalls are perpendicular and of the standard class."""
        drawn = tuple({key for key, share in shares.items() if share} for shares in (self._kinds, self.sizes))
        return drawn == ({StallKind.PERPENDICULAR}, {SizeClass.STANDARD}) and not self.runs

    def size_m(self, size: SizeClass, standard_m: tuple[float, float]) -> tuple[float, float]:
        """Return the width and length of a size class, given those of the standard one."""
        return {**_SIZES_M, **self.sizes_m, SizeClass.STANDARD: standard_m}[size]

    @property
    def shares(self) -> dict[tuple[StallKind, SizeClass], float]:
        """Share of the stalls of each kind and size; their sum is 1."""
        total = sum(self._kinds.values()) * sum(self.sizes.values())
        shares = {
            (kind, size): of_kind * of_size / total
            for kind, of_kind in self._kinds.items()
            for size, of_size in self.sizes.items()
            if of_kind and of_size and size.takes_cars
        }
        if of_motorcycles := self.sizes.get(SizeClass.MOTORCYCLE):
            shares[StallKind.PERPENDICULAR, SizeClass.MOTORCYCLE] = of_motorcycles / sum(self.sizes.values())
        return shares
