"""Layouts of surveyed garages: stalls, lanes and columns where the survey has them, in a shell along its outline."""

from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig, LookConfig
from garage2usd.garage import LaneGraph, LaneKind, Point
from garage2usd.layout import Layout
from garage2usd.layout.ceiling.beams import ceiling_levels
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.furnishing import Floor, furnished
from garage2usd.layout.measures import FloorArea
from garage2usd.layout.parking.stalls import stall_quads
from garage2usd.layout.placement import PlacedStall, Placement, placed
from garage2usd.layout.source import FloorSource
from garage2usd.layout.surveyed.cores import surveyed_blocks, surveyed_cores
from garage2usd.layout.surveyed.floor import placed_stalls, surveyed_beams, surveyed_floor
from garage2usd.layout.surveyed.gates import gates_of, lacking_portals
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.layout.surveyed.tiles import SurveyedTiles
from garage2usd.layout.surveyed.walls import surveyed_walls
from garage2usd.layout.table import ObjectTable, StallTable
from garage2usd.layout.tiles import CEILING_THICKNESS_M
from garage2usd.look import drawn_look
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.column import ColumnSpec
from garage2usd.structure.lane_graph import Square, StallType
from garage2usd.survey.clear_ground import with_clear_widths, with_lanes_to
from garage2usd.survey.fitted_stalls import FittedStall, Fitting, fitted_stalls
from garage2usd.survey.lane_network import Gate, lane_network
from garage2usd.survey.survey import Survey, SurveyedPortal, Unplaced

__all__ = ["FloorAbove", "SurveyedFloor", "lay_out_survey"]
_EQUIPMENT_M = 0.25
"""Depth in metres of what hangs on walls, beside which lanes end."""
_MOST_ROUNDS = 4
"""Number of times that doors are looked for that lanes lack."""
_UNDER_FLOOR_M = 0.02
"""Distance of a ceiling slab's upper face from a floor above that covers a part of it."""


class FloorAbove(NamedTuple):
    """The level above a surveyed one: height of its floor over that of this level, and its ground (x, z)."""

    storey_m: float
    ground: shapely.Geometry


@dataclass(frozen=True, eq=False)
class SurveyedFloor(FloorSource):
    """The floor of a surveyed garage, which has tiles but no S, R, C and tape.

    Attributes
    ----------
    survey
        The survey, aligned to the axes.
    network
        Its lane graph.
    fitted
        Its stalls in the order of `Layout.stalls`.
    unplaced
        Parts of the survey that the garage lacks, with the reasons.
    labels
        Semantic label of each tile with a lane or stalls.
    above
        The level above; None of the top one.
    """

    survey: Survey
    network: LaneGraph
    fitted: tuple[FittedStall, ...]
    unplaced: tuple[Unplaced, ...]
    labels: Mapping[Square, str] = field(repr=False)
    above: FloorAbove | None = None
    matrices: None = None

    @property
    def lanes(self) -> LaneGraph:
        """The lane graph in metres."""
        return self.network

    @property
    def again(self) -> "partial[Layout]":
        """Lay out the same survey again."""
        return partial(lay_out_survey, self.survey, above=self.above)

    @property
    def area(self) -> FloorArea:
        """Area of the ground inside the outline, without blocks and with them."""
        ground = shapely.Polygon(self.survey.outline)
        solids = shapely.union_all(self.survey.solid_polygons())
        return FloorArea(float(ground.difference(solids).area), float(ground.area))

    def access(self, stalls: Sequence[PlacedStall]) -> list[int]:
        """Return the number of the lane node before the mouth of each stall, given all stalls in order."""
        return [stall.access for _, stall in zip(stalls, self.fitted, strict=True)]

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) that names each lane node in files: (0, number)."""
        count = len(self.network.nodes)
        return np.stack([np.zeros(count, np.int32), np.arange(count, dtype=np.int32)], axis=1)

    def kinds_of_squares(self) -> dict[str, int]:
        """Count the nodes of each kind of lane and portal."""
        counts = Counter(node.kind for node in self.network.nodes)
        return {str(kind): counts[str(kind)] for kind in LaneKind}

    def label_of_square(self, row: int, col: int) -> str:
        """Return the kind of the first lane node on a tile, else the type of its stalls."""
        return self.labels.get((row, col), f"stall_{StallType.TYPE_4.value}")


def lay_out_survey(
    survey: Survey,
    config: GarageConfig,
    *,
    above: FloorAbove | None = None,
    unreachable: Collection[str] = (),
    held_back: Collection[str] = (),
    kept_clear: shapely.Geometry | None = None,
    open_boots: Collection[str] = (),
    **_of_plans: Any,  # noqa: ANN401 - what only layouts of plans take
) -> Layout:
    """Place every object of a surveyed garage.

    Parameters
    ----------
    survey
        A survey that `garage2usd.survey.survey.aligned` returned.
    config
        Sizes, fittings, parking, look and seed.
    above
        The level above; None of the top one.
    unreachable
        Names of stalls that cars do not get into; they stay as they are.
    held_back
        Names of stalls whose cars do not stand over a line.
    kept_clear, open_boots
        As for `garage2usd.layout.lay_out`.

    Raises
    ------
    ConfigError
        If the survey has no lane or no place for a door, or none of its stalls can be placed.
    """
    assert survey.outline is not None
    fittings, look = config.fittings, drawn_look(config.look, config.seed)
    ground = SurveyedGround(survey.outline, survey.columns)
    if not survey.lanes:
        raise ConfigError("lanes", [], "a lane or more")
    gates, network, fitting, added = _joined(survey, ground.polygon, config)
    if fitting.laneless:
        with_more = with_lanes_to(survey, fitting.laneless)
        if more := len(with_more.lanes) - len(survey.lanes):
            survey = with_more
            gates, network, fitting, added = _joined(survey, ground.polygon, config)
            added = (f"{more} lane{'' if more == 1 else 's'} to stalls without one are laid over free ground", *added)
    survey = replace(survey, remarks=tuple(dict.fromkeys([*survey.remarks, *added])))
    found, unplaced = fitting.stalls, fitting.unplaced
    if not found:
        reasons = ", ".join(dict.fromkeys(each.reason for each in unplaced)) or "it has none"
        raise ConfigError("stalls", reasons, "one stall or more that can be placed")
    stalls, fitted = placed_stalls(found, ground, look.font)
    labels = {stall.square: f"stall_{StallType.TYPE_3.value}" for stall in stalls}
    labels |= {ground.square_at(node.position): node.kind for node in reversed(network.nodes)}
    source = SurveyedFloor(survey, network, fitted, (*survey.unread, *unplaced), labels, above)
    tiles = SurveyedTiles(ground, network, stalls, config.bay, survey.solid_polygons())
    pillars = _columns(survey, config, look)
    cores = surveyed_cores(tiles, stalls, pillars, config)
    depth_m = ceiling_levels(fittings).beam_depth_m
    floor = Floor(
        tiles=tiles,
        lanes=network,
        stalls=stalls,
        quads=tuple(stall_quads(stalls, source.access(stalls), network)),
        shell=surveyed_walls(ground, gates, fittings, look.walls),
        pillars=pillars,
        blocks=surveyed_blocks(tiles, cores, fittings.ceiling_height_m, look.walls),
        ceilings=list(_ceiling(ground, config, above)),
        beams=surveyed_beams(ground, config.bay, fittings.ceiling_height_m, depth_m, pillars),
        cores=cores,
        shafts=(),
        area_m2=ground.polygon.area,
        draws=SquareDraws([*ground.tiles, *tiles.tiles], seed=config.seed),
        laid=lambda panels: surveyed_floor(ground, panels, stalls),
    )
    furnishing = furnished(floor, config, look, held_back=held_back, kept_clear=kept_clear, open_boots=open_boots)
    return Layout(
        ground.structure,
        source,
        ObjectTable(ground.on_tiles(furnishing.objects)),
        StallTable(stalls),
        fittings.ceiling_height_m,
        furnishing.illuminance,
        cores,
        np.zeros(ground.structure.shape, np.int32),
        look,
        frozenset(unreachable),
        furnishing.reaching,
        furnishing.misparked,
        frozenset(held_back),
    )


def _joined(
    survey: Survey, outline: shapely.Polygon, config: GarageConfig
) -> tuple[list[Gate], LaneGraph, Fitting, tuple[str, ...]]:
    """Return the doors of a survey, its lane graph, its stalls beside lanes, and remarks on doors that it lacks."""
    keeps_left = config.standard.drives_on_left
    stalls = survey.stall_polygons()
    solids = shapely.union_all(survey.solid_polygons())
    taken = shapely.union_all([*stalls, *survey.column_polygons(), solids])
    # equipment hangs on the walls
    standing = shapely.union_all([taken, outline.boundary.buffer(_EQUIPMENT_M)])
    walls = shapely.union_all([outline.boundary, solids.boundary])
    door_wall_m = config.bay.portal_side_m
    gates = gates_of(outline, survey.portals, taken, door_wall_m=door_wall_m, keeps_left=keeps_left)
    remarks: tuple[str, ...] = ()
    added: set[tuple[Point, SurveyedPortal]] = set()
    for rounds in range(1, _MOST_ROUNDS + 1):
        network = with_clear_widths(lane_network(survey.lanes, gates, stalls, walls), standing)
        fitting = fitted_stalls(survey, network, keeps_left=keeps_left, walls=walls)
        found = lacking_portals(outline, network, taken, fitting.cut_off, is_near=rounds > 1)
        lacking = {lane: portal for lane, portal in found.items() if (lane, portal) not in added}
        added |= {*lacking.items()}
        if not lacking or rounds == _MOST_ROUNDS:
            break
        for lane, portal in lacking.items():
            more = gates_of(outline, [portal], taken, door_wall_m=door_wall_m, keeps_left=keeps_left, others=gates)
            gates += [gate._replace(lane=lane) for gate in more]
        places = ", ".join(f"({portal.position[0]:.1f}, {portal.position[1]:.1f})" for portal in lacking.values())
        remarks = (*remarks, f"doors are added where lanes without a way to one come nearest to the outline: {places}")
    return gates, network, fitting, remarks


def _columns(survey: Survey, config: GarageConfig, look: LookConfig) -> list[Placement]:
    """Place the columns as they were measured, with the guards of the look."""
    height_m, guard = config.fittings.ceiling_height_m, look.columns
    return [
        placed(
            f"Column_{number:03d}",
            ColumnSpec(round(column.size_m, 3), height_m, guard=guard.guard, guard_height_m=guard.guard_height_m),
            column.centre,
        )
        for number, column in enumerate(survey.columns, start=1)
    ]


def _ceiling(ground: SurveyedGround, config: GarageConfig, above: FloorAbove | None) -> Iterator[Placement]:
    """Yield the ceiling slab over the part of each tile inside the outline; its upper face may be a floor."""
    ceiling_m = config.fittings.ceiling_height_m
    for tile in ground:
        left, back, right, front = shapely.intersection(tile.box, ground.polygon).bounds
        spec = CeilingSpec(round(right - left, 6), round(front - back, 6), CEILING_THICKNESS_M)
        if above is not None:
            room_m = round(above.storey_m - ceiling_m, 6)
            if above.ground.covers(shapely.box(left, back, right, front)):
                spec = replace(spec, thickness_m=room_m, bears_floor=True)
            else:
                spec = replace(spec, thickness_m=min(spec.thickness_m, round(room_m - _UNDER_FLOOR_M, 6)))
        place = (left + right) / 2, (back + front) / 2
        yield placed("Ceiling", spec, place, height_m=ceiling_m, square=tile.square)
