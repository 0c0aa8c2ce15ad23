"""Parked cars, vans and trucks."""

from dataclasses import dataclass, field, replace
from typing import Self

from garage2usd.assets.car_boot import open_boot_box, with_open_boot
from garage2usd.assets.car_wheels import steered, steered_box
from garage2usd.assets.cars import car, dusty, lit
from garage2usd.assets.mesh import Asset
from garage2usd.assets.own_car import own_car
from garage2usd.config.own_cars import OwnCar
from garage2usd.config.vehicles import PAINTS, CarBody, body_named
from garage2usd.objects.kind import Kind, Look, Polygon, Spec, TilePart, VariantSet, rectangle

KIND = Kind("car", number=16, label="car", cityscapes="car", follows=VariantSet.OCCUPANCY, part=TilePart.PARKING)
_VAN = replace(KIND, number=46, label="van")
_TRUCK = replace(KIND, number=47, label="truck", cityscapes="truck")
CAR_KINDS = (KIND, _VAN, _TRUCK)
"""The kinds of parked vehicles: all count as cars in layouts and reports, each with its own semantic class."""

PAINT_SET = "paint"
"""Name of the variant set that holds the paints of a car's asset."""
_ARCHES_M = 0.01
"""Overhang of the wheel arches beyond a car's body, in metres."""
_DENSITY_KG_M3 = 120.0
_HALF_MIRROR_M = 0.1
"""Half the length of a car's mirror along the car, in metres."""


@dataclass(frozen=True)
class CarSpec(Spec, kind=KIND):
    """A parked car; origin in the middle of its footprint, nose to -Z.

    Attributes
    ----------
    body, paint
        Keys of the car catalogue.
    steer_deg
        Angle of the front wheels to the left, at most `garage2usd.assets.car_wheels.MOST_STEER_DEG` either way.
    is_dusty
        True if dust covers the flanks.
    is_lit
        True if the head and tail lamps glow.
    """

    body: str
    paint: str
    steer_deg: float = 0.0
    is_dusty: bool = False
    is_lit: bool = False

    @property
    def measures(self) -> CarBody:
        """Measures of the car, from the catalogue or from the user's model."""
        return body_named(self.body)

    @property
    def shape(self) -> Self:
        """The same car in the first paint, since paints are variants of one asset."""
        return replace(self, paint=PAINTS[0])

    @property
    def look(self) -> Look:
        """Variant of the car's paint."""
        return ((PAINT_SET, self.paint),)

    @property
    def mass_kg(self) -> float:
        """Mass of the car at 120 kg/m3 of its bounding box, an assumption: 1,480 kg for the saloon."""
        body = self.measures
        return round(_DENSITY_KG_M3 * body.length_m * body.width_m * body.height_m, -1)

    @property
    def plain(self) -> "CarSpec":
        """The same car as it left the factory: wheels straight, clean, lamps off."""
        return replace(self.shape, steer_deg=0.0, is_dusty=False, is_lit=False)

    def asset(self) -> Asset:
        """Make the meshes of a car with its wheels, dust and lamps, in every paint."""
        return self.asset_from(car(self.measures))

    def asset_from(self, plain: Asset) -> Asset:
        """Make the car's asset from the asset of its `plain` shape."""
        body = self.measures
        asset = steered(plain, body, self.steer_deg)
        if self.is_dusty:
            asset = dusty(asset, body)
        return lit(asset) if self.is_lit else asset

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the car's body with wheel arches, its mirrors and its steered front wheels."""
        body = self.measures
        side, end, mirrors = body.width_m / 2 + _ARCHES_M, body.length_m / 2, body.overall_width_m / 2
        first, last = body.mirrors_m - _HALF_MIRROR_M, body.mirrors_m + _HALF_MIRROR_M
        outlines = rectangle(-side, -end, side, end), rectangle(-mirrors, first - end, mirrors, last - end)
        if not self.steer_deg:
            return outlines
        wheels, front, rear = steered_box(body, self.steer_deg)
        return *outlines, rectangle(-wheels, front, wheels, rear)


@dataclass(frozen=True)
class OpenCarSpec(CarSpec):
    """A parked catalogue car with an open boot, where `garage2usd.assets.car_boot.has_boot` says that it has one."""

    @property
    def plain(self) -> CarSpec:
        """The same car with its boot closed."""
        return CarSpec(self.body, PAINTS[0])

    def asset_from(self, plain: Asset) -> Asset:
        """Make the car's asset from the asset of its `plain` shape, with the tailgate or boot lid raised."""
        return with_open_boot(super().asset_from(plain), self.measures)

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the car and the rectangle below its raised tailgate or boot lid."""
        side, first, last = open_boot_box(self.measures)
        return *super().outlines(), rectangle(-side, first, side, last)


@dataclass(frozen=True)
class OwnCarSpec(CarSpec):
    """A parked car modelled by the user; origin and axes as for all cars.

    Attributes
    ----------
    model
        The user's car model; its paint is the one in its file.
    """

    model: OwnCar = field(kw_only=True)

    @property
    def measures(self) -> CarBody:
        """Measures of the user's car model, as found in its file or as configured."""
        return self.model

    @property
    def shape(self) -> Self:
        """The spec itself, since a user's car model has no variants."""
        return self

    @property
    def look(self) -> Look:
        """No variants: a user's car model keeps the colours of its file."""
        return ()

    def asset(self) -> Asset:
        """Make the meshes and materials of a user's car model; raise ConfigError if the file has changed."""
        return own_car(self.model)

    def outlines(self) -> tuple[Polygon, ...]:
        """Return the outlines of the user's car body, and of its mirrors where they are known."""
        return self.model.outlines


@dataclass(frozen=True)
class _OwnVanSpec(OwnCarSpec, kind=_VAN):
    """A parked van modelled by the user."""


@dataclass(frozen=True)
class _OwnTruckSpec(OwnCarSpec, kind=_TRUCK):
    """A parked truck modelled by the user."""


def car_spec(car: CarBody, paint: str) -> CarSpec:
    """Return the spec of a parked car: a catalogue car in a paint, or a user's model in the paint of its file."""
    if not isinstance(car, OwnCar):
        return CarSpec(car.name, paint)
    spec = {spec.kind.label: spec for spec in (OwnCarSpec, _OwnVanSpec, _OwnTruckSpec)}[car.semantic_class]
    return spec(car.name, paint, model=car)
