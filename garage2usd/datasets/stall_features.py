"""Features of a stall's difficulty, measured on its proven drives and on the layout."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from garage2usd.common.errors import ConfigError
from garage2usd.driving import StallProof, prove_stalls
from garage2usd.garage_model import Garage, GarageLevel
from garage2usd.layout import Layout
from garage2usd.layout.ceiling.lighting import direct_lux

_DIGITS = 6
_WIDEST_COLUMN_M = 1.2
_SAME_ROW_M = 0.01


@dataclass(frozen=True, slots=True)
class StallFeatures:
    """Difficulty features of one stall for cars.

    Attributes
    ----------
    stall
        Name of the stall.
    gear_changes_in, gear_changes_out
        Gear changes of the design car on the proven drives in and out; None without proven drives.
    clearance_m
        Least distance of the car from all obstacles on both drives, at most 1 m; None without proven drives.
    is_clear_when_full
        True if the drives are free of collisions with a car in every other stall, in addition to the parked ones; None
        without proven drives.
    aisle_width_m
        Clear width between the columns on both sides of the lane at the stall's entry.
    occupied_neighbours
        Number of occupied stalls among the two neighbours, also across a column: 0 to 2.
    illuminance_lux
        Direct illuminance of the floor at the stall's centre, by the point-by-point method.
    """

    stall: str
    gear_changes_in: int | None
    gear_changes_out: int | None
    clearance_m: float | None
    is_clear_when_full: bool | None
    aisle_width_m: float
    occupied_neighbours: int
    illuminance_lux: float

    @property
    def is_proven(self) -> bool:
        """True if drives in and out are proven."""
        return self.clearance_m is not None


def measured_stalls(
    garage: Garage | GarageLevel, *, proofs: Sequence[StallProof] | None = None
) -> tuple[StallFeatures, ...]:
    """Measure the difficulty features of each stall for cars, in the order of the layout.

    Parameters
    ----------
    garage
        The garage of one level, or a level of one.
    proofs
        Result of `garage2usd.driving.prove_stalls` for the garage; computed if left out.

    Raises
    ------
    ConfigError
        If the proofs are not those of the garage's stalls.
    """
    layout = garage.layout
    stalls = [(row, stall) for row, stall in enumerate(layout.quads) if stall.takes_cars]
    if proofs is None:
        proofs = prove_stalls(layout, most_explained=0)
    names = [stall.name for _, stall in stalls]
    if [proof.stall for proof in proofs] != names:
        raise ConfigError("proofs", f"{len(proofs)} proofs", f"a proof for each of the {len(names)} stalls, in order")
    neighbours, lux = _occupied_neighbours(layout).tolist(), _stall_lux(layout).tolist()
    found = []
    for (row, stall), proof in zip(stalls, proofs, strict=True):
        aisle_m = round(layout.lane_graph.clear_aisle_m(stall.access, stall.outwards), _DIGITS)
        found.append(StallFeatures(proof.stall, *_driven(proof), aisle_m, neighbours[row], round(lux[row], _DIGITS)))
    return tuple(found)


def _driven(proof: StallProof) -> tuple[int | None, int | None, float | None, bool | None]:
    """Return gear changes in and out, clearance, and true if clear when full; None without proven drives."""
    if proof.way_in is None or proof.way_out is None:
        return None, None, None, None
    clearance_m = round(min(proof.way_in.clearance_m, proof.way_out.clearance_m), _DIGITS)
    return proof.way_in.gear_changes, proof.way_out.gear_changes, clearance_m, proof.is_full


def _stall_lux(layout: Layout) -> NDArray[np.float64]:
    """Compute the illuminance in each stall's middle, without the lamps over ramps; shape (stalls,)."""
    tubes = [place for place in layout.of_kind("light") if place.square is not None]
    middles = np.array([stall.centre for stall in layout.quads]).reshape(-1, 2)
    return layout.illuminance.luminance_nit * direct_lux(middles, tubes)


def _occupied_neighbours(layout: Layout) -> NDArray[np.int64]:
    """Count the occupied stalls beside each stall; shape (stalls,)."""
    is_taken = layout.cars_in_stalls() >= 0
    corners = np.array([stall.corners for stall in layout.quads]).reshape(-1, 4, 2)
    yaw_rad = np.array([stall.yaw_rad for stall in layout.quads])
    mouth = corners[:, 1] - corners[:, 0]
    width_m = np.linalg.norm(mouth, axis=1)
    x, z = corners.mean(axis=1).T
    # rows run along the entries of their stalls, also if the stalls are angled
    mouth_x, mouth_z = (mouth / width_m[:, None]).T
    along, across = x * mouth_x + z * mouth_z, z * mouth_x - x * mouth_z
    order = np.lexsort((along, np.round(across, 3), yaw_rad))
    one, other = order[:-1], order[1:]
    widths = (width_m[one] + width_m[other]) / 2
    is_beside = (
        (yaw_rad[one] == yaw_rad[other])
        & (np.abs(across[other] - across[one]) < _SAME_ROW_M)
        & (along[other] - along[one] < widths + _WIDEST_COLUMN_M + _SAME_ROW_M)
    )
    count = np.zeros(len(layout.quads), dtype=np.int64)
    np.add.at(count, one[is_beside], is_taken[other[is_beside]])
    np.add.at(count, other[is_beside], is_taken[one[is_beside]])
    return count
