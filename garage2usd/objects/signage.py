"""The texts, colours and pictograms of signs in each country."""

from dataclasses import dataclass
from enum import StrEnum

import shapely
from pydantic import TypeAdapter

from garage2usd.assets.countries import Country
from garage2usd.common.documents import shipped_toml

_GRID = 1e-3


class Way(StrEnum):
    """The message of a sign over a vehicle door."""

    IN = "in"
    NOT_IN = "not_in"
    OUT = "out"
    NOT_OUT = "not_out"

    @property
    def is_open(self) -> bool:
        """True if vehicles may pass the door."""
        return self in {Way.IN, Way.OUT}


@dataclass(frozen=True)
class Signage:
    """The words, colours and numbers on signs of a country.

    Attributes
    ----------
    enter, no_entry, exit, no_exit
        Words over vehicle doors.
    exit_sign
        Word on exit signs over aisles; empty if they have only the pictogram.
    has_runner
        True if exit signs show the running man.
    is_red
        True if their legend is red on white, else white on green.
    hydrant, fire_number
        Words on hydrant cabinets: their name, and the number of the fire brigade.
    level
        Word for a level, beside its name.
    """

    enter: str
    no_entry: str
    exit: str
    no_exit: str
    exit_sign: str
    has_runner: bool
    is_red: bool
    hydrant: str
    fire_number: str
    level: str

    def of(self, way: Way) -> str:
        """Return the words on the sign over a vehicle door."""
        return {Way.IN: self.enter, Way.NOT_IN: self.no_entry, Way.OUT: self.exit, Way.NOT_OUT: self.no_exit}[way]


SIGNAGE: dict[Country, Signage] = TypeAdapter(dict[Country, Signage]).validate_python(
    shipped_toml("garage2usd.objects", "signage")
)
"""Signage of each country.

The pictogram is that of ISO 7010 (E001, E002) and GB 13495; red legends on white are usual for exit signs by NFPA 101.
"""


def running_man() -> shapely.Geometry:
    """Running person in a doorway, as on signs of ISO 7010: height 1, above the origin, second coordinate upwards."""
    strokes = [
        shapely.Point(-0.18, 0.80).buffer(0.09, quad_segs=3),  # head, body, arms and legs, then the doorway
        shapely.LineString([(-0.22, 0.66), (-0.30, 0.40)]).buffer(0.07, cap_style="flat"),
        shapely.LineString([(-0.50, 0.46), (-0.42, 0.62), (-0.22, 0.62), (-0.06, 0.50)]).buffer(
            0.035, cap_style="flat"
        ),
        shapely.LineString([(-0.30, 0.42), (-0.12, 0.34), (-0.14, 0.12)]).buffer(0.045, cap_style="flat"),
        shapely.LineString([(-0.30, 0.42), (-0.36, 0.22), (-0.58, 0.20)]).buffer(0.045, cap_style="flat"),
        shapely.box(0.22, 0.10, 0.62, 0.90),
    ]
    return shapely.union_all(strokes, grid_size=_GRID)
