"""Places of the ramps of a surveyed building: their carriageways between the lanes of two levels."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import shapely

from garage2usd.config import GarageConfig
from garage2usd.garage import Point
from garage2usd.garage.path_line import PathLine
from garage2usd.garage.ramp_lines import ramp_profile
from garage2usd.layout.ceiling.beams import ceiling_levels
from garage2usd.layout.surveyed.ramps import LevelRamps, PlacedRamp, Storey
from garage2usd.site.ramp_places import LEVEL_END_M
from garage2usd.structure.helix import WALL_M
from garage2usd.survey.lane_network import USUAL_LANE_M, Gate
from garage2usd.survey.survey import Survey, SurveyedLane
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedRamp

_ONE_WAY_M, _LEAST_M = 3.75, 3.0
"""Width in metres between the walls of a ramp in one direction of unknown width, and the least one."""
_RADIUS_M = 8.0
"""Radius of a ramp's middle line in the corners of its survey."""
_STEEPEST = 0.25
_TURN_M = 3.5
"""Greatest length of the level ground between a lane and a ramp."""
_STRAIGHT_M = 2.0
"""Length of the straight at the end of a ramp before its first bend, as far as the survey has one."""
_FAR_M, _STEP_M = 1.5, 0.1
"""Distance beyond the side of a lane up to which a ramp ends on it, and that of places where this is tried."""
_AROUND_M = 0.3
"""Distance of a ramp from the outline that is widened for it."""
_UNDER_M = 0.15
"""Room for lamps under the slab over the foot of a ramp."""
_TOUCH_M = 0.05
_ACROSS = 0.7
"""Sine of the angle from which on a lane passes a ramp."""


def placed_ramps(
    building: SurveyedBuilding, floors_m: Sequence[float], configs: Sequence[GarageConfig]
) -> tuple[list[LevelRamps], list[str]]:
    """Place the ramps of a building between its levels, the top one first.

    Parameters
    ----------
    building
        The building, aligned.
    floors_m
        Height of the floor of each level.
    configs
        Settings of each level.

    Returns
    -------
    tuple
        The ramps of each level, and remarks on those that are not built.
    """
    number_of = {level.name: number for number, level in enumerate(building.levels)}
    found: list[PlacedRamp] = []
    remarks = []
    for ramp in building.ramps:
        if not set(ramp.levels) <= number_of.keys():
            continue  # its level is left out, and named
        first, last = (number_of[name] for name in ramp.levels)
        lower = max(first, last)
        if abs(first - last) != 1:
            made: list[PlacedRamp] | str = "it does not join levels next to one another"
        else:
            fittings, above = configs[lower].fittings, configs[lower - 1].fittings
            storey = Storey(
                round(floors_m[lower - 1] - floors_m[lower], 6), fittings.ceiling_height_m, above.ceiling_height_m
            )
            upwards = ramp.points if first == lower else ramp.points[::-1]
            surveys = building.levels[lower].survey, building.levels[lower - 1].survey
            ways = (False, True) if not ramp.one_way else (first < last,)
            made = _carriageways(ramp, upwards, ways, lower - 1, surveys, storey, configs[lower])
        named = f"ramp {ramp.name} between levels {' and '.join(ramp.levels)}"
        if isinstance(made, str):
            remarks.append(f"{named} is not built: {made}")
            continue
        found += made
    of_levels = [
        LevelRamps(
            tuple(ramp for ramp in found if ramp.upper == number - 1),
            tuple(ramp for ramp in found if ramp.upper == number),
            shapely.union_all([ramp.ground for ramp in found if ramp.upper == number - 2]),
        )
        for number in range(len(building.levels))
    ]
    return of_levels, remarks


def _carriageways(
    ramp: SurveyedRamp,
    upwards: Sequence[Point],
    ways: Sequence[bool],
    upper: int,
    surveys: tuple[Survey, Survey],
    storey: Storey,
    config: GarageConfig,
) -> list[PlacedRamp] | str:
    """Return the carriageways of a ramp, from its foot up; or the reason why it is not built."""
    least_m = len(ways) * _LEAST_M
    width_m = max(ramp.width_m - 2 * WALL_M if ramp.width_m else len(ways) * _ONE_WAY_M, least_m)
    line = PathLine.rounded(upwards, width_m, _RADIUS_M)
    ends_m = []
    for survey, towards in zip(surveys, (line, line.turned()), strict=True):
        on_lanes_m = _on_lanes_m(survey, towards)
        if on_lanes_m is None:
            return f"its end is more than {_FAR_M:g} m from the lanes"
        ends_m.append(on_lanes_m)
    run_m = line.length_m - sum(ends_m)
    gentle_m = max(min(config.building.ramp_transition_m, run_m / 4), 0.0)
    fixed_m = 2 * LEVEL_END_M + gentle_m
    if storey.rise_m > _STEEPEST * (run_m - fixed_m):
        least_m = storey.rise_m / _STEEPEST + config.building.ramp_transition_m + 2 * LEVEL_END_M
        told = f"{max(run_m, 0.0):.1f} m between the lanes for {storey.rise_m:.2f} m of height"
        return f"{told}; {least_m:.1f} m are needed"
    # level ground to turn on before the ramp, as far as that makes it no steeper than asked
    usual_m = storey.rise_m / (config.building.ramp_slope_percent / 100) + fixed_m
    turn_m = min(max((run_m - usual_m) / 2, 0.0), _TURN_M)
    for end, towards in enumerate((line, line.turned())):
        # a ramp does not begin in a bend where its line has a straight before that
        straight_m = towards.straight_m - ends_m[end]
        ends_m[end] += min(turn_m, max(straight_m - _STRAIGHT_M, 0.0)) if straight_m > 0 else turn_m
    line = line.between(ends_m[0], line.length_m - ends_m[1])
    standing = shapely.union_all(
        [part for survey in surveys for part in (*survey.stall_polygons(), *survey.column_polygons())]
    )
    for wide_m in (width_m, least_m):
        sides_m = (wide_m / 2 + WALL_M, wide_m / 2 + WALL_M)
        if not line.ground(0.0, line.length_m, sides_m).buffer(-_TOUCH_M).intersects(standing):
            break
    else:
        return f"stalls or columns stand on its {least_m + 2 * WALL_M:.1f} m"
    keeps_left = config.standard.drives_on_left
    clear_m = config.fittings.clear_height_m + max(ceiling_levels(config.fittings).beam_depth_m, _UNDER_M)
    found = []
    for is_down in ways:
        # looking up, with 1 on the right
        side = 0 if len(ways) == 1 else 1 if is_down is keeps_left else -1
        own = line.beside(side * wide_m / 4, wide_m / len(ways))
        profile = tuple(
            (round(run, 4), round(height, 6))
            for run, height in ramp_profile(own.length_m, storey.rise_m, gentle_m, (LEVEL_END_M, LEVEL_END_M))
        )
        name = "".join(sign if sign.isalnum() and sign.isascii() else "_" for sign in ramp.name)
        found.append(
            PlacedRamp(
                f"{name}_{'Down' if is_down else 'Up'}",
                ramp.name,
                upper,
                own,
                is_down,
                storey,
                (side >= 0, side <= 0),
                profile,
                max(storey.ceiling_m - clear_m, 0.0),
            )
        )
    return found


def _on_lanes_m(survey: Survey, line: PathLine) -> float | None:
    """Return how far a line runs on the lanes of a level from its begin; None if it begins far from them."""
    lanes = shapely.union_all(
        [shapely.LineString(lane.points).buffer((lane.width_m or USUAL_LANE_M) / 2) for lane in survey.lanes]
    )
    if lanes.distance(shapely.Point(line.points[0])) > _FAR_M:
        return None
    runs = np.arange(0.0, line.length_m, _STEP_M)
    places = line.at(runs)
    off = np.flatnonzero(~shapely.contains_xy(lanes, places.u_m, places.v_m))
    return float(runs[off[0]]) + _STEP_M if len(off) else line.length_m


def lanes_to_landings(lanes: Sequence[SurveyedLane], gates: Sequence[Gate]) -> tuple[SurveyedLane, ...]:
    """Lengthen the lanes that end beside the middle of a ramp, so that they pass both of its carriageways."""
    found = []
    for lane in lanes:
        points = [*lane.points]
        for _ in range(2):
            (x, z), (end_x, end_z) = points[-2:]
            far = math.dist((x, z), (end_x, end_z))
            way_x, way_z = (end_x - x) / far, (end_z - z) / far
            on_m = [0.0]
            for gate in gates:
                out_x, out_z = gate.outwards
                across = way_x * out_z - way_z * out_x
                if abs(across) < _ACROSS:
                    continue
                to_x, to_z = gate.foot[0] - end_x, gate.foot[1] - end_z
                beyond_m = (to_x * out_z - to_z * out_x) / across
                before_m = (to_x * way_z - to_z * way_x) / -across
                if 0 < beyond_m <= USUAL_LANE_M / 2 and 0 < before_m <= USUAL_LANE_M + _TURN_M:
                    on_m.append(beyond_m)
            if max(on_m):
                points[-1] = round(end_x + max(on_m) * way_x, 4), round(end_z + max(on_m) * way_z, 4)
            points.reverse()
        found.append(replace(lane, points=tuple(points)))
    return tuple(found)


def with_ramps_inside(survey: Survey, ramps: LevelRamps) -> Survey:
    """Return the survey of a level with its outlines widened around the ramps that leave them."""
    assert survey.outline is not None
    grounds = [ramp.ground for ramp in (*ramps.up, *ramps.down)]
    outline, *others = (_widened(ring, grounds) for ring in (survey.outline, *survey.other_outlines))
    return replace(survey, outline=outline, other_outlines=tuple(others))


def _widened(ring: tuple[Point, ...], grounds: Sequence[shapely.Polygon]) -> tuple[Point, ...]:
    outline = shapely.Polygon(ring)
    leaving = [ground for ground in grounds if outline.intersects(ground) and not outline.covers(ground)]
    if not leaving:
        return ring
    around = [ground.buffer(_AROUND_M, join_style="mitre") for ground in leaving]
    whole = shapely.Polygon(shapely.union_all([outline, *around]).exterior).simplify(_TOUCH_M)
    return tuple((round(float(x), 3), round(float(z), 3)) for x, z in shapely.get_coordinates(whole)[:-1])
