"""Plans of all levels of a garage, and the section through them."""

from collections.abc import Mapping, Sequence

from garage2usd.driving.tracks import Tracks
from garage2usd.garage import Stall
from garage2usd.garage_model import Garage
from garage2usd.view.drawing import Drawing
from garage2usd.view.plan_picture import draw_plan, ways_on_level
from garage2usd.view.plan_sheet import Mark
from garage2usd.view.plan_tracks import track_lines
from garage2usd.view.section import draw_section


def draw_levels(
    garage: Garage,
    *,
    stall: Stall | None = None,
    marks: Mapping[str, Sequence[Mark]] | None = None,
    tracks: Tracks | None = None,
) -> dict[str, Drawing]:
    """Draw the plan of each level of a garage and, if ramps lead between them, the section along the ramps.

    Parameters
    ----------
    garage
        The garage.
    stall
        Stall of ``garage.stalls`` whose routes are drawn on each level that they lead over.
    marks
        Findings by the name of their level.
    tracks
        Tracks of traffic, drawn as lines.

    Returns
    -------
    dict
        The drawings by the name of the level, which is empty in a garage of one level, then ``section``.
    """
    drawings = {}
    for index, level in enumerate(garage.levels):
        drawings[level.place.name] = draw_plan(
            level.layout,
            stall=stall if stall is not None and stall.level == index else None,
            ways=None if stall is None else ways_on_level(garage.lanes, stall, index),
            marks=(marks or {}).get(level.name, ()),
            driven=() if tracks is None else track_lines(tracks, index),
        )
    if garage.building.links:
        drawings["section"] = draw_section(garage.levels, storey_m=garage.building.storey_m)
    return drawings
