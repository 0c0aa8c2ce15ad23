"""What a stage says that a reader cannot carry on, by reason."""

__all__ = ["Remarks"]

_MOST_PLACES = 5


class Remarks:
    """Collects what is left out or changed: each reason with the places where it came up, each place once."""

    def __init__(self) -> None:
        self._places: dict[str, dict[str, None]] = {}

    def add(self, reason: str, place: object) -> None:
        """Note a place, such as a prim's path, under a reason."""
        self._places.setdefault(reason, {})[str(place)] = None

    def lines(self) -> list[str]:
        """A line for each reason, in the order in which they came up: how many places there are, and the first few."""
        return [
            f"{reason} ({len(places)}): {', '.join([*places][:_MOST_PLACES])}"
            + (", ..." if len(places) > _MOST_PLACES else "")
            for reason, places in self._places.items()
        ]
