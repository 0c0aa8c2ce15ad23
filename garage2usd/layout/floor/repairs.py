"""Repairs of patched asphalt: cracks sealed with bitumen, and patches, at places that the seed draws."""

from collections.abc import Iterable, Iterator

import numpy as np
import shapely

from garage2usd.common.randomness import Step
from garage2usd.layout.draws import SquareDraws
from garage2usd.layout.floor.stains import drain_box_on, drawn_yaw, overlap, overlaps_paint, stain_box
from garage2usd.layout.placement import Placement, of_spec, placed, sum_of_yaws
from garage2usd.objects.drain import DrainSpec
from garage2usd.objects.floor_stain import StainMark, StainSpec
from garage2usd.objects.panel import PanelSpec
from garage2usd.structure.lane_graph import Square

_LIFT_M = 0.0004
"""Height over the floor, below all stains."""
_SLOTS = ((StainMark.REPAIR, 0.3), (StainMark.SEAM, 0.85), (StainMark.SEAM, 0.7), (StainMark.SEAM, 0.5))
"""Possible repairs of a square: mark, and share of the squares."""
_TRIES, _DRAWS = 3, 4
"""Places tried for each repair, and random numbers of each place."""
_SIZES_M = {
    StainMark.SEAM: ((1.0, 4.0), (1.1, 3.2), (0.8, 2.4)),
    StainMark.REPAIR: ((1.4, 1.4), (1.1, 2.2), (2.4, 1.6), (0.8, 3.2)),
}
_VARIANTS = 4
_QUARTER_TURN = np.pi / 2


def floor_repairs(
    floors: Iterable[Placement], draws: SquareDraws, drains: Iterable[Placement] = ()
) -> Iterator[Placement]:
    """Place sealed cracks and patches on the floor of each square, none over another, over a drain or an opening.

    Parameters
    ----------
    floors
        Floor panels of the squares, at most one on each. Patches avoid their markings, which cars wear off old cracks.
    draws
        Random numbers of each square.
    drains
        All drains.
    """
    numbers = draws.of_part(Step.FLOOR_STAINS, "repairs", len(_SLOTS), _TRIES, _DRAWS)
    drained = _drains_by_square(drains)
    for floor, panel in of_spec(floors, PanelSpec):
        if floor.square is None:
            continue
        # in the coordinates of the panel, as all that follows
        taken = [drain_box_on(floor, drain, spec) for drain, spec in drained.get(floor.square, [])]
        openings = shapely.union_all([shapely.Polygon(opening) for opening in panel.openings])
        half_x, half_z = panel.width_m / 2, panel.depth_m / 2
        for number, ((mark, share), tries) in enumerate(zip(_SLOTS, numbers[floor.square].tolist(), strict=True), 1):
            if tries[0][0] >= share:
                continue
            for there, turn, across, along in tries:
                sizes = _SIZES_M[mark]
                spec = StainSpec(mark, int(there * 1e3) % _VARIANTS, *sizes[int(there * 1e5) % len(sizes)])
                yaw = drawn_yaw(turn) if mark is StainMark.SEAM else int(2 * turn) * _QUARTER_TURN
                left, top, right, bottom = stain_box(spec, (0.0, 0.0), yaw)
                room_x, room_z = 2 * half_x - (right - left), 2 * half_z - (bottom - top)
                if min(room_x, room_z) < 0:
                    continue
                place = across * room_x - half_x - left, along * room_z - half_z - top
                box = stain_box(spec, place, yaw)
                if any(overlap(box, other) for other in taken) or openings.intersects(shapely.box(*box)):
                    continue
                if mark is StainMark.REPAIR and overlaps_paint(panel, box):
                    continue
                taken.append(box)
                name = f"{mark.value.capitalize()}_{number}"
                yaw = sum_of_yaws(yaw, floor.yaw_rad)
                yield placed(name, spec, floor.to_world(place), height_m=_LIFT_M, yaw_rad=yaw, square=floor.square)
                break


def _drains_by_square(drains: Iterable[Placement]) -> dict[Square | None, list[tuple[Placement, DrainSpec]]]:
    """Group the drains by square."""
    found: dict[Square | None, list[tuple[Placement, DrainSpec]]] = {}
    for drain, spec in of_spec(drains, DrainSpec):
        found.setdefault(drain.square, []).append((drain, spec))
    return found
