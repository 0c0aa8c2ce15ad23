"""Remarks on properties of a stage that a reader omits or changes, grouped by reason."""

_MOST_PLACES = 5


class Remarks:
    """Collector of remarks: each reason with the places where it occurred, each place once."""

    def __init__(self) -> None:
        self._places: dict[str, dict[str, None]] = {}

    def add(self, reason: str, place: object) -> None:
        """Add a place, such as a prim's path, to a remark's reason."""
        self._places.setdefault(reason, {})[str(place)] = None

    def ending(self, end: str) -> list[tuple[str, str]]:
        """Return the reasons that have an ending, each without it and with each of its places."""
        found = [(reason, place) for reason, places in self._places.items() for place in places]
        return [(reason.removesuffix(end).strip(), place) for reason, place in found if reason.endswith(end)]

    def lines(self) -> list[str]:
        """Format one line per reason in order of first occurrence: the number of places, and the first few."""
        return [
            f"{reason} ({len(places)}): {', '.join([*places][:_MOST_PLACES])}"
            + (", ..." if len(places) > _MOST_PLACES else "")
            for reason, places in self._places.items()
        ]
