"""The names under which number plates say what is to be read on them, and whose they are."""

__all__ = ["CAR_OF_PLATE", "PLATE_TEXT"]

PLATE_TEXT = "garage:numberPlate:text"
"""Attribute of the prim of a car's number plates: what is to be read on both."""
CAR_OF_PLATE = "garage:numberPlate:car"
"""Relationship of that prim to the car's."""
