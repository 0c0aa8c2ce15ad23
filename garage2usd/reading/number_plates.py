"""Names of the USD properties that hold the text and the car of number plates."""

PLATE_TEXT = "garage:numberPlate:text"
"""Attribute of the prim of a car's number plates: the text on both plates."""
CAR_OF_PLATE = "garage:numberPlate:car"
"""Relationship from the prim of number plates to the prim of their car."""
