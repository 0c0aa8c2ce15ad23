"""Ceilings of a look: drawn values, and finishes of the ceiling and the services below it."""

from garage2usd.assets import Finish
from garage2usd.config.look import NATURAL, CeilingFinish, CeilingLook
from garage2usd.look.axes import Group
from garage2usd.look.tint import tinted

__all__ = ["ceiling_finishes", "drawn_ceiling"]

_UNDERSIDES = {
    CeilingFinish.WHITE: ("ceiling_painted", NATURAL),
    CeilingFinish.BLACK: ("ceiling_painted", "#26272a"),
    CeilingFinish.BOARDS: ("ceiling_insulation", NATURAL),
}
_SERVICES = ("service_steel", "service_pipe", "service_hanger")


def drawn_ceiling(axes: Group) -> CeilingLook:
    """Draw a ceiling and the colour of its services."""
    return CeilingLook(
        finish=axes.one_of(
            "finish",
            {CeilingFinish.WHITE: 0.4, CeilingFinish.RAW: 0.35, CeilingFinish.BLACK: 0.08, CeilingFinish.BOARDS: 0.17},
        ),
        services=axes.one_of("services", {NATURAL: 0.65, "#d0d0cc": 0.2, "#2a2b2d": 0.05, "#8a9094": 0.1}),
        round_ducts=axes.one_of("round_ducts", {False: 0.75, True: 0.25}),
    )


def ceiling_finishes(ceiling: CeilingLook) -> dict[str, Finish]:
    """Finishes of slabs and beams instead of raw concrete, and of services instead of bare steel and red lacquer."""
    finishes = {}
    if ceiling.finish in _UNDERSIDES:
        finishes["ceiling_concrete"] = tinted(*_UNDERSIDES[ceiling.finish])
    if ceiling.services != NATURAL:
        finishes |= dict.fromkeys(_SERVICES, tinted("housing_white", ceiling.services))
    return finishes
