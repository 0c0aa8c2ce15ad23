"""Directions and stalls for planned lanes."""

from garage2usd.config import GarageConfig
from garage2usd.planning.orientation import with_directions
from garage2usd.planning.plan import Plan
from garage2usd.planning.stall_kinds import with_stall_kinds

__all__ = ["completed"]


def completed(plan: Plan, config: GarageConfig) -> Plan:
    """Give a plan of lanes its directions and stalls.

    Parameters
    ----------
    plan
        Lanes.
    config
        Which directions and kinds are asked for.

    Raises
    ------
    ConfigError, GenerationError
        As `with_directions` and `with_stall_kinds`.
    """
    return with_stall_kinds(with_directions(plan, config), config)
