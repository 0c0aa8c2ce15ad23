"""Lamps of car bodies: housings at the corners of nose and tail, with lenses, reflectors and daytime lights."""

from typing import NamedTuple

import numpy as np

from garage2usd.assets.car_patches import Faces, Row, across, at_depth, at_left_depth, at_x, disc_patch, end_patch
from garage2usd.assets.car_shapes import Head, TailLamp
from garage2usd.assets.car_shell import Shell, both_sides

__all__ = ["HeadLamps", "TailLamps", "head_lamps", "tail_lamps"]

_HOUSING_SKIN_M = 0.0115
_BEZEL_SKIN_M = 0.0135
_LENS_SKIN_M = 0.0155
_BEZEL_M = 0.009
"""Width of the reflector's rim around a lens."""
_EDGE_M = 0.012


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
