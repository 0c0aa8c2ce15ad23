"""Painted stall numbers on the floor or on walls."""

from collections.abc import Iterable

from garage2usd.assets.glyphs import GLYPH_PITCH, GLYPH_WIDTH
from garage2usd.assets.lettering import cells_of, overhang_of, unpainted, written_form
from garage2usd.config import FittingsConfig, LookConfig
from garage2usd.config.font_file import FontFile
from garage2usd.config.look import BandForm, MarkingsLook, NumberForm, NumberPlace
from garage2usd.garage import StallKind
from garage2usd.layout.parking.zones import zone_of
from garage2usd.layout.placement import PlacedStall, Placement, placed
from garage2usd.layout.tiles import TileGrid
from garage2usd.objects.kind import Point, Spec
from garage2usd.objects.stall_number import (
    FontNumberSpec,
    NumberFrameSpec,
    NumberSpec,
    WallFontNumberSpec,
    WallNumberSpec,
)
from garage2usd.objects.wheel_stop import WHEEL_STOP_WIDTH_M
from garage2usd.structure.grid import outside_squares

_PIECE_CHARACTERS = 2
_FROM_LINE_M = 0.225
"""Distance from a stall's mouth or wheel stop to the characters."""
_FROM_SIDES_M = 0.15
_LEAST_ON_LANE_M = 0.2
_HEIGHT_STEP_M = 0.01
_ON_WALL_M, _WALL_LIFT_M = 1.55, 0.006
"""Height of a wall number's middle over the floor, and its distance from the wall."""
_WHEEL_STOP_FROM_REAR_M = 0.55
_LANE_GAP_M, _BESIDE_STRIP_M = 0.2, 0.08
"""Distance from a stall's mouth to a number on the lane, and from the number to the guide strip."""
_FRAME_MARGIN = 0.3
"""Margin of a number's frame, as a share of the character height."""


def stall_numbers(
    stalls: Iterable[PlacedStall], grid: TileGrid | None, look: LookConfig, fittings: FittingsConfig
) -> list[Placement]:
    """Place the painted number of each stall, in pieces of at most two characters.

    Short pieces need few prototypes for all numbers. Without a grid, none are on walls.
    """
    numbers, font = look.numbers, look.font
    if not fittings.stall_numbers or numbers.place is NumberPlace.NONE:
        return []
    placements: list[Placement] = []
    for stall in stalls:
        if not stall.number or unpainted(stall.number, font):
            continue
        texts = _split(written_form(stall.number), numbers.form)
        widths = [cells_of(text, font) for text in texts]
        count = sum(widths)
        if not count:
            continue
        height_m = _fitting_height_m(numbers.height_m, count, stall.width_m)
        wall_m = _wall_behind_m(stall, grid) if grid is not None and numbers.place is NumberPlace.WALL else None
        if wall_m is not None:
            along = -wall_m
        else:
            along, height_m = _on_floor_m(stall, numbers.place, height_m, look.markings)
        done = 0.0
        for piece, (text, width) in enumerate(zip(reversed(texts), reversed(widths), strict=True), start=1):
            done += width
            across = (count - 2 * done + width) / 2 * GLYPH_PITCH * height_m
            spec = _spec(text, height_m, font, is_upright=wall_m is not None)
            placements.append(_piece_placement(stall, spec, (across, along), piece, is_upright=wall_m is not None))
        if numbers.form is NumberForm.BOXED and wall_m is None:
            margin = 2 * _FRAME_MARGIN * height_m
            width_m = (GLYPH_WIDTH + GLYPH_PITCH * (count - 1)) * height_m + margin
            over_m = 2 * max(overhang_of(text, font) for text in texts) * height_m
            frame = NumberFrameSpec(round(width_m, 3), round(height_m + over_m + margin, 3))
            placements.append(_piece_placement(stall, frame, (0.0, along), len(texts) + 1, is_upright=False))
    return placements


def _spec(text: str, height_m: float, font: FontFile | None, *, is_upright: bool) -> Spec:
    if font is None:
        return WallNumberSpec(text, height_m) if is_upright else NumberSpec(text, height_m)
    return (WallFontNumberSpec if is_upright else FontNumberSpec)(text, height_m, font)


def _piece_placement(stall: PlacedStall, spec: Spec, point: Point, piece: int, *, is_upright: bool) -> Placement:
    """Return a piece of a stall's number at a point in the stall's coordinates."""
    return placed(
        f"StallNumber_{stall.ordinal}_{piece}",
        spec,
        stall.to_world(point),
        height_m=_ON_WALL_M if is_upright else 0.0,
        yaw_rad=stall.yaw_rad,
        square=stall.square,
        ordinal=stall.ordinal,
    )


def _split(number: str, form: NumberForm) -> list[str]:
    """Split a stall number into its painted pieces, first at the end of the zone."""
    zone = zone_of(number)
    own = number.removeprefix(f"{zone}-") if zone else number
    parts = [zone, "-", own] if zone and form is NumberForm.FULL else [own]
    texts = []
    for part in parts:
        first = len(part) % _PIECE_CHARACTERS
        texts += [part[:first]] * bool(first)
        texts += [part[start : start + _PIECE_CHARACTERS] for start in range(first, len(part), _PIECE_CHARACTERS)]
    return texts


def _fitting_height_m(height_m: float, count: float, stall_width_m: float) -> float:
    """Return the character height, reduced if the number is wider than the stall between its lines."""
    most = (stall_width_m - 2 * _FROM_SIDES_M) / (GLYPH_WIDTH + GLYPH_PITCH * (count - 1))
    return height_m if height_m <= most else max(1, int(most / _HEIGHT_STEP_M)) * _HEIGHT_STEP_M


def _on_floor_m(stall: PlacedStall, place: NumberPlace, height_m: float, markings: MarkingsLook) -> tuple[float, float]:
    """Return a floor number's place along its stall, from the stall's middle towards the mouth, and its height."""
    half = stall.length_m / 2
    if place is NumberPlace.MIDDLE:
        return 0.0, height_m
    if place is NumberPlace.REAR:
        stop = _WHEEL_STOP_FROM_REAR_M + WHEEL_STOP_WIDTH_M / 2
        return -half + stop + _FROM_LINE_M + height_m / 2, height_m
    if place is NumberPlace.LANE and stall.stall_kind is StallKind.PERPENDICULAR:
        if markings.band is BandForm.NONE:
            return half + _LANE_GAP_M + height_m / 2, height_m
        room = markings.band_gap_m - 2 * _BESIDE_STRIP_M
        if room >= _LEAST_ON_LANE_M:
            lower = min(height_m, int(room / _HEIGHT_STEP_M) * _HEIGHT_STEP_M)
            return half + markings.band_gap_m / 2, lower
    return half - _FROM_LINE_M - height_m / 2, height_m


def _wall_behind_m(stall: PlacedStall, grid: TileGrid) -> float | None:
    """Return the distance from a stall's middle back to the outer wall behind it.

    None without an outer wall there, and for stalls that are not perpendicular to it.
    """
    if stall.stall_kind is not StallKind.PERPENDICULAR:
        return None
    row, col = stall.edge.opposite.beyond(stall.square)
    outside = outside_squares(grid.structure.cells)
    rows, cols = outside.shape
    if 0 <= row < rows and 0 <= col < cols and not outside[row, col]:
        return None
    tile = grid.tiles[stall.square]
    half = tile.half_z_m if stall.edge.along_x else tile.half_x_m
    from_mouth = 2 * half - stall.length_m / 2
    return round(from_mouth - _WALL_LIFT_M, 6)
