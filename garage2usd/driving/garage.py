"""The proof for each stall of a garage that the design car drives in from an entrance and out to an exit."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

from garage2usd.driving.car import DesignCar
from garage2usd.driving.lane_poses import DirectedEdge, LaneDirections
from garage2usd.driving.manoeuvre import Manoeuvre
from garage2usd.driving.obstacles import Obstacles
from garage2usd.driving.proof import LanePose, Limits, find_way
from garage2usd.driving.surroundings import absent_cars, fixed_objects, own_objects, parked_cars
from garage2usd.lanes import LaneGraph, Square
from garage2usd.layout import Layout, Stall
from garage2usd.progress import Progress, silent

__all__ = ["Nose", "StallProof", "prove_stalls"]

_SUSPECTS = 8


class Nose(StrEnum):
    """How a car stands in its stall."""

    IN = "in"
    OUT = "out"

    @property
    def turn_rad(self) -> float:
        """From a stall's yaw to the car's."""
        return 0.0 if self is Nose.IN else math.pi


@dataclass(frozen=True, slots=True)
class StallProof:
    """How a car gets into a stall and out of it, or why it does not.

    Attributes
    ----------
    stall
        Name of the stall.
    nose
        How the car stands in it; None where nothing was proven.
    way_in, way_out
        From a lane pose that cars come to from an entrance, and to one that leads on to an exit.
    is_full
        Whether the ways are clear with a car in every other stall, not only with those that stand there.
    backs_out
        Whether the way out ends on a dead-end aisle of at most 26 m with the nose to its end, to be backed out of.
    touched
        Where nothing was proven: names of the objects of which each alone is in the way, so that without it there
        were ways; where no single one is, of those that were touched most often.
    is_single_cause
        Whether `touched` are such.
    """

    stall: str
    nose: Nose | None = None
    way_in: Manoeuvre | None = None
    way_out: Manoeuvre | None = None
    is_full: bool = False
    backs_out: bool = False
    touched: tuple[str, ...] = ()
    is_single_cause: bool = False

    @property
    def is_proven(self) -> bool:
        """Whether there are both ways."""
        return self.way_in is not None and self.way_out is not None


def prove_stalls(
    layout: Layout,
    graph: LaneGraph,
    *,
    setback_m: float,
    car: DesignCar | None = None,
    limits: Limits | None = None,
    progress: Progress = silent,
) -> tuple[StallProof, ...]:
    """Drive a car into each stall that takes one and out again.

    Parameters
    ----------
    layout, graph
        The garage.
    setback_m
        How far the carriageway stays from squares that are no lane.
    car, limits
        The car, and what is asked of its driver.
    progress
        Told of each stall.

    Returns
    -------
    tuple of StallProof
        One for each stall that takes cars, in the order of the stalls.

    Notes
    -----
    Each other stall holds the car that stands there or else `car` in its middle; where no ways are found, the same is
    tried with only the cars that stand there. Nose in goes before nose out, and driving on before backing out of a
    dead end.
    """
    garage = _Garage(layout, graph, setback_m, car or DesignCar(), limits or Limits())
    stalls = [stall for stall in layout.stalls if stall.use.takes_cars]
    proofs = []
    for done, stall in enumerate(stalls):
        progress("driving", done, len(stalls))
        proofs.append(garage.proof_of(stall))
    return tuple(proofs)


class _Garage:
    """What the proofs of one garage share."""

    def __init__(self, layout: Layout, graph: LaneGraph, setback_m: float, car: DesignCar, limits: Limits) -> None:
        self.car, self.limits = car, limits
        self.directions = LaneDirections(layout.structure, graph, setback_m)
        self.as_it_stands = fixed_objects(layout).joined(parked_cars(layout))
        self.full = self.as_it_stands.joined(absent_cars(layout, car))
        self.poses_at = lru_cache(maxsize=None)(self._poses_at)

    def _poses_at(self, square: Square, *, to_leave: bool, backing: bool) -> tuple[list[LanePose], list[LanePose]]:
        """Lane poses near a square: those that serve both ways, and those that serve the asked one alone."""
        directions = self.directions
        arriving = directions.arriving
        leaving = directions.leaving | (directions.backing if backing else frozenset())
        near = directions.near(square)

        def poses(edges: frozenset[DirectedEdge]) -> list[LanePose]:
            return directions.poses([edge for edge in near if edge in edges], self.car)

        return poses(arriving & leaving), poses(leaving if to_leave else arriving)

    def proof_of(self, stall: Stall) -> StallProof:
        """The ways of one stall, or what is in their way."""
        full = self._seen_from(stall, self.full)
        touched: list[str] = []
        for obstacles in (full, self._seen_from(stall, self.as_it_stands)):
            is_full = obstacles is full
            if not is_full and len(obstacles.pieces) == len(full.pieces):
                continue
            for backing in (False, True):
                if backing and not self._has_backing(stall):
                    continue
                for nose in Nose:
                    way_in, way_out, in_the_way = self._ways(stall, nose, obstacles, self.limits, backing=backing)
                    if way_in and way_out:
                        return StallProof(stall.name, nose, way_in, way_out, is_full, backing)
                    touched += in_the_way
        suspects = tuple(dict.fromkeys(touched))
        causes = tuple(name for name in suspects[:_SUSPECTS] if self._is_proven(stall, full.without([name])))
        return StallProof(stall.name, touched=causes or suspects, is_single_cause=bool(causes))

    def _has_backing(self, stall: Stall) -> bool:
        """Whether backing out of a dead end gives more lane poses near a stall."""
        forward, backing = (
            self.poses_at(stall.access_square, to_leave=True, backing=backing)[1] for backing in (False, True)
        )
        return len(backing) > len(forward)

    def _seen_from(self, stall: Stall, obstacles: Obstacles) -> Obstacles:
        near = obstacles.near(stall.centre_m, 1.5 * (self.limits.reach_m + self.car.length_m))
        return near.without(own_objects(stall, near))

    def _is_proven(self, stall: Stall, obstacles: Obstacles) -> bool:
        """Whether there are ways, looked for roughly."""
        limits = replace(self.limits, is_thorough=False)
        return any(all(self._ways(stall, nose, obstacles, limits, backing=True)[:2]) for nose in Nose)

    def _ways(
        self, stall: Stall, nose: Nose, obstacles: Obstacles, limits: Limits, *, backing: bool
    ) -> tuple[Manoeuvre | None, Manoeuvre | None, Sequence[str]]:
        """The way in, the way out, and what was touched where one is missing."""
        parked = self.car.centred(stall.centre_m, stall.yaw_rad + nose.turn_rad)

        def way(poses: list[LanePose]) -> tuple[Manoeuvre | None, tuple[str, ...]]:
            found = find_way(self.car, parked, obstacles, poses, limits)
            return found.way, found.touched

        both, leave = self.poses_at(stall.access_square, to_leave=True, backing=backing)
        _, arrive = self.poses_at(stall.access_square, to_leave=False, backing=backing)
        out, touched = way(both)
        if out is not None:
            return out.reversed(), out, ()
        out, touched = way(leave) if len(leave) > len(both) else (None, touched)
        if out is None:
            return None, None, touched
        into, touched = way(arrive) if len(arrive) > len(both) else (None, touched)
        return into.reversed() if into else None, out, touched
