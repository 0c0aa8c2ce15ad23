"""DXF drawing of a garage: its ground plan in metres, as `garage2usd import` and CAD programs read it."""

import math
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import shapely

from garage2usd.as_built import BuiltGarage
from garage2usd.common.package import of_extra
from garage2usd.garage import StallUse
from garage2usd.maps.ground_plan import GroundPlan, LevelPlan, ground_plan

with of_extra("a drawing in DXF"):
    import ezdxf
    from ezdxf.enums import TextEntityAlignment
    from ezdxf.layouts import Modelspace

_COLOURS = {
    "OUTLINE": 7,
    "BLOCKS": 8,
    "COLUMNS": 8,
    "DOORS": 1,
    "LANES": 3,
    "LANES_ONE_WAY": 4,
    "RAMPS": 6,
    "STALLS": 5,
    "NUMBERS": 2,
    "USES": 30,
}
"""Layers and their colours of AutoCAD's index."""
_TEXT_M = 0.6
_DIGITS = 6
_UPRIGHT_RAD = math.pi / 2 + 1e-3


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
    which begin at the left end of the mouth, with the number on ``NUMBERS`` and a use other than the standard one on
    ``USES`` inside. Lanes are polylines on ``LANES`` and, in the direction of driving, ``LANES_ONE_WAY``, with their
    width as the global width. ``OUTLINE``, ``COLUMNS`` and ``BLOCKS`` have closed polylines, ``DOORS`` a line and a
    word for each door. The layers of a garage of several levels end in the level's name, ``STALLS_U1``; levels lie over
    each other at their heights, joined by lines in space on ``RAMPS``.
    """
    plan = plan or ground_plan(garage)
    with _fixed_metadata():
        drawing = ezdxf.new("R2010", units=ezdxf.units.M)
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
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


def _add_level(space: Modelspace, level: LevelPlan) -> None:
    floor_m = level.place.floor_m

    def on(layer: str) -> dict[str, object]:
        return {"layer": level.place.after(layer, joint="_"), "elevation": floor_m}

    def write(text: str, layer: str, at: tuple[float, float], turn_deg: float, height_m: float = _TEXT_M) -> None:
        attributes = {"layer": level.place.after(layer, joint="_"), "rotation": turn_deg}
        entity = space.add_text(text, height=height_m, dxfattribs=attributes)
        entity.set_placement((*np.round(at, _DIGITS).tolist(), floor_m), align=TextEntityAlignment.MIDDLE_CENTER)

    for lane in level.lanes:
        layer = "LANES_ONE_WAY" if lane.one_way else "LANES"
        attributes = {**on(layer), "const_width": round(lane.width_m, _DIGITS)}
        space.add_lwpolyline(lane.points.round(_DIGITS).tolist(), dxfattribs=attributes)
    outline = [] if level.outline is None else [level.outline]
    for layer, grounds in (("OUTLINE", outline), ("BLOCKS", level.blocks), ("COLUMNS", level.columns)):
        for ground in grounds:
            ring = shapely.get_coordinates(ground.exterior)[:-1].round(_DIGITS).tolist()
            space.add_lwpolyline(ring, close=True, dxfattribs=on(layer))
    for door in level.doors:
        start, end = ((*jamb, floor_m) for jamb in door.jambs.round(_DIGITS).tolist())
        space.add_line(start, end, dxfattribs={"layer": level.place.after("DOORS", joint="_")})
        write(door.kind, "DOORS", door.position, 0.0)
    for stall, corners in zip(level.stalls, level.corners, strict=True):
        space.add_lwpolyline(corners.round(_DIGITS).tolist(), close=True, dxfattribs=on("STALLS"))
        along = corners[1] - corners[0]
        turn_rad = math.atan2(along[1], along[0])
        if not -_UPRIGHT_RAD < turn_rad < _UPRIGHT_RAD:
            turn_rad -= math.copysign(math.pi, turn_rad)
        middle, inwards = corners.mean(axis=0), (corners[2] + corners[3] - corners[0] - corners[1]) / 2
        depth_m = float(np.linalg.norm(inwards)) or 1.0
        turn_deg = round(math.degrees(turn_rad), 4)
        if stall.number is not None:
            write(str(stall.number), "NUMBERS", tuple(middle), turn_deg)
        if stall.use is not StallUse.STANDARD:
            beside = middle + inwards / depth_m * min(2 * _TEXT_M, depth_m / 4)
            write(str(stall.use), "USES", tuple(beside), turn_deg, _TEXT_M / 2)
