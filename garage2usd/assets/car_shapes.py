"""Shapes of the catalogue's bodies: side views, and designs of lamps, grilles and wheels."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

from pydantic import TypeAdapter

from garage2usd.common.documents import shipped_toml

_BASES = {"plain_van"}
"""Bodies in the file that are only bases of others."""
_BOOT_UNTIL = 0.9
"""Share of the length before which the foot of a rear window has a boot lid behind it."""


class Head(StrEnum):
    """Designs of front lamps."""

    TWIN = "twin"
    SLIM = "slim"
    ROUND = "round"
    BLOCK = "block"
    SPLIT = "split"


class TailLamp(StrEnum):
    """Designs of rear lamps."""

    WIDE = "wide"
    TALL = "tall"
    BAR = "bar"
    ROUND = "round"


class Grille(StrEnum):
    """Designs of grilles."""

    SLATS = "slats"
    CLOSED = "closed"
    FRAME = "frame"
    BARS = "bars"
    MOUTH = "mouth"


class Rim(StrEnum):
    """Designs of wheels."""

    TWIN_SPOKE = "twin_spoke"
    FIVE_SPOKE = "five_spoke"
    MULTI_SPOKE = "multi_spoke"
    Y_SPOKE = "y_spoke"
    TURBINE = "turbine"
    COVER = "cover"
    AERO = "aero"
    STEEL = "steel"


@dataclass(frozen=True)
class SideView:
    """Side view of a body as shares of its length (from the nose) and height.

    Attributes
    ----------
    shoulder
        (share of length, share of height) of bonnet, belt line and boot lid.
    roof
        Shares of length and height of windscreen foot, roof front, roof rear, rear window foot.
    pillars
        Shares of length of the pillars between side windows.
    tumblehome
        Narrowing of the roof against the belt, as a share of the half width.
    nose, tail
        Half width at the ends as a share of the largest.
    window_run_out_m
        Distance from the rear end of the side windows to the foot of the rear window.
    bow_m
        Distance by which the centres of nose and tail protrude before their corners.
    bed
        Shares of length between which a pickup's bed is open.
    upright_tail
        True if the tail is a tailgate between tall lamps, else the lamps lie wide under a boot lid or rear window.
    rows
        Rows of seats.
    seats
        Colour of the seats: ``black``, ``grey`` or ``tan``.
    clearance_m
        Height of the sills.
    glass_until
        Share of length behind which there are no windows; None for windows all around.
    glass
        Material of the windows behind the first pillar: ``glass`` or ``glass_dark``.
    bumper
        Factor on the heights of bumpers and of the parts on them.
    slab
        Steepness of the sides, from 0 (curved) to 1 (upright).
    crown_m
        Height of the bonnet's centre above its edges.
    doors
        Number of doors on each side.
    head, tail_lamps, grille, rim
        Designs of the lamps, the grille and the wheels.
    clad
        True if arches and sills have black plastic cladding.
    rails
        True if the roof has rails.
    spoiler
        True if the roof extends over the rear window.
    soft_top
        True if the roof is made of cloth.
    slides
        True if the rear doors are sliding doors.
    """

    shoulder: tuple[tuple[float, float], ...]
    roof: tuple[tuple[float, float], ...]
    pillars: tuple[float, ...]
    tumblehome: float
    nose: float
    tail: float
    window_run_out_m: float
    bow_m: tuple[float, float] = (0.11, 0.07)
    bed: tuple[float, float] | None = None
    upright_tail: bool = False
    rows: int = 2
    seats: str = "black"
    clearance_m: float = 0.18
    glass_until: float | None = None
    glass: str = "glass"
    bumper: float = 1.0
    slab: float = 0.0
    crown_m: float = 0.045
    doors: int = 2
    head: Head = Head.TWIN
    tail_lamps: TailLamp = TailLamp.WIDE
    grille: Grille = Grille.SLATS
    rim: Rim = Rim.TWIN_SPOKE
    clad: bool = False
    rails: bool = False
    spoiler: bool = False
    soft_top: bool = False
    slides: bool = False


def _side_views() -> dict[str, SideView]:
    """Read the shapes of all bodies; a body may be based on one that precedes it in the file."""
    fields: dict[str, dict[str, Any]] = {}
    for name, given in shipped_toml("garage2usd.assets", "car_shapes").items():
        of_base = fields.get(given.pop("base", ""), {})
        if "roof_at" in given:
            given["roof"] = _roof(*given.pop("roof_at"))
        if "line" in given:
            given["shoulder"] = _shoulder(given.pop("line"), given.get("roof", of_base.get("roof")))
        fields[name] = {**of_base, **given}
    return {name: _SIDE_VIEW.validate_python(each) for name, each in fields.items() if name not in _BASES}


def _shoulder(line: Sequence[float], roof: Sequence[Sequence[float]]) -> tuple[tuple[float, float], ...]:
    """Return the shoulder through the heights of a line, as shares of the body's length and height.

    Parameters
    ----------
    line
        Heights at the nose, of the bonnet at the windscreen, of the belt at half length and at the rear, and of the
        tail.
    roof
        Roof of the body.
    """
    nose, bonnet, belt, rear, tail = line
    foot, deck = roof[0][0], roof[3][0]
    behind = ((0.97, rear),) if deck < _BOOT_UNTIL else ()
    return (
        (0.0, nose),
        (0.018, nose + 0.055),
        (0.10, nose + 0.055 + (bonnet - nose - 0.055) * 0.6),
        (foot + 0.005, bonnet),
        (0.6, belt),
        (min(deck, 0.9), rear),
        *behind,
        (1.0, tail),
    )


def _roof(foot: float, front: float, rear: float, deck: float, drop: float = 0.975) -> tuple[tuple[float, float], ...]:
    """Return the points of a roof line as shares of length and height.

    These are the windscreen foot, roof front, roof rear and rear window foot; `drop` is the height of the third.
    """
    return (foot, 0.0), (front, 1.0), (rear, drop), (deck, 0.0)


_SIDE_VIEW = TypeAdapter(SideView)
SHAPES = _side_views()
"""Shape of each body of the catalogue, by name."""
