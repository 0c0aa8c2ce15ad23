"""Proof for each stall of a garage that the design car can drive in from an entrance and out to an exit.

The garage is plain geometry: stalls, lanes by direction, and obstacles.
"""
# Over 300 lines: what is proven of a garage is declared beside what proves it.

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property, lru_cache

import numpy as np
import shapely

from garage2usd.common.progress import Progress, silent
from garage2usd.driving.car import DesignCar, Pose
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.proof import (
    LanePose,
    Limits,
    Outcome,
    Search,
    families,
    lane_poses,
    least_clearance_m,
    touched_parked,
)
from garage2usd.driving.way_search import find_guided_way, find_way_by_steps
from garage2usd.garage import DEAD_END_LIMIT_M, Arc, LaneGraph, Point, Stall
from garage2usd.native import elementary

Find = Callable[[DesignCar, Pose, Obstacles, Sequence[LanePose], Limits], Search]
ABSENT = "a car in "
"""Beginning of the name of the car that stands in an empty stall in a proof; the name of the stall follows."""
_SUSPECTS = 8
_NEAR_EDGES, _DIGITS = 2, 4
_FURTHER_OUT_M = (0.0, 0.1, 0.2, 0.3)


class Nose(StrEnum):
    """Orientation of a parked car: nose in or nose out."""

    IN = "in"
    OUT = "out"

    @property
    def turn_rad(self) -> float:
        """Turn from a stall's yaw to the yaw of the parked car."""
        return 0.0 if self is Nose.IN else math.pi


@dataclass(frozen=True, slots=True)
class StallProof:
    """Proof that a car can drive into a stall and out of it, or the obstacles that prevent it.

    Attributes
    ----------
    stall
        Name of the stall.
    nose
        Nose in or nose out; None without a proof.
    way_in, way_out
        Manoeuvres from a lane pose reachable from an entrance, and to one that leads to an exit.
    is_full
        True if the manoeuvres are collision-free with a car in every other stall, not only with the parked cars.
    backs_out
        True if the manoeuvre out ends nose first in a dead-end aisle of at most 26 m, to be backed out of.
    touched
        Without a proof: names of the objects that each block the stall alone, in the order of the obstacles, cars last.
        If there is no such object, the names of the objects touched most often.
    is_single_cause
        True if each object of `touched` blocks the stall alone.
    is_undecided
        True if there is no proof because a search reached its bound: manoeuvres may exist.
    clearance_m
        Lower bound of the clearance between the car and the first such object, on manoeuvres clear of all others;
        negative if the car would intersect it.
    """

    stall: str
    nose: Nose | None = None
    way_in: Manoeuvre | None = None
    way_out: Manoeuvre | None = None
    is_full: bool = False
    backs_out: bool = False
    touched: tuple[str, ...] = ()
    is_single_cause: bool = False
    clearance_m: float | None = None
    is_undecided: bool = False

    @property
    def is_proven(self) -> bool:
        """True if both manoeuvres were found."""
        return self.way_in is not None and self.way_out is not None

    @property
    def outcome(self) -> Outcome:
        """Outcome: reached, impossible at the search's resolution, or undecided because a search reached its bound."""
        if self.is_proven:
            return Outcome.REACHED
        return Outcome.UNDECIDED if self.is_undecided else Outcome.IMPOSSIBLE


@dataclass(frozen=True, eq=False)
class DrivenGarage:
    """A garage for driving.

    Attributes
    ----------
    stalls
        Stalls that take cars.
    lanes
        Lane graph.
    standing
        Obstacles, including the parked cars.
    taken
        Names of the stalls with a parked car.
    own
        Names of a stall's own obstacles, ignored by a car that parks there: its car, wheel stop and cones.
    """

    stalls: tuple[Stall, ...]
    lanes: LaneGraph
    standing: Obstacles
    taken: frozenset[str] = frozenset()
    own: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    @cached_property
    def backing(self) -> frozenset[Arc]:
        """Arcs into dead-end aisles that cars may back out of."""
        return self.lanes.into_dead_ends(DEAD_END_LIMIT_M)

    def near(self, node: int) -> list[Arc]:
        """Return the arcs at most two edges from a lane node, the nearest first."""
        return self.lanes.near(node, _NEAR_EDGES)

    def unseen(self, stall: Stall) -> tuple[str, ...]:
        """Return the obstacles ignored by a car that parks in a stall: the stall's own, and its assumed car; names."""
        own = self.own.get(stall.name, ())
        return own if stall.name in self.taken else (*own, _absent(stall))

    def absent_cars(self, car: DesignCar) -> Obstacles:
        """Return a car in the middle of each empty stall as obstacles."""
        empty = [stall for stall in self.stalls if stall.name not in self.taken]
        corners = [car.corners(car.centred(middle_of(stall), stall.yaw_rad)) for stall in empty]
        grounds = shapely.polygons(np.array(corners).reshape(-1, 4, 2))
        return Obstacles.of(zip(map(_absent, empty), grounds, strict=True))


def middle_of(stall: Stall) -> Point:
    """Return (x, z) of the middle of a stall, rounded to 0.1 mm, which single precision preserves."""
    x, z = stall.centre
    return round(x, _DIGITS), round(z, _DIGITS)


def _absent(stall: Stall) -> str:
    return f"{ABSENT}{stall.name}"


def prove_garage(
    garage: DrivenGarage,
    stalls: Iterable[Stall] | None = None,
    *,
    car: DesignCar | None = None,
    limits: Limits | None = None,
    noses: Sequence[Nose] = tuple(Nose),
    with_all_taken_only: bool = False,
    most_explained: int | None = None,
    progress: Progress = silent,
) -> tuple[StallProof, ...]:
    """Prove for each stall of a garage that a car can drive in and out.

    Parameters
    ----------
    garage
        The garage.
    stalls
        Stalls to prove; the default is all.
    car, limits
        The car, and the limits of its manoeuvres.
    noses
        Orientations that a parked car may have, the preferred one first.
    with_all_taken_only
        True to reject manoeuvres that need other stalls to be empty.
    most_explained
        Number of stalls without manoeuvres for which a single cause is sought; None for all.
    progress
        Function called for each stall.

    Returns
    -------
    tuple of StallProof
        One for each stall, in their order.

    Notes
    -----
    Each other stall holds its parked car, or else `car` in its middle. If no manoeuvres are found, the search is
    repeated with the parked cars only. Driving on is tried before backing out of a dead end.
    """
    prover = _Prover(garage, car or DesignCar(), limits or Limits(), noses)
    asked = garage.stalls if stalls is None else tuple(stalls)
    proofs, failed = [], 0
    for done, stall in enumerate(asked):
        progress("driving", done, len(asked))
        proof = prover.proof_of(stall, with_all_taken_only=with_all_taken_only)
        if not proof.is_proven and (most_explained is None or failed < most_explained):
            proof = prover.explained(stall, proof)
        failed += not proof.is_proven
        proofs.append(proof)
    return tuple(proofs)


class _Prover:
    """Prover of a garage's stalls, with shared caches."""

    def __init__(self, garage: DrivenGarage, car: DesignCar, limits: Limits, noses: Sequence[Nose]) -> None:
        self.car, self.limits, self.noses = car, limits, noses
        self.garage = garage
        self.as_it_stands = garage.standing
        self.full = garage.standing.joined(garage.absent_cars(car))
        self.poses_at = lru_cache(maxsize=None)(self._poses_at)

    def _poses_at(self, node: int, *, to_leave: bool, backing: bool) -> tuple[list[LanePose], list[LanePose]]:
        """Return the lane poses near a node: those for both manoeuvres, and those for the requested one."""
        lanes = self.garage.lanes
        arriving = lanes.arriving
        leaving = lanes.leaving | (self.garage.backing if backing else frozenset())
        near = self.garage.near(node)

        def poses(arcs: frozenset[Arc]) -> list[LanePose]:
            return lane_poses(lanes, [arc for arc in near if arc in arcs], self.car)

        return poses(arriving & leaving), poses(leaving if to_leave else arriving)

    def proof_of(self, stall: Stall, *, with_all_taken_only: bool) -> StallProof:
        """Prove one stall; without a proof, report the objects touched."""
        by_steps = self._proof_by(find_way_by_steps, stall, with_all_taken_only=with_all_taken_only)
        if by_steps.is_proven or not self.limits.is_thorough:
            return by_steps
        guided = self._proof_by(find_guided_way, stall, with_all_taken_only=with_all_taken_only)
        if guided.is_proven:
            return guided
        return replace(by_steps, is_undecided=by_steps.is_undecided or guided.is_undecided)

    def _proof_by(self, find: Find, stall: Stall, *, with_all_taken_only: bool) -> StallProof:
        full = self._seen_from(stall, self.full)
        touched: list[str] = []
        is_undecided = False
        as_it_stands = self._seen_from(stall, self.as_it_stands)
        is_all = with_all_taken_only or len(as_it_stands.pieces) == len(full.pieces)
        for obstacles in (full,) if is_all else (full, as_it_stands):
            for backing in (False, True):
                if backing and not self._has_backing(stall):
                    continue
                for nose in self.noses:
                    ways = self._ways(stall, nose, obstacles, self.limits, backing=backing, find=find)
                    if ways.into and ways.out:
                        return StallProof(stall.name, nose, ways.into, ways.out, obstacles is full, backing)
                    touched += ways.touched
                    is_undecided = is_undecided or ways.is_undecided
        return StallProof(stall.name, touched=tuple(dict.fromkeys(touched)), is_undecided=is_undecided)

    def explained(self, stall: Stall, proof: StallProof) -> StallProof:
        """Add to the failed proof of a stall the objects that block it alone, if any."""
        full, suspects = self._seen_from(stall, self.full), proof.touched
        without = {name: self._ways_without(stall, name, full) for name in suspects[:_SUSPECTS]}
        causes = tuple(sorted((name for name, ways in without.items() if ways), key=self.full.names.index))
        if not causes:
            return proof
        cause = full.only(causes[0])
        clearance_m = min(least_clearance_m(self.car, way, cause) for way in without[causes[0]])
        return replace(proof, touched=causes, is_single_cause=True, clearance_m=clearance_m)

    def _has_backing(self, stall: Stall) -> bool:
        """Return True if backing out of a dead end adds lane poses near a stall."""
        forward, backing = (self.poses_at(stall.access, to_leave=True, backing=backing)[1] for backing in (False, True))
        return len(backing) > len(forward)

    def _seen_from(self, stall: Stall, obstacles: Obstacles) -> Obstacles:
        near = obstacles.near(middle_of(stall), 1.5 * (self.limits.reach_m + self.car.length_m))
        return near.without(self.garage.unseen(stall))

    def _ways_without(self, stall: Stall, name: str, obstacles: Obstacles) -> tuple[Manoeuvre, ...]:
        """Search both manoeuvres coarsely with one obstacle removed; empty if either is missing."""
        limits = replace(self.limits, is_thorough=False)
        for nose in self.noses:
            ways = self._ways(stall, nose, obstacles.without([name]), limits, backing=True, find=find_way_by_steps)
            if ways.into and ways.out:
                return ways.into, ways.out
        return ()

    def _parked(self, stall: Stall, nose: Nose, obstacles: Obstacles) -> Pose:
        """Return the parked pose in the middle of the stall, moved out as little as obstacles behind require."""
        (x, z), yaw_rad = middle_of(stall), stall.yaw_rad
        sin, cos = elementary.sin(yaw_rad), elementary.cos(yaw_rad)
        poses = [
            self.car.centred((x + sin * out_m, z + cos * out_m), yaw_rad + nose.turn_rad) for out_m in _FURTHER_OUT_M
        ]
        clear = (pose for pose in poses if not touched_parked(self.car, pose, obstacles, self.limits.margin_m))
        return next(clear, poses[0])

    def _ways(
        self, stall: Stall, nose: Nose, obstacles: Obstacles, limits: Limits, *, backing: bool, find: Find
    ) -> "_Ways":
        """Search the manoeuvres into and out of a stall."""
        parked = self._parked(stall, nose, obstacles)

        def way(poses: list[LanePose]) -> Search:
            searches = []
            for family in families(poses):
                searches.append(find(self.car, parked, obstacles, family, limits))
                if searches[-1].way is not None:
                    return searches[-1]
            touched = dict.fromkeys(name for one in searches for name in one.touched)
            return Search(None, tuple(touched), all(one.is_exhausted for one in searches))

        both, leave = self.poses_at(stall.access, to_leave=True, backing=backing)
        _, arrive = self.poses_at(stall.access, to_leave=False, backing=backing)
        out = way(both)
        if out.way is not None:
            return _Ways(out.way.reversed(), out.way)
        further = way(leave) if len(leave) > len(both) else out
        if further.way is None:
            return _Ways(None, None, further.touched, not (out.is_exhausted and further.is_exhausted))
        into = way(arrive) if len(arrive) > len(both) else Search(None, (), out.is_exhausted)
        if into.way is not None:
            return _Ways(into.way.reversed(), further.way)
        return _Ways(None, further.way, into.touched, not into.is_exhausted)


@dataclass(frozen=True, slots=True)
class _Ways:
    """Manoeuvres into and out of a stall; if one is missing, also the touched objects and the search outcome."""

    into: Manoeuvre | None
    out: Manoeuvre | None
    touched: tuple[str, ...] = ()
    is_undecided: bool = False
