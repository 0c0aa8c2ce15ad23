"""Lookup of names as users spell them."""

from collections.abc import Collection, Mapping
from typing import TypeVar

__all__ = ["find_named"]

_Key = TypeVar("_Key")


def find_named(query: str, names: Mapping[_Key, Collection[str]]) -> list[_Key]:
    """Find all entries with a name; if none matches exactly, ignore case.

    Parameters
    ----------
    query
        The name.
    names
        All names of each entry.
    """
    exactly = [key for key, own in names.items() if query in own]
    folded = query.casefold()
    return exactly or [key for key, own in names.items() if folded in {name.casefold() for name in own}]
