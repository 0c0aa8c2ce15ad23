"""Semantic labels of prims: taxonomies and attributes."""

from collections.abc import Sequence
from functools import cache

from pxr import Usd, Vt

from garage2usd.scenes.values import READ_AT, lacks

__all__ = [
    "FINISH",
    "LABELS",
    "LABELS_SCHEMA",
    "OBJECT_TAXONOMY",
    "SQUARE_TAXONOMY",
    "finish_of",
    "label_of",
    "labels_name",
    "labels_of",
]

OBJECT_TAXONOMY = "class"
"""Instance name of the labels with an object's class."""
SQUARE_TAXONOMY = "square"
"""Instance name of the labels of squares, which are not object classes."""
LABELS = "semantics:labels"
"""Namespace of the label attributes."""
LABELS_SCHEMA = "SemanticsLabelsAPI"
"""The label schema, applied once for each taxonomy."""
FINISH = "garage:material:finish"
"""Attribute of a material with the name of its substance, if it differs from the material's own name."""
_ARRAYS = Vt.TokenArray, Vt.StringArray


@cache
def labels_name(taxonomy: str) -> str:
    """Return the name of a taxonomy's label attribute, for example ``semantics:labels:class``."""
    return f"{LABELS}:{taxonomy}"


def label_of(prim: Usd.Prim, taxonomy: str = OBJECT_TAXONOMY) -> str:
    """Return the first label of a prim in a taxonomy; empty without one. Raises as `labels_of`."""
    labels = _value(prim, taxonomy)
    return str(labels[0]) if labels else ""


def finish_of(material: Usd.Prim) -> str:
    """Return the name of a material's substance: its finish, else the material's own name."""
    attribute = material.GetAttribute(FINISH)
    finish = attribute.Get(READ_AT) if attribute else None
    return finish if isinstance(finish, str) and finish else material.GetName()


def labels_of(prim: Usd.Prim, taxonomy: str) -> tuple[str, ...]:
    """Return all labels of a prim in a taxonomy.

    Raises
    ------
    StageError
        If the attribute has another type: USD returns the type in the file, not that of the schema.
    """
    return tuple(map(str, _value(prim, taxonomy)))


def _value(prim: Usd.Prim, taxonomy: str) -> Sequence[str]:
    attribute = prim.GetAttribute(labels_name(taxonomy))
    labels = attribute.Get(READ_AT) if attribute else None
    if labels is None:
        return ()
    if not isinstance(labels, _ARRAYS):
        raise lacks(attribute, "labels")
    found: Sequence[str] = labels
    return found
