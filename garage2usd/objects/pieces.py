"""Semantic classes of pieces of objects: the paints on floors."""

from dataclasses import dataclass

from garage2usd.assets.mesh import Asset, Part, pascal_case

__all__ = ["PAINT_CLASSES", "PIECES", "PieceClass", "piece_name", "pieces_of"]


@dataclass(frozen=True)
class PieceClass:
    """A semantic class of pieces of objects.

    Attributes
    ----------
    label
        Name of the class, as in `garage2usd.assets.Part.piece`.
    number
        Id of the class, never reused.
    cityscapes
        Name of the nearest Cityscapes class.
    what
        Description in words.
    """

    label: str
    number: int
    cityscapes: str
    what: str


PAINT_CLASSES = (
    PieceClass("stall_line", 29, "parking", "lines between stalls, beside and behind them"),
    PieceClass("lane_line", 30, "road", "lines along the edges and the middle of lanes, and around columns"),
    PieceClass("lane_arrow", 31, "road", "arrows on lanes and portals"),
    PieceClass("crossing", 32, "road", "bars of crossings"),
    PieceClass("hatching", 33, "road", "frames and stripes where nobody parks or stands"),
    PieceClass("stall_symbol", 34, "parking", "symbols of what a stall is for"),
)
"""Classes of paint on floors; painted numbers are objects, of the class ``stall_number``."""

PIECES = PAINT_CLASSES
"""All classes of pieces, by number."""


def pieces_of(asset: Asset) -> dict[str, list[Part]]:
    """Return the parts of each labelled piece of an asset, by label."""
    found: dict[str, list[Part]] = {}
    for part in asset.parts:
        if part.piece:
            found.setdefault(part.piece, []).append(part)
    return found


def piece_name(label: str) -> str:
    """Return the name of a piece's prim, below the prim of its object."""
    return pascal_case(label)
