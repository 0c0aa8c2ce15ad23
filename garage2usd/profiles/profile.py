"""A profile: the clauses of a standard, for the design and the checks of a garage."""

import difflib
from collections.abc import Iterator
from typing import Any

from pydantic import Field, field_validator, model_validator

from garage2usd.common.documents import shipped_toml
from garage2usd.common.settings import Settings
from garage2usd.profiles.clauses import (
    Area,
    Clause,
    Count,
    Illuminance,
    Length,
    LengthRange,
    LengthsByAngle,
    Ratio,
    Steps,
)

PROFILE_NAMES = ("cn-jgj100", "de-garvo", "uk-istructe", "us-ada")
"""Names of the shipped profiles."""

USUAL_CAR_LENGTH_M, USUAL_CAR_WIDTH_M = 4.8, 1.8
"""Measures of the design car if a profile gives none: the small car of JGJ 100."""
_LEFT_HAND_TRAFFIC = frozenset({"AU", "GB", "HK", "IE", "IN", "JP", "MT", "MY", "NZ", "SG", "TH", "ZA"})
_TRANSITION_SLOPE_PERCENT, _TRANSITION_LENGTH_M = 10.0, 3.6
"""Transition of ramps, for a profile that gives only its slope or only its length."""


def shipped_settings(name: str) -> dict[str, Any]:
    """Return the contents of the file of a shipped profile."""
    return shipped_toml("garage2usd.profiles", name)


def nearest_profile(given: str) -> str:
    """Return the name of the shipped profile that is most similar to a name."""
    return difflib.get_close_matches(given.lower(), PROFILE_NAMES, n=1, cutoff=0.0)[0]


class Profile(Settings):
    """The clauses of a standard; a clause that is left out requires nothing.

    A report says "checked against" a profile; it is no certificate.
    """

    name: str = Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$")
    """Short name of the profile."""
    title: str = Field("", max_length=500)
    """Title of the standard that the profile follows."""
    country: str = Field("", pattern=r"^([A-Z]{2})?$")
    """ISO 3166 code of the country whose signs are used if `look.signs.of` is 'profile': CN, DE, GB and US are known,
    all others have international signs."""
    based_on: str | None = Field(None, exclude=True)
    """Name of the shipped profile that this one changes: its clauses hold, except for those given here."""

    design_car_length: Length | None = None
    """Length of the car that a stall is designed for."""
    design_car_width: Length | None = None
    """Width of the design car, without mirrors."""
    design_car_height: Length | None = None
    """Height of the design car."""
    turning_radius: Length | None = None
    """Least turning radius of the design car."""

    stall_width: Length | None = None
    """Least width of a stall at right angles to its aisle."""
    stall_length: Length | None = None
    """Least length of a stall at right angles to its aisle."""
    parallel_stall_width: Length | None = None
    """Least width of a stall parallel to its aisle."""
    parallel_stall_length: Length | None = None
    """Least length of a stall parallel to its aisle."""
    compact_stall_width: Length | None = None
    """Least width of a stall for compact cars at right angles to its aisle."""
    compact_stall_length: Length | None = None
    """Least length of a stall for compact cars at right angles to its aisle."""
    compact_share: Ratio | None = None
    """Greatest share of stalls for compact cars."""
    motorcycle_stall_width: Length | None = None
    """Least width of a stall for motorcycles."""
    motorcycle_stall_length: Length | None = None
    """Least length of it."""
    wall_clearance: Length | None = None
    """Least distance of the design car's sides from walls."""
    end_clearance: Length | None = None
    """Least distance of the design car's front and rear from objects before and behind it."""
    column_clearance: Length | None = None
    """Least distance of the design car from columns."""
    column_spacing: LengthRange | None = None
    """Distance of the columns at the two ends of a row of stalls."""

    aisle_width: Length | None = None
    """Least clear width of an aisle that serves stalls at right angles to it."""
    angled_aisle_widths: LengthsByAngle | None = None
    """Least clear width of an aisle that serves angled stalls, by their angle to it."""
    parallel_aisle_width: Length | None = None
    """Least clear width of an aisle that serves parallel stalls."""
    dead_end_length: Length | None = None
    """Length over which a dead-end aisle keeps a turning stall free."""

    dead_end_depth: Length | None = None
    """Greatest depth of a dead end with all its branches, even if it keeps a turning stall free."""
    loops: Steps | None = None
    """Least number of loops in the lane graph, which let a car drive round again."""
    stretch_length: Length | None = None
    """Longest stretch of lanes between two junctions, or a junction and a portal."""
    lane_field_width: Length | None = None
    """Greatest clear width of adjacent parallel lanes."""

    clear_height: Length | None = None
    """Least clear height: nothing hangs lower."""
    van_clear_height: Length | None = None
    """Least clear height on the paths to and from van-accessible stalls."""

    portals: Steps | None = None
    """Least number of vehicle entrances and exits together."""
    portal_distance: Length | None = None
    """Distance between two portals, which must be exceeded."""
    portal_width: Length | None = None
    """Least clear width of a portal with one-way traffic."""

    ramp_slope: Ratio | None = None
    """Greatest slope of a straight ramp."""
    curved_ramp_slope: Ratio | None = None
    """Greatest slope of a ramp in a bend, here taken along the inner edge."""
    ramp_transition_slope: Ratio | None = None
    """Slope above which a ramp needs transitions at its foot and its top."""
    ramp_transition_length: Length | None = None
    """Least length of each transition."""

    accessible_stalls: Steps | None = None
    """Least number of accessible stalls."""
    accessible_stall_width: Length | None = None
    """Least width of an accessible stall."""
    access_aisle_width: Length | None = None
    """Least width of the access aisle beside an accessible stall."""
    stalls_per_van_stall: Count | None = None
    """One in this number of accessible stalls, and at least one, takes vans."""
    van_stall_width: Length | None = None
    """Least width of a van-accessible stall."""
    van_access_aisle_width: Length | None = None
    """Width of the access aisle at which any accessible stall takes vans."""

    lane_illuminance: Illuminance | None = None
    """Least mean illuminance of the lanes' floor."""
    stall_illuminance: Illuminance | None = None
    """Least mean illuminance of the stalls' floor."""

    fire_compartment_area: Area | None = None
    """Largest fire compartment without sprinklers."""
    fire_compartment_area_sprinklered: Area | None = None
    """Largest fire compartment with sprinklers."""
    personnel_exits: Count | None = None
    """Least number of exits on foot."""
    exit_distance: Length | None = None
    """Greatest distance of a stall from an exit on foot without sprinklers."""
    exit_distance_sprinklered: Length | None = None
    """Greatest distance of a stall from an exit on foot with sprinklers."""

    hydrant_reach: Length | None = None
    """Greatest distance of a stall or a lane from the two nearest fire hydrants."""
    hydrant_spacing: Length | None = None
    """Greatest distance of a fire hydrant from the next one."""
    extinguisher_distance: Length | None = None
    """Greatest distance of a stall or a lane from the nearest fire extinguisher, walked along X and then along Z."""

    speed_bump_height: Length | None = None
    """Greatest height of a speed bump."""
    wheel_stop_height: Length | None = None
    """Greatest height of a wheel stop."""

    @model_validator(mode="before")
    @classmethod
    def _with_base(cls, given: Any) -> Any:  # noqa: ANN401 - pydantic's own signature
        """Add the clauses of the profile that this one is based on."""
        base = given.get("based_on") if isinstance(given, dict) else None
        return {**shipped_settings(base), **given, "based_on": None} if base in PROFILE_NAMES else given

    @field_validator("based_on")
    @classmethod
    def _is_shipped(cls, base: str | None) -> str | None:
        if base is not None:
            raise ValueError(f"one of {', '.join(PROFILE_NAMES)}; the nearest is {nearest_profile(base)}")
        return base

    def clauses(self) -> Iterator[tuple[str, Clause]]:
        """Yield name and clause of every clause that is given."""
        for name in type(self).model_fields:
            clause = getattr(self, name)
            if isinstance(clause, Clause):
                yield name, clause

    @property
    def drives_on_left(self) -> bool:
        """True if traffic in the profile's country keeps to the left."""
        return self.country in _LEFT_HAND_TRAFFIC

    @property
    def car_length_m(self) -> float:
        """Length of the design car in metres."""
        return self.design_car_length.amount if self.design_car_length else USUAL_CAR_LENGTH_M

    @property
    def car_width_m(self) -> float:
        """Width of the design car in metres, without mirrors."""
        return self.design_car_width.amount if self.design_car_width else USUAL_CAR_WIDTH_M

    @property
    def transition_slope_percent(self) -> float:
        """Slope in percent above which a ramp needs transitions; meaningful only if `transition_length_m` is not 0."""
        clause = self.ramp_transition_slope
        return clause.amount if clause else _TRANSITION_SLOPE_PERCENT

    @property
    def transition_length_m(self) -> float:
        """Least length in metres of a ramp's transitions; 0 if none are required."""
        if self.ramp_transition_length:
            return self.ramp_transition_length.amount
        return _TRANSITION_LENGTH_M if self.ramp_transition_slope else 0.0

    def compartment_area(self, *, sprinklered: bool) -> Area | None:
        """The clause on the largest fire compartment; without a clause for sprinklers, the plain one."""
        return (self.fire_compartment_area_sprinklered if sprinklered else None) or self.fire_compartment_area

    def way_out(self, *, sprinklered: bool) -> Length | None:
        """The clause on the distance to an exit on foot; without a clause for sprinklers, the plain one."""
        return (self.exit_distance_sprinklered if sprinklered else None) or self.exit_distance
