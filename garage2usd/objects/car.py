"""Parked cars."""

from dataclasses import dataclass, field, replace
from typing import Self

from garage2usd.assets.car_boot import open_boot_box, with_open_boot
from garage2usd.assets.car_wheels import steered, steered_box
from garage2usd.assets.cars import car, dusty, lit
from garage2usd.assets.mesh import Asset
from garage2usd.assets.own_car import own_car
from garage2usd.config.own_cars import OwnCar
from garage2usd.config.vehicles import PAINTS, CarBody, body_named
from garage2usd.objects.kind import Kind, Look, Spec, TilePart, VariantSet
from garage2usd.objects.outline import Polygon, rectangle

__all__ = ["CAR_KINDS", "KIND", "PAINT_SET", "CarSpec", "OpenCarSpec", "OwnCarSpec", "car_spec"]

KIND = Kind("car", number=16, label="car", cityscapes="car", follows=VariantSet.OCCUPANCY, part=TilePart.PARKING)
_VAN = replace(KIND, number=46, label="van")
_TRUCK = replace(KIND, number=47, label="truck", cityscapes="truck")
CAR_KINDS = (KIND, _VAN, _TRUCK)
"""The kinds of parked vehicles: all are cars to layouts and reports, each has a semantic class of its own."""

PAINT_SET = "paint"
"""Variant set of every car's asset."""
_ARCHES_M = 0.01
"""How far the wheel arches stand out of a car's body."""
_DENSITY_KG_M3 = 120.0
_HALF_MIRROR_M = 0.1
"""Of a car's mirrors, along it."""


@dataclass(frozen=True)
class CarSpec(Spec, kind=KIND):
    """A parked car; origin in the middle of its footprint, nose to -Z.

    Attributes
    ----------
    body, paint
        Keys of the catalogue.
    steer_deg
        How far its front wheels are turned to the left, at most `garage2usd.assets.car_wheels.MOST_STEER_DEG` either
        way.
    is_dusty
        Whether its flanks are covered with dust.
    is_lit
        Whether its head and tail lamps glow.
    """

    body: str
    paint: str
    steer_deg: float = 0.0
    is_dusty: bool = False
    is_lit: bool = False

    @property
    def measures(self) -> CarBody:
        """Its measures, whether it is of the catalogue or a model of one's own."""
        return body_named(self.body)

    @property
    def shape(self) -> Self:
        """The same body in the first paint, as the paints are variants of one asset."""
        return replace(self, paint=PAINTS[0])

    @property
    def look(self) -> Look:
        """Its paint."""
        return ((PAINT_SET, self.paint),)

    @property
    def mass_kg(self) -> float:
        """Mass at 120 kg/m3 of the box around the body, an assumption: 1,480 kg for the saloon."""
        body = self.measures
        return round(_DENSITY_KG_M3 * body.length_m * body.width_m * body.height_m, -1)

    @property
    def plain(self) -> "CarSpec":
        """The same shape as it comes from the factory: wheels straight, clean, and lamps off."""
        return replace(self.shape, steer_deg=0.0, is_dusty=False, is_lit=False)

    def asset(self) -> Asset:
        """The body with its wheels, dust and lamps, in every paint."""
        return self.asset_from(car(self.measures))

    def asset_from(self, plain: Asset) -> Asset:
        """The asset made from that of the `plain` shape."""
        body = self.measures
        asset = steered(plain, body, self.steer_deg)
        if self.is_dusty:
            asset = dusty(asset, body)
        return lit(asset) if self.is_lit else asset

    def outlines(self) -> tuple[Polygon, ...]:
        """Its body with the wheel arches, its mirrors, and its front wheels where they are turned."""
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
    """A parked car of the catalogue whose boot is open, if it has one: see `garage2usd.assets.car_boot.has_boot`."""

    @property
    def plain(self) -> CarSpec:
        """The same body with its boot closed."""
        return CarSpec(self.body, PAINTS[0])

    def asset_from(self, plain: Asset) -> Asset:
        """The asset made from that of the `plain` shape, with its tailgate or boot lid up."""
        return with_open_boot(super().asset_from(plain), self.measures)

    def outlines(self) -> tuple[Polygon, ...]:
        """Those of the car, and a rectangle below what is swung up."""
        side, first, last = open_boot_box(self.measures)
        return *super().outlines(), rectangle(-side, first, side, last)


@dataclass(frozen=True)
class OwnCarSpec(CarSpec):
    """A parked car that is a model of one's own; origin and axes as those of all cars.

    Attributes
    ----------
    model
        The car; its paint is that of its file.
    """

    model: OwnCar = field(kw_only=True)

    @property
    def measures(self) -> CarBody:
        """As they were found in its file, or given."""
        return self.model

    @property
    def shape(self) -> Self:
        """Itself."""
        return self

    @property
    def look(self) -> Look:
        """None: it has the colours of its file."""
        return ()

    def asset(self) -> Asset:
        """Its meshes with their materials; raises ConfigError where the file has changed."""
        return own_car(self.model)

    def outlines(self) -> tuple[Polygon, ...]:
        """Its body, and its mirrors where they are known."""
        return self.model.outlines


@dataclass(frozen=True)
class _OwnVanSpec(OwnCarSpec, kind=_VAN):
    """A model of the class van."""


@dataclass(frozen=True)
class _OwnTruckSpec(OwnCarSpec, kind=_TRUCK):
    """A model of the class truck."""


def car_spec(car: CarBody, paint: str) -> CarSpec:
    """A car of the catalogue in a paint, or a model of one's own in that of its file."""
    if not isinstance(car, OwnCar):
        return CarSpec(car.name, paint)
    spec = {spec.kind.label: spec for spec in (OwnCarSpec, _OwnVanSpec, _OwnTruckSpec)}[car.semantic_class]
    return spec(car.name, paint, model=car)
