"""Semantic labels on prims: their taxonomies, and what a prim's label says."""

from collections.abc import Sequence
from functools import cache

from pxr import Usd, Vt

from garage2usd.reading.values import READ_AT, lacks

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
"""Instance name of the labels that name an object's class."""
SQUARE_TAXONOMY = "square"
"""Instance name of what labels say of squares: no class of objects."""
LABELS = "semantics:labels"
"""Namespace of the attributes."""
LABELS_SCHEMA = "SemanticsLabelsAPI"
"""The schema, applied once for each taxonomy."""
FINISH = "garage:material:finish"
"""Attribute of a material that names what it is made of where its own name says what it usually is."""
_ARRAYS = Vt.TokenArray, Vt.StringArray


@cache
def labels_name(taxonomy: str) -> str:
    """Name of the attribute that holds the labels of a taxonomy, for example ``semantics:labels:class``."""
    return f"{LABELS}:{taxonomy}"


def label_of(prim: Usd.Prim, taxonomy: str = OBJECT_TAXONOMY) -> str:
    """The first label of a prim in a taxonomy; empty for none. Raises what `labels_of` raises."""
    labels = _value(prim, taxonomy)
    return str(labels[0]) if labels else ""


def finish_of(material: Usd.Prim) -> str:
    """Name of the material that a material is made of: what its finish says, else its own."""
    attribute = material.GetAttribute(FINISH)
    finish = attribute.Get(READ_AT) if attribute else None
    return finish if isinstance(finish, str) and finish else material.GetName()


def labels_of(prim: Usd.Prim, taxonomy: str) -> tuple[str, ...]:
    """All labels of a prim in a taxonomy.

    Raises
    ------
    StageError
        If the attribute holds something else: USD gives whatever a file has, not what the schema says.
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
