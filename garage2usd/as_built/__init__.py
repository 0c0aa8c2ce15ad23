"""Garages as built: lanes, stalls and every object in metres, read from a stage, a layout, a report or a plan."""

from garage2usd.as_built.garage import BuiltGarage

__all__ = ["BuiltGarage"]
