"""Refusal of a garage with unreachable stalls, with a proof for the stalls in doubt."""

from collections.abc import Sequence

from garage2usd.common.errors import ConfigError
from garage2usd.common.progress import Progress, silent
from garage2usd.config import GarageConfig
from garage2usd.driving.garage import prove_garage
from garage2usd.driving.layout_garage import layout_garage
from garage2usd.driving.proof import Outcome
from garage2usd.garage import Stall
from garage2usd.layout import Layout

__all__ = ["refuse_undrivable"]

_MOST_TRIED, _NAMED = 24, 5


def refuse_undrivable(
    layout: Layout,
    config: GarageConfig,
    tight: Sequence[Stall],
    *,
    progress: Progress = silent,
) -> None:
    """Raise an error if a car cannot drive into one of the stalls in doubt and out of it.

    Parameters
    ----------
    layout, config
        The garage.
    tight
        The stalls in doubt; at most 24 of them, spread evenly, are tried.
    progress
        Function called for each stall.

    Raises
    ------
    ConfigError
        With the setting of the aisle's width and the stalls without manoeuvres.
    """
    every = max(1, -(-len(tight) // _MOST_TRIED))
    garage = layout_garage(layout)
    names = {stall.name for stall in tight[::every]}
    tried = [at for at in garage.stalls if at.name in names]
    proofs = prove_garage(garage, tried, most_explained=0, progress=progress)
    without = {proof.stall for proof in proofs if not proof.is_proven}
    if not without:
        return
    found = [stall for stall in tight if stall.name in without]
    narrowest_m = min(layout.lane_graph.clear_aisle_m(stall.access, stall.outwards) for stall in found)
    named = _named([stall.name for stall in found])
    undecided = [proof.stall for proof in proofs if proof.outcome is Outcome.UNDECIDED]
    open_ = f" (undecided, as the search ended at its bound: {_named(undecided)})" if undecided else ""
    field, value = _setting(config, found[0])
    raise ConfigError(
        field,
        value,
        f"aisles and stalls that the design car of 4.8 x 1.8 m gets into: it gets into {len(tried) - len(found)} of "
        f"{len(tried)} that were tried, not into {named}{open_}; their aisles are {narrowest_m:.2f} m clear, 5.5 m are "
        f"enough for stalls of 2.4 m; plan.unreachable_stalls = 'mark', 'drop' or 'keep' builds it nevertheless",
    )


def _named(stalls: Sequence[str]) -> str:
    return ", ".join(stalls[:_NAMED]) + (", ..." if len(stalls) > _NAMED else "")


def _setting(config: GarageConfig, stall: Stall) -> tuple[str, object]:
    """Return the setting that determines the aisle of a stall, and its value."""
    bay = config.bay
    x, z = stall.outwards
    key = "row_depths_m" if abs(z) > abs(x) else "column_widths_m"
    if getattr(bay, key) is not None:
        return f"bay.{key}", getattr(bay, key)
    if bay.dimensioned:
        return "bay.stall_width_m", bay.stall_width_m
    return "bay.square_side_m", bay.square_side_m
