"""Names as users spell them."""

from collections.abc import Collection, Mapping
from typing import TypeVar

__all__ = ["called"]

_Key = TypeVar("_Key")


def called(asked: str, names: Mapping[_Key, Collection[str]]) -> list[_Key]:
    """What has a name in these letters; where nothing has, what has it in letters of another case.

    Parameters
    ----------
    asked
        The name.
    names
        All names of each of the things that may be asked for.
    """
    exactly = [key for key, own in names.items() if asked in own]
    folded = asked.casefold()
    return exactly or [key for key, own in names.items() if folded in {name.casefold() for name in own}]
