"""Nose and tail of car bodies: lamps with lenses and reflectors, grilles, seams, bright frames and badges."""

from typing import NamedTuple

import numpy as np

from garage2usd.assets.car_patches import Faces, Row, across, at_depth, at_left_depth, at_x, disc_patch, end_patch
from garage2usd.assets.car_shapes import Grille, Head, TailLamp
from garage2usd.assets.car_shell import Shell, both_sides

_HOUSING_SKIN_M = 0.0115
_BEZEL_SKIN_M = 0.0135
_LENS_SKIN_M = 0.0155
_BEZEL_M = 0.009
"""Width of the reflector's rim around a lens."""
_EDGE_M = 0.012
PLATE_M = (0.52, 0.11)
"""Width and height of a number plate."""
_SEAM_M = 0.007
_BORDER_M = 0.014
"""Width of the bright frame around a grille."""
_BESIDE_ARCH_M = 0.025
_BARS = 9
_HALF_BAR_M = 0.009


class HeadLamps(NamedTuple):
    """Faces of the front lamps: dark housings, white light sources, and bright reflectors around lenses."""

    housings: Faces
    lights: Faces
    bezels: Faces


class TailLamps(NamedTuple):
    """Faces of the rear lamps: dark housings, red lenses and reversing lamps."""

    housings: Faces
    lenses: Faces
    reverse: Faces


def head_lamps(shell: Shell) -> HeadLamps:
    """Make the front lamps of a body's design."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=False) - 0.022
    housings, strips, discs = _HEADS[shell.shape.head](half, top, 0.42 * shell.shape.bumper)

    lights = [end_patch(shell, rows, rear=False, skin_m=_LENS_SKIN_M) for rows in strips]
    bezels = []
    for x, y, radius in discs:
        lights.append(disc_patch(shell, (x, y), radius, rear=False, skin_m=_LENS_SKIN_M))
        bezels.append(disc_patch(shell, (x, y), radius + _BEZEL_M, rear=False, skin_m=_BEZEL_SKIN_M))
    found = [end_patch(shell, rows, rear=False, skin_m=_HOUSING_SKIN_M) for rows in housings], lights, bezels
    return HeadLamps(*(both_sides(np.concatenate(faces)) for faces in found))


_Design = tuple[list[list[Row]], list[list[Row]], list[tuple[float, float, float]]]
"""Patches of housings, patches of light strips, and lenses as X, Y and radius."""


def _twin(half: float, top: float, low: float) -> _Design:
    """Head lamp design: two lenses side by side below a light strip."""
    del low
    housing = [
        (top - 0.135, at_x(0.60 * half), at_depth(0.17)),
        (top - 0.115, at_x(0.53 * half), at_depth(0.24)),
        (top - 0.055, at_x(0.50 * half), at_depth(0.33)),
        (top, at_x(0.52 * half), at_depth(0.37)),
    ]
    strip = [(top - 0.022, at_x(0.535 * half), at_depth(0.33)), (top - 0.008, at_x(0.545 * half), at_depth(0.34))]
    return [housing], [strip], [(share * half, top - 0.077, 0.040) for share in (0.61, 0.735)]


def _slim(half: float, top: float, low: float) -> _Design:
    """Head lamp design: a narrow slit along the wing, with small lenses above a strip at its lower edge."""
    del low
    housing = [
        (top - 0.09, at_x(0.58 * half), at_depth(0.20)),
        (top - 0.055, at_x(0.49 * half), at_depth(0.34)),
        (top, at_x(0.50 * half), at_depth(0.42)),
    ]
    strip = [(top - 0.084, at_x(0.585 * half), at_depth(0.20)), (top - 0.070, at_x(0.545 * half), at_depth(0.26))]
    return [housing], [strip], [(share * half, top - 0.034, 0.019) for share in (0.57, 0.65, 0.73)]


def _round(half: float, top: float, low: float) -> _Design:
    """Head lamp design: one large round lens in a round housing, with a small lamp below it."""
    del low
    x, y, reach = 0.68 * half, top - 0.10, 0.098
    ring = [(y + reach * at, reach * wide) for at, wide in ((-1.0, 0.42), (-0.42, 1.0), (0.42, 1.0), (1.0, 0.42))]
    below = [(y - 0.185, at_x(x - 0.05), at_x(x + 0.05)), (y - 0.145, at_x(x - 0.06), at_x(x + 0.06))]
    strip = [(y - 0.176, at_x(x - 0.04), at_x(x + 0.04)), (y - 0.156, at_x(x - 0.048), at_x(x + 0.048))]
    return [[(at, at_x(x - wide), at_x(x + wide)) for at, wide in ring], below], [strip], [(x, y, 0.068)]


def _block(half: float, top: float, low: float) -> _Design:
    """Head lamp design: a tall block with two lenses one above the other, in an angle of light."""
    del low
    housing = [
        (top - 0.195, at_x(0.66 * half), at_depth(0.15)),
        (top - 0.03, at_x(0.585 * half), at_depth(0.27)),
        (top, at_x(0.59 * half), at_depth(0.30)),
    ]
    over = [(top - 0.020, at_x(0.605 * half), at_depth(0.26)), (top - 0.007, at_x(0.605 * half), at_depth(0.28))]
    beside = [
        (top - 0.180, at_x(0.675 * half), at_x(0.693 * half)),
        (top - 0.026, at_x(0.603 * half), at_x(0.628 * half)),
    ]
    return [housing], [over, beside], [(0.745 * half, top - 0.072, 0.036), (0.76 * half, top - 0.150, 0.032)]


def _split(half: float, top: float, low: float) -> _Design:
    """Head lamp design: a light strip below the bonnet, with the lenses in the bumper."""
    slit = [(top - 0.052, at_x(0.52 * half), at_depth(0.28)), (top, at_x(0.50 * half), at_depth(0.37))]
    strip = [(top - 0.040, at_x(0.535 * half), at_depth(0.28)), (top - 0.014, at_x(0.52 * half), at_depth(0.34))]
    pod = [
        (low, at_x(0.64 * half), at_depth(0.13)),
        (low + 0.055, at_x(0.60 * half), at_depth(0.20)),
        (low + 0.115, at_x(0.62 * half), at_depth(0.21)),
    ]
    return [slit, pod], [strip], [(share * half, low + 0.058, 0.036) for share in (0.685, 0.79)]


_HEADS = {Head.TWIN: _twin, Head.SLIM: _slim, Head.ROUND: _round, Head.BLOCK: _block, Head.SPLIT: _split}


def tail_lamps(shell: Shell) -> TailLamps:
    """Make the rear lamps of a body's design, and the reflectors in its bumper."""
    half, y = shell.body.width_m / 2, shell.bumper_top(rear=True) - 0.045
    reflector = [(y, at_x(0.66 * half), at_x(0.82 * half)), (y + 0.028, at_x(0.66 * half), at_x(0.82 * half))]
    made = _TAILS[shell.shape.tail_lamps](shell)
    lenses = np.concatenate([made.lenses, both_sides(end_patch(shell, reflector, rear=True))])
    return made._replace(lenses=lenses)


def _banded(shell: Shell) -> TailLamps:
    """Tail lamp design: red lenses at the corners with a reversing lamp between: tall, or wide below a boot lid."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=True) - 0.03
    tall = shell.shape.tail_lamps is TailLamp.TALL
    room = top - shell.bumper_top(rear=True) - 0.02
    height, inner = (min(0.36, room), 0.77 * half) if tall else (0.155, 0.48 * half)
    wrap = shell.shape.bow_m[1] + (0.12 if tall else 0.20)

    def patch(low: float, high: float, edge_m: float, skin_m: float) -> Faces:
        """Part of the lamps between two shares of their height, inset by an edge's width."""
        first, last = top - height + edge_m, top - edge_m
        rows = [
            (
                first + (last - first) * u,
                at_x(inner + edge_m + 0.05 * (1 - u)),
                at_depth(wrap - edge_m - 0.05 * (1 - u)),
            )
            for u in (low, high)
        ]
        return both_sides(end_patch(shell, rows, rear=True, skin_m=skin_m))

    lenses = ((0.0, 0.34), (0.48, 1.0)) if tall else ((0.0, 0.20), (0.44, 1.0))
    reverse = (0.375, 0.445) if tall else (0.245, 0.395)
    return TailLamps(
        patch(0.0, 1.0, 0.0, _HOUSING_SKIN_M),
        np.concatenate([patch(*band, _EDGE_M, _LENS_SKIN_M) for band in lenses]),
        patch(*reverse, _EDGE_M, _LENS_SKIN_M),
    )


def _reverse_in_bumper(shell: Shell) -> Faces:
    half, y = shell.body.width_m / 2, shell.bumper_top(rear=True) - 0.045
    rows = [(at, at_x(0.44 * half), at_x(0.58 * half)) for at in (y, y + 0.028)]
    return both_sides(end_patch(shell, rows, rear=True, skin_m=_LENS_SKIN_M))


def _bar(shell: Shell) -> TailLamps:
    """Tail lamp design: a light band across the whole tail, wider at its ends."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=True) - 0.025
    wrap, border = shell.shape.bow_m[1] + 0.22, 0.64 * half
    housing = [(y, at_left_depth(wrap), at_depth(wrap)) for y in (top - 0.105, top)]
    middle = across(top - 0.066, top - 0.044, border - 0.004, border - 0.004)
    end = [(top - 0.094, at_x(border), at_depth(wrap - 0.04)), (top - _EDGE_M, at_x(border), at_depth(wrap - 0.02))]
    lenses = [
        end_patch(shell, middle, rear=True, skin_m=_LENS_SKIN_M),
        both_sides(end_patch(shell, end, rear=True, skin_m=_LENS_SKIN_M)),
    ]
    housings = end_patch(shell, housing, rear=True, skin_m=_HOUSING_SKIN_M)
    return TailLamps(housings, np.concatenate(lenses), _reverse_in_bumper(shell))


def _round_tail(shell: Shell) -> TailLamps:
    """Tail lamp design: two round lenses on each side."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=True) - 0.03
    radius = min(0.058, (top - shell.bumper_top(rear=True)) / 2 - 0.02)
    y, places = top - radius - 0.012, (0.80 * half - 2 * radius - 0.022, 0.80 * half)
    housing, lenses = (
        both_sides(np.concatenate([disc_patch(shell, (x, y), radius + wider, rear=True, skin_m=skin) for x in places]))
        for wider, skin in ((0.009, _HOUSING_SKIN_M), (0.0, _LENS_SKIN_M))
    )
    return TailLamps(housing, lenses, _reverse_in_bumper(shell))


_TAILS = {TailLamp.WIDE: _banded, TailLamp.TALL: _banded, TailLamp.BAR: _bar, TailLamp.ROUND: _round_tail}


def end_trim(shell: Shell) -> Faces:
    """Black trim: grille, air intakes, plate recess, lower edges of the bumpers, shut lines of bonnet and tailgate."""
    half, top, high = shell.body.width_m / 2, shell.end_top(rear=False), shell.shape.bumper
    grille = shell.shape.grille
    faces = [end_patch(shell, _grille(shell), rear=False, skin_m=0.009 if grille is Grille.FRAME else 0.006)]
    if grille is Grille.MOUTH:
        mouth = across(0.255 * high, 0.375 * high, 0.66 * half, 0.58 * half)
        faces.append(end_patch(shell, mouth, rear=False))
    elif grille is not Grille.FRAME:
        faces.append(end_patch(shell, across(0.275 * high, 0.375 * high, 0.60 * half, 0.52 * half), rear=False))
    before, behind = shell.axles[0], shell.body.length_m - shell.axles[1]
    reach = min(0.17, before - shell.arch_radius_m - _BESIDE_ARCH_M)
    pocket = [(0.29 * high, at_x(0.70 * half), at_depth(reach)), (0.40 * high, at_x(0.73 * half), at_depth(reach))]
    faces.append(both_sides(end_patch(shell, pocket, rear=False)))
    bonnet = across(top - 0.014, top - 0.007, 0.66 * half, 0.66 * half)
    faces.append(end_patch(shell, bonnet, rear=False, skin_m=0.003))

    rear_top, high = shell.end_top(rear=True), shell.shape.bumper
    plate = rear_plate_m(shell)
    recess = across(plate - 0.03, plate + PLATE_M[1] + 0.03, 0.33 * half, 0.36 * half)
    faces.append(end_patch(shell, recess, rear=True))
    most = behind - shell.arch_radius_m - _BESIDE_ARCH_M
    edges = ((0.30, min(0.30, most)), (0.385, min(0.34, most)))
    valance = [(y * high, at_left_depth(depth), at_depth(depth)) for y, depth in edges]
    faces.append(end_patch(shell, valance, rear=True))
    gate = shell.bumper_top(rear=True) + 0.03
    faces.append(end_patch(shell, across(gate, gate + 0.012, 0.70 * half, 0.70 * half), rear=True, skin_m=0.003))
    heights = np.linspace(gate + 0.02, rear_top - 0.012, 4)
    seam = [(float(y), at_x(0.715 * half), at_x(0.715 * half + _SEAM_M)) for y in heights]
    faces.append(both_sides(end_patch(shell, seam, rear=True, skin_m=0.003)))
    return np.concatenate(faces)


def bright_trim(shell: Shell) -> Faces:
    """Bright trim: slats, bars or frame of the grille, the strip above the rear plate, badges."""
    half, top, grille = shell.body.width_m / 2, shell.end_top(rear=False), shell.shape.grille
    rows = _grille(shell)
    low, high = rows[0][0], rows[-1][0]
    faces: list[Faces] = []
    if grille is Grille.SLATS:
        for share in (0.2, 0.5, 0.8):
            y, reach = low + (high - low) * share, (0.34 + 0.095 * share) * half
            faces.append(end_patch(shell, across(y - 0.006, y + 0.006, reach, reach), rear=False, skin_m=0.009))
    elif grille is Grille.FRAME:
        faces.append(end_patch(shell, _framed(shell, _BORDER_M), rear=False))
    elif grille is Grille.BARS:
        for x in np.linspace(-0.43, 0.43, _BARS) * half:
            sides = at_x(x - _HALF_BAR_M), at_x(x + _HALF_BAR_M)
            bar = [(low + 0.012, *sides), (high - 0.012, *sides)]
            faces.append(end_patch(shell, bar, rear=False, skin_m=0.009))
    strip = rear_plate_m(shell) + PLATE_M[1] + 0.04
    faces.append(end_patch(shell, across(strip, strip + 0.02, 0.30 * half, 0.30 * half), rear=True, skin_m=0.009))
    middle = top - (0.14 if grille in {Grille.SLATS, Grille.BARS} else 0.1)
    faces.append(disc_patch(shell, (0.0, middle), 0.045, rear=False, skin_m=0.014))
    faces.append(disc_patch(shell, (0.0, strip + 0.065), 0.035, rear=True, skin_m=0.014))
    return np.concatenate(faces)


def front_plate_m(shell: Shell) -> float:
    """Height of the lower edge of the front plate."""
    return 0.385 * shell.shape.bumper


def rear_plate_m(shell: Shell) -> float:
    """Height of the lower edge of the rear plate."""
    top, bumper = shell.end_top(rear=True), shell.bumper_top(rear=True)
    return min(max(top - 0.31, bumper + 0.075), top - PLATE_M[1] - 0.075)


def _grille(shell: Shell) -> list[Row]:
    """Black panel of a car's grille."""
    half, top = shell.body.width_m / 2, shell.end_top(rear=False)
    match shell.shape.grille:
        case Grille.CLOSED:
            return across(top - 0.075, top - 0.045, 0.485 * half, 0.50 * half)
        case Grille.FRAME:
            return _framed(shell, 0.0)
        case Grille.MOUTH:
            return across(top - 0.062, top - 0.036, 0.47 * half, 0.485 * half)
        case _:
            low = max(top - 0.30, shell.bumper_top(rear=False) + 0.055)
            wide = 0.49 if shell.shape.grille is Grille.BARS else 0.455
            return across(min(low, top - 0.10), top - 0.045, (wide - 0.095) * half, wide * half)


def _framed(shell: Shell, border_m: float) -> list[Row]:
    """A hexagonal grille that reaches down to the lower edge of the bumper."""
    half, top, low = shell.body.width_m / 2, shell.end_top(rear=False) - 0.05, 0.30 * shell.shape.bumper
    middle = low + (top - low) * 0.62
    corners = ((low - border_m, 0.33), (middle, 0.46), (top + border_m, 0.42))
    return [(y, at_x(-share * half - border_m), at_x(share * half + border_m)) for y, share in corners]
