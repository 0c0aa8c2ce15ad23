"""The lanes of all levels of a stage, joined where levels and ramps still lie as its lane graph has them."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from garage2usd.as_built.level import BuiltLevel
from garage2usd.garage import Fault, LaneEdge, LaneGraph, LaneKind, LaneNode, Stall
from garage2usd.objects.ramp import KIND as RAMP
from garage2usd.reading.lanes import Lanes
from garage2usd.scenes.triangles import triangulated

_RISE_M = 0.01
_MOVED_M = 0.05
_UPWARD = 0.5
_ALONG, _ASIDE = (0.1, 0.5, 0.9), (-0.45, 0.0, 0.45)
"""Shares of the length and of the width of a lane on a ramp at which the ramp has its floor."""
_ON_EDGE = 1e-5
"""Share of a triangle's area by which a place on its edge may lie beside it, as lanes lie on seams of the mesh."""


class FoundLevel(NamedTuple):
    """A level that is in a stage.

    Attributes
    ----------
    built
        The level.
    number
        Its number in the lane graph of the building; None for a level that the lane graph does not have.
    matrix
        From the level as a garage of its own to the whole, in metres with Y up, for row vectors; float64, shape (4, 4).
    """

    built: BuiltLevel
    number: int | None
    matrix: NDArray[np.float64]


class AttachedLevels(NamedTuple):
    """The lanes and stalls of all levels that are in a stage.

    Attributes
    ----------
    lanes, stalls
        Lane graph and stalls, with levels by their index; levels that do not lie as the lane graph of the whole has
        them are joined with no other.
    faults
        Levels that are missing or moved, ramps without a floor or an end.
    """

    lanes: LaneGraph
    stalls: tuple[Stall, ...]
    faults: tuple[Fault, ...]


def attached_levels(whole: Lanes, names: Sequence[str], levels: Sequence[FoundLevel]) -> AttachedLevels:
    """Join the lanes of the levels that a stage has.

    Parameters
    ----------
    whole
        Lane graph of the building.
    names
        Names of the levels that it was written for, by their numbers; empty if unknown.
    levels
        The levels that the stage has.
    """
    faults = list(whole.faults)
    index_of = {level.number: index for index, level in enumerate(levels)}
    numbers = sorted({node.level for node in whole.nodes})
    attached = {}
    for number in numbers:
        index = index_of.get(number)
        name = names[number] if number < len(names) else str(number)
        if index is None:
            said = "the lane graph has this level, which is not in the stage"
            faults.append(Fault("level-missing", name, None, said))
            continue
        far_m = _moved_m(whole.nodes, number, levels[index])
        if far_m > _MOVED_M:
            said = f"the level lies up to {far_m:.2f} m from where its ramps and the lane graph have it"
            faults.append(Fault("level-moved", levels[index].built.place.name, None, said))
        else:
            attached[number] = index
    left_out = {node for node, at in enumerate(whole.nodes) if at.level not in attached}
    left_out |= _broken_ramps(whole.graph, attached, levels, faults)
    kept = [number for number in range(len(whole.nodes)) if number not in left_out]
    new = {number: place for place, number in enumerate(kept)}
    nodes = [replace(whole.nodes[number], level=attached[whole.nodes[number].level]) for number in kept]
    edges = [
        edge._replace(start=new[edge.start], end=new[edge.end])
        for edge in whole.edges
        if edge.start in new and edge.end in new
    ]
    stalls = [
        replace(stall, access=new[stall.access], level=attached[stall.level])
        for stall in whole.stalls
        if stall.level in attached and stall.access in new
    ]
    stalls = [*_of_levels(stalls, levels, faults)]
    for index in sorted({*range(len(levels))}.difference(attached.values())):
        _add_alone(index, levels[index], nodes, edges, stalls)
        if levels[index].number is None:
            said = "the level is not in the lane graph of the building, so no ramp leads to it"
            faults.append(Fault("level-ramp", levels[index].built.place.name, None, said))
    return AttachedLevels(LaneGraph(tuple(nodes), tuple(edges)), tuple(stalls), tuple(faults))


def numbers_of_levels(names: Sequence[str], found: Sequence[str]) -> list[int | None]:
    """Return the number of each level of a stage: by its name, else in the order of those that are left.

    Parameters
    ----------
    names
        Names of the levels by their numbers; empty if unknown.
    found
        Names of the levels that the stage has.
    """
    if not names:
        return list(range(len(found)))
    left = (number for number, name in enumerate(names) if name not in found)
    return [names.index(name) if name in names else next(left, None) for name in found]


def sloped_nodes(lanes: LaneGraph) -> set[int]:
    """Return the numbers of the nodes at the ends of edges that rise or fall."""
    nodes = lanes.nodes
    sloped = (edge for edge in lanes.edges if abs(nodes[edge.start].height_m - nodes[edge.end].height_m) > _RISE_M)
    return {number for edge in sloped for number in (edge.start, edge.end)}


def _moved_m(nodes: Sequence[LaneNode], number: int, level: FoundLevel) -> float:
    """Return how far a level's own lanes lie from those of the whole at most."""
    own = [(node.position[0], node.height_m, node.position[1]) for node in level.built.lanes.nodes]
    told = [(node.position[0], node.height_m, node.position[1]) for node in nodes if node.level == number]
    if not own:
        return 0.0
    from scipy.spatial import cKDTree  # noqa: PLC0415 - half a second that all other commands would wait

    placed = np.array(own) @ level.matrix[:3, :3] + level.matrix[3, :3]
    return float(cKDTree(np.array(told)).query(placed)[0].max())


def _broken_ramps(
    lanes: LaneGraph, attached: dict[int, int], levels: Sequence[FoundLevel], faults: list[Fault]
) -> set[int]:
    """Return the nodes on ramps that lack a floor or a level at one of their ends, and note these ramps as faults."""
    floors = _ramp_floors(levels)
    left_out: set[int] = set()
    for part in sorted(map(sorted, nx.weakly_connected_components(lanes.graph.subgraph(sloped_nodes(lanes))))):
        inner = {*part, *(other for number in part for other in lanes.beside[number])}
        landings = sorted({other for number in inner for other in lanes.beside[number]} - inner)
        ends = {lanes.nodes[number].level for number in landings}
        present = [number for number in landings if lanes.nodes[number].level in attached]
        if not present:
            left_out |= inner
            continue
        node = lanes.nodes[present[0]]
        place = f"{levels[attached[node.level]].built.place.name}/{node.name.rpartition('/')[2]}"
        if not attached.keys() >= ends:
            faults.append(Fault("level-ramp", place, node.position, "the ramp at this landing leads to no level"))
            left_out |= inner
        elif not _has_floor(lanes, {*part}, floors):
            said = "the ramp at this landing has no floor where the lane graph has it"
            faults.append(Fault("level-ramp", place, node.position, said))
            left_out |= inner
    return left_out


def _ramp_floors(levels: Sequence[FoundLevel]) -> NDArray[np.float64]:
    """Return the triangles of all ramps that a car can drive on; float64, shape (triangles, 3, 3)."""
    parts = [np.zeros((0, 3, 3))]
    for level in levels:
        for body in (body for thing in level.built.things if thing.label == RAMP.label for body in thing.bodies):
            corners, _ = triangulated(body.shape.points, body.shape.indices, body.shape.counts)
            places = body.world_points() @ level.matrix[:3, :3] + level.matrix[3, :3]
            parts.append(places[body.shape.indices[corners]])
    triangles = np.concatenate(parts)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    floors: NDArray[np.float64] = triangles[np.abs(normals[:, 1]) > _UPWARD * np.linalg.norm(normals, axis=1)]
    return floors


def _has_floor(lanes: LaneGraph, ramp: set[int], floors: NDArray[np.float64]) -> bool:
    """Return True if a ramp has a floor under all its lanes, along their middle and near both sides."""
    for edge in lanes.edges:
        if edge.start in ramp and edge.end in ramp:
            start, end = (
                np.array([node.position[0], node.height_m, node.position[1]])
                for node in (lanes.nodes[edge.start], lanes.nodes[edge.end])
            )
            aside = np.array([start[2] - end[2], 0.0, end[0] - start[0]])
            aside *= edge.width_m / (np.linalg.norm(aside) or 1.0)
            if not all(
                _is_on(floors, start + along * (end - start) + share * aside) for along in _ALONG for share in _ASIDE
            ):
                return False
    return True


def _is_on(floors: NDArray[np.float64], place: NDArray[np.float64]) -> bool:
    """Return True if a triangle lies straight above or below a place, within the tolerance."""
    first, second, third = (floors[:, corner][:, [0, 2]] - place[[0, 2]] for corner in range(3))
    areas = np.stack([_crossed(second, third), _crossed(third, first), _crossed(first, second)], axis=1)
    whole = areas.sum(axis=1)
    is_flat = whole != 0
    shares = areas[is_flat] / whole[is_flat, None]
    is_over = (shares >= -_ON_EDGE).all(axis=1)
    heights = (shares[is_over] * floors[is_flat][is_over][:, :, 1]).sum(axis=1)
    return bool((np.abs(heights - place[1]) < _MOVED_M).any())


def _crossed(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    return one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]


def _of_levels(stalls: Sequence[Stall], levels: Sequence[FoundLevel], faults: list[Fault]) -> Iterator[Stall]:
    """Yield the stalls that their levels have too, named after the prims of their levels."""
    own = [{stall.name for stall in level.built.stalls} for level in levels]
    for stall in stalls:
        before, _, name = stall.name.rpartition("/")
        level = levels[stall.level].built.place.name
        if name not in own[stall.level]:
            said = "the stall is in the lane graph of the building, but not in that of its level"
            faults.append(Fault("lane-graph", stall.name, stall.centre, said))
            continue
        facts = tuple(
            (fact, f"{level}{value[len(before) :]}" if fact == "blocked_by" and isinstance(value, str) else value)
            for fact, value in stall.facts
        )
        yield stall if before == level else replace(stall, name=f"{level}/{name}", facts=facts)


def _add_alone(
    index: int, level: FoundLevel, nodes: list[LaneNode], edges: list[LaneEdge], stalls: list[Stall]
) -> None:
    """Add the lanes and stalls of a level that no ramp joins with the others; only the top level has a street."""
    first, own, name = len(nodes), level.built, level.built.place.name
    for node in own.lanes.nodes:
        is_cut = node.is_portal and (index > 0 or node.name in own.landings)
        kind = LaneKind.STRAIGHT.value if is_cut else node.kind
        nodes.append(replace(node, kind=kind, height_m=node.height_m + level.built.place.floor_m, level=index))
    edges += [edge._replace(start=edge.start + first, end=edge.end + first) for edge in own.lanes.edges]
    for stall in own.stalls:
        prefixed = ("number", "blocked_by")
        facts = tuple((fact, f"{name}/{value}" if fact in prefixed else value) for fact, value in stall.facts)
        named = f"{name}/{stall.name}"
        stalls.append(replace(stall, name=named, access=stall.access + first, facts=facts, level=index))
