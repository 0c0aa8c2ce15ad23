"""Which asset stands for which spec: one prototype for each distinct shape of a layout."""

from collections import Counter
from dataclasses import replace
from functools import lru_cache, singledispatch
from typing import NamedTuple

import numpy as np

from garage2usd import assets
from garage2usd.assets import Asset
from garage2usd.config.vehicles import CAR_BODIES, PAINTS
from garage2usd.layout import Layout
from garage2usd.layout import specs as s
from garage2usd.layout.table import KINDS

__all__ = ["Prototype", "asset_of", "name_prototypes"]

PAINT_SET = "paint"
"""Variant set of every car's asset."""


class Prototype(NamedTuple):
    """The asset that stands for a spec, and how it looks there.

    Attributes
    ----------
    name
        Name of the asset.
    look
        (variant set, variant) pairs that an instance selects.
    """

    name: str
    look: tuple[tuple[str, str], ...] = ()


def name_prototypes(layout: Layout) -> dict[s.Spec, Prototype]:
    """Name the distinct shapes of a layout, numbered by kind in the order of their first place.

    Returns
    -------
    dict
        Spec to prototype, whose asset's name is PascalCase: ``Floor_03``, ``Column_01``, ``Car_02``.
    """
    objects = layout.placements
    _, first = np.unique(objects.spec, return_index=True)
    names: dict[s.Spec, str] = {}
    prototypes: dict[s.Spec, Prototype] = {}
    counts: Counter[str] = Counter()
    for spec, row in zip(objects.specs, first.tolist(), strict=True):
        shape, look = _shape_and_look(spec)
        if shape not in names:
            kind = "".join(word.capitalize() for word in KINDS[objects.kind[row]].value.split("_"))
            counts[kind] += 1
            names[shape] = f"{kind}_{counts[kind]:02d}"
        prototypes[spec] = Prototype(names[shape], look)
    return prototypes


def _shape_and_look(spec: s.Spec) -> tuple[s.Spec, tuple[tuple[str, str], ...]]:
    """What has an asset of its own, and the variants that make the rest of the difference."""
    if isinstance(spec, s.CarSpec):
        return replace(spec, paint=PAINTS[0]), ((PAINT_SET, spec.paint),)
    return spec, ()


@lru_cache(maxsize=4096)
def asset_of(spec: s.Spec) -> Asset:
    """The meshes of one spec's shape; made once a process."""
    return _make(spec)


@singledispatch
def _make(spec: s.Spec) -> Asset:
    raise TypeError(f"no asset for {type(spec).__name__}")  # pragma: no cover - every spec is registered below


_FLOOR_MATERIAL = {
    s.Surface.LANE: "floor_concrete",
    s.Surface.STALL: "stall_epoxy",
    s.Surface.STALL_EV: "stall_green",
    s.Surface.STALL_ACCESSIBLE: "stall_blue",
    s.Surface.PAINT_WHITE: "paint_white",
    s.Surface.PAINT_YELLOW: "paint_yellow",
}


@_make.register
def _(spec: s.PanelSpec) -> Asset:
    is_stall = spec.surface is not s.Surface.LANE
    return assets.floor_panel(
        width_m=spec.width_m,
        depth_m=spec.depth_m,
        base_material=_FLOOR_MATERIAL[spec.surface],
        markings=[assets.Marking(m.polygon, _FLOOR_MATERIAL[m.surface]) for m in spec.markings],
        openings=spec.openings,
        label="parking_stall" if is_stall else "floor",
    )


@_make.register
def _(spec: s.CeilingSpec) -> Asset:
    return assets.ceiling_panel(spec.width_m, spec.depth_m, spec.thickness_m)


@_make.register
def _(spec: s.WallSpec) -> Asset:
    return assets.wall_panel(spec.length_m, spec.height_m, spec.thickness_m)


@_make.register
def _(spec: s.WallPostSpec) -> Asset:
    return assets.wall_post(spec.side_m, spec.height_m)


@_make.register
def _(spec: s.PortalSpec) -> Asset:
    return assets.portal_wall(
        spec.length_m,
        spec.height_m,
        spec.thickness_m,
        door_width_m=spec.door_width_m,
        door_height_m=spec.door_height_m,
        is_entrance=spec.is_entrance,
        is_open=spec.is_open,
    )


@_make.register
def _(spec: s.RampSpec) -> Asset:
    return assets.ramp(
        width_m=spec.width_m,
        wall_m=spec.wall_m,
        threshold_m=(spec.threshold_width_m, spec.profile[0][0]),
        profile=spec.profile,
        cover_m=(spec.cover_end_m, spec.cover_height_m, spec.profile[-1][1]),
        wall_top_m=spec.wall_top_m,
    )


@_make.register
def _(spec: s.SkySpec) -> Asset:
    return assets.sky(
        width_m=spec.width_m,
        start_m=spec.start_m,
        end_m=spec.end_m,
        ground_m=spec.ground_m,
        low_m=spec.low_m,
        high_m=spec.high_m,
    )


@_make.register
def _(spec: s.BarrierSpec) -> Asset:
    return assets.barrier(arm_m=spec.arm_m, is_raised=spec.is_raised, elbow_m=spec.elbow_m)


@_make.register
def _(spec: s.ObstacleSpec) -> Asset:
    return assets.obstacle_block(spec.width_m, spec.depth_m, spec.height_m, has_door=spec.has_door)


@_make.register
def _(spec: s.ColumnSpec) -> Asset:
    return assets.column(spec.size_m, spec.height_m)


@_make.register
def _(spec: s.TubeLightSpec) -> Asset:
    return assets.tube_light(spec.length_m, spec.width_m, drop_m=spec.drop_m, luminance_nit=spec.luminance_nit)


@_make.register
def _(spec: s.BeamSpec) -> Asset:
    return assets.beam(spec.length_m, spec.width_m, spec.depth_m)


@_make.register
def _(spec: s.BeamNodeSpec) -> Asset:
    return assets.beam_node(spec.boxes, spec.depth_m)


@_make.register
def _(spec: s.DuctSpec) -> Asset:
    return assets.duct(
        spec.length_m, spec.width_m, spec.height_m, hanger_m=spec.hanger_m, hangers_at_m=spec.hangers_at_m
    )


@_make.register
def _(spec: s.CableTraySpec) -> Asset:
    return assets.cable_tray(spec.length_m, spec.width_m, spec.height_m, spec.drop_m, rods_at_m=spec.rods_at_m)


@_make.register
def _(spec: s.SpeedBumpSpec) -> Asset:
    return assets.speed_bump(spec.length_m)


@_make.register
def _(spec: s.WheelStopSpec) -> Asset:
    return assets.wheel_stop(spec.length_m)


@_make.register
def _(_spec: s.NoParkingSignSpec) -> Asset:
    return assets.no_parking_sign()


@_make.register
def _(_spec: s.ConeSpec) -> Asset:
    return assets.cone()


@_make.register
def _(spec: s.CarSpec) -> Asset:
    body = next(body for body in CAR_BODIES if body.name == spec.body)
    return assets.car(body)


@_make.register
def _(spec: s.NumberSpec) -> Asset:
    return assets.floor_number(spec.digits, spec.height_m, pitch=s.GLYPH_PITCH)


@_make.register
def _(spec: s.ZonePlateSpec) -> Asset:
    return assets.zone_plate(spec.text, spec.column_size_m, spec.height_m, pitch=s.GLYPH_PITCH)


@_make.register
def _(_spec: s.ChargerSpec) -> Asset:
    return assets.charger()


_ARROW_DEG = {s.Turn.LEFT: -90.0, s.Turn.AHEAD: 0.0, s.Turn.RIGHT: 90.0}


@_make.register
def _(spec: s.SprinklerSpec) -> Asset:
    return assets.sprinkler(
        spec.length_m, spec.radius_m, spec.drop_m, rods_at_m=spec.rods_at_m, heads_at_m=spec.heads_at_m
    )


@_make.register
def _(spec: s.ExitSignSpec) -> Asset:
    return assets.exit_sign(_ARROW_DEG[spec.turn], spec.top_m, spec.height_m)


@_make.register
def _(spec: s.MirrorSpec) -> Asset:
    return assets.mirror(spec.radius_m, arm_m=spec.arm_m)


@_make.register
def _(spec: s.StainSpec) -> Asset:
    return assets.floor_stain(spec.mark, spec.variant, spec.width_m, spec.depth_m)


@_make.register
def _(spec: s.TyreMarkSpec) -> Asset:
    return assets.tyre_marks(spec.variant, spec.length_m, spec.turn_rad)
