"""Lanes on a site: the score, Sarsa, and the archive of the best plans."""

from garage2usd.planning.circulation import MeasuredCirculation, measured_circulation, neither_share
from garage2usd.planning.dimensions import area_per_stall_m2, dimension, dimensioned
from garage2usd.planning.optimum import Optimum, counting_bound, find_optimum
from garage2usd.planning.orientation import DrivenLengths, completed, driven_lengths, with_directions
from garage2usd.planning.plan_tape import is_of_lanes_alone, plan_tape_of, play_plan, read_tail, tail_of
from garage2usd.planning.planner import ArchivedPlan, Plan, alternatives, given_plan, plan_lanes
from garage2usd.planning.score import Principles, Score, evaluate, is_feasible, principles
from garage2usd.planning.stall_kinds import runs_of_settings, settings_of_runs, with_stall_kinds
from garage2usd.planning.tape import play, rank_of, tape_at, tape_of

__all__ = [
    "ArchivedPlan",
    "DrivenLengths",
    "MeasuredCirculation",
    "Optimum",
    "Plan",
    "Principles",
    "Score",
    "alternatives",
    "area_per_stall_m2",
    "completed",
    "counting_bound",
    "dimension",
    "dimensioned",
    "driven_lengths",
    "evaluate",
    "find_optimum",
    "given_plan",
    "is_feasible",
    "is_of_lanes_alone",
    "measured_circulation",
    "neither_share",
    "plan_lanes",
    "plan_tape_of",
    "play",
    "play_plan",
    "principles",
    "rank_of",
    "read_tail",
    "runs_of_settings",
    "settings_of_runs",
    "tail_of",
    "tape_at",
    "tape_of",
    "with_directions",
    "with_stall_kinds",
]
