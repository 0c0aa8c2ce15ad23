"""Settings of people and loose objects: bicycles, trolleys, bins, boxes and the like."""

from enum import StrEnum

from pydantic import Field

from garage2usd.common.settings import Settings

__all__ = ["ClutterAmount", "ClutterConfig"]


class ClutterAmount(StrEnum):
    """Default density of people and loose objects, for all counts that the user leaves out."""

    NONE = "none"
    USUAL = "usual"
    CROWDED = "crowded"
    """Five times the usual counts."""

    @property
    def factor(self) -> float:
        """Factor on the usual counts."""
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
"""Usual counts per hundred stalls; assumptions, as no survey is published."""


class ClutterConfig(Settings):
    """People and loose objects, placed where no car drives or parks.

    Counts are per hundred stalls and upper limits: an object that finds no free place is left out.
    """

    amount: ClutterAmount = ClutterAmount.NONE
    """Default for counts that are left out: 'none', the 'usual' ones, or 'crowded', five times the usual ones."""
    people: float | None = Field(None, ge=0, le=200)
    """People who stand, wait, look at a phone or walk; usually 6."""
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
    """Bags on the floor; usually 1."""
    open_boots: float | None = Field(None, ge=0, le=200)
    """Parked cars whose tailgate or boot lid is open; usually 1.5."""

    def per_hundred(self, what: str) -> float:
        """Return the count per hundred stalls of the setting named `what`."""
        given: float | None = getattr(self, what)
        return _USUAL[what] * self.amount.factor if given is None else given

    @property
    def is_any(self) -> bool:
        """True if any count is greater than 0."""
        return any(self.per_hundred(what) > 0 for what in _USUAL)
