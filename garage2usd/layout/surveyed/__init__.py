"""Layouts of surveyed garages: stalls, lanes and columns where the survey has them, in a shell along its outline."""
# Over 300 lines: a floor takes all its parts in one place.

from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
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
from garage2usd.layout.surveyed.ceilings import FloorAbove, surveyed_ceiling
from garage2usd.layout.surveyed.cores import surveyed_blocks, surveyed_cores
from garage2usd.layout.surveyed.floor import placed_stalls, surveyed_beams, surveyed_floor
from garage2usd.layout.surveyed.gates import gates_of, lacking_portals
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.layout.surveyed.ramps import LevelRamps
from garage2usd.layout.surveyed.tiles import SurveyedTiles
from garage2usd.layout.surveyed.walls import surveyed_walls
from garage2usd.layout.table import ObjectTable, StallTable
from garage2usd.look import drawn_look
from garage2usd.objects.column import ColumnSpec
from garage2usd.objects.floor_stain import PuddleSpec, StainSpec, TyreMarkSpec
from garage2usd.objects.kind import rectangle
from garage2usd.structure.lane_graph import Square, StallType
from garage2usd.survey.clear_ground import with_clear_widths, with_lanes_to
from garage2usd.survey.fitted_stalls import FittedStall, Fitting, fitted_stalls
from garage2usd.survey.lane_network import Gate, lane_network
from garage2usd.survey.survey import Ground, Survey, SurveyedPortal, Unplaced

__all__ = ["FloorAbove", "LevelPart", "SurveyedFloor", "lay_out_survey"]
_EQUIPMENT_M = 0.25
"""Depth in metres of what hangs on walls, beside which lanes end."""
_MOST_ROUNDS = 4
"""Number of times that doors are looked for that lanes lack."""
_STAINS, _TYRE_MARK_M = (StainSpec, PuddleSpec, TyreMarkSpec), 4.0


class LevelPart(NamedTuple):
    """What a surveyed level has as a part of a building.

    Attributes
    ----------
    above
        The level above; None of the top one.
    ramps
        Its ramps to other levels.
    has_street
        True if it has a door to the street although its survey has no portal.
    """

    above: FloorAbove | None = None
    ramps: LevelRamps = LevelRamps()
    has_street: bool = True


ALONE = LevelPart()
"""The only level of a building."""


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
    part
        Its part of a building.
    first_landing
        Number of its first lane node that is a landing, in the order of `LevelRamps.gates`.
    """

    survey: Survey
    network: LaneGraph
    fitted: tuple[FittedStall, ...]
    unplaced: tuple[Unplaced, ...]
    labels: Mapping[Square, str] = field(repr=False)
    part: LevelPart = ALONE
    first_landing: int = 0
    matrices: None = None

    @property
    def lanes(self) -> LaneGraph:
        """The lane graph in metres."""
        return self.network

    @property
    def again(self) -> "partial[Layout]":
        """Lay out the same survey again."""
        return partial(lay_out_survey, self.survey, part=self.part)

    @property
    def landings(self) -> dict[Square, Point]:
        """Unit vector (x, z) towards the ramp from each landing of this level, by (row, col) of `node_squares`."""
        return {(0, self.first_landing + number): gate.outwards for number, gate in enumerate(self.part.ramps.gates)}

    @property
    def area(self) -> FloorArea:
        """Area of the ground inside the outline, without blocks and with them."""
        ground = self.survey.ground
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
    part: LevelPart = ALONE,
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
    part
        Its part of a building.
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
    ground = SurveyedGround([survey.outline, *survey.other_outlines], survey.columns)
    if not survey.lanes:
        raise ConfigError("lanes", [], "a lane or more")
    ramps = part.ramps
    doors, network, fitting, added = _joined(survey, ground.polygon, config, part)
    if fitting.laneless:
        with_more = with_lanes_to(survey, fitting.laneless)
        if more := len(with_more.lanes) - len(survey.lanes):
            survey = with_more
            doors, network, fitting, added = _joined(survey, ground.polygon, config, part)
            added = (f"{more} lane{'' if more == 1 else 's'} to stalls without one are laid over free ground", *added)
    survey = replace(survey, remarks=tuple(dict.fromkeys([*survey.remarks, *added])))
    found, unplaced = fitting.stalls, fitting.unplaced
    if not found:
        reasons = ", ".join(dict.fromkeys(each.reason for each in unplaced)) or "it has none"
        raise ConfigError("stalls", reasons, "one stall or more that can be placed")
    stalls, fitted = placed_stalls(found, ground, look.font)
    labels = {stall.square: f"stall_{StallType.TYPE_3.value}" for stall in stalls}
    labels |= {ground.square_at(node.position): node.kind for node in reversed(network.nodes)}
    source = SurveyedFloor(survey, network, fitted, (*survey.unread, *unplaced), labels, part, len(doors))
    tiles = SurveyedTiles(ground, network, stalls, config.bay, survey.solid_polygons(), ramps.standing)
    pillars = _columns(survey, config, look)
    cores = surveyed_cores(tiles, stalls, pillars, config)
    depth_m = ceiling_levels(fittings).beam_depth_m
    opened = shapely.Polygon() if part.above is None else part.above.openings
    floor = Floor(
        tiles=tiles,
        lanes=network,
        stalls=stalls,
        quads=tuple(stall_quads(stalls, source.access(stalls), network)),
        shell=surveyed_walls(ground, doors, fittings, look.walls),
        pillars=pillars,
        blocks=surveyed_blocks(tiles, cores, fittings.ceiling_height_m, look.walls),
        ceilings=list(surveyed_ceiling(ground, config, part.above)),
        beams=[
            beam
            for beam in surveyed_beams(ground, config.bay, fittings.ceiling_height_m, depth_m, pillars)
            if not any(shapely.Polygon(outline).intersects(opened) for outline in beam.outlines())
        ],
        cores=cores,
        shafts=(),
        area_m2=ground.polygon.area,
        draws=SquareDraws([*ground.tiles, *tiles.tiles], seed=config.seed),
        laid=lambda panels: surveyed_floor(ground, panels, stalls, ramps.openings),
        ramps=ramps.placements(),
        ramp_tubes=ramps.tubes(),
    )
    furnishing = furnished(floor, config, look, held_back=held_back, kept_clear=kept_clear, open_boots=open_boots)
    return Layout(
        ground.structure,
        source,
        ObjectTable(ground.on_tiles(_beside_ramps(furnishing.objects, ramps))),
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
    survey: Survey, outline: Ground, config: GarageConfig, part: LevelPart
) -> tuple[list[Gate], LaneGraph, Fitting, tuple[str, ...]]:
    """Return the doors of a survey, its lane graph, its stalls beside lanes, and remarks on doors that it lacks."""
    keeps_left = config.standard.drives_on_left
    stalls = survey.stall_polygons()
    solids = shapely.union_all(survey.solid_polygons())
    taken = shapely.union_all([*stalls, *survey.column_polygons(), solids, *part.ramps.standing])
    # equipment hangs on the walls
    standing = shapely.union_all([taken, outline.boundary.buffer(_EQUIPMENT_M)])
    walls = shapely.union_all([outline.boundary, solids.boundary])
    door_wall_m = config.bay.portal_side_m
    gates = gates_of(outline, survey.portals, taken, door_wall_m=door_wall_m, keeps_left=keeps_left)
    remarks: tuple[str, ...] = ()
    added: set[tuple[Point, SurveyedPortal]] = set()
    for rounds in range(1, _MOST_ROUNDS + 1):
        # ramps to other levels do not stand in for the doors to the street
        has_landings = bool(gates) or not part.has_street or rounds > 1
        landings = part.ramps.gates if has_landings else ()
        network = with_clear_widths(lane_network(survey.lanes, [*gates, *landings], stalls, walls, outline), standing)
        fitting = fitted_stalls(survey, network, keeps_left=keeps_left, walls=walls)
        found = lacking_portals(outline, network, taken, fitting.cut_off, is_near=rounds > 1)
        lacking = {lane: portal for lane, portal in found.items() if (lane, portal) not in added}
        added |= {*lacking.items()}
        if (not lacking and has_landings) or rounds == _MOST_ROUNDS:
            break
        for lane, portal in lacking.items():
            more = gates_of(outline, [portal], taken, door_wall_m=door_wall_m, keeps_left=keeps_left, others=gates)
            gates += [gate._replace(lane=lane) for gate in more]
        if not lacking:
            continue
        places = ", ".join(f"({portal.position[0]:.1f}, {portal.position[1]:.1f})" for portal in lacking.values())
        remarks = (*remarks, f"doors are added where lanes without a way to one come nearest to the outline: {places}")
    return gates, network, fitting, remarks


def _beside_ramps(parts: Iterable[Iterable[Placement]], ramps: LevelRamps) -> Iterator[Iterable[Placement]]:
    """Yield groups of objects, without the stains that reach over the ramps of the level and over its openings."""
    if not ramps.up and not ramps.down:
        yield from parts
        return
    standing = shapely.union_all(ramps.standing)
    for part in parts:
        yield [
            place for place in part if not (isinstance(place.spec, _STAINS) and _ground_of(place).intersects(standing))
        ]


def _ground_of(stain: Placement) -> shapely.Polygon:
    """Return the rectangle around a stain."""
    half_x, half_z = (getattr(stain.spec, name, _TYRE_MARK_M) / 2 for name in ("width_m", "depth_m"))
    return shapely.Polygon([stain.to_world(corner) for corner in rectangle(-half_x, -half_z, half_x, half_z)])


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
