"""Lookup of names as users spell them."""

import difflib
import re
from collections.abc import Collection, Iterable, Mapping
from typing import TypeVar

_SPANS = 12
_COUNTED = re.compile(r"(.*?)(\d{1,9})", re.DOTALL)

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


def nearest(given: str, known: Iterable[str]) -> str:
    """Return the end of a message that names the known word nearest to a misspelt one; empty if none is similar."""
    found = difflib.get_close_matches(given.lower(), known, n=1)
    return f"; the nearest is {found[0]}" if found else ""


def spans_in_words(names: Iterable[str]) -> str:
    """List names in order, consecutive numbers as spans: ``A1-01 to A1-29, A1-31, B1-01, B1-02``.

    Of more than twelve spans the rest is counted.
    """
    spans: list[list[str]] = []
    before: tuple[str, int, int] | None = None
    for name in sorted(set(names), key=lambda name: (_counted(name), name)):
        prefix, number, digits = _counted(name)
        if before in {(prefix, number - 1, digits), (prefix, number - 1, len(str(number - 1)))}:
            spans[-1].append(name)
        else:
            spans.append([name])
        before = prefix, number, digits
    shown = [name for span in spans[:_SPANS] for name in _ends(span)]
    left = sum(map(len, spans[_SPANS:]))
    return ", ".join([*shown, *([f"and {left} more"] if left else [])])


def _ends(span: list[str]) -> list[str]:
    return [f"{span[0]} to {span[-1]}"] if len(span) > 2 else span  # noqa: PLR2004 - a pair


def _counted(name: str) -> tuple[str, int, int]:
    """Split a name into a prefix and the number at its end, with the number of its digits; -1 without one."""
    found = _COUNTED.fullmatch(name)
    return (found[1], int(found[2]), len(found[2])) if found else (name, -1, 0)
