"""Lanes on a site: the score, Sarsa, and the archive of the best plans."""

from garage2usd.planning.plan import ArchivedPlan, Plan, given_plan
from garage2usd.planning.planner import plan_lanes
from garage2usd.planning.principles import Principles, principles
from garage2usd.planning.score import Score, evaluate, is_feasible

__all__ = [
    "ArchivedPlan",
    "Plan",
    "Principles",
    "Score",
    "evaluate",
    "given_plan",
    "is_feasible",
    "plan_lanes",
    "principles",
]
