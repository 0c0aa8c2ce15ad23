"""Columns of a look: drawn values and finishes."""

from garage2usd.assets import Finish
from garage2usd.config.look import NATURAL, ColumnSection, ColumnsLook, Guard
from garage2usd.look.axes import Group
from garage2usd.look.tint import tinted

__all__ = ["column_finishes", "drawn_columns"]


def drawn_columns(axes: Group) -> ColumnsLook:
    """Draw the look of columns: mostly painted white, square more often than round, with all kinds of guards."""
    return ColumnsLook(
        section=axes.one_of(
            "section", {ColumnSection.SQUARE: 0.55, ColumnSection.ROUND: 0.25, ColumnSection.RECTANGULAR: 0.2}
        ),
        colour=axes.one_of(
            "colour", {"#d6d6d2": 0.45, "#c9c5b8": 0.12, NATURAL: 0.25, "#b2b0aa": 0.12, "#8fa3a8": 0.06}
        ),
        guard=axes.one_of(
            "guard",
            {
                Guard.YELLOW_BLACK: 0.32,
                Guard.RED_WHITE: 0.14,
                Guard.BLUE_YELLOW: 0.12,
                Guard.RUBBER: 0.2,
                Guard.NONE: 0.22,
            },
        ),
        guard_height_m=axes.between("guard_height_m", 0.6, 1.6, 0.2),
    )


def column_finishes(columns: ColumnsLook) -> dict[str, Finish]:
    """Finishes of shafts instead of bare concrete."""
    return {} if columns.colour == NATURAL else {"column_concrete": tinted("column_painted", columns.colour)}
