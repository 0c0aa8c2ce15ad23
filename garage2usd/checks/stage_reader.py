"""A stage as a subject: read with pxr alone, whoever edited it."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pxr import Usd

from garage2usd.checks.contents import PlacedLight, read_contents
from garage2usd.checks.subject import Subject
from garage2usd.errors import ConfigError, StageError
from garage2usd.layout import Placement
from garage2usd.layout.lighting import direct_lux, lane_points_of
from garage2usd.objects.tube_light import TubeLightSpec
from garage2usd.reading.files import open_stage
from garage2usd.reading.ground import Point
from garage2usd.reading.lanes import Lanes, moved_stalls, read_lanes
from garage2usd.reading.objects import PlacedObject
from garage2usd.structure.grid import Structure, cells_from_text

__all__ = ["profile_name", "stage_subject", "subject_of_stage"]

_LANE_MARGIN_M = 0.7
"""What the sides of a square have over the carriageway between its columns, where no structure tells."""


def stage_subject(path: Path) -> Subject:
    """Read a stage.

    Raises
    ------
    StageError
        If it cannot be opened.
    """
    stage = open_stage(path)
    try:
        return subject_of_stage(stage, source=str(path))
    except RecursionError:
        raise StageError(str(path), "its prims are nested too deeply to be read") from None


def subject_of_stage(
    stage: Usd.Stage, *, source: str, objects: Iterable[PlacedObject] | None = None, is_judged: bool = True
) -> Subject:
    """Read a stage that is open, as it is composed now.

    Parameters
    ----------
    stage
        The stage.
    source
        Its file.
    objects
        As for `garage2usd.checks.contents.read_contents`.
    is_judged
        Whether what only rules look at is read too: how bright it is, and which stalls were moved without outlines.
    """
    ground, contents = read_lanes(stage), read_contents(stage, objects)
    structure = _structure(stage)
    lane_lux, stall_lux = _illuminances(ground, contents.lights, structure) if is_judged else (None, None)
    return Subject(
        source=source,
        kind="stage",
        stalls=tuple(ground.stalls),
        nodes=tuple(ground.nodes),
        edges=tuple(ground.edges),
        things=contents.things,
        structure=structure,
        compartments=_compartments(stage, structure),
        lane_lux=lane_lux,
        stall_lux=stall_lux,
        faults=(*ground.faults, *(moved_stalls(stage, ground) if is_judged else ())),
        stage=stage,
    )


def profile_name(stage: Usd.Stage) -> str | None:
    """Name of the profile that a stage says it was designed to."""
    prim = stage.GetDefaultPrim()
    name = prim.GetCustomDataByKey("profile") if prim else None
    return name if isinstance(name, str) else None


def _structure(stage: Usd.Stage) -> Structure | None:
    """S, R and C of the default prim's customData, if they fit together."""
    prim = stage.GetDefaultPrim()
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
    """The number of each square's fire compartment, if the default prim's customData has one for each square of S."""
    prim = stage.GetDefaultPrim()
    declared = prim.GetCustomDataByKey("fireCompartments") if prim else None
    if structure is None or declared is None:
        return None
    try:
        numbers = np.asarray(declared, dtype=np.int32)
    except (TypeError, ValueError, OverflowError):
        return None
    return numbers.reshape(structure.shape) if numbers.size == structure.cells.size else None


def _illuminances(
    ground: Lanes, lights: Iterable[PlacedLight], structure: Structure | None
) -> tuple[float | None, float | None]:
    """Mean direct light on lanes and stalls, by the method of the layout."""
    tubes = [
        Placement(
            "Light",
            TubeLightSpec(light.width_m, light.height_m, drop_m=0.0, luminance_nit=light.luminance_nit),
            (float(light.matrix[3, 0]), float(light.matrix[3, 1]), float(light.matrix[3, 2])),
            float(np.arctan2(-light.matrix[0, 2], light.matrix[0, 0])),
        )
        for light in lights
        if light.luminance_nit > 0
    ]
    lanes = [
        (node.position, _sides_m(square, node.widths_m, structure))
        for node, square in zip(ground.nodes, ground.squares, strict=True)
        if not node.is_portal
    ]
    return (
        _mean_lux(lane_points_of((*middle, *sides) for middle, sides in lanes), tubes),
        _mean_lux(np.array([stall.centre for stall in ground.stalls]).reshape(-1, 2), tubes),
    )


def _mean_lux(points: NDArray[np.float64], tubes: list[Placement]) -> float | None:
    if not len(points):
        return None
    total = np.zeros(len(points))
    for luminance in {tube.spec.luminance_nit for tube in tubes if isinstance(tube.spec, TubeLightSpec)}:
        alike = [tube for tube in tubes if getattr(tube.spec, "luminance_nit", None) == luminance]
        total += luminance * direct_lux(points, alike)
    return float(total.mean())


def _sides_m(square: Point, widths_m: tuple[float, float], structure: Structure | None) -> tuple[float, float]:
    """Extent of a lane square along X and Z."""
    row, col = int(square[0]), int(square[1])
    if structure is not None and 0 <= row < structure.shape[0] and 0 <= col < structure.shape[1]:
        return float(structure.column_widths_mm[col]) / 1000, float(structure.row_depths_mm[row]) / 1000
    return widths_m[0] + _LANE_MARGIN_M, widths_m[1] + _LANE_MARGIN_M
