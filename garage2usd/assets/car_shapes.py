"""Shapes of the catalogue's bodies: side views, and designs of lamps, grilles and wheels."""
# Over 300 lines: a table of some rows for each body.

from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Any

__all__ = ["SHAPES", "Grille", "Head", "Rim", "SideView", "TailLamp"]

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
        Whether the tail is a tailgate between tall lamps, else the lamps lie wide under a boot lid or rear window.
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
        Whether arches and sills have black plastic cladding.
    rails
        Whether the roof has rails.
    spoiler
        Whether the roof extends over the rear window.
    soft_top
        Whether the roof is made of cloth.
    slides
        Whether the rear doors are sliding doors.
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


_USUAL = {
    "hatchback": SideView(
        shoulder=((0, 0.46), (0.02, 0.52), (0.12, 0.59), (0.27, 0.645), (0.6, 0.66), (0.9, 0.675), (1, 0.65)),
        roof=((0.26, 0.0), (0.44, 1.0), (0.83, 0.965), (0.965, 0.0)),
        pillars=(0.57,),
        tumblehome=0.22,
        nose=0.80,
        tail=0.86,
        window_run_out_m=0.34,
    ),
    "saloon": SideView(
        shoulder=(
            (0, 0.46),
            (0.02, 0.52),
            (0.12, 0.59),
            (0.28, 0.645),
            (0.6, 0.665),
            (0.85, 0.705),
            (0.97, 0.715),
            (1, 0.67),
        ),
        roof=((0.275, 0.0), (0.43, 1.0), (0.66, 0.985), (0.85, 0.0)),
        pillars=(0.555,),
        tumblehome=0.25,
        nose=0.80,
        tail=0.84,
        window_run_out_m=0.34,
    ),
    "suv": SideView(
        shoulder=((0, 0.47), (0.015, 0.54), (0.1, 0.61), (0.25, 0.64), (0.6, 0.655), (0.9, 0.67), (1, 0.64)),
        roof=((0.245, 0.0), (0.40, 1.0), (0.87, 0.975), (0.985, 0.0)),
        pillars=(0.53, 0.76),
        tumblehome=0.19,
        nose=0.83,
        tail=0.90,
        window_run_out_m=0.34,
        bow_m=(0.10, 0.06),
        upright_tail=True,
        tail_lamps=TailLamp.TALL,
    ),
    "van": SideView(
        shoulder=((0, 0.42), (0.015, 0.48), (0.08, 0.54), (0.19, 0.585), (0.6, 0.60), (0.9, 0.60), (1, 0.58)),
        roof=((0.17, 0.0), (0.35, 1.0), (0.935, 0.985), (0.99, 0.0)),
        pillars=(0.45, 0.70),
        tumblehome=0.14,
        nose=0.84,
        tail=0.94,
        window_run_out_m=0.22,
        bow_m=(0.12, 0.04),
        upright_tail=True,
        tail_lamps=TailLamp.TALL,
    ),
    "pickup": SideView(
        shoulder=((0, 0.50), (0.012, 0.56), (0.09, 0.605), (0.25, 0.63), (0.6, 0.64), (0.9, 0.64), (1, 0.63)),
        roof=((0.25, 0.0), (0.375, 1.0), (0.585, 0.985), (0.635, 0.0)),
        pillars=(0.465,),
        tumblehome=0.18,
        nose=0.86,
        tail=0.96,
        window_run_out_m=0.22,
        bow_m=(0.09, 0.02),
        bed=(0.65, 0.975),
        upright_tail=True,
        tail_lamps=TailLamp.TALL,
    ),
    "compact_ev": SideView(
        shoulder=((0, 0.46), (0.02, 0.52), (0.1, 0.575), (0.22, 0.61), (0.6, 0.63), (0.9, 0.65), (1, 0.62)),
        roof=((0.19, 0.0), (0.40, 1.0), (0.80, 0.965), (0.965, 0.0)),
        pillars=(0.55,),
        tumblehome=0.22,
        nose=0.80,
        tail=0.84,
        window_run_out_m=0.34,
        bow_m=(0.13, 0.09),
        grille=Grille.CLOSED,
        head=Head.SLIM,
        tail_lamps=TailLamp.BAR,
        rim=Rim.AERO,
        spoiler=True,
    ),
}


def _changed(base: SideView, line: tuple[float, float, float, float, float], **changes: Any) -> SideView:  # noqa: ANN401 - of any field
    """Derive a side view from another one, with different shoulder heights and other changed fields.

    Heights are shares of the body's height: at the nose, the bonnet at the windscreen, the belt at half length and at
    the rear, and the tail.
    """
    nose, bonnet, belt, rear, tail = line
    foot, deck = changes.get("roof", base.roof)[0][0], changes.get("roof", base.roof)[3][0]
    behind = ((0.97, rear),) if deck < _BOOT_UNTIL else ()
    shoulder = (
        (0.0, nose),
        (0.018, nose + 0.055),
        (0.10, nose + 0.055 + (bonnet - nose - 0.055) * 0.6),
        (foot + 0.005, bonnet),
        (0.6, belt),
        (min(deck, 0.9), rear),
        *behind,
        (1.0, tail),
    )
    return replace(base, shoulder=shoulder, **changes)


def _roof(foot: float, front: float, rear: float, deck: float, drop: float = 0.975) -> tuple[tuple[float, float], ...]:
    """Points of a roof line as shares of length and height.

    These are the windscreen foot, roof front, roof rear and rear window foot; `drop` is the height of the third.
    """
    return (foot, 0.0), (front, 1.0), (rear, drop), (deck, 0.0)


_HATCH, _SALOON, _SUV, _MPV, _PICKUP = (_USUAL[name] for name in ("hatchback", "saloon", "suv", "van", "pickup"))
_VAN = replace(_MPV, rows=1, slab=0.7, slides=True, rim=Rim.STEEL, head=Head.BLOCK, seats="grey")

SHAPES: dict[str, SideView] = _USUAL | {
    "microcar": _changed(
        _HATCH,
        (0.50, 0.60, 0.63, 0.64, 0.60),
        roof=_roof(0.19, 0.43, 0.88, 0.985),
        pillars=(0.72,),
        window_run_out_m=0.16,
        bow_m=(0.10, 0.06),
        rows=1,
        doors=1,
        head=Head.ROUND,
        tail_lamps=TailLamp.ROUND,
        grille=Grille.CLOSED,
        rim=Rim.COVER,
        upright_tail=True,
    ),
    "city_car": _changed(
        _HATCH,
        (0.47, 0.605, 0.64, 0.66, 0.63),
        roof=_roof(0.215, 0.42, 0.90, 0.985),
        pillars=(0.56,),
        window_run_out_m=0.24,
        bow_m=(0.10, 0.06),
        seats="grey",
        head=Head.BLOCK,
        tail_lamps=TailLamp.TALL,
        grille=Grille.MOUTH,
        rim=Rim.COVER,
        upright_tail=True,
    ),
    "tall_city_car": _changed(
        _MPV,
        (0.46, 0.56, 0.575, 0.575, 0.55),
        roof=_roof(0.145, 0.30, 0.955, 0.993),
        pillars=(0.50, 0.80),
        bow_m=(0.07, 0.03),
        window_run_out_m=0.12,
        tumblehome=0.11,
        slab=0.9,
        rows=2,
        seats="tan",
        slides=True,
        head=Head.BLOCK,
        grille=Grille.BARS,
        rim=Rim.STEEL,
    ),
    "supermini": _changed(
        _HATCH,
        (0.47, 0.64, 0.67, 0.72, 0.69),
        roof=_roof(0.25, 0.45, 0.79, 0.965, 0.95),
        pillars=(0.61,),
        window_run_out_m=0.52,
        doors=1,
        head=Head.ROUND,
        tail_lamps=TailLamp.TALL,
        grille=Grille.FRAME,
        rim=Rim.FIVE_SPOKE,
        upright_tail=True,
        spoiler=True,
    ),
    "compact_hatch": _changed(
        _HATCH,
        (0.45, 0.63, 0.66, 0.72, 0.69),
        roof=_roof(0.275, 0.435, 0.775, 0.95, 0.93),
        pillars=(0.57,),
        window_run_out_m=0.56,
        tumblehome=0.25,
        head=Head.SLIM,
        grille=Grille.MOUTH,
        tail_lamps=TailLamp.BAR,
        rim=Rim.MULTI_SPOKE,
        spoiler=True,
    ),
    "electric_hatch": _changed(
        _USUAL["compact_ev"],
        (0.47, 0.575, 0.605, 0.665, 0.64),
        roof=_roof(0.135, 0.37, 0.925, 0.985, 0.925),
        pillars=(0.50, 0.79),
        window_run_out_m=0.12,
        bow_m=(0.10, 0.05),
        tumblehome=0.17,
        tail=0.92,
        upright_tail=True,
        tail_lamps=TailLamp.BAR,
        head=Head.ROUND,
        clad=True,
        spoiler=False,
        rim=Rim.TURBINE,
        glass="glass_dark",
        seats="grey",
    ),
    "small_saloon": _changed(
        _SALOON,
        (0.47, 0.62, 0.645, 0.685, 0.64),
        roof=_roof(0.245, 0.41, 0.69, 0.865, 0.98),
        pillars=(0.55,),
        tumblehome=0.22,
        seats="grey",
        head=Head.BLOCK,
        tail_lamps=TailLamp.TALL,
        rim=Rim.COVER,
    ),
    "executive_saloon": _changed(
        _SALOON,
        (0.47, 0.65, 0.665, 0.70, 0.66),
        roof=_roof(0.295, 0.44, 0.66, 0.875, 0.965),
        pillars=(0.55,),
        head=Head.SLIM,
        grille=Grille.FRAME,
        rim=Rim.MULTI_SPOKE,
        seats="tan",
    ),
    "luxury_saloon": _changed(
        _SALOON,
        (0.50, 0.655, 0.665, 0.69, 0.66),
        roof=_roof(0.30, 0.43, 0.67, 0.84, 0.975),
        pillars=(0.54, 0.715),
        window_run_out_m=0.26,
        head=Head.SPLIT,
        grille=Grille.BARS,
        tail_lamps=TailLamp.BAR,
        rim=Rim.AERO,
        seats="tan",
        glass="glass_dark",
    ),
    "fastback": _changed(
        _SALOON,
        (0.44, 0.62, 0.655, 0.72, 0.69),
        roof=_roof(0.235, 0.43, 0.60, 0.955, 0.97),
        pillars=(0.545,),
        window_run_out_m=0.75,
        bow_m=(0.13, 0.09),
        head=Head.SLIM,
        grille=Grille.CLOSED,
        tail_lamps=TailLamp.BAR,
        rim=Rim.AERO,
    ),
    "small_estate": _changed(
        _SALOON,
        (0.46, 0.635, 0.65, 0.665, 0.64),
        roof=_roof(0.265, 0.42, 0.91, 0.985, 0.96),
        pillars=(0.54, 0.74),
        window_run_out_m=0.20,
        head=Head.BLOCK,
        tail_lamps=TailLamp.TALL,
        upright_tail=True,
        rails=True,
        seats="grey",
        rim=Rim.FIVE_SPOKE,
    ),
    "estate": _changed(
        _SALOON,
        (0.46, 0.64, 0.66, 0.69, 0.67),
        roof=_roof(0.275, 0.425, 0.84, 0.975, 0.945),
        pillars=(0.545, 0.74),
        window_run_out_m=0.30,
        head=Head.SLIM,
        grille=Grille.MOUTH,
        spoiler=True,
        rails=True,
        rim=Rim.TURBINE,
    ),
    "large_estate": _changed(
        _SALOON,
        (0.51, 0.635, 0.645, 0.645, 0.63),
        roof=_roof(0.305, 0.40, 0.955, 0.992, 0.99),
        pillars=(0.505, 0.675, 0.83),
        window_run_out_m=0.10,
        tumblehome=0.15,
        slab=0.6,
        nose=0.86,
        tail=0.93,
        bow_m=(0.08, 0.03),
        head=Head.BLOCK,
        grille=Grille.FRAME,
        tail_lamps=TailLamp.TALL,
        upright_tail=True,
        rails=True,
        clad=True,
        rim=Rim.Y_SPOKE,
        seats="tan",
    ),
    "small_suv": _changed(
        _SUV,
        (0.49, 0.63, 0.655, 0.69, 0.67),
        roof=_roof(0.235, 0.41, 0.83, 0.975, 0.955),
        pillars=(0.55,),
        window_run_out_m=0.42,
        clearance_m=0.21,
        bumper=1.08,
        head=Head.SPLIT,
        grille=Grille.MOUTH,
        tail_lamps=TailLamp.WIDE,
        upright_tail=False,
        clad=True,
        spoiler=True,
        rim=Rim.FIVE_SPOKE,
    ),
    "electric_suv": _changed(
        _SUV,
        (0.48, 0.59, 0.64, 0.705, 0.68),
        roof=_roof(0.175, 0.39, 0.76, 0.97, 0.945),
        pillars=(0.53, 0.735),
        window_run_out_m=0.46,
        clearance_m=0.21,
        head=Head.SLIM,
        grille=Grille.CLOSED,
        tail_lamps=TailLamp.BAR,
        clad=True,
        spoiler=True,
        rim=Rim.AERO,
        seats="grey",
    ),
    "coupe_suv": _changed(
        _SUV,
        (0.50, 0.645, 0.665, 0.725, 0.70),
        roof=_roof(0.255, 0.42, 0.66, 0.955, 0.965),
        pillars=(0.54,),
        window_run_out_m=0.70,
        clearance_m=0.22,
        bumper=1.08,
        head=Head.SLIM,
        grille=Grille.FRAME,
        tail_lamps=TailLamp.BAR,
        upright_tail=False,
        clad=True,
        glass="glass_dark",
        rim=Rim.Y_SPOKE,
    ),
    "large_suv": _changed(
        _SUV,
        (0.52, 0.63, 0.64, 0.655, 0.64),
        roof=_roof(0.255, 0.40, 0.90, 0.985, 0.97),
        pillars=(0.51, 0.735),
        window_run_out_m=0.20,
        clearance_m=0.23,
        bumper=1.15,
        rows=3,
        head=Head.BLOCK,
        grille=Grille.FRAME,
        rails=True,
        glass="glass_dark",
        rim=Rim.MULTI_SPOKE,
        seats="tan",
    ),
    "full_size_suv": _changed(
        _SUV,
        (0.55, 0.635, 0.645, 0.645, 0.63),
        roof=_roof(0.27, 0.385, 0.935, 0.99, 0.985),
        pillars=(0.475, 0.70),
        window_run_out_m=0.14,
        tumblehome=0.16,
        slab=0.6,
        clearance_m=0.25,
        bumper=1.25,
        bow_m=(0.07, 0.04),
        rows=3,
        head=Head.SPLIT,
        grille=Grille.BARS,
        rails=True,
        glass="glass_dark",
        rim=Rim.FIVE_SPOKE,
    ),
    "off_roader": _changed(
        _SUV,
        (0.57, 0.63, 0.635, 0.635, 0.62),
        roof=_roof(0.31, 0.37, 0.965, 0.995, 0.985),
        pillars=(0.565, 0.79),
        window_run_out_m=0.10,
        tumblehome=0.10,
        slab=0.9,
        nose=0.90,
        tail=0.95,
        clearance_m=0.27,
        bumper=1.3,
        crown_m=0.03,
        bow_m=(0.045, 0.03),
        head=Head.ROUND,
        grille=Grille.BARS,
        clad=True,
        rim=Rim.STEEL,
    ),
    "compact_mpv": _changed(
        _MPV,
        (0.44, 0.54, 0.575, 0.62, 0.60),
        roof=_roof(0.13, 0.40, 0.87, 0.985, 0.93),
        pillars=(0.47, 0.74),
        window_run_out_m=0.22,
        bow_m=(0.15, 0.08),
        tumblehome=0.20,
        head=Head.SLIM,
        grille=Grille.MOUTH,
        tail_lamps=TailLamp.WIDE,
        upright_tail=False,
        rim=Rim.TWIN_SPOKE,
        seats="grey",
    ),
    "large_mpv": _changed(
        _MPV,
        (0.43, 0.575, 0.60, 0.625, 0.60),
        roof=_roof(0.185, 0.37, 0.915, 0.985, 0.965),
        pillars=(0.44, 0.695),
        window_run_out_m=0.24,
        rows=3,
        slides=True,
        head=Head.SLIM,
        grille=Grille.FRAME,
        rails=True,
        glass="glass_dark",
        rim=Rim.TURBINE,
    ),
    "tall_mpv": _changed(
        _MPV,
        (0.48, 0.565, 0.58, 0.59, 0.57),
        roof=_roof(0.165, 0.315, 0.95, 0.993, 0.985),
        pillars=(0.415, 0.69),
        window_run_out_m=0.14,
        tumblehome=0.11,
        slab=0.8,
        rows=3,
        slides=True,
        head=Head.SPLIT,
        grille=Grille.BARS,
        glass="glass_dark",
        rim=Rim.MULTI_SPOKE,
        seats="tan",
        bumper=1.1,
    ),
    "small_van": _changed(
        _VAN,
        (0.45, 0.565, 0.58, 0.58, 0.56),
        roof=_roof(0.205, 0.37, 0.95, 0.993, 0.98),
        pillars=(0.50,),
        glass_until=0.50,
        tumblehome=0.12,
        grille=Grille.MOUTH,
    ),
    "panel_van": _changed(
        _VAN,
        (0.44, 0.54, 0.55, 0.55, 0.53),
        roof=_roof(0.155, 0.33, 0.965, 0.995, 0.985),
        pillars=(0.43,),
        glass_until=0.43,
        tumblehome=0.10,
        slab=0.9,
        bow_m=(0.11, 0.03),
        bumper=1.15,
        clad=True,
    ),
    "crew_van": _changed(
        _VAN,
        (0.45, 0.545, 0.555, 0.555, 0.53),
        roof=_roof(0.15, 0.31, 0.965, 0.995, 0.985),
        pillars=(0.385, 0.62),
        glass_until=0.62,
        tumblehome=0.10,
        slab=0.9,
        bow_m=(0.12, 0.03),
        bumper=1.15,
        rows=2,
        head=Head.SLIM,
        grille=Grille.SLATS,
        rim=Rim.COVER,
    ),
    "small_pickup": _changed(
        _PICKUP,
        (0.49, 0.635, 0.65, 0.65, 0.64),
        roof=_roof(0.24, 0.395, 0.535, 0.575, 0.97),
        pillars=(0.52,),
        window_run_out_m=0.14,
        bed=(0.59, 0.97),
        tumblehome=0.21,
        nose=0.82,
        clearance_m=0.21,
        bow_m=(0.11, 0.03),
        rows=1,
        doors=1,
        head=Head.SPLIT,
        grille=Grille.MOUTH,
        clad=True,
        rim=Rim.STEEL,
        seats="grey",
    ),
    "crew_pickup": _changed(
        _PICKUP,
        (0.52, 0.625, 0.635, 0.635, 0.62),
        roof=_roof(0.255, 0.375, 0.595, 0.655, 0.98),
        pillars=(0.455,),
        bed=(0.67, 0.975),
        clearance_m=0.26,
        bumper=1.2,
        head=Head.SLIM,
        grille=Grille.FRAME,
        clad=True,
        rim=Rim.FIVE_SPOKE,
        glass="glass_dark",
    ),
    "full_size_pickup": _changed(
        _PICKUP,
        (0.56, 0.635, 0.645, 0.65, 0.63),
        roof=_roof(0.275, 0.385, 0.605, 0.655, 0.985),
        pillars=(0.465,),
        bed=(0.67, 0.975),
        slab=0.5,
        clearance_m=0.28,
        bumper=1.35,
        bow_m=(0.06, 0.02),
        head=Head.BLOCK,
        grille=Grille.BARS,
        rim=Rim.MULTI_SPOKE,
        seats="tan",
    ),
    "roadster": _changed(
        _SALOON,
        (0.49, 0.67, 0.70, 0.725, 0.67),
        roof=_roof(0.355, 0.475, 0.60, 0.77, 0.98),
        pillars=(0.635,),
        window_run_out_m=0.22,
        clearance_m=0.13,
        bumper=0.84,
        crown_m=0.035,
        bow_m=(0.14, 0.11),
        rows=1,
        doors=1,
        soft_top=True,
        head=Head.SLIM,
        grille=Grille.MOUTH,
        tail_lamps=TailLamp.ROUND,
        rim=Rim.Y_SPOKE,
        seats="tan",
    ),
    "coupe": _changed(
        _SALOON,
        (0.47, 0.655, 0.68, 0.715, 0.67),
        roof=_roof(0.31, 0.475, 0.62, 0.90, 0.965),
        pillars=(0.61,),
        window_run_out_m=0.50,
        clearance_m=0.15,
        bumper=0.92,
        rows=1,
        doors=1,
        head=Head.SLIM,
        grille=Grille.FRAME,
        rim=Rim.TWIN_SPOKE,
    ),
    "sports_car": _changed(
        _SALOON,
        (0.48, 0.655, 0.68, 0.715, 0.66),
        roof=_roof(0.265, 0.455, 0.555, 0.925, 0.965),
        pillars=(0.58,),
        window_run_out_m=0.85,
        clearance_m=0.13,
        bumper=0.86,
        crown_m=0.03,
        bow_m=(0.15, 0.10),
        tumblehome=0.29,
        rows=1,
        doors=1,
        head=Head.ROUND,
        grille=Grille.CLOSED,
        tail_lamps=TailLamp.BAR,
        rim=Rim.FIVE_SPOKE,
    ),
    "muscle_coupe": _changed(
        _SALOON,
        (0.53, 0.675, 0.69, 0.725, 0.69),
        roof=_roof(0.335, 0.475, 0.635, 0.885, 0.965),
        pillars=(0.625,),
        window_run_out_m=0.55,
        clearance_m=0.15,
        bumper=0.94,
        bow_m=(0.09, 0.05),
        doors=1,
        head=Head.TWIN,
        grille=Grille.BARS,
        tail_lamps=TailLamp.BAR,
        rim=Rim.Y_SPOKE,
    ),
}
"""Shape of each body of the catalogue, by name."""
