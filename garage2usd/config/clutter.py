"""Settings of the people and the things that stand about."""

from enum import StrEnum

from pydantic import Field

from garage2usd.common.settings import Settings

__all__ = ["ClutterAmount", "ClutterConfig"]


class ClutterAmount(StrEnum):
    """How much stands about where no number is given."""

    NONE = "none"
    USUAL = "usual"
    CROWDED = "crowded"
    """Five times as many."""

    @property
    def factor(self) -> float:
        """Factor of the usual numbers."""
        return {ClutterAmount.NONE: 0.0, ClutterAmount.USUAL: 1.0, ClutterAmount.CROWDED: 5.0}[self]


_USUAL = {
    "people": 6.0,
    "bicycles": 3.0,
    "motorbikes": 2.0,
    "trolleys": 2.0,
    "prams": 0.5,
    "bins": 2.0,
    "boxes": 2.0,
    "pallets": 1.0,
    "bags": 1.0,
    "open_boots": 1.5,
}
"""Per hundred stalls; assumed, as nobody has published a count."""


class ClutterConfig(Settings):
    """People and things that stand where no car drives or parks.

    Numbers are per hundred stalls, and the most there are: what finds no room is left out.
    """

    amount: ClutterAmount = ClutterAmount.NONE
    """The numbers that are not given: none, the usual ones, or five times as many for `crowded`."""
    people: float | None = Field(None, ge=0, le=200)
    """People who stand, wait, look at a phone or walk past; usually 6."""
    bicycles: float | None = Field(None, ge=0, le=200)
    """Bicycles; usually 3."""
    motorbikes: float | None = Field(None, ge=0, le=200)
    """Motorbikes; usually 2."""
    trolleys: float | None = Field(None, ge=0, le=200)
    """Shopping trolleys; usually 2."""
    prams: float | None = Field(None, ge=0, le=200)
    """Prams; usually 0.5."""
    bins: float | None = Field(None, ge=0, le=200)
    """Wheeled waste bins; usually 2."""
    boxes: float | None = Field(None, ge=0, le=200)
    """Cardboard boxes; usually 2."""
    pallets: float | None = Field(None, ge=0, le=200)
    """Pallets, bare or in stacks; usually 1."""
    bags: float | None = Field(None, ge=0, le=200)
    """Bags that are put down; usually 1."""
    open_boots: float | None = Field(None, ge=0, le=200)
    """Parked cars whose tailgate or boot lid is open; usually 1.5."""

    def per_hundred(self, what: str) -> float:
        """How many of something, a name of a setting, there are for each hundred stalls."""
        given: float | None = getattr(self, what)
        return _USUAL[what] * self.amount.factor if given is None else given

    @property
    def is_any(self) -> bool:
        """Whether anything stands about."""
        return any(self.per_hundred(what) > 0 for what in _USUAL)
