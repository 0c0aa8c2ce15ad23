"""Surveys as IFC: building models whose spaces or elements are named as stalls, storey by storey."""

from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
import shapely

from garage2usd.garage import Point, StallUse
from garage2usd.survey.drawing_words import PartKind, number_told, portal_told, size_told, use_told
from garage2usd.survey.ifc_model import Model, ModelPart, read_model
from garage2usd.survey.parts import SurveyParts
from garage2usd.survey.stall_cells import stall_corners
from garage2usd.survey.survey import Survey, Unplaced
from garage2usd.survey.surveyed_building import SurveyedBuilding, SurveyedLevel, SurveyedRamp
from garage2usd.survey.walls import add_column, add_doors, ground_within, ring_of, sides_m, solids_within

_STANDS_M = (0.2, 1.6)
"""Heights above a floor between which what stands on it is in the way of cars."""
_BELOW_M = 1.0
_LEAST_DOOR_M, _AT_WALL_M = 2.1, 1.0
_LEAST_STOREY_M = 1.8
_MOST_IN_A_ROW = 200
_MARKS = ("Mark", "Number", "ParkingNumber", "SpaceNumber", "Stellplatznummer", "Nummer", "Kennzeichen")
"""Properties with the number of a stall."""


def read_ifc_survey(path: Path) -> Survey | SurveyedBuilding:
    """Read a survey from a building model.

    Parameters
    ----------
    path
        IFC 2x3, 4 or 4.3 as text. Stalls are spaces of the type PARKING, and spaces, proxies and furniture that are
        named as stalls in one of many languages and have their size; spaces with several ``ParkingUnits`` are rows.
        Columns, walls, stairs, lifts and wide doors are those that stand on the floor of the stalls. The outline is the
        inner face of the walls, or else the edge of the slab. Floors with stalls are levels, and ramps join these.

    Raises
    ------
    ConfigError
        If the file is not IFC.
    MissingExtraError
        Without the extra ``cad``.
    """
    model = read_model(path)
    groups = _by_floor(model)
    if not groups:
        return SurveyParts().survey(origin_deg=model.origin_deg)
    names = _names(model, list(groups))
    levels = [
        SurveyedLevel(name, _survey(model, stalls, floor_m), floor_m, floor_m)
        for name, (floor_m, stalls) in zip(names, groups.items(), strict=True)
    ]
    if len(levels) == 1:
        return levels[0].survey
    return SurveyedBuilding(tuple(levels), tuple(_ramps(model, levels)))


def _by_floor(model: Model) -> dict[float, list[ModelPart]]:
    """Return the stalls of each floor by its height, the stalls of storeys first."""
    of_storeys: defaultdict[int, list[ModelPart]] = defaultdict(list)
    for part in model.parts:
        if part.kind is PartKind.STALL and not part.ground.is_empty:
            of_storeys[part.storey].append(part)
    groups: dict[float, list[ModelPart]] = {}
    for _, stalls in sorted(of_storeys.items(), reverse=True):
        for stall in stalls:
            near = next((floor_m for floor_m in groups if abs(floor_m - stall.base_m) < _LEAST_STOREY_M), None)
            groups.setdefault(round(stall.base_m, 3) if near is None else near, []).append(stall)
    return dict(sorted(groups.items()))


def _names(model: Model, floors_m: Sequence[float]) -> list[str]:
    """Return the name of the storey nearest to each floor, or its height if this name is taken."""
    names: list[str] = []
    for floor_m in floors_m:
        near = [name for name, height_m in model.storeys if abs(height_m - floor_m) < _LEAST_STOREY_M]
        best = min(
            ((abs(height_m - floor_m), name) for name, height_m in model.storeys if name in near), default=(0.0, "")
        )[1]
        names.append(best if best and best not in names else f"{floor_m:g} m")
    return names


def _survey(model: Model, stalls: Sequence[ModelPart], floor_m: float) -> Survey:
    parts = SurveyParts()
    _add_stalls(parts, stalls)
    grounds = parts.stall_polygons()
    low_m, high_m = (floor_m + height_m for height_m in _STANDS_M)
    standing = [
        part for part in model.parts if part.base_m < high_m and part.top_m > low_m and not part.ground.is_empty
    ]
    walls = [part.ground for part in standing if part.kind is PartKind.WALL]
    doors = [part for part in standing if part.kind is PartKind.DOOR and sides_m(part.ground)[1] >= _LEAST_DOOR_M]
    ground = ground_within([*walls, *(door.ground for door in doors)], grounds)
    if ground is None:
        _add_slabs(parts, model, floor_m)
    else:
        parts.add_outline("walls", ground.exterior.coords)
        for number, solid in enumerate(solids_within(walls, ground, grounds)):
            parts.add_solid(f"wall {number + 1}", ring_of(solid))
        ours = [door for door in doors if door.ground.distance(ground.exterior) < _AT_WALL_M]
        add_doors(parts, [(door.ground.centroid.coords[0], portal_told(*door.told)) for door in ours])
    rooms = shapely.union_all(
        [shapely.Polygon(corners) for corners in parts.solids]
    )  # within which nothing else counts
    for part in standing:
        for area in (area for area in _areas(part.ground) if not rooms.covers(area)):
            if part.kind is PartKind.COLUMN:
                add_column(parts, part.name, area)
            elif part.kind is PartKind.SOLID:
                parts.add_solid(part.name, ring_of(area))
    parts.ceiling_heights_m += _ceilings_m(model, grounds, floor_m)
    return parts.survey(origin_deg=model.origin_deg)


def _ceilings_m(model: Model, stalls: Sequence[shapely.Polygon], floor_m: float) -> Iterator[float]:
    """Yield the heights over the floor of the slabs above the stalls."""
    middles = shapely.multipoints(shapely.get_coordinates(shapely.centroid(stalls)))
    for part in model.parts:
        is_above = part.kind is PartKind.OUTLINE and part.base_m - floor_m > _LEAST_STOREY_M
        if is_above and part.ground.intersects(middles):
            yield round(part.base_m - floor_m, 3)


def _add_slabs(parts: SurveyParts, model: Model, floor_m: float) -> None:
    for part in model.parts:
        if part.kind is PartKind.OUTLINE and abs(part.top_m - floor_m) < _BELOW_M:
            for area in _areas(part.ground):
                parts.add_outline(part.name, area.exterior.coords)


def _add_stalls(parts: SurveyParts, stalls: Sequence[ModelPart]) -> None:
    written = [
        number_told(*(str(stall.properties.get(key) or "") for key in _MARKS), *stall.told[:2]) for stall in stalls
    ]
    common = Counter(written)
    for stall, number in zip(stalls, written, strict=True):
        number = number if common[number] <= 2 else ""  # noqa: PLR2004, PLW2901 - the number of a type is that of none
        said = (*stall.told, str(stall.properties.get("ParkingUse") or ""))
        use, size = use_told(*said), size_told(*said)
        if stall.properties.get("HandicapAccessible") is True:
            use = StallUse.ACCESSIBLE
        ring = shapely.oriented_envelope(stall.ground) if stall.ground.geom_type != "Polygon" else stall.ground
        units = stall.properties.get("ParkingUnits")
        if isinstance(units, int | float) and 1 < units <= _MOST_IN_A_ROW:
            parts.add_row(number or stall.name, ring.exterior.coords, int(units), use=use, size=size)
            continue
        corners = stall_corners(ring.exterior.coords)
        if corners is None:
            corners = stall_corners(shapely.oriented_envelope(ring).exterior.coords)
        if corners is None:
            short_m, long_m = sides_m(ring)
            reason = f"{short_m:.1f} by {long_m:.1f} m, which is no stall; its ground stays free"
            parts.unread.append(Unplaced(stall.name, reason))
        else:
            parts.add_stall(number or stall.name, corners, use=use, size=size, number=number)


def _ramps(model: Model, levels: Sequence[SurveyedLevel]) -> Iterable[SurveyedRamp]:
    """Yield the ramps from floor to floor, along the axis of the rectangle around each."""
    heights_m = np.array([level.height_m for level in levels])
    for part in model.parts:
        if part.kind is not PartKind.RAMP or part.ground.is_empty:
            continue
        corners = np.array(shapely.oriented_envelope(part.ground).exterior.coords)[:4]
        if np.hypot(*(corners[1] - corners[0])) > np.hypot(*(corners[2] - corners[1])):
            corners = np.roll(corners, -1, axis=0)  # the short side first
        ends = (corners[0] + corners[1]) / 2, (corners[2] + corners[3]) / 2
        far_m = [np.hypot(*(part.points[:, :2] - end).T) for end in ends]
        reach_m = float(np.hypot(*(corners[1] - corners[0])))
        tops_m = [part.points[away_m <= max(reach_m, away_m.min()), 2].max() for away_m in far_m]
        joined = [int(np.argmin(np.abs(heights_m - top_m))) for top_m in tops_m]
        if joined[0] != joined[1]:
            line: list[Point] = [(round(float(x), 6), round(float(z), 6)) for x, z in ends]
            one, other = (levels[number].name for number in joined)
            yield SurveyedRamp(part.name, tuple(line), (one, other), round(reach_m, 3))


def _areas(ground: shapely.Geometry) -> list[shapely.Polygon]:
    return [part for part in shapely.get_parts(ground) if part.geom_type == "Polygon"]
