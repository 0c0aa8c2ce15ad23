"""Lanes on a site: the score, Sarsa, and the archive of the best plans."""

from garage2usd.planning.plan import ArchivedPlan, Plan, given_plan, plan_lanes
from garage2usd.planning.score import Score, evaluate

__all__ = ["ArchivedPlan", "Plan", "Score", "evaluate", "given_plan", "plan_lanes"]
