"""Rules of clearance around a parked car: the design car in the middle of each stall, its nose at the mouth."""

import math
from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.solids import Solid
from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook, where_laid_out
from garage2usd.garage import Point, Stall, StallKind
from garage2usd.layout.grounds import Grounds, grounds_of
from garage2usd.profiles import Profile

BOOK = RuleBook()
_WALLS = {"wall", "obstacle"}
_ONE_BAY = 1.5
"""Greatest distance between the two columns of a bay, as a multiple of the column grid."""
_FOOT_M = 0.5
"""Greatest height of a column's lower end, and greatest distance of a column from the line of stall mouths; metres."""


@dataclass(frozen=True)
class _ParkedCars:
    """The design car parked in each stall that takes cars."""

    garage: BuiltLevel
    profile: Profile

    @cached_property
    def stalls(self) -> tuple[Stall, ...]:
        """The stalls that take the design car."""
        return tuple(stall for stall in self.garage.parking_stalls if not stall.is_compact)

    def grounds(self, *, beside_m: float = 0.0, behind_m: float = 0.0) -> Grounds:
        """Return each parked car's footprint, widened on both sides and lengthened behind; shape (stalls,)."""
        backwards = np.array([stall.backwards for stall in self.stalls]).reshape(-1, 2)
        tail = np.array([self._tail(stall) for stall in self.stalls]).reshape(-1, 2)
        across = np.stack([-backwards[:, 1], backwards[:, 0]], axis=1) * (self.profile.car_width_m / 2 + beside_m)
        nose = tail - backwards * (self.profile.car_length_m + behind_m)
        return grounds_of(np.stack([tail + across, tail - across, nose - across, nose + across], axis=1))

    def _tail(self, stall: Stall) -> Point:
        """Return the middle of the car's tail.

        It is at the mouth of a perpendicular stall. In a parallel stall the car has equal room at both ends. In an
        angled one it stands as far in as the clearance to a wall along the rear lets it.
        """
        (x, z), (back_x, back_z) = stall.tail, stall.backwards
        spare_m = max(stall.length_m - self.profile.car_length_m, 0.0)
        if stall.kind is StallKind.PERPENDICULAR:
            inwards_m = 0.0
        elif stall.kind is StallKind.PARALLEL:
            inwards_m = (stall.length_m - self.profile.car_length_m) / 2
        elif self.profile.end_clearance is None:
            inwards_m = spare_m / 2
        else:
            angle, beside_m = math.radians(stall.slant_deg), (stall.width_m - self.profile.car_width_m) / 2
            behind_m = (self.profile.end_clearance.amount - beside_m * math.cos(angle)) / math.sin(angle)
            inwards_m = min(max(spare_m - behind_m, 0.0), spare_m)
        return x - inwards_m * back_x, z - inwards_m * back_z


@BOOK.rule(
    "column-clearance",
    "column_clearance",
    "design_car_length",
    "design_car_width",
    asks="the design car in a stall keeps away from columns",
    hindrance=where_laid_out,
)
def _columns(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    cars, clause = _ParkedCars(level, profile), profile.column_clearance
    if clause:
        near = level.solids.standing_at_each(cars.grounds(), within_m=clause.amount)
        yield from _closest(cars, near, {"column"}, clause.amount, "a column")


@BOOK.rule(
    "wall-clearance",
    "wall_clearance",
    "design_car_length",
    "design_car_width",
    asks="the design car in a stall keeps away from the walls beside it",
    hindrance=where_laid_out,
)
def _walls(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    cars, clause = _ParkedCars(level, profile), profile.wall_clearance
    if clause:
        # a wall that the rear touches is not beside the car
        near = level.solids.standing_at_each(cars.grounds(beside_m=clause.amount, behind_m=-ROUNDING_M))
        yield from _closest(cars, near, _WALLS, clause.amount, "the wall beside")


@BOOK.rule(
    "end-clearance",
    "end_clearance",
    "design_car_length",
    "design_car_width",
    asks="the design car in a stall keeps away from what stands behind it",
    hindrance=where_laid_out,
)
def _ends(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    cars, clause = _ParkedCars(level, profile), profile.end_clearance
    if clause:
        near = level.solids.standing_at_each(cars.grounds(behind_m=clause.amount))
        yield from _closest(cars, near, _WALLS, clause.amount, "the wall behind")


@BOOK.rule(
    "column-spacing",
    "column_spacing",
    asks="columns stand as far apart as the grid wants where cars park between",
    hindrance=where_laid_out,
)
def _spacing(level: BuiltLevel, profile: Profile) -> Iterator[Miss]:
    if profile.column_spacing is None:
        return
    least, most = profile.column_spacing.bounds
    seen: set[float] = set()
    columns = [solid for solid in level.solids.standing("column") if solid.bottom_m < _FOOT_M]
    places = np.array([(column.footprint.centroid.x, column.footprint.centroid.y) for column in columns]).reshape(-1, 2)
    for stall in level.parking_stalls:
        measured = _between_columns(stall, places)
        if (
            measured is None
            or measured > _ONE_BAY * most
            or least - ROUNDING_M <= measured <= most + ROUNDING_M
            or round(measured, 2) in seen
        ):
            continue
        seen.add(round(measured, 2))
        required = least if measured < least else most
        yield Miss(stall.name, stall.mouth, "the columns beside the stalls keep another grid", measured, required)


def _between_columns(stall: Stall, places: NDArray[np.float64]) -> float | None:
    """Return the centre distance of the two columns beside a stall's mouth; None without two."""
    outwards = np.array(stall.outwards)
    offset = places - np.array(stall.mouth)
    ahead = offset @ outwards
    # columns that are set back from the mouths stand in the front half of the stalls
    depth_m = 0.0 if stall.kind is StallKind.ANGLED else math.dist(stall.corners[1], stall.corners[2])
    beside = (ahead < _FOOT_M) & (ahead > -max(_FOOT_M, depth_m / 2))
    along = (offset @ np.array([-outwards[1], outwards[0]]))[beside]
    left, right = along[along < 0], along[along > 0]
    return float(right.min() - left.max()) if len(left) and len(right) else None


def _closest(
    cars: _ParkedCars, near: Iterable[list[Solid]], labels: Container[str], required: float, what: str
) -> Iterator[Miss]:
    """Yield parked cars too close to pieces of some labels, except pieces inside the car's own stall."""
    rows: list[tuple[int, Solid]] = []
    for number, (stall, solids) in enumerate(zip(cars.stalls, near, strict=True)):
        inside = {solid.name for solid in cars.garage.standing_in_stalls[stall]}
        rows += [(number, solid) for solid in solids if solid.label in labels and solid.name not in inside]
    beside = cars.grounds()[np.array([number for number, _ in rows], dtype=np.intp)]
    distances = shapely.distance(beside, [solid.footprint for _, solid in rows]).tolist()
    closest: dict[int, tuple[float, str]] = {}
    for (number, solid), distance in zip(rows, distances, strict=True):
        closest[number] = min(closest.get(number, (math.inf, "")), (distance, solid.name))
    for number, (measured, name) in closest.items():
        if measured < required - ROUNDING_M:
            stall = cars.stalls[number]
            message = f"a car in the stall comes too close to {what}: {name}"
            yield Miss(stall.name, stall.centre, message, measured, required, (name,))
