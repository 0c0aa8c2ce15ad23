"""DXF drawing of a garage: its ground plan in metres, as `garage2usd import` and CAD programs read it."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from garage2usd.as_built import BuiltGarage
from garage2usd.common.package import of_extra
from garage2usd.garage import StallUse
from garage2usd.maps.ground_plan import GroundPlan, LevelPlan, ground_plan

with of_extra("a drawing in DXF"):
    from ezdxf._options import options
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.filemanagement import new
    from ezdxf.layouts.layout import Modelspace
    from ezdxf.units import M

Floats = NDArray[np.float64]

_COLOURS = {
    "OUTLINE": 7,
    "BLOCKS": 8,
    "COLUMNS": 8,
    "DOORS": 1,
    "LANES": 3,
    "LANES_ONE_WAY": 4,
    "RAMPS": 6,
    "STALLS": 5,
    "MOUTHS": 9,
    "NUMBERS": 2,
    "USES": 30,
}
"""Layers and their colours of AutoCAD's index."""
_TEXT_M = 0.6
_DIGITS = 6


def write_dxf(garage: BuiltGarage, path: Path, *, plan: GroundPlan | None = None) -> None:
    """Write the ground plan of a garage as a DXF drawing of AutoCAD 2010.

    Parameters
    ----------
    garage
        The garage.
    path
        The file, in an existing folder.
    plan
        Its ground plan, if already known.

    Notes
    -----
    A unit is a metre, x leads east and y north as in all maps. Stalls are closed polylines on the layer ``STALLS``,
    with the number on ``NUMBERS``, and a use and a size other than the standard one on ``USES`` inside; their mouths
    are lines on ``MOUTHS``. Lanes are polylines on ``LANES`` and, in the direction of driving, ``LANES_ONE_WAY``, with
    their width as the global width. ``OUTLINE``, ``COLUMNS`` and ``BLOCKS`` have closed polylines, ``DOORS`` a line and
    a word for each door. The layers of a garage of several levels end in the level's name, ``STALLS_U1``; levels lie
    over each other at their heights, joined by lines in space on ``RAMPS``.
    """
    plan = plan or ground_plan(garage)
    with _fixed_metadata():
        drawing = new("R2010", units=M)
        space = drawing.modelspace()
        for level in plan.levels:
            for layer, colour in _COLOURS.items():
                if layer != "RAMPS":
                    drawing.layers.add(level.place.after(layer, joint="_"), color=colour)
            _add_level(space, level)
        if plan.ramps:
            drawing.layers.add("RAMPS", color=_COLOURS["RAMPS"])
        for ramp in plan.ramps:
            points = zip(*ramp.lane.points.round(_DIGITS).T.tolist(), ramp.heights_m, strict=True)
            space.add_polyline3d(points, dxfattribs={"layer": "RAMPS"})
        drawing.saveas(path)


@contextmanager
def _fixed_metadata() -> Iterator[None]:
    """Give drawings the same dates and identities every time."""
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def _add_level(space: Modelspace, level: LevelPlan) -> None:
    for lane in level.lanes:
        layer = "LANES_ONE_WAY" if lane.one_way else "LANES"
        width = {"const_width": round(lane.width_m, _DIGITS)}
        space.add_lwpolyline(lane.points.round(_DIGITS).tolist(), dxfattribs={**_on(level, layer), **width})
    outline = [] if level.outline is None else [level.outline]
    for layer, grounds in (("OUTLINE", outline), ("BLOCKS", level.blocks), ("COLUMNS", level.columns)):
        for ground in grounds:
            _add_ring(space, level, layer, shapely.get_coordinates(ground.exterior)[:-1])
    for door in level.doors:
        start, end = ((*jamb, level.place.floor_m) for jamb in door.jambs.round(_DIGITS).tolist())
        space.add_line(start, end, dxfattribs={"layer": level.place.after("DOORS", joint="_")})
        _add_text(space, level, "DOORS", door.kind, np.array(door.position), 0.0, _TEXT_M)
    for stall, corners in zip(level.stalls, level.corners, strict=True):
        _add_ring(space, level, "STALLS", corners)
        space.add_lwpolyline(corners[:2].round(_DIGITS).tolist(), dxfattribs=_on(level, "MOUTHS"))
        middle, inwards = corners.mean(axis=0), (corners[2] + corners[3] - corners[0] - corners[1]) / 2
        turn_deg = _readable_deg(corners[1] - corners[0])
        if stall.number:
            _add_text(space, level, "NUMBERS", str(stall.number), middle, turn_deg, _TEXT_M)
        if stall.use is not StallUse.STANDARD:
            _add_text(space, level, "USES", str(stall.use), middle + inwards / 4, turn_deg, _TEXT_M / 2)
        if stall.size != "standard":
            _add_text(space, level, "USES", stall.size, middle - inwards / 4, turn_deg, _TEXT_M / 2)


def _on(level: LevelPlan, layer: str) -> dict[str, str | float]:
    return {"layer": level.place.after(layer, joint="_"), "elevation": level.place.floor_m}


def _add_ring(space: Modelspace, level: LevelPlan, layer: str, corners: Floats) -> None:
    space.add_lwpolyline(corners.round(_DIGITS).tolist(), close=True, dxfattribs=_on(level, layer))


def _add_text(
    space: Modelspace, level: LevelPlan, layer: str, text: str, at: Floats, turn_deg: float, height_m: float
) -> None:
    attributes = {"layer": level.place.after(layer, joint="_"), "rotation": turn_deg}
    place = *(at.round(_DIGITS) + 0.0).tolist(), level.place.floor_m
    entity = space.add_text(text, height=height_m, dxfattribs=attributes)
    entity.set_placement(place, align=TextEntityAlignment.MIDDLE_CENTER)


def _readable_deg(along: Floats) -> float:
    """Return the direction of a text along a line or against it, which is not upside down."""
    turn_deg = round(math.degrees(math.atan2(along[1], along[0])), 4)
    return turn_deg if -90.0 <= turn_deg <= 90.0 else turn_deg - math.copysign(180.0, turn_deg)  # noqa: PLR2004
