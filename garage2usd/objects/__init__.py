"""One module for each kind of object: its measures, mesh, colliders, semantic class and outline on the ground.

Every module that declares a kind binds it as ``KIND``. They are found by that name, so that another module in this
folder is another kind, and listed by their numbers, whatever their modules are called.
"""

from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules

from garage2usd.objects.kind import Kind, Spec

__all__ = ["KINDS", "Kind", "Spec"]


def _declared() -> Iterator[Kind]:
    for module in iter_modules(__path__, prefix=f"{__name__}."):
        kind = getattr(import_module(module.name), "KIND", None)
        if isinstance(kind, Kind):
            yield kind


def _in_order(kinds: list[Kind]) -> tuple[Kind, ...]:
    """Kinds by their numbers.

    Raises
    ------
    ValueError
        If two have the same number, name or label.
    """
    for facts in zip(*((kind.number, kind.name, kind.label) for kind in kinds), strict=True):
        twice = sorted({str(fact) for fact in facts if facts.count(fact) > 1})
        if twice:
            raise ValueError(f"declared by more than one kind of object: {', '.join(twice)}")
    return tuple(sorted(kinds, key=lambda kind: kind.number))


KINDS = _in_order(list(_declared()))
"""All kinds of objects, in the order of their numbers."""
