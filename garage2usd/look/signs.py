"""Which signs are drawn."""

from garage2usd.config.look import SignsLook, SignsOf
from garage2usd.look.axes import Group

__all__ = ["drawn_signs"]


def drawn_signs(axes: Group) -> SignsLook:
    """Signs, mostly those of the country."""
    return SignsLook(of=axes.one_of("of", {SignsOf.PROFILE: 0.8, SignsOf.INTERNATIONAL: 0.2}))
