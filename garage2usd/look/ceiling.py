"""Which ceilings are drawn."""

from garage2usd.config.look import NATURAL, CeilingFinish, CeilingLook
from garage2usd.look.axes import Group

__all__ = ["drawn_ceiling"]


def drawn_ceiling(axes: Group) -> CeilingLook:
    """A ceiling, and the colour of what hangs below it."""
    return CeilingLook(
        finish=axes.one_of(
            "finish",
            {CeilingFinish.WHITE: 0.4, CeilingFinish.RAW: 0.35, CeilingFinish.BLACK: 0.08, CeilingFinish.BOARDS: 0.17},
        ),
        services=axes.colour("services", {NATURAL: 0.65, "#d0d0cc": 0.2, "#2a2b2d": 0.05, "#8a9094": 0.1}, tone=0.05),
        round_ducts=axes.one_of("round_ducts", {False: 0.75, True: 0.25}),
    )
