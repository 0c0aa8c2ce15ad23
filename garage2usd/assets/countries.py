"""Countries whose signs and number plates are available."""

from enum import StrEnum


class Country(StrEnum):
    """A country, by ISO 3166."""

    NONE = ""
    """No country: international."""
    CN = "CN"
    DE = "DE"
    GB = "GB"
    US = "US"
