"""Signs of a look."""

from garage2usd.config.look import SignsLook, SignsOf
from garage2usd.look.axes import Group

__all__ = ["drawn_signs"]


def drawn_signs(axes: Group) -> SignsLook:
    """Draw the convention of signs: mostly that of the country."""
    return SignsLook(of=axes.one_of("of", {SignsOf.PROFILE: 0.8, SignsOf.INTERNATIONAL: 0.2}))
