"""A surveyed building: the surveys of its levels in one frame, and the ramps between them."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from garage2usd.common.errors import ConfigError
from garage2usd.garage import Point
from garage2usd.survey.survey import Alignment, Survey, Unplaced, aligned_together, mover


@dataclass(frozen=True)
class SurveyedLevel:
    """A level of a surveyed building.

    Attributes
    ----------
    name
        Its name in the source, such as ``-1`` or ``P2``; unique in the building.
    survey
        Its parts.
    ordinal
        Number by which levels are ordered; the higher one lies above.
    height_m
        Height of its floor above any datum of the building; None if unknown.
    """

    name: str
    survey: Survey
    ordinal: float
    height_m: float | None = None


@dataclass(frozen=True)
class SurveyedRamp:
    """The centre line of a ramp from one level to another, in the direction of driving if it is one-way.

    Attributes
    ----------
    name
        Id in the source.
    points
        (x, z) of two points or more. The ends lie on the lanes that the ramp joins, or at the ends of these.
    levels
        Names of the levels at the first and at the last point.
    width_m
        Width of the carriageway; None if unknown.
    one_way
        True if cars drive along the points only.
    """

    name: str
    points: tuple[Point, ...]
    levels: tuple[str, str]
    width_m: float | None = None
    one_way: bool = False


@dataclass(frozen=True)
class SurveyedBuilding:
    """The levels of an existing garage, in one frame: (x, z) in metres, x to the right, z downwards.

    Attributes
    ----------
    levels
        The levels, in any order; `in_order` puts the top one first.
    ramps
        The ramps between them.
    unread
        Parts of the source that belong to no level and are not in the survey.
    others
        Levels in frames of their own, as floor plans that are drawn beside each other, which are read by name only.
    """

    levels: tuple[SurveyedLevel, ...]
    ramps: tuple[SurveyedRamp, ...] = ()
    unread: tuple[Unplaced, ...] = field(default=(), repr=False)
    others: tuple[SurveyedLevel, ...] = field(default=(), repr=False)

    @classmethod
    def of(cls, survey: "Survey | SurveyedBuilding") -> "SurveyedBuilding":
        """Return a building; a survey is one of a single level without a name."""
        return survey if isinstance(survey, SurveyedBuilding) else cls((SurveyedLevel("", survey, 0.0),))

    @property
    def in_order(self) -> tuple[SurveyedLevel, ...]:
        """The levels, the top one first."""
        return tuple(sorted(self.levels, key=lambda level: -level.ordinal))

    def only(self, name: str) -> "SurveyedBuilding":
        """Return the building of one level alone, whose ramps are unread.

        Raises
        ------
        ConfigError
            If there is no level of this name; names those that there are.
        """
        for level in (*self.levels, *self.others):
            if level.name == name:
                return SurveyedBuilding((level,), unread=self.unread)
        names = ", ".join(level.name for level in (*self.in_order, *self.others) if level.name)
        raise ConfigError("level", name, names or "none, as the source has no levels")


def aligned_building(building: SurveyedBuilding) -> tuple[SurveyedBuilding, Alignment]:
    """Turn and shift all levels and ramps alike, so that most sides of stalls lie along the axes.

    Returns
    -------
    tuple
        The building with its top level first, whose surveys have outlines at or beyond (0, 0), and how it was moved.
    """
    levels = building.in_order
    surveys, alignment = aligned_together([level.survey for level in levels])
    turn, shift = mover(alignment.turn_rad, (0.0, 0.0)), mover(0.0, alignment.shift_m)
    moved = tuple(replace(level, survey=survey) for level, survey in zip(levels, surveys, strict=True))
    ramps = tuple(replace(ramp, points=tuple(shift(turn(point)) for point in ramp.points)) for ramp in building.ramps)
    return replace(building, levels=moved, ramps=ramps), alignment


def ordinals_of(names: Sequence[str]) -> dict[str, float]:
    """Return the number by which each level is ordered; names that are no numbers follow below, in their order."""
    lowest = min((float(name) for name in names if _is_number(name)), default=0.0)
    words = [name for name in names if not _is_number(name)]
    return {name: float(name) if _is_number(name) else lowest - 1 - words.index(name) for name in names}


def _is_number(name: str) -> bool:
    return name.lstrip("-").replace(".", "", 1).isdecimal()
