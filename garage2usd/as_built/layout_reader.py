"""Reader of layouts as levels of a garage, and of plans without a layout."""

from functools import lru_cache

import numpy as np

from garage2usd.as_built.contents import Model
from garage2usd.as_built.level import BuiltLevel
from garage2usd.as_built.shapes import Body, MeshShape, Thing, turned_about_y
from garage2usd.assets import Part
from garage2usd.garage import Fault, LaneGraph, Stall
from garage2usd.garage.levels import ONLY_LEVEL, LevelPlace
from garage2usd.layout import Layout
from garage2usd.objects import KINDS, Spec
from garage2usd.stage.arrangement import arrange
from garage2usd.stage.prototypes import asset_of
from garage2usd.structure.grid import Structure

_IDENTITY = np.eye(4)


def level_of_layout(
    layout: Layout, *, source: str, kind: str, place: LevelPlace = ONLY_LEVEL, faults: tuple[Fault, ...] = ()
) -> BuiltLevel:
    """Convert a layout to a level as built, without the objects that are flat on the floor."""
    lux = layout.illuminance
    return BuiltLevel(
        source=source,
        kind=kind,
        stalls=layout.quads,
        lanes=layout.lane_graph,
        things=_things(layout),
        structure=layout.matrices,
        compartments=None if layout.matrices is None else layout.compartments,
        lane_lux=lux.lanes.mean if lux.lanes else None,
        stall_lux=lux.stalls.mean if lux.stalls else None,
        lamps=lux.lamps,
        dead_lamps=lux.dead_lamps,
        faults=faults,
        is_surveyed=layout.matrices is None,
        landings={f"[{row}, {col}]": way for (row, col), way in layout.source.landings.items()},
        place=place,
    )


def level_without_layout(
    structure: Structure,
    lanes: LaneGraph,
    stalls: tuple[Stall, ...],
    *,
    source: str,
    kind: str,
    faults: tuple[Fault, ...],
) -> BuiltLevel:
    """Convert a plan that cannot be laid out: stalls and lanes, without objects and lights."""
    return BuiltLevel(
        source=source,
        kind=kind,
        stalls=stalls,
        lanes=lanes,
        structure=structure,
        faults=faults,
    )


def _things(layout: Layout) -> tuple[Thing, ...]:
    paths = arrange(layout, nested=False).paths()
    objects = layout.placements
    rows = objects.rows_of(*(kind.name for kind in KINDS if kind.is_solid))
    things = []
    matrices = turned_about_y(objects.yaw_rad[rows], objects.position_m[rows])
    for row, number, matrix in zip(rows.tolist(), objects.spec[rows].tolist(), matrices, strict=True):
        spec = objects.specs[number]
        things.append(Thing(paths[row], spec.kind.label, model_of(spec.shape).placed(matrix)))
    return tuple(things)


@lru_cache(maxsize=1024)
def model_of(spec: Spec) -> Model:
    """Return the meshes of a spec, each where its layer has it in single precision, so that both are driven alike."""
    return Model(tuple(map(_body, asset_of(spec).parts)))


def _body(part: Part) -> Body:
    shape = MeshShape(
        part.own_points.astype(np.float64), part.face_counts.astype(np.int64), part.face_indices.astype(np.int64)
    )
    matrix = _IDENTITY
    if part.pose is not None:
        place = part.pose.single
        matrix = turned_about_y(np.radians(place.yaw_deg), place[:3])
    return Body(shape, matrix, part.collider is not None)
