"""Trim at the ends of car bodies: black grilles, intakes and seams, bright frames and badges."""

import numpy as np

from garage2usd.assets.car_patches import Faces, Row, across, at_depth, at_left_depth, at_x, disc_patch, end_patch
from garage2usd.assets.car_shapes import Grille
from garage2usd.assets.car_shell import Shell, both_sides

__all__ = ["PLATE_M", "bright_trim", "end_trim", "front_plate_m", "rear_plate_m"]

PLATE_M = (0.52, 0.11)
"""Width and height of a number plate."""
_SEAM_M = 0.007
_BORDER_M = 0.014
"""Width of the bright frame around a grille."""
_BESIDE_ARCH_M = 0.025
_BARS = 9
_HALF_BAR_M = 0.009


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
