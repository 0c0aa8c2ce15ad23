"""Garages as built: levels with lanes, stalls and all objects in metres, from a stage, a layout, a report or a plan."""

from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.level import BuiltLevel

__all__ = ["BuiltGarage", "BuiltLevel"]
