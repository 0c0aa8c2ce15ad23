"""Number plates of parked cars."""

from dataclasses import dataclass, replace
from typing import Self

from garage2usd.assets.car_boot import with_rear_swung_up
from garage2usd.assets.countries import Country
from garage2usd.assets.mesh import Asset
from garage2usd.assets.number_plates import PLATE_STYLES, number_plates
from garage2usd.config.vehicles import CarBody, body_named
from garage2usd.objects.car import CarSpec, OpenCarSpec, OwnCarSpec
from garage2usd.objects.kind import Kind, Spec, TilePart, VariantSet

KIND = Kind(
    "number_plate",
    number=35,
    label="number_plate",
    cityscapes="car",
    is_solid=False,
    follows=VariantSet.OCCUPANCY,
    part=TilePart.PARKING,
)
"""To Cityscapes, whose class of them is drawn in no picture, they are part of the car."""


@dataclass(frozen=True)
class NumberPlateSpec(Spec, kind=KIND):
    """The front and rear number plates of a car; origin as the car's, in the middle of its footprint, nose to -Z."""

    body: str
    text: str
    country: Country = Country.NONE

    @property
    def shape(self) -> Self:
        """The same number plates without text, since texture coordinates of one asset make the difference."""
        return replace(self, text=" " * PLATE_STYLES[self.country].characters)

    @property
    def measures(self) -> CarBody:
        """Measures of the car that carries the number plates."""
        return body_named(self.body)

    def asset(self) -> Asset:
        """Make the meshes of both number plates with their text."""
        return number_plates(self.measures, self.text, self.country)


@dataclass(frozen=True)
class OpenPlateSpec(NumberPlateSpec):
    """The number plates of a catalogue car with an open boot, which carries the rear plate."""

    def asset(self) -> Asset:
        """Make the meshes of both number plates, the rear one swung up with the boot."""
        asset = super().asset()
        return replace(asset, parts=tuple(with_rear_swung_up(part, self.measures) for part in asset.parts))


@dataclass(frozen=True)
class OwnPlateSpec(NumberPlateSpec):
    """The number plates of a car modelled by the user.

    Attributes
    ----------
    car
        Measures of the car, with the places of its plates.
    """

    car: CarBody | None = None

    @property
    def measures(self) -> CarBody:
        """Measures of the user's car that carries the number plates."""
        return self.car or super().measures


def plates_on(car: CarSpec, text: str, country: Country) -> NumberPlateSpec:
    """Return the number plates of a parked car, from the catalogue or from the user's model."""
    if isinstance(car, OwnCarSpec):
        return OwnPlateSpec(car.body, text, country, car.model.measures)
    of = OpenPlateSpec if isinstance(car, OpenCarSpec) else NumberPlateSpec
    return of(car.body, text, country)
