"""Swept-path proofs of the stalls of a garage as built, from the street over the ramps between its levels."""

from collections.abc import Iterator, Mapping
from dataclasses import replace

from garage2usd.as_built.driven_ground import driven_garage
from garage2usd.as_built.garage import BuiltGarage
from garage2usd.as_built.level import BuiltLevel
from garage2usd.common.progress import Progress, silent
from garage2usd.driving import StallProof, prove_garage
from garage2usd.driving.garage import ABSENT
from garage2usd.garage import LaneKind, LaneNode
from garage2usd.garage.levels import LevelPlace


def prove_built(garage: BuiltGarage, *, progress: Progress = silent) -> tuple[StallProof, ...]:
    """Prove for each stall of all levels that the design car can drive in from the street, and out to it.

    Parameters
    ----------
    garage
        The garage.
    progress
        As for `garage2usd.driving.prove_garage`.

    Returns
    -------
    tuple of StallProof
        One for each stall that takes cars, level by level; names of stalls begin with the level, and touched objects
        are named by their paths in the whole stage.

    Notes
    -----
    Each level is proven among its own obstacles. Its landings count as entrances and exits only as far as lanes and
    ramps join them with the street; of stalls that are not joined with it nothing is proven.
    """
    joined = {stall.name for stall in garage.stalls if stall.access in garage.lanes.driven}
    proofs: list[StallProof] = []
    for number, level in enumerate(garage.levels):
        driven = driven_garage(_joined_with_the_street(garage, number))
        stalls = [stall for stall in driven.stalls if level.place.in_whole(stall.name) in joined]
        proven = {proof.stall: proof for proof in prove_garage(driven, stalls, progress=progress)}
        every = (proven.get(stall.name, StallProof(stall.name)) for stall in driven.stalls)
        proofs += (_in_whole(proof, level.place) for proof in every)
    return tuple(proofs)


def floors_m_of_stalls(garage: BuiltGarage) -> Mapping[str, float]:
    """Return the height of the floor under each stall, in metres, by the name of the stall."""
    return {stall.name: garage.levels[stall.level].place.floor_m for stall in garage.stalls}


def _joined_with_the_street(garage: BuiltGarage, level: int) -> BuiltLevel:
    """Return a level whose landings are portals only where the street leads to them, or they lead to it."""
    whole, own = garage.lanes, garage.levels[level]
    number_of = {(node.level, node.name.rpartition("/")[2]): number for number, node in enumerate(whole.nodes)}
    reached = {end for _, end in whole.arriving}
    leading = {start for start, _ in whole.leaving}

    def nodes() -> Iterator[LaneNode]:
        for node in own.lanes.nodes:
            lives = reached if node.kind == LaneKind.ENTRANCE else leading
            is_shut = node.name in own.landings and number_of.get((level, node.name)) not in lives
            yield replace(node, kind=LaneKind.STRAIGHT.value) if is_shut else node

    return replace(own, lanes=replace(own.lanes, nodes=tuple(nodes())))


def _in_whole(proof: StallProof, place: LevelPlace) -> StallProof:
    def named(touched: str) -> str:
        if touched.startswith(ABSENT):
            return f"{ABSENT}{place.in_whole(touched.removeprefix(ABSENT))}"
        return place.path_in_whole(touched)

    return replace(proof, stall=place.in_whole(proof.stall), touched=tuple(map(named, proof.touched)))
