"""The four directions of a plan."""

from typing import Literal

__all__ = ["Side"]

Side = Literal["up", "down", "left", "right"]
"""A direction in the plan, or an edge of a square: ``up`` leads to the first row, ``left`` to the first column."""
