"""Settings of the planner."""

from typing import Literal

from pydantic import Field

from garage2usd.config.base import Settings

__all__ = ["PlanConfig"]


class PlanConfig(Settings):
    """How lanes are planned. A setting left out takes the preset's value."""

    preset: Literal["paper", "tuned"] = "tuned"
    episodes: int = Field(5000, ge=1, le=1_000_000)
    archive_size: int = Field(200, ge=1, le=10_000)
