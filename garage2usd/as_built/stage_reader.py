"""Reader of the levels of USD stages, including stages edited by other programs; needs pxr only."""

import math
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.as_built.contents import PlacedLight, read_contents
from garage2usd.as_built.level import BuiltLevel
from garage2usd.common.errors import ConfigError
from garage2usd.garage import Point
from garage2usd.garage.levels import ONLY_LEVEL, LevelPlace
from garage2usd.layout import Placement
from garage2usd.layout.ceiling.lighting import MAINTENANCE, direct_lux, lane_points_of
from garage2usd.layout.placement import of_spec
from garage2usd.objects.lamp import LampSpec
from garage2usd.reading.lanes import Lanes, moved_stalls, read_lanes
from garage2usd.reading.lights import LightSource
from garage2usd.reading.whole_garage import garage_root
from garage2usd.scenes.prims import PlacedObject
from garage2usd.structure.grid import Structure, cells_from_text

_DISK = "DiskLight"
_PANELS = frozenset({"RectLight", _DISK})
_LAMPS = _PANELS | {"SphereLight", "CylinderLight"}
_DIGITS = 6
_LANE_MARGIN_M = 0.7
"""Difference in metres between a square's side and the carriageway between its columns, if the structure is unknown."""


def level_of_stage(
    stage: Usd.Stage,
    *,
    source: str,
    place: LevelPlace = ONLY_LEVEL,
    objects: Iterable[PlacedObject] | None = None,
    is_judged: bool = True,
) -> BuiltLevel:
    """Read a garage of one level from an open stage in its current composition.

    Parameters
    ----------
    stage
        The stage.
    source
        File of the stage.
    place
        The level's place in the whole garage.
    objects
        As for `garage2usd.as_built.contents.read_contents`.
    is_judged
        True to read also the data that only rules need: illuminance, and stalls moved without their outlines.
    """
    ground, contents = read_lanes(stage), read_contents(stage, objects)
    structure = _structure(stage)
    lamps = [light.source for light in contents.lights if light.source.kind in _LAMPS]
    is_surveyed = _is_imported(stage)
    margin_m = 0.0 if is_surveyed else _LANE_MARGIN_M
    lane_lux, stall_lux = _illuminances(ground, contents.lights, structure, margin_m) if is_judged else (None, None)
    return BuiltLevel(
        source=source,
        kind="stage",
        lanes=ground.graph,
        stalls=tuple(ground.stalls),
        things=contents.things,
        structure=structure,
        compartments=_compartments(stage, structure),
        lane_lux=lane_lux,
        stall_lux=stall_lux,
        lamps=len(lamps),
        dead_lamps=sum(lamp.candela == 0 for lamp in lamps),
        faults=(*ground.faults, *(moved_stalls(stage, ground) if is_judged else ())),
        stage=stage,
        place=place,
        is_surveyed=is_surveyed,
        keeps_left=_keeps_left(stage),
    )


def _keeps_left(stage: Usd.Stage) -> bool:
    """Return True if a stage says that its traffic keeps to the left."""
    prim = garage_root(stage)
    return bool(prim) and prim.GetCustomDataByKey("drivesOn") == "left"


def profile_name(stage: Usd.Stage) -> str | None:
    """Return the name of the design profile in a stage."""
    prim = garage_root(stage)
    name = prim.GetCustomDataByKey("profile") if prim else None
    return name if isinstance(name, str) else None


def _is_imported(stage: Usd.Stage) -> bool:
    """Return True for the stage of an imported layout, which has no squares."""
    prim = garage_root(stage)
    data: Mapping[str, object] = prim.GetCustomData() if prim else {}
    return data.get("generator") == "garage2usd" and "structureDigest" not in data


def _structure(stage: Usd.Stage) -> Structure | None:
    """Read S, R and C from the default prim's customData, if they are consistent."""
    prim = garage_root(stage)
    data: Mapping[str, object] = prim.GetCustomData() if prim else {}
    drawing, widths, depths = (data.get(name) for name in ("S", "R", "C"))
    if not isinstance(drawing, str) or widths is None or depths is None:
        return None
    try:
        cells = cells_from_text(drawing, field="S")
        return Structure.from_arrays(cells, np.asarray(widths, float), np.asarray(depths, float))
    except (ConfigError, TypeError, ValueError):
        return None


def _compartments(stage: Usd.Stage, structure: Structure | None) -> NDArray[np.int32] | None:
    """Read the fire compartment of each square from the default prim's customData, if it has one per square of S."""
    prim = garage_root(stage)
    declared = prim.GetCustomDataByKey("fireCompartments") if prim else None
    if structure is None or declared is None:
        return None
    try:
        numbers = np.asarray(declared, dtype=np.int32)
    except (TypeError, ValueError, OverflowError):
        return None
    return numbers.reshape(structure.shape) if numbers.size == structure.cells.size else None


def _illuminances(
    ground: Lanes, lights: Iterable[PlacedLight], structure: Structure | None, margin_m: float
) -> tuple[float | None, float | None]:
    """Compute the mean direct illuminance of lanes and stalls: panels as in the layout, other lights as points."""
    shining = [light for light in lights if light.source.candela > 0]
    panels = [light for light in shining if _is_panel(light.source)]
    lamps = [light for light in shining if not _is_panel(light.source)]
    lanes = [
        (node.position, _sides_m(square, node.widths_m, structure, margin_m))
        for node, square in zip(ground.nodes, ground.squares, strict=True)
        if not node.is_portal
    ]
    return (
        _mean_lux(lane_points_of((*middle, *sides) for middle, sides in lanes), panels, lamps),
        _mean_lux(np.array([stall.centre for stall in ground.stalls]).reshape(-1, 2), panels, lamps),
    )


def _mean_lux(points: NDArray[np.float64], panels: Iterable[PlacedLight], lamps: Iterable[PlacedLight]) -> float | None:
    if not len(points):
        return None
    total = np.zeros(len(points))
    tubes = [_tube(panel) for panel in panels]
    for luminance in dict.fromkeys(spec.luminance_nit for _, spec in of_spec(tubes, LampSpec)):
        alike = [tube for tube, spec in of_spec(tubes, LampSpec) if spec.luminance_nit == luminance]
        total += luminance * direct_lux(points, alike)
    return float((total + sum(_lamp_lux(points, lamp) for lamp in lamps)).mean())


def _is_panel(source: LightSource) -> bool:
    """Return True if a light is flat and has an area."""
    return source.kind in _PANELS and math.isfinite(source.luminance_nit)


def _tube(panel: PlacedLight) -> Placement:
    """Convert a panel light to a rectangle that shines down with the panel's intensity in that direction."""
    matrix, source = panel.matrix, panel.source
    width_m, height_m = source.width_m, source.height_m
    if source.kind == _DISK:
        width_m, height_m = (math.sqrt(math.pi) / 2 * size for size in (width_m, height_m))
    down = float(np.clip(matrix[2, 1] / (np.linalg.norm(matrix[2, :3]) or 1.0), 0.0, 1.0))
    luminance = round(down, _DIGITS) * source.luminance_nit * panel.nits_per_unit
    return Placement(
        "Light",
        LampSpec(width_m, height_m, drop_m=0.0, luminance_nit=luminance),
        (float(matrix[3, 0]), float(matrix[3, 1]), float(matrix[3, 2])),
        float(np.arctan2(-matrix[0, 2], matrix[0, 0])),
    )


def _lamp_lux(points: NDArray[np.float64], lamp: PlacedLight) -> NDArray[np.float64]:
    """Compute the maintained illuminance at points (x, z) on the floor from lights at one place."""
    x, height_m, z = lamp.matrix[3, :3]
    if height_m <= 0:
        return np.zeros(len(points))
    ways = np.column_stack([points[:, 0] - x, np.full(len(points), -height_m), points[:, 1] - z])
    far_m = np.linalg.norm(ways, axis=1)
    ahead = -lamp.matrix[2, :3] / (np.linalg.norm(lamp.matrix[2, :3]) or 1.0)
    cosine = np.clip(ways @ ahead / far_m, -1.0, 1.0)
    strength = lamp.source.candela * lamp.nits_per_unit
    share = np.where(np.degrees(np.arccos(cosine)) <= lamp.source.cone_deg, 1.0, 0.0)
    if lamp.source.kind in _PANELS:
        share *= np.maximum(cosine, 0.0)
    lux: NDArray[np.float64] = MAINTENANCE * strength * share * height_m / far_m**3
    return lux


def _sides_m(
    square: Point, widths_m: tuple[float, float], structure: Structure | None, margin_m: float
) -> tuple[float, float]:
    """Return the extent of a lane square along X and Z."""
    row, col = int(square[0]), int(square[1])
    if structure is not None and 0 <= row < structure.shape[0] and 0 <= col < structure.shape[1]:
        return float(structure.column_widths_mm[col]) / 1000, float(structure.row_depths_mm[row]) / 1000
    return widths_m[0] + margin_m, widths_m[1] + margin_m
