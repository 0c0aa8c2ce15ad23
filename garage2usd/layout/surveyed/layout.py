"""The layout of a surveyed garage: its stalls and columns where the survey has them, in a shell along its outline."""

from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

import networkx as nx
import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.config import GarageConfig
from garage2usd.config.look import FloorFinish
from garage2usd.garage import LaneGraph, LaneKind, Stall
from garage2usd.layout import Layout
from garage2usd.layout.ceiling.lamps import TUBE, installed_lamps, ramp_lamps
from garage2usd.layout.ceiling.lighting import lane_points_of, light_up
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.floor.repairs import floor_repairs
from garage2usd.layout.floor.stall_numbers import stall_numbers
from garage2usd.layout.floor_area import FloorArea
from garage2usd.layout.garage_stalls import stall_quads
from garage2usd.layout.parking.designation import chargers
from garage2usd.layout.parking.number_plates import number_plates
from garage2usd.layout.parking.own_cars import with_own_cars
from garage2usd.layout.parking.parked_cars import park_cars
from garage2usd.layout.parking.stall_table import StallTable
from garage2usd.layout.parking.stalls import bare_stall_panels, wheel_stops
from garage2usd.layout.parking.tight import tight_stalls
from garage2usd.layout.placement import Placement, placed
from garage2usd.layout.shell.ramps import ramp_lights, with_barriers, with_ramps
from garage2usd.layout.signs import country_of, with_signs_of
from garage2usd.layout.surveyed.floor import surveyed_floor
from garage2usd.layout.surveyed.ground import SurveyedGround
from garage2usd.layout.surveyed.stalls import placed_stalls
from garage2usd.layout.surveyed.walls import gates_of, surveyed_walls
from garage2usd.layout.table import ObjectTable
from garage2usd.layout.tiles import CEILING_THICKNESS_M
from garage2usd.look import drawn_look
from garage2usd.objects.ceiling import CeilingSpec
from garage2usd.objects.column import ColumnSpec
from garage2usd.structure.grid import Structure
from garage2usd.structure.lane_graph import LaneSquares, StallType
from garage2usd.survey.clear_widths import with_clear_widths
from garage2usd.survey.fitted_stalls import FittedStall, fitted_stalls
from garage2usd.survey.lane_network import lane_network
from garage2usd.survey.survey import Survey, Unplaced

__all__ = ["SurveyedLayout", "lay_out_survey"]

_TUBE_ASIDE_M = 2.0


@dataclass(frozen=True, eq=False)
class SurveyedLayout(Layout):
    """The layout of a surveyed garage. Its squares are tiles of the floor alone; it has no S, R, C, cores and tape.

    Attributes
    ----------
    survey
        The survey, aligned to the axes.
    network
        Its lane graph.
    fitted
        Its stalls in the order of `Layout.stalls`.
    unplaced
        Parts of the survey that it lacks, with the reasons.
    """

    survey: Survey = field(default_factory=lambda: Survey(()))
    network: LaneGraph = field(default_factory=lambda: LaneGraph((), ()))
    fitted: tuple[FittedStall, ...] = ()
    unplaced: tuple[Unplaced, ...] = ()

    @property
    def matrices(self) -> Structure | None:
        """None, as a surveyed garage has no S, R and C."""
        return None

    @property
    def lane_graph(self) -> LaneGraph:
        """The lane graph in metres."""
        return self.network

    @cached_property
    def quads(self) -> tuple[Stall, ...]:
        """The stalls as those of the neutral garage, in the order of `Layout.stalls`, with the facts of a stage."""
        occupied = self.are_occupied().tolist()
        return tuple(stall_quads(tuple(self.stalls), _access(self.fitted), self.network, self.blocked, occupied))

    @property
    def again(self) -> "partial[SurveyedLayout]":  # type: ignore[override]
        """Lay the same survey out again."""
        return partial(lay_out_survey, self.survey)

    @property
    def area(self) -> FloorArea:
        """The ground inside the outline, of which nothing is known to be no floor."""
        area = float(shapely.Polygon(self.survey.outline).area)
        return FloorArea(area, area)

    def node_squares(self) -> NDArray[np.int32]:
        """Return the (row, col) by which files name each lane node, which are counted in one row."""
        count = len(self.network.nodes)
        return np.stack([np.zeros(count, np.int32), np.arange(count, dtype=np.int32)], axis=1)

    def kinds_of_squares(self) -> dict[str, int]:
        """Count the nodes of each kind of lane and portal."""
        counts = Counter(node.kind for node in self.network.nodes)
        return {str(kind): counts[str(kind)] for kind in LaneKind}

    def label_of_square(self, row: int, col: int) -> str:
        """Return the semantic label of a tile: the kind of the first lane node on it, else that of its stalls."""
        return self._labels.get((row, col), f"stall_{StallType.TYPE_4.value}")

    @cached_property
    def _labels(self) -> dict[tuple[int, int], str]:
        edges = self.structure.row_edges_m, self.structure.column_edges_m
        labels = dict.fromkeys(map(tuple, self.stalls.square.tolist()), f"stall_{StallType.TYPE_3.value}")
        for node in reversed(self.network.nodes):
            row, col = (
                int(np.clip(np.searchsorted(lines, at, side="right") - 1, 0, len(lines) - 2))
                for lines, at in zip(edges, node.position[::-1], strict=True)
            )
            labels[row, col] = node.kind
        return labels


def lay_out_survey(
    survey: Survey,
    config: GarageConfig,
    *,
    unreachable: Collection[str] = (),
    held_back: Collection[str] = (),
    **_of_plans: Any,  # noqa: ANN401 - what only layouts of plans take
) -> SurveyedLayout:
    """Place every object of a surveyed garage.

    Parameters
    ----------
    survey
        A survey that `garage2usd.survey.alignment.aligned` returned.
    config
        Sizes, fittings, parking, look and seed.
    unreachable
        Names of stalls that cars do not get into; they stay as they are.
    held_back
        Names of stalls whose cars do not stand over a line.

    Raises
    ------
    ConfigError
        If the survey has no lane or no place for a door, or none of its stalls can be placed.
    """
    assert survey.outline is not None
    fittings, seed, look = config.fittings, config.seed, drawn_look(config.look, config.seed)
    keeps_left = config.standard.drives_on_left
    ground = SurveyedGround(survey.outline)
    if not survey.lanes:
        raise ConfigError("lanes", [], "a lane or more")
    gates = gates_of(
        ground.polygon,
        survey.portals,
        survey.lanes,
        door_wall_m=config.bay.portal_side_m,
        keeps_left=keeps_left,
    )
    network = lane_network(survey.lanes, gates, survey.stall_polygons())
    standing = shapely.union_all([*survey.stall_polygons(), *survey.column_polygons(), ground.polygon.boundary])
    network = with_clear_widths(network, standing)
    found, unplaced = fitted_stalls(survey, network, keeps_left=keeps_left)
    if not found:
        reasons = ", ".join(dict.fromkeys(each.reason for each in unplaced)) or "it has none"
        raise ConfigError("stalls", reasons, "one stall or more that can be placed")
    stalls, fitted = placed_stalls(found, ground)
    draws = SquareDraws(ground.tiles, seed=seed)
    shell = surveyed_walls(ground.polygon, gates, fittings, look.walls)
    pillars = _columns(survey, config)
    lamps, illuminance = light_up(
        installed_lamps(list(_tubes(ground, config)), look.lights, draws, seed=seed),
        _lane_points(network),
        ground.polygon.area,
        stalls,
        fittings,
    )
    country = country_of(look.signs, config.standard)
    tight = tight_stalls(network, tuple(stall_quads(stalls, _access(fitted), network)))
    parked = with_own_cars(
        park_cars(stalls, config, draws, tight=tight, held_back=held_back), stalls, config.vehicles, draws
    )

    def parts() -> Iterator[Iterable[Placement]]:
        yield (floors := list(surveyed_floor(ground, network, stalls)))
        if look.floor.finish is FloorFinish.PATCHED:
            yield floor_repairs(floors, draws)
        yield bare_stall_panels(stalls, look.markings)
        yield wheel_stops(stalls, fittings, config.standard)
        yield [*parked.cars, *number_plates(stalls, parked.cars, draws, country)]
        yield stall_numbers(stalls, None, look, fittings)
        yield chargers(stalls)
        yield _ceiling(ground, config)
        yield lamps
        walls, gates = with_barriers(with_ramps(shell, ground.polygon, fittings, look.walls), fittings)
        yield from (walls, gates)
        yield ramp_lamps(ramp_lights(walls, fittings), look.lights, illuminance.luminance_nit, seed=seed)
        yield pillars

    return SurveyedLayout(
        ground.structure,
        LaneSquares(ground.structure, 0.0, nx.freeze(nx.Graph()), {}, ()),
        ObjectTable(with_signs_of(country, parts())),
        StallTable(stalls),
        fittings.ceiling_height_m,
        illuminance,
        (),
        np.zeros(ground.structure.shape, np.int32),
        look,
        frozenset(unreachable),
        parked.reaching,
        parked.misparked,
        frozenset(held_back),
        survey=survey,
        network=network,
        fitted=fitted,
        unplaced=(*survey.unread, *unplaced),
    )


def _access(fitted: Iterable[FittedStall]) -> Iterator[int]:
    return (stall.access for stall in fitted)


def _columns(survey: Survey, config: GarageConfig) -> list[Placement]:
    height_m = config.fittings.ceiling_height_m
    return [
        placed(f"Column_{number:03d}", ColumnSpec(round(column.size_m, 3), height_m), column.centre)
        for number, column in enumerate(survey.columns, start=1)
    ]


def _ceiling(ground: SurveyedGround, config: GarageConfig) -> Iterator[Placement]:
    """Yield the ceiling slab over each tile, as far as the outline reaches."""
    for tile in ground:
        left, back, right, front = shapely.intersection(tile.box, ground.polygon).bounds
        spec = CeilingSpec(round(right - left, 6), round(front - back, 6), CEILING_THICKNESS_M)
        place = (left + right) / 2, (back + front) / 2
        yield placed("Ceiling", spec, place, height_m=config.fittings.ceiling_height_m, square=tile.square)


def _tubes(ground: SurveyedGround, config: GarageConfig) -> Iterator[Placement]:
    """Yield tube lights under the ceiling of each tile whose middle is inside the outline."""
    count = config.fittings.tubes_per_cell
    for tile in ground:
        x, z = tile.middle_m
        if not count or not ground.polygon.contains(shapely.Point(x, z)):
            continue
        aside = (-_TUBE_ASIDE_M, _TUBE_ASIDE_M) if count > 1 else (0.0,)
        for number, along in enumerate(aside, start=1):
            height_m = config.fittings.ceiling_height_m
            yield placed(f"Tube_{number}", TUBE, (x + along, z), height_m=height_m, square=tile.square)


def _lane_points(network: LaneGraph) -> NDArray[np.float64]:
    """Return points on the lanes at which their illuminance is computed."""
    return lane_points_of(
        (*node.position, *(node.sides_m or node.widths_m)) for node in network.nodes if not node.is_portal
    )
