"""The stalls of a surveyed garage on the tiles of its floor, with the numbers that people read."""

from collections import Counter
from collections.abc import Iterable
from dataclasses import replace

from garage2usd.assets.glyphs import undrawn
from garage2usd.layout.placement import PlacedStall
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.structure.lane_graph import StallType
from garage2usd.structure.stalls import Edge
from garage2usd.survey.fitted_stalls import FittedStall

__all__ = ["placed_stalls"]

_OUTWARDS = {Edge.UP: (0.0, -1.0), Edge.DOWN: (0.0, 1.0), Edge.LEFT: (-1.0, 0.0), Edge.RIGHT: (1.0, 0.0)}


def placed_stalls(
    fitted: Iterable[FittedStall], ground: SurveyedGround
) -> tuple[tuple[PlacedStall, ...], tuple[FittedStall, ...]]:
    """Return the stalls by tile in reading order, each with a number that people read, and the fitted ones likewise."""
    fitted = list(fitted)
    square_of = [ground.square_at(stall.shape.centre) for stall in fitted]
    numbers = _numbers(fitted)
    order = sorted(range(len(fitted)), key=lambda index: (square_of[index], index))
    ordinals: Counter[tuple[int, int]] = Counter()
    stalls = []
    for index in order:
        stall, square = fitted[index], square_of[index]
        shape = stall.shape
        ordinals[square] += 1
        out_x, out_z = shape.outwards
        stalls.append(
            PlacedStall(
                square=square,
                ordinal=ordinals[square],
                edge=max(Edge, key=lambda edge: _OUTWARDS[edge][0] * out_x + _OUTWARDS[edge][1] * out_z),
                stall_type=StallType.TYPE_3,
                centre_m=shape.centre,
                width_m=shape.width_m,
                length_m=shape.length_m,
                yaw_rad=shape.yaw_rad,
                use=stall.source.use,
                number=numbers[index] if stall.source.use.takes_cars else "",
                angle_deg=shape.angle_deg,
                turn=shape.turn,
                size=stall.source.size.value,
            )
        )
    return tuple(stalls), tuple(_noted(fitted[index], numbers[index]) for index in order)


def _noted(stall: FittedStall, number: str) -> FittedStall:
    """Return a stall with a note if its number cannot be painted."""
    lacking = "".join(undrawn(number))
    if not lacking:
        return stall
    note = f"its number '{number}' is not painted, as the lettering has no {lacking}"
    return replace(stall, note=f"{stall.note}; {note}" if stall.note else note)


def _numbers(fitted: Iterable[FittedStall]) -> list[str]:
    """Return the number of each stall: that of the survey, or counted through where some lack one or share it.

    Stalls in which nobody parks need none.
    """
    given = [stall.source.number for stall in fitted]
    asked = [stall.source.number for stall in fitted if stall.source.use.is_parked_in]
    if all(asked) and len(set(asked)) == len(asked):
        return given
    return [f"{number:02d}" for number in range(1, len(given) + 1)]
