"""Countries that signs and number plates are those of."""

from enum import StrEnum

__all__ = ["Country"]


class Country(StrEnum):
    """A country, by ISO 3166."""

    NONE = ""
    """None of them: international."""
    CN = "CN"
    DE = "DE"
    GB = "GB"
    US = "US"
