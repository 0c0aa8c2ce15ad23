"""Traffic: a garage in operation, with cars that arrive, park and leave on reserved ground, and people who walk."""

from garage2usd.traffic.operation import Operation

__all__ = ["Operation"]
