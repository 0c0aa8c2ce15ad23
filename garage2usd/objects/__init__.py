"""The kinds of objects, one module each: measures, mesh, colliders, semantic class and outline on the floor.

A module declares a kind as ``KIND``, and as ``MOUNTED`` the rules that hang its objects on walls and columns. Both are
found by these names, so a new module in this folder is a new kind. Kinds are listed by number.
"""

from importlib import import_module
from pkgutil import iter_modules

from garage2usd.objects.car import CAR_KINDS
from garage2usd.objects.kind import PIECES, Kind, Mounted, PieceClass, Spec, TilePart

__all__ = [
    "CAR_LABELS",
    "CLASSES",
    "CLASSES_VERSION",
    "KINDS",
    "MOUNTED",
    "MOVABLE_LABELS",
    "PIECE_LABELS",
    "Kind",
    "Mounted",
    "PieceClass",
    "Spec",
    "TilePart",
]

_MODULES = [import_module(module.name) for module in iter_modules(__path__, prefix=f"{__name__}.")]

_OTHER_CARS = CAR_KINDS[1:]
CAR_LABELS = frozenset(kind.label for kind in CAR_KINDS)
"""Semantic classes of parked vehicles."""


def _in_order(kinds: list[Kind]) -> tuple[Kind, ...]:
    """Sort kinds of objects by number.

    Raises
    ------
    ValueError
        If two kinds share a number, a name or a label, or if a kind has that of a class of pieces.
    """
    declared: list[Kind | PieceClass] = [*kinds, *_OTHER_CARS, *PIECES]
    numbers, labels = [str(each.number) for each in declared], [each.label for each in declared]
    for facts in (numbers, labels, [kind.name for kind in kinds]):
        twice = sorted({fact for fact in facts if facts.count(fact) > 1})
        if twice:
            raise ValueError(f"declared by more than one kind of object or piece: {', '.join(twice)}")
    return tuple(sorted(kinds, key=lambda kind: kind.number))


KINDS = _in_order([module.KIND for module in _MODULES if hasattr(module, "KIND")])
"""All kinds of objects, in the order of their numbers."""

_ALL: list[Kind | PieceClass] = [*KINDS, *_OTHER_CARS, *PIECES]
CLASSES: tuple[Kind | PieceClass, ...] = tuple(sorted(_ALL, key=lambda each: each.number))
"""All semantic classes of objects and of their pieces, by number: the only table of them."""
CLASSES_VERSION = 8
"""Version of the table of semantic classes, raised when a class is added or covers something else."""
PIECE_LABELS = frozenset(piece.label for piece in PIECES)
"""Semantic classes of pieces; a piece belongs to the object that it is a part of."""

_SPECS = [each for module in _MODULES for each in vars(module).values() if isinstance(each, type)]
MOVABLE_LABELS = CAR_LABELS | {
    each.kind.label for each in _SPECS if issubclass(each, Spec) and each.mass_kg is not Spec.mass_kg
}
"""Semantic classes of objects with a mass, which are no parts of the building."""

MOUNTED: tuple[Mounted, ...] = tuple(
    sorted((module.MOUNTED for module in _MODULES if hasattr(module, "MOUNTED")), key=lambda each: each.kind.number)
)
"""The kinds of objects that hang on walls and columns, by number."""
