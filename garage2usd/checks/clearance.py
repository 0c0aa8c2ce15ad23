"""Rules of the room around a parked car: the design car in the middle of each stall, its nose at the mouth."""

from collections.abc import Container, Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.checks.rule import ROUNDING_M, Miss, RuleBook
from garage2usd.checks.solids import Solid
from garage2usd.checks.subject import Subject
from garage2usd.profiles import Length, Profile
from garage2usd.reading.ground import StallOutline

__all__ = ["BOOK"]

BOOK = RuleBook()
_WALLS = {"wall", "obstacle"}
_ONE_BAY = 1.5
"""Columns farther apart than so many times the grid are not those of one bay."""
_FOOT_M = 0.5
"""How high a column's lowest piece begins, and how far from the line of mouths it stands, at most."""


@dataclass(frozen=True)
class _ParkedCar:
    """The design car in a stall."""

    stall: StallOutline
    length_m: float
    width_m: float

    @property
    def polygon(self) -> shapely.Polygon:
        """Its ground."""
        return self.ground()

    def ground(self, *, beside_m: float = 0.0, behind_m: float = 0.0) -> shapely.Polygon:
        """Its ground, and as much more on both sides and behind."""
        outwards = np.array(self.stall.outwards)
        across = np.array([-outwards[1], outwards[0]]) * (self.width_m / 2 + beside_m)
        nose = np.array(self.stall.mouth)
        rear = nose - outwards * (self.length_m + behind_m)
        return shapely.Polygon([nose + across, nose - across, rear - across, rear + across])


@BOOK.rule(
    "column-clearance",
    "column_clearance",
    "design_car_length",
    "design_car_width",
    asks="the design car in a stall keeps away from columns",
)
def _columns(subject: Subject, profile: Profile) -> Iterator[Miss]:
    for car, required in _parked(subject, profile, profile.column_clearance):
        near = subject.solids.at(car.polygon, within_m=required)
        yield from _closest(car, near, {"column"}, required, "a column", subject)


@BOOK.rule(
    "wall-clearance",
    "wall_clearance",
    "design_car_length",
    "design_car_width",
    asks="the design car in a stall keeps away from the walls beside it",
)
def _walls(subject: Subject, profile: Profile) -> Iterator[Miss]:
    for car, required in _parked(subject, profile, profile.wall_clearance):
        near = subject.solids.at(car.ground(beside_m=required))
        yield from _closest(car, near, _WALLS, required, "the wall beside", subject)


@BOOK.rule(
    "end-clearance",
    "end_clearance",
    "design_car_length",
    "design_car_width",
    asks="the design car in a stall keeps away from what stands behind it",
)
def _ends(subject: Subject, profile: Profile) -> Iterator[Miss]:
    for car, required in _parked(subject, profile, profile.end_clearance):
        near = subject.solids.at(car.ground(behind_m=required))
        yield from _closest(car, near, _WALLS, required, "the wall behind", subject)


@BOOK.rule(
    "column-spacing", "column_spacing", asks="columns stand as far apart as the grid wants where cars park between"
)
def _spacing(subject: Subject, profile: Profile) -> Iterator[Miss]:
    if profile.column_spacing is None:
        return
    least, most = profile.column_spacing.bounds
    seen: set[float] = set()
    columns = [solid for solid in subject.solids.standing("column") if solid.bottom_m < _FOOT_M]
    places = np.array([(column.footprint.centroid.x, column.footprint.centroid.y) for column in columns]).reshape(-1, 2)
    for stall in subject.parking_stalls:
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


def _between_columns(stall: StallOutline, places: NDArray[np.float64]) -> float | None:
    """Distance of the next columns on both sides of a stall's mouth, from middle to middle; None without two."""
    outwards = np.array(stall.outwards)
    offset = places - np.array(stall.mouth)
    beside = np.abs(offset @ outwards) < _FOOT_M
    along = (offset @ np.array([-outwards[1], outwards[0]]))[beside]
    left, right = along[along < 0], along[along > 0]
    return float(right.min() - left.max()) if len(left) and len(right) else None


def _parked(subject: Subject, profile: Profile, clause: Length | None) -> Iterator[tuple[_ParkedCar, float]]:
    """A car in each stall, and the room around it that a clause asks for in metres; none without a clause."""
    length, width = profile.design_car_length, profile.design_car_width
    if clause is None or length is None or width is None:
        return
    for stall in subject.parking_stalls:
        yield _ParkedCar(stall, length.amount, width.amount), clause.amount


def _closest(
    car: _ParkedCar, near: Iterable[Solid], labels: Container[str], required: float, what: str, subject: Subject
) -> Iterator[Miss]:
    """The least distance of a car to pieces of some labels; those that stand in its stall have rules of their own."""
    inside = {solid.name for solid in subject.standing_in_stalls[car.stall]}
    distances = [
        (car.polygon.distance(solid.footprint), solid.name)
        for solid in near
        if solid.label in labels and solid.name not in inside
    ]
    if distances:
        measured, name = min(distances)
        if measured < required - ROUNDING_M:
            message = f"a car in the stall comes too close to {what}: {name}"
            yield Miss(car.stall.name, car.stall.centre, message, measured, required, (name,))
