"""Country of the signs: texts and colours of exit signs, signs of levels, hydrant cabinets and portals."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from garage2usd.assets.countries import Country
from garage2usd.config.look import SignsLook, SignsOf
from garage2usd.layout.placement import Placement
from garage2usd.objects.exit_sign import ExitSignSpec
from garage2usd.objects.hydrant_cabinet import HydrantCabinetSpec
from garage2usd.objects.level_plate import LevelPlateSpec
from garage2usd.objects.level_sign import LevelSignSpec
from garage2usd.objects.portal import PortalSpec
from garage2usd.profiles import Profile

__all__ = ["country_of", "with_signs_of"]

_IN_WORDS = ExitSignSpec | HydrantCabinetSpec | LevelPlateSpec | LevelSignSpec | PortalSpec


def country_of(signs: SignsLook, profile: Profile) -> Country:
    """Return the country of a garage's signs, by its look and profile."""
    is_known = signs.of is SignsOf.PROFILE and profile.country in set(Country)
    return Country(profile.country) if is_known else Country.NONE


def with_signs_of(country: Country, parts: Iterable[Iterable[Placement]]) -> Iterator[Iterable[Placement]]:
    """Set the country of all signs among the objects, for its texts, colours and numbers."""
    for part in parts:
        yield (
            replace(each, spec=replace(each.spec, country=country))
            if country and isinstance(each.spec, _IN_WORDS)
            else each
            for each in part
        )
